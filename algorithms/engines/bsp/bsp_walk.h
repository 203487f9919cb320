/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Going through an octree of BSP trees, front to back or back to front.
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
 * Side        of the eye: exact. Where the eye is in a plane, what is in it is
 *             not seen, and neither side hides the other.
 * Left out    pieces that are in the eye's plane, and back faces of one-sided
 *             objects
 * Moved       the trees may be those of an object of which the world has an
 *             instance, moved by `shift`: the sum of any vertex and `shift` is
 *             exact */
#ifndef HSR_ALGORITHMS_BSP_WALK_H
#define HSR_ALGORITHMS_BSP_WALK_H

#include "algorithms/algorithm.h"
#include "common/trees/bsp.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A node that waits to be entered, or whose pieces wait to be told. */
struct hsr_bsp_waiting {
  uint32_t node;
  int eye_side; /* of its plane, if it was entered */
  bool gone_into;
};

/* All borrowed. */
struct hsr_bsp_walk {
  const struct hsr_bsp *bsp;
  const struct hsr_view *view;
  const double *shift;
  bool backwards; /* back to front */
  struct hsr_tally *tally;
  struct hsr_bsp_waiting *waiting; /* room for hsr_bsp_most_waiting */

  void *context;
  /* Whether to enter a cube, which is not empty; NULL: always. */
  bool (*enter)(void *context, const struct hsr_bsp_cube *cube);
  /* Whether to enter the subtree of a node; NULL: always. */
  bool (*enter_node)(void *context, uint32_t node);
  /* A piece; facing: +1 if the eye is in front of its face, -1 behind. */
  void (*piece)(void *context, const struct hsr_bsp_piece *piece, int facing);
};

/* Two for each level of a tree, a node that was entered and the child that
 * comes after it; and the node that is entered next. */
static inline size_t hsr_bsp_most_waiting(uint32_t most_depth) {
  return 2 * (size_t)most_depth + 1;
}

/* Walks from a cube on. */
void hsr_bsp_walk_cube(const struct hsr_bsp_walk *walk, uint32_t cube);

/* Walks from the root on. */
void hsr_bsp_walk_tree(const struct hsr_bsp_walk *walk);

#ifdef __cplusplus
}
#endif
#endif
