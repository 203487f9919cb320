/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Masks of 64 bits. */
#ifndef HSR_COMMON_BITS_H
#define HSR_COMMON_BITS_H

#include <stdint.h>

/* The number, from 0, of the lowest bit that is set; there must be one. */
static inline int hsr_first_bit(uint64_t mask) {
#ifdef __GNUC__
  return __builtin_ctzll(mask);
#else
  int bit = 0;
  while (!(mask >> bit & 1))
    bit++;
  return bit;
#endif
}

static inline unsigned hsr_count_bits(uint64_t mask) {
#ifdef __GNUC__
  return (unsigned)__builtin_popcountll(mask);
#else
  unsigned n = 0;
  for (; mask; mask &= mask - 1)
    n++;
  return n;
#endif
}

#endif
