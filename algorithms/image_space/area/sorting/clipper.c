/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The polygon clipper of Weiler and Atherton: an area is divided by the border
 * of another into its parts inside and outside. Either may be concave and may
 * have holes.
 *
 * Source      areas.h
 * Notation    a is the area that is clipped, and is polygon 0; b is the one that
 *             it is clipped to, and is polygon 1.
 * Method      Both borders are divided where they meet. A strand of one is
 *             inside the other, outside it, or on its border. This changes only
 *             where the borders meet: there a border enters the other area or
 *             leaves it, and the directions of the strands about the point tell
 *             which. Between such points it stays as it is.
 *             inside   the strands of a inside b and those of b inside a; where
 *                      both run along each other, that of a
 *             outside  the strands of a outside b, those of b inside a turned
 *                      round, and those of a that run against one of b */
#include "algorithms/image_space/area/sorting/areas.h"

#include <float.h>
#include <math.h>

bool hsr_areas_apart(const struct hsr_area *a, const struct hsr_area *b) {
  for (int k = 0; k < 2; k++)
    if (a->hi[k] < b->lo[k] || b->hi[k] < a->lo[k])
      return true;
  return false;
}

/* More than what is lost below the least double. */
static const double LOST = 0x1p-900;

/* What an area covers of a direction n: the least and the greatest n . p of its
 * corners p, computed, and a bound of 2^48 times their errors. A coordinate has
 * a relative error of at most 2^-50. */
struct extent {
  double lo, hi, error;
};

static struct extent extent_along(const struct hsr_area *a, const double n[2]) {
  struct extent found = {DBL_MAX, -DBL_MAX, 0};
  for (uint32_t k = 0; k < a->n_edges; k++) {
    double x = n[0] * a->edge[k].at[0][0], y = n[1] * a->edge[k].at[0][1];
    double along = x + y;
    found.lo = along < found.lo ? along : found.lo;
    found.hi = along > found.hi ? along : found.hi;
    found.error += fabs(x) + fabs(y);
  }
  return found;
}

/* Whether a line along one of the edges of `of` has the two areas on different
 * sides. What is not finite makes the error so, and the answer false. */
static bool edge_separates(const struct hsr_area *of, const struct hsr_area *a,
                           const struct hsr_area *b) {
  for (uint32_t k = 0; k < of->n_edges; k++) {
    const struct hsr_border_edge *e = &of->edge[k];
    double n[2] = {e->at[1][1] - e->at[0][1], e->at[0][0] - e->at[1][0]};
    struct extent p = extent_along(a, n), q = extent_along(b, n);
    double bound = 0x1p-48 * (p.error + q.error) + LOST;
    if (p.lo - q.hi > bound || q.lo - p.hi > bound)
      return true;
  }
  return false;
}

enum { FEW_EDGES = 8 };

bool hsr_areas_beside(const struct hsr_area *a, const struct hsr_area *b) {
  return (b->n_edges <= FEW_EDGES && edge_separates(b, a, b)) ||
         (a->n_edges <= FEW_EDGES && edge_separates(a, a, b));
}

/* --- Where strands lie ---------------------------------------------------- */

static struct hsr_strand *strand(struct hsr_clipper *c, int of, uint32_t k) {
  return &HSR_ITEM(struct hsr_strand, c->strands[of], k);
}

/* Whether a strand of polygon `of` runs along s, or against it. */
static bool runs_with(struct hsr_clipper *c, const struct hsr_strand *s, int of,
                      const struct hsr_knot *knot, enum hsr_where *where) {
  for (uint32_t k = knot->leaving[of]; k; k = strand(c, of, k - 1)->leaving)
    if (strand(c, of, k - 1)->edge.to == s->edge.to) {
      *where = HSR_ALONG;
      return true;
    }
  for (uint32_t k = knot->entering[of]; k; k = strand(c, of, k - 1)->entering)
    if (strand(c, of, k - 1)->edge.from == s->edge.to) {
      *where = HSR_AGAINST;
      return true;
    }
  return false;
}

/* Of the strands of polygon `of` at a knot, the first one counter-clockwise from
 * s: whether it enters the knot. Then its area is on the side of s. */
static bool enters_area(struct hsr_clipper *c, const struct hsr_strand *s,
                        int of, const struct hsr_knot *knot) {
  struct hsr_heading from = {s->edge.line, s->edge.sign}, best = {0, 0};
  bool found = false, enters = false;
  for (int entering = 0; entering < 2; entering++)
    for (uint32_t k = entering ? knot->entering[of] : knot->leaving[of]; k;
         k = entering ? strand(c, of, k - 1)->entering
                      : strand(c, of, k - 1)->leaving) {
      const struct hsr_border_edge *e = &strand(c, of, k - 1)->edge;
      struct hsr_heading heading = {e->line, entering ? -e->sign : e->sign};
      if (found && !hsr_border_precedes(c, from, heading, best, 1))
        continue;
      best = heading;
      enters = entering;
      found = true;
    }
  return enters;
}

/* Where a strand lies that begins on the border of polygon `of`. */
static enum hsr_where place(struct hsr_clipper *c, const struct hsr_strand *s,
                            int of, const struct hsr_knot *knot) {
  enum hsr_where where;
  if (runs_with(c, s, of, knot, &where))
    return where;
  return enters_area(c, s, of, knot) ? HSR_INSIDE : HSR_OUTSIDE;
}

static bool is_tied(const struct hsr_knot *knot, int of) {
  return knot && knot->leaving[of];
}

/* Places the strands [first, end) of polygon `of`, a cycle, against the other
 * one. */
static void place_cycle(struct hsr_clipper *c, int of, uint32_t first,
                        uint32_t end, const struct hsr_area *other) {
  uint32_t n = end - first, begin = 0;
  while (begin < n &&
         !is_tied(hsr_clipper_knot(c, strand(c, of, first + begin)->edge.from),
                  1 - of))
    begin++;
  enum hsr_where where = HSR_OUTSIDE;
  if (begin == n) {
    const struct hsr_border_edge *e = &strand(c, of, first)->edge;
    if (hsr_border_is_within(c, other->edge, other->n_edges, e->from,
                             (struct hsr_heading){e->line, e->sign}))
      where = HSR_INSIDE;
    begin = 0;
  }
  for (uint32_t k = 0; k < n && !c->failed; k++) {
    struct hsr_strand *s = strand(c, of, first + (begin + k) % n);
    const struct hsr_knot *knot = hsr_clipper_knot(c, s->edge.from);
    if (is_tied(knot, 1 - of))
      where = place(c, s, 1 - of, knot);
    s->where = where;
  }
}

static void place_all(struct hsr_clipper *c, int of,
                      const struct hsr_area *other) {
  uint32_t first = 0;
  for (size_t k = 0; k < c->ends[of].n && !c->failed; k++) {
    uint32_t end = HSR_ITEM(uint32_t, c->ends[of], k);
    place_cycle(c, of, first, end, other);
    first = end;
  }
}

/* --- Clipping ------------------------------------------------------------- */

static bool has(struct hsr_clipper *c, int of, enum hsr_where where) {
  for (uint32_t k = 0; k < c->strands[of].n; k++)
    if (strand(c, of, k)->where == where)
      return true;
  return false;
}

static void add_all(struct hsr_clipper *c, int of, enum hsr_where where,
                    bool turned) {
  for (uint32_t k = 0; k < c->strands[of].n && !c->failed; k++) {
    if (strand(c, of, k)->where != where)
      continue;
    struct hsr_border_edge e = strand(c, of, k)->edge;
    if (turned)
      e = hsr_border_make(c, e.line, -e.sign, e.to, e.from);
    hsr_border_add(c, &e);
  }
}

static void divide_both(struct hsr_clipper *c, const struct hsr_area *a,
                        const struct hsr_area *b) {
  c->round++;
  c->divisions.n = 0;
  for (int of = 0; of < 2; of++)
    c->strands[of].n = c->ends[of].n = 0;
  for (uint32_t k = 0; k < a->n_edges; k++)
    for (uint32_t l = 0; l < b->n_edges; l++)
      hsr_border_cut(c, &a->edge[k], k, &b->edge[l], l, 1);
  hsr_border_divide(c, a->edge, a->start, a->n_cycles, 0);
  hsr_border_divide(c, b->edge, b->start, b->n_cycles, 1);
}

bool hsr_areas_clip(struct hsr_clipper *c, struct hsr_area *a,
                    const struct hsr_area *by, struct hsr_area_list *inside,
                    struct hsr_area_list *outside) {
  divide_both(c, a, by);
  if (c->failed)
    return false;
  place_all(c, 0, by);
  place_all(c, 1, a);
  if (c->failed || (!has(c, 0, HSR_INSIDE) && !has(c, 0, HSR_ALONG) &&
                    !has(c, 1, HSR_INSIDE)))
    return false;
  add_all(c, 0, HSR_INSIDE, false);
  add_all(c, 0, HSR_ALONG, false);
  add_all(c, 1, HSR_INSIDE, false);
  hsr_areas_of_border(c, a->face, a->nearest, inside);
  add_all(c, 0, HSR_OUTSIDE, false);
  add_all(c, 0, HSR_AGAINST, false);
  add_all(c, 1, HSR_INSIDE, true);
  hsr_areas_of_border(c, a->face, a->nearest, outside);
  hsr_area_free(c, a);
  return true;
}

/* --- Halves of the picture ------------------------------------------------ */

struct hsr_area *hsr_area_of_half(struct hsr_clipper *c, uint32_t line,
                                  int sign) {
  uint32_t border[HSR_N_BORDERS], corner[HSR_N_BORDERS];
  int way[HSR_N_BORDERS], side[HSR_N_BORDERS];
  for (uint32_t k = 0; k < HSR_N_BORDERS; k++)
    border[k] = hsr_line_number(
        c->lines, (struct hsr_line_name){HSR_LINE_BORDER, k, 0}, &way[k]);
  /* Left, top, right, bottom: corner k is where side k begins, for one who has
   * the picture on the right. */
  for (uint32_t k = 0; k < HSR_N_BORDERS; k++) {
    corner[k] = hsr_crossing(c->lines, border[(k + 3) % 4], border[k]);
    side[k] = line == HSR_NO_LINE
                  ? 1
                  : sign * hsr_crossing_side(c->lines, corner[k], line);
  }
  uint32_t gap_from = HSR_NO_POINT, gap_to = HSR_NO_POINT;
  bool any = false;
  for (uint32_t k = 0; k < HSR_N_BORDERS; k++) {
    uint32_t next = (k + 1) % HSR_N_BORDERS;
    if (side[k] <= 0 && side[next] <= 0)
      continue;
    uint32_t from = corner[k], to = corner[next];
    if (side[k] < 0)
      from = hsr_crossing(c->lines, border[k], line);
    if (side[next] < 0)
      to = hsr_crossing(c->lines, border[k], line);
    if (side[k] <= 0)
      gap_to = from;
    if (side[next] <= 0)
      gap_from = to;
    struct hsr_border_edge e = hsr_border_make(c, border[k], way[k], from, to);
    hsr_border_add(c, &e);
    any = true;
  }
  if (!any)
    return NULL;
  if (gap_from != gap_to) {
    struct hsr_border_edge e = hsr_border_make(c, line, sign, gap_from, gap_to);
    hsr_border_add(c, &e);
  }
  struct hsr_area_list list = {NULL, NULL};
  hsr_areas_of_border(c, HSR_NO_ID, 0, &list);
  return list.first;
}
