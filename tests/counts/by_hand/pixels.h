/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes whose counts can be derived by hand: faces whose corners are given in
 * pixels of the picture, each with a depth; two of them, which several tests
 * draw. See hand.h. */
#ifndef HSR_TESTS_COUNTS_PIXELS_H
#define HSR_TESTS_COUNTS_PIXELS_H

#include "tests/counts/by_hand/hand.h"

struct pixel_face {
  int n; /* corners */
  struct hand_vertex corner[4];
};

/* A rectangle at one depth: left, then right edge, clockwise from the upper
 * left corner. */
#define PIXEL_RECTANGLE(x0, y0, x1, y1, depth)                                 \
  {                                                                            \
    4, {                                                                       \
      {x0, y0, depth}, {x1, y0, depth}, {x1, y1, depth}, {                     \
        x0, y1, depth                                                          \
      }                                                                        \
    }                                                                          \
  }

/* A is far, B and C are near. Rows 1 to 5, columns:
 *  1   A 2-12
 *  2   A 2-12, B 6-9
 *  3   A 2-12, B 6-9, C 10-14
 *  4   A 2-12,        C 10-14
 *  5                  C 10-14 */
static const struct pixel_face deck[] = {PIXEL_RECTANGLE(2, 1, 12, 5, 8),
                                         PIXEL_RECTANGLE(6, 2, 9, 4, 4),
                                         PIXEL_RECTANGLE(10, 3, 14, 6, 4)};

/* On row 3 both have the columns 4-12. With q = 1/depth in units of 1/128, S
 * has q = 8 + (x - 4) at x, and P has 13 everywhere: S comes to the front at x
 * = 9. Column c is at x = c + 0.5. */
static const struct pixel_face crossing[] = {
    {4, {{4, 3, 16}, {12, 3, 8}, {12, 4, 8}, {4, 4, 16}}},
    PIXEL_RECTANGLE(4, 3, 12, 4, 128.0 / 13)};

/* A is far, 2-12, and B near, 4-8, both on rows 1 to 6. */
static const struct pixel_face columns[] = {PIXEL_RECTANGLE(2, 1, 12, 7, 8),
                                            PIXEL_RECTANGLE(4, 1, 8, 7, 4)};

/* `crossing` on rows 1 to 6. */
static const struct pixel_face ridge[] = {
    {4, {{4, 1, 16}, {12, 1, 8}, {12, 7, 8}, {4, 7, 16}}},
    PIXEL_RECTANGLE(4, 1, 12, 7, 128.0 / 13)};

/* H is far, 1-6, and F near, 3-10, both on rows 1 and 2. */
static const struct pixel_face hidden_end[] = {PIXEL_RECTANGLE(1, 1, 6, 3, 8),
                                               PIXEL_RECTANGLE(3, 1, 10, 3, 4)};

static inline void pixel_open(struct hand_picture *p,
                              const struct pixel_face *face, int n_faces, int m,
                              int n) {
  p->scene = hsr_scene_new("by hand");
  struct hsr_object *object = hsr_scene_object(p->scene, "faces");
  for (int f = 0; f < n_faces; f++) {
    uint32_t v[4];
    for (int k = 0; k < face[f].n; k++)
      v[k] = hand_add(object, &face[f].corner[k], m, n);
    hsr_object_face(object, v, (size_t)face[f].n, NULL);
  }
  hand_finish(p, m, n);
}

/* Draws the faces in a picture of 16 x 8. Prints the counters that differ from
 * the derived values, or from 0 if they are not listed; true if there are none.
 */
static inline bool pixel_check(const char *name, const struct pixel_face *face,
                               int n_faces, const struct hand_count *derived) {
  struct hand_picture p;
  pixel_open(&p, face, n_faces, 16, 8);
  bool good = hand_compare(&p, name, derived, true);
  hand_close(&p);
  return good;
}

#endif
