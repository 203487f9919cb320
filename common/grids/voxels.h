/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pyramid of voxels, and tiling convex polyhedra into it.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 8: Warnock's subdivision in three dimensions, by
 *             listing 1; what he thought possible and did not build.
 * Notation    (C_c, C_v) -> struct hsr_triage of a cell; the finest level has
 *             C_c alone, a bit a voxel. (P_c, P_v), W and A as in listing 1.
 * Inside      a voxel is in a solid if its centre, understood as displaced by
 *             (e, e^2, e^3), e infinitesimal, is inside. So no centre lies on a
 *             plane, and solids that touch share no voxel and leave out none.
 * Centres     are the doubles that hsr_voxel_centre computes.
 * Order       any: a voxel is given to the first that it is inside of.
 * Invariant   on every path of subcells that are active: C_c is set just where
 *             all voxels of the grid are covered, C_v just where none is and
 *             there are any. What lies below a vacant subcell is cleared when
 *             it is entered; below a covered one it is stale.
 * Memory      1 bit a voxel, and 2 a subcell of every level above the finest,
 *             of cells that the grid meets. Of 4^n voxels a side, from 1 1/32
 *             bits a voxel for two levels to less than 1 2/63 for more.
 */
#ifndef HSR_COMMON_VOXELS_H
#define HSR_COMMON_VOXELS_H

#include "common/grids/solid_triage.h"
#include "common/lines/volumes.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_VOXEL_LEVELS = 5, HSR_VOXELS_MOST = 1024 /* 4^5 */ };

/* n[0] x n[1] x n[2] cubes of side `size`, the first one's corner at `lo`. */
struct hsr_voxel_grid {
  double lo[3], size;
  int n[3];
};

/* The grid around a world, `most` voxels along its longest side. Refuses one
 * that has no such cubes: HSR_E_INPUT. */
enum hsr_status hsr_voxel_grid_init(struct hsr_voxel_grid *grid,
                                    const struct hsr_world *world, int most,
                                    struct hsr_error *err);

static inline double hsr_voxel_centre(const struct hsr_voxel_grid *grid,
                                      int axis, int k) {
  return grid->lo[axis] + (k + 0.5) * grid->size;
}

/* Who is told what has become covered: of the 4 x 4 x 4 cubes of size^3 voxels
 * from `corner` on, those of a mask; some of them may end outside the grid. */
struct hsr_voxel_sink {
  void (*cubes)(void *context, const int corner[3], int size, uint64_t mask);
  void *context;
};

struct hsr_voxel_work {
  uint64_t cells, finest; /* visited; those of the finest level */
  uint64_t masks;         /* of planes, computed */
  uint64_t exact;         /* sides of voxels left to the exact predicates */
};

/* One level of the pyramid. */
struct hsr_voxel_level {
  int n[3];                  /* cells along x, y, z; x is fastest */
  struct hsr_triage *coarse; /* NULL for the finest level, which has */
  uint64_t *finest;          /* these instead */

  /* Of the cell at hand: the planes that cross it, and the subcells that
   * each leaves surely inside; those of the subcell at hand. */
  uint32_t n_active, *active, *list;
  uint64_t *inside;
};

struct hsr_voxels {
  struct hsr_voxel_grid grid;
  const struct hsr_volumes *volumes; /* borrowed */
  int n_levels; /* cells of level k have 4^(n_levels - k) voxels a side */
  size_t pyramid_bytes;
  struct hsr_voxel_level level[HSR_VOXEL_LEVELS]; /* [0] holds the root */

  /* Of the volume at hand. */
  const struct hsr_half_space *half_space;
  struct hsr_triage_plane *plane;
  uint32_t *all; /* 0, 1, ... */

  struct hsr_voxel_work work;
  bool out_of_memory; /* an exact predicate has failed */
  struct hsr_arena arena;
};

/* An empty pyramid, for volumes, which are borrowed and outlive it. Freed with
 * hsr_voxels_free, also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_voxels_init(struct hsr_voxels *voxels,
                                const struct hsr_voxel_grid *grid,
                                const struct hsr_volumes *volumes,
                                struct hsr_error *err);
void hsr_voxels_free(struct hsr_voxels *voxels);

/* Tiles volume v of those. HSR_E_NOMEM. */
enum hsr_status hsr_voxels_tile(struct hsr_voxels *voxels, uint32_t v,
                                const struct hsr_voxel_sink *sink,
                                struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
