/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A greenhouse: panes between bars, plants in pots, a vase and a tank of water.
 *
 * Metres. The front looks to +z, the ground is the plane y = 0. All coordinates
 * are dyadic. Faces of glass are one polygon each, seen from both sides, but
 * for the vase, which is closed. */
#include "scenes/builders.h"
#include "scenes/parts/shapes.h"

static const unsigned GROUND = 0x9db27c, BRICK = 0xa0523d, FRAME = 0xf3f1ea,
                      PANE = 0xcfe8ea, POT = 0xb5613c, LEAVES = 0x3f8a44,
                      FLOWERS = 0xd0477c, WOOD = 0x8a6f52, STONE = 0xb9b2a6,
                      WATER = 0x3f7fb0, VASE = 0x6fc0a8;

static const double BAR = 0.0625; /* half its width */

static void box(struct hsr_pen *pen, const char *name, unsigned colour,
                const double lo[3], const double hi[3]) {
  hsr_pen_object(pen, name, true);
  hsr_pen_paint(pen, colour);
  hsr_pen_box(pen, lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]);
  hsr_pen_place(pen, NULL);
}
#define BOX(name, colour, ...) box(pen, name, colour, __VA_ARGS__)
#define P(x, y, z) ((const double[3]){x, y, z})

static void base(struct hsr_pen *pen) {
  BOX("ground", GROUND, P(-9, -0.5, -7), P(9, 0, 7));
  BOX("front wall", BRICK, P(-4.25, 0, 1.75), P(4.25, 0.5, 2.25));
  BOX("back wall", BRICK, P(-4.25, 0, -2.25), P(4.25, 0.5, -1.75));
  BOX("west wall", BRICK, P(-4.25, 0, -1.75), P(-3.75, 0.5, 1.75));
  BOX("east wall", BRICK, P(3.75, 0, -1.75), P(4.25, 0.5, 1.75));
}

/* Posts and rafters, two metres apart, and a ridge. Rafters end at it. */
static void bars(struct hsr_pen *pen) {
  static const double north[4][2] = {
      {2, 2.375}, {2, 2.5}, {0.0625, 3.953125}, {0.0625, 3.828125}};
  static const double south[4][2] = {
      {-2, 2.375}, {-0.0625, 3.828125}, {-0.0625, 3.953125}, {-2, 2.5}};
  for (int k = -2; k <= 2; k++) {
    double x = 2 * k;
    BOX("post", FRAME, P(x - BAR, 0.5, 2 - BAR), P(x + BAR, 2.375, 2 + BAR));
    BOX("post", FRAME, P(x - BAR, 0.5, -2 - BAR), P(x + BAR, 2.375, -2 + BAR));
    hsr_pen_object(pen, "rafters", true);
    hsr_pen_paint(pen, FRAME);
    hsr_pen_frame(pen, 0, 0, 0, 1);
    hsr_pen_extrusion(pen, 4, north, x - BAR, x + BAR);
    hsr_pen_extrusion(pen, 4, south, x - BAR, x + BAR);
    hsr_pen_place(pen, NULL);
  }
  BOX("ridge", FRAME, P(-4.0625, 3.8125, -BAR), P(4.0625, 4, BAR));
}

static void pane(struct hsr_pen *pen, const double p[3], const double u[3],
                 const double v[3]) {
  hsr_pen_parallelogram(pen, p, u, v);
}

static void panes(struct hsr_pen *pen) {
  hsr_pen_object(pen, "panes", false);
  hsr_pen_paint(pen, PANE);
  hsr_pen_glass(pen, 0.25);
  for (int k = -2; k < 2; k++)
    for (int side = -1; side <= 1; side += 2) {
      double x = 2 * k + BAR;
      pane(pen, P(x, 0.5, 2 * side), P(1.875, 0, 0), P(0, 2, 0));
      pane(pen, P(x, 2.4375, 2 * side), P(1.875, 0, 0),
           P(0, 1.453125, -1.9375 * side));
    }
  for (int side = -1; side <= 1; side += 2) {
    double x = 4.0625 * side;
    const double gable[5][3] = {
        {x, 0.5, -2}, {x, 0.5, 2}, {x, 2.5, 2}, {x, 4, 0}, {x, 2.5, -2}};
    hsr_pen_polygon(pen, 5, gable);
  }
  hsr_pen_place(pen, NULL);
}

static void plants(struct hsr_pen *pen) {
  static const double pot[3][2] = {{0.25, 0}, {0.375, 0.5}, {0, 0.5}};
  static const double crown[5][2] = {
      {0.0625, 0.5}, {0.4375, 0.875}, {0.5, 1.25}, {0.25, 1.625}, {0, 1.75}};
  static const double place[4][2] = {
      {-3, -1}, {-1.75, 1}, {-0.5, -1.125}, {3, 1}};
  for (int k = 0; k < 4; k++) {
    double m[12];
    hsr_pen_matrix(m, place[k][0], 0, place[k][1], 0);
    hsr_pen_object(pen, "pot", true);
    hsr_pen_paint(pen, POT);
    hsr_pen_lathe(pen, 12, 3, pot);
    hsr_pen_place(pen, m);
    hsr_pen_object(pen, "plant", true);
    hsr_pen_paint(pen, k % 2 ? FLOWERS : LEAVES);
    hsr_pen_lathe(pen, 12, 5, crown);
    hsr_pen_place(pen, m);
  }
}

static void table(struct hsr_pen *pen) {
  static const double vase[5][2] = {
      {0.125, 0.75}, {0.25, 1}, {0.125, 1.375}, {0.1875, 1.5}, {0, 1.5}};
  double m[12];
  BOX("table top", WOOD, P(0.75, 0.625, 0), P(2.25, 0.75, 1.25));
  BOX("table leg", WOOD, P(1.375, 0, 0.5), P(1.625, 0.625, 0.75));
  hsr_pen_matrix(m, 1.5, 0, 0.625, 0);
  hsr_pen_object(pen, "vase", true);
  hsr_pen_paint(pen, VASE);
  hsr_pen_glass(pen, 0.5);
  hsr_pen_lathe(pen, 12, 5, vase);
  hsr_pen_place(pen, m);
}

static void tank(struct hsr_pen *pen) {
  BOX("tank", STONE, P(1, 0, -1.5), P(3.5, 0.0625, -0.25));
  BOX("tank side", STONE, P(1, 0.0625, -1.5), P(3.5, 0.5, -1.375));
  BOX("tank side", STONE, P(1, 0.0625, -0.375), P(3.5, 0.5, -0.25));
  BOX("tank side", STONE, P(1, 0.0625, -1.375), P(1.125, 0.5, -0.375));
  BOX("tank side", STONE, P(3.375, 0.0625, -1.375), P(3.5, 0.5, -0.375));
  BOX("stone", BRICK, P(1.75, 0.0625, -1.125), P(2.25, 0.25, -0.75));
  hsr_pen_object(pen, "water", false);
  hsr_pen_paint(pen, WATER);
  hsr_pen_glass(pen, 0.625);
  pane(pen, P(1.125, 0.375, -0.375), P(2.25, 0, 0), P(0, 0, -1));
  hsr_pen_place(pen, NULL);
}

static const double view[][8] = {{7, 3.5, 8, 0, 1.25, 0, 40},
                                 {-3.5, 1.75, 1.5, 2, 0.75, -0.5, 75},
                                 {0, 1.5, 9, 0, 1.5, 0, 40},
                                 {9, 1.25, 0.25, 0, 1.25, 0, 40},
                                 {0, 9, 0, 0, 0, 0, 50},
                                 {-7, 6, -8, 0, 1, 0, 40},
                                 {2.25, 1, -2.5, 2.25, 0.25, 0, 80},
                                 {1.5, 1.25, 2, 1.5, 1, 0, 60}};

enum hsr_status hsr_build_greenhouse(struct hsr_scene *scene,
                                     const long long *parameter) {
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  base(&pen);
  bars(&pen);
  panes(&pen);
  plants(&pen);
  table(&pen);
  tank(&pen);
  HSR_VIEWS(&pen, view, 1);
  return pen.status;
}
