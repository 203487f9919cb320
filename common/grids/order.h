/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The orders in which the cells of a grid are visited. From back to front, a
 * cell that hides another is visited after it; from front to back, before it.
 * No depths are compared: an order is an enumeration of indices.
 *
 * Source      J. E. Swan II, "Object-Order Rendering of Discrete Objects", PhD
 *             thesis, Ohio State University, 1998, chapter 2
 * Notation    the grid has n[a] cells along axis a, from 0. The eye lies in
 *             cell q[a] of that axis. The low side is the cells 0..q[a], and
 *             the high side is the rest. Either may be empty.
 * Invariant   each cell is in exactly one run.
 * Proof       (perspective, pbtf, front to back) Along an axis, a ray from the
 *             eye never turns back: on each side it only moves away from cell
 *             q. So if cell A hides cell B, A is no farther from q than B along
 *             each axis. Along each axis, both are on one side, or A is in cell
 *             q itself, which is on the low side. Within an octant, three
 *             nested loops from near to far visit A first, in any nesting. If
 *             the octants of A and B differ, A is on the low side of each axis
 *             where they differ, and low sides are visited first.
 * Departures  the theorems of the thesis are about points. There q is the last
 *             sample that is not above the eye, and octants may come in any
 *             order. Theorem 3 takes the nearest sample as q. That is wrong
 *             unless the side with that sample comes first. Cells have extent,
 *             and cell q can hide cell q + 1. So low sides come first. */
#ifndef HSR_COMMON_GRIDS_ORDER_H
#define HSR_COMMON_GRIDS_ORDER_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum hsr_grid_order {
  /* These three are right in parallel projection only. */
  HSR_BTF,     /* three nested loops, each towards the view plane (Frieder,
                  Gordon and Reynolds 1985) */
  HSR_WBTF,    /* as btf, with the axis closest to the view direction as the
                  outermost loop, and the axis farthest from it as the innermost
                  (Westover 1990) */
  HSR_VBUFFER, /* slices as in wbtf. Within a slice, cells are in order of the
                  distance of their middles from the view plane, in doubles
                  (Upson and Keeler 1988) */
  /* These three are right in both projections. */
  HSR_PBTF,   /* each axis is divided at the eye, and the octants are visited
                 one after the other (Swan 1998) */
  HSR_IPPBTF, /* each axis is divided at the eye, and each loop takes cells from
                 both sides, in order of their distance from the eye's cell
                 (after Botha and Post 2003) */
  HSR_OCTREE, /* an octree. The children of a node are visited as pbtf visits a
                 grid of 2 x 2 x 2 cells (Aref and Samet 1991) */
  HSR_GRID_ORDERS
};
extern const char *const hsr_grid_order_name[HSR_GRID_ORDERS];

/* A grid and an eye. */
struct hsr_grid_seen {
  uint32_t n[3];       /* cells, or samples; at least 1, at most 2^30 */
  int32_t q[3];        /* hsr_grid_split of each axis; -1 to n - 1 */
  double toward[3];    /* the view direction in the grid's axes, of any length.
                       Only btf, wbtf and vbuffer use it; they do not use q */
  const double *at[3]; /* where the middle of each is along the axes, ascending;
                          borrowed. Only vbuffer uses it. NULL: 1 apart */
  bool high_first;     /* visit high sides before low ones: for points only */
};

/* Returns the index at which an axis is divided, q: the last of n ascending
 * positions that is not above the eye's coordinate; -1 if all are above it. The
 * positions are the lower bounds of cells, or the places of samples. In a
 * parallel view the eye's coordinate is infinite, or NaN if the view runs
 * across the axis (common/view/view.h). For NaN any index is right; the result
 * is -1. */
int32_t hsr_grid_split(const double *position, uint32_t n, double eye);

/* Cells that are visited one after the other along an axis. */
struct hsr_grid_run {
  uint32_t at[3]; /* the indices of the first */
  int axis;       /* the axis along which the others follow */
  int step;       /* +1 or -1, from one to the next */
  uint32_t n;     /* cells, at least 1 */
};

/* Called for each run, which is borrowed for the call. */
typedef void hsr_visit_run(void *data, const struct hsr_grid_run *run);

/* The axes of three nested loops, outermost first, for each of six nestings. */
extern const int hsr_grid_nesting[6][3];

/* Visits all cells: calls visit(data, run) for each run. `front` says from
 * front to back; else it is from back to front, which is the same in reverse.
 * `nesting`, 0 to 5, is that of btf, pbtf and ippbtf. The other orders choose
 * their own.
 * HSR_E_NOMEM: vbuffer needs memory for a slice, and ippbtf for three axes. */
enum hsr_status hsr_grid_visit(enum hsr_grid_order order, int nesting,
                               bool front, const struct hsr_grid_seen *seen,
                               hsr_visit_run *visit, void *data,
                               struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
