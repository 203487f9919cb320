/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cubes against the quadtree: CouldCubeFaceBeVisible of the thesis, 5.4.2; and
 * what is not known of cells if the time ends before the tiling pass. */
#include "algorithms/hierarchical/bounded/bounded.h"
#include "common/base/clock.h"

#include <math.h>

/* --- Cubes ---------------------------------------------------------------- */

/* A side misses a square for certain if all of it lies beyond one edge, or beyond
 * the box of its corners; it covers the square if that lies within all edges. */
static enum hsr_meeting side_meets(const struct hsr_bounded_side *side,
                                   const struct hsr_square *square) {
  double reach = square->half + side->margin;
  double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
  double turn = 0;
  for (int k = 0; k < 4; k++) {
    int l = (k + 1) % 4;
    x0 = fmin(x0, side->x[k]), x1 = fmax(x1, side->x[k]);
    y0 = fmin(y0, side->y[k]), y1 = fmax(y1, side->y[k]);
    turn += side->x[k] * side->y[l] - side->x[l] * side->y[k];
  }
  if (x0 > square->x + reach || x1 < square->x - reach ||
      y0 > square->y + reach || y1 < square->y - reach)
    return HSR_MISSES;
  /* A side of a few margins may turn the other way round. */
  if (!(fabs(turn) > 64 * reach * (x1 - x0 + y1 - y0 + reach)))
    return HSR_MEETS;
  enum hsr_meeting meeting = HSR_COVERS;
  for (int k = 0; k < 4; k++) {
    int l = (k + 1) % 4;
    double dx = side->x[l] - side->x[k], dy = side->y[l] - side->y[k];
    double e = dx * (square->y - side->y[k]) - dy * (square->x - side->x[k]);
    double off = 2 * reach * (fabs(dx) + fabs(dy) + 2 * reach);
    if ((turn > 0 ? e : -e) < -off)
      return HSR_MISSES;
    if ((turn > 0 ? e : -e) < off)
      meeting = HSR_MEETS;
  }
  return meeting;
}

static double side_nearest(const struct hsr_bounded_side *side,
                           const struct hsr_square *square) {
  double q = side->a * square->x + side->b * square->y + side->c +
             (fabs(side->a) + fabs(side->b)) * square->half;
  return fmin(q, side->nearest);
}

/* --- CouldCubeFaceBeVisible ----------------------------------------------- */

static bool enqueue(struct hsr_bounded_tree *t, uint32_t c) {
  if (!hsr_arena_grow(t->job->scratch, &t->queue, sizeof c))
    return false;
  ((uint32_t *)t->queue.items)[t->queue.n - 1] = c;
  return true;
}

bool hsr_bounded_could_be_seen(struct hsr_bounded_tree *t,
                               const struct hsr_bounded_side *side,
                               uint64_t most, struct hsr_subject cube) {
  t->queue.n = 0;
  if (!enqueue(t, 0))
    return true;
  uint64_t visited = 0;
  for (size_t head = 0; head < t->queue.n; head++) {
    uint32_t c = ((uint32_t *)t->queue.items)[head];
    struct hsr_bounded_cell *cell = hsr_bounded_cell(t, c);
    struct hsr_square square = hsr_bounded_square(cell);
    double nearest = side_nearest(side, &square);
    if (cell->place == HSR_BOUNDED_OUTSIDE)
      continue;
    bool inside = cell->place == HSR_BOUNDED_INSIDE;
    if (inside)
      HSR_STEP(t->tally, HSR_BOUNDED_SIDE_CELLS, cube,
               hsr_bounded_subject(cell), hsr_bounded_window(t, cell), 0);
    if (inside && (++visited > most || hsr_bounded_is_late(t)))
      return true;
    if (side_meets(side, &square) == HSR_MISSES ||
        (inside && nearest < cell->far))
      continue;
    if (inside && (nearest > cell->near || cell->level <= -HSR_BOUNDED_TILING))
      return true;
    if (!cell->child && !hsr_bounded_split(t, c))
      return true;
    for (uint32_t k = 0; k < 4; k++)
      if (!enqueue(t, cell->child + k))
        return true;
  }
  return false;
}

/* --- When the time ends --------------------------------------------------- */

/* The clock is looked at now and then. */
bool hsr_bounded_is_late(struct hsr_bounded_tree *t) {
  if (!t->late && t->until < INFINITY && t->asked++ % 16 == 0)
    t->late = hsr_seconds_now() > t->until;
  return t->late;
}

static void leave_cell(struct hsr_bounded_tree *t, uint32_t c) {
  hsr_bounded_free_below(t, c);
  hsr_bounded_cell(t, c)->untiled = true;
}

/* Cells that lie beside the side are left as they are, down to pixels. */
static bool leave(struct hsr_bounded_tree *t,
                  const struct hsr_bounded_side *side, uint32_t c) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(t, c);
  struct hsr_square square = hsr_bounded_square(cell);
  bool inside = cell->place == HSR_BOUNDED_INSIDE;
  enum hsr_meeting meeting = side_meets(side, &square);
  if (cell->place == HSR_BOUNDED_OUTSIDE || cell->untiled ||
      meeting == HSR_MISSES ||
      (inside && side_nearest(side, &square) < cell->far))
    return true;
  if (inside && (cell->level <= 0 || (meeting == HSR_COVERS && !cell->child))) {
    leave_cell(t, c);
    return true;
  }
  if (!cell->child && !hsr_bounded_split(t, c))
    return false;
  for (uint32_t k = 0; k < 4; k++)
    if (!leave(t, side, cell->child + k))
      return false;
  return true;
}

bool hsr_bounded_leave(struct hsr_bounded_tree *t,
                       const struct hsr_bounded_side *side) {
  return leave(t, side, 0);
}

static void leave_all(struct hsr_bounded_tree *t, uint32_t c) {
  const struct hsr_bounded_cell *cell = hsr_bounded_cell(t, c);
  if (cell->place == HSR_BOUNDED_INSIDE && cell->far < INFINITY &&
      (cell->level <= 0 || !cell->child))
    leave_cell(t, c);
  else if (cell->place != HSR_BOUNDED_OUTSIDE && cell->child)
    for (uint32_t k = 0; k < 4; k++)
      leave_all(t, cell->child + k);
}

void hsr_bounded_leave_all(struct hsr_bounded_tree *t) {
  leave_all(t, 0);
}
