/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loutrel's counts, derived by hand from Sutherland et al. 1974, "Edge-
 * Intersection Algorithms". All but the last three are those of Appel's
 * algorithm: they are derived in appel_test.c. */
#include "tests/counts/by_hand/lines.h"

/* Boxes overlap: 32 of 64 pairs are apart.
 * Plane intersections: 4 pairs of an upper or lower and a left or right edge,
 * each tested twice, once along each of its edges.
 * Along F's edges the boundary edge is the nearer one. */
static const struct hand_count of_bar[] = {
    {"edge cull", 8},
    {"searches", 2},
    {"initial visibility", 4},
    {"faces in line", 2},
    {"edge intersection", 64},
    {"edge intersection", 32, "boxes apart"},
    {"edge intersection", 24, "share a vertex"},
    {"edge intersection", 4, "farther"},
    {"edge intersection", 4, "nearer"},
    {"crossings", 4},
    {"promoted", 6},
    {"sort along edge", 2},
    {"intervals drawn", 12},
    {"boxes overlap", 32},
    {"plane intersections", 8},
    {"plane intersections", 4, "nearer"},
    {"nearer boundary edges", 4},
    {NULL}};

/* 36 of 64 are apart; 2 pairs cross. */
static const struct hand_count of_corner[] = {
    {"edge cull", 8},
    {"searches", 2},
    {"initial visibility", 4},
    {"faces in line", 3},
    {"edge intersection", 64},
    {"crossings", 2},
    {"promoted", 6},
    {"hiding", 1},
    {"sorts to save", 1},
    {"intervals drawn", 10},
    {"boxes overlap", 28},
    {"plane intersections", 4},
    {"plane intersections", 2, "farther"},
    {"nearer boundary edges", 2},
    {NULL}};

/* 28 of 48 are apart, and the others share a vertex. */
static const struct hand_count of_box[] = {
    {"edge cull", 24},         {"searches", 1},
    {"initial visibility", 6}, {"faces in line", 3},
    {"edge intersection", 48}, {"correction", 19},
    {"promoted", 7},           {"hiding", 4},
    {"sorts to save", 8},      {"intervals drawn", 12},
    {"boxes overlap", 20},     {NULL}};

int main(void) {
  struct tap tap = plan(3);
  ok(&tap, hand_check("loutrel", bar, 2, of_bar), "a bar before a rectangle");
  ok(&tap, hand_check("loutrel", corner, 2, of_corner),
     "a rectangle before a corner");
  ok(&tap, hand_check("loutrel", box, 1, of_box), "a box");
  return finish(&tap);
}
