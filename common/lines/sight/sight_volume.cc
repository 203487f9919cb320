// SPDX-License-Identifier: GPL-3.0-or-later
// Edges against convex volumes: the sides of planes and of lines that an edge
// is on, and bounds of a box on the screen.
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

// Fills t and error of an event, however great the error is.
void locate_roughly(const Numbers &n, uint32_t e, hsr_sight_event *event) {
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

bool hsr_sight_narrow(const struct hsr_sight *sight, uint32_t e,
                      enum hsr_event_at at, uint32_t subject, int side,
                      struct hsr_sight_event *from,
                      struct hsr_sight_event *to) {
  const Numbers &n = *sight->numbers;
  const auto sign_at = [&](uint32_t p) {
    return side * (at == HSR_AT_PLANE ? plane_sign(n, subject, p)
                                      : line_sign(n, sight->line[subject], p));
  };
  const int a = sign_at(sight->edges->a[e]), b = sign_at(sight->edges->b[e]);
  if (a == 0 && b == 0)
    return at == HSR_AT_LINE &&
           displaced_line_sign(n, sight->line[subject]) == side;
  if (a <= 0 && b <= 0)
    return false;
  if (a >= 0 && b >= 0)
    return true;
  hsr_sight_event event = {0, 0, at, subject, 0};
  locate_roughly(n, e, &event);
  if (a < 0 && hsr_sight_compare(sight, e, &event, from) > 0)
    *from = event;
  if (b < 0 && hsr_sight_compare(sight, e, &event, to) < 0)
    *to = event;
  return hsr_sight_compare(sight, e, from, to) < 0;
}
