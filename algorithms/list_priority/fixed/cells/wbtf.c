/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Back to front, the outermost loop along the axis closest to the view
 * direction and the innermost along the one farthest from it.
 *
 * Source      L. Westover, "Footprint Evaluation for Volume Rendering",
 *             SIGGRAPH 1990; J. E. Swan II, PhD thesis, 1998, 2.2.1.
 * Known wrong in perspective, as btf is, though in fewer views.
 *
 * Notation, invariant, ties, departures and cost are those of cells.h. */
#include "algorithms/engines/cells/cells.h"

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return hsr_cells_render(HSR_WBTF, job, err);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_cells_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"take the axes in the order of their angles to the view direction"},
    {"", .part = &hsr_cells_part},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(wbtf) = {
    .name = "wbtf",
    .grid_parts = HSR_GRID_SLICES,
    .title = "Back to front by slices along the view",
    .authors = "L. Westover",
    .year = 1990,
    .source =
        "Westover, Footprint Evaluation for Volume Rendering, SIGGRAPH 1990",
    .taxonomy = HSR_LIST_PRIORITY_FIXED,
    .sort_order = "Z(XY)",
    .coherence = "object",
    .subjects = 1 << HSR_GRID,
    .makes = {{HSR_IDS}},
    .parts = uses,
    .outline = outline,
    .options = hsr_cells_front,
    .flags = HSR_INSTANCED | HSR_KNOWN_WRONG,
    .render = render};
