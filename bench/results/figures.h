/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statistics of samples of time. The unit of repetition is a process start: the
 * samples of one start share its luck with addresses and pages. So every
 * interval comes from the spread between starts as well as within them. */
#ifndef HSR_BENCH_FIGURES_H
#define HSR_BENCH_FIGURES_H

#include <stdbool.h>

/* A value and its interval; low and high are NAN if there are too few samples
 * for one. */
struct figure {
  double value, low, high;
};

/* Samples in seconds, in order: those of one start lie together. Borrowed. */
struct samples {
  const double *seconds;
  int starts, each; /* starts * each samples */
};

enum { FIGURES_MOST_STARTS = 64 };

/* The median of all samples, with a 95 % interval by the bootstrap over starts
 * and over the samples within each start. With only two starts the interval is
 * too short. Reproducible. False for lack of memory. */
bool figure_median(const struct samples *samples, struct figure *median);

double figure_least(const struct samples *samples);

/* logs[k] = the logarithm of the median of start k. False for lack of memory.
 */
bool figure_logs(const struct samples *samples, double *logs);

/* exp of the mean of n logarithms, with a 99 % interval by Student's t. */
struct figure figure_of_logs(const double *logs, int n);

/* exp(mean of a - mean of b) of two independent sets of logarithms, with a 99 %
 * interval by Welch's t. */
struct figure figure_quotient(const double *a, int n, const double *b, int m);

/* Whether there were enough samples for an interval. */
bool figure_has_interval(const struct figure *figure);

/* Whether 1 is outside the interval. False where there is none. */
bool figure_distinguishable(const struct figure *ratio);

#endif
