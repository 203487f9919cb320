/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Brute force with a large memory: the z-buffer.
 *
 * Source      Sutherland, Sproull and Schumacker 1974, appendix B, "Brute-Force
 *             Image-Space"; E. Catmull, PhD thesis, University of Utah, 1974.
 * Notation    raster element -> sample (i, j); recorded depth -> z, as q = 1/t,
 *             greater is nearer, 0 for the background
 * Invariant   at every sample, ids holds the nearest of the faces tiled so far,
 *             and z is NaN (unknown) or within RHO z of that face's q there
 * Ties        wherever the depths are closer than their bounds, and wherever a
 *             sample is closer to an edge than its bound: by hsr_nearer and
 *             hsr_covers
 * Departures  none: "if the new polygon is closer, its data replaces that
 *             already in the memory"
 * Cost        10 H_f^2 F_r predicted
 *
 * Small triangles before the eye take the fast way, sixteen at a time: their
 * vertices are snapped to a grid of 2^-15 pixel, and coverage and depth are
 * computed in floats. All other faces take the general way, row by row.
 *
 * Snapping moves a coordinate by at most s = 2^-16 + 2^-26 (common/screen.h).
 * With W and H the width and height in pixels of the box of the samples in
 * question, and everything of the triangle within it but for 2 pixels, the
 * sides d = b - a of the triangle and the offsets h of a sample from a vertex
 * are at most W + 2 and H + 2.
 *
 * Coverage. e = dx hy - dy hx changes by at most 2.1 s (|dx| + |dy| + |hx| +
 * |hy|) <= 4.2 s (W + H + 4). Differences of snapped coordinates are exact in
 * floats, being below 2^24 grid units. e is computed as (e_00 + ey jj) + ex ii;
 * its products and sums, seven roundings of terms no larger than 2 (W + 2)(H +
 * 2), err by at most 14 * 2^-24 (W + 2)(H + 2) < 2^-20 (W + 2)(H + 2). The
 * bound is 5 s (W + H + 4) + 2^-20 (W + 2)(H + 2).
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
 * of q, and RHO = 2^-16 holds it. A triangle that does not fulfil all this
 * takes the general way. */
#include "algorithms/algorithm.h"
#include "common/screen.h"
#include "common/vector.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#if defined __x86_64__ && HSR_HAVE_TARGET_CLONES
#include <immintrin.h>
#define HAVE_AVX512_TWIN 1
#endif

/* Only to measure what exactness costs: decide by the floats alone. */
#ifndef HSR_ZBUFFER_INEXACT
#define HSR_ZBUFFER_INEXACT 0
#endif

enum { DEPTH_TESTS, WRITES, FAST, GENERAL, UNSURE_COVER, UNSURE_DEPTH };

static const struct hsr_counter counters[] = {
    [DEPTH_TESTS] = {"depth tests", "depths compared with the recorded ones"},
    [WRITES] = {"writes", "samples written, overwrites counted each time"},
    [FAST] = {"fast triangles", "tiled in floats"},
    [GENERAL] = {"general faces", "tiled row by row in doubles"},
    [UNSURE_COVER] = {"unsure covers", "samples closer to an edge than floats "
                                       "can tell"},
    [UNSURE_DEPTH] = {"unsure depths", "depths closer than floats can tell"},
    {NULL, NULL}};

static double predict_tiling(const struct hsr_table1 *t) {
  return 10 * t->H_f * t->H_f * t->F_r;
}

static const struct hsr_step steps[] = {
    {"depth comparison", DEPTH_TESTS, 10, "10 H_f^2 F_r", predict_tiling},
    {NULL, 0, 0, NULL, NULL}};

enum {
  GRID_BITS = 15,
  GRID = 1 << GRID_BITS, /* grid units a pixel */
  UNSAFE = INT_MIN,      /* snapped coordinate of a vertex that is not safe */
  LARGEST_BOX = 500,     /* pixels; keeps differences below 2^24 grid units */
  AHEAD = 6,             /* triangles from the fetching to the tiling */
  BATCH = 128            /* faces looked at together */
};
/* Pixels; sums and differences of snapped coordinates fit in an int. */
static const double FARTHEST = 32767.9;
static const float RHO = 0x1p-16f;
/* q > CLEAR z, with both within RHO of the truth, is certain. */
static const float CLEAR = 1 + 2.5f * 0x1p-16f;
static const float SNAP = 0x1.01p-16f; /* s */

/* A vertex, snapped: grid units, or UNSAFE; and its depth. */
struct corner {
  int x, y;
  float q;
  int unused; /* to 16 bytes */
};

/* Triangles by their corners a, b, c, and the samples in their boxes. */
struct corners {
  int ax[BATCH], ay[BATCH], bx[BATCH], by[BATCH], cx[BATCH], cy[BATCH];
  float qa[BATCH], qb[BATCH], qc[BATCH];
  int x0[BATCH], y0[BATCH], x1[BATCH], y1[BATCH];
};

/* What becomes of a triangle. */
enum fate { DROP = 0, TILE = 1, GENERALLY = 2 };

/* Triangles ready to be tiled: edge functions and depth at the first sample of
 * the box, and their steps to the right and down. */
struct triangles {
  float e0[BATCH], e1[BATCH], e2[BATCH], ex0[BATCH], ex1[BATCH], ex2[BATCH],
      ey0[BATCH], ey1[BATCH], ey2[BATCH], bound[BATCH];
  float q[BATCH], qx[BATCH], qy[BATCH];
};

/* One of them. */
struct triangle {
  float e0, e1, e2, ex0, ex1, ex2, ey0, ey1, ey2, bound;
  float q, qx, qy;
  int x0, y0, x1, y1;
  uint32_t face;
};

struct tiling {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  struct hsr_screen screen;
  struct corner *corner; /* a vertex */
  float *z; /* z of sample (i, j) at z[(j - y0) * z_stride + i - x0] */
  size_t z_stride;
  struct hsr_window window;
  int first_x, first_y; /* of sample (0, 0), grid units */
  bool on_grid;         /* the samples lie on the grid */
  int *columns;         /* room for the spans of the largest face */
};

typedef void tile_function(struct tiling *, const struct triangle *);

/* --- What floats cannot tell
 * -------------------------------------------------- */

static bool covers(struct tiling *t, uint32_t f, int i, int j) {
  HSR_COUNT(t->tally, UNSURE_COVER, 1);
  t->screen.whole[f] = true;
  return hsr_covers(&t->screen, f, i, j, t->tally);
}

/* Is f nearer than what the sample holds? */
static bool is_nearer(struct tiling *t, uint32_t f, uint32_t held, int i,
                      int j) {
  if (held == HSR_BACKGROUND)
    return true;
  HSR_COUNT(t->tally, UNSURE_DEPTH, 1);
  hsr_screen_plane(&t->screen, f);
  hsr_screen_plane(&t->screen, held);
  return hsr_nearer(&t->screen, f, held, i, j, t->tally);
}

/* Decides sample (i, j) for a face of depth q there; `sure` if it covers it for
 * certain. */
static inline void settle(struct tiling *t, uint32_t f, float q, bool sure,
                          int i, int j) {
  uint32_t *id = &t->job->ids[(size_t)j * t->job->ids_stride + (size_t)i];
  float *z = &t->z[(size_t)(j - t->window.y0) * t->z_stride +
                   (size_t)(i - t->window.x0)];
#if HSR_ZBUFFER_INEXACT
  (void)covers;
  (void)is_nearer;
  if (sure && q > *z) {
    *z = q;
    *id = f;
  }
#else
  if (!sure && !covers(t, f, i, j))
    return;
  HSR_TOUCH(t->tally, i, j);
  HSR_STEP(t->tally, DEPTH_TESTS, HSR_COMPARE, f, *id, i, j, i + 1, j + 1);
  bool clear = q > *z * CLEAR || q * CLEAR < *z;
  HSR_COUNT_DEPTHS(t->tally, clear && *id != HSR_BACKGROUND);
  if (clear ? q < *z : !is_nearer(t, f, *id, i, j))
    return;
  HSR_STEP(t->tally, WRITES, HSR_ACCEPT, f, *id, i, j, i + 1, j + 1);
  *z = q;
  *id = f;
#endif
}

/* --- Tiling a triangle
 * --------------------------------------------------------- */

static void tile_portable(struct tiling *t, const struct triangle *tri) {
  for (int j = tri->y0; j < tri->y1; j++) {
    float down = (float)(j - tri->y0);
    float e0 = tri->e0 + tri->ey0 * down, e1 = tri->e1 + tri->ey1 * down,
          e2 = tri->e2 + tri->ey2 * down, q = tri->q + tri->qy * down;
    for (int i = tri->x0; i < tri->x1; i++) {
      float right = (float)(i - tri->x0);
      float d0 = e0 + tri->ex0 * right, d1 = e1 + tri->ex1 * right,
            d2 = e2 + tri->ex2 * right;
      float d = d0 < d1 ? d0 : d1;
      d = d < d2 ? d : d2;
      if (d >= -tri->bound)
        settle(t, tri->face, q + tri->qx * right, d > tri->bound, i, j);
    }
  }
}

#ifdef HAVE_AVX512_TWIN

/* Counts what sixteen lanes decided, before they write. */
static inline void count_row(struct tiling *t, uint32_t f, const uint32_t *ids,
                             int x, int j, unsigned nearer, unsigned farther) {
#if HSR_COUNTING
  for (unsigned lanes = nearer | farther; lanes; lanes &= lanes - 1) {
    int k = __builtin_ctz(lanes), i = x + k;
    HSR_TOUCH(t->tally, i, j);
    HSR_STEP(t->tally, DEPTH_TESTS, HSR_COMPARE, f, ids[k], i, j, i + 1, j + 1);
    HSR_COUNT_DEPTHS(t->tally, ids[k] != HSR_BACKGROUND);
    if (nearer >> k & 1)
      HSR_STEP(t->tally, WRITES, HSR_ACCEPT, f, ids[k], i, j, i + 1, j + 1);
  }
#else
  (void)t, (void)f, (void)ids, (void)x, (void)j, (void)nearer, (void)farther;
#endif
}

/* A linear function: its value at the box's first sample, and its steps. */
__attribute__((target("avx512f"))) static inline __m512
at_avx512(float first, float x, __m512 right, float y, __m512 down) {
  return _mm512_add_ps(_mm512_add_ps(_mm512_set1_ps(first),
                                     _mm512_mul_ps(_mm512_set1_ps(x), right)),
                       _mm512_mul_ps(_mm512_set1_ps(y), down));
}

/* Four by four samples at once; most triangles have no more in their box. */
__attribute__((target("avx512f"))) static void
tile_block_avx512(struct tiling *t, const struct triangle *tri) {
  const __m512 right =
      _mm512_set_ps(3, 2, 1, 0, 3, 2, 1, 0, 3, 2, 1, 0, 3, 2, 1, 0);
  const __m512 down =
      _mm512_set_ps(3, 3, 3, 3, 2, 2, 2, 2, 1, 1, 1, 1, 0, 0, 0, 0);
  __m512 d0 = at_avx512(tri->e0, tri->ex0, right, tri->ey0, down);
  __m512 d1 = at_avx512(tri->e1, tri->ex1, right, tri->ey1, down);
  __m512 d2 = at_avx512(tri->e2, tri->ex2, right, tri->ey2, down);
  __m512 d = _mm512_min_ps(_mm512_min_ps(d0, d1), d2);
  int width = tri->x1 - tri->x0, height = tri->y1 - tri->y0;
  __mmask16 in_box =
      (__mmask16)(0x1111 * ((1 << width) - 1) & ((1 << 4 * height) - 1));
  unsigned maybe = _mm512_mask_cmp_ps_mask(
      in_box, d, _mm512_set1_ps(-tri->bound), _CMP_GE_OQ);
  if (!maybe)
    return;
  unsigned sure = _mm512_cmp_ps_mask(d, _mm512_set1_ps(tri->bound), _CMP_GT_OQ);
  float q[16];
  _mm512_storeu_ps(q, at_avx512(tri->q, tri->qx, right, tri->qy, down));
  for (; maybe; maybe &= maybe - 1) {
    int k = __builtin_ctz(maybe);
    settle(t, tri->face, q[k], sure >> k & 1, tri->x0 + (k & 3),
           tri->y0 + (k >> 2));
  }
}

/* Sixteen samples of a row at a time. */
__attribute__((target("avx512f"))) static void
tile_avx512(struct tiling *t, const struct triangle *tri) {
  if (tri->x1 - tri->x0 <= 4 && tri->y1 - tri->y0 <= 4) {
    tile_block_avx512(t, tri);
    return;
  }
  const __m512 lanes =
      _mm512_set_ps(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
  const __m512 bound = _mm512_set1_ps(tri->bound),
               minus_bound = _mm512_set1_ps(-tri->bound),
               clear = _mm512_set1_ps(CLEAR);
  const __m512i face = _mm512_set1_epi32((int)tri->face);
  for (int x = tri->x0; x < tri->x1; x += 16) {
    __m512 right = _mm512_add_ps(lanes, _mm512_set1_ps((float)(x - tri->x0)));
    __m512 e0 = _mm512_add_ps(_mm512_set1_ps(tri->e0),
                              _mm512_mul_ps(_mm512_set1_ps(tri->ex0), right));
    __m512 e1 = _mm512_add_ps(_mm512_set1_ps(tri->e1),
                              _mm512_mul_ps(_mm512_set1_ps(tri->ex1), right));
    __m512 e2 = _mm512_add_ps(_mm512_set1_ps(tri->e2),
                              _mm512_mul_ps(_mm512_set1_ps(tri->ex2), right));
    __m512 q0 = _mm512_add_ps(_mm512_set1_ps(tri->q),
                              _mm512_mul_ps(_mm512_set1_ps(tri->qx), right));
    int n = tri->x1 - x;
    __mmask16 in_box = (__mmask16)(n >= 16 ? 0xffff : (1 << n) - 1);
    uint32_t *ids =
        t->job->ids + (size_t)tri->y0 * t->job->ids_stride + (size_t)x;
    float *z = t->z + (size_t)(tri->y0 - t->window.y0) * t->z_stride +
               (size_t)(x - t->window.x0);
    for (int j = tri->y0; j < tri->y1;
         j++, ids += t->job->ids_stride, z += t->z_stride) {
      __m512 down = _mm512_set1_ps((float)(j - tri->y0));
      __m512 d0 =
          _mm512_add_ps(e0, _mm512_mul_ps(_mm512_set1_ps(tri->ey0), down));
      __m512 d1 =
          _mm512_add_ps(e1, _mm512_mul_ps(_mm512_set1_ps(tri->ey1), down));
      __m512 d2 =
          _mm512_add_ps(e2, _mm512_mul_ps(_mm512_set1_ps(tri->ey2), down));
      __m512 d = _mm512_min_ps(_mm512_min_ps(d0, d1), d2);
      __mmask16 maybe =
          _mm512_mask_cmp_ps_mask(in_box, d, minus_bound, _CMP_GE_OQ);
      if (!maybe)
        continue;
      __mmask16 sure = _mm512_mask_cmp_ps_mask(maybe, d, bound, _CMP_GT_OQ);
      __m512 q =
          _mm512_add_ps(q0, _mm512_mul_ps(_mm512_set1_ps(tri->qy), down));
      __m512 held = _mm512_maskz_loadu_ps(maybe, z);
      __mmask16 nearer = _mm512_mask_cmp_ps_mask(
          sure, q, _mm512_mul_ps(held, clear), _CMP_GT_OQ);
      __mmask16 farther = _mm512_mask_cmp_ps_mask(sure, _mm512_mul_ps(q, clear),
                                                  held, _CMP_LT_OQ);
      count_row(t, tri->face, ids, x, j, nearer, farther);
      _mm512_mask_storeu_ps(z, nearer, q);
      _mm512_mask_storeu_epi32(ids, nearer, face);
      unsigned unsure = maybe & ~(unsigned)(nearer | farther);
      if (unsure) {
        float depth[16];
        _mm512_storeu_ps(depth, q);
        for (; unsure; unsure &= unsure - 1) {
          int k = __builtin_ctz(unsure);
          settle(t, tri->face, depth[k], sure >> k & 1, x + k, j);
        }
      }
    }
  }
}

#endif

/* --- Looking at a batch
 * ---------------------------------------------------------- */

/* The corners of n triangles from `first` on. */
static void gather(const struct tiling *t, uint32_t first, int n,
                   struct corners *restrict r, int *restrict one_sided) {
  const uint32_t *restrict vertex = t->job->world->vertex + 3 * (size_t)first;
  const struct corner *restrict corner = t->corner;
  for (int k = 0; k < n; k++) {
    struct corner a = corner[vertex[3 * k]], b = corner[vertex[3 * k + 1]],
                  c = corner[vertex[3 * k + 2]];
    r->ax[k] = a.x, r->ay[k] = a.y, r->qa[k] = a.q;
    r->bx[k] = b.x, r->by[k] = b.y, r->qb[k] = b.q;
    r->cx[k] = c.x, r->cy[k] = c.y, r->qc[k] = c.q;
    one_sided[k] = t->job->world->one_sided[first + (uint32_t)k];
  }
}

/* Finds their boxes, turns them so that their area on the screen is positive,
 * and says what becomes of them. */
HSR_VECTOR static void look(const struct tiling *t, int n,
                            struct corners *restrict r,
                            const int *restrict one_sided, int *restrict fate) {
  const int fx = t->first_x, fy = t->first_y;
  const int wx0 = t->window.x0, wx1 = t->window.x1, wy0 = t->window.y0,
            wy1 = t->window.y1;
  const float near = (float)t->job->view->near, unit = 1.0f / GRID;
  for (int k = 0; k < n; k++) {
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
    int past_near = near * nearest < 0.99f;

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
    fate[k] = (drop ^ 1) * (GENERALLY - fast); /* or DROP, or TILE */
  }
}

/* Moves the triangles to be tiled to the front; face[] tells which they are. */
static int compact(struct corners *r, const int *fate, int n, int *face) {
  int kept = 0;
  for (int k = 0; k < n; k++) {
    if (fate[k] != TILE)
      continue;
    r->ax[kept] = r->ax[k], r->ay[kept] = r->ay[k], r->qa[kept] = r->qa[k];
    r->bx[kept] = r->bx[k], r->by[kept] = r->by[k], r->qb[kept] = r->qb[k];
    r->cx[kept] = r->cx[k], r->cy[kept] = r->cy[k], r->qc[kept] = r->qc[k];
    r->x0[kept] = r->x0[k], r->y0[kept] = r->y0[k];
    r->x1[kept] = r->x1[k], r->y1[kept] = r->y1[k];
    face[kept++] = k;
  }
  return kept;
}

/* Sets up n triangles; good[] says whether floats hold the depth within RHO. */
HSR_VECTOR static void set_up(const struct tiling *t,
                              const struct corners *restrict r, int n,
                              struct triangles *restrict out,
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

static struct triangle take(const struct triangles *s, const struct corners *r,
                            int k, uint32_t face) {
  return (struct triangle){
      s->e0[k],  s->e1[k],  s->e2[k],  s->ex0[k],   s->ex1[k], s->ex2[k],
      s->ey0[k], s->ey1[k], s->ey2[k], s->bound[k], s->q[k],   s->qx[k],
      s->qy[k],  r->x0[k],  r->y0[k],  r->x1[k],    r->y1[k],  face};
}

/* --- The general way
 * --------------------------------------------------------------- */

static void tile_span(struct tiling *t, uint32_t f, int j, int x0, int x1) {
  float error = (float)t->screen.plane[f].error;
  for (int i = x0; i < x1; i++) {
    float q = (float)hsr_depth(&t->screen, f, i, j);
    /* Unknown unless within RHO. */
    settle(t, f, error < 0.5f * RHO * q ? q : NAN, true, i, j);
  }
}

static void tile_generally(struct tiling *t, uint32_t f) {
  struct hsr_screen *screen = &t->screen;
  hsr_screen_plane(screen, f);
  if (!hsr_screen_place(screen, f, t->tally))
    return;
  HSR_COUNT(t->tally, GENERAL, 1);
  const struct hsr_bounds *box = &screen->bounds[f];
  const struct hsr_window *w = &t->window;
  for (int j = box->y0; j < box->y1; j++) {
    int n = hsr_face_spans(screen, f, j, t->columns, t->tally);
    for (int k = 0; k < n; k += 2) {
      int x0 = t->columns[k], x1 = t->columns[k + 1];
      tile_span(t, f, j, x0 < w->x0 ? w->x0 : x0, x1 > w->x1 ? w->x1 : x1);
    }
  }
}

/* --- The algorithm
 * ------------------------------------------------------------------- */

HSR_VECTOR static void snap(size_t n, const double *restrict sx,
                            const double *restrict sy, const double *restrict q,
                            struct corner *restrict corner) {
  for (size_t v = 0; v < n; v++) {
    int safe = (fabs(sx[v]) < FARTHEST) & (fabs(sy[v]) < FARTHEST);
    corner[v].x = safe ? (int)floor(sx[v] * GRID + 0.5) : UNSAFE;
    corner[v].y = safe ? (int)floor(sy[v] * GRID + 0.5) : UNSAFE;
    corner[v].q = (float)q[v];
    corner[v].unused = 0;
  }
}

static enum hsr_status begin_frame(struct tiling *t) {
  const struct hsr_job *job = t->job;
  const struct hsr_world *world = job->world;
  const struct hsr_view *view = job->view;
  const struct hsr_window *w = &view->window;
  struct hsr_arena *arena = job->scratch;
  size_t width = (size_t)(w->x1 - w->x0), height = (size_t)(w->y1 - w->y0);
  size_t largest = 3;
  if (!world->all_triangles)
    for (uint32_t f = 0; f < world->n_faces; f++)
      if (largest < hsr_face_size(world, f))
        largest = hsr_face_size(world, f);

  t->tally = job->tally;
  t->window = *w;
  t->z_stride = width;
  t->corner = HSR_NEW(arena, struct corner, world->n_vertices);
  t->z = HSR_NEW(arena, float, width *height);
  t->columns = HSR_NEW(arena, int, largest + 4);
  if (!t->corner || !t->z || !t->columns ||
      hsr_screen_init(&t->screen, world, view, arena))
    return HSR_E_NOMEM;

  memset(t->z, 0, width * height * sizeof *t->z);
  for (int j = w->y0; j < w->y1; j++)
    memset(job->ids + (size_t)j * job->ids_stride + (size_t)w->x0, 0xff,
           width * sizeof *job->ids);
  double first_x = hsr_sample_x(view, 0) * GRID;
  double first_y = hsr_sample_y(view, 0) * GRID;
  t->first_x = (int)first_x;
  t->first_y = (int)first_y;
  t->on_grid = first_x == t->first_x && first_y == t->first_y;
  return HSR_OK;
}

/* Asks for what a triangle will need of the large memory, of which every row
 * lies on a page of its own. */
static void fetch(const struct tiling *t, const struct corners *r, int k) {
  const uint32_t *ids =
      t->job->ids + (size_t)r->y0[k] * t->job->ids_stride + (size_t)r->x0[k];
  const float *z = t->z + (size_t)(r->y0[k] - t->window.y0) * t->z_stride +
                   (size_t)(r->x0[k] - t->window.x0);
  for (int j = r->y0[k]; j < r->y1[k];
       j++, ids += t->job->ids_stride, z += t->z_stride) {
    __builtin_prefetch(ids, 1);
    __builtin_prefetch(z, 1);
  }
}

/* Triangles `first` to first + n - 1. */
static void tile_batch(struct tiling *t, uint32_t first, int n,
                       tile_function *tile) {
  struct corners corners;
  struct triangles triangles;
  int one_sided[BATCH], fate[BATCH], face[BATCH], good[BATCH];
  gather(t, first, n, &corners, one_sided);
  look(t, n, &corners, one_sided, fate);
  int n_fast = compact(&corners, fate, n, face);
  set_up(t, &corners, n_fast, &triangles, good);
  for (int k = 0; k < n_fast; k++) {
    if (k + AHEAD < n_fast)
      fetch(t, &corners, k + AHEAD);
    if (!good[k]) {
      fate[face[k]] = GENERALLY;
      continue;
    }
    HSR_COUNT(t->tally, FAST, 1);
    struct triangle triangle =
        take(&triangles, &corners, k, first + (uint32_t)face[k]);
    tile(t, &triangle);
  }
  for (int k = 0; k < n; k++)
    if (fate[k] == GENERALLY)
      tile_generally(t, first + (uint32_t)k);
}

static tile_function *choose_tile(void) {
#ifdef HAVE_AVX512_TWIN
  if (__builtin_cpu_supports("avx512f"))
    return tile_avx512;
#endif
  return tile_portable;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct tiling t = {.job = job};
  if (begin_frame(&t))
    return hsr_fail_nomem(err);
  const struct hsr_world *world = job->world;
  hsr_screen_vertices(&t.screen);
  snap(world->n_vertices, t.screen.sx, t.screen.sy, t.screen.q, t.corner);
  tile_function *tile = choose_tile();
  if (world->all_triangles && t.on_grid)
    for (uint32_t f = 0; f < world->n_faces; f += BATCH) {
      uint32_t left = world->n_faces - f;
      tile_batch(&t, f, left < BATCH ? (int)left : BATCH, tile);
    }
  else
    for (uint32_t f = 0; f < world->n_faces; f++)
      tile_generally(&t, f);
  return HSR_OK;
}

const struct hsr_algorithm HSR_ALGORITHM(zbuffer) = {
    .name = "zbuffer",
    .title = "Brute force with a large memory: the z-buffer",
    .authors = "E. Catmull; Sutherland, Sproull and Schumacker",
    .year = 1974,
    .source = "Catmull, PhD thesis, University of Utah, 1974; Sutherland et "
              "al., Computing Surveys 6(1), 1974, appendix B",
    .taxonomy = HSR_BRUTE_FORCE,
    .sort_order = "Z(XY)",
    .kind = HSR_IDS,
    .counters = counters,
    .steps = steps,
    .render = render};
