/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Test Anything Protocol, for the test programs: they call plan(n), then ok() n
 * times, and exit with the status of finish(). */
#ifndef HSR_TESTS_TAP_H
#define HSR_TESTS_TAP_H

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

struct tap {
  int planned, run, failed;
};

static inline struct tap plan(int n) {
  printf("1..%d\n", n);
  return (struct tap){n, 0, 0};
}

/* One test point with a printf description; returns whether it passed. */
static inline bool ok(struct tap *tap, bool passed, const char *format, ...) {
  va_list args;
  tap->run++;
  tap->failed += !passed;
  printf("%sok %d - ", passed ? "" : "not ", tap->run);
  va_start(args, format);
  vprintf(format, args);
  va_end(args);
  putchar('\n');
  fflush(stdout);
  return passed;
}

/* Ends a test that cannot be set up, with a printf text of why. */
__attribute__((noreturn, format(printf, 1, 2))) static inline void
bail(const char *format, ...) {
  va_list args;
  va_start(args, format);
  printf("Bail out! ");
  vprintf(format, args);
  va_end(args);
  putchar('\n');
  exit(99);
}

/* The exit status. */
static inline int finish(const struct tap *tap) {
  if (tap->run != tap->planned)
    printf("# planned %d tests, ran %d\n", tap->planned, tap->run);
  return tap->failed || tap->run != tap->planned;
}

#endif
