/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sorts and searches of the survey's chapter II: they sort, counts that can
 * be told in advance, and which orders of growth the counts bear out. Shell's
 * sort grows more slowly than N^3/2, which is its worst case. Records nearly in
 * sort take N log N in his sort, and in a tree that is entered at its root; the
 * survey has N. */
#include "bench/tables/sorts.h"
#include "tests/tap.h"

#include <math.h>
#include <string.h>

static void check(struct tap *tap, const char *method, const char *order,
                  double least, double most, bool agrees) {
  struct sorts_row row;
  for (int k = 0; k < sorts_rows(); k++) {
    if (!sorts_row(k, &row) || strcmp(row.method, method) ||
        strcmp(row.order, order))
      continue;
    ok(tap, row.count[0] >= least && row.count[0] <= most,
       "%s, %s: %g comparisons of 64 records", method, order, row.count[0]);
    ok(tap, row.agrees == agrees, "%s, %s: N^%.2f, by the survey N^%.2f",
       method, order, row.measured.exponent, row.survey.exponent);
    return;
  }
  ok(tap, false, "%s, %s: there is no such row", method, order);
}

int main(void) {
  struct tap tap = plan(1 + 2 * 14);
  bool sorted = true;
  struct sorts_row row;
  for (int k = 0; k < sorts_rows(); k++)
    if (sorts_row(k, &row) && !strcmp(row.table, "Sorts"))
      sorted &= row.sorted;
  ok(&tap, sorted, "all of them sort");
  check(&tap, "Bubble sort", "random", 63, 64 * 63 / 2 + 63, true);
  check(&tap, "Bubble sort", "nearly in sort", 63, 63 + 2 * 4, true);
  check(&tap, "Shell sort", "random", 6 * 64 - 120, 1000, false);
  check(&tap, "Shell sort", "nearly in sort", 6 * 64 - 126, 400, false);
  check(&tap, "Quick sort", "random", 64 * 6 - 128, 64 * 6 * 2, true);
  check(&tap, "Quick sort", "nearly in sort", 1000, 64 * 63 / 2, true);
  check(&tap, "Tree sort", "random", 200, 64 * 6 * 2, true);
  check(&tap, "Tree sort", "nearly in sort", 200, 64 * 6 * 2, false);
  check(&tap, "Radix sort", "random", 4 * 64, 4 * 64, true);
  check(&tap, "Radix sort", "nearly in sort", 4 * 64, 4 * 64, true);
  check(&tap, "Sequential, unordered", "random", 64, 64, true);
  check(&tap, "Sequential, ordered", "random", 25, 40, true);
  check(&tap, "Binary search", "random", 6, 7, true);
  check(&tap, "Binary tree", "random", 6, 14, true);
  return finish(&tap);
}
