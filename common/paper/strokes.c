/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Line k has two halves: number 2k at its first node, and 2k + 1 at its last. At
 * each node, halves are joined in pairs. Lines that are joined to one another make
 * a trail. A trail is closed if each of its halves is joined. Two trails may pass
 * one node. If one of them is closed, two joints at the node are exchanged, and
 * the two trails become one. */
#include "common/paper/strokes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ALONE SIZE_MAX

struct half {
  uint32_t group, node;
  size_t number;
  double along[2]; /* from the node to the other end, of length 1 */
};

struct joining {
  const struct hsr_pen_line *line;
  size_t n;
  const double (*node)[2];
  struct half *half; /* 2 n, by group and node */
  size_t *mate;      /* by number of a half: the half joined to it, or ALONE */
  size_t *trail;     /* by line: another line of the same trail, or itself */
  bool *open;        /* of a trail's representative */
};

static int by_node(const void *a, const void *b) {
  const struct half *s = a, *t = b;
  if (s->group != t->group)
    return s->group < t->group ? -1 : 1;
  if (s->node != t->node)
    return s->node < t->node ? -1 : 1;
  return (s->number > t->number) - (s->number < t->number);
}

static void make_halves(struct joining *j) {
  for (size_t k = 0; k < 2 * j->n; k++) {
    const struct hsr_pen_line *line = &j->line[k / 2];
    const uint32_t here = k % 2 ? line->to : line->from,
                   there = k % 2 ? line->from : line->to;
    struct half *half = &j->half[k];
    *half = (struct half){.group = line->group, .node = here, .number = k};
    double length = 0;
    for (int c = 0; c < 2; c++)
      half->along[c] = j->node[there][c] - j->node[here][c];
    length = hypot(half->along[0], half->along[1]);
    for (int c = 0; c < 2 && length > 0; c++)
      half->along[c] /= length;
    j->mate[k] = ALONE;
  }
  qsort(j->half, 2 * j->n, sizeof *j->half, by_node);
}

/* How far a pen turns from one line into the other: 0 straight on ... 2 back. */
static double turn(const struct half *a, const struct half *b) {
  return 1 + a->along[0] * b->along[0] + a->along[1] * b->along[1];
}

/* --- Joints --------------------------------------------------------------- */

static void join(struct joining *j, const struct half *a,
                 const struct half *b) {
  j->mate[a->number] = b->number;
  j->mate[b->number] = a->number;
}

/* The half that turns least from half a, of those that are not joined. */
static size_t best_for(const struct joining *j, const struct half *half,
                       size_t n, size_t a) {
  size_t best = ALONE;
  for (size_t k = 0; k < n; k++)
    if (k != a && j->mate[half[k].number] == ALONE &&
        (best == ALONE ||
         turn(&half[a], &half[k]) < turn(&half[a], &half[best])))
      best = k;
  return best;
}

/* Joins the halves of a node, until one at most is left: those first that are
 * the best for one another. */
static void join_node(struct joining *j, const struct half *half, size_t n) {
  for (size_t left = n; left >= 2;)
    for (size_t k = 0; k < n && left >= 2; k++) {
      if (j->mate[half[k].number] != ALONE)
        continue;
      const size_t best = best_for(j, half, n, k);
      const size_t again = best_for(j, half, n, best);
      if (again == k ||
          turn(&half[best], &half[again]) >= turn(&half[best], &half[k])) {
        join(j, &half[k], &half[best]);
        left -= 2;
      }
    }
}

/* --- Trails --------------------------------------------------------------- */

static size_t trail_of(struct joining *j, size_t line) {
  while (j->trail[line] != line)
    line = j->trail[line] = j->trail[j->trail[line]];
  return line;
}

static void unite(struct joining *j, size_t a, size_t b, bool open) {
  a = trail_of(j, a);
  b = trail_of(j, b);
  j->trail[b] = a;
  j->open[a] = open;
}

static void find_trails(struct joining *j) {
  for (size_t k = 0; k < j->n; k++)
    j->trail[k] = k;
  for (size_t k = 0; k < 2 * j->n; k++)
    if (j->mate[k] != ALONE)
      unite(j, k / 2, j->mate[k] / 2, false);
  for (size_t k = 0; k < 2 * j->n; k++)
    if (j->mate[k] == ALONE)
      j->open[trail_of(j, k / 2)] = true;
}

static size_t place_in(const struct half *half, size_t n, size_t number) {
  size_t k = 0;
  while (k < n && half[k].number != number)
    k++;
  return k;
}

/* Exchanges the joint of half a with that of half b, the straighter way. */
static void exchange(struct joining *j, const struct half *half, size_t n,
                     size_t a, size_t b) {
  const size_t mate_a = j->mate[half[a].number],
               mate_b = j->mate[half[b].number];
  const size_t c = mate_a == ALONE ? n : place_in(half, n, mate_a),
               d = mate_b == ALONE ? n : place_in(half, n, mate_b);
  /* b is of a closed trail, so it has a mate; or a is, and has one. */
  if (c == n || d == n) {
    const size_t alone = c == n ? a : b, p = c == n ? b : a, q = c == n ? d : c;
    const bool first =
        turn(&half[alone], &half[p]) <= turn(&half[alone], &half[q]);
    join(j, &half[alone], &half[first ? p : q]);
    j->mate[half[first ? q : p].number] = ALONE;
    return;
  }
  const double straight =
                   fmax(turn(&half[a], &half[b]), turn(&half[c], &half[d])),
               crossed =
                   fmax(turn(&half[a], &half[d]), turn(&half[c], &half[b]));
  join(j, &half[a], &half[straight <= crossed ? b : d]);
  join(j, &half[c], &half[straight <= crossed ? d : b]);
}

/* Unites the closed trails that pass a node with another that does. */
static void unite_node(struct joining *j, const struct half *half, size_t n) {
  for (size_t k = 1; k < n; k++) {
    const size_t a = trail_of(j, half[0].number / 2),
                 b = trail_of(j, half[k].number / 2);
    if (a == b || (j->open[a] && j->open[b]))
      continue;
    exchange(j, half, n, 0, k);
    unite(j, a, b, j->open[a] || j->open[b]);
  }
}

static void for_each_node(struct joining *j,
                          void (*visit)(struct joining *j,
                                        const struct half *half, size_t n)) {
  for (size_t k = 0, n; k < 2 * j->n; k += n) {
    const struct half *half = j->half + k;
    for (n = 1; k + n < 2 * j->n && half[n].group == half->group &&
                half[n].node == half->node;)
      n++;
    visit(j, half, n);
  }
}

/* --- Strokes -------------------------------------------------------------- */

static void add_place(struct hsr_strokes *strokes, const double at[2]) {
  memcpy(strokes->at[strokes->n_at++], at, sizeof *strokes->at);
}

/* Whether the pen goes straight on from one half's line into its mate's. */
static bool is_straight(const struct joining *j, size_t from, size_t into) {
  const struct hsr_pen_line *a = &j->line[from / 2], *b = &j->line[into / 2];
  const uint32_t p = from % 2 ? a->from : a->to, q = from % 2 ? a->to : a->from,
                 r = into % 2 ? b->from : b->to;
  const double *s = j->node[p], *t = j->node[q], *u = j->node[r];
  return a->straight == b->straight &&
         (t[0] - s[0]) * (u[0] - t[0]) + (t[1] - s[1]) * (u[1] - t[1]) > 0;
}

static uint32_t node_of(const struct joining *j, size_t half) {
  return half % 2 ? j->line[half / 2].to : j->line[half / 2].from;
}

/* Draws a stroke from half `begin` on. A line that is drawn is its own trail no
 * longer: trail[] becomes ALONE. */
static void draw(struct joining *j, struct hsr_strokes *strokes, size_t begin,
                 bool closed) {
  struct hsr_stroke *stroke = &strokes->stroke[strokes->n++];
  *stroke = (struct hsr_stroke){.group = j->line[begin / 2].group,
                                .first = strokes->n_at,
                                .closed = closed};
  size_t half = begin;
  if (!closed || !is_straight(j, j->mate[begin], begin))
    add_place(strokes, j->node[node_of(j, begin)]);
  for (;;) {
    j->trail[half / 2] = ALONE;
    const size_t end = half ^ 1, next = j->mate[end];
    if (next == begin || next == ALONE) {
      if (!closed)
        add_place(strokes, j->node[node_of(j, end)]);
      break;
    }
    if (!is_straight(j, end, next))
      add_place(strokes, j->node[node_of(j, end)]);
    half = next;
  }
  stroke->n = strokes->n_at - stroke->first;
}

/* Open strokes from their ends on, then closed ones. */
static void draw_all(struct joining *j, struct hsr_strokes *strokes) {
  for (size_t k = 0; k < 2 * j->n; k++)
    if (j->mate[k] == ALONE && j->trail[k / 2] != ALONE)
      draw(j, strokes, k, false);
  for (size_t k = 0; k < 2 * j->n; k++)
    if (j->trail[k / 2] != ALONE)
      draw(j, strokes, k, true);
}

static int by_group(const void *a, const void *b) {
  const struct hsr_stroke *s = a, *t = b;
  if (s->group != t->group)
    return s->group < t->group ? -1 : 1;
  return (s->first > t->first) - (s->first < t->first);
}

enum hsr_status hsr_strokes_join(struct hsr_strokes *strokes,
                                 const struct hsr_pen_line *line, size_t n,
                                 const double (*node)[2],
                                 struct hsr_error *err) {
  struct joining j = {.line = line,
                      .n = n,
                      .node = node,
                      .half = malloc((2 * n + 1) * sizeof *j.half),
                      .mate = malloc((2 * n + 1) * sizeof *j.mate),
                      .trail = malloc((n + 1) * sizeof *j.trail),
                      .open = calloc(n + 1, sizeof *j.open)};
  *strokes =
      (struct hsr_strokes){.stroke = malloc((n + 1) * sizeof *strokes->stroke),
                           .at = malloc((2 * n + 1) * sizeof *strokes->at)};
  enum hsr_status status = HSR_OK;
  if (j.half && j.mate && j.trail && j.open && strokes->stroke && strokes->at) {
    make_halves(&j);
    for_each_node(&j, join_node);
    find_trails(&j);
    for_each_node(&j, unite_node);
    draw_all(&j, strokes);
    qsort(strokes->stroke, strokes->n, sizeof *strokes->stroke, by_group);
  } else {
    status = hsr_fail_nomem(err);
  }
  free(j.half);
  free(j.mate);
  free(j.trail);
  free(j.open);
  return status;
}

void hsr_strokes_free(struct hsr_strokes *strokes) {
  free(strokes->stroke);
  free(strokes->at);
  *strokes = (struct hsr_strokes){.n = 0};
}

struct hsr_travel hsr_strokes_travel(const struct hsr_strokes *strokes) {
  struct hsr_travel travel = {0, 0};
  double pen[2] = {0, 0};
  for (size_t k = 0; k < strokes->n; k++) {
    const struct hsr_stroke *s = &strokes->stroke[k];
    const double(*at)[2] = strokes->at + s->first;
    travel.up += hypot(at[0][0] - pen[0], at[0][1] - pen[1]);
    for (size_t i = 1; i < s->n + s->closed; i++) {
      const double *p = at[i - 1], *q = at[i % s->n];
      travel.down += hypot(q[0] - p[0], q[1] - p[1]);
    }
    memcpy(pen, at[s->closed ? 0 : s->n - 1], sizeof pen);
  }
  return travel;
}
