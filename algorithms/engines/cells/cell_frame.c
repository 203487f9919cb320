/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of the grid in order, row by row, and which of them are drawn. */
#include "algorithms/engines/cells/cells.h"
#include "common/base/bits.h"

#include <string.h>

static const struct hsr_word off_on[] = {
    {"off", "back to front, each cell over those drawn before", 0},
    {"on", "front to back, where samples are vacant", 0},
    {NULL, NULL, 0}};

/* In the order of hsr_grid_nesting. */
static const struct hsr_word nestings[] = {
    {"zyx", "z in the outermost loop, x in the innermost", 0},
    {"zxy", "likewise", 0},
    {"yzx", "likewise", 0},
    {"yxz", "likewise", 0},
    {"xzy", "likewise", 0},
    {"xyz", "likewise", 0},
    {NULL, NULL, 0}};

const struct hsr_option hsr_cells_front[] = {
    [HSR_CELLS_FRONT] = {"front", "in which order cells are visited", off_on, 0,
                         1, 0},
    {NULL}};
const struct hsr_option hsr_cells_nested[] = {
    [HSR_CELLS_FRONT] = {"front", "in which order cells are visited", off_on, 0,
                         1, 0},
    [HSR_CELLS_NESTING] = {"nesting", "how the three loops are nested",
                           nestings, 0, 5, 0},
    {NULL}};

/* --- Beginning ------------------------------------------------------------ */

/* How the grid is seen. In parallel projection the eye is infinitely far away,
 * and above or below all (common/view/view.h). */
static struct hsr_grid_seen see(const struct hsr_cells *cells) {
  const struct hsr_grid *grid = cells->grid;
  const struct hsr_view *view = cells->job->view;
  struct hsr_grid_seen seen = {.high_first = false};
  for (int a = 0; a < 3; a++) {
    seen.n[a] = grid->n[a];
    seen.q[a] = hsr_grid_split(grid->bound[a], grid->n[a], view->eye[a]);
    seen.toward[a] = view->F[a];
    seen.at[a] = grid->at[a];
  }
  return seen;
}

/* The sides across axis a of cell k of the axis that face the eye. A side lies
 * in the plane of a bound, which is a double: so the comparison is exact. */
static uint8_t facing_sides(const struct hsr_cells *cells, int a, uint32_t k) {
  const double *bound = cells->grid->bound[a] + k;
  double eye = cells->job->view->eye[a];
  return (uint8_t)((eye < bound[0]) << 2 * a | (eye > bound[1]) << (2 * a + 1));
}

static enum hsr_status allocate_terms(struct hsr_cells *cells) {
  struct hsr_arena *arena = cells->job->scratch;
  bool all = true;
  for (int a = 0; a < 3; a++) {
    size_t n = (size_t)cells->grid->n[a] + 1;
    for (int c = 0; c < 4; c++)
      all &= (cells->term[a][c] = HSR_NEW(arena, double, n)) != NULL;
    cells->far[a] = HSR_NEW(arena, double, n);
    cells->facing[a] = HSR_NEW(arena, uint8_t, n);
    all &= cells->far[a] && cells->facing[a];
  }
  return all ? HSR_OK : HSR_E_NOMEM;
}

static enum hsr_status allocate(struct hsr_cells *cells) {
  struct hsr_arena *arena = cells->job->scratch;
  const struct hsr_grid *grid = cells->grid;
  const struct hsr_window *w = &cells->window;
  cells->words = (size_t)(w->x1 - w->x0 + 63) / 64;
  cells->vacant =
      HSR_NEW(arena, uint64_t, cells->words * (size_t)(w->y1 - w->y0));
  cells->lo = HSR_NEW(arena, int, (size_t)w->y1);
  cells->hi = HSR_NEW(arena, int, (size_t)w->y1);
  cells->cursor = HSR_NEW(arena, uint32_t, (size_t)grid->n[1] * grid->n[2]);
  return cells->vacant && cells->lo && cells->hi && cells->cursor ? HSR_OK
                                                                  : HSR_E_NOMEM;
}

static void find_corners_of_sides(struct hsr_cells *cells) {
  for (int side = 0; side < 6; side++) {
    uint32_t corner[4][3];
    hsr_grid_corner_places((const uint32_t[3]){0, 0, 0}, side, corner);
    for (int k = 0; k < 4; k++) {
      const uint32_t *c = corner[3 - k];
      cells->corner[side][k] = (uint8_t)(c[0] | c[1] << 1 | c[2] << 2);
    }
  }
}

static void clear_ids(const struct hsr_cells *cells) {
  const struct hsr_job *job = cells->job;
  const struct hsr_window *w = &cells->window;
  for (int j = w->y0; j < w->y1; j++)
    memset(hsr_job_row(job, j) + (size_t)w->x0, 0xff,
           (size_t)(w->x1 - w->x0) * sizeof *job->answer->ids);
}

enum hsr_status hsr_cells_begin(struct hsr_cells *cells,
                                const struct hsr_job *job) {
  const struct hsr_grid *grid = job->world->roster.scene->grid;
  *cells = (struct hsr_cells){.job = job,
                              .grid = grid,
                              .tally = job->tally,
                              .window = job->view->window};
  if (allocate_terms(cells) || hsr_cells_begin_sides(cells))
    return HSR_E_NOMEM;
  hsr_cells_project(cells);
  for (int a = 0; a < 3; a++)
    for (uint32_t k = 0; k < grid->n[a]; k++)
      cells->facing[a][k] = facing_sides(cells, a, k);
  find_corners_of_sides(cells);
  clear_ids(cells);
  return HSR_OK;
}

static enum hsr_status begin(struct hsr_cells *cells,
                             const struct hsr_job *job) {
  if (hsr_cells_begin(cells, job) || allocate(cells))
    return HSR_E_NOMEM;
  const struct hsr_grid *grid = cells->grid;
  const struct hsr_window *w = &cells->window;
  size_t height = (size_t)(w->y1 - w->y0);
  cells->front = job->option[HSR_CELLS_FRONT];
  memcpy(cells->cursor, grid->row,
         (size_t)grid->n[1] * grid->n[2] * sizeof *cells->cursor);
  memset(cells->vacant, 0xff, cells->words * height * sizeof *cells->vacant);
  cells->n_vacant = (uint64_t)(w->x1 - w->x0) * height;
  return HSR_OK;
}

/* --- Drawing -------------------------------------------------------------- */

/* The first face of a cell of row `row`. It is counted on from the cell that
 * was last asked for, or from an end of the row. */
static uint32_t first_face(struct hsr_cells *cells, size_t row, uint32_t cell) {
  const struct hsr_grid *g = cells->grid;
  if (cells->face_row != row || !cells->face_known) {
    cells->face_known = true;
    cells->face_row = row;
    cells->face_cell = g->row[row];
    cells->face = g->first[row];
    if (g->row[row + 1] - cell < cell - g->row[row]) {
      cells->face_cell = g->row[row + 1];
      cells->face = g->first[row + 1];
    }
  }
  for (; cells->face_cell < cell; cells->face_cell++)
    cells->face += hsr_count_bits(g->sides[cells->face_cell]);
  while (cells->face_cell > cell)
    cells->face -= hsr_count_bits(g->sides[--cells->face_cell]);
  return cells->face;
}

enum fate { OUT_OF_SIGHT, OCCUPIED, DRAWN };

enum { PART = 4 }; /* cells of a group that are looked at together */

/* What becomes of the cells from lo to hi; DRAWN if something may be drawn. */
static enum fate look_at(const struct hsr_cells *cells, const uint32_t lo[3],
                         const uint32_t hi[3], struct hsr_cell_box *box) {
  if (!hsr_cells_box(cells, lo, hi, box))
    return OUT_OF_SIGHT;
  return cells->front && !hsr_cells_any_vacant(cells, &box->bounds) ? OCCUPIED
                                                                    : DRAWN;
}

static void draw_sides(struct hsr_cells *cells, const uint32_t at[3],
                       const struct hsr_cell *cell,
                       const struct hsr_cell_box *box) {
  const struct hsr_grid *g = cells->grid;
  size_t row = (size_t)at[2] * g->n[1] + at[1];
  uint32_t face = first_face(cells, row, cell->number);
  uint8_t all = g->sides[cell->number];
  for (int side = 0; side < 6; side++) {
    if (cell->sides >> side & 1)
      hsr_cells_draw(cells, at, side, face, box);
    face += all >> side & 1;
  }
}

static void draw_cell(struct hsr_cells *cells, const struct hsr_cell *cell) {
  struct hsr_cell_box box;
  uint32_t at[3] = {cells->at[0], cells->at[1], cells->at[2]};
  at[cells->axis] = cell->x;
  enum fate fate = look_at(cells, at, at, &box);
  HSR_STEP(cells->tally, HSR_CELLS_CELLS, HSR_CELL(cell->number, 0, 0),
           HSR_NOTHING, HSR_NOWHERE, fate);
  if (fate == DRAWN)
    draw_sides(cells, at, cell, &box);
}

/* Whether none of n cells of the group, from number `k`, is to be drawn. */
static bool is_passed_over(const struct hsr_cells *cells, int k, int n) {
  const struct hsr_cell *first = &cells->group[k], *last = first + n - 1;
  struct hsr_cell_box box;
  uint32_t lo[3], hi[3];
  memcpy(lo, cells->at, sizeof lo);
  memcpy(hi, cells->at, sizeof hi);
  lo[cells->axis] = first->x < last->x ? first->x : last->x;
  hi[cells->axis] = first->x < last->x ? last->x : first->x;
  enum fate fate = look_at(cells, lo, hi, &box);
  HSR_STEP(cells->tally, HSR_CELLS_GROUPS, HSR_CELL(first->number, 0, 0),
           HSR_CELL(last->number, 0, 0), HSR_NOWHERE, fate);
  return fate != DRAWN;
}

/* n cells of the group, from number `k`, in their order; or none, if all are
 * hidden. From front to back, many are hidden: so four are looked at together,
 * too. */
static void draw_part(struct hsr_cells *cells, int k, int n) {
  if (n > 1 && is_passed_over(cells, k, n))
    return;
  int part = cells->front && n > PART ? PART : 1;
  for (int end = k + n; k < end; k += part)
    if (part == 1)
      draw_cell(cells, &cells->group[k]);
    else
      draw_part(cells, k, end - k < part ? end - k : part);
}

static void draw_group(struct hsr_cells *cells) {
  int n = cells->n_group;
  cells->n_group = 0;
  if (n)
    draw_part(cells, 0, n);
}

static inline void add_cell(struct hsr_cells *cells, uint32_t number,
                            uint32_t x, uint8_t sides) {
  cells->group[cells->n_group++] = (struct hsr_cell){number, x, sides};
  if (cells->n_group == HSR_CELLS_GROUP)
    draw_group(cells);
}

/* --- Rows ----------------------------------------------------------------- */

/* Of the eight cells from c on, those sides; the lowest byte is that of c. */
static inline uint64_t eight_sides(const struct hsr_grid *g, uint32_t c,
                                   uint8_t sides) {
  uint64_t eight;
  memcpy(&eight, g->sides + c, sizeof eight);
#if defined __BYTE_ORDER__ && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  eight = __builtin_bswap64(eight);
#endif
  return eight & UINT64_C(0x0101010101010101) * sides;
}

/* Adds cell c of a run along x if one of its sides faces the eye. */
static inline void add_facing(struct hsr_cells *cells, uint32_t c,
                              uint8_t across) {
  const struct hsr_grid *g = cells->grid;
  uint8_t sides = g->sides[c] & (across | cells->facing[0][g->x[c]]);
  if (sides)
    add_cell(cells, c, g->x[c], sides);
}

static uint8_t facing_across_x(const struct hsr_cells *cells,
                               const struct hsr_grid_run *run) {
  return cells->facing[1][run->at[1]] | cells->facing[2][run->at[2]];
}

/* The cells [c, end) of a run along x. Most are within a solid and have no side
 * at all: eight of those are passed over at once. */
static void add_upwards(struct hsr_cells *cells, const struct hsr_grid_run *run,
                        uint32_t c, uint32_t end) {
  uint8_t across = facing_across_x(cells, run);
  for (; end - c >= 8; c += 8) {
    uint64_t some = eight_sides(cells->grid, c, across | 3);
    while (some) {
      int byte = hsr_first_bit(some) / 8;
      add_facing(cells, c + (uint32_t)byte, across);
      some &= ~(UINT64_C(0xff) << 8 * byte);
    }
  }
  for (; c < end; c++)
    add_facing(cells, c, across);
}

/* The same, from end - 1 to c. */
static void add_downwards(struct hsr_cells *cells,
                          const struct hsr_grid_run *run, uint32_t c,
                          uint32_t end) {
  uint8_t across = facing_across_x(cells, run);
  for (; end - c >= 8; end -= 8) {
    uint64_t some = eight_sides(cells->grid, end - 8, across | 3);
    for (uint32_t k = 8; some && k--;)
      if (some >> 8 * k & 0xff) {
        add_facing(cells, end - 8 + k, across);
        some &= ~(UINT64_C(0xff) << 8 * k);
      }
  }
  while (end > c)
    add_facing(cells, --end, across);
}

/* The kept cells of a run along x, whose indices ascend within the row: those
 * with a side towards the eye. */
static void visit_along_x(struct hsr_cells *cells,
                          const struct hsr_grid_run *run) {
  const struct hsr_grid *g = cells->grid;
  size_t row = (size_t)run->at[2] * g->n[1] + run->at[1];
  uint32_t begin = g->row[row], end = g->row[row + 1];
  uint32_t lowest = run->step > 0 ? run->at[0] : run->at[0] + 1 - run->n;
  if (lowest > 0)
    begin = hsr_grid_first_from(g, begin, end, lowest);
  if (lowest + run->n < g->n[0])
    end = hsr_grid_first_from(g, begin, end, lowest + run->n);
  if (begin == end)
    return;
  HSR_STEP(cells->tally, HSR_CELLS_RUNS, HSR_CELL(begin, 0, 0), HSR_NOTHING,
           HSR_NOWHERE, 0);
  if (run->step > 0)
    add_upwards(cells, run, begin, end);
  else
    add_downwards(cells, run, begin, end);
  draw_group(cells);
}

/* The kept cell at these indices; UINT32_MAX if it is not kept. Mostly it is
 * near the one that was last found in its row. */
static uint32_t find_cell(struct hsr_cells *cells, const uint32_t at[3]) {
  const struct hsr_grid *g = cells->grid;
  size_t row = (size_t)at[2] * g->n[1] + at[1];
  uint32_t begin = g->row[row], end = g->row[row + 1], c = cells->cursor[row];
  if (begin == end)
    return UINT32_MAX;
  for (int k = 0; k < 2 && c + 1 < end && g->x[c] < at[0]; k++)
    c++;
  for (int k = 0; k < 2 && c > begin && g->x[c] > at[0]; k++)
    c--;
  bool found = g->x[c] == at[0];
  bool is_gap = (c == begin || g->x[c - 1] < at[0]) &&
                (c + 1 == end || g->x[c + 1] > at[0]);
  if (!found && !is_gap) {
    c = hsr_grid_first_from(g, begin, end - 1, at[0]);
    found = g->x[c] == at[0];
  }
  cells->cursor[row] = c;
  return found ? c : UINT32_MAX;
}

static void visit_across_x(struct hsr_cells *cells,
                           const struct hsr_grid_run *run) {
  const struct hsr_grid *g = cells->grid;
  uint32_t at[3] = {run->at[0], run->at[1], run->at[2]};
  bool any = false;
  for (uint32_t k = 0; k < run->n; k++) {
    at[run->axis] =
        (uint32_t)((int64_t)run->at[run->axis] + (int64_t)k * run->step);
    uint32_t c = find_cell(cells, at);
    if (c == UINT32_MAX)
      continue;
    if (!any)
      HSR_STEP(cells->tally, HSR_CELLS_RUNS, HSR_CELL(c, 0, 0), HSR_NOTHING,
               HSR_NOWHERE, 0);
    any = true;
    uint8_t facing = cells->facing[0][at[0]] | cells->facing[1][at[1]] |
                     cells->facing[2][at[2]];
    if (g->sides[c] & facing)
      add_cell(cells, c, at[run->axis], g->sides[c] & facing);
  }
  draw_group(cells);
}

static void visit_run(void *data, const struct hsr_grid_run *run) {
  struct hsr_cells *cells = data;
  if (!cells->n_vacant)
    return;
  memcpy(cells->at, run->at, sizeof cells->at);
  cells->axis = run->axis;
  if (run->axis == 0 && run->n > 1)
    visit_along_x(cells, run);
  else
    visit_across_x(cells, run);
}

enum hsr_status hsr_cells_render(enum hsr_grid_order order,
                                 const struct hsr_job *job,
                                 struct hsr_error *err) {
  struct hsr_cells cells;
  if (begin(&cells, job))
    return hsr_fail_nomem(err);
  struct hsr_grid_seen seen = see(&cells);
  bool nested = order == HSR_BTF || order == HSR_PBTF || order == HSR_IPPBTF;
  int nesting = nested ? (int)job->option[HSR_CELLS_NESTING] : 0;
  return hsr_grid_visit(order, nesting, cells.front, &seen, visit_run, &cells,
                        err);
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"runs", "rows of cells visited that have a kept one", HSR_ACTIVATE,
     HSR_OF_CELL, HSR_OF_NOTHING, .key = "row-of-cells"},
    {"groups", "rectangles around up to 16 cells of a row tested", HSR_COMPARE,
     HSR_OF_CELL, HSR_OF_CELL, "out of sight|occupied|drawn"},
    {"cells",
     "cells with a side towards the eye whose rectangle "
     "was tested",
     HSR_COMPARE, HSR_OF_CELL, HSR_OF_NOTHING, "out of sight|occupied|drawn"},
    {"sides", "sides of cells drawn", HSR_ACTIVATE, HSR_OF_FACE,
     HSR_OF_NOTHING},
    {"spans", "stretches of a row that a side covers", HSR_SPAN, HSR_OF_FACE,
     HSR_OF_WINDOW},
    {"samples taken", "samples looked at that were not vacant", HSR_REJECT,
     HSR_OF_FACE, HSR_OF_FACE},
    {"writes", "samples given to a face", HSR_ACCEPT, HSR_OF_FACE,
     HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line lines[] = {
    {"for each row of cells, in this order", HSR_RAISES(HSR_CELLS_RUNS)},
    {"  pass over cells that are out of sight or, from front to back, "
     "hidden",
     HSR_RAISES(HSR_CELLS_GROUPS)},
    {"  for each cell that is kept and may be seen",
     HSR_RAISES(HSR_CELLS_CELLS)},
    {"    for each of its sides that faces the eye",
     HSR_RAISES(HSR_CELLS_SIDES)},
    {"      for each span of samples that it covers",
     HSR_RAISES(HSR_CELLS_SPANS)},
    {"        from front to back: is a sample taken? leave it",
     HSR_RAISES(HSR_CELLS_OCCUPIED)},
    {"        else paint it", HSR_RAISES(HSR_CELLS_WRITES)},
    {NULL}};

const struct hsr_part hsr_cells_part = {
    HSR_PART_CELLS, counters, NULL, NULL, {lines}};
