/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What tiler.c does with samples and triangles, for machines with AVX2, fused
 * multiply-adds and BMI2, but without AVX-512: eight at a time. Each function
 * does what its portable twin does, but rounds less; within tiler.c only. */
#ifndef HSR_ALGORITHMS_TILER_AVX2_H
#define HSR_ALGORITHMS_TILER_AVX2_H

#define AVX2 __attribute__((target("avx2,fma,bmi2")))
enum {
  LANES_AVX2 = 8,
  MANY = 4 /* small triangles of eight; fewer are tiled one by one */
};

AVX2 static inline __m256i eight_numbers(void) {
  return _mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0);
}

/* The first n lanes. */
AVX2 static inline __m256 first_of_eight(int n) {
  return _mm256_castsi256_ps(
      _mm256_cmpgt_epi32(_mm256_set1_epi32(n), eight_numbers()));
}

/* Writes the depth and the face where the lanes of `where` say so. */
AVX2 static inline void write_eight(float *z, uint32_t *ids, __m256 where,
                                    __m256 q, __m256i id) {
  unsigned lanes = (unsigned)_mm256_movemask_ps(where);
  if (lanes == 0xff) {
    _mm256_storeu_ps(z, q);
    _mm256_storeu_si256((__m256i *)ids, id);
  } else if (lanes) {
    _mm256_maskstore_ps(z, _mm256_castps_si256(where), q);
    _mm256_maskstore_epi32((int *)ids, _mm256_castps_si256(where), id);
  }
}

/* --- Looking at a batch --------------------------------------------------- */

/* The same corner of eight triangles. */
struct corners8 {
  __m256i x, y;
  __m256 q;
};

/* Corners v[0] and v[12]. */
AVX2 static inline __m256i load_two(const struct hsr_corner *corner,
                                    const uint32_t *v) {
  return _mm256_set_m128i(_mm_loadu_si128((const __m128i *)&corner[v[12]]),
                          _mm_loadu_si128((const __m128i *)&corner[v[0]]));
}

/* Corners v[0], v[3], ... v[21]: two transpositions of four by four. */
AVX2 static inline struct corners8 gather_eight(const struct hsr_corner *corner,
                                                const uint32_t *v) {
  __m256i c0 = load_two(corner, v), c1 = load_two(corner, v + 3),
          c2 = load_two(corner, v + 6), c3 = load_two(corner, v + 9);
  __m256i xy01 = _mm256_unpacklo_epi32(c0, c1),
          xy23 = _mm256_unpacklo_epi32(c2, c3),
          q01 = _mm256_unpackhi_epi32(c0, c1),
          q23 = _mm256_unpackhi_epi32(c2, c3);
  return (struct corners8){
      _mm256_unpacklo_epi64(xy01, xy23), _mm256_unpackhi_epi64(xy01, xy23),
      _mm256_castsi256_ps(_mm256_unpacklo_epi64(q01, q23))};
}

AVX2 static inline __m256i unsafe_eight(const struct corners8 *c) {
  return _mm256_cmpeq_epi32(c->x, _mm256_set1_epi32(UNSAFE));
}

/* The samples from lo - 1 to hi + 1 grid units, of which the first is at
 * `first`, within [w0, w1): [*from, *to). */
AVX2 static inline void find_eight(__m256i lo, __m256i hi, int first, int w0,
                                   int w1, __m256i *from, __m256i *to) {
  *from = _mm256_srai_epi32(
      _mm256_add_epi32(lo, _mm256_set1_epi32(GRID - 2 - first)), GRID_BITS);
  *to = _mm256_srai_epi32(
      _mm256_add_epi32(hi, _mm256_set1_epi32(GRID + 1 - first)), GRID_BITS);
  *from = _mm256_max_epi32(*from, _mm256_set1_epi32(w0));
  *to = _mm256_min_epi32(*to, _mm256_set1_epi32(w1));
}

/* a - b, in pixels. */
AVX2 static inline __m256 eight_pixels(__m256i a, __m256i b) {
  return _mm256_mul_ps(_mm256_cvtepi32_ps(_mm256_sub_epi32(a, b)),
                       _mm256_set1_ps(1.0f / GRID));
}

/* The numbers of the lanes that are kept, from the first lane on. */
AVX2 static inline __m256i kept_first(unsigned keep) {
  uint64_t bytes = _pdep_u64(keep, 0x0101010101010101) * 0xff;
  uint64_t numbers = _pext_u64(0x0706050403020100, bytes);
  return _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((int64_t)numbers));
}

/* A row of the batch's corners from `to` on gets the lanes that are kept. */
AVX2 static inline void keep_eight(void *row, int to, __m256i kept,
                                   __m256i lanes) {
  _mm256_storeu_si256((__m256i *)((int *)row + to),
                      _mm256_permutevar8x32_epi32(lanes, kept));
}

/* `b` where `turned`, else `a`. */
AVX2 static inline __m256i either(__m256i a, __m256i b, __m256 turned) {
  return _mm256_blendv_epi8(a, b, _mm256_castps_si256(turned));
}

/* What decide() finds of the first n of triangles k to k + 7, of which those to
 * be tiled are kept. They never get ahead of what is still to be read. */
AVX2 static inline void look_at_eight(const struct hsr_tiler *t,
                                      struct hsr_batch *b, const uint32_t *v,
                                      const bool *one_sided, int k, int n) {
  const __m256i looked_at = _mm256_castps_si256(first_of_eight(n));
  struct corners8 A = gather_eight(t->corner, v),
                  B = gather_eight(t->corner, v + 1),
                  C = gather_eight(t->corner, v + 2);
  __m256i unsafe = _mm256_and_si256(
      looked_at,
      _mm256_or_si256(_mm256_or_si256(unsafe_eight(&A), unsafe_eight(&B)),
                      unsafe_eight(&C)));

  /* The samples of their boxes: the most triangles of a dense mesh have none. */
  __m256i lo_x = _mm256_min_epi32(_mm256_min_epi32(A.x, B.x), C.x),
          hi_x = _mm256_max_epi32(_mm256_max_epi32(A.x, B.x), C.x),
          lo_y = _mm256_min_epi32(_mm256_min_epi32(A.y, B.y), C.y),
          hi_y = _mm256_max_epi32(_mm256_max_epi32(A.y, B.y), C.y);
  __m256i x0, x1, y0, y1;
  find_eight(lo_x, hi_x, t->first_x, t->window.x0, t->window.x1, &x0, &x1);
  find_eight(lo_y, hi_y, t->first_y, t->window.y0, t->window.y1, &y0, &y1);
  __m256i live = _mm256_andnot_si256(
      unsafe, _mm256_and_si256(looked_at,
                               _mm256_and_si256(_mm256_cmpgt_epi32(x1, x0),
                                                _mm256_cmpgt_epi32(y1, y0))));
  __m256i fast = _mm256_setzero_si256(), general = unsafe;
  if (!_mm256_testz_si256(live, live)) {
    /* The doubled area, negative if seen from the front (y runs down). */
    __m256 width = eight_pixels(hi_x, lo_x), height = eight_pixels(hi_y, lo_y);
    __m256 area = _mm256_sub_ps(
        _mm256_mul_ps(eight_pixels(B.x, A.x), eight_pixels(C.y, A.y)),
        _mm256_mul_ps(eight_pixels(C.x, A.x), eight_pixels(B.y, A.y)));
    const __m256 two = _mm256_set1_ps(2), zero = _mm256_setzero_ps();
    __m256 around =
        _mm256_add_ps(_mm256_add_ps(width, height), _mm256_set1_ps(4));
    __m256 within = _mm256_mul_ps(
        _mm256_mul_ps(_mm256_set1_ps(0x1p-20f), _mm256_add_ps(width, two)),
        _mm256_add_ps(height, two));
    __m256 least =
        _mm256_add_ps(_mm256_mul_ps(_mm256_set1_ps(64 * SNAP), around), within);
    __m256 small =
        _mm256_and_ps(_mm256_castsi256_ps(live),
                      _mm256_cmp_ps(_mm256_max_ps(width, height),
                                    _mm256_set1_ps(LARGEST_BOX), _CMP_LE_OQ));
    __m256 behind =
               _mm256_and_ps(small, _mm256_cmp_ps(area, least, _CMP_GT_OQ)),
           before = _mm256_and_ps(
               small,
               _mm256_cmp_ps(area, _mm256_sub_ps(zero, least), _CMP_LT_OQ));
    __m256i sides =
        _mm256_cvtepu8_epi32(_mm_loadl_epi64((const __m128i *)one_sided));
    __m256 back = _mm256_and_ps(behind, _mm256_castsi256_ps(_mm256_cmpgt_epi32(
                                            sides, _mm256_setzero_si256())));
    __m256 nearest = _mm256_max_ps(_mm256_max_ps(A.q, B.q), C.q);
    __m256 past_near =
        _mm256_cmp_ps(nearest, _mm256_set1_ps(t->nearest), _CMP_LT_OQ);
    fast = _mm256_castps_si256(_mm256_and_ps(
        _mm256_andnot_ps(back, _mm256_or_ps(behind, before)), past_near));
    general = _mm256_or_si256(
        general, _mm256_andnot_si256(
                     _mm256_or_si256(_mm256_castps_si256(back), fast), live));
    unsigned lanes = (unsigned)_mm256_movemask_ps(_mm256_castsi256_ps(fast));
    if (lanes) {
      __m256 turned = _mm256_cmp_ps(area, zero, _CMP_LT_OQ);
      struct hsr_corners *r = &b->corners;
      const int to = b->n_fast;
      const __m256i kept = kept_first(lanes);
      keep_eight(r->ax, to, kept, A.x);
      keep_eight(r->ay, to, kept, A.y);
      keep_eight(r->qa, to, kept, _mm256_castps_si256(A.q));
      keep_eight(r->bx, to, kept, either(B.x, C.x, turned));
      keep_eight(r->by, to, kept, either(B.y, C.y, turned));
      keep_eight(r->qb, to, kept,
                 _mm256_castps_si256(_mm256_blendv_ps(B.q, C.q, turned)));
      keep_eight(r->cx, to, kept, either(C.x, B.x, turned));
      keep_eight(r->cy, to, kept, either(C.y, B.y, turned));
      keep_eight(r->qc, to, kept,
                 _mm256_castps_si256(_mm256_blendv_ps(C.q, B.q, turned)));
      keep_eight(r->x0, to, kept, x0);
      keep_eight(r->y0, to, kept, y0);
      keep_eight(r->x1, to, kept, x1);
      keep_eight(r->y1, to, kept, y1);
      keep_eight(b->place, to, kept,
                 _mm256_add_epi32(eight_numbers(), _mm256_set1_epi32(k)));
      b->n_fast = to + __builtin_popcount(lanes);
    }
  }
  b->general |= !_mm256_testz_si256(general, general);
  __m256i fate =
      _mm256_sub_epi32(_mm256_sub_epi32(_mm256_setzero_si256(), fast),
                       _mm256_add_epi32(general, general));
  _mm256_storeu_si256((__m256i *)(b->fate + k), fate);
}

AVX2 static void look_avx2(const struct hsr_tiler *t, struct hsr_batch *b) {
  const uint32_t *v = vertices_from(t, b);
  const bool *sides = sides_from(t, b);
  int k = 0;
  for (; k + LANES_AVX2 <= b->n; k += LANES_AVX2)
    look_at_eight(t, b, v + 3 * k, sides + k, k, LANES_AVX2);
  if (k < b->n) {
    struct last last = last_ones(v, sides, k, b->n);
    look_at_eight(t, b, last.vertex, last.one_sided, k, b->n - k);
  }
}

/* --- The general way ------------------------------------------------------ */

AVX2 static inline __m128 four_depths(const struct span *s, __m256d x) {
  __m256d q = _mm256_mul_pd(_mm256_set1_pd(s->a), x);
  q = _mm256_add_pd(_mm256_add_pd(q, _mm256_set1_pd(s->by)),
                    _mm256_set1_pd(s->c));
  return _mm256_cvtpd_ps(q);
}

AVX2 static void tile_span_avx2(struct hsr_tiler *t, const struct span *s) {
  const __m256 clear = _mm256_set1_ps(HSR_CLEAR),
               least = _mm256_set1_ps(s->least);
  const __m256i id = _mm256_set1_epi32((int)s->id);
  const __m256d lanes = _mm256_set_pd(3, 2, 1, 0), four = _mm256_set1_pd(4);
  size_t row = (size_t)(s->j - t->part.y0);
  uint32_t *ids = t->ids + row * t->ids_stride;
  float *z = t->z + row * t->z_stride;
  for (int i = s->x0; i < s->x1; i += LANES_AVX2) {
    __m256d x = _mm256_add_pd(lanes, _mm256_set1_pd(hsr_sample_x(t->view, i)));
    __m256 q = _mm256_set_m128(four_depths(s, _mm256_add_pd(x, four)),
                               four_depths(s, x));
    __m256 in = first_of_eight(s->x1 - i);
    float *z_here = z + (i - t->part.x0);
    __m256 held = _mm256_maskload_ps(z_here, _mm256_castps_si256(in));
    __m256 known = _mm256_and_ps(in, _mm256_cmp_ps(q, least, _CMP_GT_OQ));
    __m256 nearer = _mm256_and_ps(
        known, _mm256_cmp_ps(q, _mm256_mul_ps(held, clear), _CMP_GT_OQ));
    __m256 farther = _mm256_and_ps(
        known, _mm256_cmp_ps(_mm256_mul_ps(q, clear), held, _CMP_LT_OQ));
    write_eight(z_here, ids + (i - t->part.x0), nearer, q, id);
    unsigned rest = (unsigned)_mm256_movemask_ps(
        _mm256_andnot_ps(_mm256_or_ps(nearer, farther), in));
    if (!rest)
      continue;
    unsigned sure = (unsigned)_mm256_movemask_ps(known);
    float depth[LANES_AVX2];
    _mm256_storeu_ps(depth, q);
    for (; rest; rest &= rest - 1) {
      int l = __builtin_ctz(rest);
      settle(t, s->f, s->id, sure >> l & 1 ? depth[l] : NAN, true, i + l, s->j);
    }
  }
}

/* --- Triangles ------------------------------------------------------------ */

/* f + fx x: a linear function along a row. */
AVX2 static inline __m256 linear_avx2(float f, float fx, __m256 x) {
  return _mm256_fmadd_ps(_mm256_set1_ps(fx), x, _mm256_set1_ps(f));
}

/* Decides some of the eight samples from (x, j) on. */
AVX2 __attribute__((noinline)) static void
settle_eight(struct hsr_tiler *t, const struct hsr_triangle *tri, __m256 q,
             unsigned lanes, unsigned sure, int x, int j) {
  float depth[LANES_AVX2];
  _mm256_storeu_ps(depth, q);
  for (; lanes; lanes &= lanes - 1) {
    int l = __builtin_ctz(lanes);
    settle(t, tri->face, tri->id, depth[l], sure >> l & 1, x + l, j);
  }
}

/* Eight samples of each row of a box, from column x on. */
AVX2 static inline void tile_strip_avx2(struct hsr_tiler *t,
                                        const struct hsr_triangle *tri,
                                        const struct hsr_window *box, int x) {
  const __m256 bound = _mm256_set1_ps(tri->bound),
               minus_bound = _mm256_set1_ps(-tri->bound),
               clear = _mm256_set1_ps(HSR_CLEAR), one = _mm256_set1_ps(1);
  const __m256 ey0 = _mm256_set1_ps(tri->ey0), ey1 = _mm256_set1_ps(tri->ey1),
               ey2 = _mm256_set1_ps(tri->ey2), qy = _mm256_set1_ps(tri->qy);
  const __m256i id = _mm256_set1_epi32((int)tri->id);
  __m256 right = _mm256_cvtepi32_ps(
      _mm256_add_epi32(eight_numbers(), _mm256_set1_epi32(x - tri->x0)));
  __m256 e0 = linear_avx2(tri->e0, tri->ex0, right),
         e1 = linear_avx2(tri->e1, tri->ex1, right),
         e2 = linear_avx2(tri->e2, tri->ex2, right),
         q0 = linear_avx2(tri->q, tri->qx, right);
  __m256 in_box = first_of_eight(box->x1 - x);
  const size_t ids_stride = t->ids_stride, z_stride = t->z_stride;
  size_t row = (size_t)(box->y0 - t->part.y0),
         column = (size_t)(x - t->part.x0);
  uint32_t *ids = t->ids + row * ids_stride + column;
  float *z = t->z + row * z_stride + column;
  __m256 down = _mm256_set1_ps((float)(box->y0 - tri->y0));
  for (int j = box->y0; j < box->y1; j++, ids += ids_stride, z += z_stride) {
    __m256 d0 = _mm256_fmadd_ps(ey0, down, e0),
           d1 = _mm256_fmadd_ps(ey1, down, e1),
           d2 = _mm256_fmadd_ps(ey2, down, e2),
           q = _mm256_fmadd_ps(qy, down, q0),
           d = _mm256_min_ps(_mm256_min_ps(d0, d1), d2);
    down = _mm256_add_ps(down, one);
    __m256 maybe =
        _mm256_and_ps(in_box, _mm256_cmp_ps(d, minus_bound, _CMP_GE_OQ));
    unsigned some = (unsigned)_mm256_movemask_ps(maybe);
    if (!some)
      continue;
    __m256 sure = _mm256_and_ps(maybe, _mm256_cmp_ps(d, bound, _CMP_GT_OQ));
    __m256 held = _mm256_maskload_ps(z, _mm256_castps_si256(maybe));
    __m256 nearer = _mm256_and_ps(
        sure, _mm256_cmp_ps(q, _mm256_mul_ps(held, clear), _CMP_GT_OQ));
    write_eight(z, ids, nearer, q, id);
    __m256 farther = _mm256_and_ps(
        sure, _mm256_cmp_ps(_mm256_mul_ps(q, clear), held, _CMP_LT_OQ));
    unsigned unsure =
        some & ~(unsigned)_mm256_movemask_ps(_mm256_or_ps(nearer, farther));
    if (unsure)
      settle_eight(t, tri, q, unsure, (unsigned)_mm256_movemask_ps(sure), x, j);
  }
}

AVX2 static void tile_avx2(struct hsr_tiler *t,
                           const struct hsr_triangle *tri) {
  struct hsr_window box = clip(t, tri->x0, tri->y0, tri->x1, tri->y1);
  for (int x = box.x0; x < box.x1; x += LANES_AVX2)
    tile_strip_avx2(t, tri, &box, x);
}

/* --- Small triangles ------------------------------------------------------ */

AVX2 static inline __m256 load8(const float *row) {
  return _mm256_loadu_ps(row);
}

AVX2 static inline __m256i load8i(const void *row) {
  return _mm256_loadu_si256((const __m256i *)row);
}

/* f + fx x + fy y, of eight triangles. */
AVX2 static inline __m256 linear2_avx2(const float *f, const float *fx,
                                       __m256 x, const float *fy, __m256 y) {
  return _mm256_fmadd_ps(load8(fy), y, _mm256_fmadd_ps(load8(fx), x, load8(f)));
}

/* Takes the samples of some lanes: those that are certainly covered go into the
 * queue, the others are decided. */
AVX2 static inline void take_lanes(struct hsr_tiler *t,
                                   const struct hsr_batch *b, int k,
                                   unsigned maybe, unsigned sure, __m256i at,
                                   __m256 q, struct queue *queue) {
  uint32_t places[LANES_AVX2];
  float depth[LANES_AVX2];
  _mm256_storeu_si256((__m256i *)places, at);
  _mm256_storeu_ps(depth, q);
  for (unsigned rest = sure; rest; rest &= rest - 1) {
    int l = __builtin_ctz(rest), n = queue->n++;
    queue->at[n] = places[l];
    queue->q[n] = depth[l];
    queue->id[n] = b->corners.id[k + l];
  }
  if (queue->n > QUEUE)
    compare_queue(t, queue);
  for (unsigned rest = maybe & ~sure; rest; rest &= rest - 1) {
    int l = __builtin_ctz(rest);
    settle(t, hsr_tiler_face(t, b, b->place[k + l]), b->corners.id[k + l],
           depth[l], false, t->window.x0 + (int)(places[l] & 0xffff),
           t->window.y0 + (int)(places[l] >> 16));
  }
}

/* Which of eight triangles have a small box; all lanes, or none, of each. */
AVX2 static inline __m256i small_of_eight(const struct hsr_batch *b, int k) {
  const struct hsr_corners *r = &b->corners;
  __m256i width = _mm256_sub_epi32(load8i(r->x1 + k), load8i(r->x0 + k)),
          height = _mm256_sub_epi32(load8i(r->y1 + k), load8i(r->y0 + k));
  return _mm256_cmpgt_epi32(_mm256_set1_epi32(SMALL_BOX + 1),
                            _mm256_mullo_epi32(width, height));
}

/* As tile_small: each triangle has a lane of its own, and all go through the
 * samples of their boxes in step. */
AVX2 static void tile_small_avx2(struct hsr_tiler *t, const struct hsr_batch *b,
                                 int k, __m256 active, struct queue *queue) {
  const struct hsr_corners *r = &b->corners;
  const struct hsr_triangles *s = &b->triangles;
  const __m256 one = _mm256_set1_ps(1), bound = load8(s->bound + k),
               minus_bound = _mm256_sub_ps(_mm256_setzero_ps(), bound);
  const __m256i one_column = _mm256_set1_epi32(1);
  __m256i x0 = load8i(r->x0 + k), y0 = load8i(r->y0 + k);
  __m256i columns = _mm256_sub_epi32(load8i(r->x1 + k), x0);
  __m256 width = _mm256_cvtepi32_ps(columns),
         height = _mm256_cvtepi32_ps(_mm256_sub_epi32(load8i(r->y1 + k), y0));
  x0 = _mm256_sub_epi32(x0, _mm256_set1_epi32(t->window.x0));
  y0 = _mm256_sub_epi32(y0, _mm256_set1_epi32(t->window.y0));
  __m256i at = _mm256_add_epi32(x0, _mm256_slli_epi32(y0, 16));
  __m256i next_row = _mm256_sub_epi32(_mm256_set1_epi32(1 << 16), columns);
  __m256 right = _mm256_setzero_ps(), down = _mm256_setzero_ps();
  while (_mm256_movemask_ps(active)) {
    __m256 d0 = linear2_avx2(s->e0 + k, s->ex0 + k, right, s->ey0 + k, down),
           d1 = linear2_avx2(s->e1 + k, s->ex1 + k, right, s->ey1 + k, down),
           d2 = linear2_avx2(s->e2 + k, s->ex2 + k, right, s->ey2 + k, down),
           q = linear2_avx2(s->q + k, s->qx + k, right, s->qy + k, down),
           d = _mm256_min_ps(_mm256_min_ps(d0, d1), d2);
    unsigned maybe = (unsigned)_mm256_movemask_ps(
        _mm256_and_ps(active, _mm256_cmp_ps(d, minus_bound, _CMP_GE_OQ)));
    unsigned sure = (unsigned)_mm256_movemask_ps(
        _mm256_and_ps(active, _mm256_cmp_ps(d, bound, _CMP_GT_OQ)));
    if (maybe)
      take_lanes(t, b, k, maybe, sure, at, q, queue);
    right = _mm256_add_ps(right, one);
    at = _mm256_add_epi32(at, one_column);
    __m256 end = _mm256_cmp_ps(right, width, _CMP_GE_OQ);
    right = _mm256_andnot_ps(end, right);
    down = _mm256_add_ps(down, _mm256_and_ps(end, one));
    at = _mm256_add_epi32(at,
                          _mm256_and_si256(_mm256_castps_si256(end), next_row));
    active = _mm256_and_ps(active, _mm256_cmp_ps(down, height, _CMP_LT_OQ));
  }
}

AVX2 static void tile_batch_avx2(struct hsr_tiler *t,
                                 const struct hsr_batch *b) {
  struct queue queue;
  queue.n = 0;
  for (int k = 0; k < b->n_fast; k += LANES_AVX2) {
    __m256i bad =
        _mm256_cmpeq_epi32(load8i(b->good + k), _mm256_setzero_si256());
    __m256 good = _mm256_andnot_ps(_mm256_castsi256_ps(bad),
                                   first_of_eight(b->n_fast - k));
    __m256 small =
        _mm256_and_ps(good, _mm256_castsi256_ps(small_of_eight(b, k)));
    if (__builtin_popcount((unsigned)_mm256_movemask_ps(small)) < MANY)
      small = _mm256_setzero_ps();
    else
      tile_small_avx2(t, b, k, small, &queue);
    for (unsigned large =
             (unsigned)_mm256_movemask_ps(_mm256_andnot_ps(small, good));
         large; large &= large - 1) {
      struct hsr_triangle triangle =
          hsr_tiler_take(t, b, k + __builtin_ctz(large));
      tile_avx2(t, &triangle);
    }
  }
  compare_queue(t, &queue);
}

static const struct hsr_twin avx2 = {look_avx2, tile_span_avx2, tile_avx2,
                                     tile_batch_avx2, write_back_portable};

#endif
