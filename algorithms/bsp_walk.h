/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Going through an octree of BSP trees, front to back or back to front.
 *
 * Source      H. Fuchs, Z. Kedem and B. Naylor, "On Visible Surface Generation
 *             by A Priori Tree Structures", SIGGRAPH 1980; N. Greene,
 *             "Hierarchical Polygon Tiling with Coverage Masks", SIGGRAPH 1996,
 *             5.1.
 * Order       front to back: the octant that holds the eye, and the others as
 *             of hsr_octant_order; of a tree, what is on the eye's side of the
 *             plane, what is in it, and what is on the other side. Back to
 *             front: the reverse, but for pieces in one plane: those come by
 *             descending faces, so that the lowest is painted last.
 * Side        of the eye: exact. Where the eye is in a plane, what is in it is
 *             not seen, and neither side hides the other.
 * Left out    pieces that are in the eye's plane, and back faces of one side.
 * Moved       the trees may be those of an object, whose instance is it, moved
 *             by `shift`: the sum of any vertex and it is exact. */
#ifndef HSR_ALGORITHMS_BSP_WALK_H
#define HSR_ALGORITHMS_BSP_WALK_H

#include "algorithms/algorithm.h"
#include "common/bsp.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Who is told of what is come to. */
struct hsr_bsp_visitor {
  void *context;
  /* Whether to enter a cube, which holds something; NULL: always. */
  bool (*enter)(void *context, uint32_t cube);
  /* A piece; +1 if the eye is in front of its face, -1 behind. */
  void (*piece)(void *context, uint32_t piece, int eye_side);
};

enum hsr_bsp_order { HSR_FRONT_TO_BACK, HSR_BACK_TO_FRONT };

/* A node that waits: to be gone into, or for its pieces to be told of. */
struct hsr_bsp_waiting {
  uint32_t node;
  int eye_side; /* of its plane, if it is known */
  bool gone_into;
};

struct hsr_bsp_walk {
  const struct hsr_view *view;
  struct hsr_tally *tally;
  enum hsr_bsp_order order;
  struct hsr_bsp_visitor visitor;
  struct hsr_bsp_waiting *waiting; /* those of one tree */
  const struct hsr_bsp *bsp;
  double shift[3];
};

/* Makes ready for trees that are no deeper than this. HSR_E_NOMEM. */
enum hsr_status HSR_OF_BUILD(hsr_bsp_walk_init)(struct hsr_bsp_walk *walk,
                                                const struct hsr_view *view,
                                                uint32_t most_depth,
                                                struct hsr_arena *arena,
                                                struct hsr_tally *tally);

/* From the root. `order` and `visitor` are set; shift NULL: not moved. */
void HSR_OF_BUILD(hsr_bsp_walk)(struct hsr_bsp_walk *walk,
                                const struct hsr_bsp *bsp,
                                const double shift[3]);

#ifdef __cplusplus
}
#endif
#endif
