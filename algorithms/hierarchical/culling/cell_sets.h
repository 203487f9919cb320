/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which cells can be seen from which, found before any view.
 *
 * Source      J. Airey, J. Rohlf and F. Brooks, I3D 1990; S. Teller and C.
 *             Sequin, "Visibility preprocessing for interactive walkthroughs",
 *             SIGGRAPH 1991; as told by N. Greene, PhD thesis, UC Santa Cruz,
 *             1995, 2.1.6. A cell is seen from another if a line goes from one
 *             to the other through portals alone.
 * Notation    an octant is a sign for each axis: the lines that never go back
 *             along any axis. A bundle holds lines of one octant that come into
 *             a cell: a box around where they come in, and for each two axes
 *             the bounds of their slope.
 * Invariant   the bundle that comes into a cell holds every line that gets
 *             there from the start cell by the portal at hand and others. So
 *             the set of a cell holds every cell that is seen from a point of
 *             it.
 * Departures  Teller and Sequin follow each sequence of portals, and find out
 *             if a line goes through all of it. There are too many sequences in
 *             a scene without rooms. Here all lines that come into a cell are
 *             one bundle. In the order of the k-d tree from front to back, a
 *             cell comes after all those from which lines get into it; so each
 *             is looked at once for an octant and a first portal. The sets are
 *             a little larger.
 * Cost        cells x their portals x 4 octants x the cells that are seen */
#ifndef HSR_ALGORITHMS_CELL_SETS_H
#define HSR_ALGORITHMS_CELL_SETS_H

#include "algorithms/hierarchical/culling/portals.h"

struct hsr_cell_sets {
  uint32_t n_cells;
  unsigned char *sees; /* n_cells x n_cells: 1 if the second is in the set of
                          the first, as is every cell itself */
};

/* The arrays are the arena's. HSR_E_NOMEM. */
enum hsr_status hsr_cell_sets_init(struct hsr_cell_sets *sets,
                                   const struct hsr_portals *portals,
                                   struct hsr_arena *arena);

static inline bool hsr_cell_sees(const struct hsr_cell_sets *sets,
                                 uint32_t from, uint32_t cell) {
  return sets->sees[(size_t)from * sets->n_cells + cell];
}

#endif
