/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What Sutherland et al. 1974 conclude, held against what was counted. */
#ifndef HSR_BENCH_CLAIMS_H
#define HSR_BENCH_CLAIMS_H

#include "bench/tables/tables.h"

/* In the order in which one outweighs another, where a claim is of several
 * things: one that is contradicted is so whatever else was not measured. */
enum finding {
  BORNE_OUT,
  UNDECIDED, /* the interval holds values that are claimed and others */
  NOT_MEASURED,
  NOT_BORNE_OUT
};
const char *finding_name(enum finding finding); /* "not borne out" */

struct conclusion {
  const char *section, *claim;
  char criterion[200]; /* by which it was judged: "exponent: 1.75 to 2.25" */
  enum finding finding;
  char evidence[1200]; /* the figures */
};

int claims_count(void);

/* The finding of claim k of those; each is computed from the tables alone. */
struct conclusion claims_judge(const struct tables *t, int k);

#endif
