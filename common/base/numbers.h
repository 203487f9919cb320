/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The greater and the smaller of two numbers. They are faster than fmax and
 * fmin, which compilers turn into calls because of NaN. If a or b is NaN, the
 * result is b. */
#ifndef HSR_COMMON_NUMBERS_H
#define HSR_COMMON_NUMBERS_H

static inline double hsr_max(double a, double b) {
  return a > b ? a : b;
}

static inline double hsr_min(double a, double b) {
  return a < b ? a : b;
}

#endif
