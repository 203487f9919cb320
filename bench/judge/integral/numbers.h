/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Intervals of what the integral needs: logarithms, exponentials, and how much a
 * path emits. All only while doubles are rounded upwards (../rounding.h). */
#ifndef HSR_BENCH_JUDGE_INTEGRAL_NUMBERS_H
#define HSR_BENCH_JUDGE_INTEGRAL_NUMBERS_H

#include "bench/judge/rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace integral {

using judge::Interval;

constexpr double infinity = std::numeric_limits<double>::infinity();

inline double width(const Interval &x) {
  return x.sup() - x.inf();
}

inline Interval hull(const Interval &a, const Interval &b) {
  return {std::min(a.inf(), b.inf()), std::max(a.sup(), b.sup())};
}

/* What is in both. They have a number in common, up to faults of this code,
 * which would show as an interval of everything. */
inline Interval common(const Interval &a, const Interval &b) {
  const double lo = std::max(a.inf(), b.inf()), hi = std::min(a.sup(), b.sup());
  return lo <= hi ? Interval(lo, hi) : Interval(-infinity, infinity);
}

/* The same of one that may hold NaN, which says nothing. */
inline Interval narrowed(const Interval &a, const Interval &b) {
  return std::isnan(b.inf()) || std::isnan(b.sup()) ? a : common(a, b);
}

inline Interval clamped(const Interval &x, double lo, double hi) {
  return {std::min(std::max(x.inf(), lo), hi),
          std::max(std::min(x.sup(), hi), lo)};
}

/* ln 2: the double below it and the next. */
inline Interval ln2() {
  return {0x1.62e42fefa39efp-1, 0x1.62e42fefa39f0p-1};
}

/* 1 / n of 1 <= n < 32. The table is made while doubles are rounded upwards. */
inline const Interval &inverse_of(int n) {
  static const std::array<Interval, 32> table = [] {
    std::array<Interval, 32> made;
    for (int k = 1; k < 32; k++)
      made[size_t(k)] = Interval(1) / Interval(k);
    return made;
  }();
  return table[size_t(n)];
}

/* exp(-x) of x >= 0, which may be infinite. With n near x / ln 2 and r = n ln 2 - x
 * it is 2^-n exp(r), and |r| < .36: the sum of r^k / k! for k < 14, and a rest
 * below 2^-56. Below 2^-1000 nothing is told apart. */
inline Interval exp_minus(double x) {
  if (!(x < 700))
    return {0, 0x1p-1000};
  const double n = std::floor(x * 1.4426950408889634 + 0.5);
  const Interval r = Interval(n) * ln2() - Interval(x);
  Interval sum(1);
  for (int k = 13; k > 0; k--)
    sum = Interval(1) + sum * r * inverse_of(k);
  sum = sum + Interval(-0x1p-56, 0x1p-56);
  const double scale = std::ldexp(1, -int(n)); /* products with it are exact */
  return clamped(Interval(sum.inf() * scale, sum.sup() * scale), 0, 1);
}

inline Interval exp_minus(const Interval &x) {
  return {exp_minus(x.sup()).inf(), exp_minus(x.inf()).sup()};
}

/* -ln y of 0 <= y <= 1. With y = 2^e m, m from .7 to 1.42, and z = (m - 1) / (m +
 * 1), |z| < .18, ln m is 2 z times the sum of z^(2 k) / (2 k + 1), of which all
 * from k = 12 on is less than 2^-60. */
inline Interval minus_log(double y) {
  if (!(y > 0))
    return {infinity, infinity};
  int e;
  double m = std::frexp(y, &e);
  if (m < 0.7071)
    m *= 2, e--;
  const Interval z = (Interval(m) - Interval(1)) / (Interval(m) + Interval(1));
  const Interval square = CGAL::square(z);
  Interval sum(0);
  for (int k = 11; k >= 0; k--)
    sum = sum * square + inverse_of(2 * k + 1);
  sum = sum + Interval(0, 0x1p-60);
  const Interval log = Interval(2) * z * sum + Interval(e) * ln2();
  return {std::max(-log.sup(), 0.0), std::max(-log.inf(), 0.0)};
}

/* Derivatives by orders, divided by their factorials. */
constexpr int ORDERS = 5;
using series = std::array<Interval, ORDERS>;

/* Of -ln(1 - a) at `a` from 0 to below 1. */
inline void log_series(double a, int orders, series *f) {
  const Interval left = Interval(1) - Interval(a), inverse = Interval(1) / left;
  (*f)[0] = minus_log(left.sup());
  if (left.inf() < left.sup())
    (*f)[0] = hull((*f)[0], minus_log(left.inf()));
  Interval power(1);
  for (int k = 1; k < orders; k++) {
    power = power * inverse;
    (*f)[size_t(k)] = power * inverse_of(k);
  }
}

/* The first terms binomial(n + k, k) / (n + k + 1) of g_k as a sum of powers of a,
 * n < TERMS. Each further one is less than the one before it times 1.2; the first
 * of them, of n = 20 and k = 4, is 425. So for a <= 1/8 all of them add up to less
 * than 512 a^20. */
constexpr int TERMS = 20;
using emission_terms = std::array<std::array<Interval, TERMS>, ORDERS>;
inline const emission_terms &terms_of_emission() {
  static const emission_terms table = [] {
    emission_terms made;
    for (int k = 0; k < ORDERS; k++) {
      double binomial = 1; /* exact: small, and each division is, too */
      for (int n = 0; n < TERMS; n++) {
        made[size_t(k)][size_t(n)] = Interval(binomial) / Interval(n + k + 1);
        binomial = binomial * (n + 1 + k) / (n + 1);
      }
    }
    return made;
  }();
  return table;
}

/* Of g(a) = -ln(1 - a) / a, which is 1 + a/2 + a^2/3 + ..., at `a`; `log` is
 * log_series there. From a g = -ln(1 - a) follows a g_k + g_{k-1} = log_k. */
inline void emission_series(double a, const series &log, int orders,
                            series *g) {
  if (a > 0.125) {
    (*g)[0] = log[0] / Interval(a);
    for (size_t k = 1; k < size_t(orders); k++)
      (*g)[k] = (log[k] - (*g)[k - 1]) / Interval(a);
    return;
  }
  const emission_terms &terms = terms_of_emission();
  for (size_t k = 0; k < size_t(orders); k++) {
    Interval sum(0, 512);
    for (size_t n = TERMS; n-- > 0;)
      sum = sum * Interval(a) + terms[k][n];
    (*g)[k] = sum;
  }
}

/* Both over an interval: all their derivatives are positive and ascend. */
struct emission {
  series log, g;

  emission(const Interval &a, int orders) {
    const double lo = std::max(a.inf(), 0.0), hi = std::min(a.sup(), 1.0);
    log_series(lo, orders, &log);
    emission_series(lo, log, orders, &g);
    if (hi <= lo)
      return;
    series above, g_above;
    log_series(hi, orders, &above);
    emission_series(hi, above, orders, &g_above);
    for (size_t k = 0; k < size_t(orders); k++) {
      log[k] = Interval(log[k].inf(), above[k].sup());
      g[k] = Interval(g[k].inf(), g_above[k].sup());
    }
  }
};

} // namespace integral

#endif
