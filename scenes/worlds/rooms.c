/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A building of square rooms with doors: for cells and portals. */
#include "scenes/builders.h"
#include "scenes/parts/shapes.h"

enum { SIZE = 8, HEIGHT = 4, DOOR_FROM = 3, DOOR_TO = 5, BOARDS = 5 };

/* A rectangle across an axis, between two corners. */
static void draw_rectangle(struct hsr_pen *pen, const double lo[3],
                           const double hi[3], int axis) {
  double u[3] = {0, 0, 0}, v[3] = {0, 0, 0};
  int a = (axis + 1) % 3, b = (axis + 2) % 3;
  u[a] = hi[a] - lo[a];
  v[b] = hi[b] - lo[b];
  hsr_pen_parallelogram(pen, lo, u, v);
}

/* A wall across x (axis 0) or z (axis 2), a room long, from (x, z) on. */
static void draw_wall(struct hsr_pen *pen, int axis, double x, double z,
                      bool door) {
  int along = 2 - axis;
  double lo[3] = {x, 0, z}, hi[3] = {x, HEIGHT, z};
  double from = lo[along];
  hi[along] = from + (door ? DOOR_FROM : SIZE);
  draw_rectangle(pen, lo, hi, axis);
  if (!door)
    return;
  lo[along] = from + DOOR_TO;
  hi[along] = from + SIZE;
  draw_rectangle(pen, lo, hi, axis);
  lo[along] = from + DOOR_FROM;
  hi[along] = from + DOOR_TO;
  lo[1] = 2.5;
  draw_rectangle(pen, lo, hi, axis);
}

static void draw_boards(struct hsr_pen *pen, struct hsr_random *random,
                        double x, double z) {
  for (int k = 0; k < BOARDS; k++) {
    double lo[3], hi[3];
    lo[0] = x + 1 + 0.0625 * hsr_random_int(random, 0, 80);
    lo[1] = 0.125 * k;
    lo[2] = z + 1 + 0.0625 * hsr_random_int(random, 0, 80);
    for (int a = 0; a < 3; a++)
      hi[a] = lo[a] + (a == 1 ? 1 : 0.75);
    draw_rectangle(pen, lo, hi, k % 3);
  }
}

/* parameter: rooms a side; how many doors of a hundred are open. */
enum hsr_status hsr_build_rooms(struct hsr_scene *scene,
                                const long long *parameter) {
  int n = (int)parameter[0];
  double side = (double)n * SIZE;
  struct hsr_random random = {5};
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  hsr_pen_object(&pen, "rooms", false);
  for (int i = 0; i <= n; i++)
    for (int j = 0; j < n && !pen.status; j++) {
      for (int axis = 0; axis < 3; axis += 2) {
        bool door =
            i > 0 && i < n && hsr_random_int(&random, 1, 100) <= parameter[1];
        double across = (double)i * SIZE, along = (double)j * SIZE;
        hsr_pen_palette(&pen, (uint32_t)(i + 2 * j + axis));
        draw_wall(&pen, axis, axis ? along : across, axis ? across : along,
                  door);
      }
    }
  hsr_pen_paint(&pen, 0x808080);
  for (int level = 0; level < 2; level++) {
    const double lo[3] = {0, level * HEIGHT, 0}, hi[3] = {side, 0, side};
    draw_rectangle(&pen, lo, hi, 1);
  }
  for (int room = 0; room < n * n && !pen.status; room++) {
    hsr_pen_palette(&pen, (uint32_t)room);
    draw_boards(&pen, &random, (double)(room % n) * SIZE,
                (double)(room / n) * SIZE);
  }
  hsr_pen_place(&pen, NULL);
  for (int k = 0; k < n && k < 8; k++) {
    double middle = ((double)k + 0.5) * SIZE;
    const double eye[3] = {middle, 1.75, middle};
    const double at[3] = {middle + (k % 2 ? -3 : 4), 1.5, middle + 1};
    hsr_pen_view(&pen, eye, at, 75, 0);
  }
  hsr_pen_views_to(&pen, 9);
  return pen.status;
}
