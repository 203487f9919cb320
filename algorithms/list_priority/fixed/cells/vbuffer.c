/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The V-buffer: slices along the axis closest to the view direction; within a
 * slice, cells by their distance from the view plane.
 *
 * Source      C. Upson and M. Keeler, "V-BUFFER: Visible Volume Rendering",
 *             SIGGRAPH 1988; J. E. Swan II, PhD thesis, 1998, 2.2.1.
 * Known wrong in perspective, as wbtf is, whose slices it has.
 * Departures  The paper says little of the sweep within a slice. Here it is a
 *             sort by the distance of the cells' middles, made once for all
 *             slices.
 *
 * Notation, invariant, ties, further departures and cost are those of cells.h.
 */
#include "algorithms/engines/cells/cells.h"

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return hsr_cells_render(HSR_VBUFFER, job, err);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_cells_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"sort the cells of a slice by their distance from the view plane"},
    {"", .part = &hsr_cells_part},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(vbuffer) = {
    .name = "vbuffer",
    .grid_parts = HSR_GRID_SLICES,
    .title = "The V-buffer: slices, and concentric sweeps in them",
    .authors = "C. Upson, M. Keeler",
    .year = 1988,
    .source =
        "Upson and Keeler, V-BUFFER: Visible Volume Rendering, SIGGRAPH 1988",
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
