/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The times of cells that hsr bench recorded. */
#ifndef HSR_BENCH_TIMES_H
#define HSR_BENCH_TIMES_H

#include "bench/results/figures.h"
#include "bench/results/results.h"

/* The times of one cell. */
struct times {
  struct samples samples;           /* starts is 0 if it has none */
  double *seconds;                  /* owned */
  double logs[FIGURES_MOST_STARTS]; /* of each start's median */
};

/* Reads the times of a cell record; NULL has none. *times is to be freed also
 * after a failure. HSR_E_NOMEM. */
enum hsr_status times_read(const json_t *cell, struct times *times,
                           struct hsr_error *err);
void times_free(struct times *times);

/* The cell of the algorithm `reference` on one thread, for the same scene, view
 * and size; or NULL. Borrowed. */
const json_t *times_reference(const struct results *results, const json_t *cell,
                              const char *reference);

/* The logarithms of the ratios of a cell's times to the reference's, start by
 * start. There are *n, at most FIGURES_MOST_STARTS; 0 if either cell has no
 * times. HSR_E_NOMEM. */
enum hsr_status times_ratios(const struct results *results, const json_t *cell,
                             const char *reference, double *logs, int *n,
                             struct hsr_error *err);

#endif
