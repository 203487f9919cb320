/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The instances that move, in an octree of their own.
 *
 * Source      N. Greene, PhD thesis, UC Santa Cruz, 1995, 3.4: a dynamic octree
 *             of the same cubes as the static one, from scratch in every frame;
 *             whole, or divided only where it is found to be visible; or kept
 *             from frame to frame, and brought up to date; instances by their
 *             bounding volumes, which may hold them for some frames, or for
 *             all.
 * Invariant   an instance is in the smallest cube so far that holds its bounds,
 *             or in the root. Those that do not fit into the root's cube are
 *             outside. A tree that is kept may have larger cubes than a new
 *             one, where an instance moved into an octant of its cube. */
#ifndef HSR_ALGORITHMS_MOVERS_H
#define HSR_ALGORITHMS_MOVERS_H

#include "algorithms/algorithm.h"
#include "algorithms/engines/cubes/cubes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What hzbuffer-moving counts. */
enum {
  HSR_MOVERS_DOWN, /* an instance is moved from a cube to an octant */
  HSR_MOVERS_SPLITS,
  HSR_MOVERS_LOOKED_AT, /* an instance that was in its cube: it stayed or left */
  HSR_MOVERS_MET,
  HSR_MOVERS_BOUNDED,
  HSR_MOVERS_SPLITS_IN_TIME
};

#define HSR_NO_MOVER UINT32_MAX

struct hsr_mover {
  uint32_t instance, next; /* in the same cube; HSR_NO_MOVER ends */
  struct hsr_box bounds;
  uint32_t node; /* in a tree that is kept; HSR_NO_NODE: outside */
};

struct hsr_mover_node {
  uint32_t child[8], first; /* HSR_NO_NODE; HSR_NO_MOVER */
  bool divided;             /* what fits into octants is there */

  /* In a tree that is kept. */
  uint32_t parent, n_below; /* n_below: movers in it and its octants */
  struct hsr_octree_node cube;
};

/* What is made use of in a tree that is kept. Where it is not known of an
 * instance (common/scene/motion.h), that one is looked at in every frame. */
enum hsr_mover_knowledge {
  HSR_MOVERS_KNOW_NOTHING,
  HSR_MOVERS_KNOW_SPEED, /* put again every so many frames, in a box that holds
                            it for so long */
  HSR_MOVERS_KNOW_VOLUME /* put once, in the box that it never leaves */
};

struct hsr_movers {
  struct hsr_mover *mover;
  uint32_t n, outside; /* the first of those outside the root */
  bool is_kept;        /* from frame to frame */
  enum hsr_mover_knowledge knowledge;
  long every, frame; /* frames, and the last one */
  uint32_t n_known;  /* of the first ones enough is known */
  struct hsr_growing node;
  struct hsr_tally *tally;
  struct hsr_arena *arena;
};

/* All in the root, or outside. The arrays are the arena's. HSR_E_NOMEM. */
enum hsr_status hsr_movers_init(struct hsr_movers *movers,
                                const struct hsr_cubes *cubes,
                                struct hsr_tally *tally,
                                struct hsr_arena *arena);

/* Brings a tree up to date that is kept: all zero before the first frame, and
 * `arena` lasts as long. A mover stays where it is while its cube holds it;
 * else it goes up to one that does, and down again from there. ->knowledge and
 * ->every are to be set before the first frame, and then stay. HSR_E_NOMEM: the
 * tree is to be thrown away. */
enum hsr_status hsr_movers_update(struct hsr_movers *movers,
                                  const struct hsr_cubes *cubes,
                                  struct hsr_tally *tally,
                                  struct hsr_arena *arena);

/* A cube of the movers' octree as a subject. */
#define HSR_MOVERS_CUBE(node) HSR_CELL(node, HSR_NO_ID, 1)

static inline struct hsr_mover_node *
hsr_mover_node(const struct hsr_movers *movers, uint32_t k) {
  return (struct hsr_mover_node *)movers->node.items + k;
}

/* Octant o of a node; HSR_NO_NODE if nothing is in it. */
uint32_t hsr_mover_octant(const struct hsr_movers *movers, uint32_t node,
                          int o);

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
