/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/tables/growth.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>
#include <math.h>

enum { MOST_POINTS = 64 };

struct growth growth_fit(const double *x, const double *y, int n) {
  double u[MOST_POINTS], v[MOST_POINTS];
  struct growth g = {NAN, NAN, NAN, 0};
  for (int k = 0; k < n && g.n < MOST_POINTS; k++)
    if (x[k] > 0 && y[k] > 0 && isfinite(x[k]) && isfinite(y[k])) {
      u[g.n] = log(x[k]);
      v[g.n++] = log(y[k]);
    }
  if (g.n < 2)
    return g;
  double constant, slope, cov00, cov01, variance, left_over;
  gsl_fit_linear(u, 1, v, 1, (size_t)g.n, &constant, &slope, &cov00, &cov01,
                 &variance, &left_over);
  if (!isfinite(slope))
    return g;
  g.exponent = slope;
  if (g.n > 2) {
    double half = gsl_cdf_tdist_Pinv(0.975, g.n - 2) * sqrt(variance);
    g.low = slope - half;
    g.high = slope + half;
  }
  return g;
}
