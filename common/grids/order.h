/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The orders in which the cells of a grid are visited, so that none is visited
 * before one that it hides. They compare no depths: an order is an enumeration
 * of indices.
 *
 * Source      J. E. Swan II, "Object-Order Rendering of Discrete Objects", PhD
 *             thesis, Ohio State University, 1998, chapter 2
 * Notation    the grid has n[a] cells along axis a, from 0; the eye lies in
 *             cell q[a] of that axis. The low side is 0..q[a], the high side
 *             the rest; either may be empty.
 * Invariant   each cell is in exactly one run.
 * Proof       (perspective, pbtf) A ray from the eye never comes nearer to the
 *             eye again along an axis, and on each side it only goes away from
 *             cell q. So if cell A hides cell B, A is no farther from q than B
 *             along each axis. Both are on one side of each axis, or A is in
 *             cell q itself, which is on the low side. Within an octant three
 *             nested loops from near to far visit A first, in any nesting. If
 *             the octants differ, A's is lower along each axis where they do,
 *             and low sides come first.
 * Departures  The theorems of the thesis are of points. There q is the last
 *             sample that is not above the eye, and octants may come in any
 *             order. Theorem 3 takes the nearest sample for it, which is wrong
 *             unless the side that holds it comes first. Cells have extent, and
 *             cell q can hide cell q + 1: so low sides come first. */
#ifndef HSR_COMMON_GRIDS_ORDER_H
#define HSR_COMMON_GRIDS_ORDER_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum hsr_grid_order {
  HSR_BTF,     /* three loops, each towards the view plane (Frieder, Gordon and
                  Reynolds 1985). Right in parallel projection */
  HSR_WBTF,    /* the axis closest to the view direction is the outermost loop,
                  the farthest from it the innermost (Westover 1990). As btf */
  HSR_VBUFFER, /* slices as of wbtf; within a slice, cells by their distance from
                  the view plane (Upson and Keeler 1988). As btf */
  HSR_PBTF,    /* each axis is divided at the eye, and the octants are visited
                  one after the other (Swan 1998). Right in both projections */
  HSR_IPPBTF, /* each axis is divided at the eye, and each loop takes cells from
                  both sides, by their distance from the eye's (after Botha and
                  Post 2003). Right in both */
  HSR_OCTREE, /* an octree, the children of a node as pbtf would visit 2 x 2 x 2
                  cells (Aref and Samet 1991). Right in both */
  HSR_GRID_ORDERS
};
extern const char *const hsr_grid_order_name[HSR_GRID_ORDERS];

/* A grid as it is seen. */
struct hsr_grid_seen {
  uint32_t n[3];    /* cells, or samples; at least 1, at most 2^30 */
  int32_t q[3];     /* hsr_grid_split of each axis; -1 to n - 1 */
  double toward[3]; /* where the eye looks, in the grid's axes; only btf, wbtf
                       and vbuffer use it, which know no eye */
  bool high_first;  /* visit high sides before low ones: for points only */
};

/* Where an axis is divided: the last of n ascending positions that is not above
 * the eye. Positions are the lower bounds of cells, or the places of samples.
 * -1: all are above it. The eye of a parallel view is infinite, or NaN if the
 * view runs across the axis (common/view/view.h). Any answer is right then; it
 * is -1. */
int32_t hsr_grid_split(const double *position, uint32_t n, double eye);

/* Cells that are visited one after the other along an axis. */
struct hsr_grid_run {
  uint32_t at[3]; /* the first */
  int axis;       /* along which the others follow */
  int step;       /* +1 or -1 */
  uint32_t n;     /* at least 1 */
};
typedef void hsr_visit_run(void *data, const struct hsr_grid_run *run);

/* The six nestings of three loops, outermost first. */
extern const int hsr_grid_nesting[6][3];

/* Visits all cells. `nesting` is that of btf, pbtf and ippbtf, 0 to 5; the
 * others choose their own. `front`: from front to back, or else from back to
 * front, which is the same in reverse. HSR_E_NOMEM, for what vbuffer and ippbtf
 * hold: a slice, or three axes. */
enum hsr_status hsr_grid_visit(enum hsr_grid_order order, int nesting,
                               bool front, const struct hsr_grid_seen *seen,
                               hsr_visit_run *visit, void *data,
                               struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
