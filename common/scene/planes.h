/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The planes of a world's faces: for code that makes worlds. */
#ifndef HSR_COMMON_SCENE_PLANES_H
#define HSR_COMMON_SCENE_PLANES_H

#include "common/base/numbers.h"
#include "common/scene/world.h"

#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Newell's plane, summed vertex by vertex, with the first vertex as origin. All
 * zero before the first vertex. `previous` is relative to that origin, and so
 * are the terms of `sum`. `size` adds the absolute values of the terms of
 * `normal`; `reach` adds |first| and those of the terms of `sum`. */
struct hsr_newell {
  uint32_t n; /* vertices so far */
  double first[3], previous[3];
  double normal[3], size[3];
  double sum[3], reach[3];
};
void hsr_newell_add(struct hsr_newell *plane, const double v[3]);

/* A point of the plane: the mean of the vertices; for a triangle, the first. */
void hsr_newell_anchor(const struct hsr_newell *plane, double anchor[3]);

/* Whether the normal of a face is certainly not zero, by doubles. */
bool hsr_has_normal_for_certain(const struct hsr_loop *face);

/* The largest component of a face's normal, made positive. */
static inline double hsr_largest_normal(const struct hsr_mesh *mesh,
                                        uint32_t f) {
  return hsr_max(fabs(mesh->nx[f]),
                 hsr_max(fabs(mesh->ny[f]), fabs(mesh->nz[f])));
}

/* Finds which faces, whose planes are found, lie on equal ones. HSR_E_NOMEM. */
enum hsr_status hsr_world_classify_planes(struct hsr_world *world);

/* Finds the planes of all faces, which are laid out, and their plane classes.
 * Checks that every instance left its faces valid. HSR_E_NOMEM; HSR_E_INPUT as
 * hsr_world_init. */
enum hsr_status hsr_world_find_planes(struct hsr_world *world,
                                      struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
