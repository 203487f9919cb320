/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions of 64-bit masks, and of eight bytes read as one number. */
#ifndef HSR_COMMON_BITS_H
#define HSR_COMMON_BITS_H

#include <stdint.h>
#include <string.h>

/* Returns the number of the lowest bit that is set, from 0. `mask` must not be
 * 0. */
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

/* Returns how many bits are set. */
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

/* Returns byte[0] .. byte[7] as one number, with byte[0] in the lowest bits.
 * The pointer need not be aligned. */
static inline uint64_t hsr_eight_bytes(const uint8_t *byte) {
  uint64_t word = 0;
#if defined __BYTE_ORDER__ && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  memcpy(&word, byte, sizeof word);
#else
  for (int k = 0; k < 8; k++)
    word |= (uint64_t)byte[k] << 8 * k;
#endif
  return word;
}

#endif
