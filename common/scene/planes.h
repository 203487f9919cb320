/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The planes of a world's faces: for those who make worlds. */
#ifndef HSR_COMMON_SCENE_PLANES_H
#define HSR_COMMON_SCENE_PLANES_H

#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Newell's plane, vertex by vertex; the first is the origin. */
struct hsr_newell {
  uint32_t n; /* vertices so far */
  double first[3], previous[3];
  double normal[3], size[3]; /* and the sum of what it is a sum of, positive */
  double sum[3], reach[3];   /* of the vertices; and the same */
};
void hsr_newell_add(struct hsr_newell *plane, const double v[3]);

/* A point of the plane: the mean of the vertices, or of a triangle the first. */
void hsr_newell_anchor(const struct hsr_newell *plane, double anchor[3]);

/* Finds the planes of all faces, which are laid out, and their classes; and
 * checks what an instance made of them. HSR_E_NOMEM; HSR_E_INPUT as
 * hsr_world_init. */
enum hsr_status hsr_world_find_planes(struct hsr_world *world,
                                      struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
