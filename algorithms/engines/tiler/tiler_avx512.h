/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What tiler.c does with samples, for machines with AVX-512: sixteen samples or
 * triangles at a time. Each function does what its portable twin does, but rounds
 * less; within tiler.c only. */
#ifndef HSR_ALGORITHMS_TILER_AVX512_H
#define HSR_ALGORITHMS_TILER_AVX512_H

#define AVX512 __attribute__((target("avx512f")))

/* --- Looking at a batch --------------------------------------------------- */

AVX512 static inline __m512i lane_numbers(void) {
  return _mm512_set_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
}

/* The first n lanes. */
static inline __mmask16 first_lanes(int n) {
  return (__mmask16)(n >= LANES ? 0xffff : (1 << n) - 1);
}

/* The same corner of sixteen triangles. */
struct corners16 {
  __m512i x, y;
  __m512 q;
};

/* Corners v[0], v[12], v[24] and v[36]. */
AVX512 static inline __m512i load_corners(const struct hsr_corner *corner,
                                          const uint32_t *v) {
  __m512i r =
      _mm512_castsi128_si512(_mm_loadu_si128((const __m128i *)&corner[v[0]]));
  r = _mm512_inserti32x4(r, _mm_loadu_si128((const __m128i *)&corner[v[12]]),
                         1);
  r = _mm512_inserti32x4(r, _mm_loadu_si128((const __m128i *)&corner[v[24]]),
                         2);
  return _mm512_inserti32x4(r, _mm_loadu_si128((const __m128i *)&corner[v[36]]),
                            3);
}

/* Corners v[0], v[3], ... v[45]: four transpositions of four by four. */
AVX512 static inline struct corners16
gather_corners(const struct hsr_corner *corner, const uint32_t *v) {
  __m512i c0 = load_corners(corner, v), c1 = load_corners(corner, v + 3),
          c2 = load_corners(corner, v + 6), c3 = load_corners(corner, v + 9);
  __m512i xy01 = _mm512_unpacklo_epi32(c0, c1),
          xy23 = _mm512_unpacklo_epi32(c2, c3),
          q01 = _mm512_unpackhi_epi32(c0, c1),
          q23 = _mm512_unpackhi_epi32(c2, c3);
  return (struct corners16){
      _mm512_unpacklo_epi64(xy01, xy23), _mm512_unpackhi_epi64(xy01, xy23),
      _mm512_castsi512_ps(_mm512_unpacklo_epi64(q01, q23))};
}

AVX512 static inline __mmask16 unsafe_ones(const struct corners16 *c) {
  return _mm512_cmpeq_epi32_mask(c->x, _mm512_set1_epi32(UNSAFE));
}

/* The samples from lo - 1 to hi + 1 grid units, of which the first is at
 * `first`, within [w0, w1): [*from, *to). */
AVX512 static inline void find_samples(__m512i lo, __m512i hi, int first,
                                       int w0, int w1, __m512i *from,
                                       __m512i *to) {
  *from = _mm512_srai_epi32(
      _mm512_add_epi32(lo, _mm512_set1_epi32(GRID - 2 - first)), GRID_BITS);
  *to = _mm512_srai_epi32(
      _mm512_add_epi32(hi, _mm512_set1_epi32(GRID + 1 - first)), GRID_BITS);
  *from = _mm512_max_epi32(*from, _mm512_set1_epi32(w0));
  *to = _mm512_min_epi32(*to, _mm512_set1_epi32(w1));
}

/* a - b, in pixels. */
AVX512 static inline __m512 pixels_between(__m512i a, __m512i b) {
  return _mm512_mul_ps(_mm512_cvtepi32_ps(_mm512_sub_epi32(a, b)),
                       _mm512_set1_ps(1.0f / GRID));
}

/* A row of the batch's corners from `to` on gets the lanes that are kept. */
AVX512 static inline void keep_lanes(void *row, int to, __mmask16 keep,
                                     __m512i lanes) {
  _mm512_storeu_si512((int *)row + to,
                      _mm512_maskz_compress_epi32(keep, lanes));
}

/* What decide() finds of `lanes` of triangles k to k + 15, of which those to be
 * tiled are kept. They never get ahead of what is still to be read. */
AVX512 static inline void look_at_sixteen(const struct hsr_tiler *t,
                                          struct hsr_batch *b,
                                          const uint32_t *v, const bool *sides,
                                          int k, __mmask16 lanes) {
  const __m512 zero = _mm512_setzero_ps();
  struct corners16 A = gather_corners(t->corner, v),
                   B = gather_corners(t->corner, v + 1),
                   C = gather_corners(t->corner, v + 2);
  __mmask16 unsafe =
      lanes & (unsafe_ones(&A) | unsafe_ones(&B) | unsafe_ones(&C));

  /* The samples of their boxes: the most triangles of a dense mesh have none. */
  __m512i lo_x = _mm512_min_epi32(_mm512_min_epi32(A.x, B.x), C.x),
          hi_x = _mm512_max_epi32(_mm512_max_epi32(A.x, B.x), C.x),
          lo_y = _mm512_min_epi32(_mm512_min_epi32(A.y, B.y), C.y),
          hi_y = _mm512_max_epi32(_mm512_max_epi32(A.y, B.y), C.y);
  __m512i x0, x1, y0, y1;
  find_samples(lo_x, hi_x, t->first_x, t->window.x0, t->window.x1, &x0, &x1);
  find_samples(lo_y, hi_y, t->first_y, t->window.y0, t->window.y1, &y0, &y1);
  __mmask16 live = _mm512_mask_cmplt_epi32_mask(
      _mm512_mask_cmplt_epi32_mask((__mmask16)(lanes & ~unsafe), x0, x1), y0,
      y1);
  __mmask16 fast = 0, general = unsafe;
  if (live) {
    /* The doubled area, negative if seen from the front (y runs down). */
    __m512 width = pixels_between(hi_x, lo_x),
           height = pixels_between(hi_y, lo_y);
    __m512 area = _mm512_sub_ps(
        _mm512_mul_ps(pixels_between(B.x, A.x), pixels_between(C.y, A.y)),
        _mm512_mul_ps(pixels_between(C.x, A.x), pixels_between(B.y, A.y)));
    const __m512 two = _mm512_set1_ps(2);
    __m512 around =
        _mm512_add_ps(_mm512_add_ps(width, height), _mm512_set1_ps(4));
    __m512 within = _mm512_mul_ps(
        _mm512_mul_ps(_mm512_set1_ps(0x1p-20f), _mm512_add_ps(width, two)),
        _mm512_add_ps(height, two));
    __m512 least =
        _mm512_add_ps(_mm512_mul_ps(_mm512_set1_ps(64 * SNAP), around), within);
    __mmask16 small =
        _mm512_mask_cmp_ps_mask(live, _mm512_max_ps(width, height),
                                _mm512_set1_ps(LARGEST_BOX), _CMP_LE_OQ);
    __mmask16 behind = _mm512_mask_cmp_ps_mask(small, area, least, _CMP_GT_OQ);
    __mmask16 before = _mm512_mask_cmp_ps_mask(
        small, area, _mm512_sub_ps(zero, least), _CMP_LT_OQ);
    __m128i bytes = _mm_loadu_si128((const __m128i *)sides);
    __mmask16 back = _mm512_mask_test_epi32_mask(
        behind, _mm512_cvtepu8_epi32(bytes), _mm512_set1_epi32(1));
    __m512 nearest = _mm512_max_ps(_mm512_max_ps(A.q, B.q), C.q);
    fast =
        _mm512_mask_cmp_ps_mask((__mmask16)((behind | before) & ~back), nearest,
                                _mm512_set1_ps(t->nearest), _CMP_LT_OQ);
    general |= (__mmask16)(live & ~(back | fast));

    __mmask16 turned = _mm512_cmp_ps_mask(area, zero, _CMP_LT_OQ);
    struct hsr_corners *r = &b->corners;
    int to = b->n_fast;
    keep_lanes(r->ax, to, fast, A.x);
    keep_lanes(r->ay, to, fast, A.y);
    keep_lanes(r->qa, to, fast, _mm512_castps_si512(A.q));
    keep_lanes(r->bx, to, fast, _mm512_mask_mov_epi32(B.x, turned, C.x));
    keep_lanes(r->by, to, fast, _mm512_mask_mov_epi32(B.y, turned, C.y));
    keep_lanes(r->qb, to, fast,
               _mm512_castps_si512(_mm512_mask_mov_ps(B.q, turned, C.q)));
    keep_lanes(r->cx, to, fast, _mm512_mask_mov_epi32(C.x, turned, B.x));
    keep_lanes(r->cy, to, fast, _mm512_mask_mov_epi32(C.y, turned, B.y));
    keep_lanes(r->qc, to, fast,
               _mm512_castps_si512(_mm512_mask_mov_ps(C.q, turned, B.q)));
    keep_lanes(r->x0, to, fast, x0);
    keep_lanes(r->y0, to, fast, y0);
    keep_lanes(r->x1, to, fast, x1);
    keep_lanes(r->y1, to, fast, y1);
    keep_lanes(b->place, to, fast,
               _mm512_add_epi32(lane_numbers(), _mm512_set1_epi32(k)));
    b->n_fast = to + __builtin_popcount(fast);
  }
  b->general |= general;
  __m512i fate = _mm512_maskz_set1_epi32(fast, HSR_TILE);
  fate = _mm512_mask_set1_epi32(fate, general, HSR_GENERALLY);
  _mm512_storeu_si512(b->fate + k, fate);
}

AVX512 static void look_avx512(const struct hsr_tiler *t, struct hsr_batch *b) {
  const uint32_t *v = vertices_from(t, b);
  const bool *sides = sides_from(t, b);
  int k = 0;
  for (; k + LANES <= b->n; k += LANES)
    look_at_sixteen(t, b, v + 3 * k, sides + k, k, 0xffff);
  if (k < b->n) {
    struct last last = last_ones(v, sides, k, b->n);
    look_at_sixteen(t, b, last.vertex, last.one_sided, k,
                    first_lanes(b->n - k));
  }
}

/* --- The general way ------------------------------------------------------ */

AVX512 static inline __m256 eight_depths(const struct span *s, __m512d x) {
  __m512d q = _mm512_mul_pd(_mm512_set1_pd(s->a), x);
  q = _mm512_add_pd(_mm512_add_pd(q, _mm512_set1_pd(s->by)),
                    _mm512_set1_pd(s->c));
  return _mm512_cvtpd_ps(q);
}

AVX512 static void tile_span_avx512(struct hsr_tiler *t, const struct span *s) {
  const __m512 clear = _mm512_set1_ps(HSR_CLEAR);
  const __m512i id = _mm512_set1_epi32((int)s->id);
  const __m512d lanes = _mm512_set_pd(7, 6, 5, 4, 3, 2, 1, 0);
  size_t row = (size_t)(s->j - t->part.y0);
  uint32_t *ids = t->ids + row * t->ids_stride;
  float *z = t->z + row * t->z_stride;
  for (int i = s->x0; i < s->x1; i += LANES) {
    __m512d x = _mm512_add_pd(lanes, _mm512_set1_pd(hsr_sample_x(t->view, i)));
    __m512 q = _mm512_castps256_ps512(eight_depths(s, x));
    x = _mm512_add_pd(x, _mm512_set1_pd(8));
    q = _mm512_castpd_ps(_mm512_insertf64x4(
        _mm512_castps_pd(q), _mm256_castps_pd(eight_depths(s, x)), 1));
    __mmask16 in = first_lanes(s->x1 - i);
    float *z_here = z + (i - t->part.x0);
    __m512 held = _mm512_maskz_loadu_ps(in, z_here);
    __mmask16 known =
        _mm512_mask_cmp_ps_mask(in, q, _mm512_set1_ps(s->least), _CMP_GT_OQ);
    __mmask16 nearer = _mm512_mask_cmp_ps_mask(
        known, q, _mm512_mul_ps(held, clear), _CMP_GT_OQ);
    __mmask16 farther = _mm512_mask_cmp_ps_mask(known, _mm512_mul_ps(q, clear),
                                                held, _CMP_LT_OQ);
    _mm512_mask_storeu_ps(z_here, nearer, q);
    _mm512_mask_storeu_epi32(ids + (i - t->part.x0), nearer, id);
    if ((nearer | farther) == in)
      continue;
    float depth[LANES];
    _mm512_storeu_ps(depth, q);
    for (unsigned rest = in & ~(unsigned)(nearer | farther); rest;
         rest &= rest - 1) {
      int l = __builtin_ctz(rest);
      settle(t, s->f, s->id, known >> l & 1 ? depth[l] : NAN, true, i + l,
             s->j);
    }
  }
}

/* --- Triangles ------------------------------------------------------------ */

/* f + fx x: a linear function along a row. */
AVX512 static inline __m512 linear(float f, float fx, __m512 x) {
  return _mm512_fmadd_ps(_mm512_set1_ps(fx), x, _mm512_set1_ps(f));
}

/* f + fx x + fy y, of sixteen triangles. */
AVX512 static inline __m512 linear2(const float *f, const float *fx, __m512 x,
                                    const float *fy, __m512 y) {
  return _mm512_fmadd_ps(
      _mm512_loadu_ps(fy), y,
      _mm512_fmadd_ps(_mm512_loadu_ps(fx), x, _mm512_loadu_ps(f)));
}

/* Decides some of the sixteen samples from (x, j) on. */
AVX512 __attribute__((noinline)) static void
settle_row(struct hsr_tiler *t, const struct hsr_triangle *tri, __m512 q,
           unsigned lanes, unsigned sure, int x, int j) {
  float depth[LANES];
  _mm512_storeu_ps(depth, q);
  for (; lanes; lanes &= lanes - 1) {
    int l = __builtin_ctz(lanes);
    settle(t, tri->face, tri->id, depth[l], sure >> l & 1, x + l, j);
  }
}

/* Sixteen samples of each row of a box, from column x on. */
AVX512 static inline void tile_strip(struct hsr_tiler *t,
                                     const struct hsr_triangle *tri,
                                     const struct hsr_window *box, int x) {
  const __m512 bound = _mm512_set1_ps(tri->bound),
               minus_bound = _mm512_set1_ps(-tri->bound),
               clear = _mm512_set1_ps(HSR_CLEAR), one = _mm512_set1_ps(1);
  const __m512 ey0 = _mm512_set1_ps(tri->ey0), ey1 = _mm512_set1_ps(tri->ey1),
               ey2 = _mm512_set1_ps(tri->ey2), qy = _mm512_set1_ps(tri->qy);
  const __m512i id = _mm512_set1_epi32((int)tri->id);
  __m512 right = _mm512_cvtepi32_ps(
      _mm512_add_epi32(lane_numbers(), _mm512_set1_epi32(x - tri->x0)));
  __m512 e0 = linear(tri->e0, tri->ex0, right);
  __m512 e1 = linear(tri->e1, tri->ex1, right);
  __m512 e2 = linear(tri->e2, tri->ex2, right);
  __m512 q0 = linear(tri->q, tri->qx, right);
  __mmask16 in_box = first_lanes(box->x1 - x);
  const size_t ids_stride = t->ids_stride, z_stride = t->z_stride;
  size_t row = (size_t)(box->y0 - t->part.y0),
         column = (size_t)(x - t->part.x0);
  uint32_t *ids = t->ids + row * ids_stride + column;
  float *z = t->z + row * z_stride + column;
  __m512 down = _mm512_set1_ps((float)(box->y0 - tri->y0));
  for (int j = box->y0; j < box->y1; j++, ids += ids_stride, z += z_stride) {
    __m512 d0 = _mm512_fmadd_ps(ey0, down, e0),
           d1 = _mm512_fmadd_ps(ey1, down, e1),
           d2 = _mm512_fmadd_ps(ey2, down, e2),
           q = _mm512_fmadd_ps(qy, down, q0),
           d = _mm512_min_ps(_mm512_min_ps(d0, d1), d2);
    down = _mm512_add_ps(down, one);
    __mmask16 maybe =
        _mm512_mask_cmp_ps_mask(in_box, d, minus_bound, _CMP_GE_OQ);
    __mmask16 sure = _mm512_mask_cmp_ps_mask(maybe, d, bound, _CMP_GT_OQ);
    __m512 held = _mm512_maskz_loadu_ps(maybe, z);
    __mmask16 nearer = _mm512_mask_cmp_ps_mask(
        sure, q, _mm512_mul_ps(held, clear), _CMP_GT_OQ);
    _mm512_mask_storeu_ps(z, nearer, q);
    _mm512_mask_storeu_epi32(ids, nearer, id);
    if (nearer == maybe)
      continue;
    __mmask16 farther = _mm512_mask_cmp_ps_mask(sure, _mm512_mul_ps(q, clear),
                                                held, _CMP_LT_OQ);
    unsigned unsure = maybe & ~(unsigned)(nearer | farther);
    if (unsure)
      settle_row(t, tri, q, unsure, sure, x, j);
  }
}

/* A triangle with a larger box. */
AVX512 static void tile_avx512(struct hsr_tiler *t,
                               const struct hsr_triangle *tri) {
  struct hsr_window box = clip(t, tri->x0, tri->y0, tri->x1, tri->y1);
  for (int x = box.x0; x < box.x1; x += LANES)
    tile_strip(t, tri, &box, x);
}

/* Adds the samples of some lanes. */
AVX512 static inline void enqueue(struct hsr_tiler *t, struct queue *queue,
                                  __mmask16 lanes, __m512i at, __m512 q,
                                  __m512i id) {
  int n = queue->n;
  _mm512_storeu_si512(queue->at + n, _mm512_maskz_compress_epi32(lanes, at));
  _mm512_storeu_ps(queue->q + n, _mm512_maskz_compress_ps(lanes, q));
  _mm512_storeu_si512(queue->id + n, _mm512_maskz_compress_epi32(lanes, id));
  queue->n = n + __builtin_popcount(lanes);
  if (queue->n > QUEUE)
    compare_queue(t, queue);
}

/* Decides samples that triangles k to k + 15 cover perhaps. */
AVX512 __attribute__((noinline)) static void
settle_lanes(struct hsr_tiler *t, const struct hsr_batch *b, int k,
             unsigned lanes, __m512i at, __m512 q) {
  uint32_t places[LANES];
  float depth[LANES];
  _mm512_storeu_si512(places, at);
  _mm512_storeu_ps(depth, q);
  for (; lanes; lanes &= lanes - 1) {
    int l = __builtin_ctz(lanes);
    settle(t, hsr_tiler_face(t, b, b->place[k + l]), b->corners.id[k + l],
           depth[l], false, t->window.x0 + (int)(places[l] & 0xffff),
           t->window.y0 + (int)(places[l] >> 16));
  }
}

/* Which of sixteen triangles have a small box. */
AVX512 static __mmask16 small_ones(const struct hsr_batch *b, int k,
                                   __mmask16 good) {
  const struct hsr_corners *r = &b->corners;
  __m512i width = _mm512_sub_epi32(_mm512_loadu_si512(r->x1 + k),
                                   _mm512_loadu_si512(r->x0 + k));
  __m512i height = _mm512_sub_epi32(_mm512_loadu_si512(r->y1 + k),
                                    _mm512_loadu_si512(r->y0 + k));
  return _mm512_mask_cmple_epi32_mask(good, _mm512_mullo_epi32(width, height),
                                      _mm512_set1_epi32(SMALL_BOX));
}

/* Those of the triangles k to k + 15 that are small. Each has a lane of its
 * own. All go through the samples of their boxes in step, row by row. */
AVX512 static void tile_small(struct hsr_tiler *t, const struct hsr_batch *b,
                              int k, __mmask16 small, struct queue *queue) {
  const struct hsr_corners *r = &b->corners;
  const struct hsr_triangles *s = &b->triangles;
  const __m512 one = _mm512_set1_ps(1), bound = _mm512_loadu_ps(s->bound + k),
               minus_bound = _mm512_sub_ps(_mm512_setzero_ps(), bound);
  __m512i x0 = _mm512_loadu_si512(r->x0 + k),
          y0 = _mm512_loadu_si512(r->y0 + k);
  __m512i columns = _mm512_sub_epi32(_mm512_loadu_si512(r->x1 + k), x0);
  __m512 width = _mm512_cvtepi32_ps(columns);
  __m512 height =
      _mm512_cvtepi32_ps(_mm512_sub_epi32(_mm512_loadu_si512(r->y1 + k), y0));
  __m512i id = _mm512_loadu_si512(r->id + k);
  x0 = _mm512_sub_epi32(x0, _mm512_set1_epi32(t->window.x0));
  y0 = _mm512_sub_epi32(y0, _mm512_set1_epi32(t->window.y0));
  __m512i at = _mm512_add_epi32(x0, _mm512_slli_epi32(y0, 16));
  __m512i next_row = _mm512_sub_epi32(_mm512_set1_epi32(1 << 16), columns);
  __m512 right = _mm512_setzero_ps(), down = _mm512_setzero_ps();
  for (__mmask16 active = small; active;) {
    __m512 d0 = linear2(s->e0 + k, s->ex0 + k, right, s->ey0 + k, down);
    __m512 d1 = linear2(s->e1 + k, s->ex1 + k, right, s->ey1 + k, down);
    __m512 d2 = linear2(s->e2 + k, s->ex2 + k, right, s->ey2 + k, down);
    __m512 q = linear2(s->q + k, s->qx + k, right, s->qy + k, down);
    __m512 d = _mm512_min_ps(_mm512_min_ps(d0, d1), d2);
    unsigned maybe =
        _mm512_mask_cmp_ps_mask(active, d, minus_bound, _CMP_GE_OQ);
    unsigned sure = _mm512_mask_cmp_ps_mask(active, d, bound, _CMP_GT_OQ);
    enqueue(t, queue, (__mmask16)sure, at, q, id);
    if (__builtin_expect(maybe != sure, 0))
      settle_lanes(t, b, k, maybe & ~sure, at, q);
    right = _mm512_add_ps(right, one);
    at = _mm512_add_epi32(at, _mm512_set1_epi32(1));
    __mmask16 end = _mm512_cmp_ps_mask(right, width, _CMP_GE_OQ);
    right = _mm512_mask_mov_ps(right, end, _mm512_setzero_ps());
    down = _mm512_mask_add_ps(down, end, down, one);
    at = _mm512_mask_add_epi32(at, end, at, next_row);
    active = _mm512_mask_cmp_ps_mask(active, down, height, _CMP_LT_OQ);
  }
}

AVX512 static void tile_batch_avx512(struct hsr_tiler *t,
                                     const struct hsr_batch *b) {
  struct queue queue;
  queue.n = 0;
  for (int k = 0; k < b->n_fast; k += LANES) {
    __m512i flags = _mm512_loadu_si512(b->good + k);
    __mmask16 good =
        _mm512_mask_test_epi32_mask(first_lanes(b->n_fast - k), flags, flags);
    __mmask16 small = small_ones(b, k, good);
    tile_small(t, b, k, small, &queue);
    for (unsigned large = good & ~(unsigned)small; large; large &= large - 1) {
      struct hsr_triangle triangle =
          hsr_tiler_take(t, b, k + __builtin_ctz(large));
      tile_avx512(t, &triangle);
    }
  }
  compare_queue(t, &queue);
}

/* The rows are done, so they are written past the caches. */
AVX512 static void write_back_avx512(const struct hsr_tiler *t,
                                     const struct hsr_job *job) {
  const struct hsr_window *p = &t->part;
  int width = p->x1 - p->x0;
  for (int j = p->y0; j < p->y1; j++) {
    const uint32_t *from = t->ids + (size_t)(j - p->y0) * t->ids_stride;
    uint32_t *to = hsr_job_row(job, j) + (size_t)p->x0;
    int i = 0;
    for (; i < width && (uintptr_t)(to + i) % 64; i++)
      to[i] = from[i];
    for (; i + LANES <= width; i += LANES)
      _mm512_stream_si512((__m512i *)(to + i), _mm512_loadu_si512(from + i));
    for (; i < width; i++)
      to[i] = from[i];
  }
  _mm_sfence();
}

static const struct hsr_twin avx512 = {look_avx512, tile_span_avx512,
                                       tile_avx512, tile_batch_avx512,
                                       write_back_avx512};

#endif
