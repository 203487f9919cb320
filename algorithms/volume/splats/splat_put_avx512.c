/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Puts a splat into the pixels of its footprint, for machines with AVX-512,
 * which have eight pixels of four channels in a register: what splat_put.c does,
 * with the same indices wherever floats can tell them. */
#include "algorithms/volume/splats/splats.h"

#if HSR_SPLATS_HAVE_TWINS
#include <immintrin.h>
#include <string.h>

#define AVX512 __attribute__((target("avx512f,avx512bw,avx512vl")))

/* 16 pixels are weighed at once: a piece of one row, or pieces of two rows, as
 * wide as PIECE. Those of a piece are put into the picture at once. */
enum { PIECE = HSR_SPLAT_LANES, ALL = 2 * PIECE };

/* The footprint's square in floats, and the kernel's table. */
struct footprint {
  __m512 xx, xy, yy, p, q, constant, most, least; /* slope, and 2 - slope */
  __m512 column, row;                             /* of each lane */
  __m512i T[2], fall[2];                          /* fall: T_i - T_(i+1) */
  __m512i colour;
  __m512 way_x, way_y, s_x, s_y, from, to; /* of a blurred splat */
};

AVX512 static inline __m512 all(float x) {
  return _mm512_set1_ps(x);
}

/* `columns` is PIECE or ALL. */
AVX512 static inline struct footprint footprint_of(const struct hsr_splats *s,
                                                   const struct hsr_placed *p,
                                                   int columns) {
  const __m512i lane = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11,
                                         12, 13, 14, 15),
                column = _mm512_and_si512(lane, _mm512_set1_epi32(columns - 1)),
                row = _mm512_srli_epi32(_mm512_sub_epi32(lane, column), 3);
  int64_t rgba;
  memcpy(&rgba, p->colour, sizeof rgba);
  struct footprint f = {
      all(p->xx),
      all(2 * p->xy),
      all(p->yy),
      all(p->p),
      all(p->q),
      all(p->is_blurred ? p->way_error : p->constant),
      all(p->is_blurred ? 1 : p->slope),
      all(p->is_blurred ? 1 : 2 - p->slope),
      _mm512_cvtepi32_ps(column),
      _mm512_cvtepi32_ps(row),
      {_mm512_loadu_si512(s->knot), _mm512_loadu_si512(s->knot + 32)},
      {_mm512_setzero_si512()},
      _mm512_set1_epi64(rgba),
      all(p->way_x),
      all(p->way_y),
      all(p->s_x),
      all(p->s_y),
      all((float)s->way_from),
      all((float)s->way_to)};
  for (int h = 0; h < 2; h++)
    f.fall[h] =
        _mm512_sub_epi16(f.T[h], _mm512_loadu_si512(s->knot + 32 * h + 1));
  return f;
}

AVX512 __attribute__((noinline)) static __m512i
settle(const struct hsr_splats *s, const struct hsr_placed *p, int x, int j,
       int columns, unsigned doubt, __m512i index) {
  uint32_t indices[ALL];
  _mm512_storeu_si512(indices, index);
  hsr_splats_settle(s, p, x, j, columns, doubt, indices);
  return _mm512_loadu_si512(indices);
}

/* 1 / x, to 2^-22 of it. */
AVX512 static inline __m512 inverse(__m512 x) {
  __m512 y = _mm512_rcp14_ps(x);
  return _mm512_fmadd_ps(y, _mm512_fnmadd_ps(x, y, all(1)), y);
}

/* What is the same in a column of pixels. */
struct column {
  __m512 X, xx, xy, px;
};

AVX512 static inline struct column column_of(const struct footprint *f,
                                             float dx) {
  __m512 X = _mm512_add_ps(all(dx), f->column);
  return (struct column){X, _mm512_mul_ps(f->xx, _mm512_mul_ps(X, X)),
                         _mm512_mul_ps(f->xy, X),
                         _mm512_fmadd_ps(f->p, X, all(1))};
}

AVX512 static inline __m512 kappa_of(const struct footprint *f,
                                     const struct column *c, __m512 Y) {
  __m512 w = _mm512_fmadd_ps(f->q, Y, c->px);
  __m512 square = _mm512_fmadd_ps(_mm512_fmadd_ps(f->yy, Y, c->xy), Y, c->xx);
  return _mm512_mul_ps(square, inverse(_mm512_mul_ps(w, w)));
}

/* The same from the way of a blurred splat: splat_blur.c. */
AVX512 static inline __m512 blurred_kappa_of(const struct footprint *f,
                                             const struct column *c, __m512 Y) {
  __m512 per_w = inverse(_mm512_fmadd_ps(f->q, Y, c->px));
  __m512 x = _mm512_mul_ps(c->X, per_w), y = _mm512_mul_ps(Y, per_w);
  __m512 t = _mm512_fmadd_ps(f->s_x, x, _mm512_mul_ps(f->s_y, y));
  t = _mm512_min_ps(_mm512_max_ps(t, f->from), f->to);
  x = _mm512_fnmadd_ps(t, f->way_x, x);
  y = _mm512_fnmadd_ps(t, f->way_y, y);
  __m512 yy = _mm512_mul_ps(f->yy, _mm512_mul_ps(y, y));
  return _mm512_fmadd_ps(_mm512_fmadd_ps(f->xx, x, _mm512_mul_ps(f->xy, y)), x,
                         yy);
}

/* W of indices, 0 where they are not in `in`, in every other word. 16 i + j,
 * moved up by 12 bits, leaves 2 j in the highest five of a word. */
AVX512 static inline __m512i weigh(const struct footprint *f, __mmask16 in,
                                   __m512i index) {
  __m512i i = _mm512_srli_epi32(index, 4);
  __m512i T = _mm512_permutex2var_epi16(f->T[0], i, f->T[1]),
          fall = _mm512_permutex2var_epi16(f->fall[0], i, f->fall[1]);
  __m512i twice =
      _mm512_or_si512(_mm512_slli_epi16(index, 12), _mm512_set1_epi32(1 << 11));
  return _mm512_maskz_mov_epi32(
      in, _mm512_sub_epi16(T, _mm512_mulhi_epu16(fall, twice)));
}

/* In each pixel its opacity, four times. */
AVX512 static inline __m512i opacity(__m512i pixels) {
  return _mm512_shuffle_epi8(
      pixels, _mm512_broadcast_i32x4(
                  _mm_set_epi64x(0x0f0e0f0e0f0e0f0e, 0x0706070607060706)));
}

/* floor(b (65536 - by) / 65536). */
AVX512 static inline __m512i left(__m512i b, __m512i by) {
  return _mm512_mask_mulhi_epu16(b, _mm512_test_epi16_mask(by, by), b,
                                 _mm512_sub_epi16(_mm512_setzero_si512(), by));
}

AVX512 static inline void put_piece(struct hsr_splat_picture *picture,
                                    size_t at, __m512i D,
                                    enum hsr_splat_way way) {
  if (way == HSR_PUT_SUM) {
    uint32_t *sum = picture->sum[at];
    __m512i low = _mm512_cvtepu16_epi32(_mm512_castsi512_si256(D)),
            high = _mm512_cvtepu16_epi32(_mm512_extracti64x4_epi64(D, 1));
    _mm512_storeu_si512(sum, _mm512_add_epi32(_mm512_loadu_si512(sum), low));
    _mm512_storeu_si512(sum + 16,
                        _mm512_add_epi32(_mm512_loadu_si512(sum + 16), high));
    return;
  }
  uint16_t *to = picture->rgba[at];
  __m512i E = _mm512_loadu_si512(to);
  if (way == HSR_PUT_ADD)
    E = _mm512_adds_epu16(E, D);
  else if (way == HSR_PUT_OVER)
    E = _mm512_add_epi16(D, left(E, opacity(D)));
  else
    E = _mm512_add_epi16(E, left(D, opacity(E)));
  _mm512_storeu_si512(to, E);
}

/* D of the piece's pixels, the first or the second one. */
AVX512 static inline __m512i given(const struct footprint *f, __m512i weight,
                                   int piece) {
  const int64_t four = 0x0002000200020002, n = PIECE * piece;
  const __m512i pixel = _mm512_setr_epi64(
      four * n, four * (n + 1), four * (n + 2), four * (n + 3), four * (n + 4),
      four * (n + 5), four * (n + 6), four * (n + 7));
  return _mm512_mulhi_epu16(_mm512_permutexvar_epi16(pixel, weight), f->colour);
}

/* Puts the columns of the box from x on, as many as are weighed at once. */
AVX512 static inline __attribute__((always_inline)) void
put_columns(struct hsr_splats *s, const struct hsr_placed *p,
            struct hsr_splat_picture *picture, const struct footprint *f, int x,
            int columns, bool blurred, enum hsr_splat_way way) {
  const struct hsr_window *box = &p->box;
  const int rows = ALL / columns,
            n = box->x1 - x < columns ? box->x1 - x : columns;
  const size_t second = columns == ALL ? PIECE : picture->stride;
  const __mmask16 one = (__mmask16)((1u << n) - 1),
                  two =
                      (__mmask16)(columns == PIECE ? one << PIECE | one : one);
  const struct column c =
      column_of(f, (float)(hsr_sample_x(s->view, x) - p->x));
  const __m512 dy = all((float)(hsr_sample_y(s->view, box->y0) - p->y));
  const __m512i beyond = _mm512_set1_epi32(HSR_FOOTPRINT);
  __m512 row = f->row;
  size_t at = hsr_splats_at(s, picture, x, box->y0);
  for (int j = box->y0; j < box->y1; j += rows) {
    __m512 Y = _mm512_add_ps(dy, row);
    __m512 kappa = blurred ? blurred_kappa_of(f, &c, Y) : kappa_of(f, &c, Y);
    __mmask16 in = j + rows <= box->y1 ? two : one;
    __m512i index = _mm512_cvttps_epi32(
                _mm512_fmsub_ps(kappa, f->least, f->constant)),
            most = _mm512_cvttps_epi32(
                _mm512_fmadd_ps(kappa, f->most, f->constant));
    __mmask16 doubt = _mm512_mask_cmpneq_epi32_mask(in, index, most);
    if (__builtin_expect(doubt != 0, 0))
      index = settle(s, p, x, j, columns, doubt, index);
    in = _mm512_mask_cmplt_epu32_mask(in, index, beyond);
    __m512i weight = weigh(f, in, index);
    put_piece(picture, at, given(f, weight, 0), way);
    if (columns == ALL ? n > PIECE : j + 1 < box->y1)
      put_piece(picture, at + second, given(f, weight, 1), way);
    row = _mm512_add_ps(row, all((float)rows));
    at += (size_t)rows * picture->stride;
  }
}

/* What is not wider than a piece is put two rows at once. */
AVX512 static inline __attribute__((always_inline)) void
put_box(struct hsr_splats *s, const struct hsr_placed *p,
        struct hsr_splat_picture *picture, enum hsr_splat_way way) {
  if (p->is_blurred) {
    const struct footprint f = footprint_of(s, p, ALL);
    for (int x = p->box.x0; x < p->box.x1; x += ALL)
      put_columns(s, p, picture, &f, x, ALL, true, way);
  } else if (p->box.x1 - p->box.x0 <= PIECE) {
    const struct footprint f = footprint_of(s, p, PIECE);
    put_columns(s, p, picture, &f, p->box.x0, PIECE, false, way);
  } else {
    const struct footprint f = footprint_of(s, p, ALL);
    for (int x = p->box.x0; x < p->box.x1; x += ALL)
      put_columns(s, p, picture, &f, x, ALL, false, way);
  }
}

AVX512 void hsr_splats_put_avx512(struct hsr_splats *s,
                                  const struct hsr_placed *p,
                                  struct hsr_splat_picture *picture,
                                  enum hsr_splat_way way) {
  if (way == HSR_PUT_OVER)
    put_box(s, p, picture, HSR_PUT_OVER);
  else if (way == HSR_PUT_UNDER)
    put_box(s, p, picture, HSR_PUT_UNDER);
  else if (way == HSR_PUT_ADD)
    put_box(s, p, picture, HSR_PUT_ADD);
  else
    put_box(s, p, picture, HSR_PUT_SUM);
}

#endif
