/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Octrees: primitives in nested cubes.
 *
 * Source      N. Greene, "Hierarchical Rendering of Complex Environments", PhD
 *             thesis, UC Santa Cruz, 1995, 3.3.1 and 3.5.
 * Placement   a primitive that fits into an octant goes there. One that crosses
 *             a median plane stays with the cube, the smallest that encloses
 *             it; but a small one goes into every octant that it meets.
 * Invariant   the cubes that a primitive is placed in cover it.
 * Ties        a primitive on a median plane fits into either side; it goes to
 *             the lower one. */
#ifndef HSR_COMMON_OCTREE_H
#define HSR_COMMON_OCTREE_H

#include "common/base/arena.h"
#include "common/trees/box.h"
#include "common/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_NO_NODE UINT32_MAX

/* A box by its middle. */
struct hsr_octree_box {
  double centre[3], half[3];
};

struct hsr_octree_node {
  double centre[3], half;      /* the cube */
  struct hsr_octree_box tight; /* within the cube; holds all that is in it and
                                  its octants; the cube, if that is nothing */
  uint32_t child[8]; /* bit k of the octant's number: above centre[k] */
  uint32_t first, n; /* its primitives: item[first] and so on */
};

struct hsr_octree {
  struct hsr_octree_node *node; /* the first is the root; parents before
                                   children, and each before all that is in the
                                   next octant, unless it is divided bit by
                                   bit */
  uint32_t *item;               /* numbers of primitives, node by node */
  uint32_t n_nodes, n_items;
};

/* What is put into cubes: primitives 0 .. n-1, through functions that get
 * `context`. Each is connected, and `bounds` is the smallest box that holds it.
 * `area` is compared with the area of a face of a cube. `meets` tells which of
 * eight boxes it meets, bit o for box o, and may say yes in doubt; NULL: those
 * that its bounds meet. */
struct hsr_primitives {
  uint32_t n;
  const void *context;
  struct hsr_box (*bounds)(const void *context, uint32_t k);
  double (*area)(const void *context, uint32_t k);
  unsigned (*meets)(const void *context, uint32_t k,
                    const struct hsr_eight_boxes *boxes);
};

struct hsr_octree_rule {
  double small;   /* a primitive is small if its area is less than this times
                     the area of a cube's face; 0: none is */
  uint32_t most;  /* a cube of no more primitives is not divided */
  uint32_t least; /* an octant of fewer gives them back to its parent */
};

/* The cube with lower corner lo and edges of length `side` must hold all
 * primitives. The arrays are in the arena. So many threads make it, all of
 * which call the primitives' functions; it is the same for any number.
 * HSR_E_NOMEM. */
enum hsr_status hsr_octree_init(struct hsr_octree *octree,
                                const struct hsr_primitives *primitives,
                                const struct hsr_octree_rule *rule,
                                const double lo[3], double side, int threads,
                                struct hsr_arena *arena);

/* --- An octree that is divided bit by bit ---------------------------------- */

/* What is kept of a node of it. */
struct hsr_lazy_node {
  uint32_t first, n; /* what was handed down to it: item[first] and so on */
  double copies;     /* it may make so many times as many of them, in all */
  int depth;
  bool divided;
};

/* Lazy evaluation, thesis 3.4: all primitives are in a root without octants,
 * and a cube is divided when that is asked for. If all are, it has the cubes of
 * hsr_octree_init, and their primitives, in another order. What a cube holds is
 * octree.node[k].first and .n: all that was handed down to it, or what is its
 * own once it is divided. Tight boxes may be somewhat larger. */
struct hsr_lazy_octree {
  struct hsr_octree octree; /* so far; its arrays move when a cube is divided */
  struct hsr_primitives primitives;
  struct hsr_octree_rule rule;
  struct hsr_box *bounds; /* a primitive */
  double *area;
  uint32_t *mark;
  struct hsr_growing node, item, state;
  struct hsr_arena *arena;
};

static inline const struct hsr_lazy_node *
hsr_lazy_node(const struct hsr_lazy_octree *octree, uint32_t k) {
  return (const struct hsr_lazy_node *)octree->state.items + k;
}

/* As hsr_octree_init, but the root is not divided. The primitives' context is
 * borrowed. HSR_E_NOMEM. */
enum hsr_status hsr_octree_begin(struct hsr_lazy_octree *octree,
                                 const struct hsr_primitives *primitives,
                                 const struct hsr_octree_rule *rule,
                                 const double lo[3], double side,
                                 struct hsr_arena *arena);

/* Divides a cube that is not divided yet. It gets no octants if it holds few
 * primitives, or if dividing does not help. HSR_E_NOMEM. */
enum hsr_status hsr_octree_divide(struct hsr_lazy_octree *octree, uint32_t k);

static inline struct hsr_box hsr_cube_box(const struct hsr_octree_node *node) {
  struct hsr_box box;
  for (int k = 0; k < 3; k++) {
    box.lo[k] = node->centre[k] - node->half;
    box.hi[k] = node->centre[k] + node->half;
  }
  return box;
}

/* Has the node no octants? */
static inline bool hsr_octree_is_leaf(const struct hsr_octree_node *node) {
  for (int o = 0; o < 8; o++)
    if (node->child[o] != HSR_NO_NODE)
      return false;
  return true;
}

static inline struct hsr_octree_box
hsr_octree_cube(const struct hsr_octree_node *node) {
  struct hsr_octree_box cube = {
      {node->centre[0], node->centre[1], node->centre[2]},
      {node->half, node->half, node->half}};
  return cube;
}

/* One octant of a cube, as a node with no octants and no primitives. */
struct hsr_octree_node hsr_octree_octant(const struct hsr_octree_node *cube,
                                         int octant);

/* The octant that holds the box, which is within the cube; -1: the box crosses
 * a median plane. */
int hsr_octant_that_holds(const struct hsr_octree_node *cube,
                          const struct hsr_box *box);

/* The order of octants from front to back, for an eye in octant `nearest`:
 * octant nearest ^ hsr_octant_order[0], then [1], and so on. First comes the
 * nearest one, then those that share a face with it, then those that share a
 * face with the farthest, then the farthest. */
extern const unsigned char hsr_octant_order[8];

#ifdef __cplusplus
}
#endif
#endif
