/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interleaved perspective back to front: each axis is divided at the eye, and
 * each loop takes cells from both sides in turn, by their distance from it.
 *
 * Source      C. P. Botha and F. H. Post, "ShellSplatting: Interactive
 *             Rendering of Anisotropic Volumes", VisSym 2003, which objects to
 *             pbtf that its proof takes voxels for points.
 * Departures  The distance is counted in cells from the one that holds the eye.
 *
 * Notation, invariant, ties, further departures and cost are those of cells.h.
 */
#include "algorithms/engines/cells/cells.h"

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return hsr_cells_render(HSR_IPPBTF, job, err);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_cells_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"sort the cells of each axis by their distance from the eye's"},
    {"", .part = &hsr_cells_part},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(ippbtf) = {
    .name = "ippbtf",
    .grid_parts = HSR_GRID_TURNS,
    .title = "Interleaved perspective back to front",
    .authors = "C. P. Botha, F. H. Post",
    .year = 2003,
    .source = "Botha and Post, ShellSplatting: Interactive Rendering of "
              "Anisotropic Volumes, VisSym 2003",
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
