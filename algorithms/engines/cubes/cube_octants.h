/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The images of the eight octants of a cube, computed together: each octant has
 * a lane of the vector unit. They equal those of hsr_cube_project, bit for
 * bit. */
#ifndef HSR_ALGORITHMS_CUBE_OCTANTS_H
#define HSR_ALGORITHMS_CUBE_OCTANTS_H

#include "algorithms/engines/cubes/cube_frame.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_WHOLE_CUBE = 6, HSR_CUBE_PARTS }; /* six sides, and the whole */

/* Of octant o, part k (a side, or the whole) covers at most the samples
 * [x0[k][o], x1[k][o]) of the rows [y0[k][o], y1[k][o]) of the window; none if
 * that is empty. No q on the part is more than q[k][o]. */
struct hsr_octants {
  int x0[HSR_CUBE_PARTS][8], y0[HSR_CUBE_PARTS][8], x1[HSR_CUBE_PARTS][8],
      y1[HSR_CUBE_PARTS][8];
  float q[HSR_CUBE_PARTS][8];
  int has_image[8]; /* as hsr_cube_project returns */
  int front[8];     /* as in hsr_cube_image */
};

/* Fills *octants for the octants of a node. In perspective only. What is filled
 * in for an octant that the node does not have is of no use. `tight`: of the
 * boxes of the octants' contents instead of their cubes. */
void hsr_octants_project(const struct hsr_cube_frame *frame,
                         const struct hsr_placing *placing,
                         const struct hsr_octree *octree,
                         const struct hsr_octree_node *node, bool tight,
                         struct hsr_octants *octants);

/* The samples that part k of octant o may cover. False if there are none. */
static inline bool hsr_octant_bounds(const struct hsr_octants *octants, int k,
                                     int o, struct hsr_bounds *bounds) {
  *bounds = (struct hsr_bounds){octants->x0[k][o], octants->y0[k][o],
                                octants->x1[k][o], octants->y1[k][o]};
  return bounds->x0 < bounds->x1 && bounds->y0 < bounds->y1;
}

#ifdef __cplusplus
}
#endif
#endif
