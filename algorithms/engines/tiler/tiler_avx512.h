/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lanes of tiler_twin.h for machines with AVX-512: sixteen of them.
 * Included in tiler.c only. */
#define TWIN(name) name##_avx512
#define VECTOR __attribute__((target("avx512f")))
#define WIDTH 16
#define FEWEST 0 /* small triangles in step */

typedef __m512 TWIN(floats);
typedef __m512i TWIN(ints);
typedef __mmask16 TWIN(mask);
typedef __mmask16 TWIN(kept);
typedef __m512i TWIN(names);

#define f_all(x) _mm512_set1_ps(x)
#define f_fma(a, b, c) _mm512_fmadd_ps(a, b, c)
#define f_min(a, b) _mm512_min_ps(a, b)
#define f_max(a, b) _mm512_max_ps(a, b)
#define f_load(from) _mm512_loadu_ps(from)
#define f_load_where(m, from) _mm512_maskz_loadu_ps(m, from)
#define f_store(to, a) _mm512_storeu_ps(to, a)
#define f_of_ints(a) _mm512_cvtepi32_ps(a)
#define f_pick(m, yes, no) _mm512_mask_mov_ps(no, m, yes)
#define f_where(m, a) _mm512_maskz_mov_ps(m, a)
#define f_bits(a) _mm512_castps_si512(a)
#define f_of_bits(a) _mm512_castsi512_ps(a)

#define i_all(x) _mm512_set1_epi32(x)
#define i_numbers()                                                            \
  _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0)
#define i_add(a, b) _mm512_add_epi32(a, b)
#define i_sub(a, b) _mm512_sub_epi32(a, b)
#define i_mul(a, b) _mm512_mullo_epi32(a, b)
#define i_min(a, b) _mm512_min_epi32(a, b)
#define i_max(a, b) _mm512_max_epi32(a, b)
#define i_left(a, n) _mm512_slli_epi32(a, n)
#define i_right(a, n) _mm512_srai_epi32(a, n)
#define i_load(from) _mm512_loadu_si512(from)
#define i_store(to, a) _mm512_storeu_si512(to, a)
#define i_pick(m, yes, no) _mm512_mask_mov_epi32(no, m, yes)
#define i_where(m, a) _mm512_maskz_mov_epi32(m, a)

/* Each lane of four 128-bit vectors, in twos of 32 bits, or 64. */
#define i_low32(a, b) _mm512_unpacklo_epi32(a, b)
#define i_high32(a, b) _mm512_unpackhi_epi32(a, b)
#define i_low64(a, b) _mm512_unpacklo_epi64(a, b)
#define i_high64(a, b) _mm512_unpackhi_epi64(a, b)

/* Of the lanes of m. */
#define f_gt(m, a, b) _mm512_mask_cmp_ps_mask(m, a, b, _CMP_GT_OQ)
#define f_ge(m, a, b) _mm512_mask_cmp_ps_mask(m, a, b, _CMP_GE_OQ)
#define f_lt(m, a, b) _mm512_mask_cmp_ps_mask(m, a, b, _CMP_LT_OQ)
#define f_le(m, a, b) _mm512_mask_cmp_ps_mask(m, a, b, _CMP_LE_OQ)
#define i_gt(m, a, b) _mm512_mask_cmpgt_epi32_mask(m, a, b)
/* Of all lanes. */
#define f_negative(a) _mm512_cmp_ps_mask(a, _mm512_setzero_ps(), _CMP_LT_OQ)
#define f_not_below(a, b) _mm512_cmp_ps_mask(a, b, _CMP_GE_OQ)
#define i_eq(a, b) _mm512_cmpeq_epi32_mask(a, b)

#define m_none() ((__mmask16)0)
#define m_first(n) ((__mmask16)((n) >= WIDTH ? 0xffff : (1 << (n)) - 1))
#define m_and(a, b) ((__mmask16)((a) & (b)))
#define m_or(a, b) ((__mmask16)((a) | (b)))
#define m_less(a, b) ((__mmask16)((a) & ~(b))) /* a without b */
#define m_any(a) ((a) != 0)
#define m_bits(a) ((unsigned)(a))

/* The lanes of m whose bytes are not 0. */
#define m_of_bytes(m, bytes)                                                   \
  _mm512_mask_test_epi32_mask(                                                 \
      m, _mm512_cvtepu8_epi32(_mm_loadu_si128((const __m128i *)(bytes))),      \
      _mm512_set1_epi32(1))

/* Corners v[0], v[12], v[24] and v[36]. */
VECTOR static inline __m512i
load_corners_avx512(const struct hsr_corner *corner, const uint32_t *v) {
  __m512i r =
      _mm512_castsi128_si512(_mm_loadu_si128((const __m128i *)&corner[v[0]]));
  r = _mm512_inserti32x4(r, _mm_loadu_si128((const __m128i *)&corner[v[12]]),
                         1);
  r = _mm512_inserti32x4(r, _mm_loadu_si128((const __m128i *)&corner[v[24]]),
                         2);
  return _mm512_inserti32x4(r, _mm_loadu_si128((const __m128i *)&corner[v[36]]),
                            3);
}

#define kept_of_avx512(m) (m)

/* A row from `to` on gets the lanes that are kept. */
VECTOR static inline void keep_avx512(void *row, int to, __mmask16 kept,
                                      __m512i lanes) {
  i_store((int *)row + to, _mm512_maskz_compress_epi32(kept, lanes));
}

/* Writes the depth and the face of the lanes of m. */
VECTOR static inline void write_avx512(float *z, uint32_t *ids, __mmask16 m,
                                       __m512 q, __m512i id) {
  _mm512_mask_storeu_ps(z, m, q);
  _mm512_mask_storeu_epi32(ids, m, id);
}

/* The depths of a span from `x` on, rounded once. */
VECTOR static inline __m512 depths_avx512(const struct span *s, double x) {
  const __m512d a = _mm512_set1_pd(s->a), by = _mm512_set1_pd(s->by),
                c = _mm512_set1_pd(s->c),
                lanes = _mm512_add_pd(_mm512_set_pd(7, 6, 5, 4, 3, 2, 1, 0),
                                      _mm512_set1_pd(x));
  __m512d low = _mm512_mul_pd(a, lanes),
          high = _mm512_mul_pd(a, _mm512_add_pd(lanes, _mm512_set1_pd(8)));
  __m256 q_low = _mm512_cvtpd_ps(_mm512_add_pd(_mm512_add_pd(low, by), c)),
         q_high = _mm512_cvtpd_ps(_mm512_add_pd(_mm512_add_pd(high, by), c));
  return _mm512_castpd_ps(
      _mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(q_low)),
                         _mm256_castps_pd(q_high), 1));
}

#define names_at(from) i_load(from)

/* Adds the samples of some lanes to the queue. `names` are the ids of the faces
 * of all lanes. */
VECTOR static inline void enqueue_avx512(struct queue *queue, unsigned lanes,
                                         __m512i at, __m512 q, __m512i names) {
  const __mmask16 m = (__mmask16)lanes;
  int n = queue->n;
  i_store(queue->at + n, _mm512_maskz_compress_epi32(m, at));
  f_store(queue->q + n, _mm512_maskz_compress_ps(m, q));
  i_store(queue->id + n, _mm512_maskz_compress_epi32(m, names));
  queue->n = n + __builtin_popcount(lanes);
}

/* The rows are done, so they are written past the caches. */
VECTOR static void write_back_avx512(const struct hsr_tiler *t,
                                     const struct hsr_job *job) {
  const struct hsr_window *p = &t->part;
  int width = p->x1 - p->x0;
  for (int j = p->y0; j < p->y1; j++) {
    const uint32_t *from = t->ids + (size_t)(j - p->y0) * t->ids_stride;
    uint32_t *to = hsr_job_row(job, j) + (size_t)p->x0;
    int i = 0;
    for (; i < width && (uintptr_t)(to + i) % 64; i++)
      to[i] = from[i];
    for (; i + WIDTH <= width; i += WIDTH)
      _mm512_stream_si512((__m512i *)(to + i), i_load(from + i));
    for (; i < width; i++)
      to[i] = from[i];
  }
  _mm_sfence();
}

#include "algorithms/engines/tiler/tiler_twin.h"
