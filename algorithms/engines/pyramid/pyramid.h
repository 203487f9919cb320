/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The z-pyramid over a tiler's z-buffer.
 *
 * Source      N. Greene, M. Kass and G. Miller, "Hierarchical Z-Buffer
 *             Visibility", SIGGRAPH 1993, 3.2; N. Greene, PhD thesis, UC Santa
 *             Cruz, 1995, 3.3.2.
 * Notation    Depths are q as in tiler.h: greater is nearer. An entry is a
 *             z-value of the z-pyramid, in far[level], or of the znear pyramid,
 *             in near[level]. Level 0 is the z-buffer, an N x N square, N a
 *             power of two, of which the window is the first corner.
 * Invariant   When hsr_pyramid_update has been called for all boxes written to,
 *             every entry is the farthest, or in near[] the nearest, of the
 *             four below it. Samples outside of the window are nearer than
 *             anything. An unknown depth (NaN) is taken as the background in
 *             far[], and as nearer than anything in near[].
 * Ties        What is found hidden is hidden, if depths are exact within
 *             HSR_RHO. What rounding leaves open is not hidden. */
#ifndef HSR_ALGORITHMS_PYRAMID_H
#define HSR_ALGORITHMS_PYRAMID_H

#include "algorithms/engines/pyramid/entries.h"
#include "algorithms/engines/tiler/tiler.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_PYRAMID_LEVELS = 15 }; /* of 2^14 samples a side */

struct hsr_pyramid {
  /* Sample (i, j) is cell (i - x0, j - y0) of level 0. */
  struct hsr_window window;
  int n_levels;                    /* the last level is one entry, the apex */
  float *far[HSR_PYRAMID_LEVELS];  /* 2^(n_levels - 1 - level) cells a side */
  float *near[HSR_PYRAMID_LEVELS]; /* NULL: not kept. near[0] is far[0] */
  bool reads_rows; /* the fast test reads rows of entries, on some machines */
  struct hsr_entry_count
      *count; /* of what is read; borrowed, and not NULL in the
                                    counting build */
};

/* Makes a pyramid for the window; `near`: with the znear pyramid. far[0] is to
 * be the tiler's z-buffer, with rows *stride apart. The arrays are the arena's.
 * HSR_E_NOMEM. */
enum hsr_status hsr_pyramid_init(struct hsr_pyramid *pyramid,
                                 const struct hsr_window *window, bool near,
                                 size_t *stride, struct hsr_arena *arena);

/* Makes all samples of the window the background, and all entries fit. */
void hsr_pyramid_clear(struct hsr_pyramid *pyramid);

/* Brings the entries above a box of samples up to date, level by level, up to
 * the first level on which none changes. */
void hsr_pyramid_update(struct hsr_pyramid *pyramid, struct hsr_bounds box);

/* The tests. A box is of samples, within the window and not empty. True: what
 * is within the box, and nowhere nearer than depth q, is certainly hidden.
 *
 * The basic test reads the smallest entry that encloses the box, no other. */
bool hsr_pyramid_basic(struct hsr_pyramid *pyramid, struct hsr_bounds box,
                       float q);

/* The fast test reads entries that the box meets, by recursion to the samples
 * themselves. */
bool hsr_pyramid_hides(struct hsr_pyramid *pyramid, struct hsr_bounds box,
                       float q);

/* The fast test of n triangles, whose boxes are not empty: sets hidden[k]. */
void hsr_pyramid_hides_triangles(struct hsr_pyramid *pyramid, int n,
                                 const struct hsr_corners *corners,
                                 int *hidden);

/* The definitive test of a triangle that has been set up. In each entry it
 * takes the nearest depth that the triangle may have there; at a sample it asks
 * what tiling would do. */
bool hsr_pyramid_hides_triangle(struct hsr_pyramid *pyramid,
                                struct hsr_tiler *tiler,
                                const struct hsr_triangle *triangle);

/* By the znear pyramid, which there must be: is q certainly nearer than all
 * depths in the smallest entry that encloses the box? */
bool hsr_pyramid_before(struct hsr_pyramid *pyramid, struct hsr_bounds box,
                        float q);

#ifdef __cplusplus
}
#endif
#endif
