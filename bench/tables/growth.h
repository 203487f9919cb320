/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a cost grows: the exponent e of y ~ x^e, by least squares over the
 * logarithms, and the interval that holds it with 95 % of certainty if what is
 * left over is normal. */
#ifndef HSR_BENCH_GROWTH_H
#define HSR_BENCH_GROWTH_H

struct growth {
  double exponent;  /* NAN: of fewer than two different x */
  double low, high; /* NAN: of fewer than three points */
  int n;            /* points that the fit is of */
};

/* Points where x or y is not above 0, or not a number, are left out, and those
 * beyond the first 64. */
struct growth growth_fit(const double *x, const double *y, int n);

#endif
