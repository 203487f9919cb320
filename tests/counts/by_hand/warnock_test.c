/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnock's counts, derived by hand from Sutherland et al. 1974, "J. E.
 * Warnock", and from the module's own rule: sub-windows inherit that a face
 * behind a surrounder is hidden. */
#include "tests/counts/by_hand/pixels.h"

enum { SIZE = 8 };

/*      0 1 2 3 4 5 6 7
 *    0 A A A A . . . .      A fills columns 0 to 3 and reaches beyond the
 *    1 A A A A B E B .        picture above, below and to the left
 *    2 A A A A B B B .      B is the farthest: columns 1 to 6, rows 1 and 2
 *    3 A A A A . . . .      C, D and E are the nearest
 *    4 A A A A . . . .
 *    5 A C C A . . . .
 *    6 A A D A . . . .
 *    7 A A A A . . . . */
static const struct pixel_face faces[] = {
    PIXEL_RECTANGLE(-1, -1, 4, 9, 8), PIXEL_RECTANGLE(1, 1, 7, 3, 16),
    PIXEL_RECTANGLE(1, 5, 3, 6, 4), PIXEL_RECTANGLE(2, 6, 3, 7, 4),
    PIXEL_RECTANGLE(5, 1, 6, 2, 4)};

/* Z sort: 5 faces in 2 passes: 10. The order is C, D, E, A, B.
 *
 * The columns of the table are: tests, and those that boxes decide; surrounders
 * and disjoints that are inherited; hidden faces; depth comparisons. A box
 * decides if it is apart from the window, or lies in it and is smaller.
 *
 *   window                 tests box  surr disj  hidden depth
 *   0-8, 0-8                 5    5     0    0     0     0   five intersecters
 *   0-4, 0-4                 4    3     0    0     1     0   homogeneous: A
 *     (C, D and E are apart, A surrounds it, B is behind A)
 *   4-8, 0-4                 5    4     0    0     0     0   E and B intersect
 *     (B is decided by its edges; C, D and A are disjoint from all parts)
 *     4-6, 0-2               2    1     0    3     0     0   E and B intersect
 *       sample 4, 0          2    2     0    3     0     0   background
 *       sample 5, 0          2    2     0    3     0     0   background
 *       sample 4, 1          2    1     0    3     0     0   B
 *       sample 5, 1          1    0     0    3     1     0   E, which hides B
 *     6-8, 0-2               2    1     0    3     0     0   one face: B, 1 run
 *     4-6, 2-4               2    1     0    3     0     0   one face: B, 1 run
 *     6-8, 2-4               2    1     0    3     0     0   one face: B, 1 run
 *   0-4, 4-8                 4    3     0    0     1     2   C and D before A
 *     (E is apart; B is behind A)
 *     0-2, 4-6               2    1     1    1     1     1   C before A, 1 run
 *     2-4, 4-6               2    1     1    1     1     1   C before A, 1 run
 *     0-2, 6-8               2    2     1    1     1     0   homogeneous: A
 *     2-4, 6-8               2    2     1    1     1     1   D before A, 1 run
 *   4-8, 4-8                 5    5     0    0     0     0   empty
 *   sum                     46   35     4   28     7     5
 *
 * The tests find 25 disjoint faces, all by their boxes; 17 intersecters, 10 of
 * them by their boxes, which are contained; and 4 surrounders. All comparisons
 * in depth find a face in front of A.
 *
 * There are 17 windows, 4 of which are divided. Check: of 17 times 5 faces, 46
 * are tested, 4 + 28 are inherited, and 7 are hidden. */
static const struct hand_count derived[] = {
    {"Z sort", 10},
    {"Warnock special", 46},
    {"Warnock special", 25, "disjoint"},
    {"Warnock special", 17, "intersecter"},
    {"Warnock special", 4, "surrounder"},
    {"depth search", 5},
    {"depth search", 5, "in front"},
    {"windows", 17},
    {"subdivisions", 4},
    {"minimax culls", 35},
    {"minimax culls", 25, "disjoint"},
    {"minimax culls", 10, "intersecter"},
    {"inherited surrounders", 4},
    {"inherited disjoints", 28},
    {"hidden faces", 7},
    {"empty windows", 1},
    {"homogeneous windows", 2},
    {"one face", 3},
    {"one in front", 3},
    {"samples", 4},
    {"runs", 6},
    {NULL}};

/* As a raster. 13 windows are decided, and put into buckets twice. In rows:
 * 0-4, 0-4 has 4, each sample 1, each window of 2 x 2 has 2, 4-8, 4-8 has 4:
 * 4 + 4 + 7 x 2 + 4 = 26.
 *
 *   row   begin                         go on          comparisons
 *    0    0-4; 4; 5; 6-8                -              0
 *    1    4; 5                          0-4; 6-8       4, 0-4; 4, 6-8; 5, 6-8
 *    2    4-6; 6-8                      0-4            4-6, 0-4
 *    4    0-2; 2-4; 4-8                 -              0
 *    6    0-2; 2-4                      4-8            0-2, 4-8; 2-4, 4-8
 *
 * The window that begins is to the right of 0-4 twice, and else to the left. */
static const struct hand_count raster[] = {{"raster sort", 26},
                                           {"raster sort", 13, "by X"},
                                           {"raster sort", 13, "by Y"},
                                           {"raster merge", 6},
                                           {"raster merge", 2, "right"},
                                           {"raster merge", 4, "left"},
                                           {"raster rows", 26},
                                           {"windows", 17},
                                           {"Warnock special", 46},
                                           {"runs", 6},
                                           {NULL}};

/* With 64 regions, each is a sample. In the first frame all faces enter: A into
 * 4 x 8, B into 6 x 2, C into 2, D and E into 1. Ten regions have two faces.
 * Where B is behind A, six times, they enter in order: 1 comparison. Where C, D
 * or E is before the other, they do not: 1 finds it, 1 merges, and 1 finds them
 * in order. The first in Z order surrounds the sample, and hides the other. */
static const struct hand_count in_regions[] = {
    {"ranges", 5},
    {"ranges", 5, "others"},
    {"entered", 48},
    {"left", 0},
    {"region sort", 18},
    {"region sort", 10, "in order"},
    {"region sort", 8, "out of order"},
    {"Z sort", 0},
    {"windows", 64},
    {"samples", 64},
    {"subdivisions", 0},
    {"Warnock special", 38},
    {"Warnock special", 38, "surrounder"},
    {"hidden faces", 10},
    {"depth search", 0},
    {"minimax culls", 0},
    {NULL}};

/* The surround tests are those of the four surrounders: all else is decided by
 * boxes, or by an edge that meets the window. Each face is a rectangle around the
 * point: the point is on one side of its four edges; two of them cross the line
 * of its row, the left one to its left; and there is a corner in each quadrant. */
static const struct hand_count sides[] = {{"surround tests", 4},
                                          {"surround tests", 4, "inside"},
                                          {"surround: sides", 16},
                                          {"surround: sides", 16, "one side"},
                                          {"surround: rows", 0},
                                          {"surround: quadrants", 0},
                                          {"Warnock special", 46},
                                          {"windows", 17},
                                          {NULL}};
static const struct hand_count crossings[] = {
    {"surround tests", 4},
    {"surround tests", 4, "inside"},
    {"surround: rows", 16},
    {"surround: rows", 8, "on both sides"},
    {"surround: crossings", 8},
    {"surround: crossings", 4, "crosses it"},
    {"surround: crossings", 4, "to the right of the point"},
    {"surround: sides", 0},
    {"windows", 17},
    {NULL}};
static const struct hand_count angles[] = {
    {"surround tests", 4},
    {"surround tests", 4, "inside"},
    {"surround: quadrants", 16},
    {"surround: quadrants", 4, "upper right"},
    {"surround: quadrants", 4, "lower left"},
    {"surround: diagonals", 0},
    {"windows", 17},
    {NULL}};

int main(void) {
  struct tap tap = plan(6);
  struct hand_picture p;
  pixel_open(&p, faces, 5, SIZE, SIZE);
  ok(&tap, hand_compare(&p, "warnock", derived, true), "five rectangles");
  ok(&tap, hand_compare(&p, "warnock:output=raster", raster, false),
     "as a raster");
  ok(&tap, hand_compare(&p, "warnock:regions=64", in_regions, false),
     "in 64 regions");
  ok(&tap, hand_compare(&p, "warnock:surround=sides", sides, false),
     "surround tests by sides");
  ok(&tap, hand_compare(&p, "warnock:surround=crossings", crossings, false),
     "surround tests by crossings");
  ok(&tap, hand_compare(&p, "warnock:surround=angles", angles, false),
     "surround tests by angles");
  hand_close(&p);
  return finish(&tap);
}
