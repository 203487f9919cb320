/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the modules that tile with masks share: where the samples of a picture
 * are, filtered or not; how a module and a frame begin; the test of cubes; and
 * the counters.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 3.1, 4.3, 4.5 and 5.
 * Notation    a cube is the subject HSR_CELL(number, instance, 0): its number
 *             in the tree of that instance, or HSR_NO_ID where there is one
 *             tree for all. A cell of the mask pyramid is HSR_CELL(level,
 *             column, row); level 0 is the root.
 * Invariant   a cube is hidden if the mask pyramid has its silhouette covered
 */
#ifndef HSR_ALGORITHMS_TILING_FRAME_H
#define HSR_ALGORITHMS_TILING_FRAME_H

#include "algorithms/engines/masks/canvas.h"
#include "algorithms/engines/masks/polygon.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- Once ----------------------------------------------------------------- */

enum { HSR_PATTERNS = HSR_MOST_PATTERNS + 1 }; /* the last one is no jitter */

struct hsr_sampling {
  struct hsr_triage_tables tables;
  struct hsr_mask_places places[HSR_PATTERNS];
  struct hsr_kernel cosine, field;
};

enum { HSR_TILING_INTERVALS = 64 }; /* the paper's, of a side */

/* Makes what a module keeps from frame to frame: `size` bytes that begin with a
 * struct hsr_sampling; all the others are 0. HSR_E_NOMEM: then, too, *prepared
 * is the module's to release, which frees the sampling. */
enum hsr_status hsr_tiling_prepare(size_t size, long intervals, void **prepared,
                                   struct hsr_error *err);
void hsr_sampling_free(struct hsr_sampling *sampling);

/* --- A frame -------------------------------------------------------------- */

struct hsr_tiling {
  const struct hsr_job *job;
  const struct hsr_sampling *sampling;
  struct hsr_filtering filtering; /* HSR_FILTER_NONE: there is none */
  struct hsr_view view; /* of the samples: the sub-samples, if filtered */
  struct hsr_masks masks;
  struct hsr_pieces_view pieces;
  struct hsr_canvas canvas;
  struct hsr_mask_sink sink; /* to the canvas */
};

/* With room for such trees; `tiling` must stay where it is. HSR_E_NOMEM. */
enum hsr_status hsr_tiling_begin(struct hsr_tiling *tiling,
                                 const struct hsr_sampling *sampling,
                                 const struct hsr_job *job,
                                 struct hsr_pieces_room room);

/* Makes other room. HSR_E_NOMEM. */
enum hsr_status hsr_tiling_room(struct hsr_tiling *tiling,
                                struct hsr_pieces_room room);

/* The first of the patterns that a job needs. */
int hsr_tiling_pattern(const struct hsr_job *job);

/* Whether anything within a box that is moved may be seen; if `tested`, the
 * masks are asked, and not the window alone. hsr_tiling_whom has named the
 * cube. */
bool hsr_tiling_is_visible(struct hsr_tiling *tiling, const struct hsr_box *box,
                           const double shift[3], bool tested);

/* Tiles whatever is vacant still, and of no polygon. */
void hsr_tiling_background(struct hsr_tiling *tiling);

/* --- Counters ------------------------------------------------------------- */

/* What tiling with masks counts. The groups of lines: the test of a cube; listing 1;
 * its samples. */
extern const struct hsr_part hsr_tiling_part;
enum {
  HSR_CUBES_TESTED = HSR_FIRST_OF(HSR_PART_TILING),
  HSR_CUBES_CULLED,
  HSR_CUBE_CELLS,
  HSR_POLYGON_CELLS,
  HSR_FINEST_CELLS,
  HSR_PIXEL_CELLS,
  HSR_SAMPLES_WRITTEN,
  HSR_SAMPLES_UNSURE
};
enum { HSR_CUBE_LINES, HSR_CELL_LINES, HSR_SAMPLE_LINES };

/* For whom cells are visited from now on: a face, or a cube. */
static inline void hsr_tiling_whom(struct hsr_tiling *tiling,
                                   struct hsr_subject whom) {
  if (!HSR_COUNTING)
    return;
  tiling->masks.count.cells =
      whom.kind == HSR_OF_CELL ? HSR_CUBE_CELLS : HSR_POLYGON_CELLS;
  tiling->masks.count.whom = whom;
}

/* Counts a cube whose silhouette has been tiled: hsr_tiling_whom has named it,
 * and the silhouette is that of the pieces at hand. */
static inline void hsr_tiling_count_test(const struct hsr_tiling *tiling,
                                         bool visible) {
  struct hsr_tally *tally = tiling->job->tally;
  struct hsr_subject cube = tiling->masks.count.whom;
  const struct hsr_bounds *b = &tiling->pieces.box;
  struct hsr_window window = hsr_window_make(b->x0, b->y0, b->x1, b->y1);
  HSR_STEP(tally, HSR_CUBES_TESTED, cube, HSR_THE_WINDOW, window, visible);
  if (!visible)
    HSR_STEP(tally, HSR_CUBES_CULLED, cube, HSR_THE_WINDOW, window, 0);
}

#ifdef __cplusplus
}
#endif
#endif
