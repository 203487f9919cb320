/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes whose counts can be derived by hand: faces whose corners are given in
 * pixels of the picture, each with a depth. See hand.h. */
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

#endif
