/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figures that Greene prints of hierarchical visibility (Hierarchical
 * Rendering of Complex Environments, thesis, University of California at Santa
 * Cruz, 1995; with Kass and Miller, SIGGRAPH 1993; SIGGRAPH 1996), beside the
 * same of ours. His machines are gone: what is compared are counts, and ratios
 * of times. */
#ifndef HSR_BENCH_GREENE_H
#define HSR_BENCH_GREENE_H

#include "bench/results/results.h"

#include <stdbool.h>

/* A number that a cell of the results has. */
struct greene_term {
  const char *cell; /* its key (bench/results/results.h) */
  const char *of;   /* counters, joined by '+'; or "seconds", the least of a
                       frame;   or "samples", of all frames */
};

/* A figure, of over / under; or the title of those that follow, which has no
 * source. */
struct greene_figure {
  const char *what, *source;
  double printed;                 /* NAN: he has none, ours stands alone */
  struct greene_term over, under; /* under.cell NULL: 1 */
  double factor;           /* by which the quotient is multiplied; 0: 1 */
  const char *less, *more; /* why ours is less than half of his, or more than
                              twice; NULL: not known */
};

/* Ended by one without `what`. */
extern const struct greene_figure greene_figures[];

/* Ours; NAN where the results have it not. */
double greene_measured(const struct greene_figure *figure,
                       const struct results *results);

/* Why ours is off from his by more than a factor of 2; "not explained" where
 * that is not known; NULL where it is not so far off, or not measured. */
const char *greene_reason(const struct greene_figure *figure, double ours);

/* Whether the results have a cell of any figure. */
bool greene_is_measured(const struct results *results);

/* All figures as text; as a JSON array, or NULL for lack of memory. */
void greene_print(const struct results *results);
json_t *greene_json(const struct results *results);

#endif
