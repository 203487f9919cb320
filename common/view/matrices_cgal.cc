// SPDX-License-Identifier: GPL-3.0-or-later
// The matrices of a view, in rational numbers.

#include "common/polygon/exact_numbers.h"
#include "common/view/view.h"

using namespace hsr;

namespace {

using T = CGAL::Exact_rational;

void round(const Vector<T> &v, double to[3]) {
  to[0] = CGAL::to_double(v.x);
  to[1] = CGAL::to_double(v.y);
  to[2] = CGAL::to_double(v.z);
}

} // namespace

bool hsr_exact_view_matrices(struct hsr_view *view, bool *out_of_memory) {
  try {
    Vector<T> F = vector<T>(view->F), R = vector<T>(view->R),
              U = vector<T>(view->U);
    T d = det(F, R, U);
    if (d == 0)
      return false;
    T inverse = T(1) / d, m = view->whole_m, n = view->whole_n;
    const T l = view->left, t = view->top;
    Vector<T> w = inverse * cross(R, U), wx = inverse * cross(U, F),
              wy = inverse * cross(F, R);
    // V - E = t F + (w x) R + (w y) U, where w is t, or in parallel 1.
    const Vector<T> zero = T(0) * F, corner = (T(1) - T(2) * t / n) * U +
                                              (T(2) * l / m - T(1)) * R;
    const bool parallel = view->parallel;
    round(parallel ? corner : F + corner, view->ray[0]);
    round((T(2) / m) * R, view->ray[1]);
    round((T(-2) / n) * U, view->ray[2]);
    const T cx = m / T(2) - l, cy = n / T(2) - t; // the picture's centre
    round((m / T(2)) * wx + (parallel ? zero : cx * w), view->screen[0]);
    round((parallel ? zero : cy * w) - (n / T(2)) * wy, view->screen[1]);
    round(parallel ? zero : w, view->screen[2]);
    round(w, view->depth);
    view->origin[0] = parallel ? view->whole_m / 2.0 - view->left : 0;
    view->origin[1] = parallel ? view->whole_n / 2.0 - view->top : 0;
    view->origin[2] = parallel ? 1 : 0;
    return true;
  } catch (...) {
    *out_of_memory = true;
    return false;
  }
}
