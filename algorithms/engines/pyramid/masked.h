/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The masked depth buffer: two depths and a mask for each tile of samples.
 *
 * Source      J. Hasselgren, M. Andersson and T. Akenine-Möller, "Masked
 *             Software Occlusion Culling", High Performance Graphics 2016, 23-31;
 *             the two layers are those of M. Andersson, J. Hasselgren and T.
 *             Akenine-Möller, "Masked Depth Culling for Graphics Hardware", ACM
 *             Transactions on Graphics 34(6), 2015.
 * Notation    z -> q as in tiler.h: greater is nearer. So the paper's zmax of a
 *             layer, the depth that nothing in it is behind, is the least q.
 *             zmax0 -> reference; zmax1 -> working; the mask -> in_working.
 * Invariant   The samples of a tile have depths of at least `reference`, and
 *             those of in_working of at least `working`. Samples outside of the
 *             window are always in the mask.
 * Ties        As in pyramid.h: what is found hidden is hidden, if depths are
 *             exact within HSR_RHO. A sample whose cover rounding leaves open is
 *             not covered here.
 * Departures  - A tile has 8 x 8 samples. Theirs has 8 x 4, as many as the bits
 *             of a lane of their vector unit.
 *             - The buffer stands beside a z-buffer, which draws the picture.
 *             Theirs stands alone and draws none.
 *             - A face that the tiler draws the general way is put in by the
 *             samples that show it, as the z-buffer has them: exact depths need
 *             not lie on one plane in floats.
 * Cost        a tile is updated in the same time, whatever it holds */
#ifndef HSR_ALGORITHMS_MASKED_H
#define HSR_ALGORITHMS_MASKED_H

#include "algorithms/engines/pyramid/entries.h"
#include "algorithms/engines/tiler/tiler.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_MASKED_BITS = 3, HSR_MASKED_SIDE = 1 << HSR_MASKED_BITS };

/* Sample (i, j) of a tile, from its first one, is bit 8 j + i. */
struct hsr_masked_tile {
  uint64_t in_working;
  float reference, working; /* working: HUGE_VALF if the layer is empty */
};

/* The outcomes of an update: the face is not nearer than the reference layer;
 * it is added to the working layer; it takes its place; or that layer is full,
 * and is the reference layer from now on. */
#define HSR_MASKED_UPDATE_OUTCOMES                                             \
  "behind the reference layer|added to the working layer|"                     \
  "the working layer is dropped|the tile is full"

struct hsr_masked {
  struct hsr_window window; /* its first sample is the first tile's first one */
  int columns, rows;        /* of tiles */
  struct hsr_masked_tile *tile; /* row by row */
  /* A tile counts as an entry of level HSR_MASKED_BITS. Each that a face is put
   * into is a step of `updates`, with the tile and the face. */
  struct hsr_entry_count
      *count; /* borrowed, and not NULL in the counting build */
  int updates;
};

/* Makes the buffer of a window: all of it is the background. The array is the
 * arena's. HSR_E_NOMEM. */
enum hsr_status hsr_masked_init(struct hsr_masked *masked,
                                const struct hsr_window *window,
                                struct hsr_arena *arena);

/* Puts a triangle in that has been set up. No corner of it is farther than
 * depth `farthest`. */
void hsr_masked_put(struct hsr_masked *masked,
                    const struct hsr_triangle *triangle, float farthest);

/* Puts in what shows face `id` of the samples in a box, which is within the
 * window: as the tiler's ids and depths have them. The window is the tiler's
 * only part. */
void hsr_masked_put_shown(struct hsr_masked *masked,
                          const struct hsr_tiler *tiler, uint32_t id,
                          struct hsr_bounds box);

/* The tests. True: what is within a box of samples, which is within the window
 * and not empty, and nowhere nearer than depth q, is certainly hidden; or so is
 * a triangle that has been set up. As in the paper only reference layers are
 * asked. */
bool hsr_masked_hides(struct hsr_masked *masked, struct hsr_bounds box,
                      float q);
bool hsr_masked_hides_triangle(struct hsr_masked *masked,
                               const struct hsr_triangle *triangle);

#ifdef __cplusplus
}
#endif
#endif
