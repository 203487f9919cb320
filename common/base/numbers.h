/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The greater and the smaller of two numbers. */
#ifndef HSR_COMMON_NUMBERS_H
#define HSR_COMMON_NUMBERS_H

#include <stdint.h>

/* They are faster than fmax and fmin, which compilers turn into calls because
 * of NaN. If a or b is NaN, the result is b. */
static inline double hsr_max(double a, double b) {
  return a > b ? a : b;
}

static inline double hsr_min(double a, double b) {
  return a < b ? a : b;
}

static inline int hsr_max_int(int a, int b) {
  return a > b ? a : b;
}

static inline int hsr_min_int(int a, int b) {
  return a < b ? a : b;
}

static inline uint32_t hsr_max_u32(uint32_t a, uint32_t b) {
  return a > b ? a : b;
}

#endif
