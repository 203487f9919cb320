/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The order of strokes for a plotter: greedy, to the nearest end.
 *
 * The places where strokes may begin lie in a grid of about two a cell. It is
 * made anew whenever half of the strokes are drawn, so that no search crosses
 * many empty cells. O(n log n), but for strange distributions. */
#include "common/paper/strokes.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct begin {
  size_t stroke, place; /* place: of the stroke */
};

struct tour {
  struct hsr_strokes *strokes;
  size_t first, n;     /* of the group */
  bool *drawn;         /* by stroke of the group */
  struct begin *begin; /* by cell */
  size_t *start;       /* cells + 1 */
  size_t most_cells;
  double low[2], side;
  long cells[2];
};

static const double *place_of(const struct tour *t, struct begin b) {
  const struct hsr_stroke *s = &t->strokes->stroke[t->first + b.stroke];
  return t->strokes->at[s->first + b.place];
}

/* Calls each(tour, begin) for the places where a stroke may begin. */
static void for_each_begin(struct tour *t,
                           void (*each)(struct tour *t, struct begin b)) {
  for (size_t k = 0; k < t->n; k++) {
    const struct hsr_stroke *s = &t->strokes->stroke[t->first + k];
    const size_t step = s->closed || s->n == 1 ? 1 : s->n - 1;
    for (size_t i = 0; i < s->n && !t->drawn[k]; i += step)
      each(t, (struct begin){k, i});
  }
}

static size_t cell_of(const struct tour *t, const double at[2]) {
  size_t cell = 0;
  for (int c = 1; c >= 0; c--) {
    const double place = (at[c] - t->low[c]) / t->side;
    const long last = t->cells[c] - 1, i = !(place > 0) ? 0
                                           : place >= (double)last
                                               ? last
                                               : (long)place;
    cell = cell * (size_t)(c ? t->cells[1] : t->cells[0]) + (size_t)i;
  }
  return cell;
}

static void count(struct tour *t, struct begin b) {
  t->start[cell_of(t, place_of(t, b)) + 1]++;
}

static void put(struct tour *t, struct begin b) {
  t->begin[t->start[cell_of(t, place_of(t, b))]++] = b;
}

static void lay_grid(struct tour *t, size_t n_begins) {
  double high[2] = {-DBL_MAX, -DBL_MAX};
  t->low[0] = t->low[1] = DBL_MAX;
  for (size_t k = 0; k < t->n; k++) {
    const struct hsr_stroke *s = &t->strokes->stroke[t->first + k];
    for (size_t i = s->first; i < s->first + s->n; i++)
      for (int c = 0; c < 2; c++) {
        t->low[c] = fmin(t->low[c], t->strokes->at[i][c]);
        high[c] = fmax(high[c], t->strokes->at[i][c]);
      }
  }
  const double w = high[0] - t->low[0], h = high[1] - t->low[1];
  const double cells = fmax(1, (double)n_begins / 2);
  t->side = fmax(sqrt(w * h / cells), fmax(w, h) / cells);
  t->side = t->side > 0 ? t->side : 1;
  for (;; t->side *= 1.25) {
    t->cells[0] = (long)(w / t->side) + 1;
    t->cells[1] = (long)(h / t->side) + 1;
    if ((size_t)t->cells[0] * (size_t)t->cells[1] <= t->most_cells)
      break;
  }
}

static void fill_grid(struct tour *t, size_t n_begins) {
  lay_grid(t, n_begins);
  const size_t cells = (size_t)t->cells[0] * (size_t)t->cells[1];
  memset(t->start, 0, (cells + 2) * sizeof *t->start);
  for_each_begin(t, count);
  for (size_t k = 0; k < cells; k++)
    t->start[k + 1] += t->start[k];
  for_each_begin(t, put);
  memmove(t->start + 1, t->start, cells * sizeof *t->start);
  t->start[0] = 0;
}

/* Looks for a nearer place in the cells (i0, j) ... (i1, j), as far as there are
 * such. */
static void look(const struct tour *t, long i0, long i1, long j,
                 const double pen[2], struct begin *best, double *least) {
  if (j < 0 || j >= t->cells[1])
    return;
  i0 = i0 > 0 ? i0 : 0;
  i1 = i1 < t->cells[0] ? i1 : t->cells[0] - 1;
  if (i0 > i1)
    return;
  const size_t row = (size_t)(j * t->cells[0]);
  for (size_t k = t->start[row + (size_t)i0];
       k < t->start[row + (size_t)i1 + 1]; k++) {
    if (t->drawn[t->begin[k].stroke])
      continue;
    const double *at = place_of(t, t->begin[k]);
    const double far = hypot(at[0] - pen[0], at[1] - pen[1]);
    if (far < *least) {
      *least = far;
      *best = t->begin[k];
    }
  }
}

/* Rings of cells around the one that is nearest to the pen, until no nearer place
 * can be outside. No place of the grid is farther from that cell than from the
 * pen. */
static struct begin nearest(const struct tour *t, const double pen[2]) {
  struct begin best = {0, 0};
  double least = DBL_MAX;
  const long cell = (long)cell_of(t, pen);
  const long i = cell % t->cells[0], j = cell / t->cells[0];
  for (long r = 0; least == DBL_MAX || least > (double)(r - 1) * t->side; r++) {
    look(t, i - r, i + r, j - r, pen, &best, &least);
    if (r)
      look(t, i - r, i + r, j + r, pen, &best, &least);
    const long top = j - r + 1 > 0 ? j - r + 1 : 0,
               end = j + r < t->cells[1] ? j + r : t->cells[1];
    for (long k = top; k < end; k++) {
      if (i - r >= 0)
        look(t, i - r, i - r, k, pen, &best, &least);
      if (i + r < t->cells[0])
        look(t, i + r, i + r, k, pen, &best, &least);
    }
  }
  return best;
}

static void reverse(double (*at)[2], size_t n) {
  for (size_t i = 0; i + 1 < n - i; i++)
    for (int c = 0; c < 2; c++) {
      const double swap = at[i][c];
      at[i][c] = at[n - 1 - i][c];
      at[n - 1 - i][c] = swap;
    }
}

/* Makes the stroke begin at that place. */
static void turn_round(struct hsr_strokes *strokes, const struct hsr_stroke *s,
                       size_t place) {
  double(*at)[2] = strokes->at + s->first;
  if (s->closed) {
    reverse(at, place);
    reverse(at + place, s->n - place);
    reverse(at, s->n);
  } else if (place) {
    reverse(at, s->n);
  }
}

static size_t n_begins_of(const struct tour *t) {
  size_t n = 0;
  for (size_t k = 0; k < t->n; k++) {
    const struct hsr_stroke *s = &t->strokes->stroke[t->first + k];
    if (!t->drawn[k])
      n += s->closed ? s->n : 2;
  }
  return n;
}

/* Finds an order of the strokes of one group, and puts them into `into`. */
static void order_group(struct tour *t, struct hsr_stroke *into,
                        double pen[2]) {
  size_t gridded = 0; /* how many were not drawn when the grid was made */
  for (size_t left = t->n; left > 0; left--) {
    if (2 * left <= gridded || !gridded) {
      gridded = left;
      fill_grid(t, n_begins_of(t));
    }
    const struct begin b = nearest(t, pen);
    const struct hsr_stroke *s = &t->strokes->stroke[t->first + b.stroke];
    t->drawn[b.stroke] = true;
    turn_round(t->strokes, s, b.place);
    memcpy(pen, t->strokes->at[s->first + (s->closed ? 0 : s->n - 1)],
           2 * sizeof *pen);
    *into++ = *s;
  }
}

enum hsr_status hsr_strokes_order(struct hsr_strokes *strokes,
                                  struct hsr_error *err) {
  const size_t most = strokes->n_at + 2;
  struct tour t = {.strokes = strokes,
                   .drawn = calloc(strokes->n + 1, sizeof *t.drawn),
                   .begin = malloc(2 * most * sizeof *t.begin),
                   .start = malloc((2 * most + 2) * sizeof *t.start),
                   .most_cells = 2 * most};
  struct hsr_stroke *into = malloc((strokes->n + 1) * sizeof *into);
  enum hsr_status status = HSR_OK;
  double pen[2] = {0, 0};
  bool good = t.drawn && t.begin && t.start && into;
  for (size_t k = 0; good && k < strokes->n; k += t.n) {
    t.first = k;
    for (t.n = 1; k + t.n < strokes->n &&
                  strokes->stroke[k + t.n].group == strokes->stroke[k].group;)
      t.n++;
    memset(t.drawn, 0, t.n * sizeof *t.drawn);
    order_group(&t, into + k, pen);
  }
  if (good)
    memcpy(strokes->stroke, into, strokes->n * sizeof *into);
  else
    status = hsr_fail_nomem(err);
  free(t.drawn);
  free(t.begin);
  free(t.start);
  free(into);
  return status;
}
