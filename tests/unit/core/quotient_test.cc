/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact numbers and their quotients as intervals, from the least doubles to the
 * greatest and beyond both. */
#include "common/base/exact.h"

#include <cfloat>
#include <cstdio>
#include <random>

namespace {

using hsr::Exact;
using Safe = CGAL::Interval_nt<true>;

int n_tests, n_failed;

void ok(bool good, const char *what) {
  std::printf("%s %d - %s\n", good ? "ok" : "not ok", ++n_tests, what);
  n_failed += !good;
}

std::mt19937_64 random_bits(1);

int whole(int lo, int hi) {
  return std::uniform_int_distribution<int>(lo, hi)(random_bits);
}

// A number of up to 53 digits, not 0, times a power of two.
double number(int least, int most) {
  double digits = double(random_bits() >> whole(11, 63)) + 1;
  return std::ldexp(whole(0, 1) ? digits : -digits, whole(least, most));
}

Exact product(int n, int least, int most) {
  Exact all = 1;
  for (; n; n--)
    all = all * Exact(number(least, most));
  return all;
}

// Whether x <= a / b, or x >= a / b if side is 1. What is infinite is.
bool bounds(double x, int side, const Exact &a, const Exact &b) {
  if (std::isinf(x))
    return (x > 0) == (side > 0);
  const int over = int(CGAL::sign(Exact(x) * b - a)) * int(CGAL::sign(b));
  return over * side >= 0;
}

bool holds(const Safe &x, const Exact &a, const Exact &b) {
  return bounds(x.inf(), -1, a, b) && bounds(x.sup(), 1, a, b);
}

void check_quotients() {
  bool held = true, narrow = true;
  int outside = 0;
  for (int k = 0; k < 4000; k++) {
    const int n = whole(1, 4), m = whole(1, 4);
    const Exact a = product(n, -1070, 900), b = product(m, -1070, 900);
    const Safe x = hsr::quotient(a, b);
    held &= holds(x, a, b);
    outside += std::isinf(x.inf()) || std::isinf(x.sup()) ||
               (x.inf() <= DBL_MIN && x.sup() >= -DBL_MIN);
  }
  ok(held, "an interval holds the quotient");
  ok(outside > 1000, "also one that is no normal double");
  for (int k = 0; k < 4000; k++) {
    const Exact far = product(whole(1, 3), -1070, -900);
    const Exact a = far * Exact(number(-40, 40)),
                b = far * Exact(number(-40, 40));
    const Safe x = hsr::quotient(a, b);
    held &= holds(x, a, b);
    narrow &= x.sup() - x.inf() <= 0x1p-48 * std::fabs(x.inf());
  }
  ok(held && narrow, "it is narrow, even if both are far below all doubles");
}

void check_numbers() {
  bool held = true, narrow = true, exact = true, odd = true;
  for (int k = 0; k < 4000; k++) {
    const Exact wide = product(whole(1, 4), -1070, 900);
    const hsr::Interval x = hsr::interval_of(wide);
    held &= bounds(x.inf(), -1, wide, 1) && bounds(x.sup(), 1, wide, 1);
    const Exact near = product(whole(2, 4), -100, 100);
    const hsr::Interval y = hsr::interval_of(near);
    held &= bounds(y.inf(), -1, near, 1) && bounds(y.sup(), 1, near, 1);
    narrow &= y.sup() - y.inf() <= 0x1p-51 * std::fabs(y.inf());
    const double z = number(-1000, 900);
    exact &= hsr::interval_of(Exact(z)).inf() == z &&
             hsr::interval_of(Exact(z)).sup() == z;
    const double even = 0x1p53 + 2 * whole(0, 1 << 30);
    const hsr::Interval v = hsr::interval_of(Exact(even) + Exact(1));
    odd &= v.inf() == even && v.sup() == even + 2;
  }
  ok(held, "an interval holds the number, also one that is no double");
  ok(narrow, "it is narrow");
  ok(exact, "a double is an interval of no width");
  ok(odd, "an integer of 54 digits lies between two doubles");
}

void check_scaled() {
  bool held = true, exact = true;
  for (int k = 0; k < 4000; k++) {
    const double x = number(-60, 60);
    const int exponent = whole(-1200, 1200);
    const double below = hsr::scaled(x, exponent, -INFINITY),
                 above = hsr::scaled(x, exponent, INFINITY);
    const long double scaled = std::ldexp((long double)x, exponent);
    held &= below <= scaled && scaled <= above;
    if (std::fabs(scaled) >= DBL_MIN && std::fabs(scaled) <= DBL_MAX)
      exact &= below == above;
  }
  ok(held, "a number times a power of two, rounded either way");
  ok(exact, "exactly, where that is a normal double");
  ok(hsr::scaled(0, -3000, INFINITY) == 0 &&
         hsr::scaled(0, 3000, -INFINITY) == 0,
     "0 stays 0");
}

void check_intervals() {
  bool held = true;
  for (int k = 0; k < 4000; k++) {
    const double a = number(-60, 60), b = number(-60, 60);
    hsr::Interval x, y;
    {
      CGAL::Protect_FPU_rounding<true> upwards;
      x = hsr::Interval(a, a + std::fabs(a) * 0x1p-40);
      y = hsr::Interval(b, b + std::fabs(b) * 0x1p-40);
    }
    const Safe q = hsr::quotient(x, y);
    for (double p : {x.inf(), x.sup()})
      for (double r : {y.inf(), y.sup()})
        held &= holds(q, Exact(p), Exact(r));
  }
  ok(held, "of intervals, an interval holds all quotients");
}

} // namespace

int main() {
  check_quotients();
  check_numbers();
  check_scaled();
  check_intervals();
  std::printf("1..%d\n", n_tests);
  return n_failed != 0;
}
