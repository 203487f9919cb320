/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What masks.c does with the lines of a cell, for machines with AVX-512: eight
 * samples, or eight lines, at a time. Each function does what its twin without
 * the suffix, in masks.c, does, but rounds less. Included in masks.c only. */
#ifndef HSR_ALGORITHMS_TILING_MASKS_AVX512_H
#define HSR_ALGORITHMS_TILING_MASKS_AVX512_H

#define AVX512 __attribute__((target("avx512f")))

AVX512 static inline void split_avx512(const struct hsr_mask_line *line,
                                       double f,
                                       const struct hsr_mask_places *places,
                                       uint64_t *inside, uint64_t *outside) {
  __m512d a = _mm512_set1_pd(line->a), b = _mm512_set1_pd(line->b);
  __m512d from = _mm512_set1_pd(f), error = _mm512_set1_pd(line->error);
  __m512d minus = _mm512_set1_pd(-line->error);
  uint64_t in = 0, out = 0;
  for (int row = 0; row < 8; row++) {
    __m512d x = _mm512_loadu_pd(places->x + 8 * row);
    __m512d y = _mm512_loadu_pd(places->y + 8 * row);
    __m512d at = _mm512_fmadd_pd(a, x, _mm512_fmadd_pd(b, y, from));
    in |= (uint64_t)_mm512_cmp_pd_mask(at, error, _CMP_GT_OQ) << (8 * row);
    out |= (uint64_t)_mm512_cmp_pd_mask(at, minus, _CMP_LT_OQ) << (8 * row);
  }
  *inside = in;
  *outside = out;
}

/* Eight lines, each field by itself. */
struct lines_avx512 {
  __m512d a, b, c, error, span, per_a, per_b;
};

/* The first lines of a list, by a transposition of 8 x 8; of places beyond its
 * n, from 1 to 8, the first again. */
AVX512 static inline struct lines_avx512
load_lines_avx512(const struct hsr_mask_line *line, const uint32_t *list,
                  uint32_t n) {
  _Static_assert(sizeof *line == 7 * sizeof(double), "a row of 7 fields");
  const __mmask8 fields = 0x7f;
  __m512d row[8], pair[8], quad[8];
  for (uint32_t k = 0; k < 8; k++)
    row[k] = _mm512_maskz_loadu_pd(fields, &line[list[k < n ? k : 0]]);
  for (int k = 0; k < 8; k += 2) {
    pair[k] = _mm512_unpacklo_pd(row[k], row[k + 1]);
    pair[k + 1] = _mm512_unpackhi_pd(row[k], row[k + 1]);
  }
  for (int k = 0; k < 2; k++)
    for (int half = 0; half < 8; half += 4) {
      quad[half + k] =
          _mm512_shuffle_f64x2(pair[half + k], pair[half + k + 2], 0x88);
      quad[half + k + 2] =
          _mm512_shuffle_f64x2(pair[half + k], pair[half + k + 2], 0xdd);
    }
  struct lines_avx512 lines = {
      .a = _mm512_shuffle_f64x2(quad[0], quad[4], 0x88),
      .b = _mm512_shuffle_f64x2(quad[1], quad[5], 0x88),
      .c = _mm512_shuffle_f64x2(quad[2], quad[6], 0x88),
      .error = _mm512_shuffle_f64x2(quad[3], quad[7], 0x88),
      .span = _mm512_shuffle_f64x2(quad[0], quad[4], 0xdd),
      .per_a = _mm512_shuffle_f64x2(quad[1], quad[5], 0xdd),
      .per_b = _mm512_shuffle_f64x2(quad[2], quad[6], 0xdd)};
  return lines;
}

AVX512 static inline __m512d larger_avx512(__m512d x, double than) {
  return _mm512_max_pd(x, _mm512_set1_pd(than)); /* `than` if x is no number */
}

AVX512 static inline __mmask8 exceeds_avx512(__m512d x, __m512d y) {
  return _mm512_cmp_pd_mask(x, y, _CMP_GT_OQ);
}

/* The interval, of so many, in which a side is crossed: x of 1 along it. */
AVX512 static inline __m512d interval_avx512(__m512d x, int intervals) {
  __m512d at = _mm512_roundscale_pd(x, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
  return _mm512_min_pd(larger_avx512(at, 0), _mm512_set1_pd(intervals - 1));
}

/* entry_of() of all lines, which are `corner` at a cell's corner 0; a bit of
 * the result is set where that is inside. */
AVX512 static inline __mmask8
find_entries_avx512(int intervals, const struct lines_avx512 *line,
                    __m512d corner, int size, int entry[8]) {
  __m512d side = _mm512_set1_pd(size), zero = _mm512_setzero_pd();
  __m512d k = _mm512_set1_pd(intervals);
  __m512d way = _mm512_set1_pd(1.0 / size), back = _mm512_sub_pd(zero, way);
  __m512d step_x = _mm512_mul_pd(line->a, side);
  __m512d step_y = _mm512_mul_pd(line->b, side);
  __m512d least =
      _mm512_mul_pd(_mm512_set1_pd(2 / HSR_TRIAGE_SLACK), line->error);
  __mmask8 known_x = exceeds_avx512(_mm512_abs_pd(step_x), least);
  __mmask8 known_y = exceeds_avx512(_mm512_abs_pd(step_y), least);

  /* The sides that are crossed: the first and the second. */
  __m512d f1 = _mm512_add_pd(corner, step_x);
  __m512d f2 = _mm512_add_pd(f1, step_y), f3 = _mm512_add_pd(corner, step_y);
  unsigned in0 = exceeds_avx512(corner, zero), in1 = exceeds_avx512(f1, zero);
  unsigned in2 = exceeds_avx512(f2, zero), in3 = exceeds_avx512(f3, zero);
  unsigned side0 = in0 ^ in1, side1 = in1 ^ in2, side2 = in2 ^ in3,
           side3 = in3 ^ in0;
  unsigned first1 = ~side0 & side1, second2 = ~side3 & side2;
  unsigned known_first = (first1 & known_y) | (~first1 & known_x);
  unsigned known_second = (second2 & known_x) | (~second2 & known_y);
  unsigned two = (side0 | side1 | side2) & ~(side0 & side1 & side2 & side3);

  /* Where they are crossed. */
  __m512d at0 = _mm512_mul_pd(corner, _mm512_mul_pd(line->per_a, back));
  __m512d at1 = _mm512_mul_pd(f1, _mm512_mul_pd(line->per_b, back));
  __m512d at2 = _mm512_mul_pd(f2, _mm512_mul_pd(line->per_a, way));
  __m512d at3 = _mm512_mul_pd(f3, _mm512_mul_pd(line->per_b, way));
  __m512d first = _mm512_mask_blend_pd((__mmask8)side0, at2, at0);
  __m512d second = _mm512_mask_blend_pd((__mmask8)side3, at1, at3);
  first = _mm512_mask_blend_pd((__mmask8)first1, first, at1);
  second = _mm512_mask_blend_pd((__mmask8)second2, second, at2);
  first = interval_avx512(_mm512_mul_pd(first, k), intervals);
  second = interval_avx512(_mm512_mul_pd(second, k), intervals);

  /* The pairs are (0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3). */
  __m512d pair = _mm512_set1_pd(5);
  pair = _mm512_mask_mov_pd(pair, (__mmask8)first1, _mm512_set1_pd(4));
  pair =
      _mm512_mask_mov_pd(pair, (__mmask8)(first1 & second2), _mm512_set1_pd(3));
  pair = _mm512_mask_mov_pd(pair, (__mmask8)side0, _mm512_set1_pd(2));
  pair =
      _mm512_mask_mov_pd(pair, (__mmask8)(side0 & second2), _mm512_set1_pd(1));
  pair = _mm512_mask_mov_pd(pair, (__mmask8)(side0 & ~side2 & ~side3), zero);
  __m512d place = _mm512_fmadd_pd(_mm512_fmadd_pd(pair, k, first), k, second);
  place = _mm512_mask_mov_pd(
      _mm512_set1_pd(-1), (__mmask8)(two & known_first & known_second), place);
  _mm256_storeu_si256((__m256i *)(void *)entry, _mm512_cvttpd_epi32(place));
  return (__mmask8)in0;
}

AVX512 static bool compose_avx512(const struct hsr_masks *p,
                                  const struct hsr_mask_polygon *polygon,
                                  const struct hsr_mask_cell *cell,
                                  const uint32_t *list, uint32_t n,
                                  struct hsr_mask_lines *active,
                                  struct hsr_triage *mask) {
  if (!n || n > 8)
    return compose(p, polygon, cell, list, n, active, mask);
  struct lines_avx512 line = load_lines_avx512(polygon->line, list, n);
  double half = 0.5 * cell->size;
  __m512d middle = _mm512_fmadd_pd(
      line.a, _mm512_set1_pd(cell->x + half),
      _mm512_fmadd_pd(line.b, _mm512_set1_pd(cell->y + half), line.c));
  __m512d reach =
      _mm512_mul_pd(line.span, _mm512_set1_pd(p->anywhere ? half : half - 0.5));
  __mmask8 outside =
      exceeds_avx512(_mm512_sub_pd(_mm512_setzero_pd(), line.error),
                     _mm512_add_pd(middle, reach));
  __mmask8 inside = exceeds_avx512(_mm512_sub_pd(middle, reach), line.error);
  unsigned crossing = ~(unsigned)inside & ((1u << n) - 1);
  *mask = (struct hsr_triage){ALL, 0};
  active->n = 0;
  if (outside)
    return false;
  if (!crossing)
    return true;
  int entry[8];
  __m512d corner = _mm512_fnmadd_pd(_mm512_add_pd(line.a, line.b),
                                    _mm512_set1_pd(half), middle);
  unsigned has_corner = find_entries_avx512(p->tables->intervals, &line, corner,
                                            cell->size, entry);
  for (; crossing; crossing &= crossing - 1) {
    int k = hsr_first_bit(crossing);
    struct hsr_triage edge = {0, 0};
    if (entry[k] >= 0)
      edge = p->tables->mask[entry[k]];
    if (!(has_corner >> k & 1))
      edge = (struct hsr_triage){edge.v, edge.c};
    active->number[active->n] = list[k];
    active->inside[active->n++] = edge.c;
    mask->c &= edge.c;
    mask->v |= edge.v;
  }
  return true;
}

MASK_TWIN(avx512, AVX512, split_avx512, compose_avx512);

#endif
