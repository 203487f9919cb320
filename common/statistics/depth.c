/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth complexity sample by sample, and overlaps: see depth.h. */
#include "common/statistics/depth.h"
#include "common/exact/order.h"
#include "common/exact/screen.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The whole picture of a view. */
struct whole {
  struct hsr_view view;
  struct hsr_screen screen;
  struct hsr_tally tally;
  struct hsr_arena arena;
};

static enum hsr_status open_whole(struct whole *w,
                                  const struct hsr_world *world,
                                  const struct hsr_view *view) {
  *w = (struct whole){.view = *view, .arena = HSR_ARENA_EMPTY};
  w->view.window = (struct hsr_window){0, 0, view->m, view->n};
  return hsr_screen_make(&w->screen, world, &w->view, &w->arena, &w->tally);
}

/* --- Depth complexity ----------------------------------------------------- */

static void add_face(struct whole *w, uint32_t f, int *columns,
                     uint32_t *depth) {
  const struct hsr_bounds *bounds = &w->screen.bounds[f];
  struct hsr_face_rows rows;
  hsr_face_rows_begin(&rows, &w->screen, f, &w->tally);
  for (int j = bounds->y0; j < bounds->y1; j++) {
    int n = hsr_face_rows_spans(&rows, j, columns, &w->tally);
    for (int k = 0; k < n; k += 2)
      for (int i = columns[k]; i < columns[k + 1]; i++)
        depth[(size_t)j * (size_t)w->view.m + (size_t)i]++;
  }
}

enum hsr_status hsr_depth_complexity(const struct hsr_world *world,
                                     const struct hsr_view *view,
                                     uint32_t *depth, struct hsr_error *err) {
  struct whole w;
  enum hsr_status status = open_whole(&w, world, view);
  int *columns = HSR_NEW(&w.arena, int, hsr_most_corners(world) + 4);
  if (!columns)
    status = HSR_E_NOMEM;
  memset(depth, 0, (size_t)view->m * (size_t)view->n * sizeof *depth);
  for (uint32_t r = 0; !status && r < w.screen.n_relevant; r++)
    add_face(&w, w.screen.relevant[r], columns, depth);
  if (w.tally.out_of_memory)
    status = HSR_E_NOMEM;
  hsr_arena_free(&w.arena);
  return status ? hsr_fail_nomem(err) : HSR_OK;
}

/* --- Overlaps ------------------------------------------------------------- */

static int by_value(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* The part of all pairs of n intervals that overlap. Two are apart if one
 * begins where the other has ended: each begin is compared with all ends. Both
 * arrays are sorted here. */
static double part_of_pairs(double *begin, double *end, size_t n) {
  double pairs = (double)n * ((double)n - 1) / 2, apart = 0;
  size_t ended = 0;
  qsort(begin, n, sizeof *begin, by_value);
  qsort(end, n, sizeof *end, by_value);
  for (size_t k = 0; k < n; k++) {
    while (ended < n && end[ended] <= begin[k])
      ended++;
    apart += (double)ended;
  }
  return n < 2 ? NAN : 1 - apart / pairs;
}

enum hsr_status hsr_overlaps_measure(const struct hsr_world *world,
                                     const struct hsr_view *view,
                                     struct hsr_overlaps *overlaps,
                                     struct hsr_error *err) {
  struct whole w;
  enum hsr_status status = open_whole(&w, world, view);
  size_t n = status ? 0 : w.screen.n_relevant;
  double *begin = HSR_NEW(&w.arena, double, 3 * n + 1);
  double *end = HSR_NEW(&w.arena, double, 3 * n + 1);
  if (!begin || !end)
    status = HSR_E_NOMEM;
  for (size_t r = 0; !status && r < n; r++) {
    uint32_t f = w.screen.relevant[r];
    const struct hsr_bounds *b = &w.screen.bounds[f];
    begin[r] = b->x0;
    end[r] = b->x1;
    begin[n + r] = b->y0;
    end[n + r] = b->y1;
    hsr_depth_range(&w.screen, (struct hsr_polygon){.face = f},
                    &begin[2 * n + r], &end[2 * n + r]);
    /* A face across the line of sight has one depth, which it shares. */
    end[2 * n + r] = nextafter(end[2 * n + r], INFINITY);
  }
  if (w.tally.out_of_memory)
    status = HSR_E_NOMEM;
  if (!status)
    *overlaps = (struct hsr_overlaps){
        part_of_pairs(begin, end, n), part_of_pairs(begin + n, end + n, n),
        part_of_pairs(begin + 2 * n, end + 2 * n, n)};
  hsr_arena_free(&w.arena);
  return status ? hsr_fail_nomem(err) : HSR_OK;
}
