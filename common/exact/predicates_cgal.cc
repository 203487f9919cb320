// SPDX-License-Identifier: GPL-3.0-or-later
// The exact predicates of rays and planes, over CGAL's numbers: see
// common/polygon/exact_numbers.h.

#include "common/exact/predicates.h"
#include "common/exact/sample_ray.h"
#include "common/polygon/exact_numbers.h"

using namespace hsr;

namespace {

template <class T> Vector<T> from_eye(const hsr_view &view, const double v[3]) {
  return vector<T>(v) - vector<T>(view.E);
}

/* The sign of a linear function of the heading, perturbed: of its value at the
 * sample, else of its change along R, else along -U. */
template <class Linear>
int perturbed_sign(const hsr_view &view, double sx, double sy,
                   const Linear &linear, bool *out_of_memory) noexcept {
  int sign = sign_of(
      [&](auto t) {
        using T = decltype(t);
        return linear(at_sample<T>(view, sx, sy), T(0));
      },
      out_of_memory);
  if (!sign)
    sign = sign_of(
        [&](auto t) {
          using T = decltype(t);
          return linear(Heading<T>{vector<T>(view.R), T(0)}, T(0));
        },
        out_of_memory);
  if (!sign)
    sign = -sign_of(
        [&](auto t) {
          using T = decltype(t);
          return linear(Heading<T>{vector<T>(view.U), T(0)}, T(0));
        },
        out_of_memory);
  return sign;
}

/* A plane as the eye sees it: q = slope / scale. In perspective slope is k N.D
 * and scale is e = N . (S - k E). In parallel slope is N . (k P - S) and scale
 * is k N.F. */
template <class T> struct Seen {
  Vector<T> kN;
  T e, scale;

  Seen(const hsr_view &view, const hsr_loop &face) {
    Plane<T> plane = newell_plane<T>(face);
    kN = plane.k * plane.normal;
    e = plane.offset - dot(kN, vector<T>(view.E));
    scale = view.parallel ? dot(kN, vector<T>(view.F)) : e;
  }
  T slope(const hsr_view &view, const Heading<T> &at) const {
    T along = dot(kN, at.s);
    return view.parallel ? along - at.one * e : along;
  }
};

} // namespace

int hsr_exact_eye_side(const struct hsr_view *view, struct hsr_loop face,
                       bool *out_of_memory) {
  if (!view->parallel)
    return hsr_exact_plane_side(face, view->E, out_of_memory);
  return -sign_of(
      [&](auto t) {
        using T = decltype(t);
        return dot(newell_normal<T>(face), vector<T>(view->F));
      },
      out_of_memory);
}

int hsr_exact_row_side(const struct hsr_view *view, const double vertex[3],
                       double sy, bool *out_of_memory) {
  /* det(D, R, v), or in parallel det(F, R, V - P), does not depend on sx: any
   * will do. */
  int sign = perturbed_sign(
      *view, view->whole_m / 2.0 - view->left, sy,
      [&](const auto &at, auto t) {
        using T = decltype(t);
        Vector<T> v = from_eye<T>(*view, vertex), R = vector<T>(view->R);
        return view->parallel ? det(vector<T>(view->F), R, at.one * v - at.s)
                              : det(at.s, R, v);
      },
      out_of_memory);
  return sign ? sign : 1;
}

int hsr_exact_edge_side(const struct hsr_view *view, const double a[3],
                        const double b[3], double sx, double sy,
                        bool *out_of_memory) {
  /* det(a, b, D); or in parallel det(A - P, B - P, F), which is linear in P. */
  return perturbed_sign(
      *view, sx, sy,
      [&](const auto &at, auto t) {
        using T = decltype(t);
        Vector<T> p = from_eye<T>(*view, a), q = from_eye<T>(*view, b);
        if (!view->parallel)
          return det(p, q, at.s);
        Vector<T> F = vector<T>(view->F);
        return at.one * det(p, q, F) - det(p - q, at.s, F);
      },
      out_of_memory);
}

int hsr_exact_ahead(const struct hsr_view *view, struct hsr_loop face,
                    double sx, double sy, bool *out_of_memory) {
  /* The slope has the sign of the scale. */
  int scale = -hsr_exact_eye_side(view, face, out_of_memory);
  if (!scale || view->parallel)
    return scale ? 1 : -1;
  int along = perturbed_sign(
      *view, sx, sy,
      [&](const auto &at, auto t) {
        using T = decltype(t);
        return dot(newell_normal<T>(face), at.s);
      },
      out_of_memory);
  return along == scale ? 1 : -1;
}

int hsr_exact_past_near(const struct hsr_view *view, struct hsr_loop face,
                        double sx, double sy, bool *out_of_memory) {
  /* scale - near slope, or in parallel -slope - near scale, has the sign of the
   * scale. */
  int scale = -hsr_exact_eye_side(view, face, out_of_memory);
  int past = perturbed_sign(
      *view, sx, sy,
      [&](const auto &at, auto t) {
        using T = decltype(t);
        Seen<T> seen(*view, face);
        T slope = seen.slope(*view, at), near = T(view->near);
        return view->parallel ? -slope - near * at.one * seen.scale
                              : at.one * seen.scale - near * slope;
      },
      out_of_memory);
  return scale && past == scale ? 1 : -1;
}

namespace {

/* The difference of the q of f and g, times both scales. */
template <class T>
T nearer_by(const hsr_view &view, const hsr_loop &f, const hsr_loop &g,
            const Heading<T> &at) {
  Seen<T> p(view, f), q(view, g);
  return p.slope(view, at) * q.scale - q.slope(view, at) * p.scale;
}

/* The sign of the product of both scales. */
int scale_sign(const hsr_view &view, const hsr_loop &f, const hsr_loop &g,
               bool *out_of_memory) {
  return hsr_exact_eye_side(&view, f, out_of_memory) *
         hsr_exact_eye_side(&view, g, out_of_memory);
}

} // namespace

int hsr_exact_nearer(const struct hsr_view *view, struct hsr_loop f,
                     struct hsr_loop g, double sx, double sy,
                     bool *out_of_memory) {
  int sign = perturbed_sign(
      *view, sx, sy,
      [&](const auto &at, auto t) {
        return nearer_by<decltype(t)>(*view, f, g, at);
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
        return nearer_by<T>(*view, f, g,
                            Heading<T>{from_eye<T>(*view, point), T(1)});
      },
      out_of_memory);
  return sign ? sign * scale_sign(*view, f, g, out_of_memory) : 0;
}

int hsr_exact_cut_side(const struct hsr_view *view, struct hsr_loop f,
                       struct hsr_loop g, double sx, double sy,
                       bool *out_of_memory) {
  /* The ray meets f at q_f. The height over g there has the sign of
   * scale_f slope_g - scale_g slope_f times that of scale_f: in perspective it
   * is divided by slope_f, whose sign is that of scale_f, since t > 0. */
  int sign = perturbed_sign(
      *view, sx, sy,
      [&](const auto &at, auto t) {
        return -nearer_by<decltype(t)>(*view, f, g, at);
      },
      out_of_memory);
  return sign ? sign * -hsr_exact_eye_side(view, f, out_of_memory) : 0;
}
