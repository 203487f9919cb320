/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether arithmetic is what exactness rests on: it is asked once, when the core
 * starts. WebAssembly rounds to nearest and has denormal numbers; but intervals
 * have to round upwards by hand, and GMP has to know how doubles are stored. */
#include "bench/judge/rounding.h"
#include "bench/web/check.h"
#include "common/base/exact.h"

#include <CGAL/Gmpzf.h>

#include <cstdlib>

namespace {

/* Numbers that the compiler does not know. */
volatile double tenth = 0.1, one = 1, three = 3, tiny = 0x1p-1074,
                large = 0x1.fffffffffffffp1023;

bool rounds_to_nearest() {
  return one + 0x1p-53 == 1 && one + 0x1.8p-53 == 1 + 0x1p-52 &&
         tiny / 2 == 0 && tiny > 0 && tenth * 3 == 0x1.3333333333334p-2 &&
         large + large > large;
}

/* Intervals of what is exact are a point; those of a third, and of products and sums
 * that are not exact, are as narrow as can be. */
bool rounds_upwards() {
  using I = hsr::Safe_interval;
  const I four = I(one) + I(three), nine = I(three) * I(three);
  if (four.inf() != 4 || four.sup() != 4 || nine.inf() != 9 || nine.sup() != 9)
    return false;
  const I third = I(one) / I(three), sum = I(one) + I(tiny);
  return judge::is_rounding_honoured() && third.inf() < third.sup() &&
         third.inf() * 3 <= 1 && sum.inf() == 1 && sum.sup() == 1 + 0x1p-52 &&
         (I(tiny) * I(tiny)).sup() > 0 && (-I(tiny) * I(tiny)).inf() < 0;
}

/* Numbers come back from the exact ones as they were; and their sums are exact. */
bool is_exact() {
  for (const double x : {+tenth, -tenth, +tiny, +large, one / three}) {
    const hsr::Exact e(x), sum = hsr::Exact(x) * e - e * e + hsr::Exact(tiny);
    mpq_t q;
    mpq_init(q);
    mpq_set_d(q, x);
    const bool same = mpq_get_d(q) == x;
    mpq_clear(q);
    if (!same || hsr::fraction(e).to_double() != x ||
        CGAL::to_double(CGAL::Gmpzf(x)) != x || sum != hsr::Exact(tiny))
      return false;
  }
  return true;
}

bool reads_numbers() {
  return std::strtod("0.1", nullptr) == tenth &&
         std::strtod("4.9406564584124654e-324", nullptr) == tiny &&
         std::strtod("0.30000000000000004", nullptr) == tenth * 3;
}

} // namespace

extern "C" const char *check_numbers() {
  return !rounds_to_nearest() ? "doubles are not rounded to nearest"
         : !rounds_upwards()  ? "intervals are not rounded upwards"
         : !is_exact()        ? "exact numbers are not exact"
         : !reads_numbers()   ? "texts are not read to the nearest double"
                              : nullptr;
}
