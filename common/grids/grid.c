/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/grids/grid.h"
#include "common/base/bits.h"
#include "common/grids/normal.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { SIDES = 6, ALL_SIDES = (1 << SIDES) - 1 };
static const uint64_t MOST = UINT32_MAX - 1; /* ids, as in common/scene */

static size_t n_rows(const struct hsr_grid *g) {
  return (size_t)g->n[1] * g->n[2];
}

/* --- Bounds --------------------------------------------------------------- */

/* Half way between samples, and as far beyond the first and the last. A sample
 * that is alone has a cell of size 1. */
static enum hsr_status make_bounds(struct hsr_grid *g,
                                   const struct hsr_grid_samples *samples,
                                   int axis, struct hsr_error *err) {
  uint32_t n = g->n[axis];
  const double *at = samples->position[axis];
  double *bound = malloc(((size_t)n + 1) * sizeof *bound);
  g->bound[axis] = bound;
  g->at[axis] = malloc(n * sizeof *at);
  if (!bound || !g->at[axis])
    return hsr_fail_nomem(err);
  memcpy(g->at[axis], at, n * sizeof *at);
  for (uint32_t k = 1; k < n; k++)
    bound[k] = at[k - 1] / 2 + at[k] / 2;
  bound[0] = at[0] - (n > 1 ? bound[1] - at[0] : 0.5);
  bound[n] = at[n - 1] + (n > 1 ? at[n - 1] - bound[n - 1] : 0.5);
  for (uint32_t k = 0; k < n; k++)
    if (!(bound[k] < bound[k + 1]) || !isfinite(bound[k + 1] - bound[k]))
      return hsr_fail(err, HSR_E_INPUT,
                      "the grid's positions along %c do not ascend at %u",
                      "xyz"[axis], k);
  return HSR_OK;
}

/* --- Keeping -------------------------------------------------------------- */

/* The slices around the current one, and room for what is kept. */
struct keeper {
  struct hsr_grid *grid;
  const struct hsr_grid_samples *samples;
  const struct hsr_grid_keep *keep;
  float *slice[3]; /* k - 1, k, k + 1; NULL beyond the ends */
  float *memory;
  uint64_t room; /* cells */
};

/* The difference quotient of `density` at sample k of n, `stride` apart. */
static double slope(const double *at, uint32_t n, uint32_t k,
                    const float *density, ptrdiff_t stride) {
  ptrdiff_t before = k > 0 ? -stride : 0, after = k + 1 < n ? stride : 0;
  double width = at[after ? k + 1 : k] - at[before ? k - 1 : k];
  return width > 0 ? ((double)density[after] - density[before]) / width : 0;
}

static double slope_across(const struct keeper *keeper, uint32_t k, size_t at) {
  const double *z = keeper->samples->position[2];
  const float *here = keeper->slice[1],
              *below = keeper->slice[0] ? keeper->slice[0] : here,
              *above = keeper->slice[2] ? keeper->slice[2] : here;
  double width = z[above != here ? k + 1 : k] - z[below != here ? k - 1 : k];
  return width > 0 ? ((double)above[at] - below[at]) / width : 0;
}

static void find_gradient(const struct keeper *keeper, const uint32_t at[3],
                          double gradient[3]) {
  const struct hsr_grid_samples *s = keeper->samples;
  size_t place = (size_t)at[1] * s->n[0] + at[0];
  const float *density = keeper->slice[1] + place;
  gradient[0] = slope(s->position[0], s->n[0], at[0], density, 1);
  gradient[1] = slope(s->position[1], s->n[1], at[1], density, s->n[0]);
  gradient[2] = slope_across(keeper, at[2], place);
}

static double length_of(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static bool is_kept(const struct keeper *keeper, const uint32_t at[3]) {
  const struct hsr_grid_keep *keep = keeper->keep;
  float density =
      keeper->slice[1][(size_t)at[1] * keeper->samples->n[0] + at[0]];
  if (!(density >= keep->least && density <= keep->most))
    return false;
  if (!(keep->gradient > 0))
    return true;
  double gradient[3];
  find_gradient(keeper, at, gradient);
  return length_of(gradient) >= keep->gradient;
}

/* Enlarges an array of `count` items. */
#define GROW(array, count)                                                     \
  do {                                                                         \
    void *grown = realloc(array, (count) * sizeof *(array));                   \
    if (!grown)                                                                \
      return false;                                                            \
    (array) = grown;                                                           \
  } while (0)

/* Doubles the room for cells. */
static bool make_room(struct keeper *keeper) {
  struct hsr_grid *g = keeper->grid;
  uint64_t room = keeper->room ? 2 * keeper->room : 1024;
  GROW(g->x, room);
  GROW(g->level, room);
  GROW(g->steep, room);
  GROW(g->normal, room);
  if (keeper->samples->colour)
    GROW(g->rgb, room);
  keeper->room = room;
  return true;
}

static void set_colour(struct keeper *keeper, const uint32_t at[3],
                       uint8_t code[3]) {
  const struct hsr_grid_samples *s = keeper->samples;
  float rgb[3];
  s->colour(s->data, at, keeper->slice[1][(size_t)at[1] * s->n[0] + at[0]],
            rgb);
  for (int k = 0; k < 3; k++)
    code[k] = (uint8_t)lrintf(255 * sqrtf(rgb[k]));
}

/* 0 to 255 for 0 to 1, and beyond as their ends. NaN is 0. */
static uint8_t level_of(double share) {
  return (uint8_t)(share >= 1 ? 255 : share > 0 ? lrint(255 * share) : 0);
}

/* The gradient's size is taken by the cell, and 255 is the whole range of
 * densities from one cell to the next. */
static void set_levels(struct keeper *keeper, const uint32_t at[3],
                       uint32_t cell) {
  struct hsr_grid *g = keeper->grid;
  const struct hsr_grid_samples *s = keeper->samples;
  double density = keeper->slice[1][(size_t)at[1] * s->n[0] + at[0]];
  bool is_range = s->low < s->high;
  double width = is_range ? s->high - s->low : 1, gradient[3], by_cell[3];
  find_gradient(keeper, at, gradient);
  for (int a = 0; a < 3; a++) {
    by_cell[a] =
        gradient[a] * (g->bound[a][at[a] + 1] - g->bound[a][at[a]]) / width;
    gradient[a] = -gradient[a];
  }
  if (s->normal)
    s->normal(s->data, at, gradient);
  g->level[cell] = is_range ? level_of((density - s->low) / width) : 255;
  g->steep[cell] = level_of(length_of(by_cell));
  g->normal[cell] = hsr_normal_code(gradient);
}

static bool add_cell(struct keeper *keeper, const uint32_t at[3]) {
  struct hsr_grid *g = keeper->grid;
  if (g->n_cells == keeper->room && !make_room(keeper))
    return false;
  if (g->rgb)
    set_colour(keeper, at, g->rgb[g->n_cells]);
  set_levels(keeper, at, g->n_cells);
  g->x[g->n_cells++] = at[0];
  return true;
}

static enum hsr_status keep_slice(struct keeper *keeper, uint32_t k,
                                  struct hsr_error *err) {
  struct hsr_grid *g = keeper->grid;
  for (uint32_t j = 0; j < g->n[1]; j++) {
    g->row[(size_t)k * g->n[1] + j] = g->n_cells;
    for (uint32_t i = 0; i < g->n[0]; i++) {
      const uint32_t at[3] = {i, j, k};
      if (!is_kept(keeper, at))
        continue;
      if (g->n_cells == MOST)
        return hsr_fail(err, HSR_E_REFUSED, "the grid keeps over 2^32 cells");
      if (!add_cell(keeper, at))
        return hsr_fail_nomem(err);
    }
  }
  return HSR_OK;
}

static enum hsr_status read_slice(struct keeper *keeper, uint32_t k,
                                  struct hsr_error *err) {
  size_t size = (size_t)keeper->grid->n[0] * keeper->grid->n[1];
  float *to = keeper->memory + k % 3 * size;
  keeper->slice[0] = keeper->slice[1];
  keeper->slice[1] = keeper->slice[2];
  keeper->slice[2] = NULL;
  if (k >= keeper->grid->n[2])
    return HSR_OK;
  keeper->slice[2] = to;
  return keeper->samples->slice(keeper->samples->data, k, to, err);
}

static enum hsr_status keep_cells(struct keeper *keeper,
                                  struct hsr_error *err) {
  struct hsr_grid *g = keeper->grid;
  size_t size = (size_t)g->n[0] * g->n[1];
  keeper->memory = malloc(3 * size * sizeof *keeper->memory);
  g->row = malloc((n_rows(g) + 1) * sizeof *g->row);
  if (!keeper->memory || !g->row)
    return hsr_fail_nomem(err);
  enum hsr_status status = read_slice(keeper, 0, err);
  for (uint32_t k = 0; k < g->n[2] && !status; k++) {
    status = read_slice(keeper, k + 1, err);
    if (!status)
      status = keep_slice(keeper, k, err);
  }
  g->row[n_rows(g)] = g->n_cells;
  return !status && !g->n_cells
             ? hsr_fail(err, HSR_E_INPUT, "no sample of the grid is kept")
             : status;
}

/* --- Sides ---------------------------------------------------------------- */

/* Takes the sides away that two kept cells of rows a and b have in common:
 * `upper` of a's cells, `lower` of b's. Both rows ascend. */
static void join_rows(struct hsr_grid *g, size_t a, size_t b, int upper,
                      int lower) {
  uint32_t i = g->row[a], j = g->row[b];
  while (i < g->row[a + 1] && j < g->row[b + 1]) {
    if (g->x[i] == g->x[j]) {
      g->sides[i] &= (uint8_t) ~(1u << upper);
      g->sides[j] &= (uint8_t) ~(1u << lower);
    }
    uint32_t x = g->x[i];
    i += x <= g->x[j];
    j += g->x[j] <= x;
  }
}

static void join_row(struct hsr_grid *g, size_t row) {
  for (uint32_t c = g->row[row]; c + 1 < g->row[row + 1]; c++)
    if (g->x[c] + 1 == g->x[c + 1]) {
      g->sides[c] &= (uint8_t) ~(1u << 1);
      g->sides[c + 1] &= (uint8_t) ~(1u << 0);
    }
}

static void join_cells(struct hsr_grid *g) {
  for (uint32_t k = 0; k < g->n[2]; k++)
    for (uint32_t j = 0; j < g->n[1]; j++) {
      size_t row = (size_t)k * g->n[1] + j;
      join_row(g, row);
      if (j + 1 < g->n[1])
        join_rows(g, row, row + 1, 3, 2);
      if (k + 1 < g->n[2])
        join_rows(g, row, row + g->n[1], 5, 4);
    }
}

static enum hsr_status number_faces(struct hsr_grid *g, struct hsr_error *err) {
  uint64_t n = 0;
  for (size_t row = 0; row < n_rows(g); row++) {
    g->first[row] = (uint32_t)n;
    for (uint32_t c = g->row[row]; c < g->row[row + 1]; c++)
      n += hsr_count_bits(g->sides[c]);
    if (n > MOST)
      return hsr_fail(err, HSR_E_REFUSED, "the grid has over 2^32 - 2 faces");
  }
  g->first[n_rows(g)] = g->n_faces = (uint32_t)n;
  return HSR_OK;
}

static enum hsr_status make_sides(struct hsr_grid *g, bool all_sides,
                                  struct hsr_error *err) {
  g->sides = malloc(g->n_cells);
  g->first = malloc((n_rows(g) + 1) * sizeof *g->first);
  if (!g->sides || !g->first)
    return hsr_fail_nomem(err);
  memset(g->sides, ALL_SIDES, g->n_cells);
  if (!all_sides)
    join_cells(g);
  return number_faces(g, err);
}

/* --- The whole ------------------------------------------------------------ */

enum hsr_status hsr_grid_init(struct hsr_grid *grid,
                              const struct hsr_grid_samples *samples,
                              const struct hsr_grid_keep *keep,
                              struct hsr_error *err) {
  *grid = (struct hsr_grid){.n_cells = 0};
  memcpy(grid->n, samples->n, sizeof grid->n);
  hsr_palette_find("solid", &grid->palette);
  struct keeper keeper = {.grid = grid, .samples = samples, .keep = keep};
  enum hsr_status status = HSR_OK;
  for (int axis = 0; axis < 3 && !status; axis++)
    status = make_bounds(grid, samples, axis, err);
  if (!status)
    status = keep_cells(&keeper, err);
  free(keeper.memory);
  return status ? status : make_sides(grid, keep->all_sides, err);
}

/* Items from .. to - 1 of an array; NULL of NULL. */
static void *cut_array(void *array, uint32_t from, uint32_t to, size_t size) {
  if (!array)
    return NULL;
  memmove(array, (char *)array + from * size, (to - from) * size);
  void *smaller = realloc(array, (to - from + (size_t)1) * size);
  return smaller ? smaller : array;
}

void hsr_grid_cut(struct hsr_grid *g, uint32_t from, uint32_t to) {
  g->x = cut_array(g->x, from, to, sizeof *g->x);
  g->sides = cut_array(g->sides, from, to, sizeof *g->sides);
  g->rgb = cut_array(g->rgb, from, to, sizeof *g->rgb);
  g->level = cut_array(g->level, from, to, sizeof *g->level);
  g->steep = cut_array(g->steep, from, to, sizeof *g->steep);
  g->normal = cut_array(g->normal, from, to, sizeof *g->normal);
  g->n_cells = to - from;
  for (size_t row = 0; row <= n_rows(g); row++) {
    uint32_t cell = g->row[row];
    g->row[row] = cell < from ? 0 : (cell < to ? cell : to) - from;
  }
  number_faces(g, NULL); /* they are no more than before */
}

void hsr_grid_free(struct hsr_grid *grid) {
  for (int axis = 0; axis < 3; axis++) {
    free(grid->bound[axis]);
    free(grid->at[axis]);
  }
  free(grid->row);
  free(grid->first);
  free(grid->x);
  free(grid->sides);
  free(grid->rgb);
  free(grid->level);
  free(grid->steep);
  free(grid->normal);
  free(grid->densities);
  *grid = (struct hsr_grid){.n_cells = 0};
}

/* --- Names ---------------------------------------------------------------- */

/* The last of `n` ascending numbers that is at most `value`. The first is. */
static size_t last_at_most(const uint32_t *number, size_t n, uint32_t value) {
  size_t low = 0, high = n;
  while (high - low > 1) {
    size_t middle = low + (high - low) / 2;
    if (number[middle] <= value)
      low = middle;
    else
      high = middle;
  }
  return low;
}

uint32_t hsr_grid_cell(const struct hsr_grid *g, const uint32_t at[3]) {
  size_t row = (size_t)at[2] * g->n[1] + at[1];
  uint32_t first = g->row[row], n = g->row[row + 1] - first;
  if (!n)
    return UINT32_MAX;
  uint32_t cell = first + (uint32_t)last_at_most(g->x + first, n, at[0]);
  return g->x[cell] == at[0] ? cell : UINT32_MAX;
}

void hsr_grid_place(const struct hsr_grid *g, uint32_t cell, uint32_t at[3]) {
  /* Of empty rows that begin with the same cell, the last is found: the row
   * that holds it. */
  size_t row = last_at_most(g->row, n_rows(g), cell);
  at[0] = g->x[cell];
  at[1] = (uint32_t)(row % g->n[1]);
  at[2] = (uint32_t)(row / g->n[1]);
}

static uint32_t first_face(const struct hsr_grid *g, size_t row,
                           uint32_t cell) {
  uint32_t face = g->first[row];
  for (uint32_t c = g->row[row]; c < cell; c++)
    face += hsr_count_bits(g->sides[c]);
  return face;
}

uint32_t hsr_grid_first_face(const struct hsr_grid *g, uint32_t cell) {
  return first_face(g, last_at_most(g->row, n_rows(g), cell), cell);
}

void hsr_grid_face(const struct hsr_grid *g, uint32_t face, uint32_t *cell,
                   int *side) {
  size_t row = last_at_most(g->first, n_rows(g), face);
  uint32_t left = face - g->first[row], c = g->row[row];
  for (; left >= hsr_count_bits(g->sides[c]); c++)
    left -= hsr_count_bits(g->sides[c]);
  *cell = c;
  for (*side = 0; !(g->sides[c] >> *side & 1) || left--; ++*side)
    ;
}

void hsr_grid_rgb(const struct hsr_grid *g, uint32_t cell, float rgb[3]) {
  for (int k = 0; k < 3; k++) {
    float root = g->rgb ? (float)g->rgb[cell][k] / 255 : 0.75f;
    rgb[k] = root * root;
  }
}

void hsr_grid_corner_places(const uint32_t at[3], int side,
                            uint32_t corner[4][3]) {
  /* Around axis a the other two follow in turn, b and then c; seen from where a
   * is higher they run counter-clockwise. */
  int a = side / 2, b = (a + 1) % 3, c = (a + 2) % 3, high = side & 1;
  for (int k = 0; k < 4; k++) {
    int turn = high ? k : 3 - k;
    corner[k][a] = at[a] + (uint32_t)high;
    corner[k][b] = at[b] + (turn == 1 || turn == 2);
    corner[k][c] = at[c] + (turn >= 2);
  }
}

void hsr_grid_corners(const struct hsr_grid *g, const uint32_t at[3], int side,
                      double corner[4][3]) {
  uint32_t place[4][3];
  hsr_grid_corner_places(at, side, place);
  for (int k = 0; k < 4; k++)
    for (int a = 0; a < 3; a++)
      corner[k][a] = g->bound[a][place[k][a]];
}
