/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Puts a splat into the pixels of its footprint, for machines with AVX2 and
 * fused products, which have four pixels of four channels in a register: what
 * splat_put.c does, with the same indices wherever floats can tell them. */
#include "algorithms/engines/splats/splats.h"

#if HSR_SPLATS_HAVE_TWINS
#include <immintrin.h>

#define TWIN __attribute__((target("avx2,fma")))

/* Eight pixels are weighed at once: a piece of one row, or pieces of two rows,
 * as wide as PIECE. Those of a piece are put into the picture at once. */
enum { PIECE = 4, ALL = 2 * PIECE };

typedef __m256 floats;
typedef __m256i ints;
#define f_all(x) _mm256_set1_ps(x)
#define f_fma(a, b, c) _mm256_fmadd_ps(a, b, c)
#define f_fma_less(a, b, c) _mm256_fnmadd_ps(a, b, c) /* c - a b */
#define f_min(a, b) _mm256_min_ps(a, b)
#define f_max(a, b) _mm256_max_ps(a, b)
#define f_ratio(a, b) _mm256_div_ps(a, b)
#define f_inverse(a) f_ratio(f_all(1), a)
#define f_of_ints(a) _mm256_cvtepi32_ps(a)
#define i_all(x) _mm256_set1_epi32(x)
#define i_all64(x) _mm256_set1_epi64x(x)
#define i_numbers() _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7)
#define i_and(a, b) _mm256_and_si256(a, b)
#define i_right(a, n) _mm256_srli_epi32(a, n)
#define i_load(from) _mm256_loadu_si256((const __m256i *)(from))
#define i_store(to, a) _mm256_storeu_si256((__m256i *)(to), a)
#include "algorithms/engines/splats/splat_twin.h"

/* In each pixel its opacity, four times. */
TWIN static inline __m256i opacity(__m256i pixels) {
  return _mm256_shuffle_epi8(
      pixels, _mm256_broadcastsi128_si256(
                  _mm_set_epi64x(0x0f0e0f0e0f0e0f0e, 0x0706070607060706)));
}

/* floor(b (65536 - by) / 65536). */
TWIN static inline __m256i left(__m256i b, __m256i by) {
  const __m256i none = _mm256_setzero_si256();
  return _mm256_blendv_epi8(_mm256_mulhi_epu16(b, _mm256_sub_epi16(none, by)),
                            b, _mm256_cmpeq_epi16(by, none));
}

TWIN static inline void add_two(uint32_t (*sum)[4], __m128i D) {
  __m256i *to = (__m256i *)sum;
  _mm256_storeu_si256(
      to, _mm256_add_epi32(_mm256_loadu_si256(to), _mm256_cvtepu16_epi32(D)));
}

TWIN static inline void put_piece(struct hsr_splat_picture *picture, size_t at,
                                  __m256i D, enum hsr_splat_way way) {
  if (way == HSR_PUT_SUM) {
    add_two(picture->sum + at, _mm256_castsi256_si128(D));
    add_two(picture->sum + at + 2, _mm256_extracti128_si256(D, 1));
    return;
  }
  __m256i *to = (__m256i *)picture->rgba[at];
  __m256i E = _mm256_loadu_si256(to);
  if (way == HSR_PUT_ADD)
    E = _mm256_adds_epu16(E, D);
  else if (way == HSR_PUT_OVER)
    E = _mm256_add_epi16(D, left(E, opacity(D)));
  else
    E = _mm256_add_epi16(E, left(D, opacity(E)));
  _mm256_storeu_si256(to, E);
}

/* V of M = floor(weight length / 65536), in all lanes: hsr_splats_veil. */
TWIN static inline __m256i veil(const struct hsr_splats *s, __m256i weight,
                                uint32_t length) {
  const __m256i by = _mm256_set1_epi64x(length), one = i_all(65536);
  __m256i even = _mm256_srli_epi64(_mm256_mul_epu32(weight, by), 16),
          odd = _mm256_slli_epi64(
              _mm256_srli_epi64(
                  _mm256_mul_epu32(_mm256_srli_epi64(weight, 32), by), 16),
              32),
          M = _mm256_min_epu32(
              _mm256_or_si256(even, odd),
              i_all(HSR_SPLAT_HALVED * HSR_SPLAT_LESSENED - 1));
  __m256i H = _mm256_i32gather_epi32((const int *)s->halved, i_right(M, 8), 4),
          L = _mm256_i32gather_epi32((const int *)s->lessened,
                                     i_and(M, i_all(255)), 4);
  return _mm256_add_epi32(_mm256_sub_epi32(one, H),
                          _mm256_srli_epi32(_mm256_mullo_epi32(H, L), 16));
}

/* D of a piece's pixels. */
TWIN static inline __m256i given(const struct footprint *f, __m128i weight) {
  const __m256i four_times = _mm256_broadcastsi128_si256(
      _mm_set_epi64x(0x0908090809080908, 0x0100010001000100));
  return _mm256_mulhi_epu16(
      _mm256_shuffle_epi8(_mm256_cvtepu32_epi64(weight), four_times),
      f->colour);
}

/* Pixels beyond the box are not covered; those beyond the window are room that
 * the picture has to spare. */
ALWAYS void put_columns(struct hsr_splats *s, const struct hsr_placed *p,
                        struct hsr_splat_picture *picture,
                        const struct footprint *f, int past, int columns,
                        bool blurred, enum hsr_splat_way way) {
  const struct hsr_window *box = &p->box;
  const int rows = ALL / columns, x = box->x0 + past;
  const size_t second = columns == ALL ? PIECE : picture->stride;
  const int *const weights = (const int *)s->weight;
  const __m256i end = i_all(HSR_FOOTPRINT);
  const struct column c = column_of(f, p->dx, past);
  const __m256 dy = f_all(p->dy);
  __m256 row = f->row;
  size_t at = hsr_splats_at(picture, x, box->y0);
  for (int j = box->y0; j < box->y1; j += rows) {
    __m256 Y = _mm256_add_ps(dy, row);
    __m256 kappa = blurred ? blurred_kappa_of(f, &c, Y) : kappa_of(f, &c, Y);
    __m256i index = _mm256_cvttps_epi32(
                _mm256_fmsub_ps(kappa, f->least, f->constant)),
            most = _mm256_cvttps_epi32(
                _mm256_fmadd_ps(kappa, f->most, f->constant));
    unsigned same = (unsigned)_mm256_movemask_ps(
        _mm256_castsi256_ps(_mm256_cmpeq_epi32(index, most)));
    if (__builtin_expect(same != 0xff, 0))
      index = settle(s, p, x, j, columns, ~same & 0xff, index);
    __m256i weight =
        _mm256_i32gather_epi32(weights, _mm256_min_epu32(index, end), 4);
    if (!_mm256_testz_si256(weight, weight)) {
      if (s->veils)
        weight = veil(s, weight, p->length);
      put_piece(picture, at, given(f, _mm256_castsi256_si128(weight)), way);
      put_piece(picture, at + second,
                given(f, _mm256_extracti128_si256(weight, 1)), way);
    }
    row = _mm256_add_ps(row, f_all((float)rows));
    at += (size_t)rows * picture->stride;
  }
}

/* What is not wider than a piece is put two rows at once. */
SHAPE(put_narrow, PIECE, false)
SHAPE(put_wide, ALL, false)
SHAPE(put_blurred, ALL, true)

TWIN void hsr_splats_put_avx2(struct hsr_splats *s, const struct hsr_placed *p,
                              struct hsr_splat_picture *picture,
                              enum hsr_splat_way way) {
  if (p->is_blurred)
    put_blurred(s, p, picture, way);
  else if (p->box.x1 - p->box.x0 <= PIECE)
    put_narrow(s, p, picture, way);
  else
    put_wide(s, p, picture, way);
}

#endif
