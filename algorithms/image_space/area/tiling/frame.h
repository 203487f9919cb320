/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the modules that tile with masks share (tiling, tiling-merged,
 * tiling-lazy, tiling-solids): where the samples of a picture are, filtered or
 * not; how a module and a frame begin; the test of cubes; and the counters.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 3.1, 4.3, 4.5 and 5.
 * Notation    As subjects of steps: a cube is HSR_CELL(number, instance, 0),
 *             its number being that in the octree of the instance; the instance
 *             is HSR_NO_ID if one octree has all faces. A cell of the mask
 *             pyramid is HSR_CELL(level, column, row); level 0 is the root.
 * Invariant   a cube is hidden if all samples within its silhouette are covered
 */
#ifndef HSR_ALGORITHMS_TILING_FRAME_H
#define HSR_ALGORITHMS_TILING_FRAME_H

#include "algorithms/engines/masks/canvas.h"
#include "algorithms/engines/masks/polygon.h"
#include "common/answers/filter.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- Once for all frames -------------------------------------------------- */

enum { HSR_PATTERNS = HSR_MOST_PATTERNS + 1 }; /* the last one is no jitter */

/* What does not depend on the scene or the view. */
struct hsr_sampling {
  struct hsr_triage_tables tables;             /* the masks of lines */
  struct hsr_mask_places places[HSR_PATTERNS]; /* of the samples in a mask */
  struct hsr_kernel cosine, field;             /* of the filters */
};

enum {
  HSR_TILING_INTERVALS = 64
}; /* a side of a square has, as in the paper */

/* Allocates what a module keeps from frame to frame: *prepared, of `size`
 * bytes. It begins with a struct hsr_sampling, which is filled in, with tables
 * of so many intervals a side; the rest is 0. Also after a failure *prepared is
 * the module's to free, unless it is NULL, and first its sampling by
 * hsr_sampling_free. HSR_E_NOMEM. */
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

/* Begins a frame of `job`, with a vacant mask pyramid and room for trees of
 * that size. All is borrowed while *tiling is in use, which must stay where it
 * is: its sink points into it. Memory from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_tiling_begin(struct hsr_tiling *tiling,
                                 const struct hsr_sampling *sampling,
                                 const struct hsr_job *job,
                                 struct hsr_pieces_room room);

/* Makes room for trees of another size. HSR_E_NOMEM. */
enum hsr_status hsr_tiling_room(struct hsr_tiling *tiling,
                                struct hsr_pieces_room room);

/* The first of the patterns of jitter that a job needs, as an index of
 * sampling->places[]. */
int hsr_tiling_pattern(const struct hsr_job *job);

/* May anything be seen of a box, moved by `shift`? If `tested`, its silhouette
 * is tiled against the masks; otherwise only the window is asked. What it
 * visits is counted for the cube that hsr_tiling_whom has named. */
bool hsr_tiling_is_visible(struct hsr_tiling *tiling, const struct hsr_box *box,
                           const double shift[3], bool tested);

/* Tiles the background into all samples that are still vacant. */
void hsr_tiling_background(struct hsr_tiling *tiling);

/* --- Counters ------------------------------------------------------------- */

/* What tiling with masks counts; frame.c has the meanings, in this order.
 * Groups of lines of its outline: the test of a cube; the cells of listing 1;
 * the samples. */
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

/* From now on visits of cells are counted for `whom`: a face that is tiled, or
 * a cube that is tested. */
static inline void hsr_tiling_whom(struct hsr_tiling *tiling,
                                   struct hsr_subject whom) {
  if (!HSR_COUNTING)
    return;
  tiling->masks.count.cells =
      whom.kind == HSR_OF_CELL ? HSR_CUBE_CELLS : HSR_POLYGON_CELLS;
  tiling->masks.count.whom = whom;
}

/* Counts the test of a cube, whose silhouette has been tiled: the cube that
 * hsr_tiling_whom has named, and the box that hsr_pieces_box was given last. */
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
