/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figures on hierarchical visibility that Greene prints (Hierarchical
 * Rendering of Complex Environments, thesis, University of California at Santa
 * Cruz, 1995; with Kass and Miller, SIGGRAPH 1993; SIGGRAPH 1996), beside our
 * own. His machines are gone, so only counts and ratios of times are compared.
 */
#ifndef HSR_BENCH_GREENE_H
#define HSR_BENCH_GREENE_H

#include "bench/results/results.h"

#include <stdbool.h>

/* A number that a cell of the results has. */
struct greene_term {
  const char *cell; /* its key (bench/results/results.h) */
  const char
      *of; /* keys of counters, joined by '+'; or "seconds", the least time of
                       a frame; or "samples", those of all frames */
};

/* A figure, over / under. Without a source it is the title of the figures that
 * follow. */
struct greene_figure {
  const char *what, *source;
  double printed;                 /* his figure; NAN: he prints none */
  struct greene_term over, under; /* under.cell NULL: under is 1 */
  double factor;                  /* multiplies the quotient; 0 stands for 1 */
  const char *less, *more; /* why our figure is less than half of his, or more
                              than twice his; NULL: not known */
};

/* Ended by one whose `what` is NULL. */
extern const struct greene_figure greene_figures[];

/* Our figure; NAN if the results do not have it. */
double greene_measured(const struct greene_figure *figure,
                       const struct results *results);

/* Why our figure is off from his by more than a factor of 2; "not explained" if
 * that is not known. NULL if it is not so far off, or not measured. */
const char *greene_reason(const struct greene_figure *figure, double ours);

/* Whether the results have a cell of any figure. */
bool greene_is_measured(const struct results *results);

/* All figures as text; as a JSON array, or NULL for lack of memory. */
void greene_print(const struct results *results);
json_t *greene_json(const struct results *results);

#endif
