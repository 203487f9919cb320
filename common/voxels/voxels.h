/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grids of cubic voxels, and which solid of a scene each voxel is in:
 * docs/solid-voxels.md. */
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

/* n[0] x n[1] x n[2] cubes of side `size`; the first one has its lowest corner
 * at `lo`. Units of the world. */
struct hsr_voxel_grid {
  double lo[3], size;
  int n[3];
};

/* The grid around the faces of a world that is laid out: `most` voxels along
 * the longest side of their box, 1 to HSR_VOXELS_MOST. HSR_E_INPUT: the box is
 * too small. */
enum hsr_status hsr_voxel_grid_init(struct hsr_voxel_grid *grid,
                                    const struct hsr_world *world, int most,
                                    struct hsr_error *err);

/* Whether two grids have the same voxels. */
bool hsr_same_voxel_grid(const struct hsr_voxel_grid *a,
                         const struct hsr_voxel_grid *b);

/* Coordinate of the centres of the k-th voxels along an axis. */
static inline double hsr_voxel_centre(const struct hsr_voxel_grid *grid,
                                      int axis, int k) {
  return grid->lo[axis] + (k + 0.5) * grid->size;
}

static inline size_t hsr_voxel_number(const struct hsr_voxel_grid *grid, int x,
                                      int y, int z) {
  return ((size_t)z * (size_t)grid->n[1] + (size_t)y) * (size_t)grid->n[0] +
         (size_t)x;
}

static inline size_t hsr_voxel_count(const struct hsr_voxel_grid *grid) {
  return (size_t)grid->n[0] * (size_t)grid->n[1] * (size_t)grid->n[2];
}

/* --- Solids in voxels ----------------------------------------------------- */

/* Some voxels that are in one solid: of the 4 x 4 x 4 cubes of size^3 voxels
 * from `corner` on, those of `mask`; bit 16 z + 4 y + x. Cubes may end outside
 * of the grid. */
struct hsr_voxel_cubes {
  const struct hsr_voxel_grid *grid; /* borrowed */
  uint32_t solid;                    /* from 1 */
  int corner[3], size;
  uint64_t mask;
};

/* The solid of each voxel. All zero before it is opened. */
struct hsr_solid_voxels {
  struct hsr_voxel_grid grid;
  uint32_t *solid; /* by hsr_voxel_number; 0: none. NULL: not opened */
};

/* Takes a grid, of which no voxel is in a solid yet. Keeps its memory if it had
 * that grid before. HSR_E_NOMEM. */
enum hsr_status hsr_solid_voxels_open(struct hsr_solid_voxels *voxels,
                                      const struct hsr_voxel_grid *grid);
void hsr_solid_voxels_free(struct hsr_solid_voxels *voxels);

/* Puts voxels into their solid. */
void hsr_solid_voxels_put(struct hsr_solid_voxels *voxels,
                          const struct hsr_voxel_cubes *cubes);

/* Counts the voxels that are in a solid; and those of them that are at a
 * surface: one of the six voxels next to it is in another solid, in none, or
 * outside of the grid. */
void hsr_solid_voxels_count(const struct hsr_solid_voxels *voxels,
                            uint64_t *set, uint64_t *surface);

#ifdef __cplusplus
}
#endif
#endif
