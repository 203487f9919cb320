/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which solid of a scene each voxel is in.
 *
 * Solids      closed and connected (common/lines/volumes.h); those that are not
 *             convex are tiled part by part, and as their parts only touch, no
 *             voxel is in two of them.
 * Numbers     from 1 on, in the order of their first faces. They are tiled in
 *             that order: where solids overlap, the first has the voxel. */
#ifndef HSR_COMMON_VOXEL_SOLIDS_H
#define HSR_COMMON_VOXEL_SOLIDS_H

#include "common/grids/voxels.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_voxel_solids {
  struct hsr_voxel_grid grid;
  uint32_t n_solids, n_volumes; /* what is tiled: convex solids, and parts */
  uint32_t *solid;              /* n[0] n[1] n[2], x fastest; 0: none */
  struct hsr_voxel_work work;
  size_t pyramid_bytes; /* all levels */
};

/* `most` voxels along the longest side of the world. To be freed also after a
 * failure. HSR_E_NOMEM; HSR_E_INPUT as hsr_voxel_grid_init; HSR_E_REFUSED with
 * the code HSR_CC and the face, where one is of no closed solid, or of one that
 * is too large to be divided. */
enum hsr_status hsr_voxel_solids_init(struct hsr_voxel_solids *answer,
                                      const struct hsr_volumes *volumes,
                                      int most, struct hsr_error *err);
void hsr_voxel_solids_free(struct hsr_voxel_solids *answer);

/* Voxels that are in a solid; and those of them of which one of the six next to
 * them is in another, or in none. */
void hsr_voxel_solids_count(const struct hsr_voxel_solids *answer,
                            uint64_t *set, uint64_t *surface);

static inline size_t hsr_voxel_number(const struct hsr_voxel_grid *grid, int x,
                                      int y, int z) {
  return ((size_t)z * (size_t)grid->n[1] + (size_t)y) * (size_t)grid->n[0] +
         (size_t)x;
}

#ifdef __cplusplus
}
#endif
#endif
