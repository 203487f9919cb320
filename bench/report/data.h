/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files that make a report's numbers share: cells.c computes the
 * statistics of each cell, ladders.c how cells grow, data.c puts all together.
 */
#ifndef HSR_BENCH_REPORT_DATA_H
#define HSR_BENCH_REPORT_DATA_H

#include "bench/report/report.h"
#include "bench/results/figures.h"

/* The statistics of a cell. */
struct cell_figures {
  int starts; /* 0: it was not timed */
  struct figure median;
  double least; /* seconds */
  bool compared;
  struct figure ratio; /* to the reference's time, if it is compared */
};

/* Of all cells of the results, in their order; to be freed. On all processors.
 * NULL: HSR_E_NOMEM in *err. */
struct cell_figures *cells_measure(const struct report *report,
                                   struct hsr_error *err);

/* "places", "counters" and "cells" of the page's data, as one new object; or
 * NULL for lack of memory. Most of a report is its cells, so they are short: a
 * cell has the number of its place and of its list of counters, and no member
 * that says nothing. */
json_t *cells_json(const struct report *report,
                   const struct cell_figures *figures);

/* How seconds and comparisons grow: a new array of ladders, or NULL for lack of
 * memory. */
json_t *ladders_json(const struct report *report,
                     const struct cell_figures *figures);

#endif
