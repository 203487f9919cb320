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

/* Makes what a module keeps from frame to frame: `size` bytes that begin with a
 * struct hsr_sampling; all the others are 0. HSR_E_NOMEM: then, too, *prepared
 * is the module's to release, which frees the sampling. */
enum hsr_status hsr_tiling_prepare(size_t size, long intervals, void **prepared,
                                   struct hsr_error *err);
void hsr_sampling_free(struct hsr_sampling *sampling);

/* The option of all modules from which `intervals` comes. */
#define HSR_INTERVALS_OPTION                                                   \
  {                                                                            \
    .name = "intervals",                                                       \
    .meaning = "into which a side is divided for the tables of masks",         \
    .least = 1, .most = HSR_TRIAGE_MOST, .standard = 64                        \
  }

/* --- A frame -------------------------------------------------------------- */

struct hsr_tiling {
  const struct hsr_job *job;
  const struct hsr_sampling *sampling;
  struct hsr_view view; /* of the samples: the sub-samples, if filtered */
  struct hsr_masks masks;
  struct hsr_pieces_view pieces;
  struct hsr_canvas canvas;
  struct hsr_mask_sink sink; /* to the canvas */

  /* The work picture, or NULL; and whose cells it shows. */
  float *work;
  enum hsr_tiling_work {
    HSR_WORK_ALL,
    HSR_WORK_CUBES,
    HSR_WORK_POLYGONS
  } shows;
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
bool hsr_tiling_shows(struct hsr_tiling *tiling, const struct hsr_box *box,
                      const double shift[3], bool tested);

/* Tiles whatever is vacant still, and of no polygon. */
void hsr_tiling_background(struct hsr_tiling *tiling);

/* --- Counters ------------------------------------------------------------- */

/* The first counters of each module; its own begin at HSR_TILING_COUNTERS. */
enum {
  HSR_CUBES_ASKED,
  HSR_CUBES_HIDDEN,
  HSR_CUBE_CELLS,
  HSR_POLYGON_CELLS,
  HSR_FINEST_CELLS,
  HSR_PIXEL_CELLS,
  HSR_SAMPLES_WRITTEN,
  HSR_SAMPLES_UNSURE,
  HSR_TILING_COUNTERS
};

#define HSR_TILING_COUNTER_NAMES                                               \
  [HSR_CUBES_ASKED] = {"cubes asked",                                          \
                       "cubes, and boxes of instances, whose silhouettes "     \
                       "were tiled",                                           \
                       HSR_COMPARE,                                            \
                       HSR_OF_CELL,                                            \
                       HSR_OF_WINDOW,                                          \
                       "hidden|visible"},                                      \
  [HSR_CUBES_HIDDEN] = {"cubes hidden", "of these, those that are hidden",     \
                        HSR_REJECT, HSR_OF_CELL, HSR_OF_WINDOW},               \
  [HSR_CUBE_CELLS] = {"cube cells",                                            \
                      "cells of the mask pyramid visited for them",            \
                      HSR_COMPARE,                                             \
                      HSR_OF_CELL,                                             \
                      HSR_OF_CELL,                                             \
                      HSR_MASK_VISIT_OUTCOMES},                                \
  [HSR_POLYGON_CELLS] = {"polygon cells",                                      \
                         "cells of the mask pyramid visited for polygons, "    \
                         "and the background",                                 \
                         HSR_COMPARE,                                          \
                         HSR_OF_CELL,                                          \
                         HSR_OF_FACE,                                          \
                         HSR_MASK_VISIT_OUTCOMES},                             \
  [HSR_FINEST_CELLS] = {"finest cells",                                        \
                        "of all these, those of the finest level",             \
                        HSR_COMPARE,                                           \
                        HSR_OF_CELL,                                           \
                        HSR_OF_NOTHING,                                        \
                        HSR_MASK_VISIT_OUTCOMES},                              \
  [HSR_PIXEL_CELLS] = {"pixel cells",                                          \
                       "of all these, those as large as a pixel or larger",    \
                       HSR_COMPARE,                                            \
                       HSR_OF_CELL,                                            \
                       HSR_OF_NOTHING,                                         \
                       HSR_MASK_VISIT_OUTCOMES},                               \
  [HSR_SAMPLES_WRITTEN] = {"samples",                                          \
                           "written by masks, each once; of a filtered "       \
                           "picture, 64 a pixel, or 4096",                     \
                           HSR_ACCEPT, HSR_OF_FACE, HSR_OF_WINDOW},            \
  [HSR_SAMPLES_UNSURE] = {"unsure samples", "put to the exact predicates",     \
                          HSR_SAMPLE,       HSR_OF_FACE,                       \
                          HSR_OF_WINDOW,    "not covered|covered"}

/* For whom cells are visited from now on: a face, or a cube. */
static inline void hsr_tiling_whom(struct hsr_tiling *tiling,
                                   struct hsr_subject whom) {
  if (!HSR_COUNTING)
    return;
  tiling->masks.count.cells =
      whom.kind == HSR_OF_CELL ? HSR_CUBE_CELLS : HSR_POLYGON_CELLS;
  tiling->masks.count.whom = whom;
  bool shown = tiling->shows == HSR_WORK_ALL ||
               (tiling->shows == HSR_WORK_CUBES) == (whom.kind == HSR_OF_CELL);
  tiling->job->tally->work = shown ? tiling->work : NULL;
}

/* Counts a cube whose silhouette has been tiled: hsr_tiling_whom has named it,
 * and the silhouette is that of the pieces at hand. */
static inline void hsr_tiling_asked(const struct hsr_tiling *tiling,
                                    bool visible) {
  struct hsr_tally *tally = tiling->job->tally;
  struct hsr_subject cube = tiling->masks.count.whom;
  const struct hsr_bounds *b = &tiling->pieces.box;
  struct hsr_window window = hsr_window_make(b->x0, b->y0, b->x1, b->y1);
  HSR_STEP(tally, HSR_CUBES_ASKED, cube, HSR_THE_WINDOW, window, visible);
  if (!visible)
    HSR_STEP(tally, HSR_CUBES_HIDDEN, cube, HSR_THE_WINDOW, window, 0);
}

/* Lines of an outline: the test of a cube; listing 1 and its samples. */
#define HSR_TILING_CUBE_LINES                                                  \
  {"  is a vacant sample within the cube's silhouette?",                       \
   HSR_RAISES(HSR_CUBES_ASKED)},                                               \
      {"    tile_poly the silhouette, to look and not to write",               \
       HSR_RAISES(HSR_CUBE_CELLS)},                                            \
  {                                                                            \
    "  if not, cull the cube", HSR_RAISES(HSR_CUBES_HIDDEN)                    \
  }

#define HSR_TILING_CELL_LINES                                                  \
  {"    tile_poly(mask): build the polygon's mask; W = Cv & Pc, A = ~(W | Pv " \
   "| Cc)",                                                                    \
   HSR_RAISES(HSR_POLYGON_CELLS)},                                             \
      {"      of a square of one or more pixels",                              \
       HSR_RAISES(HSR_PIXEL_CELLS)},                                           \
      {"      of the finest level: W is a mask of samples",                    \
       HSR_RAISES(HSR_FINEST_CELLS)},                                          \
      {"        ask exactly about samples too close to an edge",               \
       HSR_RAISES(HSR_SAMPLES_UNSURE)},                                        \
  {                                                                            \
    "      for each TRUE bit in A: tile_poly(the subcell's mask), propagate"   \
  }

#define HSR_TILING_SAMPLE_LINE                                                 \
  {                                                                            \
    "    for each TRUE bit in W: display its samples",                         \
        HSR_RAISES(HSR_SAMPLES_WRITTEN)                                        \
  }

#ifdef __cplusplus
}
#endif
#endif
