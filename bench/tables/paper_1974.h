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

/* A row of Table II. A figure is NAN if the table prints none. */
struct paper_statistic {
  const char *symbol;
  const char *rule; /* "given", a formula, or NULL: no rule */
  double figure[ENVIRONMENTS];
};

/* A row of Table III. */
struct paper_step {
  const char *label; /* as the algorithms' descriptors have it */
  double figure[ENVIRONMENTS];
  bool once; /* not charged in each frame's cost */
};

/* A column of Table VII: the algorithms that share one estimate. */
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

/* The entry for a symbol, for an algorithm, for a step; NULL if there is none.
 * `group` may be NULL. */
const struct paper_statistic *paper_statistic(const char *symbol);
const struct paper_group *paper_group(const char *algorithm);
const struct paper_step *paper_step(const struct paper_group *group,
                                    const char *label);

#endif
