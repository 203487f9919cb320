/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth-priority Warnock: Warnock's subdivision without lists, of polygons that
 * come one by one, from front to back.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 2.1; N. Greene, PhD thesis, UC Santa Cruz, 1995,
 *             4.3.1.
 * Notation    occupied, and the quadtree of such marks -> quadtree.h; inside,
 *             outside, intersecting -> side_of_cell
 * Invariant   all that comes later is behind what has been written; a cell is
 *             occupied just when all its samples are written, or outside the
 *             window
 * Ties        pieces in one plane: the lowest face comes first
 * Departures  A cell is also outside the polygon if the polygon's box holds
 *             none of its samples. Faces for which the tree has no place are
 *             compared in depth (bsp_frame.h).
 * Cost        The work grows with the number of cells that visible edges cross.
 */
#include "algorithms/engines/windows/quadtree.h"
#include "algorithms/engines/bsp/bsp_frame.h"

enum { CELLS, SUBDIVISIONS, SIDES };

struct warnock {
  struct hsr_bsp_frame frame;
  struct hsr_quadtree quadtree;
  uint32_t *visits[HSR_QUAD_LEVELS]; /* of cells; NULL: there is no work picture
                                      */
  struct hsr_bsp_side *side;         /* for all levels */

  /* The current polygon. */
  struct hsr_piece piece;
  bool is_asked; /* what it covers is asked sample by sample */
};

/* --- Cells ---------------------------------------------------------------- */

static bool is_inside(struct warnock *s, const struct hsr_bsp_side *side, int i,
                      int j) {
  return hsr_bsp_frame_inside(&s->frame, s->piece.face, side, i, j);
}

/* A side is a line on the screen. So if the four corner samples of a cell are
 * on one side of it, all of its samples are. */
enum where { OUTSIDE, INTERSECTING, INSIDE };
static enum where side_of_cell(struct warnock *s,
                               const struct hsr_bsp_side *side,
                               const struct hsr_bounds *b) {
  int n = is_inside(s, side, b->x0, b->y0);
  if (b->x1 - b->x0 > 1 || b->y1 - b->y0 > 1) {
    n += is_inside(s, side, b->x1 - 1, b->y0);
    if (n == 1)
      return INTERSECTING;
    n += is_inside(s, side, b->x0, b->y1 - 1);
    n += is_inside(s, side, b->x1 - 1, b->y1 - 1);
    return n == 0 ? OUTSIDE : n == 4 ? INSIDE : INTERSECTING;
  }
  return n ? INSIDE : OUTSIDE;
}

static void write_cell(struct warnock *s, const struct hsr_bounds *b) {
  for (int j = b->y0; j < b->y1; j++)
    for (int i = b->x0; i < b->x1; i++) {
      HSR_STEP(s->frame.job->tally, HSR_BSP_SAMPLES, HSR_FACE(s->piece.face),
               HSR_NOTHING, HSR_AT(i, j), 0);
      hsr_bsp_frame_row(&s->frame, j)[i] = s->piece.face;
    }
}

static inline struct hsr_window window_of(const struct hsr_bounds *b) {
  return hsr_window_make(b->x0, b->y0, b->x1, b->y1);
}

static bool misses(const struct hsr_bounds *a, const struct hsr_bounds *b) {
  return a->x0 >= b->x1 || b->x0 >= a->x1 || a->y0 >= b->y1 || b->y0 >= a->y1;
}

/* --- The algorithm -------------------------------------------------------- */

/* Inserts the polygon into a cell, which n of the polygon's sides may cross.
 * Behind these n there is room for those that cross the cell's quadrants. */
static void insert(struct warnock *s, int level, int x, int y,
                   const struct hsr_bsp_side *side, uint32_t n) {
  struct hsr_tally *tally = s->frame.job->tally;
  unsigned char *state = hsr_quad_state(&s->quadtree, level, x, y);
  if (*state == HSR_QUAD_COVERED)
    return;
  struct hsr_bounds samples = hsr_quad_samples(&s->quadtree, level, x, y);
  bool outside = misses(&samples, &s->piece.bounds);
  HSR_STEP(tally, CELLS, HSR_FACE(s->piece.face), HSR_CELL(level, x, y),
           window_of(&samples), !outside);
  if (HSR_COUNTING && s->visits[level])
    s->visits[level][hsr_quad_place(&s->quadtree, level, x, y)]++;
  if (outside)
    return;
  struct hsr_bsp_side *crossing = s->side + (side - s->side) + n;
  uint32_t n_crossing = 0;
  for (uint32_t k = 0; k < n; k++) {
    enum where where = side_of_cell(s, &side[k], &samples);
    HSR_STEP(tally, SIDES, hsr_bsp_side_subject(s->piece.face, &side[k]),
             HSR_CELL(level, x, y), window_of(&samples), (int)where);
    if (where == OUTSIDE)
      return;
    if (where == INTERSECTING)
      crossing[n_crossing++] = side[k];
  }
  if (level == 0 && s->is_asked &&
      !hsr_piece_covers(&s->frame.screen, s->piece.face, s->piece.cuts,
                        s->piece.n_cuts, samples.x0, samples.y0, tally))
    return;
  if (level == 0 ||
      (!n_crossing && !s->is_asked && *state == HSR_QUAD_VACANT)) {
    write_cell(s, &samples);
    *state = HSR_QUAD_COVERED;
    return;
  }
  HSR_STEP(tally, SUBDIVISIONS, HSR_FACE(s->piece.face), HSR_CELL(level, x, y),
           window_of(&samples), 0);
  for (int q = 0; q < 4; q++)
    insert(s, level - 1, 2 * x + q % 2, 2 * y + q / 2, crossing, n_crossing);
  *state = (unsigned char)hsr_quad_gather(&s->quadtree, level, x, y);
}

static void insert_piece(void *context, const struct hsr_bsp_piece *piece,
                         int facing) {
  struct warnock *s = context;
  if (!hsr_bsp_frame_piece(&s->frame, piece, &s->piece))
    return;
  uint32_t n = 0;
  s->is_asked = hsr_bsp_frame_is_asked(&s->frame, piece->face);
  if (!s->is_asked)
    n = hsr_bsp_frame_sides(&s->frame, piece, &s->piece, facing, s->side);
  insert(s, s->quadtree.n_levels - 1, 0, 0, s->side, n);
}

/* For the work picture. */
static enum hsr_status begin_visits(struct warnock *s) {
  const struct hsr_job *job = s->frame.job;
  for (int level = 0;
       level < s->quadtree.n_levels && HSR_COUNTING && job->tally->work;
       level++) {
    size_t row = (size_t)1 << (s->quadtree.n_levels - 1 - level);
    s->visits[level] = HSR_NEW_ZEROED(job->scratch, uint32_t, row * row);
    if (!s->visits[level])
      return HSR_E_NOMEM;
  }
  return HSR_OK;
}

/* A cell's visits are shared by its samples. */
static void share_visits(const struct warnock *s) {
  const struct hsr_window *w = &s->quadtree.window;
  struct hsr_tally *tally = s->frame.job->tally;
  for (int level = 0; level < s->quadtree.n_levels && s->visits[level]; level++)
    for (int j = w->y0; j < w->y1; j++)
      for (int i = w->x0; i < w->x1; i++) {
        int x = (i - w->x0) >> level, y = (j - w->y0) >> level;
        struct hsr_bounds b = hsr_quad_samples(&s->quadtree, level, x, y);
        tally->work[(size_t)j * tally->work_stride + (size_t)i] +=
            (float)s->visits[level][hsr_quad_place(&s->quadtree, level, x, y)] /
            (float)((b.x1 - b.x0) * (b.y1 - b.y0));
      }
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct warnock warnock = {.side = NULL}, *s = &warnock;
  if (hsr_bsp_frame_begin(&s->frame, job) ||
      hsr_quadtree_init(&s->quadtree, &job->view->window, job->scratch) ||
      begin_visits(s))
    return hsr_fail_nomem(err);
  s->side = HSR_NEW(job->scratch, struct hsr_bsp_side,
                    (size_t)s->frame.most_corners *
                        ((size_t)s->quadtree.n_levels + 1));
  if (!s->side)
    return hsr_fail_nomem(err);
  hsr_bsp_frame_walk(&s->frame, false, s, insert_piece);
  share_visits(s);
  hsr_bsp_frame_finish(&s->frame);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_bsp_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [CELLS] = {"cells", "cells visited that were not occupied", HSR_COMPARE,
               HSR_OF_FACE, HSR_OF_CELL, "outside the box|in the box"},
    [SUBDIVISIONS] = {"subdivisions", "of these, those that were subdivided",
                      HSR_SUBDIVIDE, HSR_OF_FACE, HSR_OF_CELL},
    [SIDES] = {"side tests", "sides of polygons compared with cells",
               HSR_COMPARE, HSR_OF_EDGE, HSR_OF_CELL,
               "outside|intersecting|inside"},
    {NULL}};

static const struct hsr_line outline[] = {
    {"for each piece of a polygon, in the order of the BSP tree, from the "
     "front",
     HSR_RAISES(HSR_BSP_PIECES)},
    {"  insert it into a cell, unless that is occupied: the root first",
     HSR_RAISES(CELLS)},
    {"    compare each side that crosses the enclosing cell with the cell",
     HSR_RAISES(SIDES)},
    {"      if the cell is outside of one, it has nothing of the polygon"},
    {"    if the cell is vacant, and inside of all, write its samples",
     HSR_RAISES(HSR_BSP_SAMPLES)},
    {"    else insert the polygon into its four quadrants",
     HSR_RAISES(SUBDIVISIONS)},
    {"      the cell is occupied if all of these are"},
    {"for each face without a place in the tree: compare it in depth at its "
     "samples",
     HSR_RAISES(HSR_BSP_THICKNESS)},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"faces", "Z", "BSP tree", "once for all frames"},
    {"pieces", "Z", "walk of the tree, from front to back", "once a frame"},
    {"windows", "XY", "quadtree", "once a piece"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(warnock_depth) = {
    .name = "warnock-depth",
    .title = "Depth-priority Warnock: subdivision from front to back",
    .authors = "N. Greene",
    .year = 1995,
    .source = "N. Greene, Hierarchical Rendering of Complex Environments, PhD "
              "thesis, UC Santa Cruz, 1995, 4.3.1",
    .taxonomy = HSR_IMAGE_SPACE_AREA,
    .sort_order = "Z(XY)",
    .coherence = "frame; area",
    .restrictions = HSR_CF,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .sorts = sorts,
    .parts = uses,
    .counters = counters,
    .outline = outline,
    .prepare = hsr_bsp_prepare,
    .render = render,
    .show = hsr_bsp_show,
    .release = hsr_bsp_release};
