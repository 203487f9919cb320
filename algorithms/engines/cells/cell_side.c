/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One side of a cell, on the rows of the window.
 *
 * A side is a flat rectangle, and the eye is strictly in front of it. So, if
 * its cell is safely before the eye, it is on the screen a convex quadrilateral
 * of positive area whose corners run clockwise as they do in the world. Its
 * edges that go down bound its rows on the right, those that go up on the left.
 * A row that passes no corner within HSR_DELTA meets one of each. The bounds of
 * the places where an edge crosses a row are those of common/exact/screen.c
 * ("Row sides", "Edge columns"): the same operations are done here. A sample
 * that is farther than that from both edges and all corners is decided.
 *
 * Where anything is not decided, or the cell is not safe, the whole side goes
 * to the services: it is laid out alone in a world of one face. */
#include "algorithms/engines/cells/cells.h"
#include "common/base/bits.h"

/* --- Samples -------------------------------------------------------------- */

static void paint_word(struct hsr_cells *cells, uint32_t face, int first, int j,
                       uint64_t vacant) {
  uint32_t *row = hsr_job_row(cells->job, j);
  for (; vacant; vacant &= vacant - 1) {
    int i = first + hsr_first_bit(vacant);
    HSR_TOUCH(cells->tally, i, j);
    HSR_STEP(cells->tally, HSR_CELLS_WRITES, HSR_FACE(face), HSR_THE_WINDOW,
             HSR_AT(i, j), 0);
    row[i] = face;
    cells->n_vacant--;
  }
}

/* Samples of a word that are asked for and not vacant. */
static void pass_over(struct hsr_cells *cells, uint32_t face, int first, int j,
                      uint64_t taken) {
  const uint32_t *row = hsr_job_row(cells->job, j);
  for (; HSR_COUNTING && taken; taken &= taken - 1) {
    int i = first + hsr_first_bit(taken);
    HSR_TOUCH(cells->tally, i, j);
    HSR_STEP(cells->tally, HSR_CELLS_OCCUPIED, HSR_FACE(face), HSR_FACE(row[i]),
             HSR_AT(i, j), 0);
  }
}

/* Gives the vacant ones of the samples [x0, x1) of row j to a face. */
static void fill_span(struct hsr_cells *cells, uint32_t face, int x0, int x1,
                      int j) {
  const struct hsr_window *w = &cells->window;
  uint64_t *row = cells->vacant + (size_t)(j - w->y0) * cells->words;
  unsigned from = (unsigned)(x0 - w->x0), to = (unsigned)(x1 - 1 - w->x0);
  for (unsigned k = from / 64; k <= to / 64; k++) {
    uint64_t asked = ~UINT64_C(0);
    if (k == from / 64)
      asked &= ~UINT64_C(0) << from % 64;
    if (k == to / 64)
      asked &= ~UINT64_C(0) >> (63 - to % 64);
    int first = w->x0 + (int)(64 * k);
    pass_over(cells, face, first, j, asked & ~row[k]);
    paint_word(cells, face, first, j, asked & row[k]);
    row[k] &= ~asked;
  }
}

static void paint_span(struct hsr_cells *cells, uint32_t face, int x0, int x1,
                       int j) {
  uint32_t *row = hsr_job_row(cells->job, j);
  for (int i = x0; i < x1; i++) {
    HSR_TOUCH(cells->tally, i, j);
    HSR_STEP(cells->tally, HSR_CELLS_WRITES, HSR_FACE(face), HSR_THE_WINDOW,
             HSR_AT(i, j), 0);
    row[i] = face;
  }
}

/* The samples [x0, x1) of row j, as far as they are in the window. */
static inline void show_span(struct hsr_cells *cells, uint32_t face, int x0,
                             int x1, int j) {
  const struct hsr_window *w = &cells->window;
  x0 = x0 > w->x0 ? x0 : w->x0;
  x1 = x1 < w->x1 ? x1 : w->x1;
  if (x0 >= x1)
    return;
  HSR_STEP(cells->tally, HSR_CELLS_SPANS, HSR_FACE(face), HSR_THE_WINDOW,
           HSR_ON(x0, x1, j), 0);
  if (cells->front)
    fill_span(cells, face, x0, x1, j);
  else
    paint_span(cells, face, x0, x1, j);
}

/* --- By the services ------------------------------------------------------ */

enum hsr_status hsr_cells_begin_sides(struct hsr_cells *cells) {
  struct hsr_lone_side *s = &cells->lone;
  s->start[0] = 0;
  s->start[1] = 4;
  for (uint32_t k = 0; k < 4; k++)
    s->vertex[k] = k;
  s->one_sided = true;
  double *p = s->plane;
  s->world = (struct hsr_world){.n_faces = 1,
                                .roster.scene = cells->job->world->roster.scene,
                                .mesh = {.n_vertices = 4,
                                         .n_corners = 4,
                                         .x = s->x,
                                         .y = s->y,
                                         .z = s->z,
                                         .start = s->start,
                                         .vertex = s->vertex,
                                         .one_sided = &s->one_sided,
                                         .nx = p,
                                         .ny = p + 1,
                                         .nz = p + 2,
                                         .n_error = p + 3,
                                         .px = p + 4,
                                         .py = p + 5,
                                         .pz = p + 6,
                                         .anchor_error = p + 7,
                                         .deviation = p + 8}};
  return hsr_screen_init(&s->screen, &s->world, cells->job->view,
                         cells->job->scratch);
}

bool hsr_cells_lay_out(struct hsr_cells *cells, const uint32_t at[3],
                       int side) {
  struct hsr_lone_side *s = &cells->lone;
  struct hsr_tally *tally = cells->tally;
  double corner[4][3];
  hsr_grid_corners(cells->grid, at, side, corner);
  for (int k = 0; k < 4; k++) {
    s->x[k] = corner[k][0];
    s->y[k] = corner[k][1];
    s->z[k] = corner[k][2];
  }
  hsr_world_find_plane(&s->world, 0, &tally->out_of_memory);
  hsr_screen_vertices(&s->screen);
  hsr_screen_plane(&s->screen, 0);
  return hsr_screen_place(&s->screen, 0, tally);
}

static void draw_generally(struct hsr_cells *cells, const uint32_t at[3],
                           int side, uint32_t face) {
  const struct hsr_screen *screen = &cells->lone.screen;
  int columns[8];
  if (!hsr_cells_lay_out(cells, at, side))
    return;
  const struct hsr_bounds *b = &screen->bounds[0];
  for (int j = b->y0; j < b->y1; j++) {
    int n = hsr_face_spans(screen, 0, j, columns, cells->tally);
    for (int k = 0; k < n; k += 2)
      show_span(cells, face, columns[k], columns[k + 1], j);
  }
}

/* --- By the filter -------------------------------------------------------- */

/* The whole part of v, with the rest. The rounding of the one is 2^-37 at most,
 * and a rest so near to 0 or 1 is open anyway. */
static inline int split(double v, double *rest) {
  int whole = hsr_cells_whole(v);
  *rest = v - whole;
  return whole;
}

static inline bool is_open(double rest, double tolerance) {
  return !(rest > tolerance && 1 - rest > tolerance);
}

/* Corners on the screen, clockwise, and the first row below each. */
struct outline {
  double x[4], y[4];
  int row[4];
};

static inline bool find_rows(const struct hsr_cells *cells, int side,
                             const struct hsr_cell_box *box,
                             struct outline *o) {
  double first = hsr_sample_y(cells->job->view, 0), rest;
  bool open = false;
  for (int k = 0; k < 4; k++) {
    o->x[k] = box->sx[cells->corner[side][k]];
    o->y[k] = box->sy[cells->corner[side][k]];
    o->row[k] = split(o->y[k] - first, &rest) + 1;
    open |= is_open(rest, HSR_DELTA);
  }
  return !open;
}

/* The first columns right of the edge from corner a down to b, by row, as far
 * as they are in the window. False if one is open. */
static inline bool follow_edge(const struct hsr_cells *cells,
                               const struct outline *o, int a, int b,
                               int *column) {
  const struct hsr_view *view = cells->job->view;
  const struct hsr_window *w = &cells->window;
  int from = o->row[a] > w->y0 ? o->row[a] : w->y0;
  int to = o->row[b] < w->y1 ? o->row[b] : w->y1;
  double dx = o->x[b] - o->x[a], dy = o->y[b] - o->y[a];
  double slope = dx / dy, x = o->x[a] - slope * o->y[a];
  double tolerance = 4 * HSR_DELTA * (1 + fabs(slope));
  double first = hsr_sample_x(view, 0), rest;
  bool open = !(dy >= 16 * HSR_DELTA);
  for (int j = from; j < to && !open; j++) {
    double at = x + slope * hsr_sample_y(view, j) - first;
    column[j] = split(at, &rest) + 1;
    open = is_open(rest, tolerance);
  }
  return !open;
}

/* False if the filter leaves something open; then nothing is drawn. */
static bool draw_safely(struct hsr_cells *cells, int side, uint32_t face,
                        const struct hsr_cell_box *box) {
  struct outline o;
  if (!find_rows(cells, side, box, &o))
    return false;
  const struct hsr_window *w = &cells->window;
  int top = w->y1, bottom = w->y0;
  for (int a = 0; a < 4; a++) {
    int b = (a + 1) & 3;
    if (o.row[a] < o.row[b] && !follow_edge(cells, &o, a, b, cells->hi))
      return false;
    if (o.row[a] > o.row[b] && !follow_edge(cells, &o, b, a, cells->lo))
      return false;
    top = o.row[a] < top ? o.row[a] : top;
    bottom = o.row[a] > bottom ? o.row[a] : bottom;
  }
  top = top > w->y0 ? top : w->y0;
  bottom = bottom < w->y1 ? bottom : w->y1;
  for (int j = top; j < bottom; j++)
    show_span(cells, face, cells->lo[j], cells->hi[j], j);
  return true;
}

void hsr_cells_draw(struct hsr_cells *cells, const uint32_t at[3], int side,
                    uint32_t face, const struct hsr_cell_box *box) {
  HSR_STEP(cells->tally, HSR_CELLS_SIDES, HSR_FACE(face), HSR_NOTHING,
           HSR_NOWHERE, 0);
  if (!box->is_safe || !draw_safely(cells, side, face, box))
    draw_generally(cells, at, side, face);
}
