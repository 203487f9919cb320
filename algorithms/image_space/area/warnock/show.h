/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Windows that are decided, and how they are shown: at once, or as a raster
 * device takes them.
 *
 * Source      Sutherland et al. 1974, "J. E. Warnock": the decisions come in "a
 *             seemingly random order"; D. Cohen drives a raster display by "a
 *             massive sort of the windows by Y and X coordinates". How he sorts
 *             is not said.
 * Invariants  decided windows do not overlap, and together they hold every
 *             sample. So those of one row follow one another without a gap.
 * Ties        none: no two windows have the same first sample
 * Cost        the sort 2 windows; then in each row a look at each of its windows
 */
#ifndef HSR_ALGORITHMS_WARNOCK_SHOW_H
#define HSR_ALGORITHMS_WARNOCK_SHOW_H

#include "algorithms/algorithm.h"
#include "common/base/arena.h"
#include "common/exact/screen.h"

/* The samples of `window` show face `id`, or what covers them of `front`, a face
 * before it. HSR_BACKGROUND: no face. */
struct hsr_decided {
  struct hsr_window window;
  uint32_t id, front;
};

/* Where windows are shown. All but the list is borrowed. */
struct hsr_show {
  const struct hsr_job *job;
  const struct hsr_screen *screen;
  int *columns;            /* room for the spans of the largest face */
  int run;                 /* counter of runs of samples of a front face */
  bool later;              /* in the order of a raster: windows are listed */
  struct hsr_growing list; /* of struct hsr_decided */
  bool out_of_memory;      /* the list lacks windows */
};

/* Sets up a show; its arrays are in the job's arena. HSR_E_NOMEM. */
enum hsr_status hsr_show_init(struct hsr_show *show, const struct hsr_job *job,
                              const struct hsr_screen *screen, int run,
                              bool later);

/* Shows a window, or lists it. Sets `out_of_memory` if the list cannot grow. */
void hsr_show_window(struct hsr_show *show, struct hsr_window window,
                     uint32_t id, uint32_t front);

/* The counters of hsr_show_raster. */
struct hsr_raster_counters {
  int sort;  /* windows put into buckets, in each of two passes */
  int merge; /* windows compared with those that go on from the row above */
  int rows;  /* parts of windows put out, a row each */
};

/* Sorts the listed windows by Y and X, and puts them out, row by row from the
 * top, each from left to right. HSR_E_NOMEM. */
enum hsr_status hsr_show_raster(struct hsr_show *show,
                                const struct hsr_raster_counters *counters);

#endif
