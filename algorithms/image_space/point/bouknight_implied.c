/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bouknight with implied=carried: the place where two faces penetrate is
 * extrapolated from two rows.
 *
 * Source      Sutherland et al. 1974, chapter IV, "Use of Coherence",
 *             implied-edge coherence: two penetration calculations give the
 *             whole implied edge. It need not be calculated on each scan line.
 * Where       A span is known by the edge at its left end. If two faces
 *             penetrated behind that edge on the row before, and are there on
 *             this row, they are expected to do so again.
 * Exact       The extrapolated column c decides nothing by itself. The left
 *             face must be the nearest at sample c - 1, and the right one at c.
 *             Since 1/t is linear on the row, the left one is then nearer than
 *             the right one at all samples up to c - 1, and farther from c on.
 *             So at the span's limits they need not be compared with each
 *             other, only with further faces. A face that is nearest at two
 *             samples is so between them.
 * Departures  The survey would save the calculation of the point. That is one
 *             division of numbers, and no comparison. Here comparisons in depth
 *             are saved: where two faces are in a span, two take the place of
 *             six.
 * Limits      A span in which more than two faces come to be visible is
 *             searched as ever
 * Measured    Comparisons in depth on 500 lines of 500 samples, without the
 *             option and with it, and failures of an extrapolation:
 *               penetration    6,928    5,328  2 of 347
 *               soup         183,730  183,462  0 of 87
 *             In house, harbor and big-harbor no faces penetrate, so bouknight
 *             makes the same comparisons. yzx divides faces there, too, where
 *             no test tells their order. Its comparisons to find where halves
 *             meet (implied edges):
 *               penetration    6,235    4,767
 *               soup          56,310   46,993
 *               house            520      494
 *               harbor         1,787    1,380
 *               big-harbor       889      889 */
#include "algorithms/image_space/point/bouknight.h"

#include <limits.h>

enum hsr_status bouknight_begin_implied(struct bouknight *s) {
  size_t n = (size_t)s->edges.n_edges + 1;
  s->implied = HSR_NEW(s->edges.job->scratch, struct bouknight_implied, n);
  if (!s->implied)
    return HSR_E_NOMEM;
  for (size_t e = 0; e < n; e++)
    s->implied[e] = (struct bouknight_implied){.row = INT_MIN};
  return HSR_OK;
}

static struct bouknight_implied *implied_behind(const struct bouknight *s,
                                                uint32_t e) {
  return &s->implied[e == HSR_NO_ID ? s->edges.n_edges : e];
}

void bouknight_note_implied(struct bouknight *s, uint32_t e, uint32_t first,
                            uint32_t last) {
  struct bouknight_implied *known = implied_behind(s, e);
  if (known->row != s->j - 1 || known->first != first || known->last != last)
    *known = (struct bouknight_implied){first, last, s->j, {0}};
  known->row = s->j;
  if (hsr_implied_note(&known->line, &s->edges, first, last, s->j))
    HSR_STEP(s->edges.tally, BOUKNIGHT_POINTS, HSR_FACE(first), HSR_FACE(last),
             HSR_ON(s->edges.window->x0, s->edges.window->x1, s->j), 0);
}

/* Is `first` the nearest in [left, column), and `last` in [column, right)? */
static bool is_there(struct bouknight *s, uint32_t first, uint32_t last,
                     int left, int column, int right) {
  return bouknight_search(s, first, BOUKNIGHT_NONE, column - 1) == first &&
         bouknight_search(s, last, BOUKNIGHT_NONE, column) == last &&
         (left == column - 1 ||
          bouknight_search(s, first, last, left) == first) &&
         (right - 1 == column ||
          bouknight_search(s, last, first, right - 1) == last);
}

bool bouknight_extrapolate(struct bouknight *s, uint32_t e, int left,
                           int right) {
  struct bouknight_implied *known = implied_behind(s, e);
  uint32_t first = known->first, last = known->last;
  if (known->row != s->j - 1 || known->line.points < 2 ||
      s->place[first] == BOUKNIGHT_NONE || s->place[last] == BOUKNIGHT_NONE)
    return false;
  int column = hsr_implied_column(&known->line, &s->edges, s->j);
  bool inside = column > left && column < right;
  HSR_STEP(s->edges.tally, BOUKNIGHT_PREDICTED, HSR_FACE(first), HSR_FACE(last),
           HSR_ON(left, right, s->j), inside);
  if (!inside)
    return false;
  HSR_STEP(s->edges.tally, BOUKNIGHT_VERIFIED, HSR_FACE(first), HSR_FACE(last),
           HSR_AT(column, s->j), 0);
  if (!is_there(s, first, last, left, column, right)) {
    HSR_STEP(s->edges.tally, BOUKNIGHT_FAILED, HSR_FACE(first), HSR_FACE(last),
             HSR_AT(column, s->j), 0);
    return false;
  }
  known->row = s->j;
  HSR_STEP(s->edges.tally, BOUKNIGHT_DIVISIONS, HSR_FACE(first), HSR_FACE(last),
           HSR_ON(left, right, s->j), 0);
  bouknight_write(s, first, left, column);
  bouknight_write(s, last, column, right);
  return true;
}
