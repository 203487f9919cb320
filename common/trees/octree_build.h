/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steps by which octrees are made: for octree.c, where they are, and
 * octree_shared.c. */
#ifndef HSR_COMMON_OCTREE_BUILD_H
#define HSR_COMMON_OCTREE_BUILD_H

#include "common/trees/octree.h"

enum { HSR_OCTREE_DEEPEST = 32 };

/* It may make so many times as many of all primitives, in all. This is for
 * bundles of long slivers: each division doubles them, down to cubes as small as
 * the distance between two of them. */
enum { HSR_OCTREE_COPIES = 64 };

/* Numbers of primitives. The memory is malloc'ed. */
struct hsr_octree_list {
  uint32_t *k;
  uint32_t n, room;
};

struct hsr_octree_builder {
  const struct hsr_primitives *primitives;
  const struct hsr_octree_rule *rule;
  struct hsr_box *bounds; /* a primitive */
  double *area;
  uint32_t *mark; /* a primitive: 1 + the node that was last given it back */
  struct hsr_growing node, item;
  struct hsr_arena *arena;
};

/* Fills bounds[] and area[] of primitives from .. to - 1. */
void hsr_octree_look(struct hsr_octree_builder *b, uint32_t from, uint32_t to);

/* The root, and it once it is sure to hold all n boxes. */
struct hsr_octree_node hsr_octree_root(const double lo[3], double side);
void hsr_octree_enclose(struct hsr_octree_node *root,
                        const struct hsr_box *bounds, uint32_t n);

/* Appends the primitives of a list that is handed down to a cube to its own and
 * to those of the octants. False: no memory. */
bool hsr_octree_part(const struct hsr_octree_builder *b,
                     const struct hsr_octree_node *cube,
                     const struct hsr_octree_list *list,
                     struct hsr_octree_list *own,
                     struct hsr_octree_list octants[8]);

/* Octants of too few primitives give them back; all octants do if dividing does
 * not help, or if it makes more than `copies` of each of the n. `stamp` is
 * another for each cube, and not 0. False: no memory. */
bool hsr_octree_give_back(const struct hsr_octree_builder *b, uint32_t stamp,
                          uint32_t n, double copies,
                          struct hsr_octree_list *own,
                          struct hsr_octree_list octants[8]);

uint64_t hsr_octree_count(const struct hsr_octree_list *own,
                          const struct hsr_octree_list octants[8]);

/* Appends the tree of a cube, and its primitives, to those of the builder. It
 * may hold `copies` times the primitives of the list. False: no memory. */
bool hsr_octree_build(struct hsr_octree_builder *b,
                      const struct hsr_octree_node *cube,
                      const struct hsr_octree_list *list, double copies,
                      int depth, uint32_t *made);

/* Finds the tight box of node k: as it is in tight[k], and rounded in the
 * node. Those of its octants are found. */
void hsr_octree_tighten(const struct hsr_octree *octree, uint32_t k,
                        const struct hsr_box *bounds, struct hsr_box *tight);

#endif
