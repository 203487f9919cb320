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

static void draw(struct hsr_splats *s, const struct hsr_placed *p) {
  struct model *m = s->model;
  hsr_splats_widen(&m->drawn, &p->box);
  hsr_splats_put(s, p, &m->sheet, HSR_PUT_ADD);
}

/* The axis whose slices are most parallel to the view plane. */
static int sheet_axis(const struct hsr_view *view) {
  int axis = 0;
  for (int a = 1; a < 3; a++)
    if (fabs(view->F[a]) > fabs(view->F[axis]))
      axis = a;
  return axis;
}

static void draw_sheet(struct hsr_splats *s, int axis, uint32_t k) {
  struct model *m = s->model;
  m->drawn = hsr_splats_none(s);
  hsr_splats_visit_slice(s, axis, k);
  hsr_splats_fold(s, &m->sheet, &m->drawn, &m->picture);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_splats s;
  struct model m;
  int axis = sheet_axis(job->view);
  if (hsr_splats_begin(&s, job) || hsr_splats_open(&s, &m.picture) ||
      hsr_splats_open(&s, &m.sheet) || hsr_splats_open_slices(&s, axis))
    return hsr_fail_nomem(err);
  s.model = &m;
  s.draw = draw;
  int64_t n = s.grid->n[axis], q = hsr_splats_split(&s, axis);
  for (int64_t k = n - 1; k > q; k--)
    draw_sheet(&s, axis, (uint32_t)k);
  for (int64_t k = 0; k <= q; k++)
    draw_sheet(&s, axis, (uint32_t)k);
  hsr_splats_finish(&s, &m.picture);
  return HSR_OK;
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
    .flags = HSR_INSTANCED,
    .parts = uses,
    .outline = outline,
    .render = render};
