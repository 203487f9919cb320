/* SPDX-License-Identifier: GPL-3.0-or-later */
/* For the tests of oracles: worlds that are filled by hand or by dice, and
 * exact numbers. */
#ifndef HSR_TESTS_UNIT_BENCH_LITTLE_WORLD_H
#define HSR_TESTS_UNIT_BENCH_LITTLE_WORLD_H

#include "algorithms/algorithm.h"

#include <CGAL/Exact_rational.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

struct point {
  double x, y, z;
};

/* Has the fields of hsr_world that an oracle may read; the others are NULL. */
struct little_world {
  std::vector<double> x, y, z;
  std::vector<uint32_t> start = {0}, vertex;
  std::vector<char> one_sided;

  uint32_t add(const point &p) {
    x.push_back(p.x);
    y.push_back(p.y);
    z.push_back(p.z);
    return uint32_t(x.size() - 1);
  }

  /* A face of existing vertices. */
  little_world &join(const std::vector<uint32_t> &corners, bool one = false) {
    vertex.insert(vertex.end(), corners.begin(), corners.end());
    start.push_back(uint32_t(vertex.size()));
    one_sided.push_back(one);
    return *this;
  }

  /* A face of its own vertices. */
  little_world &face(const std::vector<point> &corners, bool one = false) {
    std::vector<uint32_t> numbers;
    for (const point &p : corners)
      numbers.push_back(add(p));
    return join(numbers, one);
  }

  uint32_t n_faces() const { return uint32_t(start.size() - 1); }

  struct hsr_world world() {
    static_assert(sizeof(bool) == sizeof(char), "one_sided is read as bool");
    struct hsr_world w = {};
    w.mesh.n_vertices = uint32_t(x.size());
    w.n_faces = n_faces();
    w.mesh.n_corners = uint32_t(vertex.size());
    w.mesh.x = x.data();
    w.mesh.y = y.data();
    w.mesh.z = z.data();
    w.mesh.start = start.data();
    w.mesh.vertex = vertex.data();
    w.mesh.one_sided = reinterpret_cast<bool *>(one_sided.data());
    return w;
  }
};

/* n x n samples from the origin: F = (0, 0, -1), R = (1, 0, 0),
 * U = (0, 1, 0). */
inline struct hsr_view square_view(int n, double near) {
  struct hsr_view v = {};
  v.m = v.n = v.whole_m = v.whole_n = n;
  v.window = {0, 0, n, n};
  v.F[2] = -1;
  v.R[0] = 1;
  v.U[1] = 1;
  v.near = near;
  return v;
}

/* ---- Exact numbers ---- */

using Q = CGAL::Exact_rational;

struct vec {
  Q x, y, z;
};
inline vec operator+(const vec &a, const vec &b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline vec operator*(const Q &s, const vec &a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline vec operator-(const vec &a, const vec &b) {
  return a + Q(-1) * b;
}
inline Q dot(const vec &a, const vec &b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline vec cross(const vec &a, const vec &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Q det(const vec &a, const vec &b, const vec &c) {
  return dot(a, cross(b, c));
}
inline bool is_null(const vec &a) {
  return a.x == 0 && a.y == 0 && a.z == 0;
}
inline vec exact(const point &p) {
  return {p.x, p.y, p.z};
}

/* c[0] + c[1] e + c[2] e^2, e infinitesimal and positive. */
struct poly {
  Q c[3];
};
inline poly operator-(const poly &a, const poly &b) {
  return {{a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2]}};
}
inline poly operator*(const Q &s, const poly &a) {
  return {{s * a.c[0], s * a.c[1], s * a.c[2]}};
}
inline int sign(const Q &a) {
  return a > 0 ? 1 : a < 0 ? -1 : 0;
}
inline int sign(const poly &a) {
  for (const Q &c : a.c)
    if (c != 0)
      return sign(c);
  return 0;
}

/* The displaced ray, D + e R - e^2 U, and its scalar product with a vector. */
struct displaced {
  vec d[3];
};
inline poly dot(const vec &a, const displaced &D) {
  return {{dot(a, D.d[0]), dot(a, D.d[1]), dot(a, D.d[2])}};
}

/* ---- Random scenes ---- */

struct dice {
  std::mt19937 engine;

  int below(int n) { return int(engine() % unsigned(n)); }
  int from_to(int low, int high) { return low + below(high - low + 1); }
  bool once_in(int n) { return below(n) == 0; }
  point lattice(int size) {
    const double x = from_to(-size, size), y = from_to(-size, size);
    return {x, y, double(from_to(-size, size))};
  }
  Q part() { /* in (0, 1), at a place where nothing happens */
    return Q(from_to(1, 2147483646)) / Q(2147483647);
  }
};

/* One of three simple plane polygons, convex or not, placed by O + a u + b v:
 * exactly planar in integers. */
inline std::vector<point> planar_polygon(dice &d, int size) {
  static const std::vector<std::array<int, 2>> shapes[] = {
      {{0, 0}, {2, 0}, {2, 1}, {0, 1}},
      {{0, 0}, {3, 0}, {3, 3}, {2, 1}, {1, 1}, {0, 3}},
      {{0, 0}, {1, 1}, {3, 0}, {1, 3}, {0, 2}}};
  const point O = d.lattice(size), u = d.lattice(2), v = d.lattice(2);
  std::vector<point> corners;
  for (const auto &[a, b] : shapes[d.below(3)])
    corners.push_back({O.x + a * u.x + b * v.x, O.y + a * u.y + b * v.y,
                       O.z + a * u.z + b * v.z});
  return corners;
}

/* Directions from the eye E towards the middle that are independent. */
inline void random_directions(dice &d, const point &E, int size, point *F,
                              point *R, point *U) {
  do {
    *F = d.lattice(size / 3);
    *F = {F->x - E.x, F->y - E.y, F->z - E.z};
    *R = d.lattice(1 + size / 4);
    *U = d.lattice(1 + size / 4);
  } while (det(exact(*F), exact(*R), exact(*U)) == 0);
}

/* Rounds the scene's numbers: what was exactly degenerate is then nearly so. */
inline void roughen(little_world &w, struct hsr_view &v) {
  for (std::vector<double> *a : {&w.x, &w.y, &w.z})
    for (double &value : *a)
      value = value * 0.1 + 1e3;
  for (int axis = 0; axis < 3; axis++) {
    v.E[axis] = v.E[axis] * 0.1 + 1e3;
    v.F[axis] *= 0.1;
    v.R[axis] *= 0.1;
    v.U[axis] *= 0.1;
  }
}

inline void scale(little_world &w, struct hsr_view &v, int exponent) {
  for (std::vector<double> *a : {&w.x, &w.y, &w.z})
    for (double &value : *a)
      value = std::ldexp(value, exponent);
  for (double &value : v.E)
    value = std::ldexp(value, exponent);
  v.near = std::ldexp(v.near, exponent);
}

#endif
