/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/brute_force/zbuffer_fast/light_view.h"

#include <math.h>

enum {
  LEAST_CELLS = 8,
  MOST_CELLS = 256,
  WIDE = 16, /* a face is wide if it meets more than 1 of so many cells */
  MOST_LOOKED_AT = 4 /* cells that may hold the image of a point */
};

/* Cells [x0, x1] x [y0, y1] of a side; none if x0 > x1 or y0 > y1. */
struct cells {
  int x0, y0, x1, y1;
};

/* The cell of a coordinate, one beyond either end being the last. */
static int cell_of(const struct hsr_light_view *v,
                   const struct hsr_light_side *side, int axis, double at) {
  double cell = (at - side->low[axis]) * side->scale[axis];
  return cell < 0 ? -1 : cell < v->cells ? (int)cell : v->cells;
}

static int within(const struct hsr_light_view *v, int cell) {
  return cell < 0 ? 0 : cell < v->cells ? cell : v->cells - 1;
}

/* The cells that a box meets. They do not descend from a coordinate to a
 * greater one, rounding or not. So two boxes that meet have a cell in common.
 */
static struct cells cells_of(const struct hsr_light_view *v,
                             const struct hsr_light_side *side,
                             const struct hsr_light_box *box) {
  return (struct cells){within(v, cell_of(v, side, 0, box->low[0])),
                        within(v, cell_of(v, side, 1, box->low[1])),
                        within(v, cell_of(v, side, 0, box->high[0])),
                        within(v, cell_of(v, side, 1, box->high[1]))};
}

/* --- Making it ------------------------------------------------------------ */

/* The cells of a sun's picture hold all boxes that are bounded. */
static void bound_sun(struct hsr_light_view *v,
                      const struct hsr_light_box *box) {
  double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
  for (uint32_t k = 0; k < v->shadow.n_blockers; k++)
    for (int c = 0; c < 2; c++) {
      low[c] = isfinite(box[k].low[c]) ? fmin(low[c], box[k].low[c]) : low[c];
      high[c] =
          isfinite(box[k].high[c]) ? fmax(high[c], box[k].high[c]) : high[c];
    }
  for (int c = 0; c < 2; c++) {
    bool any = low[c] < high[c] && isfinite(v->cells / (high[c] - low[c]));
    v->side[0].low[c] = any ? low[c] : 0;
    v->side[0].scale[c] = any ? v->cells / (high[c] - low[c]) : 1;
  }
}

static void bound_side(struct hsr_light_view *v, int s) {
  for (int c = 0; c < 2; c++) {
    v->side[s].low[c] = -1;
    v->side[s].scale[c] = v->cells / 2.0;
  }
}

static bool is_wide(const struct hsr_light_view *v, struct cells c) {
  return (c.x1 - c.x0 + 1) * (c.y1 - c.y0 + 1) > v->cells * v->cells / WIDE;
}

static void add(struct hsr_light_list *list, uint32_t f) {
  if (list->face)
    list->face[list->n] = f;
  list->n++;
}

/* Adds face f to what it meets on side s; the steps are counted when there is
 * room for it. */
static void add_face(struct hsr_light_view *v, int s, uint32_t f,
                     const struct hsr_light_box *box) {
  struct hsr_light_side *side = &v->side[s];
  struct hsr_tally *tally = v->shadow.job->tally;
  struct cells c = cells_of(v, side, box);
  if (is_wide(v, c)) {
    if (side->wide.face)
      HSR_STEP(tally, HSR_LIGHT_WIDE, HSR_FACE(f), HSR_NOTHING, HSR_NOWHERE, 0);
    add(&side->wide, f);
    return;
  }
  for (int y = c.y0; y <= c.y1; y++)
    for (int x = c.x0; x <= c.x1; x++) {
      struct hsr_light_list *list = &side->cell[y * v->cells + x];
      if (list->face)
        HSR_STEP(tally, HSR_LIGHT_CELLS, HSR_FACE(f), HSR_CELL(s, x, y),
                 HSR_NOWHERE, 0);
      add(list, f);
    }
}

static void add_faces(struct hsr_light_view *v, int s, const bool *seen,
                      const struct hsr_light_box *box) {
  for (uint32_t k = 0; k < v->shadow.n_blockers; k++)
    if (seen[k])
      add_face(v, s, v->shadow.blocker[k], &box[k]);
}

/* Makes room for as many faces as a list has counted, and empties it. */
static bool make_room(struct hsr_light_list *list, struct hsr_arena *arena) {
  list->face = HSR_NEW(arena, uint32_t, list->n + 1);
  list->n = 0;
  return list->face;
}

/* Sees one side: the lists are counted, and then filled. */
static enum hsr_status see_side(struct hsr_light_view *v, int s, bool *seen,
                                struct hsr_light_box *box) {
  struct hsr_arena *arena = v->shadow.job->scratch;
  struct hsr_light_side *side = &v->side[s];
  size_t n_cells = (size_t)v->cells * (size_t)v->cells;
  side->cell = HSR_NEW_ZEROED(arena, struct hsr_light_list, n_cells);
  if (!side->cell)
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < v->shadow.n_blockers; k++)
    seen[k] = hsr_light_sees(&v->shadow.lighting, v->shadow.blocker[k], s, 0,
                             &box[k]);
  if (hsr_light_sides(&v->shadow.lighting) == 1)
    bound_sun(v, box);
  else
    bound_side(v, s);
  add_faces(v, s, seen, box);
  for (size_t k = 0; k < n_cells; k++)
    if (!make_room(&side->cell[k], arena))
      return HSR_E_NOMEM;
  if (!make_room(&side->wide, arena))
    return HSR_E_NOMEM;
  add_faces(v, s, seen, box);
  return HSR_OK;
}

/* About as many cells as the window has samples, or as there are faces. */
static int choose_cells(const struct hsr_light_view *v) {
  const struct hsr_window *w = &v->shadow.job->view->window;
  double samples = (double)(w->x1 - w->x0) * (w->y1 - w->y0);
  double most = fmin(samples, 4.0 * v->shadow.n_blockers);
  return (int)fmax(LEAST_CELLS, fmin(MOST_CELLS, sqrt(most)));
}

enum hsr_status hsr_light_view_begin(struct hsr_light_view *view,
                                     const struct hsr_job *job,
                                     const struct hsr_screen *screen) {
  *view = (struct hsr_light_view){0};
  if (hsr_shadow_begin(&view->shadow, job, screen))
    return HSR_E_NOMEM;
  uint32_t n = view->shadow.n_blockers;
  bool *seen = HSR_NEW(job->scratch, bool, n + 1);
  struct hsr_light_box *box =
      HSR_NEW(job->scratch, struct hsr_light_box, n + 1);
  view->cells = choose_cells(view);
  if (!seen || !box)
    return HSR_E_NOMEM;
  for (int s = 0; s < hsr_light_sides(&view->shadow.lighting); s++)
    if (see_side(view, s, seen, box))
      return HSR_E_NOMEM;
  return HSR_OK;
}

/* --- Looking it up -------------------------------------------------------- */

/* Whether a face of the list blocks the light; it becomes the first. */
static bool blocked_by(struct hsr_light_view *v, struct hsr_light_list *list,
                       const struct hsr_lit_point *point, int i, int j) {
  uint32_t k = hsr_shadow_test(&v->shadow, point, i, j, list->face, list->n);
  if (k == list->n)
    return false;
  uint32_t blocker = list->face[k];
  list->face[k] = list->face[0];
  list->face[0] = blocker;
  return true;
}

/* All faces are tested where the image of the point cannot be told. */
static bool blocked_by_any(struct hsr_light_view *v,
                           const struct hsr_lit_point *point, int i, int j) {
  return hsr_shadow_test(&v->shadow, point, i, j, v->shadow.blocker,
                         v->shadow.n_blockers) < v->shadow.n_blockers;
}

static bool is_blocked(struct hsr_light_view *v,
                       const struct hsr_lit_point *point, int i, int j) {
  struct hsr_light_box image;
  int s = hsr_light_image(&v->shadow.lighting, point, &image);
  if (s < 0)
    return blocked_by_any(v, point, i, j);
  struct hsr_light_side *side = &v->side[s];
  struct cells c = cells_of(v, side, &image);
  if ((c.x1 - c.x0 + 1) * (c.y1 - c.y0 + 1) > MOST_LOOKED_AT)
    return blocked_by_any(v, point, i, j);
  for (int y = c.y0; y <= c.y1; y++)
    for (int x = c.x0; x <= c.x1; x++)
      if (blocked_by(v, &side->cell[y * v->cells + x], point, i, j))
        return true;
  return blocked_by(v, &side->wide, point, i, j);
}

void hsr_light_view_show(struct hsr_light_view *view) {
  const struct hsr_job *job = view->shadow.job;
  const struct hsr_window *w = &job->view->window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      uint32_t f = hsr_job_row(job, j)[i];
      struct hsr_lit_point point;
      if (f == HSR_BACKGROUND ||
          !hsr_shadow_faces(&view->shadow, f, HSR_AT(i, j)))
        continue;
      hsr_lit_point_find(&view->shadow.lighting, f, i, j, &point);
      if (!is_blocked(view, &point, i, j))
        hsr_shadow_lit(&view->shadow, f, i, i + 1, j);
    }
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"light cells", "faces put into cells of the light's picture", HSR_SORT,
     HSR_OF_FACE, HSR_OF_CELL},
    {"wide faces", "faces kept for a whole side of the light's picture",
     HSR_SORT, HSR_OF_FACE, HSR_OF_NOTHING},
    {NULL}};

static const struct hsr_line lines[] = {
    {"with shadows: put each face into the cells that it meets, as the "
     "light sees it",
     HSR_RAISES(HSR_LIGHT_CELLS)},
    {"  or keep it for its side, if these are too many",
     HSR_RAISES(HSR_LIGHT_WIDE)},
    {"for each visible sample"},
    {"  ", .part = &hsr_shadow_part, .group = HSR_SHADOW_FACING_LINES},
    {"    for each face of its cell, and then of its side"},
    {"      ", .part = &hsr_shadow_part, .group = HSR_SHADOW_LINES},
    {NULL}};

const struct hsr_part hsr_light_view_part = {
    HSR_PART_LIGHT_VIEW, counters, NULL, NULL, {lines}};
