// SPDX-License-Identifier: GPL-3.0-or-later
// The plane of a face in numbers of any type: intervals, which may leave a sign
// open, or exact numbers.
#ifndef HSR_COMMON_EXACT_PLANE_H
#define HSR_COMMON_EXACT_PLANE_H

#include "common/base/exact.h"
#include "common/scene/pieces.h"
#include "common/scene/world.h"

#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <new>

namespace hsr {

template <class T> using Vector3 = typename CGAL::Simple_cartesian<T>::Vector_3;

// Vertex v of a world.
template <class T> Vector3<T> point(const hsr_world *w, uint32_t v) {
  return {T(w->mesh.x[v]), T(w->mesh.y[v]), T(w->mesh.z[v])};
}

// The plane N . (k P - S) = 0 of docs/correct-picture.md, where S is the sum of
// the k vertices of the face, or of a polygon with the same plane. `offset` is
// N . S.
template <class T> struct FacePlane {
  Vector3<T> normal;
  T k, offset;

  // The plane of the vertices of face f. For a piece, pass its parent's world
  // and number.
  FacePlane(const hsr_world *w, uint32_t f) : normal(T(0), T(0), T(0)) {
    const hsr_loop loop = hsr_spanning_loop(w, f);
    k = T(double(loop.n));
    Vector3<T> first = point<T>(w, loop.vertex[0]), sum = first;
    for (uint32_t i = 1; i < loop.n; i++) {
      Vector3<T> a = point<T>(w, loop.vertex[i]);
      sum = sum + a;
      if (i + 1 < loop.n)
        normal = normal +
                 CGAL::cross_product(a - first,
                                     point<T>(w, loop.vertex[i + 1]) - first);
    }
    offset = normal * sum;
  }

  // The plane where coordinate `axis` is `at`. Its front is where the
  // coordinate is greater if `front` is +1, and where it is less if `front` is
  // -1.
  FacePlane(size_t axis, double at, int front)
      : normal(T(axis == 0 ? front : 0), T(axis == 1 ? front : 0),
               T(axis == 2 ? front : 0)),
        k(1), offset(T(front) * T(at)) {}

  // The height of a point over the plane, times k |N|.
  T height(const Vector3<T> &p) const { return k * (normal * p) - offset; }
};

// Returns the side of the plane of face f that vertex v is on, +1 in front or
// -1 behind, if the rounded plane makes that certain. Else returns 0. The error
// bound is that of order.c.
inline int rough_side(const hsr_world *w, uint32_t f, uint32_t v) {
  const double n[3] = {w->mesh.nx[f], w->mesh.ny[f], w->mesh.nz[f]};
  const double r[3] = {w->mesh.x[v] - w->mesh.px[f],
                       w->mesh.y[v] - w->mesh.py[f],
                       w->mesh.z[v] - w->mesh.pz[f]};
  const double n1 = std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]);
  const double r1 = std::fabs(r[0]) + std::fabs(r[1]) + std::fabs(r[2]);
  const double error =
      2 * (w->mesh.n_error[f] * r1 + w->mesh.anchor_error[f] * n1) +
      0x1p-49 * n1 * r1 + 0x1p-960;
  const double height = n[0] * r[0] + n[1] * r[1] + n[2] * r[2];
  return height > error ? 1 : height < -error ? -1 : 0;
}

// Returns the exact side: +1 in front, -1 behind, 0 on the plane. May throw
// std::bad_alloc.
inline int side_of_plane(const hsr_world *w, uint32_t f, uint32_t v) {
  if (const int side = rough_side(w, f, v))
    return side;
  if (hsr_on_plane(w, f, v))
    return 0;
  return CGAL::sign(FacePlane<Exact>(w, f).height(point<Exact>(w, v)));
}

// An axis along which a face may be projected, and the sign of its normal's
// component along that axis, which is not 0. projection_of finds it for face f.
// The axis is that of the largest component of the rounded normal, if that is
// certainly not 0. Otherwise exact signs decide. That happens if products of
// coordinates below 2^-480 underflow, or if a sliver's rounded normal is all
// rounding error. May throw std::bad_alloc.
struct Projection {
  int axis, sign;
};
inline Projection projection_of(const hsr_world *w, uint32_t f) {
  const double n[3] = {w->mesh.nx[f], w->mesh.ny[f], w->mesh.nz[f]};
  const double a[3] = {std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])};
  const int drop = a[0] >= a[1] && a[0] >= a[2] ? 0 : a[1] >= a[2] ? 1 : 2;
  if (a[drop] > w->mesh.n_error[f])
    return {drop, n[drop] > 0 ? 1 : -1};
  bool out_of_memory = false;
  for (int axis = 0; axis < 3; axis++)
    if (const int sign =
            hsr_exact_normal_sign(hsr_plane_loop(w, f), axis, &out_of_memory))
      if (!out_of_memory)
        return {axis, sign};
  throw std::bad_alloc(); // a face has a normal
}

} // namespace hsr

#endif
