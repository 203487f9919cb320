/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pyramid of voxels, and tiling convex polyhedra into it.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 8: Warnock's subdivision in three dimensions, by
 *             listing 1; what he thought possible and did not build.
 * Notation    (C_c, C_v) -> struct hsr_triage of a cell; the finest level has
 *             C_c alone, a bit a voxel. (P_c, P_v), W and A as in listing 1.
 * Inside      docs/solid-voxels.md: a voxel is in a solid if its displaced
 *             centre is. So no centre lies on a plane, and solids that touch
 *             share no voxel and leave out none.
 * Order       any: a voxel is given to the first volume that it is inside of.
 * Invariant   on every path of subcells that are active: C_c is set just where
 *             all voxels of the grid are covered, C_v just where none is and
 *             there are any. What lies below a vacant subcell is cleared when
 *             it is entered; below a covered one it is stale.
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

/* What tiling counts. In its events the cell numbered k of a level is
 * HSR_CELL(level, k, 0); level 0 is the root, and the last level the voxels. */
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
  int n[3];                  /* cells along x, y, z; x is fastest */
  struct hsr_triage *coarse; /* NULL for the finest level, which has */
  uint64_t *finest;          /* these instead */

  /* Of the cell in hand: the planes that cross it, and the subcells that each
   * leaves surely inside; and the planes of the subcell in hand. */
  uint32_t n_active, *active, *list;
  uint64_t *inside;
};

struct hsr_solid_pyramid {
  struct hsr_voxel_grid grid;
  const struct hsr_volumes *volumes; /* borrowed */
  int n_levels; /* cells of level k have 4^(n_levels - k) voxels a side */
  size_t bytes; /* of all levels */
  struct hsr_solid_level level[HSR_SOLID_LEVELS]; /* [0] holds the root */

  /* Of the volume in hand. */
  const struct hsr_half_space *half_space;
  struct hsr_triage_plane *plane;
  uint32_t *all; /* 0, 1, ... */
  uint32_t solid;
  struct hsr_tally *tally;

  /* Told of all voxels that become covered, each once. The cubes are borrowed
   * for the call. */
  void (*cover)(void *context, const struct hsr_voxel_cubes *cubes);
  void *context;
};

/* An empty pyramid. `volumes` and `arena`, from which its memory is taken, are
 * borrowed and outlive it. HSR_E_NOMEM. */
enum hsr_status hsr_solid_pyramid_init(struct hsr_solid_pyramid *pyramid,
                                       const struct hsr_voxel_grid *grid,
                                       const struct hsr_volumes *volumes,
                                       struct hsr_arena *arena);

/* Tiles volume v, which is of a solid of that number. Counts in *tally, from
 * its `first` on, as enum hsr_solid_counter says; sets its out_of_memory if an
 * exact predicate has failed. */
void hsr_solid_pyramid_tile(struct hsr_solid_pyramid *pyramid, uint32_t v,
                            uint32_t solid, struct hsr_tally *tally);

#ifdef __cplusplus
}
#endif
#endif
