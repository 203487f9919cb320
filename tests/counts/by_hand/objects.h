/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes whose counts can be derived by hand: objects whose vertices are given
 * in pixels of a picture of 16 x 8, each with a depth. See hand.h. */
#ifndef HSR_TESTS_COUNTS_OBJECTS_H
#define HSR_TESTS_COUNTS_OBJECTS_H

#include "tests/counts/by_hand/hand.h"

enum { OBJECTS_M = 16, OBJECTS_N = 8 };

struct hand_face {
  int n;
  int vertex[4]; /* of its object */
};

struct hand_object {
  int n_vertices, n_faces;
  struct hand_vertex vertex[8];
  struct hand_face face[6];
};

/* An object that is one rectangle, at one depth on its left and at another on
 * its right. Its vertices are numbered clockwise from the upper left corner. */
#define HAND_SLANT(x0, y0, x1, y1, left, right)                                \
  {                                                                            \
    4, 1, {{x0, y0, left}, {x1, y0, right}, {x1, y1, right}, {x0, y1, left}},  \
    {                                                                          \
      {                                                                        \
        4, {                                                                   \
          0, 1, 2, 3                                                           \
        }                                                                      \
      }                                                                        \
    }                                                                          \
  }

/* The same at one depth. */
#define HAND_RECTANGLE(x0, y0, x1, y1, depth)                                  \
  HAND_SLANT(x0, y0, x1, y1, depth, depth)

static inline void hand_open(struct hand_picture *p,
                             const struct hand_object *object, int n) {
  p->scene = hsr_scene_new("by hand");
  for (int k = 0; k < n; k++) {
    struct hsr_object *made = hsr_scene_object(p->scene, "object");
    uint32_t v[8], corner[4];
    for (int i = 0; i < object[k].n_vertices; i++)
      v[i] = hand_add(made, &object[k].vertex[i], OBJECTS_M, OBJECTS_N);
    for (int f = 0; f < object[k].n_faces; f++) {
      const struct hand_face *face = &object[k].face[f];
      for (int i = 0; i < face->n; i++)
        corner[i] = v[face->vertex[i]];
      hsr_object_face(made, corner, (size_t)face->n, NULL);
    }
  }
  hand_finish(p, OBJECTS_M, OBJECTS_N);
}

/* Draws the objects. Prints the counters that differ from the derived values,
 * or from 0 if they are not listed; true if there are none. */
static inline bool hand_check(const char *name,
                              const struct hand_object *object, int n,
                              const struct hand_count *derived) {
  struct hand_picture p;
  hand_open(&p, object, n);
  bool good = hand_compare(&p, name, derived, true);
  hand_close(&p);
  return good;
}

#endif
