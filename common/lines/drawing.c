/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/lines/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void hsr_drawing_free(struct hsr_drawing *drawing) {
  free(drawing->segment);
  *drawing = (struct hsr_drawing){.segment = NULL};
}

enum hsr_status hsr_drawing_add(struct hsr_drawing *drawing,
                                const struct hsr_segment *segment) {
  if (drawing->n) {
    struct hsr_segment *last = &drawing->segment[drawing->n - 1];
    if (!hsr_edge_name_compare(&last->edge, &segment->edge) &&
        last->t1 == segment->t0 &&
        last->invisibility == segment->invisibility) {
      last->t1 = segment->t1;
      for (int k = 0; k < 3; k++)
        last->to[k] = segment->to[k];
      return HSR_OK;
    }
  }
  if (drawing->n == drawing->room) {
    size_t room = drawing->room ? 2 * drawing->room : 256;
    struct hsr_segment *more =
        realloc(drawing->segment, room * sizeof *drawing->segment);
    if (!more)
      return HSR_E_NOMEM;
    drawing->segment = more;
    drawing->room = room;
  }
  drawing->segment[drawing->n++] = *segment;
  return HSR_OK;
}

/* --- Order ---------------------------------------------------------------- */

static int order(uint32_t a, uint32_t b) {
  return (a > b) - (a < b);
}

int hsr_edge_name_compare(const struct hsr_edge_name *a,
                          const struct hsr_edge_name *b) {
  if (a->implied != b->implied)
    return a->implied ? 1 : -1;
  if (a->a != b->a)
    return order(a->a, b->a);
  if (a->b != b->b)
    return order(a->b, b->b);
  return order(a->part, b->part);
}

/* The intervals of one edge in a drawing. */
struct stretch {
  const struct hsr_segment *first;
  size_t n;
};

static struct stretch edge_at(const struct hsr_drawing *drawing, size_t k) {
  struct stretch s = {drawing->segment + k, 0};
  while (k + s.n < drawing->n &&
         !hsr_edge_name_compare(&s.first->edge, &s.first[s.n].edge))
    s.n++;
  return s;
}

static int by_edge(const void *a, const void *b) {
  const struct stretch *s = a, *t = b;
  return hsr_edge_name_compare(&s->first->edge, &t->first->edge);
}

enum hsr_status hsr_drawing_sort(struct hsr_drawing *drawing) {
  size_t n = 0;
  struct stretch *edge = malloc((drawing->n + 1) * sizeof *edge);
  struct hsr_segment *sorted =
      malloc((drawing->room + 1) * sizeof *drawing->segment);
  if (!edge || !sorted) {
    free(edge);
    free(sorted);
    return HSR_E_NOMEM;
  }
  for (size_t k = 0; k < drawing->n; k += edge[n++].n)
    edge[n] = edge_at(drawing, k);
  qsort(edge, n, sizeof *edge, by_edge);
  struct hsr_segment *next = sorted;
  for (size_t e = 0; e < n; next += edge[e++].n)
    memcpy(next, edge[e].first, edge[e].n * sizeof *next);
  free(edge);
  free(drawing->segment);
  drawing->segment = sorted;
  return HSR_OK;
}

static int by_edge_and_place(const void *a, const void *b) {
  const struct hsr_segment *p = a, *q = b;
  const int order = hsr_edge_name_compare(&p->edge, &q->edge);
  return order ? order : (p->t0 > q->t0) - (p->t0 < q->t0);
}

enum hsr_status hsr_drawing_gather(struct hsr_drawing *drawing) {
  struct hsr_drawing gathered = {.segment = NULL};
  if (drawing->n)
    qsort(drawing->segment, drawing->n, sizeof *drawing->segment,
          by_edge_and_place);
  for (size_t k = 0; k < drawing->n; k++)
    if (hsr_drawing_add(&gathered, &drawing->segment[k])) {
      hsr_drawing_free(&gathered);
      return HSR_E_NOMEM;
    }
  hsr_drawing_free(drawing);
  *drawing = gathered;
  return HSR_OK;
}

/* --- Comparison ----------------------------------------------------------- */

static uint32_t wanted_invisibility(const struct hsr_segment *segment,
                                    bool visible_only) {
  return visible_only ? segment->invisibility > 0 : segment->invisibility;
}

/* Doubles below 2^-1022 are multiples of 2^-1074 and have no relative error to
 * speak of. Each of the two is within one such step of the true number. */
static bool is_close(double got, double wanted) {
  double steps = 2 * 0x1p-1074;
  return fabs(got - wanted) <= HSR_DRAWING_TOLERANCE * fabs(wanted) + steps;
}

static bool agree(struct stretch got, struct stretch wanted,
                  bool visible_only) {
  size_t g = 0;
  for (size_t w = 0; w < wanted.n; g++) {
    uint32_t invisibility = wanted_invisibility(&wanted.first[w], visible_only);
    double t0 = wanted.first[w].t0, t1 = wanted.first[w].t1;
    for (w++; w < wanted.n && wanted_invisibility(&wanted.first[w],
                                                  visible_only) == invisibility;
         w++)
      t1 = wanted.first[w].t1;
    if (g == got.n || got.first[g].invisibility != invisibility ||
        !is_close(got.first[g].t0, t0) || !is_close(got.first[g].t1, t1))
      return false;
  }
  return g == got.n;
}

void hsr_drawing_compare(const struct hsr_drawing *got,
                         const struct hsr_drawing *wanted, bool visible_only,
                         struct hsr_drawing_difference *difference) {
  *difference = (struct hsr_drawing_difference){.edges = 0};
  size_t g = 0, w = 0;
  while (g < got->n || w < wanted->n) {
    struct stretch a = edge_at(got, g), b = edge_at(wanted, w);
    int which = g == got->n ? 1
                : w == wanted->n
                    ? -1
                    : hsr_edge_name_compare(&a.first->edge, &b.first->edge);
    difference->edges++;
    if (which || !agree(a, b, visible_only))
      if (!difference->differing++)
        difference->first = which <= 0 ? a.first->edge : b.first->edge;
    g += which <= 0 ? a.n : 0;
    w += which >= 0 ? b.n : 0;
  }
}
