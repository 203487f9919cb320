/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/image_space/area/tiling/frame.h"
#include "common/answers/kinds/filtered.h"

#include <stdlib.h>

/* Lines that a polygon may have besides those of its corners, for near and for
 * clips (clip.h); also enough for the silhouette of a box. */
enum { SPARE_LINES = 8 };

/* --- Where the samples are ------------------------------------------------ */

static struct hsr_mask_places places_of(const struct hsr_jitter *jitter) {
  struct hsr_mask_places places;
  for (int bit = 0; bit < 64; bit++) {
    places.x[bit] = bit % 8 + 0.5 + jitter->x[bit];
    places.y[bit] = bit / 8 + 0.5 + jitter->y[bit];
  }
  return places;
}

static enum hsr_status make_sampling(struct hsr_sampling *s, long intervals,
                                     struct hsr_error *err) {
  for (int pattern = 0; pattern < HSR_PATTERNS; pattern++) {
    struct hsr_jitter jitter = {{0}, {0}};
    if (pattern < HSR_MOST_PATTERNS)
      hsr_jitter_init(&jitter, pattern);
    s->places[pattern] = places_of(&jitter);
  }
  hsr_kernel_init(&s->cosine, HSR_FILTER_COSINE);
  hsr_kernel_init(&s->field, HSR_FILTER_FIELD);
  return hsr_triage_init(&s->tables, (int)intervals, err);
}

enum hsr_status hsr_tiling_prepare(size_t size, long intervals, void **prepared,
                                   struct hsr_error *err) {
  *prepared = calloc(1, size);
  return *prepared ? make_sampling(*prepared, intervals, err)
                   : hsr_fail_nomem(err);
}

void hsr_sampling_free(struct hsr_sampling *s) {
  hsr_triage_free(&s->tables);
}

/* Samples along a side of a pixel. Not filtered: 1. Filtered: 8, one mask a
 * pixel; by box64x64 64, which is 8 x 8 masks, a level more. */
static int side_of(const struct hsr_filtering *filtering) {
  return filtering->filter ? HSR_SUB * hsr_filter_cells(filtering->filter) : 1;
}

static struct hsr_view view_of(const struct hsr_job *job,
                               const struct hsr_filtering *filtering) {
  int side = side_of(filtering);
  return side > 1 ? hsr_view_finer(job->view, side, side) : *job->view;
}

int hsr_tiling_pattern(const struct hsr_job *job) {
  return hsr_form_filtering(&job->answer->form).patterns ? 0
                                                         : HSR_MOST_PATTERNS;
}

/* The places of samples in a mask if the view displaces all samples alike, as
 * it may if the picture is not filtered. NULL: out of memory. */
static struct hsr_mask_places *displaced(const struct hsr_job *job,
                                         const struct hsr_view *view) {
  struct hsr_mask_places *places =
      HSR_NEW(job->scratch, struct hsr_mask_places, 1);
  for (int bit = 0; places && bit < 64; bit++) {
    places->x[bit] = hsr_sample_x(view, bit % 8);
    places->y[bit] = hsr_sample_y(view, bit / 8);
  }
  return places;
}

/* --- A frame -------------------------------------------------------------- */

static struct hsr_masks masks_of(struct hsr_tiling *t) {
  const struct hsr_job *job = t->job;
  bool jittered = t->filtering.patterns > 0;
  bool moved =
      !t->filtering.filter && (t->view.offset_x != 0 || t->view.offset_y != 0);
  int pattern = hsr_tiling_pattern(job);
  return (struct hsr_masks){.tables = &t->sampling->tables,
                            .places = moved ? displaced(job, &t->view)
                                            : t->sampling->places + pattern,
                            .filtering = jittered ? &t->filtering : NULL,
                            .anywhere = jittered || moved,
                            .count = {.tally = job->tally,
                                      .cells = HSR_POLYGON_CELLS,
                                      .finest = HSR_FINEST_CELLS,
                                      .pixels = HSR_PIXEL_CELLS,
                                      .unsure = HSR_SAMPLES_UNSURE},
                            .pixel = side_of(&t->filtering)};
}

enum hsr_status hsr_tiling_begin(struct hsr_tiling *t,
                                 const struct hsr_sampling *sampling,
                                 const struct hsr_job *job,
                                 struct hsr_pieces_room room) {
  const struct hsr_filtering filtering = hsr_form_filtering(&job->answer->form);
  *t = (struct hsr_tiling){.job = job,
                           .sampling = sampling,
                           .filtering = filtering,
                           .view = view_of(job, &filtering)};
  t->masks = masks_of(t);
  bool field = filtering.filter == HSR_FILTER_FIELD;
  hsr_canvas_begin(&t->canvas, job, t->view.window,
                   field ? &sampling->field : &sampling->cosine,
                   HSR_SAMPLES_WRITTEN);
  t->sink = hsr_canvas_sink(&t->canvas);
  if (!t->masks.places ||
      hsr_masks_init(&t->masks, &t->view.window, room.corners + SPARE_LINES,
                     job->scratch))
    return HSR_E_NOMEM;
  return hsr_pieces_begin(&t->pieces, room, &t->view, &t->masks, job->tally,
                          job->scratch);
}

enum hsr_status hsr_tiling_room(struct hsr_tiling *t,
                                struct hsr_pieces_room room) {
  const struct hsr_job *job = t->job;
  if (hsr_masks_room(&t->masks, room.corners + SPARE_LINES, job->scratch))
    return HSR_E_NOMEM;
  return hsr_pieces_begin(&t->pieces, room, &t->view, &t->masks, job->tally,
                          job->scratch);
}

bool hsr_tiling_is_visible(struct hsr_tiling *t, const struct hsr_box *box,
                           const double shift[3], bool tested) {
  enum hsr_box_place place = hsr_pieces_box(&t->pieces, box, shift);
  if (place != HSR_BOX_INSIDE || !tested)
    return place != HSR_BOX_OUTSIDE;
  bool visible =
      hsr_masks_find(&t->masks, t->pieces.box) &&
      hsr_masks_show_found(&t->masks, hsr_pieces_silhouette(&t->pieces));
  hsr_tiling_count_test(t, visible);
  return visible;
}

void hsr_tiling_background(struct hsr_tiling *t) {
  hsr_tiling_whom(t, HSR_FACE(HSR_BACKGROUND));
  hsr_canvas_face(&t->canvas, HSR_BACKGROUND);
  hsr_masks_tile_rest(&t->masks, &t->sink);
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"cubes tested",
     "cubes, and boxes of instances, whose silhouettes "
     "were tiled",
     HSR_COMPARE, HSR_OF_CELL, HSR_OF_WINDOW, "hidden|visible",
     .key = "cube-tested"},
    {"cubes culled", "of these, those that are hidden", HSR_REJECT, HSR_OF_CELL,
     HSR_OF_WINDOW, .key = "cube-culled"},
    {"cube cells", "cells of the mask pyramid visited for them", HSR_COMPARE,
     HSR_OF_CELL, HSR_OF_CELL, HSR_MASK_VISIT_OUTCOMES, .key = "cube-cell"},
    {"polygon cells",
     "cells of the mask pyramid visited for polygons, "
     "and the background",
     HSR_COMPARE, HSR_OF_CELL, HSR_OF_FACE, HSR_MASK_VISIT_OUTCOMES,
     .key = "polygon-cell"},
    {"finest cells", "of all these, those of the finest level", HSR_COMPARE,
     HSR_OF_CELL, HSR_OF_NOTHING, HSR_MASK_VISIT_OUTCOMES,
     .key = "finest-cell"},
    {"pixel cells", "of all these, those as large as a pixel or larger",
     HSR_COMPARE, HSR_OF_CELL, HSR_OF_NOTHING, HSR_MASK_VISIT_OUTCOMES,
     .key = "pixel-cell"},
    {"samples",
     "written by masks, each once; of a filtered "
     "picture, 64 a pixel, or 4096",
     HSR_ACCEPT, HSR_OF_FACE, HSR_OF_WINDOW, .key = "sample"},
    {"unsure samples", "decided by the exact predicates", HSR_SAMPLE,
     HSR_OF_FACE, HSR_OF_WINDOW, "not covered|covered"},
    {NULL}};

static const struct hsr_line cube_lines[] = {
    {"  is a vacant sample within the cube's silhouette?",
     HSR_RAISES(HSR_CUBES_TESTED)},
    {"    tile_poly the silhouette, to look and not to write",
     HSR_RAISES(HSR_CUBE_CELLS)},
    {"  if not, cull the cube", HSR_RAISES(HSR_CUBES_CULLED)},
    {NULL}};

static const struct hsr_line cell_lines[] = {
    {"    tile_poly(mask): build the polygon's mask; W = Cv & Pc, A = ~(W | Pv "
     "| Cc)",
     HSR_RAISES(HSR_POLYGON_CELLS)},
    {"      of a square of one or more pixels", HSR_RAISES(HSR_PIXEL_CELLS)},
    {"      of the finest level: W is a mask of samples",
     HSR_RAISES(HSR_FINEST_CELLS)},
    {"        ask exactly about samples too close to an edge",
     HSR_RAISES(HSR_SAMPLES_UNSURE)},
    {"      for each TRUE bit in A: tile_poly(the subcell's mask), propagate"},
    {NULL}};

static const struct hsr_line sample_lines[] = {
    {"    for each TRUE bit in W: display its samples",
     HSR_RAISES(HSR_SAMPLES_WRITTEN)},
    {NULL}};

const struct hsr_part hsr_tiling_part = {
    HSR_PART_TILING,
    counters,
    NULL,
    NULL,
    {cube_lines, cell_lines, sample_lines}};
