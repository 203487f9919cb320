/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grids of cubic voxels, and the solid of a scene that each voxel is in.
 * docs/solid-voxels.md has the definition. */
#ifndef HSR_COMMON_VOXELS_VOXELS_H
#define HSR_COMMON_VOXELS_VOXELS_H

#include "common/base/status.h"
#include "common/scene/world.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* --- The grid ------------------------------------------------------------- */

#define HSR_VOXELS_MOST 1024 /* along an axis */

/* n[0] x n[1] x n[2] cubes of side `size`. The lowest corner of the first one
 * is `lo`. World units. */
struct hsr_voxel_grid {
  double lo[3], size;
  int n[3];
};

/* Sets *grid to the grid around the faces of a world that is laid out, with
 * `most` voxels, 1 to HSR_VOXELS_MOST, along the longest side of their bounding
 * box. HSR_E_INPUT if the box is too small. */
enum hsr_status hsr_voxel_grid_init(struct hsr_voxel_grid *grid,
                                    const struct hsr_world *world, int most,
                                    struct hsr_error *err);

/* Whether two grids have the same voxels. */
bool hsr_same_voxel_grid(const struct hsr_voxel_grid *a,
                         const struct hsr_voxel_grid *b);

/* Returns the coordinate, along an axis, of the centres of voxels with index k
 * on that axis. */
static inline double hsr_voxel_centre(const struct hsr_voxel_grid *grid,
                                      int axis, int k) {
  return grid->lo[axis] + (k + 0.5) * grid->size;
}

/* Returns the number of voxel (x, y, z): x runs fastest, z slowest. */
static inline size_t hsr_voxel_number(const struct hsr_voxel_grid *grid, int x,
                                      int y, int z) {
  return ((size_t)z * (size_t)grid->n[1] + (size_t)y) * (size_t)grid->n[0] +
         (size_t)x;
}

/* Returns the number of voxels of a grid. */
static inline size_t hsr_voxel_count(const struct hsr_voxel_grid *grid) {
  return (size_t)grid->n[0] * (size_t)grid->n[1] * (size_t)grid->n[2];
}

/* --- Solids in voxels ----------------------------------------------------- */

/* Some voxels that are in one solid. There are 4 x 4 x 4 cubes of size^3 voxels
 * each. `corner` has the indices of the first voxel of the first cube. Bit 16 z
 * + 4 y + x of `mask` is set for the cubes that are in the solid. Cubes may
 * reach beyond the ends of the grid, but not before its beginning. */
struct hsr_voxel_cubes {
  const struct hsr_voxel_grid *grid; /* borrowed */
  uint32_t solid;                    /* from 1 */
  int corner[3], size;
  uint64_t mask;
};

/* The solid of each voxel. All zero before hsr_solid_voxels_open. It owns its
 * array. */
struct hsr_solid_voxels {
  struct hsr_voxel_grid grid;
  uint32_t *solid; /* by hsr_voxel_number: its solid, from 1; 0: none. NULL: not
                      opened */
};

/* Sets the grid, with no voxel in a solid. The array is used again if the grid
 * is the same as before. HSR_E_NOMEM. */
enum hsr_status hsr_solid_voxels_open(struct hsr_solid_voxels *voxels,
                                      const struct hsr_voxel_grid *grid);

/* Frees the array. *voxels may be opened again. */
void hsr_solid_voxels_free(struct hsr_solid_voxels *voxels);

/* Puts voxels into their solid. The grid is that of *voxels. */
void hsr_solid_voxels_put(struct hsr_solid_voxels *voxels,
                          const struct hsr_voxel_cubes *cubes);

/* Counts voxels. *set becomes the number of voxels that are in a solid.
 * *surface becomes the number of those at a surface: one of the six voxels next
 * to it is in another solid, in none, or outside of the grid. */
void hsr_solid_voxels_count(const struct hsr_solid_voxels *voxels,
                            uint64_t *set, uint64_t *surface);

#ifdef __cplusplus
}
#endif
#endif
