/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pyramid of voxels, and tiling convex polyhedra into it.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 8: Warnock's subdivision in three dimensions, by
 *             listing 1. The paper proposes it, but does not report it built.
 * Notation    (C_c, C_v) -> struct hsr_triage of a cell; the finest level has
 *             C_c alone, a bit a voxel. (P_c, P_v), W and A as in listing 1.
 * Inside      A voxel is in a solid if its displaced centre is
 *             (docs/solid-voxels.md). So no centre lies on a plane, and solids
 *             that touch share no voxel and leave out none.
 * Order       any: a voxel belongs to the first volume that it is inside of
 * Invariant   In a cell that can be reached from the root by active subcells:
 *             C_c is set if and only if all voxels of the subcell that are in
 *             the grid are covered; C_v if and only if none is, and there are
 *             some. What is kept below a vacant subcell is stale until it is
 *             cleared, on entry; below a covered subcell it is stale for good.
 * Memory      1 bit a voxel, and 2 a subcell of every level above the finest,
 *             of cells that the grid meets. Of 4^n voxels a side, from 1 1/32
 *             bits a voxel for two levels to less than 1 2/63 for more.
 */
#ifndef HSR_ALGORITHMS_SOLID_PYRAMID_H
#define HSR_ALGORITHMS_SOLID_PYRAMID_H

#include "algorithms/algorithm.h"
#include "algorithms/volume/solid_triage.h"
#include "common/voxels/voxels.h"
#include "common/lines/volumes.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_SOLID_LEVELS = 5 /* 4^5 = HSR_VOXELS_MOST */ };

/* What tiling counts. As the subject of a step, cell number k of a level is
 * HSR_CELL(level, k, 0). Level 0 is the root; subcells of the last level are
 * the voxels. */
enum hsr_solid_counter {
  HSR_SOLID_CELL,    /* cells visited above the finest level */
  HSR_SOLID_FINEST,  /* cells visited of the finest level */
  HSR_SOLID_MASK,    /* masks of planes */
  HSR_SOLID_EXACT,   /* sides of voxels, decided exactly */
  HSR_SOLID_COVERED, /* masks that were written: struct hsr_voxel_cubes */
  HSR_SOLID_COUNTERS
};

/* One level of the pyramid. */
struct hsr_solid_level {
  int n[3];                  /* cells along x, y, z; x runs fastest */
  struct hsr_triage *coarse; /* by cell; NULL on the finest level */
  uint64_t *finest;          /* by cell; NULL on all other levels */

  /* Of the cell that is being visited: the planes that cross it; for each, the
   * subcells that are surely inside; and room for the planes of one subcell. */
  uint32_t n_active, *active, *list;
  uint64_t *inside;
};

struct hsr_solid_pyramid {
  struct hsr_voxel_grid grid;
  const struct hsr_volumes *volumes; /* borrowed */
  int n_levels; /* cells of level k have 4^(n_levels - k) voxels a side */
  size_t bytes; /* of all levels */
  struct hsr_solid_level level[HSR_SOLID_LEVELS]; /* [0] holds the root */

  /* Of the volume that is being tiled. */
  const struct hsr_cut *half_space;
  struct hsr_triage_plane *plane;
  uint32_t *all; /* 0, 1, ... */
  uint32_t solid;
  struct hsr_tally *tally;

  /* Set by the caller: gets all voxels that become covered, each once. The
   * cubes are borrowed for the call. */
  void (*cover)(void *context, const struct hsr_voxel_cubes *cubes);
  void *context;
};

/* Makes a pyramid of a grid, all of it vacant. `volumes` is borrowed as long as
 * *pyramid; memory is the arena's. HSR_E_NOMEM. */
enum hsr_status hsr_solid_pyramid_init(struct hsr_solid_pyramid *pyramid,
                                       const struct hsr_voxel_grid *grid,
                                       const struct hsr_volumes *volumes,
                                       struct hsr_arena *arena);

/* Tiles volume v, which belongs to solid number `solid`. Counts in *tally, as
 * enum hsr_solid_counter says; sets its out_of_memory if an exact predicate
 * failed. */
void hsr_solid_pyramid_tile(struct hsr_solid_pyramid *pyramid, uint32_t v,
                            uint32_t solid, struct hsr_tally *tally);

#ifdef __cplusplus
}
#endif
#endif
