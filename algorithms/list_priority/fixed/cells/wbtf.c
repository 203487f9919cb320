/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Back to front, the outermost loop along the axis closest to the view
 * direction and the innermost along the one farthest from it.
 *
 * Source      L. Westover, "Footprint Evaluation for Volume Rendering",
 *             SIGGRAPH 1990; J. E. Swan II, PhD thesis, 1998, 2.1.
 * Known wrong in perspective, as btf is, though in fewer views.
 *
 * Notation, invariant, ties, departures and cost are those of cells.h. */
#include "algorithms/engines/cells/cells.h"

static const struct hsr_counter counters[] = {HSR_CELLS_COUNTERS};

static const struct hsr_line outline[] = {
    {"take the axes in the order of their angles to the view direction"},
    HSR_CELLS_LINES};

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return hsr_cells_render(HSR_WBTF, job, err);
}

const struct hsr_algorithm HSR_ALGORITHM(wbtf) = {
    HSR_OF_CELLS,
    .name = "wbtf",
    .title = "Back to front by slices along the view",
    .authors = "L. Westover",
    .year = 1990,
    .source =
        "Westover, Footprint Evaluation for Volume Rendering, SIGGRAPH 1990",
    .counters = counters,
    .outline = outline,
    .options = hsr_cells_front,
    .flags = HSR_INSTANCED | HSR_KNOWN_WRONG,
    .render = render};
