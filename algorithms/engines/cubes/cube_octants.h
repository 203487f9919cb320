/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The images of a cube's octants, all at once: each has a lane of the vector
 * unit. They are the images of hsr_cube_project, bit for bit. */
#ifndef HSR_ALGORITHMS_CUBE_OCTANTS_H
#define HSR_ALGORITHMS_CUBE_OCTANTS_H

#include "algorithms/engines/cubes/cube_frame.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_WHOLE_CUBE = 6, HSR_CUBE_PARTS }; /* six sides, and the whole */

/* Of octant o: part k covers samples [x0[k][o], x1[k][o]) of rows [y0[k][o],
 * y1[k][o]) of the window at most, none if that is empty, and no q on it is
 * more than q[k][o]. */
struct hsr_octants {
  int x0[HSR_CUBE_PARTS][8], y0[HSR_CUBE_PARTS][8], x1[HSR_CUBE_PARTS][8],
      y1[HSR_CUBE_PARTS][8];
  float q[HSR_CUBE_PARTS][8];
  int has_image[8]; /* as hsr_cube_project returns */
  int front[8];     /* as in hsr_cube_image */
};

/* In perspective. Octants that the node lacks get an image of no use. `tight`:
 * the boxes within the cubes, instead of the cubes. */
void hsr_octants_project(const struct hsr_cube_frame *frame,
                         const struct hsr_placing *placing,
                         const struct hsr_octree *octree,
                         const struct hsr_octree_node *node, bool tight,
                         struct hsr_octants *octants);

/* Part k of octant o: false if it covers no sample. */
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
