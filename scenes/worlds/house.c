/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A house after the first column of Table II of Sutherland et al. 1974.
 *
 * Metres. The front looks to +z, the lawn is the plane y = 0. Every part is a
 * closed convex solid of its own, parts touch at most, and any two have a
 * plane between them: no algorithm's restriction is broken. All coordinates
 * are dyadic, so that parts that touch do so exactly. */
#include "scenes/builders.h"
#include "scenes/parts/shapes.h"

static const unsigned EARTH = 0x8a6f52, LAWN = 0x86b36a, STONE = 0xb9b2a6,
                      SAND = 0xd9c79a, PLASTER = 0xf1e3c6, TILES = 0xb5543c,
                      BRICK = 0xa0523d, WOOD = 0xe9e4da, DOOR = 0x2f5d62,
                      GLASS = 0x86b4cf, BARK = 0x6b4f3a, LEAVES = 0x4f8a4c;

static void part(struct hsr_pen *pen, const char *name, unsigned colour) {
  hsr_pen_object(pen, name, true);
  hsr_pen_paint(pen, colour);
}

static void box(struct hsr_pen *pen, const char *name, unsigned colour,
                const double lo[3], const double hi[3]) {
  part(pen, name, colour);
  hsr_pen_box(pen, lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]);
  hsr_pen_place(pen, NULL);
}
#define BOX(name, colour, ...) box(pen, name, colour, __VA_ARGS__)
#define P(x, y, z) ((const double[3]){x, y, z})

/* A plate of half sides a and b with its corners cut off by c. */
static void plate(struct hsr_pen *pen, const char *name, unsigned colour,
                  double a, double b, double c, const double level[2]) {
  const double ring[8][2] = {{a, -b + c},  {a - c, -b}, {-a + c, -b},
                             {-a, -b + c}, {-a, b - c}, {-a + c, b},
                             {a - c, b},   {a, b - c}};
  part(pen, name, colour);
  hsr_pen_prism(pen, 8, ring, level[0], level[1]);
  hsr_pen_place(pen, NULL);
}

static void ground(struct hsr_pen *pen) {
  plate(pen, "earth", EARTH, 26, 26, 8, (const double[2]){-1, -0.25});
  plate(pen, "lawn", LAWN, 25, 25, 8, (const double[2]){-0.25, 0});
  BOX("path", SAND, P(-1, 0, 7.25), P(1, 0.0625, 15));
}

/* Five-cornered walls below the gables, and plain ones between them. */
static void walls(struct hsr_pen *pen) {
  static const double gable[5][2] = {
      {-4, 0.5}, {4, 0.5}, {4, 4.25}, {0, 7.25}, {-4, 4.25}};
  BOX("floor", STONE, P(-5, 0, -4), P(5, 0.5, 4));
  BOX("front wall", PLASTER, P(-4.75, 0.5, 3.75), P(4.75, 4.25, 4));
  BOX("back wall", PLASTER, P(-4.75, 0.5, -4), P(4.75, 4.25, -3.75));
  BOX("ceiling", WOOD, P(-4.75, 4, -3.75), P(4.75, 4.25, 3.75));
  for (int east = 0; east <= 1; east++) {
    part(pen, east ? "east wall" : "west wall", PLASTER);
    hsr_pen_frame(pen, 0, 0, 0, 1);
    hsr_pen_extrusion(pen, 5, gable, east ? 4.75 : -5, east ? 5 : -4.75);
    hsr_pen_place(pen, NULL);
  }
}

/* Two slabs of slope 3/4 that meet above the ridge. */
static void roof(struct hsr_pen *pen) {
  static const double north[4][2] = {
      {4.75, 3.6875}, {4.75, 4}, {0, 7.5625}, {0, 7.25}};
  static const double south[4][2] = {
      {-4.75, 3.6875}, {0, 7.25}, {0, 7.5625}, {-4.75, 4}};
  for (int back = 0; back <= 1; back++) {
    part(pen, back ? "back roof" : "front roof", TILES);
    hsr_pen_frame(pen, 0, 0, 0, 1);
    hsr_pen_extrusion(pen, 4, back ? north : south, -5.5, 5.5);
    hsr_pen_place(pen, NULL);
  }
}

/* Its foot is cut along the roof, which it stands on. */
static void chimney(struct hsr_pen *pen) {
  static const double ring[8][3] = {
      {2, 6.0625, 2}, {3.25, 6.0625, 2}, {3.25, 6.8125, 1}, {2, 6.8125, 1},
      {2, 8.25, 2},   {3.25, 8.25, 2},   {3.25, 8.25, 1},   {2, 8.25, 1}};
  part(pen, "chimney", BRICK);
  hsr_pen_loft(pen, 4, 2, ring, false);
  hsr_pen_place(pen, NULL);
  BOX("chimney cap", STONE, P(1.875, 8.25, 0.875), P(3.375, 8.5, 2.125));
}

static void porch(struct hsr_pen *pen) {
  static const double shed[4][2] = {
      {-6.75, 2.75}, {-4, 2.75}, {-4, 3.5}, {-6.75, 3}};
  static const double column[2][2] = {{0.1875, 0.5}, {0.1875, 2.75}};
  BOX("porch floor", STONE, P(-2, 0, 4), P(2, 0.5, 6.5));
  BOX("step", STONE, P(-1.25, 0, 6.5), P(1.25, 0.25, 7.25));
  part(pen, "porch column", WOOD);
  hsr_pen_lathe(pen, 8, 2, column);
  for (int east = 0; east <= 1; east++) {
    double m[12];
    hsr_pen_matrix(m, east ? 1.625 : -1.625, 0, 6.125, 0);
    hsr_pen_place(pen, m);
  }
  part(pen, "porch roof", TILES);
  hsr_pen_frame(pen, 0, 0, 0, 1);
  hsr_pen_extrusion(pen, 4, shed, -2.25, 2.25);
  hsr_pen_place(pen, NULL);
}

static void openings(struct hsr_pen *pen) {
  static const struct {
    double x, y, z;
    int quarters;
  } window[4] = {
      {-3.5, 1.5, 4, 0}, {3.5, 1.5, 4, 0}, {5, 1.5, 2, 1}, {5, 1.5, -2, 1}};
  part(pen, "door", DOOR);
  hsr_pen_frame(pen, 0, 0.5, 4, 0);
  hsr_pen_panel(pen, -0.625, 0, 0.625, 2, 0.1875, 0.125, WOOD);
  hsr_pen_place(pen, NULL);
  part(pen, "window", GLASS);
  hsr_pen_panel(pen, -0.75, 0, 0.75, 1.625, 0.1875, 0.125, WOOD);
  for (int i = 0; i < 4; i++) {
    double m[12];
    hsr_pen_matrix(m, window[i].x, window[i].y, window[i].z,
                   window[i].quarters);
    hsr_pen_place(pen, m);
  }
}

static void tree(struct hsr_pen *pen) {
  static const double trunk[2][2] = {{0.25, 0}, {0.1875, 1.75}};
  static const double crown[3][2] = {{1, 1.75}, {1.875, 3}, {0, 6.5}};
  double m[12];
  hsr_pen_matrix(m, -5, 0, 8, 0);
  part(pen, "trunk", BARK);
  hsr_pen_lathe(pen, 6, 2, trunk);
  hsr_pen_place(pen, m);
  part(pen, "crown", LEAVES);
  hsr_pen_lathe(pen, 8, 3, crown);
  hsr_pen_place(pen, m);
}

static void fence(struct hsr_pen *pen) {
  part(pen, "fence", WOOD);
  hsr_pen_panel(pen, -3, 0.25, 3, 0.875, 0.125, 0.0625, WOOD);
  for (int east = 0; east <= 1; east++) {
    double m[12];
    hsr_pen_matrix(m, east ? 4.5 : -4.5, 0, 10, 0);
    hsr_pen_place(pen, m);
  }
  part(pen, "hedge", LEAVES);
  hsr_pen_panel(pen, -14, 0, 14, 2, 1.5, 0.25, LEAVES);
  hsr_pen_place(pen, (const double[12]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -12});
}

static const double view[][8] = {{12, 14, 20, -0.25, 1.5, 1.25, 38},
                                 {-16, 6, 18, 0, 3, 0, 40},
                                 {0, 3, 24, 0, 3, 0, 45},
                                 {24, 14, -12, 0, 2, 0, 40},
                                 {-13, 19, -16, 0, 2, 0, 40},
                                 {0, 30, 0, 0, 0, 0, 45},
                                 {3.5, 2, 2.5, -4, 1.5, -2, 75},
                                 {1.5, 1.75, 8.5, -2, 2, 0, 70},
                                 {9, 0.5, 9.5, 0, 3.5, 0, 60}};

enum hsr_status hsr_build_house(struct hsr_scene *scene,
                                const long long *parameter) {
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  ground(&pen);
  walls(&pen);
  roof(&pen);
  chimney(&pen);
  porch(&pen);
  openings(&pen);
  tree(&pen);
  fence(&pen);
  HSR_VIEWS(&pen, view, 1);
  return pen.status;
}
