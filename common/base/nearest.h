/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rounding of a quotient, by GMP. */
#ifndef HSR_COMMON_BASE_NEAREST_H
#define HSR_COMMON_BASE_NEAREST_H

#include <gmp.h>
#include <math.h>
#include <stdbool.h>

/* The double that is nearest to q >= 0; of two, the lower. q need not be in its
 * lowest terms, but its denominator is positive. */
static inline double hsr_nearest_double(const mpq_t q) {
  double low = mpq_get_d(q); /* rounded towards zero */
  double high = nextafter(low, INFINITY);
  mpq_t middle, other;
  mpq_inits(middle, other, NULL);
  mpq_set_d(middle, low);
  mpq_set_d(other, high);
  mpq_add(middle, middle, other);
  mpq_div_2exp(middle, middle, 1);
  bool upward = mpq_cmp(q, middle) > 0;
  mpq_clears(middle, other, NULL);
  return upward ? high : low;
}

#endif
