/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Of an algorithm that visits the cells of a grid in order: the row of cells at which
 * it is, and the part of the order that the row is in, a slice or an octant. As
 * data/grids.js of the page finds them, and looks/solids.js draws them. */
#include "bench/lesson/frames.h"

#include <math.h>
#include <stdlib.h>

struct cells {
  uint32_t low[3], high[3];
};

/* A row: the place of its first cell, and all its cells up to the last one drawn. */
struct row {
  uint64_t event; /* that begins it */
  uint32_t first[3];
  struct cells cells;
};

static const struct row *rows_of(const struct frames *f) {
  return f->rows.items;
}

static enum hsr_grid_parts parts_of(const struct frames *f) {
  return f->run->setup.algorithm->grid_parts;
}

bool frames_note_rows(struct frames *f, const struct hsr_event *event) {
  const struct hsr_grid *grid = f->run->scene->grid;
  bool begins = frames_has_key(f, event, "row-of-cells");
  uint32_t at[3];
  if (event->a.kind != HSR_OF_CELL || (!begins && !f->rows.n) ||
      !lesson_has_cells(f->run) ||
      !lesson_place_of_cell(grid, event->a.id[0], at))
    return true;
  if (begins) {
    if (!hsr_arena_grow(&f->arena, &f->rows, sizeof(struct row)))
      return false;
    struct row row = {.event = event->number};
    for (int a = 0; a < 3; a++)
      row.first[a] = row.cells.low[a] = row.cells.high[a] = at[a];
    ((struct row *)f->rows.items)[f->rows.n - 1] = row;
    return true;
  }
  struct cells *cells = &((struct row *)f->rows.items)[f->rows.n - 1].cells;
  for (int a = 0; a < 3; a++) {
    cells->low[a] = at[a] < cells->low[a] ? at[a] : cells->low[a];
    cells->high[a] = at[a] > cells->high[a] ? at[a] : cells->high[a];
  }
  return true;
}

static int compare_rows(const void *a, const void *b) {
  const struct row *r = a, *s = b;
  return (r->event > s->event) - (r->event < s->event);
}

/* The row that a step begins; NULL: it begins none. */
static const struct row *row_of(const struct frames *f,
                                const struct hsr_event *event) {
  const struct row wanted = {.event = event->number};
  return f->rows.n ? bsearch(&wanted, f->rows.items, f->rows.n, sizeof wanted,
                             compare_rows)
                   : NULL;
}

/* The axis along which the first cells of the rows change least often; -1: none
 * changes. */
static int outermost(const struct frames *f) {
  const struct row *row = rows_of(f);
  size_t changes[3] = {0, 0, 0};
  int axis = -1;
  for (size_t k = 1; k < f->rows.n; k++)
    for (int a = 0; a < 3; a++)
      changes[a] += row[k].first[a] != row[k - 1].first[a];
  for (int a = 0; a < 3; a++)
    if (changes[a] && (axis < 0 || changes[a] < changes[axis]))
      axis = a;
  return axis;
}

/* The last cell of the lower half of an octree's root, which is a cube of the least
 * power of two that holds all cells. */
static int32_t middle_of(const uint32_t n[3]) {
  uint32_t size = 1;
  for (int a = 0; a < 3; a++)
    while (size < n[a])
      size *= 2;
  return (int32_t)(size / 2) - 1;
}

/* The part that a row is in. False: there is none. */
static bool find_part(const struct frames *f, const struct row *row,
                      struct cells *part) {
  const uint32_t *n = f->run->scene->grid->n;
  enum hsr_grid_parts parts = parts_of(f);
  bool is_eighth = parts == HSR_GRID_OCTANTS || parts == HSR_GRID_CHILDREN;
  int axis = is_eighth ? -1 : outermost(f);
  int32_t last[3];
  if (parts == HSR_GRID_WHOLE || (!is_eighth && axis < 0))
    return false;
  lesson_eye_cell(f->run, last);
  for (int a = 0; a < 3; a++) {
    int64_t from = 0, to = (int64_t)n[a] - 1;
    int64_t end = parts == HSR_GRID_CHILDREN ? middle_of(n) : last[a];
    if (is_eighth && row->first[a] > end)
      from = end + 1;
    else if (is_eighth)
      to = end < to ? end : to;
    else if (a == axis)
      from = to = row->first[a];
    part->low[a] = (uint32_t)from;
    part->high[a] = (uint32_t)to;
  }
  return true;
}

/* The row before, if both sides of the eye take turns and it is on the other side along
 * one axis; else NULL. */
static const struct row *row_across(const struct frames *f,
                                    const struct row *row) {
  int32_t eye[3];
  int n = 0;
  if (parts_of(f) != HSR_GRID_TURNS || row == rows_of(f))
    return NULL;
  lesson_eye_cell(f->run, eye);
  for (int a = 0; a < 3; a++)
    n += ((int64_t)row->first[a] > eye[a]) !=
         ((int64_t)row[-1].first[a] > eye[a]);
  return n == 1 ? row - 1 : NULL;
}

/* The edges of a box of cells, as far as they lie before the eye. */
static void mark_cells(struct frames *f, const struct cells *cells,
                       const struct frame_look *look) {
  const struct hsr_grid *grid = f->run->scene->grid;
  for (int c = 0; c < 8; c++)
    for (int axis = 1; axis < 8; axis *= 2) {
      double at[2][3];
      if (c & axis)
        continue;
      for (int e = 0; e < 2; e++)
        for (int a = 0; a < 3; a++)
          at[e][a] = (e ? c | axis : c) >> a & 1
                         ? grid->bound[a][cells->high[a] + 1]
                         : grid->bound[a][cells->low[a]];
      json_t *image =
          lesson_image_json(&f->run->view, (const double(*)[3])at, 2);
      frames_add_line(f, json_array_get(image, 0), json_array_get(image, 1));
      json_decref(image);
    }
  frames_stroke(f, look->colour, look->width, look->dash);
}

void frames_mark_rows(struct frames *f, const struct hsr_event *event,
                      unsigned colour) {
  const struct row *row = row_of(f, event);
  struct cells part;
  if (!row)
    return;
  if (find_part(f, row, &part))
    mark_cells(f, &part, &(struct frame_look){FRAME_INK, 0, 2, FRAME_DASHED});
  const struct row *before = row_across(f, row);
  if (before)
    mark_cells(f, &before->cells,
               &(struct frame_look){colour, 0, 2.5, FRAME_DOTTED});
  mark_cells(f, &row->cells, &(struct frame_look){colour, 0, 2.5, FRAME_SOLID});
}
