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

/* The sums of Newell's plane (Sutherland et al. 1974, eq. 6), with the first
 * vertex as origin. d is a vertex minus the first one. World units. All zero
 * before the first vertex. */
struct hsr_newell {
  uint32_t n;                   /* vertices so far */
  double first[3], previous[3]; /* the first vertex; d of the last one */
  double normal[3], size[3];    /* the sum of the terms of the normal, and the
                                   sum of their absolute values */
  double sum[3], reach[3];      /* the sum of d; |first| plus the sum of |d| */
};

/* Adds the next vertex of the polygon. */
void hsr_newell_add(struct hsr_newell *plane, const double v[3]);

/* Writes a point of the plane: the mean of the vertices or, of a triangle, the
 * first vertex. */
void hsr_newell_anchor(const struct hsr_newell *plane, double anchor[3]);

/* Whether arithmetic in doubles proves that the normal of a face is not zero.
 * False says nothing. */
bool hsr_has_normal_for_certain(const struct hsr_loop *face);

/* Returns the greatest absolute value of a component of the normal of face f,
 * as stored in the mesh. */
static inline double hsr_largest_normal(const struct hsr_mesh *mesh,
                                        uint32_t f) {
  return hsr_max(fabs(mesh->nx[f]),
                 hsr_max(fabs(mesh->ny[f]), fabs(mesh->nz[f])));
}

/* Sets the plane class of every face, and n_planes. The planes must be found
 * already. HSR_E_NOMEM. */
enum hsr_status hsr_world_classify_planes(struct hsr_world *world);

/* Finds the planes and plane classes of all faces, which must be laid out, and
 * checks that the faces of every instance are valid. HSR_E_NOMEM; HSR_E_INPUT
 * as hsr_world_init. */
enum hsr_status hsr_world_find_planes(struct hsr_world *world,
                                      struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
