/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The proofs of the fast way's bounds.
 *
 * Snapping moves a coordinate by at most s = 2^-16 + 2^-26
 * (common/exact/screen.h), or 2^-24 more than 2^-16 where that is all that is
 * known of it. With W and H the width and height in pixels of the box of the
 * samples in question, and everything of the triangle within it but for 2
 * pixels, the sides d = b - a of the triangle and the offsets h of a sample
 * from a vertex are at most W + 2 and H + 2.
 *
 * Coverage. e = dx hy - dy hx changes by at most 2.1 s (|dx| + |dy| + |hx| +
 * |hy|) <= 4.2 s (W + H + 4). Differences of snapped coordinates are exact in
 * floats, being below 2^24 grid units. e is computed as (e_00 + ey jj) + ex ii,
 * or as (e_00 + ex ii) + ey jj; its products and sums, seven roundings of terms
 * no larger than 2 (W + 2)(H + 2), err by at most 14 * 2^-24 (W + 2)(H + 2) <
 * 2^-20 (W + 2)(H + 2). The bound is 5 s (W + H + 4) + 2^-20 (W + 2)(H + 2). A
 * fused multiply-add leaves out the rounding of its product, here and below,
 * and errs by no more than what is reckoned for the two operations.
 *
 * Depth. The plane through the snapped vertices with their depths q^ differs at
 * a sample of the triangle from the true one by the interpolated residuals at
 * the vertices, each at most 2^-23 q + |g|_1 s, g the gradient of q; the
 * weights are at most 1 + 1/16 since |A| >= 64 s (W + H + 4), A the doubled
 * area. The gradient computed from A and differences D1, D2 of depths carries,
 * times the box, at most 2^-24 M (3 k + 5), where M = (|D1| (|dy2| W + |dx2| H)
 * + |D2| (|dy1| W + |dx1| H)) / |A| and k = (|dx1 dy2| + |dx2 dy1|) / |A|;
 * evaluating it takes four roundings of at most 2^-24 (q_max + M). Where D1 and
 * D2 are at most q_min in size, so that q_max <= 2 q_min, and M <= 4 q_min,
 * M (k + 2) <= 16 q_min, |g|_1 <= 0.3 q_min, the sum is at most
 *     (2^-23 + 0.3 * 2^-16) 17/16 + 2^-24 (48 + 24) < 0.7 * 2^-16
 * of q, and HSR_RHO = 2^-16 holds it. A triangle that does not fulfil all this
 * takes the general way.
 *
 * Parallel. q is far - t, with far = t_max + range, where range is t_max -
 * t_min or 2^-20 of the size of the coordinates, whichever is more. t is within
 * 8u of that size, which is 2^-30 of the range, and q is at least the range: so
 * q is within 2^-29 of itself before it is rounded to a float. From here on
 * only q > 0 and its relative error matter, and all of the above holds. In the
 * general way far is added to the constant of a depth plane; least has what
 * that rounds. */
#include "algorithms/engines/tiler/tiler.h"
#include "common/base/vector.h"

#include <limits.h>
#include <string.h>

/* The counting build takes the portable way, triangle after triangle and sample
 * by sample. So its counts and traces are the same on every machine. */
#if defined __x86_64__ && HSR_HAVE_TARGET_CLONES && !HSR_COUNTING
#include <immintrin.h>
#define HAVE_TWINS 1
#endif

/* 1: decide by the floats alone. This is only to measure what exactness costs.
 */
#ifndef HSR_INEXACT
#define HSR_INEXACT 0
#endif

enum {
  GRID_BITS = 15,
  GRID = 1 << GRID_BITS, /* grid units a pixel */
  UNSAFE = INT_MIN,      /* snapped coordinate of a vertex that is not safe */
  LARGEST_BOX = 500,     /* pixels; keeps differences below 2^24 grid units */
  LANES = 16,
  SMALL_BOX = 16, /* samples; above, a triangle fills its own lanes */
  QUEUE = 512,    /* samples */
  SNAPPED = 256   /* points that are transformed before they are snapped */
};
/* Pixels; sums and differences of snapped coordinates fit in an int. */
static const double FARTHEST = 32767.9;
static const float SNAP = 0x1.01p-16f; /* s */

/* A row of a face that covers all of it: q = a sx + (b sy) + c. */
struct span {
  uint32_t f, id;
  double a, b, by, c;
  float least; /* a depth is unknown unless it is more: within HSR_RHO */
  int j, x0, x1;
};

/* The loops over samples and triangles. They are written for every machine in
 * this file, and once more in tiler_twin.h for AVX2 (tiler_avx2.h) and AVX-512
 * (tiler_avx512.h). */
struct hsr_twin {
  void (*look)(const struct hsr_tiler *, struct hsr_batch *);
  void (*tile_span)(struct hsr_tiler *, const struct span *);
  void (*tile)(struct hsr_tiler *, const struct hsr_triangle *);
  void (*tile_batch)(struct hsr_tiler *, const struct hsr_batch *);
  void (*write_back)(const struct hsr_tiler *, const struct hsr_job *);
};

/* --- What floats cannot tell ---------------------------------------------- */

/* Makes sure that the screen's vertices have been transformed. */
void hsr_tiler_need_screen(struct hsr_tiler *t) {
  void (*lay_out)(void *) = t->lay_out;
  t->lay_out = NULL;
  if (lay_out)
    lay_out(t->context);
}

/* The same for the corners of face f. */
static void need_corners(struct hsr_tiler *t, uint32_t f) {
  hsr_tiler_need_screen(t);
  if (t->list)
    hsr_screen_corners(&t->screen, f);
}

/* Does face f of the tiler's world, whose id in the picture is `id`, cover
 * sample (i, j)? Decided exactly. */
static bool covers(struct hsr_tiler *t, uint32_t f, uint32_t id, int i, int j) {
  struct hsr_screen *screen = &t->screen;
  if (t->alone) {
    hsr_alone_take(t->alone, id);
    screen = &t->alone->screen;
    f = 0;
  } else {
    need_corners(t, f);
  }
  screen->whole[f] = true;
  bool covered = hsr_covers(screen, f, i, j, t->tally);
  HSR_STEP(t->tally, HSR_UNSURE_COVER, HSR_FACE(id), HSR_THE_WINDOW,
           HSR_AT(i, j), covered);
  return covered;
}

/* Of two faces, by their ids in the picture: is the first nearer at sample (i,
 * j) than the second? Decided exactly. */
static bool is_nearer_exactly(struct hsr_tiler *t, uint32_t id, uint32_t held,
                              int i, int j) {
  if (t->pair)
    return hsr_pair_nearer(t->pair, id, held, i, j, t->tally);
  hsr_screen_plane(&t->screen, id);
  hsr_screen_plane(&t->screen, held);
  return hsr_nearer(&t->screen, id, held, i, j, t->tally);
}

/* Is the face `id` nearer than `held`, which the sample holds? Both are ids in
 * the picture; `held` may be the background, or the face itself. */
static bool is_nearer(struct hsr_tiler *t, uint32_t id, uint32_t held, int i,
                      int j) {
  if (held == HSR_BACKGROUND || held == id)
    return held != id;
  bool nearer = is_nearer_exactly(t, id, held, i, j);
  HSR_STEP(t->tally, HSR_UNSURE_DEPTH, HSR_FACE(id), HSR_FACE(held),
           HSR_AT(i, j), nearer);
  return nearer;
}

/* The face is written to the sample. */
static inline void tell_write(const struct hsr_tiler *t, uint32_t id,
                              uint32_t held, int i, int j) {
  HSR_ACCEPTED(t->tally, HSR_WRITES, HSR_FACE(id), HSR_FACE(held), HSR_AT(i, j),
               t->glass ? hsr_glass_tint(t->glass, id)->rgb : NULL);
  if (held != HSR_BACKGROUND)
    HSR_STEP(t->tally, HSR_OVERWRITES, HSR_FACE(held), HSR_FACE(id),
             HSR_AT(i, j), 0);
}

/* Writes face f of the tiler's world, whose id in the picture is `id`, to
 * sample (i, j), where its depth is q, if it covers the sample and is nearer
 * than what is there. `sure`: it certainly covers it, and f is not used. */
static inline void settle(struct hsr_tiler *t, uint32_t f, uint32_t id, float q,
                          bool sure, int i, int j) {
  size_t x = (size_t)(i - t->part.x0), y = (size_t)(j - t->part.y0);
  uint32_t *held = &t->ids[y * t->ids_stride + x];
  float *z = &t->z[y * t->z_stride + x];
#if HSR_INEXACT
  (void)covers;
  (void)is_nearer;
  (void)f;
  if (sure && q > *z) {
    *z = q;
    *held = id;
  }
#else
  if (!sure && !covers(t, f, id, i, j))
    return;
  HSR_TOUCH(t->tally, i, j);
  bool clear = q > *z * HSR_CLEAR || q * HSR_CLEAR < *z;
  HSR_COUNT_DEPTHS(t->tally, clear && *held != HSR_BACKGROUND);
  bool nearer = clear ? q > *z : is_nearer(t, id, *held, i, j);
  HSR_STEP(t->tally, HSR_DEPTH_TESTS, HSR_FACE(id), HSR_FACE(*held),
           HSR_AT(i, j), nearer);
  if (!nearer)
    return;
  tell_write(t, id, *held, i, j);
  *z = q;
  *held = id;
#endif
}

/* --- Looking at a batch --------------------------------------------------- */

/* The corners of the triangles to be looked at, and which are one-sided, from
 * the batch's first on. */
static inline const uint32_t *vertices_from(const struct hsr_tiler *t,
                                            const struct hsr_batch *b) {
  const uint32_t *vertex =
      t->list ? t->list->vertex : t->screen.world->mesh.vertex;
  return vertex + 3 * (size_t)b->first;
}
static inline const bool *sides_from(const struct hsr_tiler *t,
                                     const struct hsr_batch *b) {
  return (t->list ? t->list->one_sided : t->screen.world->mesh.one_sided) +
         b->first;
}

/* The corners of the faces from the k-th on. */
static void gather_from(const struct hsr_tiler *t, struct hsr_batch *batch,
                        int k) {
  const uint32_t *restrict vertex = vertices_from(t, batch);
  const bool *one_sided = sides_from(t, batch);
  const struct hsr_corner *restrict corner = t->corner;
  struct hsr_corners *restrict r = &batch->corners;
  for (; k < batch->n; k++) {
    struct hsr_corner a = corner[vertex[3 * k]], b = corner[vertex[3 * k + 1]],
                      c = corner[vertex[3 * k + 2]];
    r->ax[k] = a.x, r->ay[k] = a.y, r->qa[k] = a.q;
    r->bx[k] = b.x, r->by[k] = b.y, r->qb[k] = b.q;
    r->cx[k] = c.x, r->cy[k] = c.y, r->qc[k] = c.q;
    batch->one_sided[k] = one_sided[k];
  }
}

/* Finds the boxes of the triangles from `from` on, turns them so that their
 * area on the screen is positive, and says what becomes of them. */
HSR_VECTOR static int decide(const struct hsr_tiler *t, int from, int n,
                             struct hsr_corners *restrict r,
                             const int *restrict one_sided,
                             int *restrict fate) {
  int any = 0;
  const int fx = t->first_x, fy = t->first_y;
  const int wx0 = t->window.x0, wx1 = t->window.x1, wy0 = t->window.y0,
            wy1 = t->window.y1;
  const float past = t->nearest, unit = 1.0f / GRID;
  for (int k = from; k < n; k++) {
    int ax = r->ax[k], bx = r->bx[k], cx = r->cx[k];
    int ay = r->ay[k], by = r->by[k], cy = r->cy[k];
    float qa = r->qa[k], qb = r->qb[k], qc = r->qc[k];
    int unsafe = (ax == UNSAFE) | (bx == UNSAFE) | (cx == UNSAFE);
    int safe = unsafe - 1;              /* all bits, or none */
    ax &= safe, bx &= safe, cx &= safe; /* nothing below may overflow */
    ay &= safe, by &= safe, cy &= safe;
    int lo_x = ax < bx ? ax : bx, hi_x = ax < bx ? bx : ax;
    int lo_y = ay < by ? ay : by, hi_y = ay < by ? by : ay;
    lo_x = cx < lo_x ? cx : lo_x;
    hi_x = cx > hi_x ? cx : hi_x;
    lo_y = cy < lo_y ? cy : lo_y;
    hi_y = cy > hi_y ? cy : hi_y;

    /* Samples from lo - 1 to hi + 1 grid units, within the window. */
    int x0 = (lo_x - 1 - fx + GRID - 1) >> GRID_BITS;
    int x1 = ((hi_x + 1 - fx) >> GRID_BITS) + 1;
    int y0 = (lo_y - 1 - fy + GRID - 1) >> GRID_BITS;
    int y1 = ((hi_y + 1 - fy) >> GRID_BITS) + 1;
    x0 = x0 < wx0 ? wx0 : x0;
    x1 = x1 > wx1 ? wx1 : x1;
    y0 = y0 < wy0 ? wy0 : y0;
    y1 = y1 > wy1 ? wy1 : y1;
    int empty = (x0 >= x1) | (y0 >= y1);

    /* The doubled area, negative if seen from the front (y runs down). */
    float width = (float)(hi_x - lo_x) * unit;
    float height = (float)(hi_y - lo_y) * unit;
    float d1x = (float)(bx - ax) * unit, d1y = (float)(by - ay) * unit;
    float d2x = (float)(cx - ax) * unit, d2y = (float)(cy - ay) * unit;
    float area = d1x * d2y - d2x * d1y;
    float least = 64 * SNAP * (width + height + 4) +
                  0x1p-20f * (width + 2) * (height + 2);
    int small = (width <= LARGEST_BOX) & (height <= LARGEST_BOX);
    int back = small & (area > least) & one_sided[k];
    int thick = (area > least) | (area < -least);
    float nearest = qa > qb ? qa : qb;
    nearest = qc > nearest ? qc : nearest;
    int past_near = nearest < past;

    int turned = area < 0;
    r->bx[k] = turned ? cx : bx;
    r->by[k] = turned ? cy : by;
    r->cx[k] = turned ? bx : cx;
    r->cy[k] = turned ? by : cy;
    r->qb[k] = turned ? qc : qb;
    r->qc[k] = turned ? qb : qc;
    r->x0[k] = x0;
    r->y0[k] = y0;
    r->x1[k] = x1;
    r->y1[k] = y1;
    int drop = (unsafe ^ 1) & (empty | back);
    int fast = (unsafe ^ 1) & small & thick & past_near;
    fate[k] =
        (drop ^ 1) * (HSR_GENERALLY - fast); /* or HSR_DROP, or HSR_TILE */
    any |= fate[k];
  }
  return any & HSR_GENERALLY;
}

/* Copies the k-th triangle to number `to`; it is face first + place. */
static void move(struct hsr_batch *b, int k, int place, int to) {
  struct hsr_corners *r = &b->corners;
  r->ax[to] = r->ax[k], r->ay[to] = r->ay[k], r->qa[to] = r->qa[k];
  r->bx[to] = r->bx[k], r->by[to] = r->by[k], r->qb[to] = r->qb[k];
  r->cx[to] = r->cx[k], r->cy[to] = r->cy[k], r->qc[to] = r->qc[k];
  r->x0[to] = r->x0[k], r->y0[to] = r->y0[k];
  r->x1[to] = r->x1[k], r->y1[to] = r->y1[k];
  r->id[to] = r->id[k];
  b->place[to] = place;
}

/* Looks at the triangles from `from` on, one after another. Those to be tiled
 * are moved behind the n_fast ones that there are. */
static void look_from(const struct hsr_tiler *t, struct hsr_batch *b,
                      int from) {
  gather_from(t, b, from);
  b->general |= decide(t, from, b->n, &b->corners, b->one_sided, b->fate);
  for (int k = from; k < b->n; k++)
    if (b->fate[k] == HSR_TILE)
      move(b, k, k, b->n_fast++);
}

static void look_portable(const struct hsr_tiler *t, struct hsr_batch *b) {
  look_from(t, b, 0);
}

/* Sets up n triangles. good[k]: floats hold the depth of the k-th within
 * HSR_RHO. */
HSR_VECTOR static void set_up(const struct hsr_tiler *t,
                              const struct hsr_corners *restrict r, int n,
                              struct hsr_triangles *restrict out,
                              int *restrict good) {
  const int fx = t->first_x, fy = t->first_y;
  const float unit = 1.0f / GRID;
  for (int k = 0; k < n; k++) {
    int ax = r->ax[k], ay = r->ay[k], bx = r->bx[k], by = r->by[k],
        cx = r->cx[k], cy = r->cy[k];
    int sx = r->x0[k] * GRID + fx, sy = r->y0[k] * GRID + fy;
    float abx = (float)(bx - ax) * unit, aby = (float)(by - ay) * unit;
    float bcx = (float)(cx - bx) * unit, bcy = (float)(cy - by) * unit;
    float cax = (float)(ax - cx) * unit, cay = (float)(ay - cy) * unit;
    float hax = (float)(sx - ax) * unit, hay = (float)(sy - ay) * unit;
    float hbx = (float)(sx - bx) * unit, hby = (float)(sy - by) * unit;
    float hcx = (float)(sx - cx) * unit, hcy = (float)(sy - cy) * unit;
    out->e0[k] = abx * hay - aby * hax;
    out->e1[k] = bcx * hby - bcy * hbx;
    out->e2[k] = cax * hcy - cay * hcx;
    out->ex0[k] = -aby;
    out->ex1[k] = -bcy;
    out->ex2[k] = -cay;
    out->ey0[k] = abx;
    out->ey1[k] = bcx;
    out->ey2[k] = cax;

    /* How large the box of samples and corners is at most, in pixels. */
    float w1 = fabsf(abx), w2 = fabsf(cax), h1 = fabsf(aby), h2 = fabsf(cay);
    float width = w1 + w2, height = h1 + h2;
    out->bound[k] =
        5 * SNAP * (width + height + 4) + 0x1p-20f * (width + 2) * (height + 2);

    float product1 = -abx * cay, product2 = -cax * aby;
    float inverse = 1 / (product1 - product2);
    float q = r->qa[k], D1 = r->qb[k] - q, D2 = r->qc[k] - q;
    float qx = (D1 * cay + D2 * aby) * -inverse;
    float qy = (D1 * cax + D2 * abx) * inverse;
    out->qx[k] = qx;
    out->qy[k] = qy;
    out->q[k] = q + (qx * hax + qy * hay);
    float M = (fabsf(D1) * (h2 * width + w2 * height) +
               fabsf(D2) * (h1 * width + w1 * height)) *
              inverse;
    float condition = (fabsf(product1) + fabsf(product2)) * inverse;
    float least = r->qb[k] < q ? r->qb[k] : q;
    least = r->qc[k] < least ? r->qc[k] : least;
    good[k] = (M * (condition + 2) <= 16 * least) & (M <= 4 * least) &
              (fabsf(D1) <= least) & (fabsf(D2) <= least) &
              (fabsf(qx) + fabsf(qy) <= 0.3f * least);
  }
}

void hsr_tiler_look(const struct hsr_tiler *t, struct hsr_batch *b,
                    uint32_t first, int n) {
  b->first = first;
  b->n = n;
  b->n_fast = b->general = 0;
  t->twin->look(t, b);
  for (int k = 0; k < b->n_fast; k++)
    b->corners.id[k] = hsr_tiler_id(t, hsr_tiler_face(t, b, b->place[k]));
}

void hsr_tiler_drop(struct hsr_batch *b, const int *drop) {
  int kept = 0;
  for (int k = 0; k < b->n_fast; k++) {
    if (drop[k])
      b->fate[b->place[k]] = HSR_DROP;
    else if (kept++ < k)
      move(b, k, b->place[k], kept - 1);
  }
  b->n_fast = kept;
}

void hsr_tiler_set_up(const struct hsr_tiler *t, struct hsr_batch *b) {
  set_up(t, &b->corners, b->n_fast, &b->triangles, b->good);
  for (int k = 0; k < b->n_fast; k++) {
    if (b->good[k])
      HSR_STEP(t->tally, HSR_FAST, HSR_FACE(b->corners.id[k]), HSR_NOTHING,
               hsr_window_make(b->corners.x0[k], b->corners.y0[k],
                               b->corners.x1[k], b->corners.y1[k]),
               0);
    else
      b->general = b->fate[b->place[k]] = HSR_GENERALLY;
  }
}

struct hsr_triangle hsr_tiler_take(const struct hsr_tiler *t,
                                   const struct hsr_batch *b, int k) {
  const struct hsr_triangles *s = &b->triangles;
  const struct hsr_corners *r = &b->corners;
  return (struct hsr_triangle){
      s->e0[k],    s->e1[k],  s->e2[k],
      s->ex0[k],   s->ex1[k], s->ex2[k],
      s->ey0[k],   s->ey1[k], s->ey2[k],
      s->bound[k], s->q[k],   s->qx[k],
      s->qy[k],    r->x0[k],  r->y0[k],
      r->x1[k],    r->y1[k],  hsr_tiler_face(t, b, b->place[k]),
      r->id[k],    false};
}

/* --- The general way ------------------------------------------------------ */

/* The samples that a box and the part being tiled have in common. */
static inline struct hsr_window clip(const struct hsr_tiler *t, int x0, int y0,
                                     int x1, int y1) {
  const struct hsr_window *p = &t->part;
  return (struct hsr_window){x0 > p->x0 ? x0 : p->x0, y0 > p->y0 ? y0 : p->y0,
                             x1 < p->x1 ? x1 : p->x1, y1 < p->y1 ? y1 : p->y1};
}

static void tile_span_from(struct hsr_tiler *t, const struct span *s, int i) {
  for (; i < s->x1; i++) {
    float q = (float)(s->a * hsr_sample_x(t->view, i) + s->by + s->c);
    settle(t, s->f, s->id, q > s->least ? q : NAN, true, i, s->j);
  }
}

static void tile_span_portable(struct hsr_tiler *t, const struct span *s) {
  tile_span_from(t, s, s->x0);
}

/* A face's rows, but for where they are. A depth is recorded where it is within
 * HSR_RHO / 2 of the truth. */
static struct span span_of(const struct hsr_tiler *t, uint32_t f) {
  const struct hsr_depth_plane *p = &t->screen.plane[f];
  double error = p->error + 0x1p-51 * (fabs(p->c) + t->far);
  return (struct span){.f = f,
                       .id = hsr_tiler_id(t, f),
                       .a = p->a,
                       .b = p->b,
                       .c = p->c + t->far,
                       .least = (float)error / (0.5f * HSR_RHO)};
}

static void tile_span(struct hsr_tiler *t, struct span *span, int j, int x0,
                      int x1) {
  span->by = span->b * hsr_sample_y(t->view, j);
  span->j = j;
  span->x0 = x0 < t->part.x0 ? t->part.x0 : x0;
  span->x1 = x1 > t->part.x1 ? t->part.x1 : x1;
  if (span->x0 < span->x1)
    t->twin->tile_span(t, span);
}

/* The rows from j up to `end`, which both edges cross. */
static void tile_between(struct hsr_tiler *t, struct span *span,
                         const struct hsr_edge *e, const struct hsr_edge *g,
                         int j, int end) {
  j = j < t->part.y0 ? t->part.y0 : j;
  end = end > t->part.y1 ? t->part.y1 : end;
  for (; j < end; j++) {
    int x0 = hsr_edge_column(&t->screen, e, j, t->tally);
    int x1 = hsr_edge_column(&t->screen, g, j, t->tally);
    tile_span(t, span, j, x0 < x1 ? x0 : x1, x0 < x1 ? x1 : x0);
  }
}

/* A triangle that is whole: from its upper corner to the middle one, and from
 * there to the lower one. */
static void tile_whole(struct hsr_tiler *t, uint32_t f) {
  const struct hsr_world *world = t->screen.world;
  uint32_t v[3];
  int row[3];
  memcpy(v, world->mesh.vertex + world->mesh.start[f], sizeof v);
  for (int k = 0; k < 3; k++)
    row[k] = hsr_vertex_row(&t->screen, v[k], t->tally);
  for (int k = 0; k < 3; k++) { /* bubbles: 0 1, 1 2, 0 1 */
    int a = k % 2, b = a + 1, r = row[a];
    uint32_t w = v[a];
    if (row[a] <= row[b])
      continue;
    row[a] = row[b], v[a] = v[b];
    row[b] = r, v[b] = w;
  }
  struct hsr_edge all, upper, lower;
  hsr_edge_init(&all, &t->screen, v[0], v[2]);
  hsr_edge_init(&upper, &t->screen, v[0], v[1]);
  hsr_edge_init(&lower, &t->screen, v[1], v[2]);
  struct span span = span_of(t, f);
  tile_between(t, &span, &all, &upper, row[0], row[1]);
  tile_between(t, &span, &all, &lower, row[1], row[2]);
}

/* The samples from lo - 1 to hi + 1 grid units, of which the first is at
 * `first`, within [*from, *to). */
static void samples_within(int lo, int hi, int first, int *from, int *to) {
  int from_lo = (lo - 1 - first + GRID - 1) >> GRID_BITS;
  int to_hi = ((hi + 1 - first) >> GRID_BITS) + 1;
  *from = from_lo > *from ? from_lo : *from;
  *to = to_hi < *to ? to_hi : *to;
}

bool hsr_tiler_bound(const struct hsr_tiler *t, uint32_t f,
                     struct hsr_bounds *box, float *nearest, float *farthest) {
  const struct hsr_mesh *mesh = &t->screen.world->mesh;
  int x0 = INT_MAX, y0 = INT_MAX, x1 = INT_MIN, y1 = INT_MIN;
  *nearest = 0;
  *farthest = HUGE_VALF;
  for (uint32_t c = mesh->start[f]; c < mesh->start[f + 1]; c++) {
    const struct hsr_corner *v = &t->corner[mesh->vertex[c]];
    if (v->x == UNSAFE || !t->on_grid)
      return false;
    x0 = v->x < x0 ? v->x : x0;
    x1 = v->x > x1 ? v->x : x1;
    y0 = v->y < y0 ? v->y : y0;
    y1 = v->y > y1 ? v->y : y1;
    *nearest = v->q > *nearest ? v->q : *nearest;
    *farthest = v->q < *farthest ? v->q : *farthest;
  }
  *box = (struct hsr_bounds){t->window.x0, t->window.y0, t->window.x1,
                             t->window.y1};
  samples_within(x0, x1, t->first_x, &box->x0, &box->x1);
  samples_within(y0, y1, t->first_y, &box->y0, &box->y1);
  return true;
}

bool hsr_tiler_place(struct hsr_tiler *t, uint32_t f) {
  need_corners(t, f);
  if (t->few)
    hsr_world_find_plane(t->few, f, &t->tally->out_of_memory);
  hsr_screen_plane(&t->screen, f);
  if (!hsr_screen_place(&t->screen, f, t->tally))
    return false;
  HSR_STEP(t->tally, HSR_GENERAL, HSR_FACE(hsr_tiler_id(t, f)), HSR_NOTHING,
           hsr_window_make(t->screen.bounds[f].x0, t->screen.bounds[f].y0,
                           t->screen.bounds[f].x1, t->screen.bounds[f].y1),
           0);
  return true;
}

void hsr_tiler_tile_generally(struct hsr_tiler *t, uint32_t f) {
  if (t->screen.whole[f] && hsr_face_size(t->screen.world, f) == 3) {
    tile_whole(t, f);
    return;
  }
  const struct hsr_bounds *bounds = &t->screen.bounds[f];
  struct hsr_window box =
      clip(t, bounds->x0, bounds->y0, bounds->x1, bounds->y1);
  struct hsr_face_rows rows;
  hsr_face_rows_begin(&rows, &t->screen, f, t->tally);
  struct span span = span_of(t, f);
  for (int j = box.y0; j < box.y1; j++) {
    int n = hsr_face_rows_spans(&rows, j, t->columns, t->tally);
    for (int k = 0; k < n; k += 2)
      tile_span(t, &span, j, t->columns[k], t->columns[k + 1]);
  }
}

/* --- Tiling triangles ----------------------------------------------------- */

/* A triangle at a sample: its depth; does it perhaps cover the sample, and does
 * it certainly? */
struct at {
  float q;
  bool maybe, sure;
};

static inline struct at look_at(const struct hsr_triangle *tri, int i, int j) {
  float right = (float)(i - tri->x0), down = (float)(j - tri->y0);
  float d0 = tri->e0 + tri->ey0 * down + tri->ex0 * right,
        d1 = tri->e1 + tri->ey1 * down + tri->ex1 * right,
        d2 = tri->e2 + tri->ey2 * down + tri->ex2 * right;
  float d = d0 < d1 ? d0 : d1;
  d = d < d2 ? d : d2;
  return (struct at){tri->q + tri->qy * down + tri->qx * right,
                     d >= -tri->bound, d > tri->bound};
}

bool hsr_tiler_shows(struct hsr_tiler *t, const struct hsr_triangle *tri, int i,
                     int j) {
  struct at at = look_at(tri, i, j);
  if (!at.maybe || !(at.sure || covers(t, tri->face, tri->id, i, j)))
    return false;
  size_t x = (size_t)(i - t->part.x0), y = (size_t)(j - t->part.y0);
  float z = t->z[y * t->z_stride + x];
  bool clear = at.q > z * HSR_CLEAR || at.q * HSR_CLEAR < z;
  return clear ? at.q > z
               : is_nearer(t, tri->id, t->ids[y * t->ids_stride + x], i, j);
}

void hsr_tiler_tile_before(struct hsr_tiler *t,
                           const struct hsr_triangle *tri) {
  struct hsr_window box = clip(t, tri->x0, tri->y0, tri->x1, tri->y1);
  for (int j = box.y0; j < box.y1; j++)
    for (int i = box.x0; i < box.x1; i++) {
      struct at at = look_at(tri, i, j);
      if (!at.maybe || !(at.sure || covers(t, tri->face, tri->id, i, j)))
        continue;
      size_t x = (size_t)(i - t->part.x0), y = (size_t)(j - t->part.y0);
      uint32_t *held = &t->ids[y * t->ids_stride + x];
      HSR_TOUCH(t->tally, i, j);
      tell_write(t, tri->id, *held, i, j);
      t->z[y * t->z_stride + x] = at.q;
      *held = tri->id;
    }
}

static void tile_portable(struct hsr_tiler *t, const struct hsr_triangle *tri) {
  struct hsr_window box = clip(t, tri->x0, tri->y0, tri->x1, tri->y1);
  for (int j = box.y0; j < box.y1; j++) {
    for (int i = box.x0; i < box.x1; i++) {
      struct at at = look_at(tri, i, j);
      if (at.maybe)
        settle(t, tri->face, tri->id, at.q, at.sure, i, j);
    }
  }
}

static void tile_batch_portable(struct hsr_tiler *t,
                                const struct hsr_batch *b) {
  for (int k = 0; k < b->n_fast; k++) {
    if (!b->good[k])
      continue;
    struct hsr_triangle triangle = hsr_tiler_take(t, b, k);
    tile_portable(t, &triangle);
  }
}

/* From the part's ids to the picture's. */
static void write_back_portable(const struct hsr_tiler *t,
                                const struct hsr_job *job) {
  const struct hsr_window *p = &t->part;
  for (int j = p->y0; j < p->y1; j++)
    memcpy(hsr_job_row(job, j) + (size_t)p->x0,
           t->ids + (size_t)(j - p->y0) * t->ids_stride,
           (size_t)(p->x1 - p->x0) * sizeof *t->ids);
}

static const struct hsr_twin portable = {look_portable, tile_span_portable,
                                         tile_portable, tile_batch_portable,
                                         write_back_portable};

#ifdef HAVE_TWINS

/* Samples that small triangles cover for certain, their depths to be compared
 * with the recorded ones. */
struct queue {
  int n;
  uint32_t at[QUEUE + LANES]; /* column + 2^16 row, from the window's first */
  float q[QUEUE + LANES];
  uint32_t id[QUEUE + LANES];
};

static void compare_queue(struct hsr_tiler *t, struct queue *queue) {
  const size_t ids_stride = t->ids_stride, z_stride = t->z_stride;
  const struct hsr_window *w = &t->window; /* it is the only part */
  uint32_t *ids = t->ids;
  float *z = t->z;
  for (int k = 0; k < queue->n; k++) {
    size_t x = queue->at[k] & 0xffff, y = queue->at[k] >> 16;
    size_t place = y * z_stride + x;
    float q = queue->q[k], held = z[place];
    if (__builtin_expect(q > held * HSR_CLEAR, 1)) {
      z[place] = q;
      ids[y * ids_stride + x] = queue->id[k];
    } else if (__builtin_expect(!(q * HSR_CLEAR < held), 0)) {
      settle(t, HSR_NO_ID, queue->id[k], q, true, w->x0 + (int)x,
             w->y0 + (int)y);
    }
  }
  queue->n = 0;
}

/* The triangles from the k-th of n on, fewer than there are lanes. The first
 * one stands in the lanes that are left. */
struct last {
  uint32_t vertex[3 * LANES];
  bool one_sided[LANES];
};

static struct last last_ones(const uint32_t *v, const bool *one_sided, int k,
                             int n) {
  struct last last;
  for (int l = 0; l < LANES; l++) {
    int from = k + l < n ? k + l : k;
    memcpy(last.vertex + 3 * l, v + 3 * from, 3 * sizeof *v);
    last.one_sided[l] = one_sided[from];
  }
  return last;
}

#include "algorithms/engines/tiler/tiler_avx2.h"
#include "algorithms/engines/tiler/tiler_avx512.h"
#endif

static const struct hsr_twin *choose_twin(void) {
#ifdef HAVE_TWINS
  if (__builtin_cpu_supports("avx512f"))
    return &twin_avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("bmi2"))
    return &twin_avx2;
#endif
  return &portable;
}

/* --- For whoever tiles ---------------------------------------------------- */

HSR_VECTOR static void snap(size_t n, const double *restrict sx,
                            const double *restrict sy, const double *restrict q,
                            struct hsr_corner *restrict corner) {
  for (size_t v = 0; v < n; v++) {
    int safe = (fabs(sx[v]) < FARTHEST) & (fabs(sy[v]) < FARTHEST);
    corner[v].x = safe ? (int)floor(sx[v] * GRID + 0.5) : UNSAFE;
    corner[v].y = safe ? (int)floor(sy[v] * GRID + 0.5) : UNSAFE;
    corner[v].q = (float)q[v];
    corner[v].unused = 0;
  }
}

/* In parallel: the depths of n vertices, once they are snapped. */
HSR_VECTOR static void snap_depths(size_t n, const double *restrict x,
                                   const double *restrict y,
                                   const double *restrict z, const double *E,
                                   const double *depth, double far,
                                   struct hsr_corner *restrict corner) {
  const double e0 = E[0], e1 = E[1], e2 = E[2];
  const double d0 = depth[0], d1 = depth[1], d2 = depth[2];
  for (size_t v = 0; v < n; v++) {
    double q = far - (d0 * (x[v] - e0) + d1 * (y[v] - e1) + d2 * (z[v] - e2));
    corner[v].x = q > 0 ? corner[v].x : UNSAFE;
    corner[v].q = (float)q;
  }
}

HSR_VECTOR static int
snap_far_parallel(size_t n, const double *restrict x, const double *restrict y,
                  const double *restrict z, const struct hsr_way_to_screen *way,
                  double far, struct hsr_corner *restrict corner) {
  const double(*const rows)[3] = way->rows;
  const double a0 = rows[0][0], a1 = rows[0][1], a2 = rows[0][2],
               a3 = way->origin[0];
  const double b0 = rows[1][0], b1 = rows[1][1], b2 = rows[1][2],
               b3 = way->origin[1];
  const double c0 = rows[2][0], c1 = rows[2][1], c2 = rows[2][2],
               c3 = way->origin[2];
  int all = way->sure < 1;
  for (size_t v = 0; v < n; v++) {
    double q = far - (c0 * x[v] + c1 * y[v] + c2 * z[v] + c3);
    double sx = a0 * x[v] + a1 * y[v] + a2 * z[v] + a3;
    double sy = b0 * x[v] + b1 * y[v] + b2 * z[v] + b3;
    int safe = (q > 0) & (fabs(sx) < FARTHEST) & (fabs(sy) < FARTHEST);
    all &= safe;
    corner[v].x = safe ? (int)floor(sx * GRID + 0.5) : UNSAFE;
    corner[v].y = safe ? (int)floor(sy * GRID + 0.5) : UNSAFE;
    corner[v].q = (float)q;
    corner[v].unused = 0;
  }
  return all;
}

HSR_VECTOR static int snap_far(size_t n, const double *restrict x,
                               const double *restrict y,
                               const double *restrict z,
                               const struct hsr_way_to_screen *way,
                               struct hsr_corner *restrict corner) {
  const double(*const rows)[3] = way->rows;
  const double *const origin = way->origin, sure = way->sure;
  const double a0 = rows[0][0], a1 = rows[0][1], a2 = rows[0][2],
               a3 = origin[0];
  const double b0 = rows[1][0], b1 = rows[1][1], b2 = rows[1][2],
               b3 = origin[1];
  const double c0 = rows[2][0], c1 = rows[2][1], c2 = rows[2][2],
               c3 = origin[2];
  int all = 1;
  for (size_t v = 0; v < n; v++) {
    double w = c0 * x[v] + c1 * y[v] + c2 * z[v] + c3, q = 1 / w;
    double sx = (a0 * x[v] + a1 * y[v] + a2 * z[v] + a3) * q;
    double sy = (b0 * x[v] + b1 * y[v] + b2 * z[v] + b3) * q;
    int safe = (w > sure) & (fabs(sx) < FARTHEST) & (fabs(sy) < FARTHEST);
    all &= safe;
    corner[v].x = safe ? (int)floor(sx * GRID + 0.5) : UNSAFE;
    corner[v].y = safe ? (int)floor(sy * GRID + 0.5) : UNSAFE;
    corner[v].q = (float)q;
    corner[v].unused = 0;
  }
  return all;
}

/* Do the samples lie on the grid? */
static bool find_grid(struct hsr_tiler *t) {
  double first_x = hsr_sample_x(t->view, 0) * GRID;
  double first_y = hsr_sample_y(t->view, 0) * GRID;
  t->first_x = (int)first_x;
  t->first_y = (int)first_y;
  return first_x == t->first_x && first_y == t->first_y;
}

void hsr_tiler_begin(struct hsr_tiler *t, const struct hsr_job *job) {
  *t = (struct hsr_tiler){.view = job->view,
                          .tally = job->tally,
                          .window = job->view->window,
                          .twin = choose_twin()};
  t->on_grid = find_grid(t);
  double near = job->view->near;
  t->nearest = near > 0 ? (float)(0.99 / near) : INFINITY;
}

void hsr_tiler_set_range(struct hsr_tiler *t, double nearest, double farthest,
                         double size) {
  const struct hsr_view *view = t->view;
  t->far = farthest + fmax(farthest - nearest, 0x1p-20 * size);
  t->nearest = (float)((t->far - view->near) * (1 - 0x1p-16));
}

void hsr_tiler_snap(struct hsr_tiler *t) {
  const struct hsr_mesh *mesh = &t->screen.world->mesh;
  size_t n = mesh->n_vertices;
  snap(n, t->screen.sx, t->screen.sy, t->screen.q, t->corner);
  if (t->view->parallel)
    snap_depths(n, mesh->x, mesh->y, mesh->z, t->view->E, t->view->depth,
                t->far, t->corner);
}

void hsr_tiler_snap_points(struct hsr_tiler *t, size_t first, size_t n,
                           const double *x, const double *y, const double *z) {
  double sx[SNAPPED], sy[SNAPPED], q[SNAPPED];
  for (size_t v = 0; v < n; v += SNAPPED) {
    size_t some = n - v < SNAPPED ? n - v : SNAPPED;
    struct hsr_corner *corner = t->corner + first + v;
    hsr_screen_points(&t->screen, some, x + v, y + v, z + v, sx, sy, q);
    snap(some, sx, sy, q, corner);
    if (t->view->parallel)
      snap_depths(some, x + v, y + v, z + v, t->view->E, t->view->depth, t->far,
                  corner);
  }
}

bool hsr_tiler_snap_far(struct hsr_tiler *t, size_t n, const double *x,
                        const double *y, const double *z,
                        const struct hsr_way_to_screen *way) {
  return t->view->parallel
             ? snap_far_parallel(n, x, y, z, way, t->far, t->corner)
             : snap_far(n, x, y, z, way, t->corner);
}

void hsr_tiler_begin_part(struct hsr_tiler *t, struct hsr_window part) {
  size_t width = (size_t)(part.x1 - part.x0);
  t->part = part;
  for (int j = 0; j < part.y1 - part.y0; j++) {
    memset(t->z + (size_t)j * t->z_stride, 0, width * sizeof *t->z);
    memset(t->ids + (size_t)j * t->ids_stride, 0xff, width * sizeof *t->ids);
  }
}

void hsr_tiler_tile_batch(struct hsr_tiler *t, const struct hsr_batch *b) {
  t->twin->tile_batch(t, b);
}

void hsr_tiler_tile(struct hsr_tiler *t, const struct hsr_triangle *triangle) {
  t->twin->tile(t, triangle);
}

void hsr_tiler_write_back(const struct hsr_tiler *t,
                          const struct hsr_job *job) {
  t->twin->write_back(t, job);
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"depth tests", "depths compared with the recorded ones", HSR_COMPARE,
     HSR_OF_FACE, HSR_OF_FACE, "farther|nearer", .key = "depth-test"},
    {"writes", "samples written, overwrites counted each time", HSR_ACCEPT,
     HSR_OF_FACE, HSR_OF_FACE, .key = "write"},
    {"overwrites", "writes where there was a face already", HSR_RETIRE,
     HSR_OF_FACE, HSR_OF_FACE},
    {"fast triangles", "tiled in floats", HSR_ACTIVATE, HSR_OF_FACE},
    {"general faces", "tiled row by row in doubles", HSR_ACTIVATE, HSR_OF_FACE},
    {"unsure covers", "samples closer to an edge than floats can tell",
     HSR_SAMPLE, HSR_OF_FACE, HSR_OF_WINDOW, "not covered|covered"},
    {"unsure depths", "depths closer than floats can tell", HSR_COMPARE,
     HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    {NULL}};

static const struct hsr_line lines[] = {
    {"tile a small triangle in floats", HSR_RAISES(HSR_FAST)},
    {"or any other face row by row in doubles", HSR_RAISES(HSR_GENERAL)},
    {"  for each sample that it covers: exactly, where floats cannot tell",
     HSR_RAISES(HSR_UNSURE_COVER)},
    {"    is it nearer than the recorded depth?", HSR_RAISES(HSR_DEPTH_TESTS)},
    {"      exactly, where floats cannot tell", HSR_RAISES(HSR_UNSURE_DEPTH)},
    {"      if so, record its depth and its id", HSR_RAISES(HSR_WRITES)},
    {"        instead of those of another face", HSR_RAISES(HSR_OVERWRITES)},
    {NULL}};

const struct hsr_part hsr_tiler_part = {
    HSR_PART_TILER, counters, NULL, NULL, {lines}};
