/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Perspective back to front: each axis is divided at the eye, and the octants
 * are visited one after the other, each from its far corner to the eye.
 *
 * Source      J. E. Swan II, "Object-Order Rendering of Discrete Objects", PhD
 *             thesis, Ohio State University, 1998, 2.3, theorems 1 to 3 and
 *             corollaries 1 to 6; the six nestings are its duals. The order is
 *             older: M. Anderson 1982 for grids in the plane, N. Max 1993.
 * Departures  Cells have extent, and the thesis' theorems are of points. The
 *             axis is divided at the cell that holds the eye, and the sides
 *             that hold it come last (first, from front to back).
 *
 * Notation, invariant, ties, further departures and cost are those of cells.h.
 */
#include "algorithms/engines/cells/cells.h"

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return hsr_cells_render(HSR_PBTF, job, err);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_cells_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"divide each axis at the eye; take the octants, those of the eye's cell "
     "last"},
    {"", .part = &hsr_cells_part},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(pbtf) = {
    .name = "pbtf",
    .grid_parts = HSR_GRID_OCTANTS,
    .title = "Perspective back to front, octant by octant",
    .authors = "J. E. Swan II",
    .year = 1998,
    .source = "Swan, Object-Order Rendering of Discrete Objects, PhD thesis, "
              "Ohio State University, 1998",
    .taxonomy = HSR_LIST_PRIORITY_FIXED,
    .sort_order = "Z(XY)",
    .coherence = "object",
    .subjects = 1 << HSR_GRID,
    .makes = {{HSR_IDS}},
    .parts = uses,
    .outline = outline,
    .options = hsr_cells_nested,
    .flags = HSR_INSTANCED,
    .render = render};
