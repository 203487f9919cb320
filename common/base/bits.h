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

/* Eight bytes as a number, the first one in its lowest bits. */
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
