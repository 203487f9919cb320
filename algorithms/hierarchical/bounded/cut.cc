// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts of polygons, and where they reach `near`, in exact terms, for where
// doubles say too little: an eye that is almost in a plane that is far larger
// than its distance. The formulas are those of shape.c.
#include "algorithms/hierarchical/bounded/shape.h"
#include "common/exact/exact_plane.h"

#include <limits>

namespace {

using hsr::Exact;
using Vector = hsr::Vector3<Exact>;

struct Plane {
  Vector normal;
  Exact height; // of the eye

  Plane(const hsr::FacePlane<Exact> &plane, const Vector &eye)
      : normal(plane.normal * plane.k), height(plane.height(eye)) {}
};

Plane plane_of(const hsr_screen *screen, const hsr_shape_cut *cut,
               const Vector &eye) {
  if (cut->face != HSR_NO_ID)
    return {hsr::FacePlane<Exact>(screen->world, cut->face), eye};
  const size_t axis = cut->N[0] != 0 ? 0 : cut->N[1] != 0 ? 1 : 2;
  return {hsr::FacePlane<Exact>(axis, cut->P[axis], 1), eye};
}

Vector exactly(const double v[3]) {
  return {Exact(v[0]), Exact(v[1]), Exact(v[2])};
}

} // namespace

extern "C" {

void hsr_near_exactly(const hsr_screen *screen, uint32_t f, bool at_eye,
                      double normal[3], double *rest) {
  try {
    const hsr_view &view = *screen->view;
    const Vector eye = exactly(view.E);
    const Plane N({screen->world, f}, eye);
    Vector out = -N.normal;
    Exact along = -N.height, more = 0; // whose sign turns the line
    if (view.parallel) {
      along = N.normal * exactly(view.F);
      more = -N.height - along * Exact(view.near);
    } else if (at_eye) {
      out = N.normal;
    } else {
      out = out * Exact(view.near);
      more = along;
    }
    const double turn = CGAL::sign(along);
    for (int c = 0; c < 3; c++)
      normal[c] = turn * CGAL::to_double(out[c]);
    *rest = turn * CGAL::to_double(more);
  } catch (...) {
    *rest = std::numeric_limits<double>::quiet_NaN();
  }
}

void hsr_cut_exactly(const hsr_screen *screen, const hsr_shape_cut *own,
                     const hsr_shape_cut *cut, double normal[3], double *rest) {
  try {
    const Vector eye = exactly(screen->view->E);
    const Plane M = plane_of(screen, own, eye), N = plane_of(screen, cut, eye);
    Vector out = M.normal * N.height - N.normal * M.height;
    Exact more = 0;
    if (screen->view->parallel) {
      const Vector F = exactly(screen->view->F);
      const Exact k = M.normal * F, f = N.normal * F;
      out = N.normal * k - M.normal * f;
      more = k * N.height - f * M.height;
    }
    for (int c = 0; c < 3; c++)
      normal[c] = CGAL::to_double(out[c]);
    *rest = CGAL::to_double(more);
  } catch (...) {
    *rest = std::numeric_limits<double>::quiet_NaN();
  }
}

} /* extern "C" */
