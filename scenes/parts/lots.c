/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scenes/parts/lots.h"

#include <math.h>

static const unsigned PLOT = 0xb7b09c, GRASS = 0x8fb573, GLASS = 0x6f9dbd,
                      WHITE = 0xf0ece2, STEEL = 0x4b5560, BARK = 0x6b4f3a,
                      LEAVES = 0x4f8f4e, SLATE = 0x5d6470, RED = 0xb23a33;

/* How many more parts of `size` faces bring the object nearest to n_faces. */
static int room(const struct hsr_pen *pen, int n_faces, int size) {
  if (pen->status)
    return 0;
  int n = n_faces - (int)pen->scene->objects[pen->object].n_faces;
  return n > 0 ? (n + size / 2) / size : 0;
}

/* A block from y0 to y1 over the rectangle of half sides a, b about (x, z). */
struct block {
  double x, z, a, b, y0, y1;
};

static void draw_block(struct hsr_pen *pen, const struct block *k) {
  hsr_pen_box(pen, k->x - k->a, k->y0, k->z - k->b, k->x + k->a, k->y1,
              k->z + k->b);
}

static void plot(struct hsr_pen *pen, unsigned colour) {
  hsr_pen_paint(pen, colour);
  hsr_pen_box(pen, -27, 0, -27, 27, 0.25, 27);
}

/* A roof of gables to left and right, or to front and back if `across`,
 * reaching half a metre over its block. */
static void gable_roof(struct hsr_pen *pen, const struct block *k,
                       double height, bool across) {
  double a = (across ? k->b : k->a) + 0.5, b = (across ? k->a : k->b) + 0.5;
  const double section[3][2] = {{-b, k->y1}, {b, k->y1}, {0, k->y1 + height}};
  hsr_pen_frame(pen, k->x, 0, k->z, across ? 0 : 1);
  hsr_pen_extrusion(pen, 3, section, -a, a);
  hsr_pen_frame(pen, 0, 0, 0, 0);
}

/* A grid of about n window boxes on one side of a block. */
static void window_grid(struct hsr_pen *pen, const struct block *k, int side,
                        int n) {
  double half = side & 1 ? k->b : k->a, front = side & 1 ? k->a : k->b;
  double height = k->y1 - k->y0;
  int columns = (int)(sqrt(n * 2 * half / height) + 0.5);
  columns = columns < 1 ? 1 : columns > n ? n : columns;
  int rows = (n + columns / 2) / columns;
  double w = 2 * half / columns, h = height / rows;
  hsr_pen_frame(pen, k->x, 0, k->z, side);
  for (int r = 0; r < rows; r++)
    for (int c = 0; c < columns; c++) {
      double x = -half + (c + 0.5) * w, y = k->y0 + (r + 0.5) * h;
      hsr_pen_box(pen, x - 0.3125 * w, y - 0.28125 * h, front, x + 0.3125 * w,
                  y + 0.28125 * h, front + 0.375);
    }
  hsr_pen_frame(pen, 0, 0, 0, 0);
}

/* About n windows on the four sides; a few of them on the front alone. */
static void windows(struct hsr_pen *pen, const struct block *k, int n) {
  hsr_pen_paint(pen, GLASS);
  for (int side = 0; side < 4; side++) {
    int here = n < 4 ? (side ? 0 : n) : (n + 3 - side) / 4;
    if (here > 0)
      window_grid(pen, k, side, here);
  }
}

/* The outline of a hull in 2q + 3 points, the bow a parabola towards +x. */
static void hull_ring(double (*p)[3], int q, double length, double beam,
                      double y) {
  double a = length / 2, b = beam / 2, bow = length * 0.3125;
  for (int i = 0; i < 2 * q + 3; i++) {
    double t = (double)(i - q) / q;
    p[i][0] = i <= 2 * q ? a - bow * t * t : -a;
    p[i][1] = y;
    p[i][2] = i <= 2 * q ? -b * t : i == 2 * q + 1 ? -0.75 * b : 0.75 * b;
  }
}

/* A hull from the water up to its deck. Its rings are alike, so that its sides
 * are plane; q and bands must be powers of 2 for them to be so exactly. */
static void hull(struct hsr_pen *pen, int q, int bands, double length,
                 double beam, double deck) {
  double ring[4 * 40][3];
  int n = 2 * q + 3;
  for (int i = 0; i <= bands; i++) {
    double s = 1 - 0.125 * (bands - i) / bands;
    double y = HSR_WATER + (deck - HSR_WATER) * i / bands;
    hull_ring(ring + i * n, q, length * s, beam * s, y);
  }
  hsr_pen_loft(pen, (uint32_t)n, (uint32_t)bands + 1, (const double(*)[3])ring,
               false);
}

static const unsigned box_colour[6] = {0xb5483a, 0x3f6e9a, 0xd9a441,
                                       0x5a8f6b, 0xd8d3c8, 0x7d5a8c};

/* n boxes of 2a x h x 2b in stacks of at most `tallest` on a grid of columns
 * x rows about (x, z). */
static void stacks(struct hsr_pen *pen, struct hsr_random *random,
                   const struct block *k, int columns, int rows, int n) {
  int height[64] = {0}, n_stacks = columns * rows;
  double w = 2 * k->a / columns, d = 2 * k->b / rows, h = k->y1 - k->y0;
  for (int i = 0; i < n; i++) {
    int s = hsr_random_int(random, 0, n_stacks - 1);
    while (height[s] > i / n_stacks)
      s = (s + 1) % n_stacks;
    double x = k->x - k->a + (s % columns + 0.5) * w;
    double z = k->z - k->b + (s / columns + 0.5) * d, y = k->y0 + h * height[s];
    height[s]++;
    hsr_pen_paint(pen, box_colour[hsr_random_int(random, 0, 5)]);
    hsr_pen_box(pen, x - 0.46875 * w, y, z - 0.46875 * d, x + 0.46875 * w,
                y + h, z + 0.46875 * d);
  }
}

static void draw_ship(struct hsr_pen *pen, int variant, int n_faces) {
  static const unsigned paint[4] = {0x7d2f2a, 0x27405c, 0x3c4448, 0x2f5b4f};
  struct hsr_random random = {(uint64_t)variant + 11};
  int q = n_faces < 20 ? 1 : n_faces < 60 ? 2 : 8;
  hsr_pen_paint(pen, paint[variant]);
  hull(pen, q, n_faces < 60 ? 1 : 2, 58, 14, 4);
  const struct block bridge = {-21, 0, 3.5, 4.5, 4, 15};
  hsr_pen_paint(pen, WHITE);
  draw_block(pen, &bridge);
  if (room(pen, n_faces, 6) > 0) {
    hsr_pen_paint(pen, variant & 1 ? RED : 0xe0a030);
    hsr_pen_box(pen, -22.5, 15, -1.5, -19.5, 19, 1.5);
  }
  int n = room(pen, n_faces, 6);
  if (n > 8) {
    windows(pen, &bridge, n / 2);
    n = room(pen, n_faces, 6);
  }
  const struct block cargo = {1, 0, 16, 4.5, 4, 6.5};
  int rows = n < 6 ? 1 : 3;
  stacks(pen, &random, &cargo, n < 6 ? 4 : 5, rows, n);
}

static void boat(struct hsr_pen *pen, double x, double z, bool cabin) {
  static const double sail[3][2] = {{-4, 2}, {-0.5, 2}, {-0.5, 16}};
  hsr_pen_frame(pen, x, 0, z, 0);
  hsr_pen_paint(pen, WHITE);
  hull(pen, 1, 1, 14, 5, -0.5);
  hsr_pen_extrusion(pen, 3, sail, -0.125, 0.125);
  if (cabin) {
    hsr_pen_paint(pen, BARK);
    hsr_pen_box(pen, -0.25, -0.5, -0.25, 0.25, 18, 0.25);
    hsr_pen_paint(pen, GLASS);
    hsr_pen_box(pen, 0.5, -0.5, -1, 3, 0.75, 1);
  }
  hsr_pen_frame(pen, 0, 0, 0, 0);
}

static void draw_boats(struct hsr_pen *pen, int variant, int n_faces) {
  bool cabin = n_faces >= 20;
  int n = n_faces / (cabin ? 24 : 12);
  n = n < 1 ? 1 : n > 9 ? 9 : n;
  struct hsr_random random = {(uint64_t)variant + 23};
  for (int i = 0; i < n; i++) {
    double x = n > 1 ? 20.0 * (i % 3 - 1) : 0,
           z = n > 1 ? 20.0 * (i / 3 - 1) : 0;
    x += 0.5 * hsr_random_int(&random, -5, 5);
    z += 0.5 * hsr_random_int(&random, -10, 10);
    boat(pen, x, z, cabin);
  }
}

/* Two portals, or four legs with braces, under a boom towards the water. */
static void crane_legs(struct hsr_pen *pen, bool fine) {
  for (int i = 0; i < 2; i++) {
    double x = i ? 7 : -9;
    if (!fine) {
      hsr_pen_box(pen, x, 0, 0, x + 2, 24, 18);
      continue;
    }
    hsr_pen_box(pen, x, 0, 0, x + 2, 24, 2);
    hsr_pen_box(pen, x, 0, 16, x + 2, 24, 18);
    hsr_pen_box(pen, x, 8, 2, x + 2, 10, 16);
    hsr_pen_box(pen, x, 22, 2, x + 2, 24, 16);
  }
}

static void draw_crane(struct hsr_pen *pen, int variant, int n_faces) {
  bool fine = n_faces > 80;
  hsr_pen_paint(pen, variant ? 0x3c7fb0 : 0xe3a52e);
  crane_legs(pen, fine);
  hsr_pen_box(pen, -10, 24, -1, 10, 27, 19);
  hsr_pen_box(pen, -2, 27, -24, 2, 29.5, 32);
  int n = room(pen, n_faces, 6);
  if (n-- > 0) {
    hsr_pen_paint(pen, WHITE);
    hsr_pen_box(pen, -2, 29.5, -23, 2, 34, -14);
  }
  hsr_pen_paint(pen, STEEL);
  if (n-- > 0)
    hsr_pen_box(pen, -1.5, 29.5, 8, 1.5, 46, 11);
  for (int i = 0; i < n; i++) {
    double z = -13 + 20.0 * i / n;
    hsr_pen_box(pen, -1.75, 29.5, z, 1.75, 31 + (i & 1), z + 10.0 / n);
  }
}

static void draw_containers(struct hsr_pen *pen, int variant, int n_faces) {
  struct hsr_random random = {(uint64_t)variant + 37};
  int n = room(pen, n_faces, 6);
  const struct block ground = {0, 0, 26, 26, 0, n < 6 ? 9 : 4.5};
  if (n < 6)
    stacks(pen, &random, &ground, 1, 3, n);
  else
    stacks(pen, &random, &ground, 2, 7, n);
}

static void draw_warehouse(struct hsr_pen *pen, int variant, int n_faces) {
  static const unsigned wall[3] = {0x9c5a48, 0xb98d6a, 0x8b8f94};
  const struct block hall = {0, 0, 27, 16 + 3.0 * variant, 0, 15 + variant};
  hsr_pen_paint(pen, wall[variant]);
  draw_block(pen, &hall);
  hsr_pen_paint(pen, SLATE);
  gable_roof(pen, &hall, 6, false);
  windows(pen, &hall, room(pen, n_faces, 6));
}

/* A cylinder under a quarter-circle dome. */
static void one_tank(struct hsr_pen *pen, double x, double radius,
                     double height, int n_faces) {
  double profile[40][2] = {{radius, 0}, {radius, height}};
  uint32_t n = n_faces < 60 ? 8 : n_faces < 120 ? 12 : 16, k = 2;
  int bands = (n_faces - 1 - (int)n) / (int)n;
  for (int i = 1; i <= bands; i++, k++) {
    double c, s;
    hsr_unit((uint32_t)i, 4 * (uint32_t)bands, &c, &s);
    profile[k][0] = i == bands ? 0 : radius * hsr_grid(c, 64);
    profile[k][1] = height + radius * 0.5 * hsr_grid(s, 64);
  }
  hsr_pen_frame(pen, x, 0, 0, 0);
  hsr_pen_lathe(pen, n, k, (const double(*)[2])profile);
  hsr_pen_frame(pen, 0, 0, 0, 0);
}

static void draw_tank(struct hsr_pen *pen, int variant, int n_faces) {
  hsr_pen_paint(pen, variant ? 0xcfd6d8 : 0xd9cdb4);
  if (n_faces < 60) {
    one_tank(pen, 0, 22, 14 + 6 * variant, n_faces);
    return;
  }
  one_tank(pen, -14.5, 13, 14 + 4 * variant, n_faces / 2);
  one_tank(pen, 14.5, 13, 14 + 4 * variant, n_faces / 2);
}

static const unsigned wall_colour[6] = {0xe8d5b0, 0xd9a07a, 0xe3c6a8,
                                        0xc7d0cf, 0xd98f70, 0xf0e6d2};

static void one_house(struct hsr_pen *pen, const struct block *body,
                      int variant, int n_faces) {
  uint32_t before = pen->status ? 0 : pen->scene->objects[pen->object].n_faces;
  hsr_pen_paint(pen, wall_colour[variant]);
  draw_block(pen, body);
  hsr_pen_paint(pen, variant & 1 ? 0x9a4a38 : 0xb35f42);
  gable_roof(pen, body, 0.5 * (body->b < body->a ? body->b : body->a) + 2,
             body->a < body->b);
  windows(pen, body, room(pen, (int)before + n_faces, 6));
}

static void draw_houses(struct hsr_pen *pen, int variant, int n_faces) {
  double h = 18 + 4.0 * (variant % 3);
  if (n_faces >= 17)
    plot(pen, PLOT);
  if (n_faces < 60) {
    const struct block one = {0, 0, 22, 14, 0.25, h + 4};
    one_house(pen, &one, variant, n_faces - (n_faces >= 17 ? 6 : 0));
    return;
  }
  int n = n_faces < 120 ? 2 : 4;
  for (int i = 0; i < n; i++) {
    struct block k = {n == 2  ? 0
                      : i & 1 ? 13.5
                              : -13.5,
                      i & n / 2 ? 13 : -13,
                      n == 2 ? 22 : 11,
                      9,
                      0.25,
                      h + 2 * (i % 3)};
    if (n == 2)
      k.z = i ? 13 : -13;
    one_house(pen, &k, (variant + i) % 6, (n_faces - 6) / n);
  }
}

static void draw_tower(struct hsr_pen *pen, int variant, int n_faces) {
  static const unsigned wall[5] = {0xd8dde0, 0xcdbfa6, 0x9fb4c0, 0xe6dccb,
                                   0xb9aca0};
  double h = 54 + 13 * variant;
  if (n_faces >= 17)
    plot(pen, PLOT);
  const struct block shaft = {0, 0, 14, 14, 0.25, h};
  const struct block top = {0, 0, 10, 10, h, h + 8 + 2 * (variant & 1)};
  hsr_pen_paint(pen, wall[variant]);
  draw_block(pen, &shaft);
  hsr_pen_paint(pen, SLATE);
  if (room(pen, n_faces, 6) > 0)
    draw_block(pen, &top);
  windows(pen, &shaft, room(pen, n_faces, 6));
}

static void one_tree(struct hsr_pen *pen, double x, double z, double height) {
  const double crown[3][2] = {
      {2.5, 0.25 * height}, {5, 0.5 * height}, {0, height}};
  hsr_pen_frame(pen, x, 0, z, 0);
  hsr_pen_paint(pen, BARK);
  hsr_pen_box(pen, -0.75, 0.25, -0.75, 0.75, 0.25 * height, 0.75);
  hsr_pen_paint(pen, LEAVES);
  hsr_pen_lathe(pen, 6, 3, crown);
  hsr_pen_frame(pen, 0, 0, 0, 0);
}

static void draw_park(struct hsr_pen *pen, int variant, int n_faces) {
  struct hsr_random random = {(uint64_t)variant + 41};
  plot(pen, GRASS);
  int n = room(pen, n_faces, 19);
  for (int i = 0; i < n; i++) {
    double x = n < 3 ? 12.0 * i : -20 + 13.0 * (i % 4);
    double z = n < 3 ? 0 : -18 + 13.0 * (i / 4 % 4);
    x += 0.25 * hsr_random_int(&random, -3, 3);
    z += 0.25 * hsr_random_int(&random, -3, 3);
    one_tree(pen, x, z, hsr_random_int(&random, 12, 20));
  }
}

static void draw_church(struct hsr_pen *pen, int variant, int n_faces) {
  static const double spire[2][2] = {{5.5, 40}, {0, 66}};
  (void)variant;
  const struct block nave = {6, 0, 19, 9, 0, 16},
                     tower = {-19, 0, 5.5, 5.5, 0, 40};
  hsr_pen_paint(pen, 0xd9cdb8);
  draw_block(pen, &nave);
  draw_block(pen, &tower);
  hsr_pen_paint(pen, 0x6d8f86);
  gable_roof(pen, &nave, 10, false);
  hsr_pen_frame(pen, -19, 0, 0, 0);
  hsr_pen_lathe(pen, 8, 2, spire);
  hsr_pen_frame(pen, 0, 0, 0, 0);
  windows(pen, &nave, room(pen, n_faces, 6));
}

/* Bands of red and white, a gallery, a lantern and its roof. */
static void draw_lighthouse(struct hsr_pen *pen, int variant, int n_faces) {
  (void)variant;
  uint32_t n = n_faces < 60 ? 8 : 16;
  int bands = (n_faces - 3 * (int)n) / ((int)n + 2);
  bands = bands < 1 ? 1 : bands;
  for (int i = 0; i < bands; i++) {
    double foot = (double)i / bands, top = (i + 1.0) / bands;
    const double ring[2][2] = {{hsr_grid(8 - 3 * foot, 16), 36 * foot},
                               {hsr_grid(8 - 3 * top, 16), 36 * top}};
    hsr_pen_paint(pen, i & 1 ? RED : WHITE);
    hsr_pen_lathe(pen, n, 2, ring);
  }
  static const double lantern[3][2] = {{3.5, 36}, {3.5, 41}, {0, 46}};
  hsr_pen_paint(pen, 0xf2d36b);
  hsr_pen_lathe(pen, n, 3, lantern);
}

/* A dome of radius 1 and height 1, to be stretched by its instance. */
static void draw_hill(struct hsr_pen *pen, int variant, int n_faces) {
  double profile[40][2] = {{1, 0}};
  uint32_t n = n_faces < 20 ? 6 : n_faces < 60 ? 8 : n_faces < 100 ? 12 : 16;
  uint32_t bands = (uint32_t)n_faces / n;
  bands = bands < 1 ? 1 : bands > 30 ? 30 : bands;
  for (uint32_t i = 1; i <= bands; i++) {
    double c, s;
    hsr_unit(i, 4 * bands, &c, &s);
    profile[i][0] = i == bands ? 0 : hsr_grid(c, 256);
    profile[i][1] = hsr_grid(s, 256);
  }
  hsr_pen_paint(pen, variant ? 0x6f9a6a : 0x7fa874);
  hsr_pen_lathe(pen, n, bands + 1, (const double(*)[2])profile);
}

const struct hsr_lot_type hsr_lot_types[HSR_N_LOT_KINDS] = {
#define X(kind, variants) {#kind, variants, draw_##kind},
    HSR_LOTS(X)
#undef X
};
