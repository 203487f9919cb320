/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Masks of 64 bits, and of eight bytes. */
#ifndef HSR_COMMON_BITS_H
#define HSR_COMMON_BITS_H

#include <stdint.h>
#include <string.h>

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

/* The first of eight bytes that is not 0; 8 if all are. */
static inline int hsr_first_byte(const uint8_t *eight) {
#if defined __BYTE_ORDER__ && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  uint64_t mask;
  memcpy(&mask, eight, sizeof mask);
  return mask ? hsr_first_bit(mask) / 8 : 8;
#else
  int k = 0;
  while (k < 8 && !eight[k])
    k++;
  return k;
#endif
}

#endif
