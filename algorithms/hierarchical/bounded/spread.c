/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Refining for filters wider than a pixel: what is seen in a cell counts in all
 * pixels within the filter's reach. The thesis, 5.4.3, last paragraph.
 *
 * Notation    f is the filter, a product of B-splines (docs/area-picture.md);
 *             the weight of a cell in a pixel is the integral of f over the
 *             cell, a product of two differences of the spline's integral.
 * Interval    let A be the cell's area, w its weight, f between f0 and f1 on
 *             it; let the colour be between c0 and c1 on it, and its mean
 *             between m0 and m1. Then the integral of f times colour lies
 *             between w m0 and w m1, but for A (f1 - f0) (c1 - c0) / 4: Gruss'
 *             inequality for the covariance of two bounded functions. It also
 *             lies between w c0 and w c1. The thesis multiplies the intervals
 *             of f and of the colour; this is narrower.
 * Sums        a pixel keeps the sum of its cells' bounds. When a cell is
 *             divided, its bounds are taken back and those of its four children
 *             added.
 * Rounding    a weight is within 2^-48 of the cell's side, all else within
 *             2^-50 of 1 for each cell that is added or taken back; `slack`
 *             grows by both.
 * Departures  the cells of a pixel that is done stay, since its neighbours may
 *             need them */
#include "algorithms/hierarchical/bounded/refine.h"
#include "common/answers/kinds/area.h"

#include <math.h>

/* One pixel: bounds of its integral, and the best ones of its value. */
struct sum {
  double lo[3], hi[3], slack;
  double best_lo[3], best_hi[3];
  bool done;
};

struct hsr_bounded_spread {
  struct sum *sum; /* of the window's pixels, row by row */
  double *across,
      *down; /* the filter's integral over the screen, of each column and
                            row of the window */
  struct hsr_window window;
};

int hsr_bounded_reach(enum hsr_area_filter filter) {
  return filter == HSR_AREA_BOX ? 0 : filter == HSR_AREA_CUBIC ? 2 : 1;
}

/* --- The filter ----------------------------------------------------------- */

/* f(u), u not negative. */
static double filter_at(enum hsr_area_filter filter, double u) {
  double s;
  switch (filter) {
  case HSR_AREA_TENT:
    return u < 1 ? 1 - u : 0;
  case HSR_AREA_QUADRATIC:
    s = 1.5 - u;
    return u < .5 ? .75 - u * u : u < 1.5 ? s * s / 2 : 0;
  case HSR_AREA_CUBIC:
    s = 2 - u;
    return u < 1 ? 2.0 / 3 - u * u + u * u * u / 2 : u < 2 ? s * s * s / 6 : 0;
  default:
    return u < .5;
  }
}

/* Its integral from 0 to u, u not negative. */
static double integral_to(enum hsr_area_filter filter, double u) {
  double s;
  switch (filter) {
  case HSR_AREA_TENT:
    return u < 1 ? u - u * u / 2 : .5;
  case HSR_AREA_QUADRATIC:
    s = 1.5 - u;
    return u < .5 ? .75 * u - u * u * u / 3 : u < 1.5 ? .5 - s * s * s / 6 : .5;
  case HSR_AREA_CUBIC:
    s = 2 - u;
    return u < 1   ? u * (2.0 / 3) - u * u * u / 3 + u * u * u * u / 8
           : u < 2 ? .5 - s * s * s * s / 24
                   : .5;
  default:
    return fmin(u, .5);
  }
}

/* What of the filter lies in a stretch of the screen, for a pixel in the middle
 * of which is 0; and between which values it is there. */
struct stretch {
  double weight, least, most;
};

static struct stretch stretch_of(enum hsr_area_filter filter, double from,
                                 double to) {
  double a = fabs(from), b = fabs(to);
  double near = from < 0 && to > 0 ? 0 : fmin(a, b);
  double weight = copysign(integral_to(filter, b), to) -
                  copysign(integral_to(filter, a), from);
  return (struct stretch){fmax(0, weight), filter_at(filter, fmax(a, b)),
                          filter_at(filter, near)};
}

/* --- What a cell gives to pixels ------------------------------------------ */

/* The pixels of the window that a cell counts in. */
static struct hsr_window reached(const struct hsr_bounded_refining *r,
                                 const struct hsr_bounded_cell *cell) {
  const struct hsr_window *w = &r->spread->window;
  struct hsr_square s = hsr_bounded_square(cell);
  int by = hsr_bounded_reach(r->limits->form.filter);
  int x0 = (int)floor(s.x - s.half) - by, y0 = (int)floor(s.y - s.half) - by;
  int x1 = (int)ceil(s.x + s.half) + by, y1 = (int)ceil(s.y + s.half) + by;
  return hsr_window_make(x0 > w->x0 ? x0 : w->x0, y0 > w->y0 ? y0 : w->y0,
                         x1 < w->x1 ? x1 : w->x1, y1 < w->y1 ? y1 : w->y1);
}

static struct sum *sum_of(const struct hsr_bounded_refining *r, int i, int j) {
  const struct hsr_window *w = &r->spread->window;
  return &r->spread->sum[(size_t)(j - w->y0) * (size_t)(w->x1 - w->x0) +
                         (size_t)(i - w->x0)];
}

/* What is known of the colours in a cell. */
struct colours {
  double least[3], most[3], mean_lo[3], mean_hi[3];
};

static struct colours colours_of(const struct hsr_bounded_refining *r,
                                 const struct hsr_bounded_cell *cell) {
  struct colours of;
  hsr_bounded_hull(r->tree, cell, of.least, of.most);
  for (int c = 0; c < 3; c++) {
    of.mean_lo[c] = cell->lo[c];
    of.mean_hi[c] = cell->hi[c];
  }
  return of;
}

/* The bounds of what a cell gives to one pixel. */
static void give(const struct colours *of, const struct hsr_square *square,
                 struct stretch x, struct stretch y, double lo[3],
                 double hi[3]) {
  double weight = x.weight * y.weight, area = 4 * square->half * square->half;
  double spread = area * (x.most * y.most - x.least * y.least) / 4;
  for (int c = 0; c < 3; c++) {
    double off = spread * (of->most[c] - of->least[c]);
    lo[c] = fmax(weight * of->least[c], weight * of->mean_lo[c] - off);
    hi[c] = fmin(weight * of->most[c], weight * of->mean_hi[c] + off);
  }
}

/* Adds what a leaf gives to its pixels, or takes it back: sign -1. Returns the
 * most uncertainty that it gives to a pixel that is not done. */
static double add_cell(struct hsr_bounded_refining *r,
                       const struct hsr_bounded_cell *cell, int sign) {
  enum hsr_area_filter filter = r->limits->form.filter;
  struct hsr_square s = hsr_bounded_square(cell);
  struct hsr_window w = reached(r, cell);
  struct colours of = colours_of(r, cell);
  double most = 0, lo[3], hi[3];
  for (int j = w.y0; j < w.y1; j++) {
    struct stretch y =
        stretch_of(filter, s.y - s.half - (j + .5), s.y + s.half - (j + .5));
    for (int i = w.x0; i < w.x1; i++) {
      struct sum *sum = sum_of(r, i, j);
      give(&of, &s,
           stretch_of(filter, s.x - s.half - (i + .5), s.x + s.half - (i + .5)),
           y, lo, hi);
      for (int c = 0; c < 3; c++) {
        sum->lo[c] += sign * lo[c];
        sum->hi[c] += sign * hi[c];
      }
      sum->slack += 0x1p-47 * s.half + 0x1p-50;
      if (!sum->done)
        most = fmax(most, hsr_bounded_width(lo, hi));
    }
  }
  return most;
}

/* --- Pixels --------------------------------------------------------------- */

/* The value is the integral over the filter's integral over the screen. */
static void update(const struct hsr_bounded_refining *r, int i, int j) {
  const struct hsr_bounded_spread *spread = r->spread;
  struct sum *sum = sum_of(r, i, j);
  double whole = spread->across[i - spread->window.x0] *
                 spread->down[j - spread->window.y0];
  for (int c = 0; c < 3; c++) {
    double lo = fmax(0, (sum->lo[c] - sum->slack) / whole);
    double hi = (sum->hi[c] + sum->slack) / whole;
    sum->best_lo[c] = fmax(sum->best_lo[c], hsr_bounded_down(lo, 0x1p-47));
    sum->best_hi[c] = fmin(sum->best_hi[c], hsr_bounded_up(hi, 0x1p-47));
  }
}

static void write_pixel(const struct hsr_bounded_refining *r, int i, int j) {
  const struct sum *sum = sum_of(r, i, j);
  struct hsr_area_bounds *to =
      r->answer + 3 * ((size_t)j * (size_t)r->tree->job->answer->m + (size_t)i);
  for (int c = 0; c < 3; c++)
    to[c] = (struct hsr_area_bounds){sum->best_lo[c], sum->best_hi[c]};
}

static void accept(struct hsr_bounded_refining *r, int i, int j) {
  sum_of(r, i, j)->done = true;
  write_pixel(r, i, j);
  hsr_bounded_accept(r, i, j);
  r->unfinished--;
}

/* The pixels of a part of the window: the narrow ones are accepted. */
static void look_at(struct hsr_bounded_refining *r, struct hsr_window w) {
  for (int j = w.y0; j < w.y1; j++)
    for (int i = w.x0; i < w.x1; i++) {
      struct sum *sum = sum_of(r, i, j);
      if (sum->done)
        continue;
      update(r, i, j);
      if (hsr_bounded_width(sum->best_lo, sum->best_hi) <= r->limits->form.eps)
        accept(r, i, j);
    }
}

/* --- What the tiling pass left -------------------------------------------- */

static bool make_spread(struct hsr_bounded_refining *r) {
  const struct hsr_job *job = r->tree->job;
  struct hsr_arena *arena = job->scratch;
  struct hsr_window w = r->limits->window;
  enum hsr_area_filter filter = r->limits->form.filter;
  size_t m = (size_t)(w.x1 - w.x0), n = (size_t)(w.y1 - w.y0);
  struct hsr_bounded_spread *spread =
      HSR_NEW(arena, struct hsr_bounded_spread, 1);
  r->spread = spread;
  if (!spread)
    return false;
  *spread = (struct hsr_bounded_spread){
      .sum = HSR_NEW_ZEROED(arena, struct sum, m * n),
      .across = HSR_NEW(arena, double, m),
      .down = HSR_NEW(arena, double, n),
      .window = w};
  if (!spread->sum || !spread->across || !spread->down)
    return false;
  for (int i = w.x0; i < w.x1; i++)
    spread->across[i - w.x0] =
        stretch_of(filter, -(i + .5), job->view->m - (i + .5)).weight;
  for (int j = w.y0; j < w.y1; j++)
    spread->down[j - w.y0] =
        stretch_of(filter, -(j + .5), job->view->n - (j + .5)).weight;
  for (size_t k = 0; k < m * n; k++)
    for (int c = 0; c < 3; c++)
      spread->sum[k].best_hi[c] = 1;
  r->unfinished = m * n;
  return true;
}

/* Bounds the mean over a leaf, adds it to its pixels, and queues the leaf. */
static bool add_leaf(struct hsr_bounded_refining *r, uint32_t c) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(r->tree, c);
  hsr_bounded_mean(r->tree, cell, r->limits->exact, cell->lo, cell->hi);
  struct hsr_bounded_item item = {add_cell(r, cell, 1), c, c, -cell->level};
  return item.depth < 0 || item.depth >= r->limits->deepest ||
         !(item.uncertainty > 0) || hsr_bounded_push(&r->queue, item);
}

/* All leaves. One of more than a pixel is divided unless it has one colour, while
 * there is time. */
static bool add_all(struct hsr_bounded_refining *r, uint32_t c) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(r->tree, c);
  if (cell->place == HSR_BOUNDED_OUTSIDE)
    return true;
  if (!cell->child && hsr_bounded_is_late(r->tree))
    return add_leaf(r, c);
  if (!cell->child) {
    double low[3], high[3];
    hsr_bounded_settle(r->tree, c);
    hsr_bounded_hull(r->tree, cell, low, high);
    if (cell->level <= 0 || !(hsr_bounded_width(low, high) > 0))
      return add_leaf(r, c);
    if (!hsr_bounded_split(r->tree, c))
      return false;
  }
  for (uint32_t k = 0; k < 4; k++)
    if (!add_all(r, cell->child + k))
      return false;
  return true;
}

static bool begin(struct hsr_bounded_refining *r) {
  if (!make_spread(r) || !add_all(r, 0))
    return false;
  look_at(r, r->spread->window);
  return true;
}

/* --- Refining ------------------------------------------------------------- */

static bool is_wanted(const struct hsr_bounded_refining *r,
                      const struct hsr_bounded_item *item) {
  struct hsr_window w = reached(r, hsr_bounded_cell(r->tree, item->cell));
  for (int j = w.y0; j < w.y1; j++)
    for (int i = w.x0; i < w.x1; i++)
      if (!sum_of(r, i, j)->done)
        return true;
  return false;
}

static bool refine(struct hsr_bounded_refining *r,
                   const struct hsr_bounded_item *item) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(r->tree, item->cell);
  add_cell(r, cell, -1);
  if (!hsr_bounded_split(r->tree, item->cell))
    return false;
  for (uint32_t k = 0; k < 4; k++)
    if (!add_leaf(r, cell->child + k))
      return false;
  look_at(r, reached(r, cell));
  return true;
}

/* --- Pixels that are not done --------------------------------------------- */

static void write(struct hsr_bounded_refining *r) {
  const struct hsr_window *w = &r->spread->window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      if (!sum_of(r, i, j)->done)
        write_pixel(r, i, j);
}

static void accept_rest(struct hsr_bounded_refining *r) {
  const struct hsr_window *w = &r->spread->window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      if (!sum_of(r, i, j)->done)
        accept(r, i, j);
}

const struct hsr_bounded_way hsr_bounded_across_pixels = {
    .begin = begin,
    .is_wanted = is_wanted,
    .refine = refine,
    .write = write,
    .accept_rest = accept_rest};
