/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Borders of areas: where two of them meet, their division into strands, and on
 * which side a point lies. All cases are decided: borders may share lines,
 * stretches of lines, and points.
 *
 * Source      areas.h
 * Notation    a direction d of an edge is sign (b, -a), a and b being the
 *             coefficients of its line. The determinant of two directions has
 *             the sign of the turn from the first to the second. */
#include "algorithms/image_space/area/sorting/areas.h"

#include <math.h>
#include <stdlib.h>

void *hsr_clipper_item(struct hsr_clipper *c, struct hsr_growing *array,
                       size_t size) {
  if (hsr_named_lines_failed(c->lines) ||
      !hsr_arena_grow(c->arena, array, size)) {
    c->failed = true;
    return NULL;
  }
  return (char *)array->items + (array->n - 1) * size;
}

struct hsr_knot *hsr_clipper_knot(struct hsr_clipper *c, uint32_t point) {
  /* After a failure a point may have no number; then there is no item. */
  while (c->knots.n <= point) {
    struct hsr_knot *knot = HSR_CLIPPER_NEW(c, &c->knots, struct hsr_knot);
    if (!knot)
      return NULL;
    knot->round = 0;
  }
  struct hsr_knot *knot = &HSR_ITEM(struct hsr_knot, c->knots, point);
  if (knot->round != c->round)
    *knot = (struct hsr_knot){c->round, {0, 0}, {0, 0}};
  return knot;
}

struct hsr_border_edge hsr_border_make(const struct hsr_clipper *c,
                                       uint32_t line, int sign, uint32_t from,
                                       uint32_t to) {
  struct hsr_border_edge edge = {line, sign, from, to, {{0}}};
  hsr_crossing_at(c->lines, from, edge.at[0]);
  hsr_crossing_at(c->lines, to, edge.at[1]);
  return edge;
}

/* --- Directions ----------------------------------------------------------- */

static int turn(struct hsr_clipper *c, struct hsr_heading a,
                struct hsr_heading b) {
  return a.line == b.line
             ? 0
             : a.sign * b.sign * hsr_line_turn(c->lines, a.line, b.line);
}

/* In which part of a full turn a direction lies: 0, less than half; 1, half; 2,
 * more; 3, all of it. */
static int part_of_turn(struct hsr_clipper *c, struct hsr_heading from,
                        struct hsr_heading to, int hand) {
  int by = hand * turn(c, from, to);
  if (by)
    return by > 0 ? 0 : 2;
  return from.sign == to.sign ? 3 : 1;
}

bool hsr_border_precedes(struct hsr_clipper *c, struct hsr_heading from,
                         struct hsr_heading a, struct hsr_heading b, int hand) {
  int p = part_of_turn(c, from, a, hand), q = part_of_turn(c, from, b, hand);
  return p != q ? p < q : hand * turn(c, a, b) > 0;
}

/* --- Places along an edge ------------------------------------------------- */

/* Compares two points of the edge's line: negative if p comes before q. */
static int along(struct hsr_clipper *c, const struct hsr_border_edge *e,
                 uint32_t p, uint32_t q) {
  double d[2];
  hsr_line_direction(c->lines, e->line, d);
  int axis = d[0] * d[0] >= d[1] * d[1] ? 0 : 1;
  int way = d[axis] * e->sign > 0 ? 1 : -1;
  return way * hsr_crossing_compare(c->lines, p, q, axis);
}

bool hsr_border_between(struct hsr_clipper *c, const struct hsr_border_edge *e,
                        uint32_t p) {
  return p != e->from && p != e->to && along(c, e, e->from, p) < 0 &&
         along(c, e, p, e->to) < 0;
}

/* --- Where two edges meet ------------------------------------------------- */

static void divide_at(struct hsr_clipper *c, uint32_t polygon, uint32_t edge,
                      uint32_t point) {
  struct hsr_division *d =
      HSR_CLIPPER_NEW(c, &c->divisions, struct hsr_division);
  if (d)
    *d = (struct hsr_division){polygon, edge, point};
}

/* Whether x is certainly less than y. They are coordinates of points. */
static bool is_less(double x, double y) {
  return x + 0x1p-30 + 0x1p-48 * (fabs(x) + fabs(y)) < y;
}

static bool boxes_meet(const struct hsr_border_edge *a,
                       const struct hsr_border_edge *b) {
  for (int k = 0; k < 2; k++) {
    double a0 = a->at[0][k], a1 = a->at[1][k], b0 = b->at[0][k],
           b1 = b->at[1][k];
    if (is_less(a0 > a1 ? a0 : a1, b0 < b1 ? b0 : b1) ||
        is_less(b0 > b1 ? b0 : b1, a0 < a1 ? a0 : a1))
      return false;
  }
  return true;
}

static void cut_on_one_line(struct hsr_clipper *c,
                            const struct hsr_border_edge *a, uint32_t k,
                            const struct hsr_border_edge *b, uint32_t l,
                            uint32_t of) {
  const uint32_t ends_a[2] = {a->from, a->to}, ends_b[2] = {b->from, b->to};
  for (int e = 0; e < 2; e++) {
    if (hsr_border_between(c, a, ends_b[e]))
      divide_at(c, 0, k, ends_b[e]);
    if (hsr_border_between(c, b, ends_a[e]))
      divide_at(c, of, l, ends_a[e]);
  }
}

void hsr_border_cut(struct hsr_clipper *c, const struct hsr_border_edge *a,
                    uint32_t k, const struct hsr_border_edge *b, uint32_t l,
                    uint32_t of) {
  if (!boxes_meet(a, b))
    return;
  if (a->line == b->line) {
    cut_on_one_line(c, a, k, b, l, of);
    return;
  }
  int a0 = hsr_crossing_side(c->lines, a->from, b->line),
      a1 = hsr_crossing_side(c->lines, a->to, b->line);
  if (a0 * a1 > 0)
    return;
  int b0 = hsr_crossing_side(c->lines, b->from, a->line),
      b1 = hsr_crossing_side(c->lines, b->to, a->line);
  if (b0 * b1 > 0)
    return;
  if (a0 && a1 && b0 && b1) {
    uint32_t point = hsr_crossing(c->lines, a->line, b->line);
    divide_at(c, 0, k, point);
    divide_at(c, of, l, point);
    c->crossings++;
  } else if (a0 && a1) {
    divide_at(c, 0, k, b0 ? b->to : b->from);
  } else if (b0 && b1) {
    divide_at(c, of, l, a0 ? a->to : a->from);
  }
}

/* --- Strands -------------------------------------------------------------- */

static int by_edge(const void *a, const void *b) {
  const struct hsr_division *d = a, *e = b;
  if (d->polygon != e->polygon)
    return d->polygon < e->polygon ? -1 : 1;
  if (d->edge != e->edge)
    return d->edge < e->edge ? -1 : 1;
  return (d->point > e->point) - (d->point < e->point);
}

/* Sorts the n divisions of one edge along it, and leaves out repeated ones. */
static size_t sort_along(struct hsr_clipper *c, const struct hsr_border_edge *e,
                         struct hsr_division *d, size_t n) {
  size_t kept = 0;
  for (size_t k = 0; k < n; k++) {
    if (k && d[k].point == d[k - 1].point)
      continue;
    d[kept++] = d[k];
  }
  for (size_t k = 1; k < kept; k++) {
    struct hsr_division moved = d[k];
    size_t to = k;
    for (; to && along(c, e, moved.point, d[to - 1].point) < 0; to--)
      d[to] = d[to - 1];
    d[to] = moved;
  }
  return kept;
}

static void add_strand(struct hsr_clipper *c, const struct hsr_border_edge *e,
                       uint32_t from, uint32_t to, uint32_t of) {
  struct hsr_strand *strand =
      HSR_CLIPPER_NEW(c, &c->strands[of], struct hsr_strand);
  struct hsr_knot *knot = strand ? hsr_clipper_knot(c, from) : NULL;
  if (!knot)
    return;
  uint32_t number = (uint32_t)c->strands[of].n;
  strand->edge = hsr_border_make(c, e->line, e->sign, from, to);
  strand->where = HSR_OUTSIDE;
  strand->leaving = knot->leaving[of];
  knot->leaving[of] = number;
  knot = hsr_clipper_knot(c, to);
  if (!knot)
    return;
  strand->entering = knot->entering[of];
  knot->entering[of] = number;
}

void hsr_border_divide(struct hsr_clipper *c,
                       const struct hsr_border_edge *edge,
                       const uint32_t *start, uint32_t n_cycles, uint32_t of) {
  struct hsr_division *all = c->divisions.items;
  size_t at = 0, n = c->divisions.n;
  if (n && !of)
    qsort(all, n, sizeof *all, by_edge);
  while (at < n && all[at].polygon < of)
    at++;
  for (uint32_t cycle = 0; cycle < n_cycles && !c->failed; cycle++) {
    for (uint32_t k = start[cycle]; k < start[cycle + 1]; k++) {
      size_t first = at;
      while (at < n && all[at].polygon == of && all[at].edge == k)
        at++;
      size_t kept =
          at > first ? sort_along(c, &edge[k], all + first, at - first) : 0;
      uint32_t from = edge[k].from;
      for (size_t d = 0; d < kept; d++) {
        add_strand(c, &edge[k], from, all[first + d].point, of);
        from = all[first + d].point;
      }
      add_strand(c, &edge[k], from, edge[k].to, of);
    }
    uint32_t *end = HSR_CLIPPER_NEW(c, &c->ends[of], uint32_t);
    if (end)
      *end = (uint32_t)c->strands[of].n;
  }
}

/* --- On which side -------------------------------------------------------- */

/* Whether the edge crosses the ray that leaves p along sx. */
static bool crosses_right(struct hsr_clipper *c,
                          const struct hsr_border_edge *e, uint32_t p) {
  int from = hsr_crossing_compare(c->lines, e->from, p, 1) > 0,
      to = hsr_crossing_compare(c->lines, e->to, p, 1) > 0;
  if (from == to)
    return false;
  /* The area's side of the edge is that of lower sx if the edge runs down. */
  int side = e->sign * hsr_crossing_side(c->lines, p, e->line);
  return to ? side > 0 : side < 0;
}

/* The edge next to `heading` at p, counter-clockwise: if it leaves p, there is
 * no area before it, and if it enters, there is. */
struct nearest_edge {
  bool found, enters;
  struct hsr_heading heading;
};

static void meet(struct hsr_clipper *c, struct nearest_edge *nearest,
                 struct hsr_heading from, struct hsr_heading heading,
                 bool enters) {
  if (nearest->found &&
      !hsr_border_precedes(c, from, heading, nearest->heading, 1))
    return;
  *nearest = (struct nearest_edge){true, enters, heading};
}

bool hsr_border_is_within(struct hsr_clipper *c,
                          const struct hsr_border_edge *edge, uint32_t n,
                          uint32_t p, struct hsr_heading heading) {
  struct nearest_edge nearest = {.found = false};
  bool odd = false;
  for (uint32_t k = 0; k < n; k++) {
    const struct hsr_border_edge *e = &edge[k];
    if (e->from == p)
      meet(c, &nearest, heading, (struct hsr_heading){e->line, e->sign}, false);
    else if (e->to == p)
      meet(c, &nearest, heading, (struct hsr_heading){e->line, -e->sign}, true);
    else if (!hsr_crossing_side(c->lines, p, e->line) &&
             hsr_border_between(c, e, p))
      return turn(c, (struct hsr_heading){e->line, e->sign}, heading) > 0;
    else if (!nearest.found && crosses_right(c, e, p))
      odd = !odd;
  }
  return nearest.found ? nearest.enters : odd;
}
