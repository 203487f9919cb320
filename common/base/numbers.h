/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The greater and the smaller of two numbers. fmax and fmin are calls, since
 * they ask for NaN; here, if a is NaN, the answer is b. */
#ifndef HSR_COMMON_NUMBERS_H
#define HSR_COMMON_NUMBERS_H

static inline double hsr_max(double a, double b) {
  return a > b ? a : b;
}

static inline double hsr_min(double a, double b) {
  return a < b ? a : b;
}

#endif
