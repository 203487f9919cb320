/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the windows that Warnock's algorithm has decided are shown: at once, or
 * sorted as a raster display takes them.
 *
 * Source      Sutherland et al. 1974, "J. E. Warnock": the decisions come in "a
 *             seemingly random order"; D. Cohen drives a raster display by "a
 *             massive sort of the windows by Y and X coordinates". How he sorts
 *             is not said.
 * Invariants  Decided windows do not overlap, and together they hold every
 *             sample. So those on one row follow one another without a gap.
 * Ties        none: no two windows have the same first sample
 * Cost        two steps a window for the sort; then one for each row of each
 *             window
 */
#ifndef HSR_ALGORITHMS_WARNOCK_SHOW_H
#define HSR_ALGORITHMS_WARNOCK_SHOW_H

#include "algorithms/algorithm.h"
#include "common/base/arena.h"
#include "common/exact/screen.h"

/* A decided window. Its samples show face `front` where that covers them, and
 * face `id` elsewhere. Either may be HSR_BACKGROUND: no face. */
struct hsr_decided {
  struct hsr_window window;
  uint32_t id, front;
};

/* Shows windows of one frame. */
struct hsr_show {
  const struct hsr_job *job;       /* borrowed */
  const struct hsr_screen *screen; /* borrowed */
  int *columns;                    /* room for the spans of the largest face */
  int run;                 /* counter of runs of samples of a front face */
  bool later;              /* windows are listed, for hsr_show_raster */
  struct hsr_growing list; /* struct hsr_decided */
  bool out_of_memory;      /* the list lacks windows */
};

/* Sets up *show; its arrays are in the job's scratch. HSR_E_NOMEM. */
enum hsr_status hsr_show_init(struct hsr_show *show, const struct hsr_job *job,
                              const struct hsr_screen *screen, int run,
                              bool later);

/* Writes the ids of a window, or lists it if show->later. Sets
 * show->out_of_memory if the list cannot grow. */
void hsr_show_window(struct hsr_show *show, struct hsr_window window,
                     uint32_t id, uint32_t front);

/* The counters of hsr_show_raster. */
struct hsr_raster_counters {
  int sort;  /* windows put into buckets, in each of two passes */
  int merge; /* windows compared with those that go on from the row above */
  int rows;  /* parts of windows put out, a row each */
};

/* Sorts the listed windows by Y and X, and writes their ids row by row from the
 * top, each row from left to right. HSR_E_NOMEM. */
enum hsr_status hsr_show_raster(struct hsr_show *show,
                                const struct hsr_raster_counters *counters);

#endif
