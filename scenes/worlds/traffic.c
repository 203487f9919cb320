/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The office with moving carts. Each has a straight way of its own from one end
 * of the building to the other, along x or z, and turns as it goes. There are
 * as many as make the given percentage of all faces move. They pass through
 * whatever stands there. */
#include "scenes/builders.h"
#include "scenes/parts/shapes.h"

enum { MODULES = 3, CART_FACES = 8 * 12, MODULE_FACES = 14976 };
static const double LENGTH = 16.0 * MODULES, STOREY = 4;

/* 96 triangles, about the origin, its wheels on y = 0. */
static void draw_cart(struct hsr_pen *pen) {
  hsr_pen_object(pen, "cart", true);
  pen->triangles = true;
  pen->scene->objects[pen->object].moves = true;
  hsr_pen_paint(pen, 0xb23a33);
  hsr_pen_box(pen, -0.375, 0.25, -0.25, 0.375, 0.3125, 0.25);
  hsr_pen_paint(pen, 0x6f9dbd);
  hsr_pen_box(pen, -0.3125, 0.3125, -0.1875, 0.1875, 0.75, 0.1875);
  hsr_pen_paint(pen, 0x4b5560);
  hsr_pen_box(pen, 0.3125, 0.3125, -0.25, 0.375, 1, -0.1875);
  hsr_pen_box(pen, 0.3125, 0.3125, 0.1875, 0.375, 1, 0.25);
  for (int k = 0; k < 4; k++) {
    double x = k & 1 ? 0.25 : -0.25, z = k & 2 ? 0.1875 : -0.1875;
    hsr_pen_box(pen, x - 0.0625, 0, z - 0.03125, x + 0.0625, 0.125,
                z + 0.03125);
  }
}

/* Places a cart at a frame. Its way, speed and turning are random. */
static void place_cart(struct hsr_pen *pen, struct hsr_random *random,
                       double frame) {
  double start = LENGTH * hsr_random_unit(random);
  double aside = 1 + (LENGTH - 2) * hsr_random_unit(random);
  double speed = 0.02 + 0.06 * hsr_random_unit(random); /* metres a frame */
  int storey = hsr_random_int(random, 0, 4 * MODULES - 1);
  int direction = hsr_random_int(random, 0, 3);
  uint32_t turns = (uint32_t)hsr_random_int(random, 0, 359);
  double along = start + speed * frame, c, s;
  along -= LENGTH * (double)(long long)(along / LENGTH);
  if (direction & 1)
    along = LENGTH - along;
  double x = direction & 2 ? along : aside, z = direction & 2 ? aside : along;
  hsr_unit((turns + (uint32_t)frame) % 360, 360, &c, &s);
  const double m[12] = {c,  0, s, x, 0, 1, 0, STOREY * storey + 0.25,
                        -s, 0, c, z};
  hsr_pen_place(pen, m);
}

enum hsr_status hsr_build_traffic(struct hsr_scene *scene,
                                  const long long *parameter) {
  const long long office[3] = {MODULES, 0, 0};
  double per_cent = (double)parameter[0], frame = (double)parameter[1];
  double still = (double)MODULE_FACES * MODULES * MODULES * MODULES;
  int carts = (int)(still * per_cent / (100 - per_cent) / CART_FACES + 0.5);
  enum hsr_status status = hsr_build_office(scene, office);
  if (status)
    return status;
  struct hsr_random random = {1995};
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  draw_cart(&pen);
  for (int k = 0; k < carts; k++)
    place_cart(&pen, &random, frame);
  return pen.status;
}
