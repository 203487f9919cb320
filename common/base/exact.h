// SPDX-License-Identifier: GPL-3.0-or-later
// The two number types that the core's C++ files use to decide a sign:
// intervals, which may leave the sign open, and exact numbers.
//
// Exact       integers times powers of two. Their sums, differences and
//             products are exact. Their exponents have no limit as those of
//             doubles have.
// Memory      numbers cannot fail. If memory runs out they have a reserve
//             (number_memory.cc); if that is used up, the program ends.
#ifndef HSR_COMMON_BASE_EXACT_H
#define HSR_COMMON_BASE_EXACT_H

#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>

#include <cmath>

namespace hsr {

// Only for use while the rounding mode is upwards, as CGAL sets it.
using Interval = CGAL::Interval_nt<false>;
using Exact = CGAL::Mpzf;

// For use in any rounding mode: each operation sets and restores it.
using Safe_interval = CGAL::Interval_nt<true>;

// x times 2^exponent. If that is below the normal doubles or above all doubles,
// the result is moved by one double towards `to`, so that rounding is outward.
inline double scaled(double x, double exponent, double to) {
  const double y =
      std::ldexp(x, int(std::fmax(-3000, std::fmin(exponent, 3000))));
  return x == 0 || (std::fabs(y) >= 0x1p-1022 && std::isfinite(y))
             ? y
             : std::nextafter(y, to);
}
inline Safe_interval scaled_outward(const Safe_interval &x, double exponent) {
  return {scaled(x.inf(), exponent, -INFINITY),
          scaled(x.sup(), exponent, INFINITY)};
}

// x as a quotient of integers in lowest terms. The denominator is a power of
// two, so the numerator or the denominator is odd.
inline CGAL::Gmpq fraction(const Exact &x) {
  return CGAL::Gmpq(x);
}

// Returns an interval that holds x / 2^*exponent, and sets *exponent. The size
// of each end is 0 or from 1/2 to 1. Both ends are equal if x has 53 binary
// digits or fewer.
inline Safe_interval leading_digits(const Exact &x, long *exponent) {
  const CGAL::Gmpq whole = fraction(x);
  const mpz_srcptr digits = mpq_numref(whole.mpq());
  const double towards_zero = mpz_get_d_2exp(exponent, digits);
  *exponent -= long(mpz_sizeinbase(mpq_denref(whole.mpq()), 2)) - 1;
  if (mpz_sgn(digits) == 0 ||
      mpz_sizeinbase(digits, 2) - mpz_scan1(digits, 0) <= 53)
    return towards_zero;
  const double ulp = 0x1p-53; // of a number from 1/2 to 1
  return towards_zero < 0 ? Safe_interval(towards_zero - ulp, towards_zero)
                          : Safe_interval(towards_zero, towards_zero + ulp);
}

// An interval that holds x.
inline Interval interval_of(const Exact &x) {
  long digits;
  const Safe_interval part = leading_digits(x, &digits);
  const Safe_interval held = scaled_outward(part, double(digits));
  return {held.inf(), held.sup()};
}

// An interval that holds a / b; b must not be 0. The leading digits are divided
// first, and the quotient is scaled after that. The reason: exact numbers have
// no least exponent, but doubles have one, and the product of a few coordinates
// below 2^-300 is below the least double.
inline Safe_interval quotient(const Exact &a, const Exact &b) {
  long digits_a, digits_b;
  const Safe_interval part =
      leading_digits(a, &digits_a) / leading_digits(b, &digits_b);
  return scaled_outward(part, double(digits_a) - double(digits_b));
}

inline Safe_interval quotient(const Interval &a, const Interval &b) {
  return Safe_interval(a.inf(), a.sup()) / Safe_interval(b.inf(), b.sup());
}

} // namespace hsr

#endif
