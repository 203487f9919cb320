/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Puts a splat into the pixels of its footprint, for machines with AVX-512,
 * which have eight pixels of four channels in a register: what splat_put.c
 * does, with the same indices wherever floats can tell them. */
#include "algorithms/engines/splats/splats.h"

#if HSR_SPLATS_HAVE_TWINS
#include <immintrin.h>

#define TWIN __attribute__((target("avx512f,avx512bw,avx512vl")))

/* 16 pixels are weighed at once: of one row, of two rows of PIECE, or of four
 * rows of HALF. Eight of them are a piece, which is put into the picture at
 * once: it is of one row, or of two rows of HALF. */
enum { PIECE = HSR_SPLAT_LANES, HALF = PIECE / 2, ALL = 2 * PIECE };

typedef __m512 floats;
typedef __m512i ints;
#define f_all(x) _mm512_set1_ps(x)
#define f_fma(a, b, c) _mm512_fmadd_ps(a, b, c)
#define f_fma_less(a, b, c) _mm512_fnmadd_ps(a, b, c) /* c - a b */
#define f_min(a, b) _mm512_min_ps(a, b)
#define f_max(a, b) _mm512_max_ps(a, b)
#define f_ratio(a, b) _mm512_mul_ps(a, f_inverse(b))
#define f_of_ints(a) _mm512_cvtepi32_ps(a)
#define i_all(x) _mm512_set1_epi32(x)
#define i_all64(x) _mm512_set1_epi64(x)
#define i_numbers()                                                            \
  _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#define i_and(a, b) _mm512_and_si512(a, b)
#define i_right(a, n) _mm512_srli_epi32(a, (unsigned)(n))
#define i_load(from) _mm512_loadu_si512(from)
#define i_store(to, a) _mm512_storeu_si512(to, a)

/* 1 / x, to 2^-22 of it. */
TWIN static inline __m512 f_inverse(__m512 x) {
  __m512 y = _mm512_rcp14_ps(x);
  return _mm512_fmadd_ps(y, _mm512_fnmadd_ps(x, y, f_all(1)), y);
}

#include "algorithms/engines/splats/splat_twin.h"

/* W of indices, 0 where they are not in `in`, in every other word. 16 i + j,
 * moved up by 12 bits, leaves 2 j in the highest five of a word. */
TWIN static inline __m512i weigh(const struct hsr_splats *s, __mmask16 in,
                                 __m512i index) {
  __m512i i = _mm512_srli_epi32(index, 4);
  __m512i T = _mm512_permutex2var_epi16(_mm512_load_si512(s->knot), i,
                                        _mm512_load_si512(s->knot + 32)),
          fall = _mm512_permutex2var_epi16(_mm512_load_si512(s->fall), i,
                                           _mm512_load_si512(s->fall + 32));
  __m512i twice =
      _mm512_or_si512(_mm512_slli_epi16(index, 12), _mm512_set1_epi32(1 << 11));
  return _mm512_maskz_mov_epi32(
      in, _mm512_sub_epi16(T, _mm512_mulhi_epu16(fall, twice)));
}

/* In each pixel its opacity, four times. */
TWIN static inline __m512i opacity(__m512i pixels) {
  return _mm512_shuffle_epi8(
      pixels, _mm512_broadcast_i32x4(
                  _mm_set_epi64x(0x0f0e0f0e0f0e0f0e, 0x0706070607060706)));
}

/* floor(b (65536 - by) / 65536). */
TWIN static inline __m512i left(__m512i b, __m512i by) {
  return _mm512_mask_mulhi_epu16(b, _mm512_test_epi16_mask(by, by), b,
                                 _mm512_sub_epi16(_mm512_setzero_si512(), by));
}

/* A piece of the picture: eight pixels from `at` on, or four, and four more
 * from `second` on. */
TWIN static inline __m512i load(const uint16_t (*rgba)[4], size_t at,
                                size_t second) {
  if (second == at + HALF)
    return _mm512_loadu_si512(rgba + at);
  return _mm512_inserti64x4(
      _mm512_castsi256_si512(_mm256_loadu_si256((const __m256i *)(rgba + at))),
      _mm256_loadu_si256((const __m256i *)(rgba + second)), 1);
}

TWIN static inline void store(uint16_t (*rgba)[4], size_t at, size_t second,
                              __m512i E) {
  if (second == at + HALF) {
    _mm512_storeu_si512(rgba + at, E);
    return;
  }
  _mm256_storeu_si256((__m256i *)(rgba + at), _mm512_castsi512_si256(E));
  _mm256_storeu_si256((__m256i *)(rgba + second),
                      _mm512_extracti64x4_epi64(E, 1));
}

TWIN static inline void add_four(uint32_t (*sum)[4], __m256i D) {
  _mm512_storeu_si512(
      sum, _mm512_add_epi32(_mm512_loadu_si512(sum), _mm512_cvtepu16_epi32(D)));
}

TWIN static inline void put_piece(struct hsr_splat_picture *picture, size_t at,
                                  size_t second, __m512i D,
                                  enum hsr_splat_way way) {
  if (way == HSR_PUT_SUM) {
    add_four(picture->sum + at, _mm512_castsi512_si256(D));
    add_four(picture->sum + second, _mm512_extracti64x4_epi64(D, 1));
    return;
  }
  __m512i E = load((const uint16_t(*)[4])picture->rgba, at, second);
  if (way == HSR_PUT_ADD)
    E = _mm512_adds_epu16(E, D);
  else if (way == HSR_PUT_OVER)
    E = _mm512_add_epi16(D, left(E, opacity(D)));
  else
    E = _mm512_add_epi16(E, left(D, opacity(E)));
  store(picture->rgba, at, second, E);
}

/* V of M = floor(weight length / 65536), in all lanes: hsr_splats_veil. The
 * weight is in every other word. */
TWIN static inline __m512i veil(const struct hsr_splats *s, __m512i words,
                                uint32_t length) {
  const __m512i by = _mm512_set1_epi64(length), one = i_all(65536),
                weight = i_and(words, i_all(UINT16_MAX));
  __m512i even = _mm512_srli_epi64(_mm512_mul_epu32(weight, by), 16),
          odd = _mm512_slli_epi64(
              _mm512_srli_epi64(
                  _mm512_mul_epu32(_mm512_srli_epi64(weight, 32), by), 16),
              32),
          M = _mm512_min_epu32(
              _mm512_or_si512(even, odd),
              i_all(HSR_SPLAT_HALVED * HSR_SPLAT_LESSENED - 1));
  __m512i H = _mm512_i32gather_epi32(i_right(M, 8), s->halved, 4),
          L = _mm512_i32gather_epi32(i_and(M, i_all(255)), s->lessened, 4);
  return _mm512_add_epi32(_mm512_sub_epi32(one, H),
                          _mm512_srli_epi32(_mm512_mullo_epi32(H, L), 16));
}

/* D of a piece's pixels, the first or the second one. */
TWIN static inline __m512i given(const struct footprint *f, __m512i weight,
                                 int piece) {
  const int64_t four = 0x0002000200020002, n = PIECE * piece;
  const __m512i pixel = _mm512_setr_epi64(
      four * n, four * (n + 1), four * (n + 2), four * (n + 3), four * (n + 4),
      four * (n + 5), four * (n + 6), four * (n + 7));
  return _mm512_mulhi_epu16(_mm512_permutexvar_epi16(pixel, weight), f->colour);
}

/* Pixels beyond the box get a weight of 0 and stay as they are. To leave them
 * out would take a branch, which the processor often guesses wrong. */
ALWAYS void put_columns(struct hsr_splats *s, const struct hsr_placed *p,
                        struct hsr_splat_picture *picture,
                        const struct footprint *f, int past, int columns,
                        bool blurred, enum hsr_splat_way way) {
  const struct hsr_window *box = &p->box;
  const int rows = ALL / columns, x = box->x0 + past,
            n = box->x1 - x < columns ? box->x1 - x : columns;
  const size_t stride = picture->stride,
               second = columns == HALF ? stride : HALF,
               next = columns == ALL     ? PIECE
                      : columns == PIECE ? stride
                                         : 2 * stride;
  const unsigned in_box = ((1u << n) - 1) * (columns == ALL     ? 1
                                             : columns == PIECE ? 0x101
                                                                : 0x1111);
  const struct column c = column_of(f, p->dx, past);
  const __m512 dy = f_all(p->dy);
  const __m512i beyond = _mm512_set1_epi32(HSR_FOOTPRINT);
  __m512 row = f->row;
  size_t at = hsr_splats_at(picture, x, box->y0);
  for (int left = box->y1 - box->y0; left > 0; left -= rows) {
    __m512 Y = _mm512_add_ps(dy, row);
    __m512 kappa = blurred ? blurred_kappa_of(f, &c, Y) : kappa_of(f, &c, Y);
    __mmask16 in =
        (__mmask16)(left < rows ? in_box & ((1u << columns * left) - 1)
                                : in_box);
    __m512i index = _mm512_cvttps_epi32(
                _mm512_fmsub_ps(kappa, f->least, f->constant)),
            most = _mm512_cvttps_epi32(
                _mm512_fmadd_ps(kappa, f->most, f->constant));
    __mmask16 doubt = _mm512_mask_cmpneq_epi32_mask(in, index, most);
    if (__builtin_expect(doubt != 0, 0))
      index = settle(s, p, x, box->y1 - left, columns, doubt, index);
    in = _mm512_mask_cmplt_epu32_mask(in, index, beyond);
    __m512i weight = weigh(s, in, index);
    if (s->veils)
      weight = veil(s, weight, p->length);
    put_piece(picture, at, at + second, given(f, weight, 0), way);
    if (columns < ALL || n > PIECE)
      put_piece(picture, at + next, at + next + second, given(f, weight, 1),
                way);
    row = _mm512_add_ps(row, f_all((float)rows));
    at += (size_t)rows * stride;
  }
}

/* What is not wider than a piece, or half of it, is put two or four rows at
 * once. */
SHAPE(put_narrow, HALF, false)
SHAPE(put_middle, PIECE, false)
SHAPE(put_wide, ALL, false)
SHAPE(put_blurred, ALL, true)

TWIN void hsr_splats_put_avx512(struct hsr_splats *s,
                                const struct hsr_placed *p,
                                struct hsr_splat_picture *picture,
                                enum hsr_splat_way way) {
  const int width = p->box.x1 - p->box.x0;
  if (p->is_blurred)
    put_blurred(s, p, picture, way);
  else if (width <= HALF)
    put_narrow(s, p, picture, way);
  else if (width <= PIECE)
    put_middle(s, p, picture, way);
  else
    put_wide(s, p, picture, way);
}

#endif
