/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The counts of both z-buffers, derived by hand from Sutherland et al. 1974,
 * appendix B; and those of the fast one from the tiler's rule for what floats can
 * hold. */
#include "tests/counts/by_hand/pixels.h"

enum { M = 16, N = 8 };

/* A is far, B is near, and C falls off steeply to the left; each has an upright
 * edge on the left:
 *  row   A       B      C
 *  1     2-13
 *  2     2-11    4-9
 *  3     2-9     4-7
 *  4     2-7     4-5    10-14
 *  5     2-5            10-13
 *  6     2-3            10-12
 *  7                    10-11 */
static const struct pixel_face triangles[] = {
    {3, {{2, 1, 8}, {14, 1, 8}, {2, 7, 8}}},
    {3, {{4, 2, 4}, {10, 2, 4}, {4, 5, 4}}},
    {3, {{10, 4, 16}, {15, 4, 2}, {10, 8, 16}}}};

/* Samples: A 11 + 9 + 7 + 5 + 3 + 1 = 36, B 5 + 3 + 1 = 9, C 4 + 3 + 2 + 1 =
 * 10. Each is a depth test, against the background or, for B, against A. All
 * find the face nearer: 55 writes, 9 of which are B's over A. */
static const struct hand_count derived[] = {{"depth tests", 55},
                                            {"depth tests", 55, "nearer"},
                                            {"writes", 55},
                                            {"overwrites", 9},
                                            {NULL}};

/* A and B are tiled in floats. C has 1/t from 1/16 to 1/2. This range is longer
 * than its lower end, so C goes the general way. All edges keep a distance from
 * the samples, and 1/t of A and B differ by a factor of two. */
static const struct hand_count fast[] = {{"depth tests", 55},
                                         {"depth tests", 55, "nearer"},
                                         {"writes", 55},
                                         {"overwrites", 9},
                                         {"fast triangles", 2},
                                         {"general faces", 1},
                                         {NULL}};

/* The three are one group. They have two sides, so none turns away, and the group
 * is in the picture. */
static const struct hand_count grouped[] = {
    {"groups tested", 1}, {"groups tested", 1, "kept"}, {"groups away", 0},
    {"groups out", 0},    {"triangles left out", 0},    {"depth tests", 55},
    {"writes", 55},       {"fast triangles", 2},        {NULL}};

int main(void) {
  struct tap tap = plan(3);
  struct hand_picture p;
  pixel_open(&p, triangles, 3, M, N);
  ok(&tap, hand_compare(&p, "zbuffer", derived, true), "three triangles");
  ok(&tap, hand_compare(&p, "zbuffer-fast", fast, true), "the same, fast");
  ok(&tap, hand_compare(&p, "zbuffer-fast:groups=cones", grouped, false),
     "the same in a group");
  hand_close(&p);
  return finish(&tap);
}
