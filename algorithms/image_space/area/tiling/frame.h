/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all that tile with masks have in common: where the samples of a picture
 * are, filtered or not; what a frame begins with; the test of cubes; and what
 * is counted.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 3.3, 4.5 and 5.
 * Cubes       one is hidden if the mask pyramid has its silhouette covered */
#ifndef HSR_ALGORITHMS_TILING_FRAME_H
#define HSR_ALGORITHMS_TILING_FRAME_H

#include "algorithms/image_space/area/tiling/masks/canvas.h"
#include "algorithms/image_space/area/tiling/masks/polygon.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Compiled twice, as the algorithms are. */
#define hsr_sampling_init HSR_OF_BUILD(hsr_sampling_init)
#define hsr_sampling_free HSR_OF_BUILD(hsr_sampling_free)
#define hsr_tiling_begin HSR_OF_BUILD(hsr_tiling_begin)
#define hsr_tiling_room HSR_OF_BUILD(hsr_tiling_room)
#define hsr_tiling_pattern HSR_OF_BUILD(hsr_tiling_pattern)
#define hsr_tiling_shows HSR_OF_BUILD(hsr_tiling_shows)
#define hsr_tiling_background HSR_OF_BUILD(hsr_tiling_background)
#define hsr_tiling_count HSR_OF_BUILD(hsr_tiling_count)

/* --- Once ----------------------------------------------------------------- */

enum { HSR_PATTERNS = HSR_MOST_PATTERNS + 1 }; /* the last one is no jitter */

struct hsr_sampling {
  struct hsr_triage_tables tables;
  struct hsr_mask_places places[HSR_PATTERNS];
  struct hsr_kernel cosine;
};

/* HSR_E_NOMEM; freed with hsr_sampling_free also then. */
enum hsr_status hsr_sampling_init(struct hsr_sampling *sampling, int intervals,
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
  struct hsr_mask_work cubes, polygons; /* masks.work is that of polygons */
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
 * masks are asked, and not the window alone. */
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
                       "were tiled"},                                          \
  [HSR_CUBES_HIDDEN] = {"cubes hidden", "of these, those that are hidden"},    \
  [HSR_CUBE_CELLS] = {"cube cells",                                            \
                      "cells of the mask pyramid visited for them"},           \
  [HSR_POLYGON_CELLS] = {"polygon cells",                                      \
                         "cells of the mask pyramid visited for polygons, "    \
                         "and the background"},                                \
  [HSR_FINEST_CELLS] = {"finest cells",                                        \
                        "of all these, those of the finest level"},            \
  [HSR_PIXEL_CELLS] = {"pixel cells",                                          \
                       "of all these, those as large as a pixel or larger"},   \
  [HSR_SAMPLES_WRITTEN] = {"samples", "written, each once"},                   \
  [HSR_SAMPLES_UNSURE] = {"unsure samples", "put to the exact predicates"}

/* Adds up what the masks and the canvas have counted. */
void hsr_tiling_count(const struct hsr_tiling *tiling);

#ifdef __cplusplus
}
#endif
#endif
