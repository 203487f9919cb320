/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Puts a splat into the pixels of its footprint. Written twice: for every
 * machine, and for AVX-512, which has eight pixels of four channels in a
 * register. Both find the same indices wherever floats can tell them. */
#include "algorithms/volume/splats/splats.h"
#include "common/base/vector.h"

#include <string.h>

#if defined __x86_64__ && HSR_HAVE_TARGET_CLONES && !HSR_COUNTING
#include <immintrin.h>
#define HAVE_AVX512_TWIN 1
#define AVX512 __attribute__((target("avx512f,avx512bw,avx512vl")))
#endif

enum { LANES = HSR_SPLAT_LANES, OPACITY = HSR_SPLAT_OPACITY };

/* --- A pixel -------------------------------------------------------------- */

/* a + floor(b (65536 - by) / 65536). */
static inline uint16_t joined(uint32_t a, uint32_t b, uint32_t by) {
  return (uint16_t)(a + (b * (65536 - by) >> 16));
}

static inline uint16_t most_of(uint32_t sum) {
  return (uint16_t)(sum < UINT16_MAX ? sum : UINT16_MAX);
}

/* D is what the splat gives. */
static inline void put_channels(struct hsr_splat_picture *picture, size_t at,
                                const uint16_t D[4], enum hsr_splat_way way) {
  if (way == HSR_PUT_SUM) {
    for (int c = 0; c <= OPACITY; c++)
      picture->sum[at][c] += D[c];
    return;
  }
  uint16_t *E = picture->rgba[at];
  uint32_t by = way == HSR_PUT_OVER ? D[OPACITY] : E[OPACITY];
  for (int c = 0; c <= OPACITY; c++)
    E[c] = way == HSR_PUT_OVER    ? joined(D[c], E[c], by)
           : way == HSR_PUT_UNDER ? joined(E[c], D[c], by)
                                  : most_of((uint32_t)E[c] + D[c]);
}

static inline void put_weight(uint64_t *weight, uint64_t D, uint32_t by,
                              enum hsr_splat_way way) {
  *weight = way == HSR_PUT_OVER    ? D + (*weight * (65536 - by) >> 16)
            : way == HSR_PUT_UNDER ? *weight + (D * (65536 - by) >> 16)
                                   : *weight + D;
}

static inline void put_pixel(const struct hsr_placed *p,
                             struct hsr_splat_picture *picture, size_t at,
                             uint32_t weight, enum hsr_splat_way way) {
  uint16_t D[4];
  for (int c = 0; c <= OPACITY; c++)
    D[c] = (uint16_t)(weight * p->colour[c] >> 16);
  if (picture->weight) {
    uint32_t by =
        way == HSR_PUT_UNDER ? picture->rgba[at][OPACITY] : D[OPACITY];
    put_weight(&picture->weight[at], (uint64_t)weight * p->energy >> 16, by,
               way);
  }
  put_channels(picture, at, D, way);
}

void hsr_splats_add(const struct hsr_splats *s, const struct hsr_placed *p,
                    struct hsr_splat_picture *picture, int i, int j,
                    uint32_t weight) {
  put_pixel(p, picture, hsr_splats_at(s, picture, i, j), weight, HSR_PUT_ADD);
}

/* --- For every machine ---------------------------------------------------- */

static void put_portable(struct hsr_splats *s, const struct hsr_placed *p,
                         struct hsr_splat_picture *picture,
                         enum hsr_splat_way way) {
  int32_t index[LANES];
  for (int j = p->box.y0; j < p->box.y1; j++)
    for (int x = p->box.x0; x < p->box.x1; x += LANES) {
      hsr_splats_find(s, p, x, j, index);
      for (int l = 0; l < LANES; l++) {
        if (index[l] == HSR_FOOTPRINT)
          continue;
        HSR_STEP(s->tally, HSR_SPLAT_UPDATES, HSR_CELL(p->cell, 0, 0),
                 HSR_THE_WINDOW, HSR_AT(x + l, j), 0);
        HSR_TOUCH(s->tally, x + l, j);
        put_pixel(p, picture, hsr_splats_at(s, picture, x + l, j),
                  s->weight[index[l]], way);
      }
    }
}

/* --- For AVX-512 ---------------------------------------------------------- */

#ifdef HAVE_AVX512_TWIN

/* The footprint's square in floats. */
struct square {
  __m256 xx, xy, yy, p, q, error, least; /* least: 1 - error */
};

AVX512 static inline __m256 all(float x) {
  return _mm256_set1_ps(x);
}

AVX512 static inline __m256i lane_numbers(void) {
  return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
}

/* Where floats cannot tell. */
AVX512 __attribute__((noinline)) static __m256i
settle(const struct hsr_splats *s, const struct hsr_placed *p, int x, int j,
       unsigned doubt, __m256i index) {
  int32_t indices[LANES];
  _mm256_storeu_si256((__m256i *)indices, index);
  for (; doubt; doubt &= doubt - 1) {
    int l = __builtin_ctz(doubt);
    indices[l] = hsr_splats_index(s, p, x + l, j);
  }
  return _mm256_loadu_si256((const __m256i *)indices);
}

/* The weights of n pixels from x on, dx and dy from the middle. */
AVX512 static inline __m256i weigh(const struct hsr_splats *s,
                                   const struct hsr_placed *p,
                                   const struct square *k, int x, int j, int n,
                                   float dx, float dy) {
  __m256 X = _mm256_add_ps(all(dx), _mm256_cvtepi32_ps(lane_numbers()));
  __m256 xy = _mm256_mul_ps(k->xy, all(dy)),
         yy = _mm256_mul_ps(k->yy, all(dy * dy)),
         q = _mm256_add_ps(all(1), _mm256_mul_ps(k->q, all(dy)));
  __m256 over = _mm256_add_ps(
      _mm256_mul_ps(_mm256_add_ps(_mm256_mul_ps(k->xx, X), xy), X), yy);
  __m256 under = _mm256_add_ps(q, _mm256_mul_ps(k->p, X));
  __m256 kappa = _mm256_div_ps(over, _mm256_mul_ps(under, under));
  __mmask8 in = (__mmask8)(n < LANES ? (1u << n) - 1 : 0xff);
  in = _mm256_mask_cmp_ps_mask(in, kappa, all(HSR_FOOTPRINT + 1), _CMP_LT_OQ);
  __m256i index = _mm256_maskz_cvttps_epi32(in, kappa);
  __m256 part = _mm256_sub_ps(kappa, _mm256_cvtepi32_ps(index));
  __mmask8 low = _mm256_mask_cmp_ps_mask(in, part, k->error, _CMP_LT_OQ),
           high = _mm256_mask_cmp_ps_mask(in, part, k->least, _CMP_GT_OQ);
  unsigned doubt = (low & _mm256_test_epi32_mask(index, index)) | high;
  if (__builtin_expect(doubt != 0, 0))
    index = settle(s, p, x, j, doubt, index);
  in = _mm256_mask_cmp_epi32_mask(in, index, _mm256_set1_epi32(HSR_FOOTPRINT),
                                  _MM_CMPINT_LT);
  return _mm256_mmask_i32gather_epi32(_mm256_setzero_si256(), in, index,
                                      (const int *)s->weight, 4);
}

/* In each pixel the 16 bits from this byte on, four times. */
AVX512 static inline __m512i spread(__m512i pixels, int byte) {
  const int64_t low = 0x0100010001000100, step = 0x0202020202020202;
  int64_t first = low + byte / 2 * step, second = first + 4 * step;
  return _mm512_shuffle_epi8(
      pixels, _mm512_broadcast_i32x4(_mm_set_epi64x(second, first)));
}

/* b by / 65536, rounded up: what b loses when it is joined. */
AVX512 static inline __m512i taken(__m512i b, __m512i by) {
  __m512i low = _mm512_mullo_epi16(b, by), high = _mm512_mulhi_epu16(b, by);
  __mmask32 up = _mm512_test_epi16_mask(low, low);
  return _mm512_mask_add_epi16(high, up, high, _mm512_set1_epi16(1));
}

AVX512 static inline void put_lanes(struct hsr_splat_picture *picture,
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
  else {
    __m512i less =
        way == HSR_PUT_OVER ? taken(E, spread(D, 6)) : taken(D, spread(E, 6));
    E = _mm512_sub_epi16(_mm512_add_epi16(E, D), less);
  }
  _mm512_storeu_si512(to, E);
}

AVX512 static inline __attribute__((always_inline)) void
put_avx512(struct hsr_splats *s, const struct hsr_placed *p,
           struct hsr_splat_picture *picture, enum hsr_splat_way way) {
  int64_t rgba;
  memcpy(&rgba, p->colour, sizeof rgba);
  const __m512i colour = _mm512_set1_epi64(rgba);
  const struct square square = {all(p->xx),       all(2 * p->xy), all(p->yy),
                                all(p->p),        all(p->q),      all(p->error),
                                all(1 - p->error)};
  for (int j = p->box.y0; j < p->box.y1; j++) {
    float dy = (float)(hsr_sample_y(s->view, j) - p->y);
    for (int x = p->box.x0; x < p->box.x1; x += LANES) {
      float dx = (float)(hsr_sample_x(s->view, x) - p->x);
      __m256i weight = weigh(s, p, &square, x, j, p->box.x1 - x, dx, dy);
      __m512i D =
          _mm512_mulhi_epu16(spread(_mm512_cvtepu32_epi64(weight), 0), colour);
      put_lanes(picture, hsr_splats_at(s, picture, x, j), D, way);
    }
  }
}

AVX512 static void put_fast(struct hsr_splats *s, const struct hsr_placed *p,
                            struct hsr_splat_picture *picture,
                            enum hsr_splat_way way) {
  if (way == HSR_PUT_OVER)
    put_avx512(s, p, picture, HSR_PUT_OVER);
  else if (way == HSR_PUT_UNDER)
    put_avx512(s, p, picture, HSR_PUT_UNDER);
  else if (way == HSR_PUT_ADD)
    put_avx512(s, p, picture, HSR_PUT_ADD);
  else
    put_avx512(s, p, picture, HSR_PUT_SUM);
}

static bool is_fast(const struct hsr_placed *p,
                    const struct hsr_splat_picture *picture) {
  return p->is_small && !picture->weight &&
         __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512vl");
}

#else

static void put_fast(struct hsr_splats *s, const struct hsr_placed *p,
                     struct hsr_splat_picture *picture,
                     enum hsr_splat_way way) {
  put_portable(s, p, picture, way);
}

static bool is_fast(const struct hsr_placed *p,
                    const struct hsr_splat_picture *picture) {
  (void)p, (void)picture;
  return false;
}

#endif

void hsr_splats_put(struct hsr_splats *s, const struct hsr_placed *p,
                    struct hsr_splat_picture *picture, enum hsr_splat_way way) {
  HSR_STEP(s->tally, HSR_SPLAT_SPLATS, HSR_CELL(p->cell, 0, 0), HSR_THE_WINDOW,
           p->box, 2);
  if (is_fast(p, picture))
    put_fast(s, p, picture, way);
  else
    put_portable(s, p, picture, way);
}
