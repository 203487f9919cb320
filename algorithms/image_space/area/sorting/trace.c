/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From edges in any order to areas: cycles, holes, and the memory of both.
 *
 * Source      areas.h
 * Tracing     the interior is on one side of every edge. After an edge that
 *             enters a point comes the first one that leaves it, for one who
 *             turns clockwise in (sx, sy) from the way back: between the two
 *             there is nothing but interior. So each cycle borders one part of
 *             the interior, and parts that touch in a point are apart. */
#include "algorithms/image_space/area/sorting/areas.h"

#include <math.h>
#include <string.h>

/* --- Lists ---------------------------------------------------------------- */

void hsr_areas_push(struct hsr_area_list *list, struct hsr_area *area) {
  area->next = NULL;
  if (list->last)
    list->last->next = area;
  else
    list->first = area;
  list->last = area;
}

struct hsr_area *hsr_areas_pop(struct hsr_area_list *list) {
  struct hsr_area *area = list->first;
  if (area)
    list->first = area->next;
  if (!list->first)
    list->last = NULL;
  return area;
}

void hsr_areas_join(struct hsr_area_list *list, struct hsr_area_list *more) {
  if (!more->first)
    return;
  if (list->last)
    list->last->next = more->first;
  else
    list->first = more->first;
  list->last = more->last;
  *more = (struct hsr_area_list){NULL, NULL};
}

/* --- Memory --------------------------------------------------------------- */

static size_t bytes_of(uint32_t n_cycles, uint32_t n_edges) {
  return sizeof(struct hsr_area) + n_edges * sizeof(struct hsr_border_edge) +
         (n_cycles + 1) * sizeof(uint32_t);
}

/* An area with room for cycles and edges. Sizes are powers of two, so that what
 * is given back fits again. */
static struct hsr_area *new_area(struct hsr_clipper *c, uint32_t n_cycles,
                                 uint32_t n_edges) {
  size_t bytes = bytes_of(n_cycles, n_edges);
  int size_class = 8;
  while ((size_t)1 << size_class < bytes)
    size_class++;
  if (size_class >= HSR_AREA_CLASSES) {
    c->failed = true;
    return NULL;
  }
  struct hsr_area *area = c->kept[size_class];
  if (area)
    c->kept[size_class] = area->next;
  else
    area = hsr_arena_array(c->arena, (size_t)1 << size_class, 1);
  if (!area) {
    c->failed = true;
    return NULL;
  }
  *area = (struct hsr_area){
      .n_cycles = n_cycles, .n_edges = n_edges, .size_class = size_class};
  area->edge = (struct hsr_border_edge *)(area + 1);
  area->start = (uint32_t *)(area->edge + n_edges);
  return area;
}

void hsr_area_free(struct hsr_clipper *c, struct hsr_area *area) {
  area->next = c->kept[area->size_class];
  c->kept[area->size_class] = area;
}

/* --- Cycles --------------------------------------------------------------- */

void hsr_border_add(struct hsr_clipper *c, const struct hsr_border_edge *edge) {
  struct hsr_loose_edge *loose =
      HSR_CLIPPER_NEW(c, &c->border, struct hsr_loose_edge);
  if (loose)
    *loose = (struct hsr_loose_edge){*edge, 0, false};
}

static struct hsr_loose_edge *loose_edge(struct hsr_clipper *c, uint32_t k) {
  return &HSR_ITEM(struct hsr_loose_edge, c->border, k);
}

/* Lists the edges by the points that they leave. */
static void tie(struct hsr_clipper *c) {
  c->round++;
  for (uint32_t k = 0; k < c->border.n; k++) {
    struct hsr_knot *knot = hsr_clipper_knot(c, loose_edge(c, k)->edge.from);
    if (!knot)
      return;
    loose_edge(c, k)->next = knot->leaving[0];
    knot->leaving[0] = k + 1;
  }
}

static struct hsr_heading heading_of(const struct hsr_border_edge *e, int way) {
  return (struct hsr_heading){e->line, way * e->sign};
}

/* The edge that comes after this one, or NULL. */
static struct hsr_loose_edge *follow(struct hsr_clipper *c,
                                     const struct hsr_border_edge *e) {
  struct hsr_knot *knot = hsr_clipper_knot(c, e->to);
  struct hsr_loose_edge *best = NULL;
  for (uint32_t k = knot ? knot->leaving[0] : 0; k;
       k = loose_edge(c, k - 1)->next) {
    struct hsr_loose_edge *other = loose_edge(c, k - 1);
    if (!best ||
        hsr_border_precedes(c, heading_of(e, -1), heading_of(&other->edge, 1),
                            heading_of(&best->edge, 1), -1))
      best = other;
  }
  return best;
}

/* Puts the edges of the cycle that begins with `first` into the path. */
static void trace_cycle(struct hsr_clipper *c, struct hsr_loose_edge *first) {
  c->path.n = 0;
  for (struct hsr_loose_edge *e = first; e && !e->taken;
       e = follow(c, &e->edge)) {
    struct hsr_border_edge *next =
        HSR_CLIPPER_NEW(c, &c->path, struct hsr_border_edge);
    if (!next)
      return;
    *next = e->edge;
    e->taken = true;
  }
  const struct hsr_border_edge *path = c->path.items;
  if (path[c->path.n - 1].to != path[0].from)
    c->faulty = true;
}

/* Appends the path as a cycle. Edges on one line that follow one another become
 * one. */
static void add_cycle(struct hsr_clipper *c) {
  const struct hsr_border_edge *path = c->path.items;
  uint32_t n = (uint32_t)c->path.n, first = 0;
  while (first < n && path[first].line == path[(first + n - 1) % n].line)
    first++;
  if (first == n) {
    c->faulty = true;
    return;
  }
  struct hsr_traced_cycle *cycle =
      HSR_CLIPPER_NEW(c, &c->cycles, struct hsr_traced_cycle);
  if (!cycle)
    return;
  *cycle = (struct hsr_traced_cycle){.first = (uint32_t)c->cycled.n};
  struct hsr_border_edge *last = NULL;
  for (uint32_t k = 0; k < n; k++) {
    const struct hsr_border_edge *e = &path[(first + k) % n];
    if (last && last->line == e->line) {
      last->to = e->to;
      memcpy(last->at[1], e->at[1], sizeof e->at[1]);
      continue;
    }
    last = HSR_CLIPPER_NEW(c, &c->cycled, struct hsr_border_edge);
    if (!last)
      return;
    *last = *e;
    cycle->n++;
  }
  if (cycle->n < 3)
    c->faulty = true;
}

static void trace(struct hsr_clipper *c) {
  c->cycles.n = c->cycled.n = 0;
  tie(c);
  for (uint32_t k = 0; k < c->border.n && !c->failed && !c->faulty; k++)
    if (!loose_edge(c, k)->taken) {
      trace_cycle(c, loose_edge(c, k));
      if (!c->failed && !c->faulty)
        add_cycle(c);
    }
}

/* --- Outer cycles and holes ----------------------------------------------- */

static const struct hsr_border_edge *
edges_of(const struct hsr_clipper *c, const struct hsr_traced_cycle *cycle) {
  return &HSR_ITEM(struct hsr_border_edge, c->cycled, cycle->first);
}

/* Twice the area, rounded, about the first point; and a bound of its error. A
 * coordinate has a relative error of 2^-50, so a difference of two has an error
 * of 2^-49 of their absolute sum at most, and a product of two differences one
 * of 2^-48 of the product of these sums. The rest is for the roundings of n
 * additions. */
static double rough_area(const struct hsr_border_edge *e, uint32_t n,
                         double *bound) {
  double sum = 0, size = 0;
  const double *o = e[0].at[0];
  for (uint32_t k = 1; k < n; k++) {
    const double *a = e[k].at[0], *b = e[k].at[1];
    sum += (a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1]);
    size += (fabs(a[0]) + fabs(o[0])) * (fabs(b[1]) + fabs(o[1])) +
            (fabs(b[0]) + fabs(o[0])) * (fabs(a[1]) + fabs(o[1]));
  }
  *bound = (0x1p-47 + 0x1p-51 * n) * size + 0x1p-900;
  return sum;
}

/* Whether point p comes before q, by sx and then by sy. */
static bool is_first(struct hsr_clipper *c, uint32_t p, uint32_t q) {
  int by = hsr_crossing_compare(c->lines, p, q, 0);
  return by ? by < 0 : hsr_crossing_compare(c->lines, p, q, 1) < 0;
}

/* At the first of its points an outer cycle turns towards its interior, as
 * often as it passes there. A hole turns away there once. */
static bool turns_inward(struct hsr_clipper *c, const struct hsr_border_edge *e,
                         uint32_t n) {
  uint32_t first = e[0].from;
  for (uint32_t k = 1; k < n; k++)
    if (is_first(c, e[k].from, first))
      first = e[k].from;
  for (uint32_t k = 0; k < n; k++) {
    const struct hsr_border_edge *in = &e[(k + n - 1) % n], *out = &e[k];
    if (out->from == first &&
        in->sign * out->sign * hsr_line_turn(c->lines, in->line, out->line) < 0)
      return false;
  }
  return true;
}

static void measure(struct hsr_clipper *c, struct hsr_traced_cycle *cycle) {
  const struct hsr_border_edge *e = edges_of(c, cycle);
  double bound, twice = rough_area(e, cycle->n, &bound);
  cycle->outer =
      twice > bound || (!(twice < -bound) && turns_inward(c, e, cycle->n));
  for (int axis = 0; axis < 2; axis++) {
    double lo = e[0].at[0][axis], hi = lo;
    for (uint32_t k = 1; k < cycle->n; k++) {
      double at = e[k].at[0][axis];
      lo = at < lo ? at : lo;
      hi = at > hi ? at : hi;
    }
    cycle->lo[axis] = lo - 0x1p-48 * fabs(lo);
    cycle->hi[axis] = hi + 0x1p-48 * fabs(hi);
  }
}

/* Whether a cycle lies inside an outer one, which is not the same. */
static bool is_in(struct hsr_clipper *c, const struct hsr_traced_cycle *cycle,
                  const struct hsr_traced_cycle *outer) {
  for (int axis = 0; axis < 2; axis++)
    if (cycle->lo[axis] > outer->hi[axis] || cycle->hi[axis] < outer->lo[axis])
      return false;
  const struct hsr_border_edge *e = edges_of(c, cycle);
  return hsr_border_is_within(c, edges_of(c, outer), outer->n, e->from,
                              heading_of(e, 1));
}

/* Finds the innermost outer cycle around each hole. */
static void own_holes(struct hsr_clipper *c, uint32_t n_outer) {
  struct hsr_traced_cycle *cycle = c->cycles.items;
  for (uint32_t h = 0; h < c->cycles.n; h++) {
    uint32_t owner = UINT32_MAX;
    for (uint32_t k = 0; k < c->cycles.n && !cycle[h].outer; k++)
      if (cycle[k].outer &&
          (n_outer == 1 ||
           (is_in(c, &cycle[h], &cycle[k]) &&
            (owner == UINT32_MAX || is_in(c, &cycle[k], &cycle[owner])))))
        owner = k;
    cycle[h].owner = owner;
    if (!cycle[h].outer && owner == UINT32_MAX)
      c->faulty = true;
  }
}

/* --- Areas ---------------------------------------------------------------- */

static void put_cycle(const struct hsr_clipper *c, struct hsr_area *area,
                      const struct hsr_traced_cycle *cycle) {
  uint32_t at = area->start[area->n_cycles];
  memcpy(area->edge + at, edges_of(c, cycle), cycle->n * sizeof *area->edge);
  area->start[++area->n_cycles] = at + cycle->n;
}

static void make_area(struct hsr_clipper *c, uint32_t k, uint32_t face,
                      double nearest, struct hsr_area_list *list) {
  const struct hsr_traced_cycle *cycle = c->cycles.items;
  uint32_t n_cycles = 1, n_edges = cycle[k].n;
  for (uint32_t h = 0; h < c->cycles.n; h++)
    if (!cycle[h].outer && cycle[h].owner == k) {
      n_cycles++;
      n_edges += cycle[h].n;
    }
  struct hsr_area *area = new_area(c, n_cycles, n_edges);
  if (!area)
    return;
  area->face = face;
  area->nearest = nearest;
  area->n_cycles = area->start[0] = 0;
  put_cycle(c, area, &cycle[k]);
  for (uint32_t h = 0; h < c->cycles.n && area->n_cycles < n_cycles; h++)
    if (!cycle[h].outer && cycle[h].owner == k)
      put_cycle(c, area, &cycle[h]);
  memcpy(area->lo, cycle[k].lo, sizeof area->lo);
  memcpy(area->hi, cycle[k].hi, sizeof area->hi);
  hsr_areas_push(list, area);
}

void hsr_areas_of_border(struct hsr_clipper *c, uint32_t face, double nearest,
                         struct hsr_area_list *list) {
  trace(c);
  c->border.n = 0;
  if (c->failed || c->faulty)
    return;
  struct hsr_traced_cycle *cycle = c->cycles.items;
  uint32_t n_outer = 0;
  for (uint32_t k = 0; k < c->cycles.n; k++) {
    measure(c, &cycle[k]);
    n_outer += cycle[k].outer;
  }
  own_holes(c, n_outer);
  for (uint32_t k = 0; k < c->cycles.n && !c->failed && !c->faulty; k++)
    if (cycle[k].outer)
      make_area(c, k, face, nearest, list);
}
