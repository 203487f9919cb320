/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Refining where the filter is the pixel itself: area sampling. The thesis,
 * 5.4.3.
 *
 * Interval    a cell of at most a pixel holds bounds of its own part of the
 *             pixel's integral; the bounds of a cell that has children are the
 *             sums of theirs. A cell of more than a pixel holds bounds for each
 *             of its pixels.
 * Rounding    what is not negative and exact but for u = 2^-53 of itself is
 *             moved outward by 2^-51 of itself in every sum of four
 * Departures  a cell of more than a pixel is divided only if its polygons have
 *             more than one colour. What belongs to a pixel is given back when
 *             it is done. */
#include "algorithms/hierarchical/bounded/refine.h"
#include "common/answers/kinds/area.h"

#include <math.h>

static void bound(const struct hsr_bounded_refining *r, uint32_t c) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(r->tree, c);
  double area = cell->level < 0 ? ldexp(1, 2 * cell->level) : 1;
  hsr_bounded_mean(r->tree, cell, r->limits->exact, cell->lo, cell->hi);
  for (int k = 0; k < 3; k++) {
    cell->lo[k] *= area;
    cell->hi[k] *= area;
  }
}

/* The bounds of a cell by those of its children; they never become wider. */
static void sum_children(const struct hsr_bounded_tree *t,
                         struct hsr_bounded_cell *cell, bool first) {
  for (int c = 0; c < 3; c++) {
    double lo = 0, hi = 0;
    for (uint32_t k = 0; k < 4; k++) {
      const struct hsr_bounded_cell *child =
          hsr_bounded_cell(t, cell->child + k);
      lo = hsr_bounded_down(lo + child->lo[c], 0x1p-51);
      hi = hsr_bounded_up(hi + child->hi[c], 0x1p-51);
    }
    cell->lo[c] = first ? lo : fmax(cell->lo[c], lo);
    cell->hi[c] = first ? hi : fmin(cell->hi[c], hi);
  }
}

static void write_pixel(const struct hsr_bounded_refining *r,
                        const struct hsr_bounded_cell *cell, int i, int j) {
  struct hsr_area_bounds *to =
      r->answer + 3 * ((size_t)j * (size_t)r->tree->job->answer->m + (size_t)i);
  for (int c = 0; c < 3; c++)
    to[c] = (struct hsr_area_bounds){cell->lo[c], fmin(1, cell->hi[c])};
}

/* A pixel, or all pixels of a larger cell. */
static void write_pixels(const struct hsr_bounded_refining *r,
                         const struct hsr_bounded_cell *cell) {
  struct hsr_window w = hsr_bounded_window(r->tree, cell);
  for (int j = w.y0; j < w.y1; j++)
    for (int i = w.x0; i < w.x1; i++)
      write_pixel(r, cell, i, j);
}

/* A pixel, or all pixels of a larger cell: no more is done there. */
static void accept(struct hsr_bounded_refining *r, uint32_t c) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(r->tree, c);
  struct hsr_window w = hsr_bounded_window(r->tree, cell);
  cell->done = true;
  for (int j = w.y0; j < w.y1; j++)
    for (int i = w.x0; i < w.x1; i++) {
      write_pixel(r, cell, i, j);
      hsr_bounded_accept(r, i, j);
    }
  hsr_bounded_free_below(r->tree, c);
}

static bool is_narrow(const struct hsr_bounded_refining *r,
                      const struct hsr_bounded_cell *cell) {
  return hsr_bounded_width(cell->lo, cell->hi) <= r->limits->form.eps;
}

/* --- What the tiling pass left -------------------------------------------- */

static bool push(struct hsr_bounded_refining *r, uint32_t c, uint32_t pixel) {
  const struct hsr_bounded_cell *cell = hsr_bounded_cell(r->tree, c);
  struct hsr_bounded_item item = {hsr_bounded_width(cell->lo, cell->hi), c,
                                  pixel, -cell->level};
  return item.depth >= r->limits->deepest || !(item.uncertainty > 0) ||
         hsr_bounded_push(&r->queue, item);
}

static bool push_leaves(struct hsr_bounded_refining *r, uint32_t c,
                        uint32_t pixel) {
  uint32_t child = hsr_bounded_cell(r->tree, c)->child;
  if (!child)
    return push(r, c, pixel);
  for (uint32_t k = 0; k < 4; k++)
    if (!push_leaves(r, child + k, pixel))
      return false;
  return true;
}

/* Bounds of all leaves, and of the cells above them that are within a pixel. */
static void bound_all(const struct hsr_bounded_refining *r, uint32_t c) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(r->tree, c);
  if (!cell->child) {
    if (!hsr_bounded_is_late(r->tree))
      hsr_bounded_settle(r->tree, c);
    bound(r, c);
    return;
  }
  for (uint32_t k = 0; k < 4; k++)
    bound_all(r, cell->child + k);
  sum_children(r->tree, cell, true);
}

/* Every cell of at least a pixel: accepted, or divided down to its pixels while
 * there is time. */
static bool begin_cell(struct hsr_bounded_refining *r, uint32_t c) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(r->tree, c);
  if (cell->place == HSR_BOUNDED_OUTSIDE)
    return true;
  if (cell->place == HSR_BOUNDED_INSIDE && (cell->level == 0 || !cell->child)) {
    bound_all(r, c);
    if (is_narrow(r, cell)) {
      accept(r, c);
      return true;
    }
    if (cell->level == 0 || hsr_bounded_is_late(r->tree)) {
      r->unfinished++;
      return r->tree->late || push_leaves(r, c, c);
    }
    if (!hsr_bounded_split(r->tree, c))
      return false;
  }
  for (uint32_t k = 0; k < 4; k++)
    if (!begin_cell(r, cell->child + k))
      return false;
  return true;
}

static bool begin(struct hsr_bounded_refining *r) {
  return begin_cell(r, 0);
}

/* --- Refining ------------------------------------------------------------- */

/* PropagateUncertainty: up to the pixel. */
static void propagate(struct hsr_bounded_refining *r, uint32_t c) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(r->tree, c);
  sum_children(r->tree, cell, false);
  while (cell->level < 0) {
    c = cell->parent;
    cell = hsr_bounded_cell(r->tree, c);
    sum_children(r->tree, cell, false);
  }
  if (is_narrow(r, cell)) {
    accept(r, c);
    r->unfinished--;
  }
}

/* What is below a pixel that is done is no more. */
static bool is_wanted(const struct hsr_bounded_refining *r,
                      const struct hsr_bounded_item *item) {
  return !hsr_bounded_cell(r->tree, item->pixel)->done;
}

static bool refine(struct hsr_bounded_refining *r,
                   const struct hsr_bounded_item *item) {
  struct hsr_bounded_tree *t = r->tree;
  if (!hsr_bounded_split(t, item->cell))
    return false;
  uint32_t child = hsr_bounded_cell(t, item->cell)->child;
  for (uint32_t k = 0; k < 4; k++)
    bound(r, child + k);
  propagate(r, item->cell);
  for (uint32_t k = 0; k < 4 && is_wanted(r, item); k++)
    if (!push(r, child + k, item->pixel))
      return false;
  return true;
}

/* --- Pixels that are not done --------------------------------------------- */

/* A leaf of more than a pixel is one that there was no time to divide. */
static void write_cell(struct hsr_bounded_refining *r, uint32_t c,
                       bool accepted) {
  const struct hsr_bounded_cell *cell = hsr_bounded_cell(r->tree, c);
  if (cell->place == HSR_BOUNDED_OUTSIDE || cell->done)
    return;
  if (cell->level > 0 && cell->child)
    for (uint32_t k = 0; k < 4; k++)
      write_cell(r, cell->child + k, accepted);
  else if (accepted)
    accept(r, c);
  else
    write_pixels(r, cell);
}

static void write(struct hsr_bounded_refining *r) {
  write_cell(r, 0, false);
}

static void accept_rest(struct hsr_bounded_refining *r) {
  write_cell(r, 0, true);
}

const struct hsr_bounded_way hsr_bounded_within_pixels = {
    .begin = begin,
    .is_wanted = is_wanted,
    .refine = refine,
    .write = write,
    .accept_rest = accept_rest};
