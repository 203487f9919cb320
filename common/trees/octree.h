/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Octrees: primitives in nested cubes.
 *
 * Source      N. Greene, "Hierarchical Rendering of Complex Environments", PhD
 *             thesis, UC Santa Cruz, 1995, 3.3.1 and 3.5.
 * Placement   a primitive that fits into an octant goes there. A primitive that
 *             crosses a median plane stays with the cube, which is the smallest
 *             that encloses it. But a small primitive that crosses a median
 *             plane goes into every octant that it meets.
 * Invariant   the cubes that a primitive is placed in cover it.
 * Ties        a primitive that lies in a median plane goes to the lower
 *             side. */
#ifndef HSR_COMMON_OCTREE_H
#define HSR_COMMON_OCTREE_H

#include "common/base/arena.h"
#include "common/trees/box.h"
#include "common/base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_NO_NODE UINT32_MAX

/* A box, by its centre and half of its sides. World units, as all lengths
 * here. */
struct hsr_octree_box {
  double centre[3], half[3];
};

struct hsr_octree_node {
  double centre[3], half;      /* the cube */
  struct hsr_octree_box tight; /* a box that holds the parts of its primitives,
                                  and of its octants', that are in the cube; the
                                  cube itself if there are none */
  uint32_t child[8]; /* nodes, or HSR_NO_NODE. Bit k of the octant's number is
                        set above centre[k] */
  uint32_t first, n; /* its primitives are item[first], ..., item[first+n-1] */
};

struct hsr_octree {
  struct hsr_octree_node *node; /* the first is the root. hsr_octree_init puts
                                   them in depth-first order, by ascending
                                   octant. hsr_octree_divide appends the octants
                                   of a cube */
  uint32_t *item;               /* numbers of primitives, node by node */
  uint32_t n_nodes, n_items;
};

/* What is put into cubes: primitives 0 .. n-1, described by functions that get
 * `context`. A primitive is connected, and `bounds` returns the smallest box
 * that holds it. `area` returns a number that is compared with the area of a
 * face of a cube. `meets` returns which of eight boxes the primitive meets, bit
 * o for box o; in doubt it may set a bit. If `meets` is NULL, they are the
 * boxes that meet its bounds. */
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
                     the area of a cube's face; 0: none is small */
  uint32_t most;  /* a cube of at most so many primitives is not divided */
  uint32_t least; /* an octant of fewer primitives is given up, and its parent
                     gets them */
};

/* Makes an octree. Its root is the cube with lower corner lo and edges of
 * length `side`, which must hold all primitives, apart from rounding. The
 * arrays are in the arena. `threads` threads make it, and all of them call the
 * primitives' functions. The result is the same for any number of threads.
 * HSR_E_NOMEM. */
enum hsr_status hsr_octree_init(struct hsr_octree *octree,
                                const struct hsr_primitives *primitives,
                                const struct hsr_octree_rule *rule,
                                const double lo[3], double side, int threads,
                                struct hsr_arena *arena);

/* --- A lazy octree -------------------------------------------------------- */

/* More about a node of a lazy octree. */
struct hsr_lazy_node {
  uint32_t first, n; /* its primitives from its parent: item[first], ... */
  double copies;     /* its subtree may hold each of them so many times, on the
                        average */
  int depth;         /* 0 of the root */
  bool divided;      /* hsr_octree_divide was called for it */
};

/* Lazy evaluation, section 3.4 of the thesis. At first all primitives are in a
 * root without octants. hsr_octree_divide divides a cube. When all cubes are
 * divided, the octree has the cubes of hsr_octree_init with the same
 * primitives, in another order. node[k].first and .n are the primitives that
 * node k got from its parent or, once it is divided, those that stay with it.
 * Tight boxes may be somewhat larger. */
struct hsr_lazy_octree {
  struct hsr_octree octree; /* as it is now; its arrays may move when a cube is
                               divided */
  struct hsr_primitives primitives;
  struct hsr_octree_rule rule;
  struct hsr_box *bounds; /* by primitive */
  double *area;           /* by primitive */
  uint32_t *mark;         /* by primitive: for hsr_octree_give_back */
  struct hsr_growing node, item, state; /* state: struct hsr_lazy_node */
  struct hsr_arena *arena;              /* borrowed */
};

/* Returns what is kept of node k. The pointer is valid until the next call of
 * hsr_octree_divide. */
static inline const struct hsr_lazy_node *
hsr_lazy_node(const struct hsr_lazy_octree *octree, uint32_t k) {
  return (const struct hsr_lazy_node *)octree->state.items + k;
}

/* Sets up a lazy octree: as hsr_octree_init, but the root is not divided.
 * *primitives and *rule are copied. The primitives' context and the arena are
 * borrowed and must outlive the octree. HSR_E_NOMEM. */
enum hsr_status hsr_octree_begin(struct hsr_lazy_octree *octree,
                                 const struct hsr_primitives *primitives,
                                 const struct hsr_octree_rule *rule,
                                 const double lo[3], double side,
                                 struct hsr_arena *arena);

/* Divides cube k, which must not be divided yet. It gets no octants if it holds
 * few primitives, or if that would not separate them. HSR_E_NOMEM. */
enum hsr_status hsr_octree_divide(struct hsr_lazy_octree *octree, uint32_t k);

/* --- Cubes ---------------------------------------------------------------- */

/* Returns the cube of a node, by its lowest and highest corner, rounded. */
static inline struct hsr_box hsr_cube_box(const struct hsr_octree_node *node) {
  struct hsr_box box;
  for (int k = 0; k < 3; k++) {
    box.lo[k] = node->centre[k] - node->half;
    box.hi[k] = node->centre[k] + node->half;
  }
  return box;
}

/* Whether the node has no octants. */
static inline bool hsr_octree_is_leaf(const struct hsr_octree_node *node) {
  for (int o = 0; o < 8; o++)
    if (node->child[o] != HSR_NO_NODE)
      return false;
  return true;
}

/* Returns the cube of a node, by its centre and half of its sides. */
static inline struct hsr_octree_box
hsr_octree_cube(const struct hsr_octree_node *node) {
  struct hsr_octree_box cube = {
      {node->centre[0], node->centre[1], node->centre[2]},
      {node->half, node->half, node->half}};
  return cube;
}

/* Returns octant `octant` of a cube, as a node with no octants and no
 * primitives. */
struct hsr_octree_node hsr_octree_octant(const struct hsr_octree_node *cube,
                                         int octant);

/* Returns the number of the octant that holds the box, which is within the
 * cube. -1: the box crosses a median plane. */
int hsr_octant_that_holds(const struct hsr_octree_node *cube,
                          const struct hsr_box *box);

/* The order of octants from front to back. For an eye in octant `nearest`, the
 * k-th octant is nearest ^ hsr_octant_order[k]. The nearest octant comes first,
 * then those that share a face with it, then those that share a face with the
 * farthest, then the farthest. */
extern const unsigned char hsr_octant_order[8];

#ifdef __cplusplus
}
#endif
#endif
