/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The claims about triage coverage masks (common/voxels/triage.h): for every
 * line, covered cells are wholly inside the line, and vacant cells wholly
 * outside. All by integers, against the sign of the line's equation at every
 * corner of a cell. */
#include "common/voxels/triage.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LINES = 200000, UNIT = 1 << 13, SLACK = 2 }; /* UNIT a side */

/* f = a x + b y + c; inside it is positive. */
struct line {
  int64_t a, b, c;
};

struct point {
  int64_t x, y; /* in units */
};

static struct line line_through(struct point p, struct point q) {
  int64_t dx = q.x - p.x, dy = q.y - p.y;
  return (struct line){-dy * UNIT, dx * UNIT, dy * p.x - dx * p.y};
}

/* f at (x, y) / UNIT. */
static int64_t at(const struct line *line, int64_t x, int64_t y) {
  return (line->a * x + line->b * y) / UNIT + line->c;
}

static struct line reversed(struct line line) {
  return (struct line){-line.a, -line.b, -line.c};
}

/* Through two points in the square or near it, of a fine grid or of one that
 * goes through the corners of cells. */
static struct line random_line(uint64_t *seed) {
  int64_t step = draw_integer(seed, 0, 3) ? 1 : UNIT / 32;
  int64_t n = UNIT / step;
  struct point p[2];
  do
    for (int k = 0; k < 2; k++)
      p[k] = (struct point){step * draw_integer(seed, -n / 8, n + n / 8),
                            step * draw_integer(seed, -n / 8, n + n / 8)};
  while (p[0].x == p[1].x && p[0].y == p[1].y);
  return line_through(p[0], p[1]);
}

static int look_up(const struct line *line, int intervals, bool *inside) {
  double step[2] = {(double)line->a, (double)line->b};
  double per[2] = {1 / step[0], 1 / step[1]};
  bool known[2] = {line->a != 0, line->b != 0};
  return hsr_triage_entry(intervals, (double)line->c, step, per, known, inside);
}

static struct hsr_triage turned(struct hsr_triage mask, bool inside) {
  return inside ? mask : (struct hsr_triage){mask.v, mask.c};
}

/* The number of cells that a mask has wrong, or marks twice. */
static long count_wrong(const struct line *line, struct hsr_triage mask) {
  long wrong = (mask.c & mask.v) != 0;
  int64_t f[9][9];
  for (int k = 0; k < 81; k++)
    f[k / 9][k % 9] = at(line, k % 9 * (UNIT / 8), k / 9 * (UNIT / 8));
  for (int bit = 0; bit < 64; bit++) {
    const int64_t *low = &f[bit / 8][bit % 8], *high = &f[bit / 8 + 1][bit % 8];
    bool inside = low[0] > 0 && low[1] > 0 && high[0] > 0 && high[1] > 0;
    bool outside = low[0] < 0 && low[1] < 0 && high[0] < 0 && high[1] < 0;
    wrong += (mask.c >> bit & 1) && !inside;
    wrong += (mask.v >> bit & 1) && !outside;
  }
  return wrong;
}

/* --- Lines ---------------------------------------------------------------- */

/* A line crosses the square if corners of it are on both sides. Only then does
 * the line have an entry. */
static bool crosses(const struct line *line) {
  int n = (at(line, 0, 0) > 0) + (at(line, UNIT, 0) > 0) +
          (at(line, UNIT, UNIT) > 0) + (at(line, 0, UNIT) > 0);
  return n > 0 && n < 4;
}

static bool meets_corner(const struct line *line) {
  return !at(line, 0, 0) || !at(line, UNIT, 0) || !at(line, UNIT, UNIT) ||
         !at(line, 0, UNIT);
}

static void test_lines(struct tap *tap, const struct hsr_triage_tables *tables,
                       uint64_t *seed) {
  long wrong = 0, crossing = 0, unlike = 0, both = 0;
  int k = tables->intervals;
  while (crossing < LINES) {
    struct line line = random_line(seed), other = reversed(line);
    bool inside, of_other;
    int entry = look_up(&line, k, &inside);
    unlike += (entry >= 0) != crosses(&line);
    if (entry < 0)
      continue;
    struct hsr_triage mask = turned(tables->mask[entry], inside);
    crossing++;
    wrong += count_wrong(&line, mask);
    both += mask.c && mask.v;
    int entry_of_other = look_up(&other, k, &of_other);
    if (entry_of_other >= 0)
      wrong +=
          count_wrong(&other, turned(tables->mask[entry_of_other], of_other));
    if (!meets_corner(&line)) /* a neighbour looks up the same */
      unlike += entry_of_other != entry || of_other == inside;
  }
  ok(tap, !wrong && both > LINES / 2,
     "K = %d: %d lines, %ld with cells on both sides, %ld cells wrong", k,
     LINES, both, wrong);
  ok(tap, !unlike,
     "K = %d: just lines that cross have an entry, the same one both ways: "
     "%ld have not",
     k, unlike);
}

/* --- Entries -------------------------------------------------------------- */

static const int SIDES[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

static struct point on_side(int side, int64_t t) {
  switch (side) {
  case 0:
    return (struct point){t, 0};
  case 1:
    return (struct point){UNIT, t};
  case 2:
    return (struct point){UNIT - t, UNIT};
  default:
    return (struct point){0, UNIT - t};
  }
}

/* The line through a point on each of two sides. It is turned so that corner 0
 * is inside if the points are not beyond the corners. */
static struct line line_of_pair(int pair, int64_t t, int64_t u) {
  const int *side = SIDES[pair];
  struct line middle =
      line_through(on_side(side[0], UNIT / 2), on_side(side[1], UNIT / 2));
  struct line line = line_through(on_side(side[0], t), on_side(side[1], u));
  return at(&middle, 0, 0) > 0 ? line : reversed(line);
}

/* A place in an interval, or within the slack of it; often at an end. */
static int64_t random_place(int i, int intervals, uint64_t *seed) {
  int64_t lo = (int64_t)i * UNIT / intervals - SLACK;
  int64_t hi = (int64_t)(i + 1) * UNIT / intervals + SLACK;
  int64_t kind = draw_integer(seed, 0, 3);
  return kind == 0 ? lo : kind == 1 ? hi : draw_integer(seed, lo, hi);
}

/* Every entry is right for all lines through both of its intervals, or within
 * the slack of them. */
static void test_entries(struct tap *tap,
                         const struct hsr_triage_tables *tables,
                         uint64_t *seed) {
  int k = tables->intervals, each = LINES / (6 * k * k) + 1;
  long wrong = 0, n = 0;
  for (int entry = 0; entry < 6 * k * k; entry++)
    for (int l = 0; l < each; l++) {
      int64_t t = random_place(entry / k % k, k, seed);
      int64_t u = random_place(entry % k, k, seed);
      struct line line = line_of_pair(entry / (k * k), t, u);
      if (!line.a && !line.b)
        continue;
      wrong += count_wrong(&line, tables->mask[entry]);
      n++;
    }
  ok(tap, !wrong && n > LINES / 2,
     "K = %d: %ld lines within the slack of all entries, %ld cells wrong", k, n,
     wrong);
}

/* One entry by hand: that of the line x + y = 7/16, and of all lines from
 * 3/8 .. 4/8 of the upper side to 3/8 .. 4/8 of the left one.
 *
 *       c a a a a v v v      cells that lines touch at a corner are active, by
 *       a a a a v v v v      the slack
 *       a a a v v v v v
 */
static void test_one(struct tap *tap, const struct hsr_triage_tables *tables) {
  struct line line = {-16, -16, 7};
  bool inside;
  int entry = look_up(&line, 8, &inside);
  struct hsr_triage none = {0, 0},
                    mask = entry < 0 ? none : tables->mask[entry];
  ok(tap, inside && mask.c == 1 && mask.v == 0xfffffffefcf8f0e0u,
     "an entry looked at by hand: %016llx covered, %016llx vacant",
     (unsigned long long)mask.c, (unsigned long long)mask.v);
}

static int count_bits(uint64_t mask) {
  int n = 0;
  for (; mask; mask &= mask - 1)
    n++;
  return n;
}

/* The mean number of active cells of an entry, beside that of an independent
 * program without a slack. Ends of intervals are on borders of cells, so some
 * cells are active only by the slack. In some entries lines cut off a corner
 * within an interval of it, and nothing is known. */
static double test_figures(struct tap *tap,
                           const struct hsr_triage_tables *tables,
                           double wanted) {
  int k = tables->intervals, n = 6 * k * k, most = 0, of_nothing = 0;
  double sum = 0;
  for (int entry = 0; entry < n; entry++) {
    struct hsr_triage mask = tables->mask[entry];
    int active = 64 - count_bits(mask.c | mask.v);
    sum += active;
    if (active == 64)
      of_nothing++;
    else
      most = active > most ? active : most;
  }
  double mean = sum / n;
  ok(tap,
     mean > wanted && mean < wanted + 36.0 / k && of_nothing <= 4 &&
         most <= (k == 4 ? 36 : 28),
     "K = %d: %.2f active cells an entry (%.2f without the slack), at most %d "
     "but in %d entries",
     k, mean, wanted, most, of_nothing);
  return mean;
}

/* --- Samples -------------------------------------------------------------- */

/* Whether all lines of an entry have a point strictly on one side. */
static bool is_decided(int entry, int intervals, int64_t x, int64_t y) {
  int k = intervals, inside = 0, outside = 0;
  for (int end = 0; end < 4; end++) {
    int64_t t = (int64_t)(entry / k % k + (end & 1)) * UNIT / k;
    int64_t u = (int64_t)(entry % k + (end >> 1)) * UNIT / k;
    struct line line = line_of_pair(entry / (k * k), t, u);
    int64_t f = at(&line, x, y);
    inside += f > 0;
    outside += f < 0;
  }
  return inside == 4 || outside == 4;
}

/* The share of samples that the tables have wrong. */
static double test_samples(struct tap *tap, int k, uint64_t *seed) {
  double x[64], y[64];
  uint64_t *mask = malloc(6 * (size_t)k * (size_t)k * sizeof *mask);
  long wrong = 0, crossing = 0, decided = 0;
  if (!mask)
    bail("out of memory");
  for (int bit = 0; bit < 64; bit++) {
    x[bit] = (bit % 8 + 0.5) / 8;
    y[bit] = (bit / 8 + 0.5) / 8;
  }
  hsr_sample_masks(k, x, y, mask);
  for (long l = 0; l < LINES; l++) {
    struct line line = random_line(seed);
    bool inside;
    int entry = look_up(&line, k, &inside);
    if (entry < 0)
      continue;
    uint64_t samples = inside ? mask[entry] : ~mask[entry];
    crossing++;
    for (int bit = 0; bit < 64; bit++) {
      int64_t sx = (2 * (bit % 8) + 1) * (UNIT / 16);
      int64_t sy = (2 * (bit / 8) + 1) * (UNIT / 16);
      int64_t f = at(&line, sx, sy);
      if (!f || (samples >> bit & 1) == (f > 0))
        continue;
      wrong++;
      decided += is_decided(entry, k, sx, sy);
    }
  }
  free(mask);
  double share = (double)wrong / (64.0 * (double)crossing);
  ok(tap, wrong && !decided,
     "K = %d: masks of samples are wrong only where lines of the entry differ: "
     "%.3f %% of samples, %ld elsewhere",
     k, 100 * share, decided);
  return share;
}

int main(void) {
  static const struct {
    int intervals;
    double active; /* without a slack */
  } some[] = {{4, 16.2},  {8, 12.1},  {16, 10.5},
              {32, 9.72}, {64, 9.31}, {128, 9.10}};
  enum { SOME = sizeof some / sizeof *some };
  struct tap tap = plan(5 * SOME + 2);
  uint64_t seed = 1996;
  double active = 64, wrong = 1;
  bool falls = true;
  for (int s = 0; s < SOME; s++) {
    struct hsr_triage_tables tables;
    struct hsr_error err;
    int k = some[s].intervals;
    if (hsr_triage_init(&tables, k, &err))
      bail("out of memory");
    test_lines(&tap, &tables, &seed);
    test_entries(&tap, &tables, &seed);
    if (k == 8)
      test_one(&tap, &tables);
    double mean = test_figures(&tap, &tables, some[s].active);
    double share = test_samples(&tap, k, &seed);
    falls &= mean < active && share < 0.7 * wrong;
    active = mean;
    wrong = share;
    hsr_triage_free(&tables);
  }
  ok(&tap, falls, "the finer the intervals, the fewer are active and wrong");
  return finish(&tap);
}
