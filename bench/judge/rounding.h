/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rounding modes, for judges that compute in CGAL's intervals. */
#ifndef HSR_BENCH_JUDGE_ROUNDING_H
#define HSR_BENCH_JUDGE_ROUNDING_H

#include <CGAL/Interval_nt.h>

namespace judge {

using Interval = CGAL::Interval_nt<false>; /* only while an Upward lives */

struct Upward : CGAL::Protect_FPU_rounding<true> {};
struct Nearest : CGAL::Protect_FPU_rounding<true> {
  Nearest() : CGAL::Protect_FPU_rounding<true>(CGAL_FE_TONEAREST) {}
};

/* Whether intervals hold what they should, which they do not where directed
 * rounding is ignored. */
inline bool is_rounding_honoured() {
  const Upward upward;
  const Interval third = Interval(1) / Interval(3);
  const Interval tenth = Interval(1.1) * Interval(10.1);
  return third.inf() < third.sup() && tenth.inf() < tenth.sup();
}

} // namespace judge

#endif
