// SPDX-License-Identifier: GPL-3.0-or-later
// The exact predicates of rays and planes, over CGAL's numbers: see
// common/polygon/exact_numbers.h.
//
// Division    there is none: x = (2 sx - m)/m and y = (n - 2 sy)/n are
//             multiplied through by m n > 0.

#include "common/exact/predicates.h"
#include "common/polygon/exact_numbers.h"

using namespace hsr;

namespace {

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
