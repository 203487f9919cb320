/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The walk: the traversal of an octree of BSP trees for one eye, from front to
 * back or from back to front.
 *
 * Source      H. Fuchs, Z. Kedem and B. Naylor, "On Visible Surface Generation
 *             by A Priori Tree Structures", SIGGRAPH 1980; N. Greene,
 *             "Hierarchical Polygon Tiling with Coverage Masks", SIGGRAPH 1996,
 *             5.1.
 * Order       Front to back: the octant that holds the eye comes first, the
 *             others as hsr_octant_order has them. In a tree, the eye's side of
 *             the plane comes first, then what is in the plane, then the other
 *             side. Back to front is the reverse, except for pieces in one
 *             plane: they come by descending faces, so that the lowest is
 *             painted last.
 * Side        The side of a plane on which the eye is, is decided exactly. If
 *             the eye is in the plane, what is in it is not seen, and neither
 *             side hides the other.
 * Left out    pieces whose plane holds the eye, and back faces of one-sided
 *             objects
 * Moved       The trees may be those of an object, of which an instance is
 *             moved by `shift`. The sum of any vertex and `shift` is then
 *             exact. */
#ifndef HSR_ALGORITHMS_BSP_WALK_H
#define HSR_ALGORITHMS_BSP_WALK_H

#include "algorithms/algorithm.h"
#include "common/trees/bsp.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A node on the stack of a traversal: it waits to be entered, or if gone_into,
 * to give its pieces. */
struct hsr_bsp_waiting {
  uint32_t node;
  int eye_side; /* if gone_into: the eye's side of its plane, +1, -1 or 0 */
  bool gone_into;
};

/* What a traversal needs, set by the caller. All is borrowed for the call. */
struct hsr_bsp_walk {
  const struct hsr_bsp *bsp;
  const struct hsr_view *view;
  const double *shift; /* three numbers: Moved, above */
  bool backwards;      /* from back to front */
  struct hsr_tally *tally;
  struct hsr_bsp_waiting *waiting; /* room for hsr_bsp_most_waiting of them */

  void *context;
  /* Asked whether to enter a cube, which is not empty. NULL: yes. */
  bool (*enter)(void *context, const struct hsr_bsp_cube *cube);
  /* Asked whether to enter the subtree of a node. NULL: yes. */
  bool (*enter_node)(void *context, uint32_t node);
  /* Gets each piece in its turn. facing: +1 if the eye is in front of its face,
   * -1 if it is behind. */
  void (*piece)(void *context, const struct hsr_bsp_piece *piece, int facing);
};

/* The most nodes on the stack for trees of this depth: two for each level, a
 * node that was entered and its child that comes after it; and the node that is
 * entered next. */
static inline size_t hsr_bsp_most_waiting(uint32_t most_depth) {
  return 2 * (size_t)most_depth + 1;
}

/* Traverses what is in a cube. */
void hsr_bsp_walk_cube(const struct hsr_bsp_walk *walk, uint32_t cube);

/* Traverses all, from the root cube. */
void hsr_bsp_walk_tree(const struct hsr_bsp_walk *walk);

#ifdef __cplusplus
}
#endif
#endif
