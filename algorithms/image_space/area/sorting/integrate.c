/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/image_space/area/sorting/integrate.h"
#include "common/answers/filter.h"
#include "common/base/numbers.h"

#include <math.h>
#include <stddef.h>

enum { CHANNELS = 3 };

/* What the pieces in one pixel add up to. */
struct sums {
  double inside[CHANNELS]; /* of w dy (mx - i): to this pixel */
  double left[CHANNELS];   /* of w dy: to all pixels on the left */
};

/* What the error of a row depends on. */
struct row {
  double weight; /* E */
  uint64_t pieces;
};

struct integral {
  const struct hsr_job *job;
  struct hsr_integral_counters counters;
  struct sums *sums; /* of the window's rows, m a row */
  struct row *row;
  double background[CHANNELS];

  /* The present region. */
  uint32_t face;
  double w[CHANNELS], largest; /* of w, without its sign */
};

static void find_colour(const struct integral *g, uint32_t face,
                        double colour[CHANNELS]) {
  uint16_t rgb[CHANNELS];
  hsr_filter_colour(g->job->world, g->job->view, face, rgb);
  for (int c = 0; c < CHANNELS; c++)
    colour[c] = rgb[c] / 65535.0;
}

/* --- Sides ---------------------------------------------------------------- */

/* A piece in pixel i of row j. */
static void add_piece(struct integral *g, int i, int j, double dy, double mx) {
  int y = j - g->job->view->window.y0, m = g->job->view->m;
  struct sums *sums = &g->sums[(size_t)y * (size_t)m + (size_t)i];
  for (int c = 0; c < CHANNELS; c++) {
    sums->inside[c] += g->w[c] * dy * (mx - i);
    sums->left[c] += g->w[c] * dy;
  }
  g->row[y].pieces++;
  HSR_STEP(g->job->tally, g->counters.pieces, HSR_FACE(g->face), HSR_NOTHING,
           HSR_AT(i, j), 0);
  HSR_TOUCH(g->job->tally, i, j);
}

/* The part of a side in row j, from x0 to x1: x0 <= x1. */
static void add_in_row(struct integral *g, int j, double x0, double x1,
                       double dy) {
  int last = g->job->view->m - 1;
  int i0 = hsr_min_int((int)x0, last), i1 = hsr_min_int((int)x1, last);
  if (i0 == i1) {
    add_piece(g, i0, j, dy, (x0 + x1) / 2);
    return;
  }
  for (int i = i0; i <= i1; i++) {
    double from = fmax(x0, i), to = i < i1 ? i + 1 : x1;
    add_piece(g, i, j, dy * ((to - from) / (x1 - x0)), (from + to) / 2);
  }
}

/* Where the side from a to b, which runs downward, is at height y. */
static double crossing(const double a[2], const double b[2], double y) {
  if (y <= a[1] || y >= b[1])
    return y <= a[1] ? a[0] : b[0];
  double x = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
  return fmin(fmax(x, fmin(a[0], b[0])), fmax(a[0], b[0]));
}

/* The parts of a side that runs downward, in the rows of the window. They count
 * with `sign`. */
static void add_downward(struct integral *g, const double a[2],
                         const double b[2], int sign) {
  const struct hsr_window *w = &g->job->view->window;
  int j1 = hsr_min_int((int)ceil(b[1]), w->y1);
  for (int j = hsr_max_int((int)a[1], w->y0); j < j1; j++) {
    double top = fmax(a[1], j), bottom = fmin(b[1], j + 1);
    double x0 = crossing(a, b, top), x1 = crossing(a, b, bottom);
    add_in_row(g, j, fmin(x0, x1), fmax(x0, x1), sign * (bottom - top));
  }
}

/* A side counts for the errors of the rows that it is in or beside. */
static void add_error(struct integral *g, double top, double bottom) {
  const struct hsr_window *w = &g->job->view->window;
  int j1 = hsr_min_int((int)floor(bottom + 0x1p-20), w->y1 - 1);
  for (int j = hsr_max_int((int)floor(top - 0x1p-20), w->y0); j <= j1; j++)
    g->row[j - w->y0].weight += g->largest;
}

static void add_cycle(struct integral *g, const struct hsr_polygons *p,
                      const struct hsr_polygon_cycle *cycle) {
  const struct hsr_polygon_side *side = p->side + cycle->first;
  for (size_t k = 0; k < cycle->n; k++) {
    const double *a = side[k].at, *b = side[(k + 1) % cycle->n].at;
    add_error(g, fmin(a[1], b[1]), fmax(a[1], b[1]));
    if (a[1] < b[1])
      add_downward(g, a, b, 1);
    else if (a[1] > b[1])
      add_downward(g, b, a, -1);
  }
}

static void add_region(struct integral *g, const struct hsr_polygons *p,
                       const struct hsr_polygon_region *region) {
  g->face = region->face;
  g->largest = 0;
  find_colour(g, region->face, g->w);
  for (int c = 0; c < CHANNELS; c++) {
    g->w[c] -= g->background[c];
    g->largest = fmax(g->largest, fabs(g->w[c]));
  }
  for (size_t k = 0; k < region->n; k++)
    add_cycle(g, p, p->cycle + region->first + k);
}

/* --- Pixels --------------------------------------------------------------- */

/* How far a sum of row j, and the pixel's value, may be off. */
static double error_of(const struct integral *g, int j) {
  const struct hsr_view *view = g->job->view;
  const struct row *row = &g->row[j - view->window.y0];
  double d = 0x1p-46 * hsr_max_int(view->m, view->n);
  double terms = (double)row->pieces + view->m + 8;
  return row->weight * (2 * d + terms * 0x1p-51) + 0x1p-50;
}

/* The pixels of row j, from right to left. Returns the widest interval. */
static double write_row(const struct integral *g, int j) {
  const struct hsr_job *job = g->job;
  const struct hsr_window *w = &job->view->window;
  const struct sums *sums =
      g->sums + (size_t)(j - w->y0) * (size_t)job->view->m;
  struct hsr_area_bounds *row = hsr_answer_areas_of(job->answer) +
                                CHANNELS * (size_t)j * (size_t)job->answer->m;
  double error = error_of(g, j), right[CHANNELS] = {0, 0, 0}, widest = 0;
  for (int i = job->view->m - 1; i >= w->x0; i--) {
    struct hsr_area_bounds *to = row + CHANNELS * (size_t)i;
    for (int c = 0; c < CHANNELS; c++) {
      double value = g->background[c] + right[c] + sums[i].inside[c];
      right[c] += sums[i].left[c];
      if (i >= w->x1)
        continue;
      to[c] = (struct hsr_area_bounds){fmin(1, fmax(0, value - error)),
                                       fmax(0, fmin(1, value + error))};
      widest = fmax(widest, to[c].hi - to[c].lo);
    }
    if (i < w->x1)
      HSR_ACCEPTED(job->tally, g->counters.pixels, HSR_NOTHING, HSR_NOTHING,
                   HSR_AT(i, j), to);
  }
  return widest;
}

enum hsr_status hsr_integrate(const struct hsr_job *job,
                              const struct hsr_polygons *polygons,
                              struct hsr_integral_counters counters,
                              struct hsr_error *err) {
  const struct hsr_window *w = &job->view->window;
  size_t rows = (size_t)(w->y1 - w->y0), m = (size_t)job->view->m;
  struct integral g = {.job = job,
                       .counters = counters,
                       .sums =
                           HSR_NEW_ZEROED(job->scratch, struct sums, rows * m),
                       .row = HSR_NEW_ZEROED(job->scratch, struct row, rows)};
  if (!g.sums || !g.row)
    return hsr_fail_nomem(err);
  find_colour(&g, HSR_BACKGROUND, g.background);
  for (size_t k = 0; k < polygons->n_regions; k++)
    add_region(&g, polygons, &polygons->region[k]);
  double widest = 0, eps = hsr_form_area(&job->answer->form).eps;
  for (int j = w->y0; j < w->y1; j++)
    widest = fmax(widest, write_row(&g, j));
  return widest <= eps
             ? HSR_OK
             : hsr_fail(
                   err, HSR_E_REFUSED,
                   "weiler-atherton: areas are known within %.2g here: eps=%g "
                   "is less",
                   widest, eps);
}
