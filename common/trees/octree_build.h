/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steps of making an octree, for octree.c, which has their code, and
 * octree_shared.c. */
#ifndef HSR_COMMON_OCTREE_BUILD_H
#define HSR_COMMON_OCTREE_BUILD_H

#include "common/trees/octree.h"

enum { HSR_OCTREE_DEEPEST = 32 }; /* levels below the root */

/* An octree may hold each primitive so many times, on the average. The limit is
 * for bundles of long slivers. Each division doubles their number, until cubes
 * are as small as the distance between two slivers. */
enum { HSR_OCTREE_COPIES = 64 };

/* Numbers of primitives. The memory is malloc'ed. */
struct hsr_octree_list {
  uint32_t *k;
  uint32_t n, room;
};

struct hsr_octree_builder {
  const struct hsr_primitives *primitives; /* borrowed */
  const struct hsr_octree_rule *rule;      /* borrowed */
  struct hsr_box *bounds;                  /* by primitive */
  double *area;                            /* by primitive */
  uint32_t *mark; /* by primitive: the stamp of the cube that it was last given
                     back to (hsr_octree_give_back) */
  struct hsr_growing node, item;
  struct hsr_arena *arena;
};

/* Fills bounds[] and area[] of primitives from .. to - 1. */
void hsr_octree_look(struct hsr_octree_builder *b, uint32_t from, uint32_t to);

/* Returns a root node for the cube with lower corner lo and edges `side`. */
struct hsr_octree_node hsr_octree_root(const double lo[3], double side);

/* Replaces the root's cube by one that holds all n boxes, if it does not,
 * because of rounding. */
void hsr_octree_enclose(struct hsr_octree_node *root,
                        const struct hsr_box *bounds, uint32_t n);

/* Divides the primitives that a cube got from its parent: appends each to the
 * cube's own or to the lists of octants. False: no memory. */
bool hsr_octree_part(const struct hsr_octree_builder *b,
                     const struct hsr_octree_node *cube,
                     const struct hsr_octree_list *list,
                     struct hsr_octree_list *own,
                     struct hsr_octree_list octants[8]);

/* Moves the primitives of octants that have too few back to the cube's own. All
 * octants are emptied if the division does not help, or if it makes more than
 * `copies` times the n primitives. `stamp` must be different for each cube, and
 * not 0. False: no memory. */
bool hsr_octree_give_back(const struct hsr_octree_builder *b, uint32_t stamp,
                          uint32_t n, double copies,
                          struct hsr_octree_list *own,
                          struct hsr_octree_list octants[8]);

/* Returns the number of primitives in all these lists. */
uint64_t hsr_octree_count(const struct hsr_octree_list *own,
                          const struct hsr_octree_list octants[8]);

/* Makes the tree of a cube from the primitives of a list, and appends its nodes
 * and items to those of the builder. *made becomes the index of its root. The
 * tree may hold `copies` times the primitives of the list. False: no memory. */
bool hsr_octree_build(struct hsr_octree_builder *b,
                      const struct hsr_octree_node *cube,
                      const struct hsr_octree_list *list, double copies,
                      int depth, uint32_t *made);

/* Finds the tight box of node k. Sets tight[k], and the node's rounded copy.
 * Those of its octants must be found before. */
void hsr_octree_tighten(const struct hsr_octree *octree, uint32_t k,
                        const struct hsr_box *bounds, struct hsr_box *tight);

#endif
