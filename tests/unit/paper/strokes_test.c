/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strokes: as few as there can be, every line once; the order of a plotter; the
 * dashes of a stroke. On random drawings of lines between places of a lattice. */
#include "common/paper/dashes.h"
#include "common/paper/strokes.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NODES = 30, MOST_LINES = 60, GROUPS = 3, TRIALS = 2000 };

static uint64_t state = 1;
static uint32_t below(uint32_t n) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return (uint32_t)(state >> 33) % n;
}

static double node[NODES][2];
static struct hsr_pen_line line[MOST_LINES];
static size_t n_lines;

/* Places of which no three are on one line, so that no place is left out. */
static void make_lines(void) {
  for (int k = 0; k < NODES; k++) {
    node[k][0] = k;
    node[k][1] = k * k / 4.;
  }
  n_lines = 1 + below(MOST_LINES);
  for (uint32_t k = 0; k < n_lines; k++) {
    const uint32_t from = below(NODES),
                   to = (from + 1 + below(NODES - 1)) % NODES;
    line[k] = (struct hsr_pen_line){below(GROUPS), from, to, k};
  }
}

/* Half the odd nodes of each piece that hangs together, or one. */
static size_t least(uint32_t group) {
  int part[NODES], degree[NODES] = {0};
  size_t strokes = 0;
  for (int k = 0; k < NODES; k++)
    part[k] = k;
  for (bool again = true; again;) {
    again = false;
    for (size_t k = 0; k < n_lines; k++) {
      int *a = &part[line[k].from], *b = &part[line[k].to];
      if (line[k].group == group && *a != *b) {
        *a = *b = *a < *b ? *a : *b;
        again = true;
      }
    }
  }
  for (size_t k = 0; k < n_lines; k++)
    if (line[k].group == group) {
      degree[line[k].from]++;
      degree[line[k].to]++;
    }
  for (int p = 0; p < NODES; p++) {
    size_t odd = 0, any = 0;
    for (int k = 0; k < NODES; k++) {
      odd += part[k] == p && degree[k] % 2;
      any += part[k] == p && degree[k];
    }
    strokes += any ? odd > 2 ? odd / 2 : 1 : 0;
  }
  return strokes;
}

static bool has(const double at[2], uint32_t k) {
  return at[0] == node[k][0] && at[1] == node[k][1];
}

/* Takes the line between two places of a stroke away; false: it is not there, or
 * no longer. */
static bool take(uint32_t group, const double a[2], const double b[2],
                 bool *taken) {
  for (size_t k = 0; k < n_lines; k++)
    if (!taken[k] && line[k].group == group &&
        ((has(a, line[k].from) && has(b, line[k].to)) ||
         (has(b, line[k].from) && has(a, line[k].to))))
      return taken[k] = true;
  return false;
}

/* Whether the strokes draw every line once. */
static bool covers(const struct hsr_strokes *s) {
  bool taken[MOST_LINES] = {false}, good = true;
  size_t drawn = 0;
  for (size_t k = 0; k < s->n; k++) {
    const struct hsr_stroke *stroke = &s->stroke[k];
    for (size_t i = 1; i < stroke->n + (stroke->closed ? 1 : 0); i++, drawn++)
      good &= take(stroke->group, s->at[stroke->first + i - 1],
                   s->at[stroke->first + i % stroke->n], taken);
  }
  return good && drawn == n_lines;
}

static void try_joining(struct tap *t) {
  size_t wrong = 0, not_least = 0, farther = 0, lost = 0;
  double up = 0, ordered = 0;
  for (int trial = 0; trial < TRIALS; trial++) {
    struct hsr_strokes s;
    make_lines();
    if (hsr_strokes_join(&s, line, n_lines, (const double(*)[2])node, NULL))
      bail("out of memory");
    wrong += !covers(&s);
    for (uint32_t g = 0; g < GROUPS; g++) {
      size_t n = 0;
      for (size_t k = 0; k < s.n; k++)
        n += s.stroke[k].group == g;
      not_least += n != least(g);
    }
    const struct hsr_travel before = hsr_strokes_travel(&s);
    if (hsr_strokes_order(&s, NULL))
      bail("out of memory");
    const struct hsr_travel after = hsr_strokes_travel(&s);
    lost += !covers(&s) || fabs(before.down - after.down) > 1e-9 * before.down;
    farther += after.up > 2 * before.up;
    up += before.up;
    ordered += after.up;
    hsr_strokes_free(&s);
  }
  ok(t, !wrong, "every line is drawn once: %zu of %d not", wrong, TRIALS);
  ok(t, !not_least, "the strokes are as few as can be: %zu groups not",
     not_least);
  ok(t, !lost, "in the order of a plotter they are the same: %zu not", lost);
  ok(t, !farther && ordered < .8 * up,
     "and the pen travels less: %.0f, not %.0f", ordered, up);
}

/* ---- Straight on ---- */

/* Streets: some of the sides of a lattice. Those of a row or of a column have one
 * number. */
enum { STREETS = 6 };

static void make_streets(void) {
  n_lines = 0;
  for (uint32_t k = 0; k < STREETS * STREETS; k++) {
    const uint32_t i = k % STREETS, j = k / STREETS;
    if (i + 1 < STREETS && n_lines < MOST_LINES && below(3))
      line[n_lines++] = (struct hsr_pen_line){0, k, k + 1, j};
    if (j + 1 < STREETS && n_lines < MOST_LINES && below(3))
      line[n_lines++] = (struct hsr_pen_line){0, k + STREETS, k, STREETS + i};
  }
}

static int sign(double x) {
  return (x > 0) - (x < 0);
}

/* Marks a side that is drawn; false: it is not there, or no longer. */
static bool take_street(uint32_t a, uint32_t b, bool *taken) {
  for (size_t k = 0; k < n_lines; k++)
    if (!taken[k] && ((line[k].from == a && line[k].to == b) ||
                      (line[k].from == b && line[k].to == a)))
      return taken[k] = true;
  return false;
}

/* Marks the sides that a stroke draws. Returns how many; 0 if one is not there,
 * or no longer, or if the stroke has a place in which it goes straight on. */
static size_t walk(const struct hsr_strokes *s, const struct hsr_stroke *stroke,
                   bool *taken) {
  const double(*at)[2] = (const double(*)[2])s->at + stroke->first;
  const size_t turns = stroke->closed ? stroke->n : stroke->n - 2;
  size_t drawn = 0;
  for (size_t i = 0; i < turns; i++) {
    const double *a = at[i], *b = at[(i + 1) % stroke->n],
                 *c = at[(i + 2) % stroke->n];
    if (sign(b[0] - a[0]) == sign(c[0] - b[0]) &&
        sign(b[1] - a[1]) == sign(c[1] - b[1]))
      return 0;
  }
  for (size_t i = 0; i < stroke->n - !stroke->closed; i++) {
    const double *from = at[i], *to = at[(i + 1) % stroke->n];
    const int step[2] = {sign(to[0] - from[0]), sign(to[1] - from[1])};
    for (double x = from[0], y = from[1]; x != to[0] || y != to[1];
         x += step[0], y += step[1], drawn++)
      if (!take_street((uint32_t)(STREETS * y + x),
                       (uint32_t)(STREETS * (y + step[1]) + x + step[0]),
                       taken))
        return 0;
  }
  return drawn;
}

static void try_streets(struct tap *t) {
  static double at[STREETS * STREETS][2];
  size_t wrong = 0;
  for (int k = 0; k < STREETS * STREETS; k++) {
    at[k][0] = k % STREETS;
    at[k][1] = (double)(k / STREETS);
  }
  for (int trial = 0; trial < TRIALS; trial++) {
    struct hsr_strokes s;
    bool taken[MOST_LINES] = {false}, good = true;
    size_t drawn = 0;
    make_streets();
    if (hsr_strokes_join(&s, line, n_lines, (const double(*)[2])at, NULL))
      bail("out of memory");
    for (size_t k = 0; k < s.n; k++) {
      const size_t n = walk(&s, &s.stroke[k], taken);
      good = good && n;
      drawn += n;
    }
    wrong += !good || drawn != n_lines;
    hsr_strokes_free(&s);
  }
  ok(t, !wrong, "where a stroke goes straight on it has no place: %zu not",
     wrong);
}

/* A cross: the straight ways are joined. A place on a straight line is left
 * out. */
static void try_straight(struct tap *t) {
  static const double at[5][2] = {{0, 0}, {1, 0}, {2, 0}, {1, 1}, {1, -1}};
  static const struct hsr_pen_line cross[] = {
      {0, 0, 1, 7}, {0, 3, 1, 8}, {0, 1, 2, 7}, {0, 1, 4, 8}};
  struct hsr_strokes s;
  if (hsr_strokes_join(&s, cross, 4, at, NULL))
    bail("out of memory");
  ok(t, s.n == 2 && s.n_at == 4, "a cross is two strokes of two places");
  ok(t,
     fabs(s.at[0][0] - s.at[1][0]) == 2 || fabs(s.at[0][1] - s.at[1][1]) == 2,
     "which go straight on");
  hsr_strokes_free(&s);
  static const double square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  static const struct hsr_pen_line side[] = {
      {0, 0, 1, 0}, {0, 1, 2, 1}, {0, 2, 3, 2}, {0, 3, 0, 3}};
  if (hsr_strokes_join(&s, side, 4, square, NULL))
    bail("out of memory");
  ok(t, s.n == 1 && s.stroke[0].closed && s.stroke[0].n == 4,
     "a square is one closed stroke");
  hsr_strokes_free(&s);
}

/* ---- Dashes ---- */

struct cut {
  double ink, last[2];
  size_t dashes;
};

static void move(void *on, const double at[2]) {
  struct cut *cut = on;
  memcpy(cut->last, at, sizeof cut->last);
  cut->dashes++;
}

static void draw(void *on, const double at[2]) {
  struct cut *cut = on;
  cut->ink += hypot(at[0] - cut->last[0], at[1] - cut->last[1]);
  memcpy(cut->last, at, sizeof cut->last);
}

static double length_of(const double (*at)[2], size_t n, bool closed) {
  double length = 0;
  for (size_t k = 1; k < n + (closed ? 1 : 0); k++)
    length += hypot(at[k % n][0] - at[k - 1][0], at[k % n][1] - at[k - 1][1]);
  return length;
}

/* Strokes of right angles, open and closed. Each side is long enough for two
 * dashes, so there is ink at every corner, for a third of a dash on both sides;
 * an open stroke also ends with ink. Stairs of short steps have no corner. */
static void try_corners(struct tap *t) {
  struct hsr_dashes d = {.n = 0};
  size_t wrong = 0, ends = 0;
  for (int trial = 0; trial < TRIALS; trial++) {
    const bool closed = trial % 2;
    const double w = 20 + below(100), h = 20 + below(100);
    const double at[4][2] = {{0, 0}, {w, 0}, {w, h}, {0, h}};
    const double corner[3] = {w, w + h, 2 * w + h};
    if (hsr_dashes_find(&d, at, 4, closed, 6, 4, NULL))
      bail("out of memory");
    for (int c = 0; c < (closed ? 3 : 2); c++) {
      double run = 0;
      size_t k = 0;
      while (k < d.n && run + d.length[k] < corner[c])
        run += d.length[k++];
      wrong +=
          k % 2 || corner[c] - run < 2 || run + d.length[k] - corner[c] < 2;
    }
    ends += d.n % 2 == 0;
  }
  ok(t, !wrong, "at %zu corners there is no ink", wrong);
  ok(t, !ends, "%zu strokes end without ink", ends);
  double stairs[41][2];
  for (int k = 0; k < 41; k++) {
    stairs[k][0] = (double)((k + 1) / 2);
    stairs[k][1] = (double)(k / 2);
  }
  if (hsr_dashes_find(&d, (const double(*)[2])stairs, 41, false, 6, 4, NULL))
    bail("out of memory");
  ok(t, d.n >= 5 && d.n <= 9,
     "stairs of short steps have dashes as long as ever: %zu", d.n);
  hsr_dashes_free(&d);
}

static void try_dashes(struct tap *t) {
  size_t sums = 0, few = 0, cuts = 0, negative = 0;
  struct hsr_dashes d = {.n = 0};
  for (int trial = 0; trial < TRIALS; trial++) {
    double at[8][2];
    const size_t n = 2 + below(7);
    const bool closed = n > 2 && below(2) == 1;
    for (size_t k = 0; k < n; k++)
      for (int c = 0; c < 2; c++)
        at[k][c] = below(1000) / 10. + (double)k / 16;
    if (hsr_dashes_find(&d, (const double(*)[2])at, n, closed, 3, 2, NULL))
      bail("out of memory");
    const double length = length_of((const double(*)[2])at, n, closed);
    double sum = 0, ink = 0;
    for (size_t k = 0; k < d.n; k++) {
      sum += d.length[k];
      ink += k % 2 ? 0. : d.length[k];
      negative += d.length[k] > 0 ? 0 : 1;
    }
    struct cut cut = {.dashes = 0};
    hsr_dashes_cut(&d, (const double(*)[2])at, n, closed, &cut, move, draw);
    sums += fabs(sum - length) > 1e-9 * length;
    few += d.n < 3;
    cuts += fabs(cut.ink - ink) > 1e-9 * length || cut.dashes != (d.n + 1) / 2;
  }
  ok(t, !sums, "dashes and gaps are as long as the stroke: %zu not", sums);
  ok(t, !few && !negative, "two dashes at least: %zu not, %zu of no length",
     few, negative);
  ok(t, !cuts, "what is cut is what was found: %zu not", cuts);
  try_corners(t);
  static const double corner[3][2] = {{0, 0}, {100, 0}, {100, 50}};
  if (hsr_dashes_find(&d, corner, 3, false, 6, 4, NULL))
    bail("out of memory");
  double run = 0;
  size_t k = 0;
  for (; k < d.n && run + d.length[k] < 100; k++)
    run += d.length[k];
  ok(t, k < d.n && k % 2 == 0 && run < 95 && run + d.length[k] > 105,
     "there is ink on both sides of a corner");
  static const double tiny[2][2] = {{0, 0}, {.5, 0}};
  if (hsr_dashes_find(&d, tiny, 2, false, 6, 4, NULL))
    bail("out of memory");
  ok(t, d.n == 3 && fabs(d.length[1] - .5 * 4 / 16) < 1e-12,
     "a stroke shorter than a dash has two dashes and a gap");
  double round[64][2];
  for (int i = 0; i < 64; i++) {
    round[i][0] = 50 * cos(i * .0981747704246810387);
    round[i][1] = 50 * sin(i * .0981747704246810387);
  }
  if (hsr_dashes_find(&d, (const double(*)[2])round, 64, true, 6, 4, NULL))
    bail("out of memory");
  ok(t, d.n % 2 == 0 && fabs(d.length[0] - d.length[d.n - 2]) < 1e-9,
     "a circle has as many gaps as dashes");
  hsr_dashes_free(&d);
}

int main(void) {
  struct tap t = plan(17);
  try_joining(&t);
  try_streets(&t);
  try_straight(&t);
  try_dashes(&t);
  return finish(&t);
}
