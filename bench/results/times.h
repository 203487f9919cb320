/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The times of cells that hsr bench recorded. */
#ifndef HSR_BENCH_TIMES_H
#define HSR_BENCH_TIMES_H

#include "bench/results/figures.h"
#include "bench/results/results.h"

/* Of one cell. */
struct times {
  struct samples samples;           /* starts 0: it has none */
  double *seconds;                  /* owned */
  double logs[FIGURES_MOST_STARTS]; /* of each start's median */
};

/* Reads a cell record; NULL is one without times. To be freed also after a
 * failure: HSR_E_NOMEM. */
enum hsr_status times_read(const json_t *cell, struct times *times,
                           struct hsr_error *err);
void times_free(struct times *times);

/* The cell of the same place by the algorithm `reference` on one thread, or
 * NULL. */
const json_t *times_reference(const struct results *results, const json_t *cell,
                              const char *reference);

/* The logarithms of a cell's times over the reference's, start by start, at
 * most FIGURES_MOST_STARTS; *n is 0 where either has no times. HSR_E_NOMEM. */
enum hsr_status times_ratios(const struct results *results, const json_t *cell,
                             const char *reference, double *logs, int *n,
                             struct hsr_error *err);

#endif
