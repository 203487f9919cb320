/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact signs over CGAL's interval and exact number types, for C++ files that
 * write a predicate as a polynomial.
 *
 * Method      Each predicate is a polynomial, written once as a template over
 *             the number type. It is evaluated in intervals first. If the
 *             interval does not tell the sign, it is evaluated in exact
 *             numbers, which hold sums and products of doubles exactly
 *             (common/base/exact.h).
 * Division    The polynomials do not divide. Those of the screen, with x = (2
 *             sx
 *             - m)/m and y = (n - 2 sy)/n, are multiplied by m n > 0. Those
 *             with a mean are multiplied by the number of vertices. */
#ifndef HSR_COMMON_POLYGON_EXACT_NUMBERS_H
#define HSR_COMMON_POLYGON_EXACT_NUMBERS_H

#include "common/base/exact.h"
#include "common/polygon/polygon.h"

#include <CGAL/Exact_rational.h>

namespace hsr {

/* Returns the sign of polynomial(T()): -1, 0 or +1. The argument only tells the
 * number type. If memory runs out, *out_of_memory is set and the result is
 * meaningless. */
template <class Polynomial>
int sign_of(const Polynomial &polynomial, bool *out_of_memory) noexcept {
  try {
    {
      CGAL::Protect_FPU_rounding<true> upwards;
      CGAL::Uncertain<CGAL::Sign> sign = CGAL::sign(polynomial(Interval()));
      if (CGAL::is_certain(sign))
        return CGAL::get_certain(sign);
    }
    return CGAL::sign(polynomial(Exact()));
  } catch (...) {
    *out_of_memory = true;
    return 1;
  }
}

/* Vectors of three numbers of type T, with their usual operations. */
template <class T> struct Vector { T x, y, z; };

template <class T> Vector<T> vector(const double v[3]) {
  return {T(v[0]), T(v[1]), T(v[2])};
}
template <class T> Vector<T> operator-(const Vector<T> &a, const Vector<T> &b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T> Vector<T> operator+(const Vector<T> &a, const Vector<T> &b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T> Vector<T> operator*(const T &s, const Vector<T> &a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T> T dot(const Vector<T> &a, const Vector<T> &b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T> Vector<T> cross(const Vector<T> &a, const Vector<T> &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T det(const Vector<T> &a, const Vector<T> &b, const Vector<T> &c) {
  return dot(cross(a, b), c);
}

/* Corner k of a face, 0 <= k < face.n. */
template <class T> Vector<T> corner(const hsr_loop &face, uint32_t k) {
  size_t v = face.stride * face.vertex[k];
  return {T(face.x[v]), T(face.y[v]), T(face.z[v])};
}

/* Newell's normal (Sutherland et al. 1974, eq. 6), not normalised. The sum is
 * formed with the first corner as origin, which gives the same vector. */
template <class T> Vector<T> newell_normal(const hsr_loop &face) {
  Vector<T> first = corner<T>(face, 0);
  Vector<T> normal = {T(0), T(0), T(0)};
  Vector<T> previous = corner<T>(face, 1) - first;
  for (uint32_t k = 2; k < face.n; k++) {
    Vector<T> next = corner<T>(face, k) - first;
    normal = normal + cross(previous, next);
    previous = next;
  }
  return normal;
}

/* The plane of the points P with N . (k P - S) = 0, where S is the sum of k
 * points of the plane. */
template <class T> struct Plane {
  Vector<T> normal; // N
  T k, offset;      // offset is N . S
};

/* The plane with Newell's normal through the mean of the corners. */
template <class T> Plane<T> newell_plane(const hsr_loop &face) {
  Vector<T> normal = newell_normal<T>(face);
  if (face.n == 3) /* any corner will do */
    return {normal, T(1), dot(normal, corner<T>(face, 0))};
  Vector<T> sum = {T(0), T(0), T(0)};
  for (uint32_t k = 0; k < face.n; k++)
    sum = sum + corner<T>(face, k);
  return {normal, T(double(face.n)), dot(normal, sum)};
}

} // namespace hsr

#endif
