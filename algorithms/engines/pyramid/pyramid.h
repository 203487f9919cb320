/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The z-pyramid.
 *
 * Source      N. Greene, M. Kass and G. Miller, "Hierarchical Z-Buffer
 *             Visibility", SIGGRAPH 1993, 3.2; N. Greene, PhD thesis, UC Santa
 *             Cruz, 1995, 3.3.2.
 * Notation    depths are q = 1/t: farthest is least. z-value -> far[level], and
 *             of the second pyramid near[level]; level 0 is the z-buffer, an
 *             N x N square, N a power of two, of which the window is a corner
 * Invariant   after hsr_pyramid_update of all boxes written to, every entry is
 *             the farthest (nearest) of the four below it. What is outside of
 *             the window is nearer than anything; an unknown depth (NaN) is the
 *             background's in far[], nearer than anything in near[].
 * Ties        what is called hidden is hidden, where depths are exact within
 *             HSR_RHO; where rounding leaves it open, it is not hidden */
#ifndef HSR_ALGORITHMS_PYRAMID_H
#define HSR_ALGORITHMS_PYRAMID_H

#include "algorithms/engines/tiler/tiler.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_PYRAMID_LEVELS = 15 }; /* of 2^14 samples a side */

/* What the tests below raise, in the counting build: a counter of the tally for
 * each entry that is read. */
struct hsr_pyramid_count {
  struct hsr_tally *tally;
  int reads;
  struct hsr_subject whom; /* the face or the cube that is tested */
  float *work; /* sample (i, j), at work[j * work_stride + i], by its share of
                  every entry read; or NULL */
  size_t work_stride;
};

/* The events of a read: the entry (level, column, row), for whom, the samples
 * that it stands for. It decides if the test goes into no entry below it. */
#define HSR_PYRAMID_READ_OUTCOMES "leaves it open|decides"

struct hsr_pyramid {
  struct hsr_window
      window;   /* sample (i, j) is cell (i - x0, j - y0) of level 0 */
  int n_levels; /* the last one is one cell, the apex */
  float *far[HSR_PYRAMID_LEVELS];  /* 2^(n_levels - 1 - level) cells a side */
  float *near[HSR_PYRAMID_LEVELS]; /* NULL: not kept. near[0] is far[0] */
  bool reads_rows; /* the fast test reads rows of entries, on some machines */
  struct hsr_pyramid_count count;
};

/* A pyramid for the window, its arrays the arena's, and a z-buffer as a tiler
 * has it, `stride` floats a row. HSR_E_NOMEM. */
enum hsr_status hsr_pyramid_init(struct hsr_pyramid *pyramid,
                                 const struct hsr_window *window, bool near,
                                 size_t *stride, struct hsr_arena *arena);

/* All samples are the background. */
void hsr_pyramid_clear(struct hsr_pyramid *pyramid);

/* Brings the entries above a box of samples up to date, level by level, until
 * one does not change. */
void hsr_pyramid_update(struct hsr_pyramid *pyramid, struct hsr_bounds box);

/* The basic test: the smallest entry that encloses the box, and nothing else.
 */
bool hsr_pyramid_basic(struct hsr_pyramid *pyramid, struct hsr_bounds box,
                       float q);

/* The fast test: is all within a box of samples, which is within the window and
 * not empty, of depth q or farther, hidden? */
bool hsr_pyramid_hides(struct hsr_pyramid *pyramid, struct hsr_bounds box,
                       float q);

/* The fast test of n triangles, whose boxes are not empty: hidden[k] tells. */
void hsr_pyramid_hides_triangles(struct hsr_pyramid *pyramid, int n,
                                 const struct hsr_corners *corners,
                                 int *hidden);

/* The definitive test: is a triangle that is set up hidden? Within each entry,
 * by the nearest that it has there; at a sample, by what tiling it would do. */
bool hsr_pyramid_hides_triangle(struct hsr_pyramid *pyramid,
                                struct hsr_tiler *tiler,
                                const struct hsr_triangle *triangle);

/* By the pyramid of the nearest: is q nearer than anything in the smallest
 * entry that encloses the box? */
bool hsr_pyramid_before(struct hsr_pyramid *pyramid, struct hsr_bounds box,
                        float q);

#ifdef __cplusplus
}
#endif
#endif
