/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a cost grows: the exponent e of y ~ x^e, by least squares over the
 * logarithms, with its 95 % interval. The interval assumes that the residuals
 * are normal. */
#ifndef HSR_BENCH_GROWTH_H
#define HSR_BENCH_GROWTH_H

struct growth {
  double exponent;  /* NAN if there are fewer than two different x */
  double low, high; /* NAN if there are fewer than three points */
  int n;            /* points in the fit */
};

/* Leaves out points whose x or y is not a number above 0, and all points after
 * the first 64. */
struct growth growth_fit(const double *x, const double *y, int n);

#endif
