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

static const struct hsr_counter counters[] = {HSR_CELLS_COUNTERS};

static const struct hsr_line outline[] = {
    {"sort the cells of each axis by their distance from the eye's"},
    HSR_CELLS_LINES};

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return hsr_cells_render(HSR_IPPBTF, job, err);
}

const struct hsr_algorithm HSR_ALGORITHM(ippbtf) = {
    HSR_OF_CELLS,
    .name = "ippbtf",
    .title = "Interleaved perspective back to front",
    .authors = "C. P. Botha, F. H. Post",
    .year = 2003,
    .source = "Botha and Post, ShellSplatting: Interactive Rendering of "
              "Anisotropic Volumes, VisSym 2003",
    .counters = counters,
    .outline = outline,
    .options = hsr_cells_nested,
    .flags = HSR_INSTANCED,
    .render = render};
