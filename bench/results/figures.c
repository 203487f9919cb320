/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Source: B. Efron and R. J. Tibshirani, An Introduction to the Bootstrap,
 * 1993, chapter 13 (percentile intervals) and section 8.3 (samples of two
 * levels); T. C. Hesterberg, What Teachers Should Know About the Bootstrap, The
 * American Statistician 69 (2015), for percentiles farther out, which correct
 * for a small number of starts; B. L. Welch, Biometrika 34 (1947), for two sets
 * of unequal spread.
 *
 * Ratios are judged at 99 %, not 95 %, since a table shows hundreds at once.
 * They are judged by t, not by the bootstrap, whose intervals are too short for
 * only a few starts. */
#include "bench/results/figures.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_statistics.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RESAMPLES = 4000, LEAST_STARTS = 3 /* two tell nothing at 99 % */ };

/* The median; changes the order of the values. */
static double median_of(double *values, int n) {
  return gsl_stats_median(values, 1, (size_t)n);
}

double figure_least(const struct samples *s) {
  return gsl_stats_min(s->seconds, 1, (size_t)(s->starts * s->each));
}

/* --- Medians -------------------------------------------------------------- */

static void draw_resample(const struct samples *s, const gsl_rng *random,
                          double *out) {
  for (int k = 0; k < s->starts; k++) {
    size_t start = gsl_rng_uniform_int(random, (unsigned long)s->starts);
    gsl_ran_sample(random, out + k * s->each, (size_t)s->each,
                   (void *)(s->seconds + start * (size_t)s->each),
                   (size_t)s->each, sizeof *out);
  }
}

/* The share of the resamples that is left out at either end of a 95 % interval.
 * The bootstrap alone leaves out .025. But the spread among n starts is too
 * small by (n - 1) / n, and so uncertain that Student's t takes the place of
 * the normal distribution. */
static double tail_share(int starts) {
  if (starts < 2)
    return .025;
  double t = gsl_cdf_tdist_Pinv(.975, starts - 1);
  return gsl_cdf_ugaussian_P(-t * sqrt(starts / (starts - 1.0)));
}

/* The value below which `share` of n values lie, between two of them in
 * proportion, as gsl_stats_quantile_from_sorted_data has it; but without
 * sorting, which would take longer than all else. Changes their order. */
static double quantile(double *values, size_t n, double share) {
  double place = share * (double)(n - 1);
  size_t below = (size_t)place;
  double part = place - (double)below;
  double low = gsl_stats_select(values, 1, n, below);
  if (below + 1 == n)
    return low;
  return (1 - part) * low + part * gsl_stats_select(values, 1, n, below + 1);
}

bool figure_median(const struct samples *s, struct figure *median) {
  int n = s->starts * s->each;
  gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937); /* always the same seed */
  double *values = malloc((size_t)n * sizeof *values);
  double *medians = malloc(RESAMPLES * sizeof *medians);
  bool good = random && values && medians;
  if (good) {
    for (int k = 0; k < RESAMPLES; k++) {
      draw_resample(s, random, values);
      medians[k] = median_of(values, n);
    }
    memcpy(values, s->seconds, (size_t)n * sizeof *values);
    double tail = tail_share(s->starts);
    *median = (struct figure){.value = median_of(values, n),
                              .low = quantile(medians, RESAMPLES, tail),
                              .high = quantile(medians, RESAMPLES, 1 - tail)};
  }
  free(medians);
  free(values);
  if (random)
    gsl_rng_free(random);
  return good;
}

/* --- Ratios --------------------------------------------------------------- */

bool figure_logs(const struct samples *s, double *logs) {
  double *values = malloc((size_t)s->each * sizeof *values);
  for (int k = 0; values && k < s->starts; k++) {
    memcpy(values, s->seconds + k * s->each, (size_t)s->each * sizeof *values);
    logs[k] = log(median_of(values, s->each));
  }
  free(values);
  return values != NULL;
}

static struct figure interval(double mean, double error, double freedom) {
  double t = gsl_cdf_tdist_Pinv(.995, freedom);
  return (struct figure){exp(mean), exp(mean - t * error),
                         exp(mean + t * error)};
}

struct figure figure_of_logs(const double *logs, int n) {
  double mean = gsl_stats_mean(logs, 1, (size_t)n);
  if (n < LEAST_STARTS)
    return (struct figure){exp(mean), NAN, NAN};
  double spread = gsl_stats_sd(logs, 1, (size_t)n);
  return interval(mean, spread / sqrt(n), n - 1);
}

struct figure figure_quotient(const double *a, int n, const double *b, int m) {
  double mean =
      gsl_stats_mean(a, 1, (size_t)n) - gsl_stats_mean(b, 1, (size_t)m);
  if (n < LEAST_STARTS || m < LEAST_STARTS)
    return (struct figure){exp(mean), NAN, NAN};
  double va = gsl_stats_variance(a, 1, (size_t)n) / n;
  double vb = gsl_stats_variance(b, 1, (size_t)m) / m;
  double all = va + vb;
  double freedom =
      all > 0 ? all * all / (va * va / (n - 1) + vb * vb / (m - 1)) : n + m - 2;
  return interval(mean, sqrt(all), freedom);
}

bool figure_has_interval(const struct figure *figure) {
  return !isnan(figure->low);
}

bool figure_distinguishable(const struct figure *ratio) {
  return ratio->low > 1 || ratio->high < 1;
}
