/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene as plain faces, with the same ids. It has no instances that are moved,
 * and one object for each run of faces that are all one-sided, or all not. */
#ifndef HSR_BENCH_SUITE_FLAT_H
#define HSR_BENCH_SUITE_FLAT_H

#include "common/scene/world.h"

/* Makes the same faces, with the vertices of the world. *flat is the caller's
 * to delete, also after a failure; it has no views, and is not finished.
 * HSR_E_NOMEM. */
enum hsr_status flat_make(const struct hsr_world *world,
                          struct hsr_scene **flat, struct hsr_error *err);

/* Triangles, and the faces that they are of. */
struct flat_triangles {
  uint32_t n;
  uint32_t *of;              /* n: the face of each, ascending */
  struct hsr_scene *rounded; /* those that have an area, with coordinates that
                                are floats; NULL if that is the same as the
                                scene: it has triangles alone, and floats */
  uint32_t *of_rounded;      /* the face of each of these */
  uint32_t n_without_area;
};

/* Divides faces into triangles, as hsr_scene_write_glb does with a flat scene.
 * To be freed also after a failure. HSR_E_NOMEM; HSR_E_REFUSED if a face cannot
 * be divided. */
enum hsr_status flat_triangulate(const struct hsr_world *world,
                                 struct flat_triangles *triangles,
                                 struct hsr_error *err);
void flat_free(struct flat_triangles *triangles);

#endif
