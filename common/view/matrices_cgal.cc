// SPDX-License-Identifier: GPL-3.0-or-later
// The matrices of a view, in rational numbers.

#include "common/polygon/exact_numbers.h"
#include "common/view/view.h"

using namespace hsr;

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
