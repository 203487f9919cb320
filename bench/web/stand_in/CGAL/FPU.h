// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's arithmetic of intervals, where there is but one mode of rounding: to nearest.
// CGAL would widen every result by a double. Here the error of each operation is
// computed, and the result goes to the double above only if it lies below the exact
// one. So an interval is the same as with hardware that rounds upwards, to the last
// bit; and so are all that follows from it, coordinates and counts.
//
//   a + b   Knuth's error of a sum, which is exact (The Art of Computer Programming
//           2, 4.2.2, theorem C)
//   a b     Dekker's error of a product (Numerische Mathematik 18, 1971), where no
//           part of it is out of range; else a fused multiply-add, if need be of
//           numbers that are scaled by a power of 2, tells its sign
//   a / b   the sign of a - q b, and of b. The remainder is a double
//   sqrt x  the sign of x - s s, which is a double
#ifndef HSR_WEB_FPU_H
#define HSR_WEB_FPU_H

// CGAL's file has its own functions under these names, which nobody then calls.
#include_next <CGAL/FPU.h>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace CGAL {
namespace upward {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();
constexpr double small = 0x1p-900, great = 0x1p990, scale = 0x1p540;

// The double above a finite x.
inline double above(double x) {
  std::int64_t bits;
  if (x == 0)
    return std::numeric_limits<double>::denorm_min();
  std::memcpy(&bits, &x, sizeof bits);
  bits += x > 0 ? 1 : -1;
  std::memcpy(&x, &bits, sizeof bits);
  return x;
}

// What is not finite: upwards, finite numbers never give -infinity.
inline double beyond(double result, bool is_finite) {
  return is_finite && result == -infinity ? -largest : result;
}

inline bool is_finite(double x) {
  return std::fabs(x) <= largest;
}

inline double sum(double a, double b) {
  const double s = a + b;
  if (!is_finite(s))
    return beyond(s, is_finite(a) && is_finite(b));
  const double c = s - a, error = (a - (s - c)) + (b - c);
  return error > 0 ? above(s) : s;
}

struct Halves {
  double high, low;
  explicit Halves(double x) {
    const double c = 0x8000001p0 * x;
    high = c - (c - x);
    low = x - high;
  }
};

// a b - p, where p is the product that was rounded, and nothing is out of range.
inline double product_error(double a, double b, double p) {
  const Halves x(a), y(b);
  return x.low * y.low -
         (((p - x.high * y.high) - x.low * y.high) - x.high * y.low);
}

inline bool is_usual(double a, double b, double p) {
  const double least = std::fabs(p);
  return least > small && std::fabs(a) < great && std::fabs(b) < great;
}

// A number of the sign of a b + c, which is about as small as a rounding error of
// both: 0 only if that is exactly 0.
inline double sign(double a, double b, double c) {
  if (std::fabs(c) > small)
    return std::fma(a, b, c);
  double &less = std::fabs(a) < std::fabs(b) ? a : b;
  less *= scale;
  less *= scale;
  return std::fma(a, b, c * scale * scale);
}

inline double product(double a, double b) {
  const double p = a * b;
  if (!is_finite(p))
    return beyond(p, is_finite(a) && is_finite(b));
  if (a == 0 || b == 0)
    return p;
  const double error =
      is_usual(a, b, p) ? product_error(a, b, p) : sign(a, b, -p);
  return error > 0 ? above(p) : p;
}

inline double quotient(double a, double b) {
  const double q = a / b;
  if (!is_finite(q))
    return beyond(q, is_finite(a) && b != 0);
  if (a == 0 || !is_finite(b))
    return q;
  double rest;
  if (is_usual(q, b, a)) {
    const double p = q * b;
    rest = (a - p) - product_error(q, b, p);
  } else {
    rest = sign(-q, b, a);
  }
  return (b > 0 ? rest > 0 : rest < 0) ? above(q) : q;
}

// How far a root that was rounded is off: a number of the sign of x - s s.
inline double root_rest(double x, double s) {
  return sign(-s, s, x);
}

inline double root(double x) {
  const double s = std::sqrt(x);
  return is_finite(s) && s > 0 && root_rest(x, s) > 0 ? above(s) : s;
}

// The root of x, downwards; 0 below 0.
inline double root_below(double x) {
  const double s = x > 0 ? std::sqrt(x) : 0;
  return is_finite(s) && s > 0 && root_rest(x, s) < 0 ? -above(-s) : s;
}

} // namespace upward
} // namespace CGAL

#undef CGAL_IA_ADD
#undef CGAL_IA_SUB
#undef CGAL_IA_MUL
#undef CGAL_IA_DIV
#define CGAL_IA_ADD(a, b) CGAL::upward::sum(a, b)
#define CGAL_IA_SUB(a, b) CGAL::upward::sum(a, -(b))
#define CGAL_IA_MUL(a, b) CGAL::upward::product(a, b)
#define CGAL_IA_DIV(a, b) CGAL::upward::quotient(a, b)
#define CGAL_IA_SQUARE(a) CGAL::upward::product(a, a)
#define IA_sqrt_up(a) upward::root(a)
#define IA_sqrt_toward_zero(a) upward::root_below(a)

#endif
