/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lanes of tiler_twin.h for machines with AVX2, fused multiply-adds and
 * BMI2, but without AVX-512: eight of them. Included in tiler.c only. In a mask
 * all bits of a lane are set, or none. */
#define TWIN(name) name##_avx2
#define VECTOR __attribute__((target("avx2,fma,bmi2")))
#define WIDTH 8
#define FEWEST 4 /* small triangles in step; fewer are tiled one by one */
#define write_back_avx2 write_back_portable

typedef __m256 TWIN(floats);
typedef __m256i TWIN(ints);
typedef __m256 TWIN(mask);
typedef __m256i TWIN(kept);
typedef const uint32_t *TWIN(names); /* where they are */

#define f_all(x) _mm256_set1_ps(x)
#define f_fma(a, b, c) _mm256_fmadd_ps(a, b, c)
#define f_min(a, b) _mm256_min_ps(a, b)
#define f_max(a, b) _mm256_max_ps(a, b)
#define f_load(from) _mm256_loadu_ps(from)
#define f_load_where(m, from) _mm256_maskload_ps(from, _mm256_castps_si256(m))
#define f_store(to, a) _mm256_storeu_ps(to, a)
#define f_of_ints(a) _mm256_cvtepi32_ps(a)
#define f_pick(m, yes, no) _mm256_blendv_ps(no, yes, m)
#define f_where(m, a) _mm256_and_ps(m, a)
#define f_bits(a) _mm256_castps_si256(a)
#define f_of_bits(a) _mm256_castsi256_ps(a)

#define i_all(x) _mm256_set1_epi32(x)
#define i_numbers() _mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0)
#define i_add(a, b) _mm256_add_epi32(a, b)
#define i_sub(a, b) _mm256_sub_epi32(a, b)
#define i_mul(a, b) _mm256_mullo_epi32(a, b)
#define i_min(a, b) _mm256_min_epi32(a, b)
#define i_max(a, b) _mm256_max_epi32(a, b)
#define i_left(a, n) _mm256_slli_epi32(a, n)
#define i_right(a, n) _mm256_srai_epi32(a, n)
#define i_load(from) _mm256_loadu_si256((const __m256i *)(from))
#define i_store(to, a) _mm256_storeu_si256((__m256i *)(to), a)
#define i_pick(m, yes, no) f_bits(f_pick(m, f_of_bits(yes), f_of_bits(no)))
#define i_where(m, a) _mm256_and_si256(f_bits(m), a)

/* Each lane of four 128-bit vectors, in twos of 32 bits, or 64. */
#define i_low32(a, b) _mm256_unpacklo_epi32(a, b)
#define i_high32(a, b) _mm256_unpackhi_epi32(a, b)
#define i_low64(a, b) _mm256_unpacklo_epi64(a, b)
#define i_high64(a, b) _mm256_unpackhi_epi64(a, b)

/* Of the lanes of m. */
#define f_gt(m, a, b) _mm256_and_ps(m, _mm256_cmp_ps(a, b, _CMP_GT_OQ))
#define f_ge(m, a, b) _mm256_and_ps(m, _mm256_cmp_ps(a, b, _CMP_GE_OQ))
#define f_lt(m, a, b) _mm256_and_ps(m, _mm256_cmp_ps(a, b, _CMP_LT_OQ))
#define f_le(m, a, b) _mm256_and_ps(m, _mm256_cmp_ps(a, b, _CMP_LE_OQ))
#define i_gt(m, a, b) _mm256_and_ps(m, f_of_bits(_mm256_cmpgt_epi32(a, b)))
/* Of all lanes. */
#define f_negative(a) _mm256_cmp_ps(a, _mm256_setzero_ps(), _CMP_LT_OQ)
#define f_not_below(a, b) _mm256_cmp_ps(a, b, _CMP_GE_OQ)
#define i_eq(a, b) f_of_bits(_mm256_cmpeq_epi32(a, b))

#define m_none() _mm256_setzero_ps()
#define m_first(n) f_of_bits(_mm256_cmpgt_epi32(i_all(n), i_numbers()))
#define m_and(a, b) _mm256_and_ps(a, b)
#define m_or(a, b) _mm256_or_ps(a, b)
#define m_less(a, b) _mm256_andnot_ps(b, a) /* a without b */
#define m_any(a) (!_mm256_testz_si256(f_bits(a), f_bits(a)))
#define m_bits(a) ((unsigned)_mm256_movemask_ps(a))

/* The lanes of m whose bytes are not 0. */
#define m_of_bytes(m, bytes)                                                   \
  i_gt(m, _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)(bytes))),     \
       _mm256_setzero_si256())

/* Corners v[0] and v[12]. */
VECTOR static inline __m256i load_corners_avx2(const struct hsr_corner *corner,
                                               const uint32_t *v) {
  return _mm256_set_m128i(_mm_loadu_si128((const __m128i *)&corner[v[12]]),
                          _mm_loadu_si128((const __m128i *)&corner[v[0]]));
}

/* The numbers of the lanes that are kept, from the first lane on. */
VECTOR static inline __m256i kept_of_avx2(__m256 keep) {
  uint64_t bytes = _pdep_u64(m_bits(keep), 0x0101010101010101) * 0xff;
  uint64_t numbers = _pext_u64(0x0706050403020100, bytes);
  return _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((int64_t)numbers));
}

/* A row from `to` on gets the lanes that are kept. */
VECTOR static inline void keep_avx2(void *row, int to, __m256i kept,
                                    __m256i lanes) {
  i_store((int *)row + to, _mm256_permutevar8x32_epi32(lanes, kept));
}

/* Writes the depth and the face of the lanes of m. */
VECTOR static inline void write_avx2(float *z, uint32_t *ids, __m256 m,
                                     __m256 q, __m256i id) {
  unsigned lanes = m_bits(m);
  if (lanes == 0xff) {
    f_store(z, q);
    i_store(ids, id);
  } else if (lanes) {
    _mm256_maskstore_ps(z, f_bits(m), q);
    _mm256_maskstore_epi32((int *)ids, f_bits(m), id);
  }
}

/* The depths of a span from `x` on, rounded once. */
VECTOR static inline __m256 depths_avx2(const struct span *s, double x) {
  const __m256d a = _mm256_set1_pd(s->a), by = _mm256_set1_pd(s->by),
                c = _mm256_set1_pd(s->c),
                lanes =
                    _mm256_add_pd(_mm256_set_pd(3, 2, 1, 0), _mm256_set1_pd(x));
  __m256d low = _mm256_mul_pd(a, lanes),
          high = _mm256_mul_pd(a, _mm256_add_pd(lanes, _mm256_set1_pd(4)));
  return _mm256_set_m128(
      _mm256_cvtpd_ps(_mm256_add_pd(_mm256_add_pd(high, by), c)),
      _mm256_cvtpd_ps(_mm256_add_pd(_mm256_add_pd(low, by), c)));
}

#define names_at(from) (from)

/* Adds the samples of some lanes to the queue. `names` are the ids of the faces
 * of all lanes: where they are. */
VECTOR static inline void enqueue_avx2(struct queue *queue, unsigned lanes,
                                       __m256i at, __m256 q,
                                       const uint32_t *names) {
  uint32_t places[WIDTH];
  float depth[WIDTH];
  i_store(places, at);
  f_store(depth, q);
  for (; lanes; lanes &= lanes - 1) {
    int l = __builtin_ctz(lanes), n = queue->n++;
    queue->at[n] = places[l];
    queue->q[n] = depth[l];
    queue->id[n] = names[l];
  }
}

#include "algorithms/engines/tiler/tiler_twin.h"
