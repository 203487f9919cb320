/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Back to front: three nested loops over a grid, each towards the view plane.
 *
 * Source      G. Frieder, D. Gordon and R. A. Reynolds, "Back-to-Front Display
 *             of Voxel-Based Objects", IEEE Computer Graphics and Applications
 *             5(1), 1985; J. E. Swan II, PhD thesis, 1998, 2.2.1.
 * Known wrong in perspective: the loops know the direction of the view and not
 *             the eye. Where the eye is within the extent of an axis, one
 *             direction along it cannot be right on both sides of the eye.
 *
 * Notation, invariant, ties, departures and cost are those of cells.h. */
#include "algorithms/engines/cells/cells.h"

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return hsr_cells_render(HSR_BTF, job, err);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_cells_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"axis by axis: begin at the end that is farthest from the view plane"},
    {"", .part = &hsr_cells_part},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(btf) = {
    .name = "btf",
    .grid_parts = HSR_GRID_SLICES,
    .title = "Back to front in three nested loops",
    .authors = "G. Frieder, D. Gordon, R. A. Reynolds",
    .year = 1985,
    .source = "Frieder et al., Back-to-Front Display of Voxel-Based Objects, "
              "IEEE Computer Graphics and Applications 5(1), 1985",
    .taxonomy = HSR_LIST_PRIORITY_FIXED,
    .sort_order = "Z(XY)",
    .coherence = "object",
    .subjects = 1 << HSR_GRID,
    .makes = {{HSR_IDS}},
    .parts = uses,
    .outline = outline,
    .options = hsr_cells_nested,
    .flags = HSR_INSTANCED | HSR_KNOWN_WRONG,
    .render = render};
