/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sorts, searches and merges of Sutherland et al. 1974, chapter II,
 * "Sorting": comparisons counted as the number of records grows, beside the
 * orders of growth that the survey lists. */
#ifndef HSR_BENCH_SORTS_H
#define HSR_BENCH_SORTS_H

#include "bench/tables/growth.h"

#include <stdbool.h>

enum { SORTS_SIZES = 5 };
extern const double sorts_sizes[SORTS_SIZES]; /* records: 64 to 16,384 */

/* One method on records of one initial order. */
struct sorts_row {
  const char *table, *method, *order; /* "Sorts", "Quick sort", "random" */
  const char *formula;                /* the survey's: "N log N" */
  double count[SORTS_SIZES];          /* comparisons; of radix sort, moves */
  struct growth measured, survey;     /* of count, and of the formula */
  bool sorted;                        /* the records were in order in the end */
  bool agrees; /* the exponents differ by a tenth at most; those of N and
                  N log N do by 0.15 */
};

/* How many rows there are; and row k, from 0, counted anew. False if memory
 * runs out. */
int sorts_rows(void);
bool sorts_row(int k, struct sorts_row *row);

/* Prints all of them. False if memory runs out. */
bool sorts_print(void);

#endif
