// SPDX-License-Identifier: GPL-3.0-or-later
// The exact predicates of one polygon and of its plane, over CGAL's numbers.

#include "common/polygon/polygon.h"
#include "common/polygon/exact_numbers.h"

using namespace hsr;

int hsr_exact_normal_sign(struct hsr_loop face, int axis, bool *out_of_memory) {
  return sign_of(
      [&](auto t) {
        using T = decltype(t);
        Vector<T> n = newell_normal<T>(face);
        return axis == 0 ? n.x : axis == 1 ? n.y : n.z;
      },
      out_of_memory);
}

int hsr_exact_has_normal(struct hsr_loop face, bool *out_of_memory) {
  for (int axis = 0; axis < 3; axis++)
    if (hsr_exact_normal_sign(face, axis, out_of_memory))
      return 1;
  return 0;
}

namespace {

/* The number of a corner at another place than the first; 0: there is none. */
uint32_t second_place(const hsr_loop &face) {
  const auto coordinate = [&](const double *axis, uint32_t k) {
    return axis[face.stride * face.vertex[k]];
  };
  for (uint32_t k = 1; k < face.n; k++)
    for (const double *axis : {face.x, face.y, face.z})
      if (coordinate(axis, k) != coordinate(axis, 0))
        return k;
  return 0;
}

} // namespace

int hsr_exact_is_on_line(struct hsr_loop face, bool *out_of_memory) {
  const uint32_t second = second_place(face);
  for (uint32_t k = 1; second && k < face.n; k++)
    for (int axis = 0; axis < 3; axis++)
      if (sign_of(
              [&](auto t) {
                using T = decltype(t);
                const Vector<T> first = corner<T>(face, 0);
                const Vector<T> n = cross(corner<T>(face, second) - first,
                                          corner<T>(face, k) - first);
                return axis == 0 ? n.x : axis == 1 ? n.y : n.z;
              },
              out_of_memory))
        return 0;
  return 1;
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
    sign = hsr_exact_normal_sign(face, axis, out_of_memory);
  return sign;
}

namespace {

/* The height of corner k over a plane, times the plane's k. */
template <class T>
T height_of(const Plane<T> &plane, const hsr_loop &loop, uint32_t k) {
  return plane.k * dot(plane.normal, corner<T>(loop, k)) - plane.offset;
}

enum answer { NO, YES, UNCERTAIN };

/* Whether a polygon is flat, in intervals. The plane is computed once, since a
 * face may have a million corners. */
answer is_flat_roughly(const hsr_loop &loop, const hsr_loop &of_plane) {
  CGAL::Protect_FPU_rounding<true> upwards;
  const Plane<Interval> plane = newell_plane<Interval>(of_plane);
  answer flat = YES;
  for (uint32_t k = loop.n <= 4 ? 3 : 0; k < loop.n; k++) {
    const CGAL::Uncertain<CGAL::Sign> sign =
        CGAL::sign(height_of(plane, loop, k));
    if (!CGAL::is_certain(sign))
      flat = UNCERTAIN;
    else if (CGAL::get_certain(sign) != CGAL::ZERO)
      return NO;
  }
  return flat;
}

} // namespace

bool hsr_is_flat(struct hsr_loop loop, bool *out_of_memory) {
  struct hsr_loop of_plane = loop;
  if (loop.n == 4)
    of_plane.n = 3;
  try {
    const answer flat = is_flat_roughly(loop, of_plane);
    if (flat != UNCERTAIN)
      return flat == YES;
    const Plane<Exact> plane = newell_plane<Exact>(of_plane);
    for (uint32_t k = loop.n <= 4 ? 3 : 0; k < loop.n; k++)
      if (CGAL::sign(height_of(plane, loop, k)) != CGAL::ZERO)
        return false;
    return true;
  } catch (...) {
    *out_of_memory = true;
    return true;
  }
}
