/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether views are at equal steps of a screw.
 *
 * Source      docs/composited-picture.md, "Frames between two views"
 * Method      a turn and a shift at constant speeds look the same from every view
 *             on their way: each view sees the next one in the same direction, as
 *             far away, and turned alike. Only such a way has equal steps, if no
 *             step turns by more than its share of half a turn. So nothing of how
 *             common/view/path.h finds the way is used here. */
#ifndef HSR_BENCH_JUDGE_STEPS_H
#define HSR_BENCH_JUDGE_STEPS_H

#include "common/view/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace judge {

/* Where a view is and how it looks. */
struct pose {
  using Real = long double;
  std::array<std::array<Real, 3>, 3> axis; /* right, up, forward, of length 1 */
  std::array<Real, 3> E, sizes;            /* sizes: |R|, |U|, near */

  template <class View> explicit pose(const View &view) {
    const double *const of[3] = {view.R, view.U, view.F};
    for (size_t k = 0; k < 3; k++) {
      const Real length =
          std::hypot(Real(of[k][0]), Real(of[k][1]), Real(of[k][2]));
      for (size_t a = 0; a < 3; a++)
        axis[k][a] = of[k][a] / length;
      E[k] = view.E[k];
      sizes[k] = k < 2 ? length : Real(view.near);
    }
  }
};

/* How a view sees the next one. */
struct step {
  std::array<std::array<long double, 3>, 3> turn = {};
  std::array<long double, 3> shift = {}, growth = {};

  step(const pose &from, const pose &to) {
    for (size_t k = 0; k < 3; k++) {
      for (size_t a = 0; a < 3; a++) {
        shift[k] += (to.E[a] - from.E[a]) * from.axis[k][a];
        for (size_t l = 0; l < 3; l++)
          turn[k][l] += to.axis[l][a] * from.axis[k][a];
      }
      growth[k] = to.sizes[k] - from.sizes[k];
    }
  }

  /* The cosine of its angle. */
  long double cosine() const {
    return (turn[0][0] + turn[1][1] + turn[2][2] - 1) / 2;
  }
};

/* `scale`: of what is compared. */
inline bool is_alike(const step &a, const step &b, long double scale) {
  const long double turned = 1e-11L, moved = turned * scale;
  for (size_t k = 0; k < 3; k++) {
    if (!(std::fabs(a.shift[k] - b.shift[k]) <= moved &&
          std::fabs(a.growth[k] - b.growth[k]) <= moved))
      return false;
    for (size_t l = 0; l < 3; l++)
      if (!(std::fabs(a.turn[k][l] - b.turn[k][l]) <= turned))
        return false;
  }
  return true;
}

/* At least two. They lead from the view before `last` to `last`. */
inline bool are_steps(const std::vector<pose> &all, const hsr_view &last) {
  const pose begin(last.before), end(last);
  long double scale = 1;
  for (const pose *p : {&begin, &end})
    for (size_t a = 0; a < 3; a++)
      scale = std::max({scale, std::fabs(p->E[a]), std::fabs(p->sizes[a])});
  const step still(begin, begin), first(all[0], all[1]);
  const long double most =
      3.141592653589793238462643383279502884L / (long double)(all.size() - 1);
  if (!is_alike(step(begin, all.front()), still, scale) ||
      !is_alike(step(end, all.back()), still, scale) ||
      first.cosine() < std::cos(most) - 1e-9L)
    return false;
  for (size_t k = 1; k < all.size(); k++)
    if (!is_alike(step(all[k - 1], all[k]), first, scale))
      return false;
  return true;
}

} /* namespace judge */

#endif
