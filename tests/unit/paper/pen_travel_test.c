/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The order of strokes for a plotter, on random strokes: it is one of the same
 * strokes, each from one of its ends on, and as good as that of a search through
 * all ends. */
#include "common/paper/strokes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TRIALS = 300, MOST_STROKES = 120, MOST_PLACES = 8, GROUPS = 3 };

static uint64_t seed = 7;
static size_t draw_size(size_t lo, size_t hi) {
  return (size_t)draw_integer(&seed, (int64_t)lo, (int64_t)hi);
}

/* Places on a lattice of `side`: many are equal if it is small. All strokes may
 * lie on one line. */
static void make(struct hsr_strokes *s, size_t side, bool flat) {
  s->n = draw_size(0, MOST_STROKES);
  s->n_at = 0;
  s->stroke = malloc((s->n + 1) * sizeof *s->stroke);
  s->at = malloc((s->n * MOST_PLACES + 1) * sizeof *s->at);
  if (!s->stroke || !s->at)
    bail("out of memory");
  for (size_t k = 0; k < s->n; k++) {
    const size_t n = draw_size(2, MOST_PLACES);
    s->stroke[k] = (struct hsr_stroke){.group = (uint32_t)(k * GROUPS / s->n),
                                       .first = s->n_at,
                                       .n = n,
                                       .closed = n > 2 && draw_size(0, 1) == 1};
    for (size_t i = 0; i < n; i++, s->n_at++) {
      s->at[s->n_at][0] = (double)draw_size(0, side) / 16 + 100;
      s->at[s->n_at][1] = flat ? 5 : (double)draw_size(0, side) / 16;
    }
  }
}

static struct hsr_strokes copy_of(const struct hsr_strokes *s) {
  struct hsr_strokes copy = *s;
  copy.stroke = malloc((s->n + 1) * sizeof *s->stroke);
  copy.at = malloc((s->n_at + 1) * sizeof *s->at);
  if (!copy.stroke || !copy.at)
    bail("out of memory");
  memcpy(copy.stroke, s->stroke, s->n * sizeof *s->stroke);
  memcpy(copy.at, s->at, s->n_at * sizeof *s->at);
  return copy;
}

static double way(const double a[2], const double b[2]) {
  return hypot(b[0] - a[0], b[1] - a[1]);
}

/* ---- The same strokes ---- */

static bool is_place(const double a[2], const double b[2]) {
  return a[0] == b[0] && a[1] == b[1];
}

/* Whether a stroke's places are another's, from place `from` on, forwards or
 * backwards. */
static bool is_from(const double (*a)[2], const double (*b)[2], size_t n,
                    size_t from, bool back) {
  for (size_t i = 0; i < n; i++)
    if (!is_place(a[i], b[(from + (back ? n - i : i)) % n]))
      return false;
  return true;
}

static bool is_same(const struct hsr_strokes *s, const struct hsr_stroke *a,
                    const struct hsr_strokes *t, const struct hsr_stroke *b) {
  const double(*p)[2] = (const double(*)[2])s->at + a->first;
  const double(*q)[2] = (const double(*)[2])t->at + b->first;
  if (a->n != b->n || a->closed != b->closed || a->group != b->group)
    return false;
  if (!a->closed)
    return is_from(p, q, a->n, 0, false) || is_from(p, q, a->n, a->n - 1, true);
  for (size_t k = 0; k < a->n; k++)
    if (is_from(p, q, a->n, k, false) || is_from(p, q, a->n, k, true))
      return true;
  return false;
}

static bool are_same(const struct hsr_strokes *s, const struct hsr_strokes *t) {
  bool taken[MOST_STROKES] = {false};
  for (size_t k = 0; k < s->n; k++) {
    size_t i = 0;
    while (i < t->n &&
           (taken[i] || !is_same(s, &s->stroke[k], t, &t->stroke[i])))
      i++;
    if (i == t->n)
      return false;
    taken[i] = true;
  }
  return s->n == t->n;
}

static bool are_by_group(const struct hsr_strokes *s) {
  for (size_t k = 1; k < s->n; k++)
    if (s->stroke[k].group < s->stroke[k - 1].group)
      return false;
  return true;
}

/* ---- Always the nearest ---- */

/* How near a stroke begins, at best. */
static double nearest(const struct hsr_strokes *s, size_t k,
                      const double pen[2]) {
  const struct hsr_stroke *stroke = &s->stroke[k];
  double least = DBL_MAX;
  for (size_t i = 0; i < stroke->n; i += stroke->closed ? 1 : stroke->n - 1)
    least = fmin(least, way(pen, s->at[stroke->first + i]));
  return least;
}

/* Whether each stroke of an order begins as near to the pen as any of its group
 * that comes later. */
static bool is_greedy(const struct hsr_strokes *s) {
  double pen[2] = {0, 0};
  for (size_t k = 0; k < s->n; k++) {
    const struct hsr_stroke *stroke = &s->stroke[k];
    const double gone = way(pen, s->at[stroke->first]);
    for (size_t i = k; i < s->n && s->stroke[i].group == stroke->group; i++)
      if (nearest(s, i, pen) < gone)
        return false;
    memcpy(pen, s->at[stroke->first + (stroke->closed ? 0 : stroke->n - 1)],
           sizeof pen);
  }
  return true;
}

int main(void) {
  struct tap t = plan(6);
  size_t other = 0, groups = 0, down = 0, far = 0, more = 0;
  double before = 0, after = 0;
  for (int trial = 0; trial < TRIALS; trial++) {
    struct hsr_strokes s;
    make(&s, trial % 2 ? 20 : 100000, trial % 10 == 9);
    struct hsr_strokes given = copy_of(&s);
    if (hsr_strokes_order(&s, NULL))
      bail("out of memory");
    const struct hsr_travel is = hsr_strokes_travel(&s),
                            was = hsr_strokes_travel(&given);
    other += !are_same(&s, &given);
    groups += !are_by_group(&s);
    down += fabs(is.down - was.down) > 1e-9 * was.down;
    far += !is_greedy(&s);
    more += is.up > was.up * (1 + 1e-12);
    before += was.up;
    after += is.up;
    hsr_strokes_free(&s);
    hsr_strokes_free(&given);
  }
  ok(&t, !other, "the strokes are the same: %zu of %d times not", other,
     TRIALS);
  ok(&t, !groups, "group by group: %zu times not", groups);
  ok(&t, !down, "the pen draws as much: %zu times not", down);
  ok(&t, !far, "it goes to the nearest end each time: %zu times not", far);
  ok(&t, !more, "it is never up for longer than in the order given: %zu times",
     more);
  ok(&t, after < .5 * before, "up for %.0f, not %.0f", after, before);
  return finish(&t);
}
