// SPDX-License-Identifier: GPL-3.0-or-later
// Edges against convex volumes: the sides of planes and of lines that an edge
// is on, and bounds of a box on the screen.
//
// Places      where edge A B crosses the image of a line, t = X / (X + Y). Here X
//             and Y are the sizes of the turns from the line to A and to B
//             (hsr_sight_turn), each times the other end's q; in parallel, the
//             turns alone. In doubles X is off by at most its turn's bound
//             times q, and 2^-40 of itself, since q is off by 2^-42 of itself;
//             likewise Y. Let e be both errors together and M = X + Y. Then t is
//             off by at most e / (M - e); that is less than 2 e / M if e is at
//             most M / 4. Five roundings of numbers up to 1 are less than 2^-50.
#include "common/lines/sight/sight_numbers.h"

#include <algorithm>
#include <cmath>

using namespace hsr::sight;
using hsr::Interval;

static Interval hull(const Interval &a, const Interval &b) {
  return {std::min(a.inf(), b.inf()), std::max(a.sup(), b.sup())};
}

struct hsr_extent hsr_sight_enclose(const struct hsr_sight *sight,
                                    const double lo[3], const double hi[3]) {
  using T = Interval;
  const Eye<T> &eye = sight->numbers->rough;
  CGAL::Protect_FPU_rounding<true> upwards;
  T x, y, q;
  for (int k = 0; k < 8; k++) {
    const double corner[3] = {k & 1 ? hi[0] : lo[0], k & 2 ? hi[1] : lo[1],
                              k & 4 ? hi[2] : lo[2]};
    const Point<T> P = eye.seen_point(lift<T>(corner) - eye.E, T(1));
    if (!(P.w.inf() > 0))
      return {-INFINITY, -INFINITY, INFINITY, INFINITY, -INFINITY, INFINITY};
    const T here[3] = {dot(eye.X, P.p) / P.w, dot(eye.Y, P.p) / P.w,
                       eye.scale * P.d / P.w};
    x = k ? hull(x, here[0]) : here[0];
    y = k ? hull(y, here[1]) : here[1];
    q = k ? hull(q, here[2]) : here[2];
  }
  x = (x + T(1)) * T(sight->view->m / 2.0);
  y = (T(1) - y) * T(sight->view->n / 2.0);
  return {x.inf(), y.inf(), x.sup(), y.sup(), q.inf(), q.sup()};
}

int hsr_sight_eye_side(const struct hsr_sight *sight, uint32_t f) {
  return facing_sign(*sight->numbers, f);
}

namespace {

// The side of a line through two points, as far as doubles make it certain; else
// 0.
int rough_line_sign(const Numbers &n, const hsr_sight_line &line, uint32_t p) {
  double bound, turn = hsr_sight_turn(n.sight, line.a, line.b, p, &bound);
  return n.sight->ahead[p] && (turn > bound || turn < -bound)
             ? turn > 0 ? 1 : -1
             : 0;
}

int line_sign(const Numbers &n, const hsr_sight_line &line, uint32_t p) {
  if (!line.of_planes) {
    if (p == line.a || p == line.b)
      return 0;
    if (const int side = rough_line_sign(n, line, p))
      return side;
  }
  return sign_of(n, HSR_ASK_EDGE, [&](auto t) {
    using T = decltype(t);
    return dot(normal_of_image<T>(n, line), n.point<T>(p).p);
  });
}

// The side of a line for an edge whose image lies on that of the line.
int displaced_line_sign(const Numbers &n, const hsr_sight_line &line) {
  return displaced_sign(n, HSR_ASK_EDGE, [&](auto t, int along) {
    using T = decltype(t);
    if (along == VALUE)
      return T(0);
    return dot(normal_of_image<T>(n, line), change<T>(n, along));
  });
}

// Fills t and error of an event, which is at a line with the ends of e on both
// sides, in doubles. False if they are not good enough.
bool locate_on_line(const Numbers &n, uint32_t e, hsr_sight_event *event) {
  const hsr_sight *s = n.sight;
  const hsr_sight_line &line = s->line[event->subject];
  const uint32_t a = s->edges->a[e], b = s->edges->b[e];
  if (line.of_planes || !s->ahead[a] || !s->ahead[b])
    return false;
  double bound_a, bound_b;
  const double turn_a =
      std::fabs(hsr_sight_turn(s, line.a, line.b, a, &bound_a));
  const double turn_b =
      std::fabs(hsr_sight_turn(s, line.a, line.b, b, &bound_b));
  const double by_a = s->view->parallel ? 1 : s->q[b];
  const double by_b = s->view->parallel ? 1 : s->q[a];
  const double x = turn_a * by_a, y = turn_b * by_b, sum = x + y;
  const double off = bound_a * by_a + bound_b * by_b + 0x1p-40 * sum;
  if (!(turn_a > bound_a && turn_b > bound_b && off <= sum / 4))
    return false;
  event->t = x / sum;
  event->error = 2 * off / sum + 0x1p-50;
  return true;
}

// Fills t and error of an event, however great the error is.
void locate_roughly(const Numbers &n, uint32_t e, hsr_sight_event *event) {
  if (event->at == HSR_AT_LINE && locate_on_line(n, e, event))
    return;
  const Interval t = rough_place(n, e, *event);
  const double least = t.inf() > 0 ? t.inf() : 0; // also if that is NaN
  const double most = t.sup() < 1 ? t.sup() : 1;
  event->t = least + (most - least) / 2;
  event->error = most - least;
}

} // namespace

bool hsr_sight_excludes(const struct hsr_sight *sight, uint32_t e,
                        enum hsr_event_at at, uint32_t subject, int side) {
  const Numbers &n = *sight->numbers;
  const hsr_world *w = sight->world;
  const hsr_sight_line *line =
      at == HSR_AT_LINE ? &sight->line[subject] : nullptr;
  if (line && line->of_planes)
    return false;
  int n_on_line = 0;
  for (uint32_t p : {sight->edges->a[e], sight->edges->b[e]}) {
    if (line && (p == line->a || p == line->b)) {
      n_on_line++;
      continue;
    }
    if (p >= w->mesh.n_vertices ||
        (line ? rough_line_sign(n, *line, p)
              : hsr::rough_side(w, subject, p)) != -side)
      return false;
  }
  return n_on_line < 2;
}

struct hsr_sight_half hsr_sight_find_half(const struct hsr_sight *sight,
                                          uint32_t e, enum hsr_event_at at,
                                          uint32_t subject, int side) {
  const Numbers &n = *sight->numbers;
  const auto sign_at = [&](uint32_t p) {
    return side * (at == HSR_AT_PLANE ? plane_sign(n, subject, p)
                                      : line_sign(n, sight->line[subject], p));
  };
  const int a = sign_at(sight->edges->a[e]), b = sign_at(sight->edges->b[e]);
  hsr_sight_half half = {hsr_sight_half::HSR_HALF_NONE,
                         {0, 0, at, subject, 0, 0}};
  if (a == 0 && b == 0) {
    if (at == HSR_AT_LINE &&
        displaced_line_sign(n, sight->line[subject]) == side)
      half.part = hsr_sight_half::HSR_HALF_ALL;
  } else if (a >= 0 && b >= 0) {
    half.part = hsr_sight_half::HSR_HALF_ALL;
  } else if (a > 0 || b > 0) {
    half.part = a < 0 ? hsr_sight_half::HSR_HALF_AFTER
                      : hsr_sight_half::HSR_HALF_BEFORE;
    locate_roughly(n, e, &half.at);
  }
  return half;
}

bool hsr_sight_narrow(const struct hsr_sight *sight, uint32_t e,
                      const struct hsr_sight_half *half,
                      struct hsr_sight_event *from,
                      struct hsr_sight_event *to) {
  if (half->part == hsr_sight_half::HSR_HALF_NONE)
    return false;
  if (half->part == hsr_sight_half::HSR_HALF_ALL)
    return true;
  const bool after = half->part == hsr_sight_half::HSR_HALF_AFTER;
  if (hsr_sight_compare(sight, e, &half->at, after ? from : to) ==
      (after ? 1 : -1))
    *(after ? from : to) = half->at;
  return hsr_sight_compare(sight, e, from, to) < 0;
}
