/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The instances that move, in an octree of their own for one frame.
 *
 * Source      N. Greene, PhD thesis, UC Santa Cruz, 1995, 3.4: a dynamic octree
 *             of the same cubes as the static one, from scratch in every frame;
 *             whole, or divided only where it is found to be visible; instances
 *             by their bounding volumes.
 * Invariant   an instance is in the smallest cube so far that holds its bounds,
 *             or in the root. Those that do not fit into the root's cube are
 *             outside. */
#ifndef HSR_ALGORITHMS_MOVERS_H
#define HSR_ALGORITHMS_MOVERS_H

#include "algorithms/algorithm.h"
#include "algorithms/hierarchical/cubes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Compiled twice, as the algorithms are. */
#define hsr_movers_init HSR_OF_BUILD(hsr_movers_init)
#define hsr_movers_divide HSR_OF_BUILD(hsr_movers_divide)
#define hsr_movers_divide_all HSR_OF_BUILD(hsr_movers_divide_all)

#define HSR_NO_MOVER UINT32_MAX

struct hsr_mover {
  uint32_t instance, next; /* in the same cube; HSR_NO_MOVER ends */
  struct hsr_box bounds;
};

struct hsr_mover_node {
  uint32_t child[8], first; /* HSR_NO_NODE; HSR_NO_MOVER */
  bool divided;             /* what fits into octants is there */
};

struct hsr_movers {
  struct hsr_mover *mover;
  uint32_t n, outside; /* the first of those outside the root */
  struct hsr_growing node;
  struct hsr_tally *tally;
  int moved, splits; /* counters: an instance is moved from a cube to an octant;
                        a cube is divided */
  struct hsr_arena *arena;
};

/* All in the root, or outside. The counters are those of struct hsr_movers; the
 * arrays are the arena's. HSR_E_NOMEM. */
enum hsr_status hsr_movers_init(struct hsr_movers *movers,
                                const struct hsr_cubes *cubes,
                                struct hsr_tally *tally, int moved, int splits,
                                struct hsr_arena *arena);

/* A cube of the movers' octree as a subject. */
#define HSR_MOVERS_CUBE(node) HSR_CELL(node, HSR_NO_ID, 1)

static inline struct hsr_mover_node *
hsr_mover_node(const struct hsr_movers *movers, uint32_t k) {
  return (struct hsr_mover_node *)movers->node.items + k;
}

/* Divides a node, whose cube is given, if it is not yet. False for lack of
 * memory. */
bool hsr_movers_divide(struct hsr_movers *movers, uint32_t node,
                       const struct hsr_octree_node *cube);

/* And all nodes below. */
bool hsr_movers_divide_all(struct hsr_movers *movers, uint32_t node,
                           const struct hsr_octree_node *cube);

#ifdef __cplusplus
}
#endif
#endif
