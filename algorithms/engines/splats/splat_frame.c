/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The samples of the grid in order, row by row, and which of them are drawn. */
#include "algorithms/engines/splats/splats.h"
#include "common/answers/kinds/composited.h"
#include "common/base/numbers.h"
#include "common/grids/normal.h"

#include <math.h>
#include <string.h>

/* --- Beginning ------------------------------------------------------------ */

static bool allocate(struct hsr_splats *s) {
  struct hsr_arena *arena = s->job->scratch;
  bool all = true;
  for (int a = 0; a < 3; a++) {
    size_t n = s->grid->n[a];
    for (int t = 0; t < HSR_TERMS; t++)
      all &= (s->term[a][t] = HSR_NEW(arena, double, n)) != NULL;
    s->far[a] = HSR_NEW(arena, double, n);
    s->per_size[a] = HSR_NEW(arena, double, n);
    all &= s->far[a] && s->per_size[a];
  }
  s->light = HSR_NEW(arena, struct hsr_splat_light, HSR_NO_NORMAL + 1);
  return all && s->light;
}

/* The terms of the products, of sample k of axis a. */
static void fill_products(struct hsr_splats *s, int a, uint32_t k) {
  const struct hsr_view *v = s->view;
  double by = s->per_size[a][k],
         V = by * (v->parallel ? v->F[a] : s->far[a][k]), A = by * v->ray[1][a],
         B = by * v->ray[2][a];
  double U = by * v->U[a] / v->whole_n, R = by * v->R[a] / v->whole_m;
  s->term[a][HSR_TERM_VV][k] = V * V;
  s->term[a][HSR_TERM_VA][k] = V * A;
  s->term[a][HSR_TERM_VB][k] = V * B;
  s->term[a][HSR_TERM_AA][k] = A * A;
  s->term[a][HSR_TERM_AB][k] = A * B;
  s->term[a][HSR_TERM_BB][k] = B * B;
  s->term[a][HSR_TERM_APART][k] = 2 * (U * U + R * R);
}

static void fill_terms(struct hsr_splats *s) {
  const struct hsr_view *v = s->view;
  for (int a = 0; a < 3; a++) {
    const double row[4] = {v->screen[0][a], v->screen[1][a],
                           v->parallel ? 0 : v->screen[2][a], v->depth[a]};
    double most[4] = {0, 0, 0, 0}, apart = 0;
    for (uint32_t k = 0; k < s->grid->n[a]; k++) {
      double far = s->grid->at[a][k] - v->E[a];
      s->far[a][k] = far;
      double size = s->grid->bound[a][k + 1] - s->grid->bound[a][k];
      s->per_size[a][k] = 1 / size;
      s->largest[a] = fmax(s->largest[a], size);
      for (int c = 0; c < 4; c++) {
        s->term[a][c][k] = row[c] * far;
        most[c] = fmax(most[c], fabs(row[c] * far));
      }
      fill_products(s, a, k);
      apart = fmax(apart, s->term[a][HSR_TERM_APART][k]);
    }
    for (int c = 0; c < 4; c++)
      s->most[c] += most[c];
    for (int c = 0; c < 3; c++)
      s->spread[c] += fabs(row[c]) * s->largest[a];
    s->apart += s->splatting.antialias ? apart : 0;
  }
  for (int c = 0; c < 2; c++)
    s->most[c] += fabs(v->origin[c]);
}

static uint32_t most_opacity(const struct hsr_palette *palette) {
  uint32_t most = 0;
  for (int k = 0; k < HSR_LEVELS; k++)
    most = palette->opacity[k] > most ? palette->opacity[k] : most;
  return most;
}

/* The energy of a splat that is neither widened for pixels nor blurred. */
static uint32_t plain_energy(struct hsr_splats *s) {
  struct hsr_splat splat = hsr_splats_exact(s, (const uint32_t[3]){0, 0, 0});
  splat.antialias = false;
  splat.blur = HSR_SHARP;
  return hsr_exact_energy(&splat, &s->tally->out_of_memory);
}

enum hsr_status hsr_splats_begin(struct hsr_splats *s,
                                 const struct hsr_job *job) {
  *s = (struct hsr_splats){.job = job,
                           .view = job->view,
                           .grid = job->world->roster.scene->grid,
                           .tally = job->tally,
                           .splatting = hsr_form_splatting(&job->answer->form),
                           .window = job->view->window,
                           .twin = hsr_splats_twin(),
                           .visits = 1};
  if (s->splatting.blur == HSR_BLUR_ACCUMULATE)
    s->splatting.blur = HSR_SHARP;
  if (!allocate(s) || hsr_splats_open_lengths(s))
    return HSR_E_NOMEM;
  fill_terms(s);
  hsr_splats_fill_weights(s);
  hsr_splats_fill_lights(s);
  s->most_opacity = most_opacity(&s->grid->palette);
  s->plain_energy = plain_energy(s);
  return HSR_OK;
}

/* --- Samples -------------------------------------------------------------- */

/* What a colour needs is far away in memory, so it is asked for early. */
static inline void ask_for_colour(const struct hsr_grid *g, uint32_t cell) {
  __builtin_prefetch(&g->normal[cell]);
  if (g->rgb)
    __builtin_prefetch(&g->rgb[cell]);
}

/* `n` kept samples of a row, from a cell on, up or down. A sample of opacity 0
 * gives nothing to any pixel, unless weights or densities are wanted. */
static void add(struct hsr_splats *s, uint32_t cell, uint32_t n, int step,
                uint32_t j, uint32_t k) {
  const bool wants_all =
      s->splatting.normalise || s->splatting.model == HSR_SLAB;
  s->visited += n;
  while (n && !s->stopped) {
    struct hsr_splat_samples *b = hsr_splats_samples(s);
    const uint32_t room = HSR_SPLAT_BATCH - (uint32_t)b->n,
                   here = n < room ? n : room;
    int at = b->n;
    for (uint32_t c = 0; c < here; c++, cell += (uint32_t)step) {
      HSR_STEP(s->tally, HSR_SPLAT_CELLS, HSR_CELL(cell, 0, 0), HSR_NOTHING,
               HSR_NOWHERE, 0);
      uint32_t opacity = hsr_splats_opacity(s, cell);
      ask_for_colour(s->grid, cell);
      b->cell[at] = cell;
      b->opacity[at] = opacity;
      b->at[0][at] = s->grid->x[cell];
      b->at[1][at] = j;
      b->at[2][at] = k;
      at += opacity || wants_all;
    }
    b->n = at;
    n -= here;
    if (at == HSR_SPLAT_BATCH)
      hsr_splats_close_batch(s, false);
  }
}

/* --- Rows ----------------------------------------------------------------- */

enum { PIECE = 16 }; /* kept samples that are tested at once */

/* Where splats of a row are on the screen. */
struct extent {
  double from[2], to[2];
};

/* Adds the image of the box that reaches `reach` cells to all sides of a
 *   sample. Row c of the view gives w times screen coordinate c, and row 2
 * gives w. Let the sample be at x. Then row c less x times row 2 is 0 at the
 * sample. Within the box it is at most its spread. A point of the image is
 * this, divided by w, away from x. So it is no farther away than the spread,
 *   divided by the least w. False if the box may be behind the eye. Rounding
 * changes less than 2^-30 of the sizes of the terms. */
static bool extend(const struct hsr_splats *s, uint32_t i, uint32_t j,
                   uint32_t k, double reach, struct extent *extent) {
  const struct hsr_view *v = s->view;
  double image[3], size[3];
  for (int c = 0; c < 3; c++) {
    image[c] =
        s->term[0][c][i] + (s->term[1][c][j] + s->term[2][c][k]) + v->origin[c];
    size[c] = s->most[c] + reach * s->spread[c];
  }
  double near = image[2] - reach * s->spread[2];
  if (!(near > 0x1p-20 * size[2]))
    return false;
  double per_w = 1 / image[2], per_near = 1 / near;
  for (int c = 0; c < 2; c++) {
    double at = image[c] * per_w, spread = 0;
    for (int a = 0; a < 3; a++)
      spread += fabs(v->screen[c][a] - at * v->screen[2][a]) * s->largest[a];
    double away =
        per_near * (reach * spread + 0x1p-30 * (size[c] + fabs(at) * size[2]));
    if (!(fabs(at) + away < 0x1p60))
      return false;
    extent->from[c] = hsr_min(extent->from[c], at - away);
    extent->to[c] = hsr_max(extent->to[c], at + away);
  }
  return true;
}

/* The pixels of the window that a splat of a row, from x = lo to hi, may touch.
 * Where the ray of a covered pixel is nearest to the sample, it is in a box
 * around the sample that reaches g r cells to all sides. So the pixel is
 * between the images of the boxes around the first and the last sample, if both
 * are before the eye. A blurred splat may be farther away. */
static struct hsr_window may_touch(const struct hsr_splats *s, uint32_t j,
                                   uint32_t k, uint32_t lo, uint32_t hi) {
  const struct hsr_view *v = s->view;
  const struct hsr_window *w = &s->window;
  if (s->splatting.blur)
    return *w;
  double depth = s->term[1][3][j] + s->term[2][3][k],
         t = hsr_max(s->term[0][3][lo], s->term[0][3][hi]) + depth;
  double g = sqrt(hsr_max(1, s->apart * (v->parallel ? 1 : t * t)));
  double reach = 1.001 * g * s->splatting.width * s->reach;
  struct extent e = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
  if (!extend(s, lo, j, k, reach, &e) || !extend(s, hi, j, k, reach, &e))
    return *w;
  const double left = hsr_sample_x(v, 0), top = hsr_sample_y(v, 0);
  return (struct hsr_window){
      hsr_splats_first_pixel(e.from[0] - left, w->x0, w->x1),
      hsr_splats_first_pixel(e.from[1] - top, w->y0, w->y1),
      hsr_splats_end_pixel(e.to[0] - left, w->x0, w->x1),
      hsr_splats_end_pixel(e.to[1] - top, w->y0, w->y1)};
}

/* The kept samples from c = begin up to end of a row, up or down. */
enum { OUT, FULL, IN };

static void visit_piece(struct hsr_splats *s, uint32_t j, uint32_t k,
                        uint32_t begin, uint32_t end, int step) {
  const struct hsr_grid *g = s->grid;
  struct hsr_window box = may_touch(s, j, k, g->x[begin], g->x[end - 1]);
  int where = box.x0 >= box.x1 || box.y0 >= box.y1                    ? OUT
              : hsr_splats_is_hidden(s, s->most_opacity, 65536, &box) ? FULL
                                                                      : IN;
  HSR_STEP(s->tally, HSR_SPLAT_ROWS, HSR_CELL(begin, 0, 0),
           HSR_CELL(end - 1, 0, 0), HSR_NOWHERE, where);
  if (where != IN)
    return;
  add(s, step > 0 ? begin : end - 1, end - begin, step, j, k);
}

/* The kept samples from x = lo to hi, both included, up or down: at once, or in
 * pieces if they may be hidden. */
static void visit_row(struct hsr_splats *s, uint32_t j, uint32_t k, uint32_t lo,
                      uint32_t hi, int step) {
  const struct hsr_grid *g = s->grid;
  size_t row = (size_t)k * g->n[1] + j;
  uint32_t begin = g->row[row], end = g->row[row + 1];
  if (begin == end)
    return;
  if (lo > 0)
    begin = hsr_grid_first_from(g, begin, end, lo);
  if (hi < g->n[0] - 1)
    end = hsr_grid_first_from(g, begin, end, hi + 1);
  uint32_t most = s->how->is_hidden ? PIECE : end - begin;
  for (uint32_t left = end - begin; left;) {
    uint32_t n = left < most ? left : most,
             from = step > 0 ? end - left : begin + left - n;
    visit_piece(s, j, k, from, from + n, step);
    left -= n;
  }
}

static void visit_run(void *data, const struct hsr_grid_run *run) {
  struct hsr_splats *s = data;
  uint32_t at[3] = {run->at[0], run->at[1], run->at[2]};
  if (run->axis == 0) {
    uint32_t last =
        (uint32_t)((int64_t)at[0] + ((int64_t)run->n - 1) * run->step);
    visit_row(s, at[1], at[2], run->step > 0 ? at[0] : last,
              run->step > 0 ? last : at[0], run->step);
    return;
  }
  for (uint32_t k = 0; k < run->n; k++) {
    at[run->axis] =
        (uint32_t)((int64_t)run->at[run->axis] + (int64_t)k * run->step);
    uint32_t cell = hsr_grid_cell(s->grid, at);
    if (cell != UINT32_MAX)
      add(s, cell, 1, 1, at[1], at[2]);
  }
}

int32_t hsr_splats_split(const struct hsr_splats *s, int a) {
  return hsr_grid_split(s->grid->bound[a], s->grid->n[a], s->view->eye[a]);
}

/* Draws what is left. */
static enum hsr_status end_visit(struct hsr_splats *s, struct hsr_error *err) {
  hsr_splats_close_batch(s, false);
  hsr_splats_flush(s);
  s->visit++;
  s->visited = 0;
  return s->stopped
             ? hsr_fail(err, HSR_E_STOPPED, "stopped by whoever asked for it")
             : HSR_OK;
}

enum hsr_status hsr_splats_visit(struct hsr_splats *s,
                                 enum hsr_grid_order order, int nesting,
                                 bool front, struct hsr_error *err) {
  struct hsr_grid_seen seen = {.high_first = false};
  for (int a = 0; a < 3; a++) {
    seen.n[a] = s->grid->n[a];
    seen.q[a] = hsr_splats_split(s, a);
    seen.toward[a] = s->view->F[a];
    seen.at[a] = s->grid->at[a];
  }
  enum hsr_status status =
      hsr_grid_visit(order, nesting, front, &seen, visit_run, s, err);
  return status ? status : end_visit(s, err);
}

/* --- Slices --------------------------------------------------------------- */

enum { IN_NO_SLICE = -1 };

/* Whether a row of kept samples, which is not empty, is out of the window. */
static bool is_row_out(struct hsr_splats *s, uint32_t row) {
  const struct hsr_grid *g = s->grid;
  const uint32_t first = g->x[g->row[row]], last = g->x[g->row[row + 1] - 1];
  struct hsr_window box =
      may_touch(s, row % g->n[1], row / g->n[1], first, last);
  bool is_out = box.x0 >= box.x1 || box.y0 >= box.y1;
  HSR_STEP(s->tally, HSR_SPLAT_ROWS, HSR_CELL(g->row[row], 0, 0),
           HSR_CELL(g->row[row + 1] - 1, 0, 0), HSR_NOWHERE, is_out ? OUT : IN);
  return is_out;
}

/* The slice of each kept sample; none in a row that is out of the window. */
static void number_samples(struct hsr_splats *s, hsr_splats_slice_of *slice_of,
                           int32_t *slice) {
  const struct hsr_grid *g = s->grid;
  for (uint32_t row = 0; row < g->n[1] * g->n[2]; row++) {
    const uint32_t begin = g->row[row], end = g->row[row + 1];
    bool is_out = begin < end && is_row_out(s, row);
    for (uint32_t c = begin; c < end; c++) {
      const uint32_t at[3] = {g->x[c], row % g->n[1], row / g->n[1]};
      slice[c] = is_out ? IN_NO_SLICE : (int32_t)slice_of(s, at);
    }
  }
}

/* Sorts all kept samples by their slices, by counting. */
enum hsr_status hsr_splats_open_lists(struct hsr_splats *s, uint32_t n,
                                      hsr_splats_slice_of *slice_of) {
  const struct hsr_grid *g = s->grid;
  struct hsr_arena *arena = s->job->scratch;
  int32_t *slice = HSR_NEW(arena, int32_t, g->n_cells);
  s->start = HSR_NEW_ZEROED(arena, uint32_t, (size_t)n + 2);
  s->sample = HSR_NEW(arena, struct hsr_splat_sample, g->n_cells);
  if (!slice || !s->start || !s->sample)
    return HSR_E_NOMEM;
  number_samples(s, slice_of, slice);
  for (uint32_t c = 0; c < g->n_cells; c++)
    if (slice[c] != IN_NO_SLICE)
      s->start[slice[c] + 2]++;
  for (uint32_t k = 0; k < n; k++)
    s->start[k + 2] += s->start[k + 1];
  for (uint32_t row = 0; row < g->n[1] * g->n[2]; row++)
    for (uint32_t c = g->row[row]; c < g->row[row + 1]; c++)
      if (slice[c] != IN_NO_SLICE)
        s->sample[s->start[slice[c] + 1]++] = (struct hsr_splat_sample){c, row};
  return HSR_OK;
}

static uint32_t slice_across_x(const struct hsr_splats *s,
                               const uint32_t at[3]) {
  (void)s;
  return at[0];
}

enum hsr_status hsr_splats_open_slices(struct hsr_splats *s, int axis) {
  return axis == 0 ? hsr_splats_open_lists(s, s->grid->n[0], slice_across_x)
                   : HSR_OK;
}

static void visit_slice(struct hsr_splats *s, int axis, uint32_t index) {
  const struct hsr_grid *g = s->grid;
  uint32_t all = g->n[0] - 1;
  if (axis == 2)
    for (uint32_t j = 0; j < g->n[1]; j++)
      visit_row(s, j, index, 0, all, 1);
  if (axis == 1)
    for (uint32_t k = 0; k < g->n[2]; k++)
      visit_row(s, index, k, 0, all, 1);
  if (axis == 0)
    for (uint32_t c = s->start[index]; c < s->start[index + 1]; c++) {
      const struct hsr_splat_sample *sample = &s->sample[c];
      add(s, sample->cell, 1, 1, sample->row % g->n[1], sample->row / g->n[1]);
    }
}

enum hsr_status hsr_splats_visit_slices(struct hsr_splats *s, int axis,
                                        uint32_t first, uint32_t n, int step,
                                        struct hsr_error *err) {
  for (uint32_t k = 0; k < n && !s->stopped; k++) {
    visit_slice(s, axis, first + (uint32_t)step * k);
    hsr_splats_close_batch(s, true);
  }
  return end_visit(s, err);
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"rows", "boxes around rows of samples tested", HSR_COMPARE, HSR_OF_CELL,
     HSR_OF_CELL, "out of the window|full|in it"},
    {"samples", "kept samples visited", HSR_ACTIVATE, HSR_OF_CELL,
     HSR_OF_NOTHING},
    {"splats", "rectangles around splats tested", HSR_COMPARE, HSR_OF_CELL,
     HSR_OF_WINDOW, "out of sight|full|drawn"},
    {"updates", "pixels that a splat was put into", HSR_SAMPLE, HSR_OF_CELL,
     HSR_OF_WINDOW, .key = "splat-update"},
    {"writes", "pixels that are not empty", HSR_ACCEPT, HSR_OF_NOTHING,
     HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_counter folds[] = {
    {"folds", "sums of pixels put over the picture", HSR_SAMPLE, HSR_OF_NOTHING,
     HSR_OF_WINDOW},
    {NULL}};

const struct hsr_part hsr_splats_part = {
    HSR_PART_SPLATS, counters, NULL, NULL, {NULL}};
const struct hsr_part hsr_folds_part = {
    HSR_PART_FOLDS, folds, NULL, NULL, {NULL}};
