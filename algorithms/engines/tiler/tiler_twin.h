/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The loops of tiler.c over samples and triangles, WIDTH at a time. Each
 * function does what its portable twin in tiler.c does, but rounds less. This
 * file is part of tiler.c. It is included once for each width, by the header
 * that defines the lanes (tiler_avx2.h, tiler_avx512.h): operations f_ on
 * floats, i_ on ints and m_ on masks, of WIDTH lanes. TWIN(name) is the name
 * with that width's ending. */
#define floats TWIN(floats)
#define ints TWIN(ints)
#define mask TWIN(mask)

/* --- Looking at a batch --------------------------------------------------- */

/* The same corner of WIDTH triangles. */
struct TWIN(corners) {
  ints x, y;
  floats q;
};

/* Corners v[0], v[3], ...: transpositions of four by four. */
VECTOR static inline struct TWIN(corners)
    TWIN(gather)(const struct hsr_corner *corner, const uint32_t *v) {
  ints c0 = TWIN(load_corners)(corner, v),
       c1 = TWIN(load_corners)(corner, v + 3),
       c2 = TWIN(load_corners)(corner, v + 6),
       c3 = TWIN(load_corners)(corner, v + 9);
  ints xy01 = i_low32(c0, c1), xy23 = i_low32(c2, c3), q01 = i_high32(c0, c1),
       q23 = i_high32(c2, c3);
  return (struct TWIN(corners)){i_low64(xy01, xy23), i_high64(xy01, xy23),
                                f_of_bits(i_low64(q01, q23))};
}

/* The samples from lo - 1 to hi + 1 grid units, of which the first is at
 * `first`, within [w0, w1): [*from, *to). */
VECTOR static inline void TWIN(find_samples)(ints lo, ints hi, int first,
                                             int w0, int w1, ints *from,
                                             ints *to) {
  *from = i_right(i_add(lo, i_all(GRID - 2 - first)), GRID_BITS);
  *to = i_right(i_add(hi, i_all(GRID + 1 - first)), GRID_BITS);
  *from = i_max(*from, i_all(w0));
  *to = i_min(*to, i_all(w1));
}

/* a - b, in pixels. */
VECTOR static inline floats TWIN(pixels)(ints a, ints b) {
  return f_of_ints(i_sub(a, b)) * f_all(1.0f / GRID);
}

/* Returns the lanes of `live` whose triangles take the fast way. *turned: the
 * lanes whose triangles are seen from the front (y runs down). *back: those of
 * back faces that do not exist. */
VECTOR static inline mask
TWIN(decide)(const struct hsr_tiler *t, const struct TWIN(corners) * A,
             const struct TWIN(corners) * B, const struct TWIN(corners) * C,
             floats width, floats height, mask live, const bool *one_sided,
             mask *turned, mask *back) {
  const floats zero = f_all(0), two = f_all(2);
  /* The doubled area, negative if seen from the front. */
  floats area = TWIN(pixels)(B->x, A->x) * TWIN(pixels)(C->y, A->y) -
                TWIN(pixels)(C->x, A->x) * TWIN(pixels)(B->y, A->y);
  floats around = width + height + f_all(4);
  floats within = f_all(0x1p-20f) * (width + two) * (height + two);
  floats least = f_all(64 * SNAP) * around + within;
  mask small = f_le(live, f_max(width, height), f_all(LARGEST_BOX));
  mask behind = f_gt(small, area, least);
  mask before = f_lt(small, area, zero - least);
  floats nearest = f_max(f_max(A->q, B->q), C->q);
  *turned = f_negative(area);
  *back = m_of_bytes(behind, one_sided);
  return f_lt(m_less(m_or(behind, before), *back), nearest, f_all(t->nearest));
}

/* Triangles go to the batch's fast ones, from the kept lanes. */
VECTOR static inline void TWIN(keep_corners)(struct hsr_corners *r, int to,
                                             TWIN(kept) kept, mask turned,
                                             const struct TWIN(corners) * A,
                                             const struct TWIN(corners) * B,
                                             const struct TWIN(corners) * C) {
  TWIN(keep)(r->ax, to, kept, A->x);
  TWIN(keep)(r->ay, to, kept, A->y);
  TWIN(keep)(r->qa, to, kept, f_bits(A->q));
  TWIN(keep)(r->bx, to, kept, i_pick(turned, C->x, B->x));
  TWIN(keep)(r->by, to, kept, i_pick(turned, C->y, B->y));
  TWIN(keep)(r->qb, to, kept, f_bits(f_pick(turned, C->q, B->q)));
  TWIN(keep)(r->cx, to, kept, i_pick(turned, B->x, C->x));
  TWIN(keep)(r->cy, to, kept, i_pick(turned, B->y, C->y));
  TWIN(keep)(r->qc, to, kept, f_bits(f_pick(turned, B->q, C->q)));
}

/* What decide() finds of the first n of the triangles from k on, of which those
 * to be tiled are kept. They never get ahead of what is still to be read. */
VECTOR static inline void TWIN(look_at)(const struct hsr_tiler *t,
                                        struct hsr_batch *b, const uint32_t *v,
                                        const bool *one_sided, int k, int n) {
  const mask asked = m_first(n);
  const ints unsafe_x = i_all(UNSAFE);
  struct TWIN(corners) A = TWIN(gather)(t->corner, v),
                       B = TWIN(gather)(t->corner, v + 1),
                       C = TWIN(gather)(t->corner, v + 2);
  mask unsafe =
      m_and(asked, m_or(m_or(i_eq(A.x, unsafe_x), i_eq(B.x, unsafe_x)),
                        i_eq(C.x, unsafe_x)));

  /* The samples of their boxes: the most triangles of a dense mesh have
   * none. */
  ints lo_x = i_min(i_min(A.x, B.x), C.x), hi_x = i_max(i_max(A.x, B.x), C.x),
       lo_y = i_min(i_min(A.y, B.y), C.y), hi_y = i_max(i_max(A.y, B.y), C.y);
  ints x0, x1, y0, y1;
  TWIN(find_samples)
  (lo_x, hi_x, t->first_x, t->window.x0, t->window.x1, &x0, &x1);
  TWIN(find_samples)
  (lo_y, hi_y, t->first_y, t->window.y0, t->window.y1, &y0, &y1);
  mask live = i_gt(i_gt(m_less(asked, unsafe), x1, x0), y1, y0);
  mask fast = m_none(), general = unsafe;
  if (m_any(live)) {
    mask turned, back;
    fast =
        TWIN(decide)(t, &A, &B, &C, TWIN(pixels)(hi_x, lo_x),
                     TWIN(pixels)(hi_y, lo_y), live, one_sided, &turned, &back);
    general = m_or(general, m_less(live, m_or(back, fast)));
    if (m_any(fast)) {
      struct hsr_corners *r = &b->corners;
      const int to = b->n_fast;
      const TWIN(kept) kept = TWIN(kept_of)(fast);
      TWIN(keep_corners)(r, to, kept, turned, &A, &B, &C);
      TWIN(keep)(r->x0, to, kept, x0);
      TWIN(keep)(r->y0, to, kept, y0);
      TWIN(keep)(r->x1, to, kept, x1);
      TWIN(keep)(r->y1, to, kept, y1);
      TWIN(keep)(b->place, to, kept, i_add(i_numbers(), i_all(k)));
      b->n_fast = to + __builtin_popcount(m_bits(fast));
    }
  }
  b->general |= m_any(general);
  i_store(b->fate + k, i_add(i_where(fast, i_all(HSR_TILE)),
                             i_where(general, i_all(HSR_GENERALLY))));
}

VECTOR static void TWIN(look)(const struct hsr_tiler *t, struct hsr_batch *b) {
  const uint32_t *v = vertices_from(t, b);
  const bool *sides = sides_from(t, b);
  int k = 0;
  for (; k + WIDTH <= b->n; k += WIDTH)
    TWIN(look_at)(t, b, v + 3 * k, sides + k, k, WIDTH);
  if (k < b->n) {
    struct last last = last_ones(v, sides, k, b->n);
    TWIN(look_at)(t, b, last.vertex, last.one_sided, k, b->n - k);
  }
}

/* --- The general way ------------------------------------------------------ */

VECTOR static void TWIN(tile_span)(struct hsr_tiler *t, const struct span *s) {
  const floats clear = f_all(HSR_CLEAR), least = f_all(s->least);
  const ints id = i_all((int)s->id);
  size_t row = (size_t)(s->j - t->part.y0);
  uint32_t *ids = t->ids + row * t->ids_stride;
  float *z = t->z + row * t->z_stride;
  for (int i = s->x0; i < s->x1; i += WIDTH) {
    floats q = TWIN(depths)(s, hsr_sample_x(t->view, i));
    mask in = m_first(s->x1 - i);
    float *z_here = z + (i - t->part.x0);
    floats held = f_load_where(in, z_here);
    mask known = f_gt(in, q, least);
    mask nearer = f_gt(known, q, held * clear);
    mask farther = f_lt(known, q * clear, held);
    TWIN(write)(z_here, ids + (i - t->part.x0), nearer, q, id);
    unsigned rest = m_bits(m_less(in, m_or(nearer, farther)));
    if (!rest)
      continue;
    unsigned sure = m_bits(known);
    float depth[WIDTH];
    f_store(depth, q);
    for (; rest; rest &= rest - 1) {
      int l = __builtin_ctz(rest);
      settle(t, s->f, s->id, sure >> l & 1 ? depth[l] : NAN, true, i + l, s->j);
    }
  }
}

/* --- Triangles ------------------------------------------------------------ */

/* f + fx x: a linear function along a row. */
VECTOR static inline floats TWIN(linear)(float f, float fx, floats x) {
  return f_fma(f_all(fx), x, f_all(f));
}

/* f + fx x + fy y, of WIDTH triangles. */
VECTOR static inline floats TWIN(linear2)(const float *f, const float *fx,
                                          floats x, const float *fy, floats y) {
  return f_fma(f_load(fy), y, f_fma(f_load(fx), x, f_load(f)));
}

/* Decides some of the samples from (x, j) on. */
VECTOR __attribute__((noinline)) static void
TWIN(settle_row)(struct hsr_tiler *t, const struct hsr_triangle *tri, floats q,
                 unsigned lanes, unsigned sure, int x, int j) {
  float depth[WIDTH];
  f_store(depth, q);
  for (; lanes; lanes &= lanes - 1) {
    int l = __builtin_ctz(lanes);
    settle(t, tri->face, tri->id, depth[l], sure >> l & 1, x + l, j);
  }
}

/* WIDTH samples of each row of a box, from column x on. */
VECTOR static inline void TWIN(tile_strip)(struct hsr_tiler *t,
                                           const struct hsr_triangle *tri,
                                           const struct hsr_window *box,
                                           int x) {
  const floats bound = f_all(tri->bound), minus_bound = f_all(-tri->bound),
               clear = f_all(HSR_CLEAR), one = f_all(1);
  const floats ey0 = f_all(tri->ey0), ey1 = f_all(tri->ey1),
               ey2 = f_all(tri->ey2), qy = f_all(tri->qy);
  const ints id = i_all((int)tri->id);
  floats right = f_of_ints(i_add(i_numbers(), i_all(x - tri->x0)));
  floats e0 = TWIN(linear)(tri->e0, tri->ex0, right),
         e1 = TWIN(linear)(tri->e1, tri->ex1, right),
         e2 = TWIN(linear)(tri->e2, tri->ex2, right),
         q0 = TWIN(linear)(tri->q, tri->qx, right);
  mask in_box = m_first(box->x1 - x);
  const size_t ids_stride = t->ids_stride, z_stride = t->z_stride;
  size_t row = (size_t)(box->y0 - t->part.y0),
         column = (size_t)(x - t->part.x0);
  uint32_t *ids = t->ids + row * ids_stride + column;
  float *z = t->z + row * z_stride + column;
  floats down = f_all((float)(box->y0 - tri->y0));
  for (int j = box->y0; j < box->y1; j++, ids += ids_stride, z += z_stride) {
    floats d0 = f_fma(ey0, down, e0), d1 = f_fma(ey1, down, e1),
           d2 = f_fma(ey2, down, e2), q = f_fma(qy, down, q0),
           d = f_min(f_min(d0, d1), d2);
    down = down + one;
    mask maybe = f_ge(in_box, d, minus_bound);
    unsigned some = m_bits(maybe);
    if (!some)
      continue;
    mask sure = f_gt(maybe, d, bound);
    floats held = f_load_where(maybe, z);
    mask nearer = f_gt(sure, q, held * clear);
    TWIN(write)(z, ids, nearer, q, id);
    mask farther = f_lt(sure, q * clear, held);
    unsigned unsure = some & ~m_bits(m_or(nearer, farther));
    if (unsure)
      TWIN(settle_row)(t, tri, q, unsure, m_bits(sure), x, j);
  }
}

/* A triangle with a larger box. */
VECTOR static void TWIN(tile)(struct hsr_tiler *t,
                              const struct hsr_triangle *tri) {
  struct hsr_window box = clip(t, tri->x0, tri->y0, tri->x1, tri->y1);
  for (int x = box.x0; x < box.x1; x += WIDTH)
    TWIN(tile_strip)(t, tri, &box, x);
}

/* --- Small triangles ------------------------------------------------------ */

/* Decides samples that the triangles from k on cover perhaps. */
VECTOR __attribute__((noinline)) static void
TWIN(settle_lanes)(struct hsr_tiler *t, const struct hsr_batch *b, int k,
                   unsigned lanes, ints at, floats q) {
  uint32_t places[WIDTH];
  float depth[WIDTH];
  i_store(places, at);
  f_store(depth, q);
  for (; lanes; lanes &= lanes - 1) {
    int l = __builtin_ctz(lanes);
    settle(t, hsr_tiler_face(t, b, b->place[k + l]), b->corners.id[k + l],
           depth[l], false, t->window.x0 + (int)(places[l] & 0xffff),
           t->window.y0 + (int)(places[l] >> 16));
  }
}

/* Which of the good triangles from k on have a small box. */
VECTOR static inline mask TWIN(small_ones)(const struct hsr_batch *b, int k,
                                           mask good) {
  const struct hsr_corners *r = &b->corners;
  ints width = i_sub(i_load(r->x1 + k), i_load(r->x0 + k)),
       height = i_sub(i_load(r->y1 + k), i_load(r->y0 + k));
  return i_gt(good, i_all(SMALL_BOX + 1), i_mul(width, height));
}

/* Those of the triangles from k on that are small. Each has a lane of its own.
 * All go through the samples of their boxes in step, row by row. */
VECTOR static void TWIN(tile_small)(struct hsr_tiler *t,
                                    const struct hsr_batch *b, int k,
                                    mask active, struct queue *queue) {
  const struct hsr_corners *r = &b->corners;
  const struct hsr_triangles *s = &b->triangles;
  const floats one = f_all(1), bound = f_load(s->bound + k),
               minus_bound = f_all(0) - bound;
  ints x0 = i_load(r->x0 + k), y0 = i_load(r->y0 + k);
  ints columns = i_sub(i_load(r->x1 + k), x0);
  floats width = f_of_ints(columns),
         height = f_of_ints(i_sub(i_load(r->y1 + k), y0));
  x0 = i_sub(x0, i_all(t->window.x0));
  y0 = i_sub(y0, i_all(t->window.y0));
  ints at = i_add(x0, i_left(y0, 16));
  ints next_row = i_sub(i_all(1 << 16), columns);
  const TWIN(names) names = names_at(r->id + k);
  floats right = f_all(0), down = f_all(0);
  while (m_any(active)) {
    floats d0 = TWIN(linear2)(s->e0 + k, s->ex0 + k, right, s->ey0 + k, down),
           d1 = TWIN(linear2)(s->e1 + k, s->ex1 + k, right, s->ey1 + k, down),
           d2 = TWIN(linear2)(s->e2 + k, s->ex2 + k, right, s->ey2 + k, down),
           q = TWIN(linear2)(s->q + k, s->qx + k, right, s->qy + k, down),
           d = f_min(f_min(d0, d1), d2);
    unsigned maybe = m_bits(f_ge(active, d, minus_bound));
    unsigned sure = m_bits(f_gt(active, d, bound));
    if (maybe) {
      TWIN(enqueue)(queue, sure, at, q, names);
      if (queue->n > QUEUE)
        compare_queue(t, queue);
      if (__builtin_expect(maybe != sure, 0))
        TWIN(settle_lanes)(t, b, k, maybe & ~sure, at, q);
    }
    right = right + one;
    at = i_add(at, i_all(1));
    mask end = f_not_below(right, width);
    right = f_pick(end, f_all(0), right);
    down = down + f_where(end, one);
    at = i_add(at, i_where(end, next_row));
    active = f_lt(active, down, height);
  }
}

VECTOR static void TWIN(tile_batch)(struct hsr_tiler *t,
                                    const struct hsr_batch *b) {
  struct queue queue;
  queue.n = 0;
  for (int k = 0; k < b->n_fast; k += WIDTH) {
    mask good =
        m_less(m_first(b->n_fast - k), i_eq(i_load(b->good + k), i_all(0)));
    mask small = TWIN(small_ones)(b, k, good);
    if (__builtin_popcount(m_bits(small)) < FEWEST)
      small = m_none();
    else
      TWIN(tile_small)(t, b, k, small, &queue);
    for (unsigned large = m_bits(m_less(good, small)); large;
         large &= large - 1) {
      struct hsr_triangle triangle =
          hsr_tiler_take(t, b, k + __builtin_ctz(large));
      TWIN(tile)(t, &triangle);
    }
  }
  compare_queue(t, &queue);
}

static const struct hsr_twin TWIN(twin) = {TWIN(look), TWIN(tile_span),
                                           TWIN(tile), TWIN(tile_batch),
                                           TWIN(write_back)};

#undef floats
#undef ints
#undef mask
#undef TWIN
#undef VECTOR
#undef WIDTH
#undef FEWEST
#undef f_all
#undef f_fma
#undef f_min
#undef f_max
#undef f_load
#undef f_load_where
#undef f_store
#undef f_of_ints
#undef f_pick
#undef f_where
#undef f_bits
#undef f_of_bits
#undef f_gt
#undef f_ge
#undef f_lt
#undef f_le
#undef f_negative
#undef f_not_below
#undef names_at
#undef i_all
#undef i_numbers
#undef i_add
#undef i_sub
#undef i_mul
#undef i_min
#undef i_max
#undef i_left
#undef i_right
#undef i_load
#undef i_store
#undef i_pick
#undef i_where
#undef i_low32
#undef i_high32
#undef i_low64
#undef i_high64
#undef i_gt
#undef i_eq
#undef m_none
#undef m_first
#undef m_and
#undef m_or
#undef m_less
#undef m_any
#undef m_bits
#undef m_of_bytes
