/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kept cells of a grid, for the page: as cubes of no instance. */
#include "bench/lesson/lesson.h"
#include "common/answers/coded.h"
#include "common/files/json/json.h"
#include "common/grids/order.h"

/* What is larger is left out of the page. */
enum { MOST_CELLS = 4096 };

static json_t *cell_json(const struct trace_run *run, const uint32_t at[3]) {
  const struct hsr_grid *grid = run->scene->grid;
  json_t *corners = json_array();
  for (int c = 0; c < 8; c++) {
    double point[3];
    for (int k = 0; k < 3; k++)
      point[k] = grid->bound[k][at[k] + (c >> k & 1)];
    hsr_json_append(&corners, hsr_point_json(&run->view, point));
  }
  return corners;
}

/* Adds the cells of row j of slice k. */
static void add_row(json_t **cubes, const struct trace_run *run, uint32_t j,
                    uint32_t k) {
  const struct hsr_grid *grid = run->scene->grid;
  uint32_t row = j + grid->n[1] * k;
  for (uint32_t c = grid->row[row]; c < grid->row[row + 1]; c++)
    hsr_json_append(cubes,
                    json_pack("[I i o]", (json_int_t)c, 0,
                              cell_json(run, (uint32_t[3]){grid->x[c], j, k})));
}

bool lesson_has_cells(const struct trace_run *run) {
  const struct hsr_grid *grid = run->scene->grid;
  if (!grid || grid->n_cells > MOST_CELLS)
    return false;
  const struct hsr_shown own = hsr_setup_show(&run->setup);
  return !own.boxes && !own.octree && !own.cubes && !own.bsp && !own.grove;
}

/* Where each cell is in the grid. */
static json_t *places_json(const struct hsr_grid *grid) {
  json_t *places = json_array();
  for (uint32_t row = 0; row < grid->n[1] * grid->n[2]; row++)
    for (uint32_t c = grid->row[row]; c < grid->row[row + 1]; c++)
      hsr_json_append(&places, json_pack("[I I I]", (json_int_t)grid->x[c],
                                         (json_int_t)(row % grid->n[1]),
                                         (json_int_t)(row / grid->n[1])));
  return places;
}

/* The planes between the slices of cells, along each axis. */
static json_t *bounds_json(const struct hsr_grid *grid) {
  json_t *bounds = json_array();
  for (int k = 0; k < 3; k++) {
    json_t *along = json_array();
    for (uint32_t c = 0; c <= grid->n[k]; c++)
      hsr_json_append(&along, json_real(grid->bound[k][c]));
    hsr_json_append(&bounds, along);
  }
  return bounds;
}

void lesson_eye_cell(const struct trace_run *run, int32_t at[3]) {
  const struct hsr_grid *grid = run->scene->grid;
  for (int k = 0; k < 3; k++)
    at[k] = hsr_grid_split(grid->bound[k], grid->n[k], run->view.eye[k]);
}

static json_t *eye_json(const struct trace_run *run) {
  int32_t at[3];
  lesson_eye_cell(run, at);
  return json_pack("[iii]", at[0], at[1], at[2]);
}

bool lesson_place_of_cell(const struct hsr_grid *grid, uint32_t cell,
                          uint32_t at[3]) {
  uint32_t low = 0, high = grid->n[1] * grid->n[2];
  if (cell >= grid->n_cells)
    return false;
  while (high - low > 1) { /* the row that begins at or before it */
    uint32_t middle = low + (high - low) / 2;
    if (grid->row[middle] <= cell)
      low = middle;
    else
      high = middle;
  }
  at[0] = grid->x[cell];
  at[1] = low % grid->n[1];
  at[2] = low / grid->n[1];
  return true;
}

static const char *const parts_word[] = {[HSR_GRID_WHOLE] = "whole",
                                         [HSR_GRID_SLICES] = "slices",
                                         [HSR_GRID_OCTANTS] = "octants",
                                         [HSR_GRID_TURNS] = "turns",
                                         [HSR_GRID_CHILDREN] = "children"};

bool lesson_add_cells(json_t *to, const struct trace_run *run) {
  const struct hsr_grid *grid = run->scene->grid;
  json_t *cubes = json_array();
  for (uint32_t k = 0; k < grid->n[2]; k++)
    for (uint32_t j = 0; j < grid->n[1]; j++)
      add_row(&cubes, run, j, k);
  return !json_object_set_new(to, "isGrid", json_true()) &&
         !json_object_set_new(to, "places", places_json(grid)) &&
         !json_object_set_new(to, "bounds", bounds_json(grid)) &&
         !json_object_set_new(to, "eyeCell", eye_json(run)) &&
         !json_object_set_new(
             to, "gridParts",
             json_string(parts_word[run->setup.algorithm->grid_parts])) &&
         !json_object_set_new(to, "cubes", cubes);
}
