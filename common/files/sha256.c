/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/sha256.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { BLOCK = 64 };

struct sha256 {
  uint32_t h[8], k[64];
  uint64_t bytes;
};

/* The first 32 bits of the fraction of a root of p, which is square (2) or
 * cubic (3): the greatest x with (whole + x/2^32)^power <= p. */
static uint32_t root_bits(uint32_t p, int power) {
  unsigned __int128 low = 0, high = (unsigned __int128)p << 32;
  while (high - low > 1) {
    const unsigned __int128 middle = (low + high) / 2;
    const bool fits =
        power == 2
            ? middle * middle <= (unsigned __int128)p << 64
            /* middle < 8 * 2^32, so that its cube has fewer than 106 bits */
            : middle < (unsigned __int128)8 << 32 &&
                  middle * middle * middle <= (unsigned __int128)p << 96;
    if (fits)
      low = middle;
    else
      high = middle;
  }
  return (uint32_t)low;
}

/* The constants are roots of the first 64 primes. */
static void begin(struct sha256 *s) {
  s->bytes = 0;
  int n = 0;
  for (uint32_t p = 2; n < 64; p++) {
    bool prime = true;
    for (uint32_t q = 2; q * q <= p; q++)
      prime &= p % q != 0;
    if (!prime)
      continue;
    if (n < 8)
      s->h[n] = root_bits(p, 2);
    s->k[n++] = root_bits(p, 3);
  }
}

static uint32_t turn(uint32_t x, int n) {
  return x >> n | x << (32 - n);
}

static void schedule(const unsigned char *block, uint32_t w[64]) {
  for (int t = 0; t < 16; t++)
    w[t] = (uint32_t)block[4 * t] << 24 | (uint32_t)block[4 * t + 1] << 16 |
           (uint32_t)block[4 * t + 2] << 8 | block[4 * t + 3];
  for (int t = 16; t < 64; t++) {
    const uint32_t a = w[t - 15], b = w[t - 2];
    w[t] = w[t - 16] + (turn(a, 7) ^ turn(a, 18) ^ a >> 3) + w[t - 7] +
           (turn(b, 17) ^ turn(b, 19) ^ b >> 10);
  }
}

static void add_block(struct sha256 *s, const unsigned char *block) {
  uint32_t w[64], v[8];
  schedule(block, w);
  memcpy(v, s->h, sizeof v);
  for (int t = 0; t < 64; t++) {
    const uint32_t a = v[0], e = v[4];
    const uint32_t one = v[7] + (turn(e, 6) ^ turn(e, 11) ^ turn(e, 25)) +
                         ((e & v[5]) ^ (~e & v[6])) + s->k[t] + w[t];
    const uint32_t two = (turn(a, 2) ^ turn(a, 13) ^ turn(a, 22)) +
                         ((a & v[1]) ^ (a & v[2]) ^ (v[1] & v[2]));
    memmove(v + 1, v, 7 * sizeof *v);
    v[4] += one;
    v[0] = one + two;
  }
  for (int k = 0; k < 8; k++)
    s->h[k] += v[k];
}

/* The last bytes, fewer than a block, and the padding. */
static void end(struct sha256 *s, const unsigned char *rest, size_t n,
                char text[HSR_SHA256_TEXT]) {
  unsigned char last[2 * BLOCK] = {0};
  const size_t all = n + 9 <= BLOCK ? BLOCK : 2 * BLOCK;
  memcpy(last, rest, n);
  last[n] = 0x80;
  for (int k = 0; k < 8; k++)
    last[all - 1 - (size_t)k] = (unsigned char)(8 * s->bytes >> 8 * k);
  for (size_t k = 0; k < all; k += BLOCK)
    add_block(s, last + k);
  for (int k = 0; k < 8; k++)
    snprintf(text + 8 * k, 9, "%08x", s->h[k]);
}

static enum hsr_status fail(const char *path, struct hsr_error *err) {
  return hsr_fail(err, HSR_E_INPUT, "%.300s: cannot be read: %s", path,
                  strerror(errno));
}

enum hsr_status hsr_sha256_of_file(const char *path, char text[HSR_SHA256_TEXT],
                                   uint64_t *bytes, struct hsr_error *err) {
  unsigned char buffer[BLOCK << 10];
  struct sha256 s;
  FILE *in = fopen(path, "rb");
  if (!in)
    return fail(path, err);
  begin(&s);
  size_t n;
  /* A short read is the last one. */
  while ((n = fread(buffer, 1, sizeof buffer, in)) == sizeof buffer) {
    s.bytes += n;
    for (size_t k = 0; k < n; k += BLOCK)
      add_block(&s, buffer + k);
  }
  s.bytes += n;
  const enum hsr_status status = ferror(in) ? fail(path, err) : HSR_OK;
  fclose(in);
  if (status)
    return status;
  size_t k = 0;
  for (; k + BLOCK <= n; k += BLOCK)
    add_block(&s, buffer + k);
  end(&s, buffer + k, n - k, text);
  *bytes = s.bytes;
  return HSR_OK;
}
