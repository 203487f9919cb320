/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells and portals: the potentially visible set, found for each view, or
 * beforehand for each cell.
 *
 * Source      D. Luebke and C. Georges, "Portals and mirrors: simple, fast
 *             evaluation of potentially visible sets", I3D 1995; as told by N.
 *             Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.6. With sets=cells
 *             what came before it, as told there: J. Airey, J. Rohlf and F.
 *             Brooks, I3D 1990; S. Teller and C. Sequin, SIGGRAPH 1991.
 * Notation    cull box -> the rectangle of samples that is seen through the
 *             portals passed so far; aggregate -> a cell's cull box, which
 *             holds all that it was reached by
 * Invariants  Every face that is visible at a sample is in a cell whose cull
 *             box holds the sample, or is not flat. So the set holds all that
 *             is visible. With sets=cells the cull boxes are the whole picture,
 *             of every cell that is seen from a start cell (cell_sets.h).
 * Ties        by hsr_nearer: the picture's order
 * Departures  A cell that is reached again is looked at again only if that
 *             widens its cull box; the box is then the rectangle around both.
 *             So the recursion ends soon where ways are many. Cells and portals
 *             are found in the scene (portals.h), since scenes name none. Faces
 *             that are not flat are in every set.
 * Cost        The cells that are seen, and what is in them.
 *
 * Start. A ray is followed from t = near, since walls before that do not exist.
 * The box around these points of the window's rays is in the cells from which
 * the recursion starts. A plane across an axis is then crossed from the eye's
 * side to the other, or not at all. */
#include "algorithms/algorithm.h"
#include "algorithms/hierarchical/culling/box_samples.h"
#include "algorithms/hierarchical/culling/cell_sets.h"
#include "algorithms/hierarchical/culling/portals.h"
#include "common/exact/screen.h"

#include <float.h>
#include <stdlib.h>

enum {
  STARTS,
  CELLS,
  PORTALS,
  FACES,
  OUTSIDE,
  DRAWN,
  DEPTHS,
  WRITES,
  OVERWRITES
};

enum { SETS };
enum { OF_VIEWS, OF_CELLS };
static const struct hsr_word sets[] = {
    {"views", "found for each view, as in 1995", 0},
    {"cells", "found for each cell beforehand, as in 1991", 0},
    {NULL}};
static const struct hsr_option options[] = {
    [SETS] = {"sets", "of what the potentially visible sets are", sets, 0, 1,
              OF_VIEWS},
    {NULL}};

struct prepared {
  struct hsr_portals portals;
  struct hsr_cell_sets sets;
};

struct pvs {
  const struct hsr_job *job;
  const struct hsr_cell_sets *sets; /* of cells; or NULL */
  const struct hsr_portals *portals;
  struct hsr_tally *tally;
  struct hsr_screen screen;
  struct hsr_bounds *seen;     /* a cell: its cull box; x0 = x1: not seen */
  struct hsr_growing waiting;  /* cells */
  bool *is_waiting, *is_drawn; /* a cell; a face */
  unsigned char *known;        /* a face */
  int *columns;
  bool out_of_memory;
};
enum { UNKNOWN, IN_SIGHT, NOT_IN_SIGHT };

static struct hsr_window window_of(const struct hsr_bounds *b) {
  return hsr_window_make(b->x0, b->y0, b->x1, b->y1);
}

/* --- Cells ---------------------------------------------------------------- */

/* Widens a cell's cull box. False if it holds this one already. */
static bool widen(struct pvs *s, uint32_t cell, const struct hsr_bounds *b) {
  struct hsr_bounds *seen = &s->seen[cell];
  bool is_new = seen->x0 == seen->x1;
  if (!is_new && seen->x0 <= b->x0 && seen->y0 <= b->y0 && seen->x1 >= b->x1 &&
      seen->y1 >= b->y1)
    return false;
  if (is_new)
    *seen = *b;
  seen->x0 = b->x0 < seen->x0 ? b->x0 : seen->x0;
  seen->y0 = b->y0 < seen->y0 ? b->y0 : seen->y0;
  seen->x1 = b->x1 > seen->x1 ? b->x1 : seen->x1;
  seen->y1 = b->y1 > seen->y1 ? b->y1 : seen->y1;
  if (s->is_waiting[cell])
    return true;
  if (!hsr_arena_grow(s->job->scratch, &s->waiting, sizeof cell)) {
    s->out_of_memory = true;
    return false;
  }
  ((uint32_t *)s->waiting.items)[s->waiting.n - 1] = cell;
  s->is_waiting[cell] = true;
  return true;
}

/* What is seen from a start cell, found beforehand. */
static void look_up(struct pvs *s, uint32_t from) {
  const struct hsr_window *w = &s->job->view->window;
  const struct hsr_bounds all = {w->x0, w->y0, w->x1, w->y1};
  for (uint32_t cell = 0; cell < s->sets->n_cells; cell++) {
    if (!hsr_cell_sees(s->sets, from, cell) ||
        s->seen[cell].x0 < s->seen[cell].x1)
      continue;
    s->seen[cell] = all;
    HSR_STEP(s->tally, CELLS, HSR_CELL(cell, HSR_NO_ID, 0), HSR_THE_WINDOW, *w,
             0);
  }
}

enum { IS_OUTSIDE, SEEN_BEFORE, IS_SEEN };

static void visit(struct pvs *s, uint32_t cell) {
  const struct hsr_portals *p = s->portals;
  const struct hsr_bounds all = s->seen[cell];
  struct hsr_subject here = HSR_CELL(cell, HSR_NO_ID, 0);
  HSR_STEP(s->tally, CELLS, here, HSR_THE_WINDOW, window_of(&all), 0);
  for (uint32_t k = p->first_portal[cell]; k < p->first_portal[cell + 1]; k++) {
    const struct hsr_portal *portal = &p->portal[p->of_cell[k]];
    bool upwards = portal->cell[0] == cell;
    double eye = s->job->view->eye[portal->axis];
    double at = portal->box.lo[portal->axis];
    if (!(upwards ? eye < at : eye > at))
      continue;
    struct hsr_bounds b = all;
    hsr_box_samples(s->job->view, &portal->box, &b);
    uint32_t beyond = portal->cell[upwards];
    int outcome = b.x0 >= b.x1 || b.y0 >= b.y1 ? IS_OUTSIDE
                  : widen(s, beyond, &b)       ? IS_SEEN
                                               : SEEN_BEFORE;
    HSR_STEP(s->tally, PORTALS, here, HSR_CELL(beyond, p->of_cell[k], 0),
             window_of(&b), outcome);
  }
}

static void start(void *context, uint32_t cell) {
  struct pvs *s = context;
  const struct hsr_window *w = &s->job->view->window;
  HSR_STEP(s->tally, STARTS, HSR_CELL(cell, HSR_NO_ID, 0), HSR_NOTHING,
           HSR_NOWHERE, 0);
  if (s->sets)
    look_up(s, cell);
  else
    widen(s, cell, &(struct hsr_bounds){w->x0, w->y0, w->x1, w->y1});
}

/* Holds the points at t = near of all rays of the window. */
static struct hsr_box start_box(const struct hsr_view *view) {
  struct hsr_box box = {{INFINITY, INFINITY, INFINITY},
                        {-INFINITY, -INFINITY, -INFINITY}};
  const struct hsr_window *w = &view->window;
  for (int corner = 0; corner < 4; corner++) {
    double sx = corner & 1 ? w->x1 : w->x0, sy = corner & 2 ? w->y1 : w->y0;
    for (int k = 0; k < 3; k++) {
      double a = view->ray[0][k], b = sx * view->ray[1][k],
             c = sy * view->ray[2][k];
      double along = view->parallel ? view->F[k] : a + b + c;
      double from = view->E[k] + (view->parallel ? a + b + c : 0);
      double size = fabs(a) + fabs(b) + fabs(c) + fabs(view->F[k]);
      double error =
          view->parallel || view->near > 0
              ? 0x1p-45 * (fabs(view->E[k]) + (1 + view->near) * size)
              : 0;
      box.lo[k] = fmin(box.lo[k], from + view->near * along - error);
      box.hi[k] = fmax(box.hi[k], from + view->near * along + error);
    }
  }
  return box;
}

/* --- Faces ---------------------------------------------------------------- */

static bool is_in_sight(struct pvs *s, uint32_t f) {
  if (s->known[f] == UNKNOWN) {
    hsr_screen_plane(&s->screen, f);
    s->known[f] =
        hsr_screen_place(&s->screen, f, s->tally) ? IN_SIGHT : NOT_IN_SIGHT;
  }
  return s->known[f] == IN_SIGHT;
}

static void write(struct pvs *s, uint32_t f, uint32_t *id, int i, int j) {
  HSR_TOUCH(s->tally, i, j);
  if (*id != HSR_BACKGROUND) {
    bool nearer = hsr_nearer(&s->screen, f, *id, i, j, s->tally);
    HSR_STEP(s->tally, DEPTHS, HSR_FACE(f), HSR_FACE(*id), HSR_AT(i, j),
             nearer);
    if (!nearer)
      return;
    HSR_STEP(s->tally, OVERWRITES, HSR_FACE(*id), HSR_FACE(f), HSR_AT(i, j), 0);
  }
  HSR_STEP(s->tally, WRITES, HSR_FACE(f), HSR_FACE(*id), HSR_AT(i, j), 0);
  *id = f;
}

static void draw(struct pvs *s, uint32_t f) {
  const struct hsr_bounds *b = &s->screen.bounds[f];
  HSR_STEP(s->tally, DRAWN, HSR_FACE(f), HSR_NOTHING, HSR_NOWHERE, 0);
  s->is_drawn[f] = true;
  for (int j = b->y0; j < b->y1; j++) {
    uint32_t *row = hsr_job_row(s->job, j);
    int n = hsr_face_spans(&s->screen, f, j, s->columns, s->tally);
    for (int c = 0; c < n; c += 2)
      for (int i = s->columns[c] > b->x0 ? s->columns[c] : b->x0;
           i < s->columns[c + 1] && i < b->x1; i++)
        write(s, f, &row[i], i, j);
  }
}

static void meet(struct pvs *s, uint32_t f, const struct hsr_bounds *box,
                 struct hsr_subject cell) {
  if (s->is_drawn[f])
    return;
  HSR_STEP(s->tally, FACES, HSR_FACE(f), cell, HSR_NOWHERE, 0);
  const struct hsr_bounds *b = &s->screen.bounds[f];
  if (is_in_sight(s, f) && b->x0 < box->x1 && box->x0 < b->x1 &&
      b->y0 < box->y1 && box->y0 < b->y1)
    draw(s, f);
  else
    HSR_STEP(s->tally, OUTSIDE, HSR_FACE(f), HSR_THE_WINDOW, window_of(box), 0);
}

static void draw_set(struct pvs *s) {
  const struct hsr_portals *p = s->portals;
  const struct hsr_window *w = &s->job->view->window;
  const struct hsr_bounds all = {w->x0, w->y0, w->x1, w->y1};
  for (uint32_t k = 0; k < p->n_loose; k++)
    meet(s, p->loose[k], &all, HSR_NOTHING);
  for (uint32_t c = 0; c < p->n_cells; c++) {
    const struct hsr_bounds *box = &s->seen[c];
    for (uint32_t k = p->first_face[c];
         box->x0 < box->x1 && k < p->first_face[c + 1]; k++)
      meet(s, p->face[k], box, HSR_CELL(c, HSR_NO_ID, 0));
  }
}

/* --- The algorithm -------------------------------------------------------- */

static enum hsr_status begin(struct pvs *s) {
  const struct hsr_job *job = s->job;
  const struct hsr_world *world = job->world;
  struct hsr_arena *arena = job->scratch;
  s->seen = HSR_NEW_ZEROED(arena, struct hsr_bounds, s->portals->n_cells);
  s->is_waiting = HSR_NEW_ZEROED(arena, bool, s->portals->n_cells);
  s->is_drawn = HSR_NEW_ZEROED(arena, bool, world->n_faces);
  s->known = HSR_NEW_ZEROED(arena, unsigned char, world->n_faces);
  s->columns = HSR_NEW(arena, int, hsr_most_corners(world) + 4);
  if (!s->seen || !s->is_waiting || !s->is_drawn || !s->known || !s->columns ||
      hsr_screen_init(&s->screen, world, job->view, arena))
    return HSR_E_NOMEM;
  hsr_screen_vertices(&s->screen);
  hsr_job_clear(job);
  return HSR_OK;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  const struct prepared *prepared = job->prepared;
  struct pvs s = {.job = job,
                  .sets =
                      job->option[SETS] == OF_CELLS ? &prepared->sets : NULL,
                  .portals = &prepared->portals,
                  .tally = job->tally};
  if (begin(&s))
    return hsr_fail_nomem(err);
  struct hsr_box box = start_box(job->view);
  hsr_portals_find(s.portals, &box, start, &s);
  while (s.waiting.n && !s.out_of_memory) {
    uint32_t cell = ((uint32_t *)s.waiting.items)[--s.waiting.n];
    s.is_waiting[cell] = false;
    visit(&s, cell);
  }
  if (s.out_of_memory)
    return hsr_fail_nomem(err);
  draw_set(&s);
  return HSR_OK;
}

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  struct prepared *made = calloc(1, sizeof *made);
  *prepared = made;
  if (!made || hsr_portals_init(&made->portals, world) ||
      (option[SETS] == OF_CELLS &&
       hsr_cell_sets_init(&made->sets, &made->portals, &made->portals.arena)))
    return hsr_fail_nomem(err);
  return HSR_OK;
}

static void release(void *object) {
  struct prepared *prepared = object;
  hsr_portals_free(&prepared->portals);
  free(prepared);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_counter counters[] = {
    [STARTS] = {"start cells", "cells in which rays start", HSR_ACTIVATE,
                HSR_OF_CELL, HSR_OF_NOTHING},
    [CELLS] = {"cells visited",
               "cells looked at, again if they are seen in "
               "more",
               HSR_ACTIVATE, HSR_OF_CELL, HSR_OF_WINDOW},
    [PORTALS] = {"portals",
                 "portals on the far side of a cell compared with "
                 "its cull box",
                 HSR_COMPARE, HSR_OF_CELL, HSR_OF_CELL,
                 "outside|seen before|seen"},
    [FACES] = {"faces met", "in cells that are seen, or not flat", HSR_ACTIVATE,
               HSR_OF_FACE, HSR_OF_CELL},
    [OUTSIDE] = {"faces outside",
                 "of these, outside of the cull box or out of "
                 "sight",
                 HSR_REJECT, HSR_OF_FACE, HSR_OF_WINDOW},
    [DRAWN] = {"faces drawn", "the potentially visible set", HSR_ACTIVATE,
               HSR_OF_FACE, HSR_OF_NOTHING},
    [DEPTHS] = {"depth tests", "depths compared with the recorded face's",
                HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    [WRITES] = {"writes", "samples written, overwrites counted each time",
                HSR_ACCEPT, HSR_OF_FACE, HSR_OF_FACE},
    [OVERWRITES] = {"overwrites", "writes where there was a face already",
                    HSR_RETIRE, HSR_OF_FACE, HSR_OF_FACE},
    {NULL}};

static const struct hsr_line outline[] = {
    {"for each cell in which the eye is", HSR_RAISES(STARTS)},
    {"visit a cell with a cull box, of the whole picture first; or each cell "
     "of the start cell's set",
     HSR_RAISES(CELLS)},
    {"  for each portal of the cell: does its rectangle meet the cull box?",
     HSR_RAISES(PORTALS)},
    {"    visit the cell beyond, with what is left of the box"},
    {"for each cell that was visited, for each face in it", HSR_RAISES(FACES)},
    {"  leave it if it is outside of the cell's cull box", HSR_RAISES(OUTSIDE)},
    {"  draw it into the z-buffer", HSR_RAISES(DRAWN)},
    {"    at each sample: is it nearer than the recorded face?",
     HSR_RAISES(DEPTHS)},
    {"      if so, record it", HSR_RAISES(WRITES)},
    {"        instead of another", HSR_RAISES(OVERWRITES)},
    {NULL}};

/* The cells; and each portal, by the cell beyond it and its own number. */
static void put_boxes(const void *prepared, const struct hsr_scene *scene,
                      hsr_take_box *put, void *to) {
  const struct hsr_portals *portals =
      &((const struct prepared *)prepared)->portals;
  (void)scene;
  for (uint32_t c = 0; c < portals->n_cells; c++)
    put(to, c, HSR_NO_ID, &portals->cell[c]);
  for (uint32_t k = 0; k < portals->n_portals; k++)
    for (int side = 0; side < 2; side++)
      put(to, portals->portal[k].cell[side], k, &portals->portal[k].box);
}

static void show(const void *prepared, struct hsr_shown *shown) {
  (void)prepared;
  shown->boxes = put_boxes;
}

const struct hsr_algorithm HSR_ALGORITHM(pvs) = {
    .name = "pvs",
    .title = "Cells and portals: potentially visible sets",
    .authors = "D. Luebke and C. Georges",
    .year = 1995,
    .source = "Luebke and Georges, I3D 1995; Greene, PhD thesis, UC Santa "
              "Cruz, 1995, 2.1.6",
    .taxonomy = HSR_HIERARCHICAL,
    .sort_order = "Z(XY)",
    .coherence = "of cells, in space",
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .counters = counters,
    .outline = outline,
    .options = options,
    .prepare = prepare,
    .render = render,
    .release = release,
    .show = show};
