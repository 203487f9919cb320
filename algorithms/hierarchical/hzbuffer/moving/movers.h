/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The dynamic octree: the instances that move, in an octree of their own.
 *
 * Source      N. Greene, PhD thesis, UC Santa Cruz, 1995, 3.4: a dynamic octree
 *             of the same cubes as the static one.
 * Notation    dynamic primitive -> mover, an instance that moves. What is put
 *             into cubes is its bounding box in the world, `bounds`.
 * Ways        The octree is made anew in every frame: hsr_movers_init, then
 *             hsr_movers_divide_all, or lazily hsr_movers_divide for cubes that
 *             are found to be visible. Or it is kept from frame to frame:
 *             hsr_movers_update. Then the bounds of a mover may hold it for
 *             several frames, or for all.
 * Invariant   A mover's cube holds its bounds. When the mover was put there, no
 *             smaller cube of those made so far held them. A mover that does
 *             not fit into the root's cube is outside: in a list of its own. */
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
  uint32_t instance;
  uint32_t next; /* the next mover in the same cube; HSR_NO_MOVER: none */
  struct hsr_box bounds; /* in the world */
  uint32_t node; /* if the octree is kept: its cube; HSR_NO_NODE: outside */
};

struct hsr_mover_node {
  uint32_t child[8]; /* HSR_NO_NODE: there is none */
  uint32_t first;    /* the first mover of its list; HSR_NO_MOVER: none */
  bool divided;      /* movers that fit into an octant are in it */

  /* If the octree is kept. */
  uint32_t parent;  /* HSR_NO_NODE: the root */
  uint32_t n_below; /* movers in this cube and in all cubes in it */
  struct hsr_octree_node cube;
};

/* What of an instance's motion is used (common/scene/motion.h), if the octree
 * is kept. An instance of which that is not known is looked at in every frame:
 * is it still in its cube? */
enum hsr_mover_knowledge {
  HSR_MOVERS_KNOW_NOTHING,
  HSR_MOVERS_KNOW_SPEED, /* its greatest speed: it is looked at once in `every`
                            frames; its bounds hold it for so long */
  HSR_MOVERS_KNOW_VOLUME /* a box that it never leaves: that is its bounds, and
                            it is looked at once */
};

struct hsr_movers {
  struct hsr_mover *mover; /* n of them */
  uint32_t n;
  uint32_t outside; /* the first mover outside of the root's cube */
  bool is_kept;     /* the octree is kept from frame to frame */
  enum hsr_mover_knowledge knowledge;
  long every;       /* for HSR_MOVERS_KNOW_SPEED: a number of frames, from 1 */
  long frame;       /* the frame of the last update */
  uint32_t n_known; /* enough is known of mover[0 .. n_known) */
  struct hsr_growing node; /* struct hsr_mover_node; the first is the root */
  struct hsr_tally *tally;
  struct hsr_arena *arena;
};

/* Begins the octree of one frame: a root with all movers that fit into it, the
 * others outside. `cubes`, of the scene's present frame, and the tally are
 * borrowed as long as *movers; the arrays are the arena's. HSR_E_NOMEM. */
enum hsr_status hsr_movers_init(struct hsr_movers *movers,
                                const struct hsr_cubes *cubes,
                                struct hsr_tally *tally,
                                struct hsr_arena *arena);

/* Brings an octree that is kept to the scene's present frame. A mover stays in
 * its cube while that holds its bounds. Otherwise it goes up to a cube that
 * does, and down again. *movers is all zero before the first frame, but for
 * ->knowledge and ->every, which the caller sets and does not change. The arena
 * lasts as long as *movers. HSR_E_NOMEM: the octree cannot be used any more. */
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

/* Divides a node, if it is not divided yet: moves each mover that fits into an
 * octant down into it. A node with a single mover gets no octants. `cube` is
 * the node's own. False: out of memory. */
bool hsr_movers_divide(struct hsr_movers *movers, uint32_t node,
                       const struct hsr_octree_node *cube);

/* The same of a node and of all nodes below it. */
bool hsr_movers_divide_all(struct hsr_movers *movers, uint32_t node,
                           const struct hsr_octree_node *cube);

#ifdef __cplusplus
}
#endif
#endif
