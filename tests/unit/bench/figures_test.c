/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statistics of samples whose truth is known: times with a median of 1, spread
 * log-normally within each start and also between starts. */
#include "bench/results/figures.h"
#include "tests/tap.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdlib.h>

enum { EACH = 9, TRIALS = 2000 };

static gsl_rng *randoms;

/* The spread of logarithms between starts, and of samples within one. */
static const double between = .03, within = .02;

static struct samples draw(double *seconds, int starts, double median) {
  for (int s = 0; s < starts; s++) {
    double luck = gsl_ran_gaussian(randoms, between);
    for (int k = 0; k < EACH; k++)
      seconds[s * EACH + k] =
          median * exp(luck + gsl_ran_gaussian(randoms, within));
  }
  return (struct samples){seconds, starts, EACH};
}

static void draw_logs(double *logs, int starts, double median) {
  double seconds[FIGURES_MOST_STARTS * EACH];
  struct samples samples = draw(seconds, starts, median);
  if (!figure_logs(&samples, logs))
    exit(99);
}

static bool holds(const struct figure *f, double truth) {
  return f->low <= truth && truth <= f->high;
}

/* --- Plain values --------------------------------------------------------- */

static void test_values(struct tap *tap) {
  const double seconds[] = {5, 1, 3, 2, 8, 4};
  struct samples odd = {seconds, 1, 5}, even = {seconds, 2, 3};
  struct figure f, again;
  ok(tap, figure_median(&odd, &f) && f.value == 3, "the median of five");
  ok(tap, figure_median(&even, &f) && f.value == 3.5, "the median of six");
  ok(tap,
     figure_median(&even, &again) && again.low == f.low &&
         again.high == f.high && f.low >= 1 && f.high <= 8 && f.low < f.value &&
         f.value < f.high,
     "its interval is about it, and always the same");
  ok(tap, figure_least(&even) == 1, "the least");
  double logs[2];
  ok(tap,
     figure_logs(&even, logs) && fabs(logs[0] - log(3)) < 1e-15 &&
         fabs(logs[1] - log(4)) < 1e-15,
     "the medians of starts, as logarithms");
}

/* By hand: t(.995) is 4.6041 for 4 degrees of freedom. */
static void test_intervals(struct tap *tap) {
  const double five[] = {-.02, -.01, 0, .01, .02};
  struct figure f = figure_of_logs(five, 2),
                g = figure_quotient(five, 5, five, 2);
  ok(tap,
     fabs(f.value - exp(-.015)) < 1e-12 && isnan(f.low) && isnan(f.high) &&
         isnan(g.low) && !figure_distinguishable(&f) &&
         !figure_distinguishable(&g),
     "two starts tell nothing");
  f = figure_of_logs(five, 5);
  ok(tap, fabs(f.high - exp(4.6041 * sqrt(.00025 / 5))) < 1e-5,
     "five tell something");
  /* Equal spread and number: twice the degrees of freedom, 8: t is 3.3554. */
  const double more[] = {.98, .99, 1, 1.01, 1.02};
  f = figure_quotient(more, 5, five, 5);
  ok(tap,
     fabs(f.value - exp(1)) < 1e-12 &&
         fabs(f.low - exp(1 - 3.3554 * sqrt(2 * .00025 / 5))) < 1e-4,
     "the quotient of two sets");
  f = figure_quotient(five, 5, five, 5);
  ok(tap, f.value == 1 && !figure_distinguishable(&f),
     "a set is not distinguishable from itself");
  const double same[] = {.5, .5, .5};
  f = figure_quotient(same, 3, same, 3);
  ok(tap,
     f.value == 1 && f.low == 1 && f.high == 1 && !figure_distinguishable(&f),
     "nor one without spread");
}

/* --- How often they are right --------------------------------------------- */

static double median_coverage(int starts) {
  int held = 0;
  for (int k = 0; k < TRIALS / 4; k++) {
    double seconds[FIGURES_MOST_STARTS * EACH];
    struct samples samples = draw(seconds, starts, 1);
    struct figure f;
    if (!figure_median(&samples, &f))
      exit(99);
    held += holds(&f, 1);
  }
  return 4.0 * held / TRIALS;
}

static double logs_coverage(int starts) {
  int held = 0;
  for (int k = 0; k < TRIALS; k++) {
    double logs[FIGURES_MOST_STARTS];
    draw_logs(logs, starts, 1);
    struct figure f = figure_of_logs(logs, starts);
    held += holds(&f, 1);
  }
  return (double)held / TRIALS;
}

/* The share of pairs that are found distinguishable, in the right direction. */
static double distinguished(int starts, double ratio) {
  int told = 0;
  for (int k = 0; k < TRIALS; k++) {
    double a[FIGURES_MOST_STARTS], b[FIGURES_MOST_STARTS];
    draw_logs(a, starts, ratio);
    draw_logs(b, starts, 1);
    struct figure f = figure_quotient(a, starts, b, starts);
    told += figure_distinguishable(&f) &&
            (ratio == 1 || (f.value > 1) == (ratio > 1));
  }
  return (double)told / TRIALS;
}

static bool is_between(double low, double x, double high) {
  return low <= x && x <= high;
}

/* With 500 and 2000 trials a standard deviation is .01 and .002. */
static void test_coverage(struct tap *tap) {
  double two = median_coverage(2), five = median_coverage(5),
         twenty = median_coverage(20);
  ok(tap, is_between(.92, five, .99), "5 starts: %.3f of 95 %% intervals hold",
     five);
  ok(tap, is_between(.92, twenty, .99), "20 starts: %.3f", twenty);
  ok(tap, is_between(.75, two, .99), "2 starts are too few for 95 %%: %.3f",
     two);
  static const int starts[] = {3, 5, 20};
  for (int k = 0; k < 3; k++) {
    double held = logs_coverage(starts[k]);
    ok(tap, is_between(.98, held, .998),
       "%d starts: %.4f of 99 %% intervals of a ratio hold", starts[k], held);
  }
}

static void test_distinction(struct tap *tap) {
  double same = distinguished(5, 1), three = distinguished(3, 1),
         slower = distinguished(5, 1.2), faster = distinguished(5, 1 / 1.2),
         little = distinguished(5, 1.005), many = distinguished(64, 1.03);
  ok(tap, same < .02, "5 starts of the same are told apart in %.4f", same);
  ok(tap, three < .02, "3 starts, in %.4f", three);
  ok(tap, slower > .95, "what is slower by a fifth, in %.4f", slower);
  ok(tap, faster > .95, "what is faster, in %.4f", faster);
  ok(tap, little < .05, "what is slower by half a percent, in %.4f", little);
  ok(tap, many > .9, "64 starts tell three percent, in %.4f", many);
}

int main(void) {
  struct tap tap = plan(5 + 5 + 6 + 6);
  randoms = gsl_rng_alloc(gsl_rng_mt19937);
  test_values(&tap);
  test_intervals(&tap);
  test_coverage(&tap);
  test_distinction(&tap);
  gsl_rng_free(randoms);
  return finish(&tap);
}
