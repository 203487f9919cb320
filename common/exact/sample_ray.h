// SPDX-License-Identifier: GPL-3.0-or-later
// The ray of a sample in the numbers T of common/polygon/exact_numbers.h.
//
// Division    nothing is divided. x = (2 (sx + l) - W)/W and y = (H - 2 (sy +
//             t))/H of common/view/view.h are multiplied by m n > 0, where m is
//             W and n is H.
#ifndef HSR_SAMPLE_RAY_H
#define HSR_SAMPLE_RAY_H

#include "common/polygon/exact_numbers.h"
#include "common/view/view.h"

namespace hsr {

/* The point S of common/view/view.h, times m n, with E as origin: s is m n D in
 * perspective and m n (P - E) in parallel, and `one` is m n. A derivative of S
 * has the same type, with `one` 0. */
template <class T> struct Heading {
  Vector<T> s;
  T one;
};

/* S of the screen point (sx, sy), not perturbed. */
template <class T>
Heading<T> at_sample(const hsr_view &view, double sx, double sy) {
  const T m = T(double(view.whole_m)), n = T(double(view.whole_n));
  const T left = T(2.0 * view.left), above = T(2.0 * view.top);
  const T right = (T(sx) + T(sx) + left - m) * n,
          up = (n - above - T(sy) - T(sy)) * m;
  const Vector<T> s = right * vector<T>(view.R) + up * vector<T>(view.U);
  if (view.parallel)
    return {s, m * n};
  return {(m * n) * vector<T>(view.F) + s, m * n};
}

} // namespace hsr

#endif
