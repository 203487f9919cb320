// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's arithmetic of intervals, where there is one mode of rounding. It widens
// every result to the double beyond, by nextafter. Here it gets another function
// for that, which is inlined: this makes the oracle much faster. What CGAL's file
// includes is included before, so that the name is changed in that file alone.
#ifndef HSR_WEB_FPU_H
#define HSR_WEB_FPU_H

#include <CGAL/assertions.h>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace CGAL {

// The double beside x, on the side of `to`, which is infinity, or 0 for an x of
// 0 or more.
inline double beside(double x, double to) {
  std::int64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  if (x == to || x != x)
    return x;
  if (x == 0)
    bits = 1; // to is infinity
  else
    bits += (x > 0) == (to > x) ? 1 : -1;
  std::memcpy(&x, &bits, sizeof bits);
  return x;
}

} // namespace CGAL

#define nextafter beside
#include_next <CGAL/FPU.h>
#undef nextafter

#endif
