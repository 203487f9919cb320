/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The conclusions of Sutherland et al. 1974, compared with what was counted. */
#ifndef HSR_BENCH_CLAIMS_H
#define HSR_BENCH_CLAIMS_H

#include "bench/tables/tables.h"

/* Later findings outweigh earlier ones. Where a claim has several parts, its
 * finding is that of the weightiest part: a claim with one contradicted part is
 * not borne out, even if other parts were not measured. */
enum finding {
  BORNE_OUT,
  UNDECIDED, /* the interval holds values that are claimed and others */
  NOT_MEASURED,
  NOT_BORNE_OUT
};
const char *finding_name(enum finding finding); /* "not borne out" */

struct conclusion {
  const char *section;
  const char *sentence; /* how the survey's sentence begins */
  const char *claim;
  const char *erratum; /* how the survey contradicts it itself, or NULL */
  char criterion[200]; /* how it is judged: "exponent: 1.75 to 2.25" */
  enum finding finding;
  char evidence[1200]; /* the figures */
};

int claims_count(void);

/* The conclusion on claim k, from 0, computed from the tables alone. */
struct conclusion claims_judge(const struct tables *t, int k);

#endif
