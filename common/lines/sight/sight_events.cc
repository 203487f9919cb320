// SPDX-License-Identifier: GPL-3.0-or-later
// Places along edges: where events are, which part of an edge is in the
// picture, and where an edge pierces a face.
//
// Pierced     The point where A'B' meets a plane is a quotient of two functions
//             that are linear in the displacement. So a sign there is that of a
//             polynomial in e of degree 4: the sign of its first coefficient
//             that is not zero. If all are zero, the plane meets the edge in
//             depth alone (it is parallel to R and U), and the edge counts as
//             not behind it: as if it were a little nearer to the eye, which
//             moves the point towards its end that is behind.
#include "common/lines/sight/sight_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>

using namespace hsr::sight;
using hsr::Exact;
using hsr::Interval;

// --- Places ------------------------------------------------------------------

void hsr_sight_locate(const struct hsr_sight *sight, uint32_t e,
                      struct hsr_sight_event *event) {
  const Numbers &n = *sight->numbers;
  try {
    Interval t = rough_place(n, e, *event);
    // 2^-44 is less than 1e-13.
    if (!(t.sup() - t.inf() <= 0x1p-44 * t.inf())) {
      count_exact(n, HSR_ASK_PLACE);
      const Place<Exact> place = place_of<Exact>(n, e, *event);
      const auto part = hsr::quotient(place.from, place.from - place.to);
      t = Interval(part.inf(), part.sup());
    }
    event->error = t.sup() - t.inf();
    event->t = std::min(1.0, std::max(0.0, t.inf() + event->error / 2));
  } catch (...) {
    sight->tally->out_of_memory = true;
    event->t = event->error = 0;
  }
}

int hsr_sight_compare(const struct hsr_sight *sight, uint32_t e,
                      const struct hsr_sight_event *a,
                      const struct hsr_sight_event *b) {
  if (a->t + a->error < b->t - b->error)
    return -1;
  if (a->t - a->error > b->t + b->error)
    return 1;
  if (a->at == b->at && a->subject == b->subject)
    return 0;
  const Numbers &n = *sight->numbers;
  try {
    count_exact(n, HSR_ASK_PLACE);
    const Place<Exact> p = place_of<Exact>(n, e, *a);
    const Place<Exact> q = place_of<Exact>(n, e, *b);
    const Exact pd = p.from - p.to, qd = q.from - q.to;
    return CGAL::sign(p.from * qd - q.from * pd) * CGAL::sign(pd) *
           CGAL::sign(qd);
  } catch (...) {
    sight->tally->out_of_memory = true;
    return 0;
  }
}

// --- What is in the picture -------------------------------------------------

// Whether a point is safely inside the picture and ahead.
static bool is_inside(const hsr_sight *sight, uint32_t p) {
  const double x = sight->sx[p], y = sight->sy[p];
  return sight->ahead[p] && x > HSR_DELTA && x < sight->view->m - HSR_DELTA &&
         y > HSR_DELTA && y < sight->view->n - HSR_DELTA;
}

// Narrows the part by one border; false if nothing is left.
static bool clip(const hsr_sight *sight, uint32_t e, uint32_t border,
                 hsr_sight_event *from, hsr_sight_event *to) {
  const Numbers &n = *sight->numbers;
  const int a = border_sign(n, border, sight->edges->a[e]);
  const int b = border_sign(n, border, sight->edges->b[e]);
  if (a <= 0 && b <= 0)
    return a == 0 && b == 0 && (border == LEFT || border == TOP);
  if (a >= 0 && b >= 0)
    return true;
  hsr_sight_event at = {0, 0, HSR_AT_BORDER, border, 0};
  hsr_sight_locate(sight, e, &at);
  if (a < 0 && hsr_sight_compare(sight, e, &at, from) > 0)
    *from = at;
  if (b < 0 && hsr_sight_compare(sight, e, &at, to) < 0)
    *to = at;
  return hsr_sight_compare(sight, e, from, to) < 0;
}

bool hsr_sight_picture(const struct hsr_sight *sight, uint32_t e,
                       struct hsr_sight_event *from,
                       struct hsr_sight_event *to) {
  *from = hsr_sight_event{0, 0, HSR_AT_START, 0, 0};
  *to = hsr_sight_event{1, 0, HSR_AT_END, 0, 0};
  if (!has_image(*sight->numbers, sight->edges->a[e], sight->edges->b[e]))
    return false;
  if (is_inside(sight, sight->edges->a[e]) &&
      is_inside(sight, sight->edges->b[e]))
    return true;
  for (uint32_t border = 0; border < N_BORDERS; border++)
    if (!clip(sight, e, border, from, to))
      return false;
  return true;
}

// --- Pierced faces ----------------------------------------------------------

namespace {

// A polynomial in the infinitesimal, of degree 4.
struct Series {
  std::array<Exact, 5> c;

  // value(along), which is linear in v = e R - e^2 U.
  template <class Value> static Series of(const Value &value) {
    Series s;
    for (int along : {VALUE, ALONG_R, ALONG_MINUS_U})
      s.c[size_t(along)] = value(along);
    return s;
  }
  int sign() const {
    for (const Exact &coefficient : c)
      if (const int s = CGAL::sign(coefficient))
        return s;
    return 0;
  }
};

// x y + z w.
Series combine(const Series &x, const Series &y, const Series &z,
               const Series &w) {
  Series sum;
  for (size_t i = 0; i < 3; i++)
    for (size_t k = 0; k < 3; k++)
      sum.c[i + k] = sum.c[i + k] + x.c[i] * y.c[k] + z.c[i] * w.c[k];
  return sum;
}

// The point where A'B' pierces the plane of a face. The heights of its ends
// have different signs.
struct Pierced {
  const Numbers &n;
  uint32_t f, a, b;
  uint32_t behind; // a or b

  // Whether the face covers the point, in intervals and without the
  // displacement: +1 yes, -1 no, 0 uncertain.
  int covers_roughly() const {
    CGAL::Protect_FPU_rounding<true> upwards;
    using T = Interval;
    const Plane<T> plane = n.plane<T>(f);
    const Point<T> A = n.point<T>(a), B = n.point<T>(b);
    // Where a height may be zero, the edge may begin in the plane.
    const T ha = CGAL::abs(plane.height(A));
    const T hb = CGAL::abs(plane.height(B));
    if (!certain_sign(ha) && !certain_sign(hb))
      return 0;
    const Point<T> X = {hb * A.p + ha * B.p, hb * A.d + ha * B.d,
                        hb * A.w + ha * B.w};
    const hsr_world *w = n.sight->world;
    bool inside = false;
    Point<T> P = n.point<T>(w->mesh.vertex[w->mesh.start[f + 1] - 1]);
    int row_p = certain_sign(row_value(n, X, P, VALUE));
    for (uint32_t k = w->mesh.start[f]; k < w->mesh.start[f + 1]; k++) {
      const Point<T> Q = n.point<T>(w->mesh.vertex[k]);
      const int row_q = certain_sign(row_value(n, X, Q, VALUE));
      if (!row_p || !row_q)
        return 0;
      if (row_p != row_q) {
        const int side = certain_sign(side_value(n, P, Q, X, X.w, VALUE));
        if (!side)
          return 0;
        inside ^= side == -row_p;
      }
      P = Q;
      row_p = row_q;
    }
    return inside ? 1 : -1;
  }

  // The sign at X' of a function whose value at a displaced point is
  // value(point, along): X' is between A' and B', by the sizes of the heights.
  template <class Value>
  int sign_at(const Series &ha, const Series &hb, const Value &value) const {
    const Series at_a = Series::of([&](int along) { return value(a, along); });
    const Series at_b = Series::of([&](int along) { return value(b, along); });
    if (const int sign = combine(hb, at_a, ha, at_b).sign())
      return sign;
    return (behind == a ? at_a : at_b).sign();
  }

  Series size_of_height(uint32_t p) const {
    using T = Exact;
    const Plane<T> plane = n.plane<T>(f);
    const Point<T> P = n.point<T>(p);
    const Series height = Series::of(
        [&](int along) { return height_value(n, plane, P, P.w, along); });
    if (height.sign() >= 0)
      return height;
    return Series::of([&](int along) { return -height.c[size_t(along)]; });
  }

  bool covers_exactly() const {
    using T = Exact;
    const Series ha = size_of_height(a), hb = size_of_height(b);
    const auto row = [&](uint32_t q) {
      const Point<T> Q = n.point<T>(q);
      const int sign = sign_at(ha, hb, [&](uint32_t p, int along) {
        return row_value(n, n.point<T>(p), Q, along);
      });
      return sign ? sign : 1;
    };
    const auto side = [&](uint32_t c, uint32_t d) {
      const Point<T> C = n.point<T>(c), D = n.point<T>(d);
      return sign_at(ha, hb, [&](uint32_t p, int along) {
        const Point<T> P = n.point<T>(p);
        return side_value(n, C, D, P, P.w, along);
      });
    };
    return has_odd_parity(n.sight->world, f, row, side);
  }
};

// Whether the edge is ahead at an event.
bool is_ahead(const Numbers &n, uint32_t e, const hsr_sight_event &event) {
  const hsr_sight *s = n.sight;
  const bool a = s->ahead[s->edges->a[e]], b = s->ahead[s->edges->b[e]];
  if (a && b)
    return true;
  if (!a && !b)
    return false;
  hsr_sight_event near = {0, 0, HSR_AT_BORDER, NEAR, 0};
  hsr_sight_locate(s, e, &near);
  return hsr_sight_compare(s, e, &event, &near) == (a ? -1 : 1);
}

} // namespace

bool hsr_sight_pierces(const struct hsr_sight *sight, uint32_t e, uint32_t f,
                       struct hsr_sight_event *event) {
  const Numbers &n = *sight->numbers;
  const uint32_t a = sight->edges->a[e], b = sight->edges->b[e];
  const int far = -sight->facing[f];
  const bool a_behind = height_sign(n, f, a) == far;
  const bool b_behind = height_sign(n, f, b) == far;
  if (a_behind == b_behind)
    return false;
  *event = hsr_sight_event{0, 0, HSR_AT_PLANE, f, b_behind ? 1 : -1, f};
  try {
    const Pierced pierced = {n, f, a, b, b_behind ? b : a};
    int covers = pierced.covers_roughly();
    if (!covers) {
      count_exact(n, HSR_ASK_EDGE);
      covers = pierced.covers_exactly() ? 1 : -1;
    }
    if (covers < 0)
      return false;
  } catch (...) {
    sight->tally->out_of_memory = true;
    return false;
  }
  hsr_sight_locate(sight, e, event);
  return is_ahead(n, e, *event);
}
