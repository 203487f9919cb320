// SPDX-License-Identifier: GPL-3.0-or-later
// The plane of a face in numbers of any type: intervals, which may leave a
// comparison open, and exact ones.
#ifndef HSR_COMMON_EXACT_PLANE_H
#define HSR_COMMON_EXACT_PLANE_H

#include "common/world.h"

#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>
#include <CGAL/Simple_cartesian.h>

namespace hsr {

using Interval = CGAL::Interval_nt<false>;
using Exact = CGAL::Mpzf;
template <class T> using Vector = typename CGAL::Simple_cartesian<T>::Vector_3;

template <class T> Vector<T> point(const hsr_world *w, uint32_t v) {
  return {T(w->x[v]), T(w->y[v]), T(w->z[v])};
}

// N . (k P - S) = 0, as in docs/correct-picture.md; `offset` is N . S.
template <class T> struct Plane {
  Vector<T> normal;
  T k, offset;

  Plane(const hsr_world *w, uint32_t f)
      : normal(T(0), T(0), T(0)), k(double(hsr_face_size(w, f))) {
    const uint32_t *vertex = w->vertex + w->start[f], n = hsr_face_size(w, f);
    Vector<T> first = point<T>(w, vertex[0]), sum = first;
    for (uint32_t i = 1; i < n; i++) {
      Vector<T> a = point<T>(w, vertex[i]);
      sum = sum + a;
      if (i + 1 < n)
        normal = normal + CGAL::cross_product(
                              a - first, point<T>(w, vertex[i + 1]) - first);
    }
    offset = normal * sum;
  }

  T height(const Vector<T> &p) const { return k * (normal * p) - offset; }
};

} // namespace hsr

#endif
