/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sheet buffer: the splats of a slice of the grid are added, and the slices
 * are composited from back to front.
 *
 * Source      L. Westover, "Footprint Evaluation for Volume Rendering",
 *             SIGGRAPH 1990; J. E. Swan II, PhD thesis, Ohio State University,
 *             1998, 1.2.2
 * Place       list priority over clusters: a sheet is a cluster within which
 *             nothing is hidden.
 * Cost        as splats.h, and the pixels of each sheet's rectangle
 *
 * Notation, invariant, ties, further departures are those of splats.h. */
#include "algorithms/engines/splats/splats.h"
#include "common/answers/kinds/composited.h"

#include <math.h>

struct model {
  struct hsr_splat_picture picture, sheet;
  struct hsr_window drawn; /* of the sheet */
};

static enum hsr_status open(struct hsr_splats *s, struct hsr_splat_tile *tile) {
  struct model *m = tile->model;
  m->drawn = hsr_splats_none(&tile->window);
  return hsr_splats_open(s, tile, &m->picture) ||
                 hsr_splats_open_sums(s, tile, &m->sheet)
             ? HSR_E_NOMEM
             : HSR_OK;
}

static void draw(struct hsr_splats *s, struct hsr_splat_tile *tile,
                 const struct hsr_placed *p) {
  struct model *m = tile->model;
  hsr_splats_widen(&m->drawn, &p->box);
  hsr_splats_put(s, p, &m->sheet, m->sheet.sum ? HSR_PUT_SUM : HSR_PUT_ADD);
}

/* The axis whose slices are most parallel to the view plane. */
static int sheet_axis(const struct hsr_view *view) {
  int axis = 0;
  for (int a = 1; a < 3; a++)
    if (fabs(view->F[a]) > fabs(view->F[axis]))
      axis = a;
  return axis;
}

static void fold(struct hsr_splats *s, struct hsr_splat_tile *tile) {
  struct model *m = tile->model;
  hsr_splats_fold(s, &m->sheet, &m->drawn, &m->picture);
  m->drawn = hsr_splats_none(&tile->window);
}

static void finish(struct hsr_splats *s, struct hsr_splat_tile *tile) {
  hsr_splats_finish(s, &((struct model *)tile->model)->picture);
}

static const struct hsr_splats_module how = {
    .size = sizeof(struct model), .open = open, .draw = draw, .fold = fold};

static enum hsr_status draw_frame(const struct hsr_job *job,
                                  struct hsr_error *err) {
  struct hsr_splats s;
  int axis = sheet_axis(job->view);
  if (hsr_splats_begin(&s, job) || hsr_splats_divide(&s, &how) ||
      hsr_splats_open_slices(&s, axis))
    return hsr_fail_nomem(err);
  uint32_t n = s.grid->n[axis],
           near = (uint32_t)(hsr_splats_split(&s, axis) + 1);
  s.visits = 2;
  enum hsr_status status =
      hsr_splats_visit_slices(&s, axis, n - 1, n - near, -1, err);
  if (!status)
    status = hsr_splats_visit_slices(&s, axis, 0, near, 1, err);
  hsr_splats_each(&s, finish);
  return status;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return hsr_splats_accumulate(job, draw_frame, err);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_splats_part}, {&hsr_folds_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"choose the slices most parallel to the view plane"},
    {"for each slice, from back to front"},
    {"  for each row of samples; is its box out of the window? leave it",
     HSR_RAISES(HSR_SPLAT_ROWS)},
    {"    for each sample of it that is kept", HSR_RAISES(HSR_SPLAT_CELLS)},
    {"      find its footprint; is it out of sight? leave it",
     HSR_RAISES(HSR_SPLAT_SPLATS)},
    {"      add weight times colour to the sheet, a pixel at a time",
     HSR_RAISES(HSR_SPLAT_UPDATES)},
    {"  put the sheet over the picture", HSR_RAISES(HSR_SPLAT_FOLDS)},
    {"write the pixels that are not empty", HSR_RAISES(HSR_SPLAT_WRITES)},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(splat_sheet) = {
    .name = "splat-sheet",
    .title = "Splatting with a sheet buffer",
    .authors = "L. Westover",
    .year = 1990,
    .source = "Westover, Footprint Evaluation for Volume Rendering, SIGGRAPH "
              "1990; Swan, Object-Order Rendering of Discrete Objects, PhD "
              "thesis, Ohio State University, 1998",
    .sort_order = "Z(XY)",
    .taxonomy = HSR_VOLUME_SPACE,
    .coherence = "object",
    .subjects = 1 << HSR_GRID,
    .makes = {{HSR_COMPOSITED, 1 << HSR_SHEET}},
    .flags = HSR_INSTANCED | HSR_OWN_TILES,
    .parts = uses,
    .outline = outline,
    .render = render};
