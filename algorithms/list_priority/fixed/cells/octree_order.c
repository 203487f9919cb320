/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An octree over the grid: the children of a node in an order that the eye's
 * place gives, as pbtf would visit 2 x 2 x 2 cells.
 *
 * Source      W. G. Aref and H. Samet, "Perspective Viewing of Objects
 *             Represented by Octrees", 1991; J. E. Swan II, PhD thesis, 1998,
 *             2.2.3.
 * Departures  The tree is not stored: its nodes are halves of index ranges. A
 *             leaf is one cell.
 *
 * Notation, invariant, ties, further departures and cost are those of cells.h.
 */
#include "algorithms/engines/cells/cells.h"

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return hsr_cells_render(HSR_OCTREE, job, err);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_cells_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"at a node: take the children, the one opposite to the eye first"},
    {"", .part = &hsr_cells_part},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(octree_order) = {
    .name = "octree-order",
    .grid_parts = HSR_GRID_CHILDREN,
    .title = "An octree, the far children of a node first",
    .authors = "W. G. Aref, H. Samet",
    .year = 1991,
    .source = "Aref and Samet, Perspective Viewing of Objects Represented by "
              "Octrees, Computer Graphics Forum, 1991",
    .taxonomy = HSR_LIST_PRIORITY_FIXED,
    .sort_order = "Z(XY)",
    .coherence = "object",
    .subjects = 1 << HSR_GRID,
    .makes = {{HSR_IDS}},
    .parts = uses,
    .outline = outline,
    .options = hsr_cells_front,
    .flags = HSR_INSTANCED,
    .render = render};
