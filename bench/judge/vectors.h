/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Vectors that judges share, of intervals or of exact numbers. */
#ifndef HSR_BENCH_JUDGE_VECTORS_H
#define HSR_BENCH_JUDGE_VECTORS_H

namespace judge {

template <class T> struct vec { T x, y, z; };

template <class T> inline vec<T> lift(double x, double y, double z) {
  return {T(x), T(y), T(z)};
}

template <class T> inline vec<T> lift(const double v[3]) {
  return {T(v[0]), T(v[1]), T(v[2])};
}

template <class T> inline vec<T> operator+(const vec<T> &a, const vec<T> &b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class T> inline vec<T> operator-(const vec<T> &a, const vec<T> &b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class T> inline vec<T> operator*(const T &s, const vec<T> &a) {
  return {s * a.x, s * a.y, s * a.z};
}

template <class T> inline T dot(const vec<T> &a, const vec<T> &b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T> inline vec<T> cross(const vec<T> &a, const vec<T> &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
inline T det(const vec<T> &a, const vec<T> &b, const vec<T> &c) {
  return dot(cross(a, b), c);
}

} // namespace judge

#endif
