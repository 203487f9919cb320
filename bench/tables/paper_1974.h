/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figures that Sutherland, Sproull and Schumacker print (A Characterization
 * of Ten Hidden-Surface Algorithms, Computing Surveys 6(1), 1974, Tables II to
 * VII), for their three environments. */
#ifndef HSR_BENCH_PAPER_1974_H
#define HSR_BENCH_PAPER_1974_H

#include <stdbool.h>

/* Roberts' house, the harbor, the big harbor: our scenes, at 500 x 500. */
enum { ENVIRONMENTS = 3, HOUSE = 0, HARBOR, BIG_HARBOR };
struct paper_environment {
  const char *scene;
  const char *title; /* the survey's word for it */
};
extern const struct paper_environment paper_environments[ENVIRONMENTS];

/* Table II, a row; both 0 where it has none. */
struct paper_statistic {
  const char *symbol;
  const char *rule; /* "given", a formula, or NULL: no rule */
  double figure[ENVIRONMENTS];
};

/* Table III, a row. */
struct paper_step {
  const char *label; /* as the algorithms' descriptors have it */
  double figure[ENVIRONMENTS];
  bool once; /* not charged in each frame's cost */
};

/* Table VII, a column: the algorithms for which the survey has one estimate. */
enum { PAPER_ALGORITHMS = 3, PAPER_STEPS = 5 };
struct paper_group {
  const char *name;
  const char *algorithm[PAPER_ALGORITHMS + 1]; /* ended by NULL */
  struct paper_step step[PAPER_STEPS + 1];     /* ended by .label == NULL */
  double total[ENVIRONMENTS];
};

/* The rows of Table II and the columns of Table VII; the last one has no
 * name. */
extern const struct paper_statistic paper_statistics[];
extern const struct paper_group paper_groups[];

/* What of these is about a symbol, an algorithm, a step; NULL if nothing is.
 * `group` may be NULL. */
const struct paper_statistic *paper_statistic(const char *symbol);
const struct paper_group *paper_group(const char *algorithm);
const struct paper_step *paper_step(const struct paper_group *group,
                                    const char *label);

#endif
