/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scenes/parts/module.h"

/* The stairwell in the slabs. */
enum { WEST = 332, EAST = 692, NORTH = 288, SOUTH = 736 };

/* The stairs. */
enum {
  N_TREADS = 15,
  RISE = 16,
  RUN = (EAST - WEST) / N_TREADS,
  STAIR_NORTH = 448,
  STAIR_SOUTH = 576
};

/* Heights above the floor: of hand rails, of a cubicle's walls, desk and shelf.
 */
enum { RAIL = 64, WALL = 96, DESK = 48, SHELF = 74 };

/* A cubicle's extent along x and z. */
enum { WIDE = 192, DEEP = 176 };

static const unsigned CONCRETE = 0xc9c5bb, PAINT = 0xe8e6df, STEEL = 0x7d8790,
                      TREAD = 0xa9794f, LIGHT = 0xfff6d8, DARK = 0x34383d,
                      BEECH = 0xd8b98a, CABINET = 0xaeb4b8, PAPER = 0xf4f1e8;

/* A bar along the stairs, between x0 and x1 and between two heights above the
 * line of the treads' backs, which rises by 2 in 3; x is from the foot. */
static void bar(struct hsr_pen *pen, int x0, int x1, int low, int high, int z0,
                int z1) {
  const int x[4] = {x0, x1, x1, x0}, z[4] = {z1, z1, z0, z0};
  double p[8][3];
  for (int i = 0; i < 8; i++) {
    p[i][0] = (WEST + x[i % 4]) / 64.0;
    p[i][1] = (RISE * x[i % 4] / RUN + (i < 4 ? low : high)) / 64.0;
    p[i][2] = z[i % 4] / 64.0;
  }
  hsr_pen_loft(pen, 4, 2, (const double(*)[3])p, false);
}

/* --- The building: 56 hexahedra a storey ---------------------------------- */

static void slab(struct hsr_pen *pen) {
  hsr_pen_paint(pen, CONCRETE);
  hsr_pen_block(pen, 0, -HSR_SLAB, 0, HSR_MODULE, 0, NORTH);
  hsr_pen_block(pen, 0, -HSR_SLAB, SOUTH, HSR_MODULE, 0, HSR_MODULE);
  hsr_pen_block(pen, 0, -HSR_SLAB, NORTH, WEST, 0, SOUTH);
  hsr_pen_block(pen, EAST, -HSR_SLAB, NORTH, HSR_MODULE, 0, SOUTH);
}

/* Up to the next slab; and, so that no module reaches into the next, the upper
 * end of the rails of the stairs from below. */
static void stairs(struct hsr_pen *pen) {
  hsr_pen_paint(pen, TREAD);
  for (int i = 1; i <= N_TREADS; i++)
    hsr_pen_block(pen, WEST + RUN * (i - 1), RISE * i - 4, STAIR_NORTH + 4,
                  WEST + RUN * i, RISE * i, STAIR_SOUTH - 4);
  for (int south = 0; south <= 1; south++) {
    int z = south ? STAIR_SOUTH - 4 : STAIR_NORTH, well = EAST - WEST;
    hsr_pen_paint(pen, STEEL);
    bar(pen, 0, well, -HSR_SLAB, 0, z, z + 4);
    bar(pen, 126, 129, 0, RAIL, z + 1, z + 3);
    bar(pen, well - 3, well, 2 - HSR_STOREY, RAIL - HSR_STOREY, z + 1, z + 3);
    hsr_pen_paint(pen, TREAD);
    bar(pen, 0, 258, RAIL, RAIL + 3, z, z + 4);
    bar(pen, 264, well, RAIL - HSR_STOREY, RAIL + 3 - HSR_STOREY, z, z + 4);
  }
}

/* About the stairwell, but for the ends of the stairs. */
static void railings(struct hsr_pen *pen) {
  for (int south = 0; south <= 1; south++) {
    int edge = south ? SOUTH : NORTH - 4, end = south ? SOUTH + 4 : NORTH;
    int open = south ? STAIR_SOUTH : STAIR_NORTH - 3;
    hsr_pen_paint(pen, STEEL);
    for (int x = WEST; x < EAST; x += (EAST - WEST) / 2 - 2)
      hsr_pen_block(pen, x, 0, edge, x + 3, RAIL, edge + 3);
    hsr_pen_block(pen, WEST - 4, 0, open, WEST - 1, RAIL, open + 3);
    hsr_pen_block(pen, EAST + 1, 0, open, EAST + 4, RAIL, open + 3);
    hsr_pen_paint(pen, TREAD);
    hsr_pen_block(pen, WEST - 4, RAIL, edge, EAST + 4, RAIL + 3, end);
    int from = south ? open : NORTH, to = south ? SOUTH : open + 3;
    hsr_pen_block(pen, WEST - 4, RAIL, from, WEST, RAIL + 3, to);
    hsr_pen_block(pen, EAST, RAIL, from, EAST + 4, RAIL + 3, to);
  }
}

/* Thin columns, beams from module to module on them, and lamps below these. */
static void frame(struct hsr_pen *pen) {
  for (int south = 0; south <= 1; south++) {
    int z = south ? SOUTH + 4 : NORTH - 24, top = HSR_STOREY - HSR_SLAB - 16;
    hsr_pen_paint(pen, PAINT);
    hsr_pen_block(pen, WEST - 24, 0, z, WEST - 4, top, z + 20);
    hsr_pen_block(pen, EAST + 4, 0, z, EAST + 24, top, z + 20);
    hsr_pen_block(pen, 0, top, z, HSR_MODULE, top + 16, z + 20);
    hsr_pen_paint(pen, LIGHT);
    hsr_pen_block(pen, WEST + 80, top - 4, z + 4, EAST - 80, top, z + 16);
  }
}

/* --- A cubicle: 32 hexahedra ------------------------------------------------
 *
 * In its own frame: x from 0 to WIDE, the back at z = 0, the front, with the
 * way in, at z = DEEP. The wall at x = WIDE is the next cubicle's. */

static void walls(struct hsr_pen *pen, unsigned cloth) {
  hsr_pen_paint(pen, cloth);
  hsr_pen_block(pen, 0, 0, 0, WIDE, WALL, 4);
  hsr_pen_block(pen, 0, 0, 4, 4, WALL, DEEP);
  hsr_pen_block(pen, 4, 0, DEEP - 4, 80, WALL, DEEP);
}

static void desk(struct hsr_pen *pen) {
  hsr_pen_paint(pen, BEECH);
  hsr_pen_block(pen, 4, DESK - 4, 4, WIDE, DESK, 52);
  hsr_pen_block(pen, 4, DESK - 4, 52, 48, DESK, 128);
  hsr_pen_paint(pen, STEEL);
  hsr_pen_block(pen, 4, 0, 8, 7, DESK - 4, 48);
  hsr_pen_block(pen, 8, 0, 121, 44, DESK - 4, 124);
}

/* Three drawers below the desk, now and then one left open. */
static void drawers(struct hsr_pen *pen, struct hsr_random *random) {
  hsr_pen_paint(pen, CABINET);
  hsr_pen_block(pen, 152, 0, 8, 184, DESK - 4, 46);
  for (int i = 0; i < 3; i++) {
    int y = 2 + 14 * i;
    int front =
        hsr_random_int(random, 0, 7) ? 47 : hsr_random_int(random, 50, 62);
    hsr_pen_paint(pen, CABINET);
    hsr_pen_block(pen, 153, y, 46, 183, y + 13, front);
    hsr_pen_paint(pen, DARK);
    hsr_pen_block(pen, 162, y + 8, front, 174, y + 10, front + 1);
  }
}

/* A shelf on the back wall, with five books. */
static void shelf(struct hsr_pen *pen, struct hsr_random *random) {
  hsr_pen_paint(pen, BEECH);
  hsr_pen_block(pen, 98, SHELF - 2, 4, WIDE - 2, SHELF, 20);
  int x = hsr_random_int(random, 100, 120);
  for (int i = 0; i < 5; i++) {
    int thick = hsr_random_int(random, 3, 9);
    hsr_pen_palette(pen, (uint32_t)hsr_random_int(random, 0, 11));
    int deep = hsr_random_int(random, 14, 19);
    int high = hsr_random_int(random, 12, 19);
    hsr_pen_block(pen, x, SHELF, 4, x + thick, SHELF + high, deep);
    x += thick + hsr_random_int(random, 0, 3);
  }
}

/* Monitor, keyboard and a pile of paper. */
static void computer(struct hsr_pen *pen, struct hsr_random *random) {
  static const unsigned glow[4] = {0x9cc7e8, 0x3f6fa5, 0xdfe9d8, 0x24405c};
  int x = hsr_random_int(random, 56, 74);
  hsr_pen_paint(pen, DARK);
  hsr_pen_block(pen, x - 9, DESK, 12, x + 9, DESK + 1, 28);
  hsr_pen_block(pen, x - 2, DESK + 1, 18, x + 2, DESK + 16, 20);
  hsr_pen_block(pen, x - 20, DESK + 8, 20, x + 20, DESK + 36, 23);
  hsr_pen_paint(pen, glow[hsr_random_int(random, 0, 3)]);
  hsr_pen_block(pen, x - 18, DESK + 10, 23, x + 18, DESK + 34, 24);
  hsr_pen_paint(pen, PAINT);
  x += hsr_random_int(random, -6, 6);
  hsr_pen_block(pen, x - 14, DESK, 33, x + 14, DESK + 2, 44);
  hsr_pen_paint(pen, PAPER);
  x = hsr_random_int(random, 104, 150);
  hsr_pen_block(pen, x, DESK, 24, x + 14, DESK + hsr_random_int(random, 1, 9),
                43);
}

/* About the axis of its frame, the back to +z. */
static void chair(struct hsr_pen *pen, unsigned cloth) {
  hsr_pen_paint(pen, DARK);
  hsr_pen_block(pen, -16, 1, -2, 16, 4, 2);
  hsr_pen_block(pen, -2, 1, 2, 2, 4, 16);
  hsr_pen_block(pen, -2, 1, -16, 2, 4, -2);
  hsr_pen_block(pen, -2, 4, -2, 2, 28, 2);
  hsr_pen_paint(pen, cloth);
  hsr_pen_block(pen, -14, 28, -14, 14, 32, 14);
  hsr_pen_block(pen, -13, 30, 14, 13, 62, 17);
}

/* With its corner at (x, z), turned by quarters. */
static void cubicle(struct hsr_pen *pen, int x, int y, int z, int quarters,
                    struct hsr_random *random) {
  static const unsigned cloth[4] = {0x8c9fae, 0xa5a58d, 0x9fb0a0, 0xb39b8e};
  static const unsigned seat[4] = {0x2f4858, 0x7a3b3b, 0x3d5a3f, 0x55486b};
  hsr_pen_frame(pen, x / 64.0, y / 64.0, z / 64.0, quarters);
  walls(pen, cloth[hsr_random_int(random, 0, 3)]);
  desk(pen);
  drawers(pen, random);
  shelf(pen, random);
  computer(pen, random);
  double place[3] = {hsr_random_int(random, 68, 128) / 64.0};
  place[2] = hsr_random_int(random, 88, 136) / 64.0;
  hsr_instance_vertex(pen->m, place, place);
  hsr_pen_frame(pen, place[0], place[1], place[2],
                quarters + hsr_random_int(random, 0, 3));
  chair(pen, seat[hsr_random_int(random, 0, 3)]);
}

/* Four cubicles, and the wall that ends the row. */
static void row(struct hsr_pen *pen, int y, bool south,
                struct hsr_random *random) {
  int turn = south ? 2 : 0, sign = south ? -1 : 1;
  int x = south ? HSR_MODULE - 128 : 128, z = south ? HSR_MODULE : 0;
  for (int i = 0; i < 4; i++)
    cubicle(pen, x + sign * WIDE * i, y, z, turn, random);
  hsr_pen_frame(pen, (x + sign * WIDE * 4) / 64.0, y / 64.0, z / 64.0, turn);
  hsr_pen_paint(pen, 0x8c9fae);
  hsr_pen_block(pen, 0, 0, 0, 4, WALL, DEEP);
}

static void storey(struct hsr_pen *pen, int i, struct hsr_random *random) {
  int y = HSR_STOREY * i + HSR_SLAB;
  hsr_pen_frame(pen, 0, y / 64.0, 0, 0);
  slab(pen);
  stairs(pen);
  railings(pen);
  frame(pen);
  hsr_pen_paint(pen, CABINET);
  hsr_pen_block(pen, 800, 0, 416, 832, 72, 608);
  row(pen, y, false, random);
  row(pen, y, true, random);
}

void hsr_draw_module(struct hsr_pen *pen) {
  struct hsr_random random = {1993};
  for (int i = 0; i < HSR_MODULE / HSR_STOREY; i++)
    storey(pen, i, &random);
}
