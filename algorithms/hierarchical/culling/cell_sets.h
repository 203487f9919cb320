/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which cells of space can be seen from which, computed once for all views.
 *
 * Source      J. Airey, J. Rohlf and F. Brooks, I3D 1990; S. Teller and C.
 *             Sequin, "Visibility preprocessing for interactive walkthroughs",
 *             SIGGRAPH 1991; as told by N. Greene, PhD thesis, UC Santa Cruz,
 *             1995, 2.1.6. A cell is seen from another if a line goes from one
 *             to the other through portals alone.
 * Notation    Octant: a sign for each axis, and all directions that have these
 *             signs. Bundle: the lines of one octant that enter a cell. It is
 *             kept as a box around the points where they enter, and for each
 *             two axes bounds of their slope.
 * Invariant   For each start cell and each of its portals: the bundle of a cell
 *             holds every line that leaves the start cell by that portal and
 *             gets to the cell through portals. So the set of a cell holds
 *             every cell that is seen from any of its points.
 * Departures  Teller and Sequin follow each sequence of portals, and test
 *             whether a line goes through all of it. In a scene without rooms
 *             there are too many sequences. Here all lines that enter a cell
 *             are one bundle. In the k-d tree's order from front to back, a
 *             cell comes after all cells from which lines enter it. So each is
 *             looked at once for an octant and a first portal. The sets become
 *             a little larger.
 * Cost        cells x their portals x 4 octants x the cells that are seen */
#ifndef HSR_ALGORITHMS_CELL_SETS_H
#define HSR_ALGORITHMS_CELL_SETS_H

#include "algorithms/hierarchical/culling/portals.h"

struct hsr_cell_sets {
  uint32_t n_cells;
  /* n_cells x n_cells: 1 if the second cell is in the set of the first. Every
   * cell is in its own set */
  unsigned char *sees;
};

/* Computes the sets of all cells. `portals` is not kept; the array is the
 * arena's. HSR_E_NOMEM. */
enum hsr_status hsr_cell_sets_init(struct hsr_cell_sets *sets,
                                   const struct hsr_portals *portals,
                                   struct hsr_arena *arena);

/* Is `cell` in the set of cell `from`? */
static inline bool hsr_cell_sees(const struct hsr_cell_sets *sets,
                                 uint32_t from, uint32_t cell) {
  return sets->sees[(size_t)from * sets->n_cells + cell];
}

#endif
