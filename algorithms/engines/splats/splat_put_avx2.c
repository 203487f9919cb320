/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Puts a splat into the pixels of its footprint, for machines with AVX2 and fused
 * products, which have four pixels of four channels in a register: what
 * splat_put.c does, with the same indices wherever floats can tell them. */
#include "algorithms/engines/splats/splats.h"

#if HSR_SPLATS_HAVE_TWINS
#include <immintrin.h>
#include <string.h>

#define AVX2 __attribute__((target("avx2,fma")))

/* Eight pixels are weighed at once: a piece of one row, or pieces of two rows, as
 * wide as PIECE. Those of a piece are put into the picture at once. */
enum { PIECE = 4, ALL = 2 * PIECE };

/* The footprint's square in floats. */
struct footprint {
  __m256 xx, xy, yy, p, q, constant, most, least; /* slope, and 2 - slope */
  __m256 column, row;                             /* of each lane */
  __m256i colour;
  __m256 way_x, way_y, s_x, s_y, from, to; /* of a blurred splat */
  const int *weight;
};

AVX2 static inline __m256 all(float x) {
  return _mm256_set1_ps(x);
}

AVX2 static inline __m256i all_of(int k) {
  return _mm256_set1_epi32(k);
}

/* `columns` is PIECE or ALL. */
AVX2 static inline struct footprint footprint_of(const struct hsr_splats *s,
                                                 const struct hsr_placed *p,
                                                 int columns, bool blurred) {
  const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7),
                column = _mm256_and_si256(lane, all_of(columns - 1)),
                row = _mm256_srli_epi32(_mm256_sub_epi32(lane, column), 2);
  int64_t rgba;
  memcpy(&rgba, p->colour, sizeof rgba);
  return (struct footprint){all(p->xx),
                            all(2 * p->xy),
                            all(p->yy),
                            all(p->p),
                            all(p->q),
                            all(blurred ? p->way_error : p->constant),
                            all(blurred ? 1 : p->slope),
                            all(blurred ? 1 : 2 - p->slope),
                            _mm256_cvtepi32_ps(column),
                            _mm256_cvtepi32_ps(row),
                            _mm256_set1_epi64x(rgba),
                            all(p->way_x),
                            all(p->way_y),
                            all(p->s_x),
                            all(p->s_y),
                            all((float)s->way_from),
                            all((float)s->way_to),
                            (const int *)s->weight};
}

AVX2 __attribute__((noinline)) static __m256i
settle(const struct hsr_splats *s, const struct hsr_placed *p, int x, int j,
       int columns, unsigned doubt, __m256i index) {
  uint32_t indices[ALL];
  _mm256_storeu_si256((__m256i *)indices, index);
  hsr_splats_settle(s, p, x, j, columns, doubt, indices);
  return _mm256_loadu_si256((const __m256i *)indices);
}

/* What is the same in a column of pixels: `past` columns right of the first. */
struct column {
  __m256 X, xx, xy, px;
};

AVX2 static inline struct column column_of(const struct footprint *f, float dx,
                                           int past) {
  __m256 column = _mm256_add_ps(all((float)past), f->column),
         X = _mm256_add_ps(all(dx), column);
  return (struct column){X, _mm256_mul_ps(f->xx, _mm256_mul_ps(X, X)),
                         _mm256_mul_ps(f->xy, X),
                         _mm256_fmadd_ps(f->p, X, all(1))};
}

AVX2 static inline __m256 kappa_of(const struct footprint *f,
                                   const struct column *c, __m256 Y) {
  __m256 w = _mm256_fmadd_ps(f->q, Y, c->px);
  __m256 square = _mm256_fmadd_ps(_mm256_fmadd_ps(f->yy, Y, c->xy), Y, c->xx);
  return _mm256_div_ps(square, _mm256_mul_ps(w, w));
}

/* The same from the way of a blurred splat: splat_blur.c. */
AVX2 static inline __m256 blurred_kappa_of(const struct footprint *f,
                                           const struct column *c, __m256 Y) {
  __m256 per_w = _mm256_div_ps(all(1), _mm256_fmadd_ps(f->q, Y, c->px));
  __m256 x = _mm256_mul_ps(c->X, per_w), y = _mm256_mul_ps(Y, per_w);
  __m256 t = _mm256_fmadd_ps(f->s_x, x, _mm256_mul_ps(f->s_y, y));
  t = _mm256_min_ps(_mm256_max_ps(t, f->from), f->to);
  x = _mm256_fnmadd_ps(t, f->way_x, x);
  y = _mm256_fnmadd_ps(t, f->way_y, y);
  __m256 yy = _mm256_mul_ps(f->yy, _mm256_mul_ps(y, y));
  return _mm256_fmadd_ps(_mm256_fmadd_ps(f->xx, x, _mm256_mul_ps(f->xy, y)), x,
                         yy);
}

/* In each pixel its opacity, four times. */
AVX2 static inline __m256i opacity(__m256i pixels) {
  return _mm256_shuffle_epi8(
      pixels, _mm256_broadcastsi128_si256(
                  _mm_set_epi64x(0x0f0e0f0e0f0e0f0e, 0x0706070607060706)));
}

/* floor(b (65536 - by) / 65536). */
AVX2 static inline __m256i left(__m256i b, __m256i by) {
  const __m256i none = _mm256_setzero_si256();
  return _mm256_blendv_epi8(_mm256_mulhi_epu16(b, _mm256_sub_epi16(none, by)),
                            b, _mm256_cmpeq_epi16(by, none));
}

AVX2 static inline void add_two(uint32_t (*sum)[4], __m128i D) {
  __m256i *to = (__m256i *)sum;
  _mm256_storeu_si256(
      to, _mm256_add_epi32(_mm256_loadu_si256(to), _mm256_cvtepu16_epi32(D)));
}

AVX2 static inline void put_piece(struct hsr_splat_picture *picture, size_t at,
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

/* D of a piece's pixels. */
AVX2 static inline __m256i given(const struct footprint *f, __m128i weight) {
  const __m256i four_times = _mm256_broadcastsi128_si256(
      _mm_set_epi64x(0x0908090809080908, 0x0100010001000100));
  return _mm256_mulhi_epu16(
      _mm256_shuffle_epi8(_mm256_cvtepu32_epi64(weight), four_times),
      f->colour);
}

/* Puts the columns of the box from x0 + past on, as many as are weighed at once.
 * Pixels beyond the box are not covered; those beyond the window are room that the
 * picture has to spare. */
AVX2 static inline __attribute__((always_inline)) void
put_columns(struct hsr_splats *s, const struct hsr_placed *p,
            struct hsr_splat_picture *picture, const struct footprint *f,
            int past, int columns, bool blurred, enum hsr_splat_way way) {
  const struct hsr_window *box = &p->box;
  const int rows = ALL / columns, x = box->x0 + past;
  const size_t second = columns == ALL ? PIECE : picture->stride;
  const __m256i end = all_of(HSR_FOOTPRINT);
  const struct column c = column_of(f, p->dx, past);
  const __m256 dy = all(p->dy);
  __m256 row = f->row;
  size_t at = hsr_splats_at(s, picture, x, box->y0);
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
        _mm256_i32gather_epi32(f->weight, _mm256_min_epu32(index, end), 4);
    if (!_mm256_testz_si256(weight, weight)) {
      put_piece(picture, at, given(f, _mm256_castsi256_si128(weight)), way);
      put_piece(picture, at + second,
                given(f, _mm256_extracti128_si256(weight, 1)), way);
    }
    row = _mm256_add_ps(row, all((float)rows));
    at += (size_t)rows * picture->stride;
  }
}

/* All columns of the box. */
AVX2 static inline __attribute__((always_inline)) void
put_box(struct hsr_splats *s, const struct hsr_placed *p,
        struct hsr_splat_picture *picture, int columns, bool blurred,
        enum hsr_splat_way way) {
  const struct footprint f = footprint_of(s, p, columns, blurred);
  const int width = p->box.x1 - p->box.x0;
  for (int past = 0; past < width; past += columns)
    put_columns(s, p, picture, &f, past, columns, blurred, way);
}

/* Each way has code of its own. */
AVX2 static inline __attribute__((always_inline)) void
put_shape(struct hsr_splats *s, const struct hsr_placed *p,
          struct hsr_splat_picture *picture, int columns, bool blurred,
          enum hsr_splat_way way) {
  if (way == HSR_PUT_OVER)
    put_box(s, p, picture, columns, blurred, HSR_PUT_OVER);
  else if (way == HSR_PUT_UNDER)
    put_box(s, p, picture, columns, blurred, HSR_PUT_UNDER);
  else if (way == HSR_PUT_ADD)
    put_box(s, p, picture, columns, blurred, HSR_PUT_ADD);
  else
    put_box(s, p, picture, columns, blurred, HSR_PUT_SUM);
}

/* So has each shape, as together they would need more registers than there are.
 * What is not wider than a piece is put two rows at once. */
#define SHAPE AVX2 static __attribute__((noinline)) void
SHAPE put_narrow(struct hsr_splats *s, const struct hsr_placed *p,
                 struct hsr_splat_picture *picture, enum hsr_splat_way way) {
  put_shape(s, p, picture, PIECE, false, way);
}
SHAPE put_wide(struct hsr_splats *s, const struct hsr_placed *p,
               struct hsr_splat_picture *picture, enum hsr_splat_way way) {
  put_shape(s, p, picture, ALL, false, way);
}
SHAPE put_blurred(struct hsr_splats *s, const struct hsr_placed *p,
                  struct hsr_splat_picture *picture, enum hsr_splat_way way) {
  put_shape(s, p, picture, ALL, true, way);
}

AVX2 void hsr_splats_put_avx2(struct hsr_splats *s, const struct hsr_placed *p,
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
