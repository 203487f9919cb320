/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The instances that move, in an octree of their own.
 *
 * Source      N. Greene, PhD thesis, UC Santa Cruz, 1995, 3.4: a dynamic octree
 *             of the same cubes as the static one. It is made in every frame,
 *             whole, or divided only where it is found to be visible; or it is
 *             kept from frame to frame and brought up to date. Instances are in
 *             it by their bounding volumes, which may hold them for some
 *             frames, or for all.
 * Invariant   the cube in which an instance is holds its bounds. Of the cubes
 *             that are made it was the smallest one when the instance was put
 *             there. Instances that do not fit into the root's cube are
 *             outside. */
#ifndef HSR_ALGORITHMS_MOVERS_H
#define HSR_ALGORITHMS_MOVERS_H

#include "algorithms/algorithm.h"
#include "algorithms/engines/cubes/cubes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What hzbuffer-moving counts; hzbuffer_moving.c has their meanings. */
enum {
  HSR_MOVERS_DOWN,
  HSR_MOVERS_SPLITS,
  HSR_MOVERS_LOOKED_AT,
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
  bool divided;             /* what fits into octants is in them */

  /* In a tree that is kept. */
  uint32_t parent, n_below; /* n_below: movers in it and its octants */
  struct hsr_octree_node cube;
};

/* What is known beforehand of how instances move (common/scene/motion.h), for a
 * tree that is kept. An instance of which it is not known is looked at in every
 * frame. */
enum hsr_mover_knowledge {
  HSR_MOVERS_KNOW_NOTHING,
  HSR_MOVERS_KNOW_SPEED, /* it is looked at every `every` frames, and is in the
                            tree with a box that holds it for so long */
  HSR_MOVERS_KNOW_VOLUME /* it is looked at once, and is in the tree with the
                            box that it never leaves */
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

/* Brings a tree that is kept up to date. It is all zero before the first frame,
 * and `arena` lasts as long as it does. A mover stays where it is while its
 * cube holds it. Otherwise it goes up to a cube that does, and down again.
 * ->knowledge and ->every are set before the first frame, and do not change.
 * HSR_E_NOMEM: the tree cannot be used any more. */
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

/* Divides a node, whose cube is given, if it is not divided yet. False for lack
 * of memory. */
bool hsr_movers_divide(struct hsr_movers *movers, uint32_t node,
                       const struct hsr_octree_node *cube);

/* The same of a node and of all nodes below it. */
bool hsr_movers_divide_all(struct hsr_movers *movers, uint32_t node,
                           const struct hsr_octree_node *cube);

#ifdef __cplusplus
}
#endif
#endif
