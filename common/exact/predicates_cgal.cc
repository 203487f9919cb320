// SPDX-License-Identifier: GPL-3.0-or-later
// The exact predicates over CGAL's interval and exact number types.
//
// Method      Each predicate is a polynomial written once as a template over
//             the number type. It is evaluated in intervals, whose rounding
//             CGAL directs; if the interval does not tell the sign, in
//             MP_Float, CGAL's exact floating-point numbers (integers times
//             powers of two), which hold sums and products of doubles exactly.
//             The faster Mpzf is not for us: where memory runs out within a
//             sum, CGAL 5.5 frees an address that it never got.
// Division    there is none: x = (2 sx - m)/m and y = (n - 2 sy)/n are
//             multiplied through by m n > 0, means by the number of vertices.

#include "common/exact/predicates.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/MP_Float.h>

#include <new>

namespace {

using Interval = CGAL::Interval_nt<false>;
using Exact = CGAL::MP_Float;

/* The sign of polynomial(T()), the argument only telling the number type. */
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
    *out_of_memory = true; /* the only thing that MP_Float throws */
    return 1;
  }
}

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

template <class T> Vector<T> corner(const hsr_loop &face, uint32_t k) {
  size_t v = face.stride * face.vertex[k];
  return {T(face.x[v]), T(face.y[v]), T(face.z[v])};
}

/* Newell's normal about the first vertex, which is the same vector. */
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

/* The plane N . (k P - S) = 0 as N and N . S, and k. */
template <class T> struct Plane {
  Vector<T> normal;
  T k, offset;
};

template <class T> Plane<T> newell_plane(const hsr_loop &face) {
  Vector<T> normal = newell_normal<T>(face);
  if (face.n == 3) /* any corner will do */
    return {normal, T(1), dot(normal, corner<T>(face, 0))};
  Vector<T> sum = {T(0), T(0), T(0)};
  for (uint32_t k = 0; k < face.n; k++)
    sum = sum + corner<T>(face, k);
  return {normal, T(double(face.n)), dot(normal, sum)};
}

/* m n D: the ray of screen point (sx, sy), without division. */
template <class T> Vector<T> ray(const hsr_view &view, double sx, double sy) {
  T m = T(double(view.m)), n = T(double(view.n));
  T right = (T(sx) + T(sx) - m) * n, up = (n - T(sy) - T(sy)) * m;
  return (m * n) * vector<T>(view.F) + right * vector<T>(view.R) +
         up * vector<T>(view.U);
}

template <class T> Vector<T> from_eye(const hsr_view &view, const double v[3]) {
  return vector<T>(v) - vector<T>(view.E);
}

/* The sign of a function of the ray that is linear in D, perturbed: of its
 * value at D, else of its change along R, else along -U. */
template <class Linear>
int perturbed_sign(const hsr_view &view, double sx, double sy,
                   const Linear &linear, bool *out_of_memory) noexcept {
  int sign = sign_of(
      [&](auto t) {
        using T = decltype(t);
        return linear(ray<T>(view, sx, sy), T(1));
      },
      out_of_memory);
  if (!sign)
    sign = sign_of(
        [&](auto t) {
          using T = decltype(t);
          return linear(vector<T>(view.R), T(0));
        },
        out_of_memory);
  if (!sign)
    sign = -sign_of(
        [&](auto t) {
          using T = decltype(t);
          return linear(vector<T>(view.U), T(0));
        },
        out_of_memory);
  return sign;
}

/* k N.D and c = N . (S - k E) of a plane, whose quotient is 1/t. */
template <class T> T depth_scale(const hsr_view &view, const Plane<T> &plane) {
  return plane.offset - plane.k * dot(plane.normal, vector<T>(view.E));
}

} // namespace

namespace {

/* The sign of a component of Newell's normal. */
int normal_sign(const hsr_loop &face, int axis, bool *out_of_memory) {
  return sign_of(
      [&](auto t) {
        using T = decltype(t);
        Vector<T> n = newell_normal<T>(face);
        return axis == 0 ? n.x : axis == 1 ? n.y : n.z;
      },
      out_of_memory);
}

} // namespace

int hsr_exact_has_normal(struct hsr_loop face, bool *out_of_memory) {
  for (int axis = 0; axis < 3; axis++)
    if (normal_sign(face, axis, out_of_memory))
      return 1;
  return 0;
}

int hsr_exact_same_plane(struct hsr_loop f, struct hsr_loop g,
                         bool *out_of_memory) {
  /* Parallel normals, and the mean of one on the other. */
  for (int axis = 0; axis < 3; axis++) {
    int sign = sign_of(
        [&](auto t) {
          using T = decltype(t);
          Vector<T> n = cross(newell_normal<T>(f), newell_normal<T>(g));
          return axis == 0 ? n.x : axis == 1 ? n.y : n.z;
        },
        out_of_memory);
    if (sign)
      return 0;
  }
  return !sign_of(
      [&](auto t) {
        using T = decltype(t);
        Plane<T> p = newell_plane<T>(f), q = newell_plane<T>(g);
        /* N_f (k_g P_f's offset) against the same point measured by g, along
         * N_f, which is parallel to N_g. */
        return p.offset * q.k * dot(q.normal, p.normal) -
               q.offset * p.k * dot(p.normal, p.normal);
      },
      out_of_memory);
}

int hsr_exact_moved_plane_side(struct hsr_loop face, const double shift[3],
                               const double point[3], bool *out_of_memory) {
  return sign_of(
      [&](auto t) {
        using T = decltype(t);
        Plane<T> plane = newell_plane<T>(face);
        return plane.k *
                   dot(plane.normal, vector<T>(point) - vector<T>(shift)) -
               plane.offset;
      },
      out_of_memory);
}

int hsr_exact_plane_side(struct hsr_loop face, const double point[3],
                         bool *out_of_memory) {
  static const double nowhere[3] = {0, 0, 0};
  return hsr_exact_moved_plane_side(face, nowhere, point, out_of_memory);
}

int hsr_exact_displaced_plane_side(struct hsr_loop face, const double point[3],
                                   bool *out_of_memory) {
  int sign = hsr_exact_plane_side(face, point, out_of_memory);
  for (int axis = 0; axis < 3 && !sign; axis++)
    sign = normal_sign(face, axis, out_of_memory);
  return sign;
}

int hsr_exact_row_side(const struct hsr_view *view, const double vertex[3],
                       double sy, bool *out_of_memory) {
  /* det(D, R, v) does not depend on sx: any will do. */
  int sign = perturbed_sign(
      *view, view->m / 2.0, sy,
      [&](const auto &d, auto one) {
        using T = decltype(one);
        return det(d, vector<T>(view->R), from_eye<T>(*view, vertex));
      },
      out_of_memory);
  return sign ? sign : 1;
}

int hsr_exact_edge_side(const struct hsr_view *view, const double a[3],
                        const double b[3], double sx, double sy,
                        bool *out_of_memory) {
  return perturbed_sign(
      *view, sx, sy,
      [&](const auto &d, auto one) {
        using T = decltype(one);
        return det(from_eye<T>(*view, a), from_eye<T>(*view, b), d);
      },
      out_of_memory);
}

int hsr_exact_edge_slope(const struct hsr_view *view, const double a[3],
                         const double b[3], bool *out_of_memory) {
  return sign_of(
      [&](auto t) {
        using T = decltype(t);
        return det(from_eye<T>(*view, a), from_eye<T>(*view, b),
                   vector<T>(view->R));
      },
      out_of_memory);
}

int hsr_exact_ahead(const struct hsr_view *view, struct hsr_loop face,
                    double sx, double sy, bool *out_of_memory) {
  /* N.D has the sign of c = N . (S - k E). */
  int c = -hsr_exact_plane_side(face, view->E, out_of_memory);
  int along = perturbed_sign(
      *view, sx, sy,
      [&](const auto &d, auto one) {
        using T = decltype(one);
        return dot(newell_normal<T>(face), d);
      },
      out_of_memory);
  return c && along == c ? 1 : -1;
}

int hsr_exact_past_near(const struct hsr_view *view, struct hsr_loop face,
                        double sx, double sy, bool *out_of_memory) {
  /* c - near k N.D, scaled by m n as D is, has the sign of c. */
  int c = -hsr_exact_plane_side(face, view->E, out_of_memory);
  int past = perturbed_sign(
      *view, sx, sy,
      [&](const auto &d, auto one) {
        using T = decltype(one);
        Plane<T> plane = newell_plane<T>(face);
        T mn = T(double(view->m)) * T(double(view->n));
        return one * mn * depth_scale(*view, plane) -
               T(view->near) * plane.k * dot(plane.normal, d);
      },
      out_of_memory);
  return c && past == c ? 1 : -1;
}

namespace {

/* k_f N_f.D / c_f - k_g N_g.D / c_g, times c_f c_g. */
template <class T>
T nearer_by(const hsr_view &view, const hsr_loop &f, const hsr_loop &g,
            const Vector<T> &d) {
  Plane<T> p = newell_plane<T>(f), q = newell_plane<T>(g);
  return p.k * dot(p.normal, d) * depth_scale(view, q) -
         q.k * dot(q.normal, d) * depth_scale(view, p);
}

/* The sign of c_f c_g. */
int scale_sign(const hsr_view &view, const hsr_loop &f, const hsr_loop &g,
               bool *out_of_memory) {
  return hsr_exact_plane_side(f, view.E, out_of_memory) *
         hsr_exact_plane_side(g, view.E, out_of_memory);
}

} // namespace

int hsr_exact_nearer(const struct hsr_view *view, struct hsr_loop f,
                     struct hsr_loop g, double sx, double sy,
                     bool *out_of_memory) {
  int sign = perturbed_sign(
      *view, sx, sy,
      [&](const auto &d, auto one) {
        using T = decltype(one);
        return nearer_by<T>(*view, f, g, d);
      },
      out_of_memory);
  return sign ? sign * scale_sign(*view, f, g, out_of_memory) : 0;
}

int hsr_exact_nearer_towards(const struct hsr_view *view, struct hsr_loop f,
                             struct hsr_loop g, const double point[3],
                             bool *out_of_memory) {
  int sign = sign_of(
      [&](auto t) {
        using T = decltype(t);
        return nearer_by<T>(*view, f, g, from_eye<T>(*view, point));
      },
      out_of_memory);
  return sign ? sign * scale_sign(*view, f, g, out_of_memory) : 0;
}

int hsr_exact_cut_side(const struct hsr_view *view, struct hsr_loop f,
                       struct hsr_loop g, double sx, double sy,
                       bool *out_of_memory) {
  /* With t = c_f / (k_f N_f.D), k_g N_g.(E + t D) - N_g.S_g
   * = (c_f k_g N_g.D - c_g k_f N_f.D) / (k_f N_f.D), and N_f.D has the sign of
   * c_f, since t > 0. */
  int sign = perturbed_sign(
      *view, sx, sy,
      [&](const auto &d, auto one) {
        using T = decltype(one);
        Plane<T> p = newell_plane<T>(f), q = newell_plane<T>(g);
        return depth_scale(*view, p) * q.k * dot(q.normal, d) -
               depth_scale(*view, q) * p.k * dot(p.normal, d);
      },
      out_of_memory);
  return sign ? sign * -hsr_exact_plane_side(f, view->E, out_of_memory) : 0;
}

bool hsr_exact_view_matrices(const struct hsr_view *view, double ray_rows[3][3],
                             double screen[3][3], bool *out_of_memory) {
  try {
    using T = CGAL::Exact_rational;
    Vector<T> F = vector<T>(view->F), R = vector<T>(view->R),
              U = vector<T>(view->U);
    T d = det(F, R, U);
    if (d == 0)
      return false;
    T inverse = T(1) / d, m = view->m, n = view->n;
    Vector<T> w = inverse * cross(R, U), wx = inverse * cross(U, F),
              wy = inverse * cross(F, R);
    const Vector<T> rows[6] = {F - R + U,
                               (T(2) / m) * R,
                               (T(-2) / n) * U,
                               (m / T(2)) * (w + wx),
                               (n / T(2)) * (w - wy),
                               w};
    for (int i = 0; i < 6; i++) {
      double *row = i < 3 ? ray_rows[i] : screen[i - 3];
      row[0] = CGAL::to_double(rows[i].x);
      row[1] = CGAL::to_double(rows[i].y);
      row[2] = CGAL::to_double(rows[i].z);
    }
    return true;
  } catch (...) {
    *out_of_memory = true;
    return false;
  }
}
