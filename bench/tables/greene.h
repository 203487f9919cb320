/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figures that Greene prints of hierarchical visibility (Hierarchical
 * Rendering, thesis, University of California at Santa Cruz, 1995; with Kass
 * and Miller, SIGGRAPH 1993; SIGGRAPH 1996), beside the same of ours. His
 * machines are gone: what is compared are counts, and ratios of times. */
#ifndef HSR_BENCH_GREENE_H
#define HSR_BENCH_GREENE_H

#include "bench/results.h"

/* What an algorithm takes for a picture, from view 1. */
struct greene_term {
  const char *algorithm;
  const char *counter; /* NULL: seconds, their median */
  const char *scene;
  int size; /* of the picture, size x size */
};

/* A figure: a term per sample, or as a ratio to another one. */
struct greene_figure {
  const char *source, *what;
  double printed;
  struct greene_term term, to; /* to.algorithm NULL: per sample */
};

extern const struct greene_figure greene_figures[]; /* the last: no source */

/* Ours; NAN where the results have it not. */
double greene_measured(const struct greene_figure *figure,
                       const struct results *results);

#endif
