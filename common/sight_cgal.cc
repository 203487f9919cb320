// SPDX-License-Identifier: GPL-3.0-or-later
// The exact services of common/sight.h, over CGAL's number types.
//
// Notation    a point P is (p, d), P - E = p / d, d > 0: so ends of implied
//             edges need no division. w(p) is its depth times d and a positive
//             constant. v = e R - e^2 U is the displacement of a direction, e
//             infinitesimal; a displaced point is p' = p + w(p) v.
// Method      Whatever is asked is linear in v, but for coverage where an edge
//             pierces a plane. Its sign is that of its value, else of its
//             change along R, else along -U: each is a polynomial in the input
//             doubles, evaluated in intervals, and in CGAL's Mpzf, which is
//             exact, if the interval of the value holds zero.
// Pierced     Where A'B' meets a plane is a quotient of two such; there a sign
//             is that of a polynomial in e of degree 4, whose first coefficient
//             that is not zero tells. If all are zero, the plane meets the edge
//             in depth alone (it is parallel to R and U), and the edge counts
//             as not behind it: as if it were a little nearer to the eye, which
//             moves the point towards its end that is behind.

#include "common/sight.h"
#include "common/exact_points.h"

#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>

#include <algorithm>
#include <array>
#include <new>
#include <vector>

namespace {

using hsr::Exact;
using hsr::Interval;
using Safe = CGAL::Interval_nt<true>;

template <class T> struct vec { T x, y, z; };
template <class T> vec<T> operator+(const vec<T> &a, const vec<T> &b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T> vec<T> operator-(const vec<T> &a, const vec<T> &b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T> vec<T> operator*(const T &s, const vec<T> &a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T> T dot(const vec<T> &a, const vec<T> &b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T> vec<T> cross(const vec<T> &a, const vec<T> &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T> T det(const vec<T> &a, const vec<T> &b, const vec<T> &c) {
  return dot(cross(a, b), c);
}
template <class T> vec<T> lift(const double v[3]) {
  return {T(v[0]), T(v[1]), T(v[2])};
}

// The eye: w(p) = s det(p, R, U), and likewise x w and y w, all times `scale`.
template <class T> struct Eye {
  vec<T> E, F, R, U, W, X, Y;
  T scale, near;

  void set(const hsr_view &view, int s) {
    const T sign = T(double(s));
    E = lift<T>(view.E);
    F = lift<T>(view.F);
    R = lift<T>(view.R);
    U = lift<T>(view.U);
    W = sign * cross(R, U);
    X = sign * cross(U, F);
    Y = sign * cross(F, R);
    scale = dot(F, W);
    near = T(view.near);
  }
};

// (p, d), and its w.
template <class T> struct Point {
  vec<T> p;
  T d, w;
};

// h(p) = N . (k p - c d), its sign +1 in front of the plane; the eye's is -c.
template <class T> struct Plane {
  vec<T> kN;
  T c;
  T height(const Point<T> &P) const { return dot(kN, P.p) - c * P.d; }
};

} // namespace

struct hsr_sight_numbers {
  const hsr_sight *sight;
  Eye<Interval> rough;
  Eye<Exact> exact;

  template <class T> const Eye<T> &eye() const;
  template <class T> Point<T> point(uint32_t p) const;
  template <class T> Plane<T> plane(uint32_t f) const;
};

template <> const Eye<Interval> &hsr_sight_numbers::eye<Interval>() const {
  return rough;
}
template <> const Eye<Exact> &hsr_sight_numbers::eye<Exact>() const {
  return exact;
}

namespace {

using Numbers = hsr_sight_numbers;

void convert(const Exact &from, Interval &to) {
  to = Interval(CGAL::to_interval(from));
}
void convert(const Exact &from, Exact &to) {
  to = from;
}

template <class T>
Point<T> with_depth(const Eye<T> &eye, const vec<T> &p, const T &d) {
  return {p, d, dot(eye.W, p)};
}

} // namespace

template <class T> Point<T> hsr_sight_numbers::point(uint32_t p) const {
  const hsr_world *w = sight->world;
  if (p < w->n_vertices) {
    const double v[3] = {w->x[p], w->y[p], w->z[p]};
    return with_depth<T>(eye<T>(), lift<T>(v) - eye<T>().E, T(1));
  }
  const hsr::Exact_point &from = sight->edges->exact->points[p - w->n_vertices];
  vec<T> at;
  T d;
  convert(from.at[0], at.x);
  convert(from.at[1], at.y);
  convert(from.at[2], at.z);
  convert(from.denominator, d);
  return with_depth<T>(eye<T>(), at - d * eye<T>().E, d);
}

template <class T> Plane<T> hsr_sight_numbers::plane(uint32_t f) const {
  const hsr::Plane<T> plane(sight->world, f);
  const vec<T> kN = {plane.k * plane.normal[0], plane.k * plane.normal[1],
                     plane.k * plane.normal[2]};
  return {kN, plane.offset - dot(kN, eye<T>().E)};
}

namespace {

// --- Signs -----------------------------------------------------------------

enum { VALUE, ALONG_R, ALONG_MINUS_U };

int certain_sign(const Interval &number) {
  return number.inf() > 0 ? 1 : number.sup() < 0 ? -1 : 0;
}
int certain_sign(const Exact &number) {
  return CGAL::sign(number);
}

// The direction of a change, or the sign with which one counts.
template <class T> vec<T> change(const Numbers &n, int along) {
  const Eye<T> &eye = n.eye<T>();
  return along == ALONG_R ? eye.R : vec<T>{-eye.U.x, -eye.U.y, -eye.U.z};
}

void count_exact(const Numbers &n, enum hsr_question question) {
  n.sight->tally->exact[question]++;
}

// value(T(), along) is linear in the displacement. 0 if it is zero always.
template <class Value>
int displaced_sign(const Numbers &n, enum hsr_question question,
                   const Value &value) noexcept {
  try {
    {
      CGAL::Protect_FPU_rounding<true> upwards;
      if (const int sign = certain_sign(value(Interval(), VALUE)))
        return sign;
    }
    count_exact(n, question);
    for (int along : {VALUE, ALONG_R, ALONG_MINUS_U})
      if (const int sign = certain_sign(value(Exact(), along)))
        return sign;
    return 0;
  } catch (...) {
    n.sight->tally->out_of_memory = true;
    return 1;
  }
}

// The sign of value(T()).
template <class Value>
int sign_of(const Numbers &n, enum hsr_question question,
            const Value &value) noexcept {
  return displaced_sign(n, question, [&](auto t, int along) {
    using T = decltype(t);
    return along == VALUE ? value(t) : T(0);
  });
}

// det(c, d, p'), or its change; w is p's, or that of the end from where p is
// looked for.
template <class T>
T side_value(const Numbers &n, const Point<T> &c, const Point<T> &d,
             const Point<T> &p, const T &w, int along) {
  if (along == VALUE)
    return det(c.p, d.p, p.p);
  return w * det(c.p, d.p, change<T>(n, along));
}

// Of plane f at p', or the change.
template <class T>
T height_value(const Numbers &n, const Plane<T> &plane, const Point<T> &p,
               const T &w, int along) {
  if (along == VALUE)
    return plane.height(p);
  return w * dot(plane.kN, change<T>(n, along));
}

// det(p', R, q), or its change.
template <class T>
T row_value(const Numbers &n, const Point<T> &p, const Point<T> &q, int along) {
  const vec<T> &R = n.eye<T>().R;
  if (along == VALUE)
    return det(p.p, R, q.p);
  return p.w * det(change<T>(n, along), R, q.p);
}

int height_sign(const Numbers &n, uint32_t f, uint32_t p) {
  return displaced_sign(n, HSR_ASK_VERTEX, [&](auto t, int along) {
    using T = decltype(t);
    const Point<T> P = n.point<T>(p);
    return height_value(n, n.plane<T>(f), P, P.w, along);
  });
}

int facing_sign(const Numbers &n, uint32_t f) {
  return -sign_of(n, HSR_ASK_FACING, [&](auto t) {
    using T = decltype(t);
    return n.plane<T>(f).c;
  });
}

} // namespace

// --- Images ------------------------------------------------------------------

int hsr_sight_side_exact(const struct hsr_sight *sight, uint32_t c, uint32_t d,
                         uint32_t p) {
  const Numbers &n = *sight->numbers;
  return displaced_sign(n, HSR_ASK_EDGE, [&](auto t, int along) {
    using T = decltype(t);
    const Point<T> P = n.point<T>(p);
    return side_value(n, n.point<T>(c), n.point<T>(d), P, P.w, along);
  });
}

int hsr_sight_line_side_exact(const struct hsr_sight *sight, uint32_t a,
                              uint32_t b, uint32_t p) {
  const Numbers &n = *sight->numbers;
  return displaced_sign(n, HSR_ASK_EDGE, [&](auto t, int along) {
    using T = decltype(t);
    const Point<T> A = n.point<T>(a), B = n.point<T>(b), P = n.point<T>(p);
    if (along == VALUE)
      return det(A.p, B.p, P.p);
    return det(change<T>(n, along), A.w * B.p - B.w * A.p, P.p);
  });
}

int hsr_sight_row_side_exact(const struct hsr_sight *sight, uint32_t p,
                             uint32_t q) {
  const Numbers &n = *sight->numbers;
  const int sign = displaced_sign(n, HSR_ASK_ROW, [&](auto t, int along) {
    using T = decltype(t);
    return row_value(n, n.point<T>(p), n.point<T>(q), along);
  });
  return sign ? sign : 1;
}

// --- Depth -------------------------------------------------------------------

bool hsr_sight_behind(const struct hsr_sight *sight, uint32_t f, uint32_t p) {
  return height_sign(*sight->numbers, f, p) == -sight->facing[f];
}

bool hsr_sight_nearer(const struct hsr_sight *sight, uint32_t e, uint32_t c) {
  const Numbers &n = *sight->numbers;
  const hsr_edges *edges = sight->edges;
  const uint32_t a = edges->a[e], b = edges->b[e];
  // Scaling A'B' from the eye until it meets the edge scales this volume
  // through zero; its sign before is that of the side on which D lies.
  const int volume = displaced_sign(n, HSR_ASK_DEPTH, [&](auto t, int along) {
    using T = decltype(t);
    const Point<T> A = n.point<T>(a), B = n.point<T>(b);
    const Point<T> C = n.point<T>(edges->a[c]), D = n.point<T>(edges->b[c]);
    const vec<T> CD = cross(C.p, D.p);
    if (along == VALUE)
      return A.d * dot(CD, B.p) - B.d * dot(CD, A.p) +
             dot(cross(A.p, B.p), D.p - C.p);
    const vec<T> by = change<T>(n, along);
    return (A.d * B.w - B.d * A.w) * dot(CD, by) +
           dot(cross(by, A.w * B.p - B.w * A.p), D.p - C.p);
  });
  return volume && volume == hsr_sight_line_side(sight, a, b, edges->b[c]);
}

// The side of the line c d on which e is, close to its end p.
static int side_of_beginning(const hsr_sight *sight, uint32_t c, uint32_t d,
                             uint32_t p, uint32_t other) {
  double bound, turn = hsr_sight_turn(sight, c, d, other, &bound);
  if (turn > bound)
    return 1;
  if (turn < -bound)
    return -1;
  const Numbers &n = *sight->numbers;
  return displaced_sign(n, HSR_ASK_EDGE, [&](auto t, int along) {
    using T = decltype(t);
    return side_value(n, n.point<T>(c), n.point<T>(d), n.point<T>(other),
                      n.point<T>(p).w, along);
  });
}

static int turn_of_corner(const hsr_sight *sight, uint32_t c, uint32_t d,
                          uint32_t p) {
  double bound, turn = hsr_sight_turn(sight, c, d, p, &bound);
  if (turn > bound)
    return 1;
  if (turn < -bound)
    return -1;
  const Numbers &n = *sight->numbers;
  return sign_of(n, HSR_ASK_EDGE, [&](auto t) {
    using T = decltype(t);
    return det(n.point<T>(c).p, n.point<T>(d).p, n.point<T>(p).p);
  });
}

bool hsr_sight_corner_hides(const struct hsr_sight *sight, uint32_t e,
                            uint32_t p, struct hsr_corner corner) {
  const Numbers &n = *sight->numbers;
  const hsr_world *w = sight->world;
  const uint32_t f = corner.face, first = w->start[f], last = w->start[f + 1];
  const uint32_t before =
      w->vertex[corner.k == first ? last - 1 : corner.k - 1];
  const uint32_t after = w->vertex[corner.k + 1 == last ? first : corner.k + 1];
  const uint32_t other =
      sight->edges->a[e] == p ? sight->edges->b[e] : sight->edges->a[e];
  const int inside = -sight->facing[f];
  const bool in_arriving =
      side_of_beginning(sight, before, p, p, other) == inside;
  const bool in_leaving =
      side_of_beginning(sight, p, after, p, other) == inside;
  const bool reflex = turn_of_corner(sight, before, p, after) == -inside;
  if (!(reflex ? in_arriving || in_leaving : in_arriving && in_leaving))
    return false;
  const int height = displaced_sign(n, HSR_ASK_VERTEX, [&](auto t, int along) {
    using T = decltype(t);
    return height_value(n, n.plane<T>(f), n.point<T>(other), n.point<T>(p).w,
                        along);
  });
  return height == -sight->facing[f];
}

// --- Places of events
// ------------------------------------------------------------

namespace {

// The borders of what is in the picture.
enum { NEAR, LEFT, RIGHT, BOTTOM, TOP, N_BORDERS };

template <class T>
T border_value(const Eye<T> &eye, uint32_t border, const Point<T> &P) {
  switch (border) {
  case NEAR:
    return P.w - eye.near * eye.scale * P.d;
  case LEFT:
    return P.w + dot(eye.X, P.p);
  case RIGHT:
    return P.w - dot(eye.X, P.p);
  case BOTTOM:
    return P.w + dot(eye.Y, P.p);
  default:
    return P.w - dot(eye.Y, P.p);
  }
}

uint32_t side_begins(const hsr_world *w, uint32_t k) {
  // The face of the corner: the last that starts at or before it.
  const uint32_t *face =
      std::upper_bound(w->start, w->start + w->n_faces + 1, k) - 1;
  return w->vertex[k == face[0] ? face[1] - 1 : k - 1];
}

// Where an event is: t = from / (from - to), `from` and `to` being the values
// at both ends of a function that is zero there.
template <class T> struct Place { T from, to; };

template <class T>
Place<T> place_of(const Numbers &n, uint32_t e, const hsr_sight_event &event) {
  const hsr_sight *s = n.sight;
  const hsr_edges *edges = s->edges;
  if (event.at == HSR_AT_START)
    return {T(0), T(-1)};
  if (event.at == HSR_AT_END)
    return {T(1), T(0)};
  const Point<T> A = n.point<T>(edges->a[e]), B = n.point<T>(edges->b[e]);
  T from, to;
  if (event.at == HSR_AT_EDGE || event.at == HSR_AT_SIDE) {
    const bool is_edge = event.at == HSR_AT_EDGE;
    const uint32_t c = is_edge ? edges->a[event.subject]
                               : side_begins(s->world, event.subject);
    const uint32_t d =
        is_edge ? edges->b[event.subject] : s->world->vertex[event.subject];
    const vec<T> normal = cross(n.point<T>(c).p, n.point<T>(d).p);
    from = dot(normal, A.p);
    to = dot(normal, B.p);
  } else if (event.at == HSR_AT_ROW) {
    const vec<T> normal = cross(n.eye<T>().R, n.point<T>(event.subject).p);
    from = dot(normal, A.p);
    to = dot(normal, B.p);
  } else if (event.at == HSR_AT_BORDER) {
    from = border_value(n.eye<T>(), event.subject, A);
    to = border_value(n.eye<T>(), event.subject, B);
  } else {
    const Plane<T> plane = n.plane<T>(event.subject);
    const Eye<T> &eye = n.eye<T>();
    if (event.at == HSR_AT_PLANE) {
      from = plane.height(A);
      to = plane.height(B);
    } else {
      const T near = eye.near * eye.scale;
      from = plane.c * A.w - near * dot(plane.kN, A.p);
      to = plane.c * B.w - near * dot(plane.kN, B.p);
    }
  }
  return {from * B.d, to * A.d};
}

} // namespace

void hsr_sight_locate(const struct hsr_sight *sight, uint32_t e,
                      struct hsr_sight_event *event) {
  const Numbers &n = *sight->numbers;
  try {
    Interval t(0, 1);
    {
      CGAL::Protect_FPU_rounding<true> upwards;
      const Place<Interval> place = place_of<Interval>(n, e, *event);
      t = place.from / (place.from - place.to);
    }
    // 2^-44 is less than 1e-13.
    if (!(t.sup() - t.inf() <= 0x1p-44 * t.inf())) {
      count_exact(n, HSR_ASK_PLACE);
      const Place<Exact> place = place_of<Exact>(n, e, *event);
      const Safe quotient = Safe(CGAL::to_interval(place.from)) /
                            Safe(CGAL::to_interval(place.from - place.to));
      t = Interval(quotient.inf(), quotient.sup());
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

// --- What is in the picture
// --------------------------------------------------------

// Whether a and b are not on a line with the eye.
static bool has_image(const hsr_sight *sight, uint32_t a, uint32_t b) {
  const double dx = sight->sx[a] - sight->sx[b];
  const double dy = sight->sy[a] - sight->sy[b];
  if (std::fabs(dx) > 4 * HSR_DELTA || std::fabs(dy) > 4 * HSR_DELTA)
    return true;
  const Numbers &n = *sight->numbers;
  try {
    const vec<Exact> normal = cross(n.point<Exact>(a).p, n.point<Exact>(b).p);
    return CGAL::sign(normal.x) || CGAL::sign(normal.y) || CGAL::sign(normal.z);
  } catch (...) {
    sight->tally->out_of_memory = true;
    return false;
  }
}

// Safely inside the picture and ahead.
static bool is_inside(const hsr_sight *sight, uint32_t p) {
  const double x = sight->sx[p], y = sight->sy[p];
  return sight->ahead[p] && x > HSR_DELTA && x < sight->view->m - HSR_DELTA &&
         y > HSR_DELTA && y < sight->view->n - HSR_DELTA;
}

static int border_sign(const Numbers &n, uint32_t border, uint32_t p) {
  return sign_of(n, HSR_ASK_EDGE, [&](auto t) {
    using T = decltype(t);
    return border_value(n.eye<T>(), border, n.point<T>(p));
  });
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
  if (!has_image(sight, sight->edges->a[e], sight->edges->b[e]))
    return false;
  if (is_inside(sight, sight->edges->a[e]) &&
      is_inside(sight, sight->edges->b[e]))
    return true;
  for (uint32_t border = 0; border < N_BORDERS; border++)
    if (!clip(sight, e, border, from, to))
      return false;
  return true;
}

// --- Pierced faces
// -------------------------------------------------------------------

namespace {

// Whether face f covers a direction: an odd number of its sides cross to the
// right. row(q) is the sign of det(D, R, q), side(c, d) that of det(c, d, D).
template <class Row, class Side>
bool has_odd_parity(const hsr_world *w, uint32_t f, const Row &row,
                    const Side &side) {
  bool odd = false;
  uint32_t p = w->vertex[w->start[f + 1] - 1];
  int row_p = row(p);
  for (uint32_t k = w->start[f]; k < w->start[f + 1]; k++) {
    const uint32_t q = w->vertex[k];
    const int row_q = row(q);
    if (row_p != row_q)
      odd ^= side(p, q) == -row_p;
    p = q;
    row_p = row_q;
  }
  return odd;
}

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

// Where A'B' pierces the plane of a face, the heights of its ends having
// different signs.
struct Pierced {
  const Numbers &n;
  uint32_t f, a, b;
  uint32_t behind; // a or b

  // Covering by intervals, where the displacement does not matter: +1, -1, or 0
  // if that does not tell.
  int covers_roughly() const {
    CGAL::Protect_FPU_rounding<true> upwards;
    using T = Interval;
    const Plane<T> plane = n.plane<T>(f);
    const Point<T> A = n.point<T>(a), B = n.point<T>(b);
    T ha = plane.height(A), hb = plane.height(B);
    const int sa = certain_sign(ha), sb = certain_sign(hb);
    if (!sa || !sb)
      return 0;
    ha = sa > 0 ? ha : -ha;
    hb = sb > 0 ? hb : -hb;
    const Point<T> X = {hb * A.p + ha * B.p, hb * A.d + ha * B.d,
                        hb * A.w + ha * B.w};
    const hsr_world *w = n.sight->world;
    bool inside = false;
    Point<T> P = n.point<T>(w->vertex[w->start[f + 1] - 1]);
    int row_p = certain_sign(row_value(n, X, P, VALUE));
    for (uint32_t k = w->start[f]; k < w->start[f + 1]; k++) {
      const Point<T> Q = n.point<T>(w->vertex[k]);
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

// Whether an event is where the edge is ahead.
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
  *event = hsr_sight_event{0, 0, HSR_AT_PLANE, f, b_behind ? 1 : -1};
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

// --- Any face, by the definition
// ------------------------------------------------------

namespace {

// P(t) of an edge, t = from / (from - to), as a point.
template <class T>
Point<T> point_at(const Numbers &n, uint32_t e, const T &numerator,
                  const T &denominator) {
  const Point<T> A = n.point<T>(n.sight->edges->a[e]);
  const Point<T> B = n.point<T>(n.sight->edges->b[e]);
  const T one_less = denominator - numerator;
  return with_depth<T>(n.eye<T>(),
                       (one_less * B.d) * A.p + (numerator * A.d) * B.p,
                       denominator * A.d * B.d);
}

// Whether face f hides P(t), t a double or a quotient, and P ahead.
class At_point {
public:
  At_point(const Numbers &n, uint32_t e, uint32_t f, double t)
      : n_(n), e_(e), f_(f), t_(t), is_double_(true) {}
  At_point(const Numbers &n, uint32_t e, uint32_t f, const Exact &numerator,
           const Exact &denominator)
      : n_(n), e_(e), f_(f), t_(0), is_double_(false), numerator_(numerator),
        denominator_(denominator) {}

  bool hides() const {
    if (!is_before())
      return false;
    return has_odd_parity(
        n_.sight->world, f_, [this](uint32_t q) { return row(q); },
        [this](uint32_t c, uint32_t d) { return side(c, d); });
  }

private:
  const Numbers &n_;
  uint32_t e_, f_;
  double t_;
  bool is_double_;
  Exact numerator_, denominator_;

  template <class T> Point<T> point() const {
    if (is_double_)
      return point_at<T>(n_, e_, T(t_), T(1));
    T numerator, denominator;
    convert(numerator_, numerator);
    convert(denominator_, denominator);
    return point_at<T>(n_, e_, numerator, denominator);
  }

  int row(uint32_t q) const {
    const int sign = displaced_sign(n_, HSR_ASK_ROW, [&](auto t, int along) {
      using T = decltype(t);
      return row_value(n_, point<T>(), n_.point<T>(q), along);
    });
    return sign ? sign : 1;
  }

  int side(uint32_t c, uint32_t d) const {
    return displaced_sign(n_, HSR_ASK_EDGE, [&](auto t, int along) {
      using T = decltype(t);
      const Point<T> P = point<T>();
      return side_value(n_, n_.point<T>(c), n_.point<T>(d), P, P.w, along);
    });
  }

  // near < t < w on the plane: N . D and c agree in sign, c - near N . D and c
  // do, and P' is behind.
  bool is_before() const {
    const int c = -n_.sight->facing[f_];
    const int slope =
        displaced_sign(n_, HSR_ASK_FACING, [&](auto t, int along) {
          using T = decltype(t);
          const Point<T> P = point<T>();
          const vec<T> kN = n_.plane<T>(f_).kN;
          return along == VALUE ? dot(kN, P.p)
                                : P.w * dot(kN, change<T>(n_, along));
        });
    if (slope != c)
      return false;
    const int past = displaced_sign(n_, HSR_ASK_NEAR, [&](auto t, int along) {
      using T = decltype(t);
      const Point<T> P = point<T>();
      const Eye<T> &eye = n_.eye<T>();
      const Plane<T> plane = n_.plane<T>(f_);
      const T near = eye.near * eye.scale;
      if (along == VALUE)
        return plane.c * P.w - near * dot(plane.kN, P.p);
      return -(near * P.w * dot(plane.kN, change<T>(n_, along)));
    });
    if (past != c)
      return false;
    return displaced_sign(n_, HSR_ASK_DEPTH, [&](auto t, int along) {
             using T = decltype(t);
             const Point<T> P = point<T>();
             return height_value(n_, n_.plane<T>(f_), P, P.w, along);
           }) == c;
  }
};

// Whether face f hides e between two of its places that follow one another.
bool hides_between(const Numbers &n, uint32_t e, uint32_t f,
                   const hsr_sight_event &from, const hsr_sight_event &to) {
  const double middle = from.t + (to.t - from.t) / 2;
  if (from.t + from.error < middle && middle < to.t - to.error)
    return At_point(n, e, f, middle).hides();
  const Place<Exact> p = place_of<Exact>(n, e, from);
  const Place<Exact> q = place_of<Exact>(n, e, to);
  Exact pd = p.from - p.to, qd = q.from - q.to, pn = p.from, qn = q.from;
  if (CGAL::sign(pd) < 0) {
    pd = -pd;
    pn = -pn;
  }
  if (CGAL::sign(qd) < 0) {
    qd = -qd;
    qn = -qn;
  }
  return At_point(n, e, f, pn * qd + qn * pd, Exact(2) * pd * qd).hides();
}

// The places where the hiding of e by f may change, between the ends of where e
// is ahead, these included; in order.
class Places {
public:
  Places(const Numbers &n, uint32_t e, uint32_t f) : n_(n), e_(e) {
    const hsr_sight *s = n.sight;
    const uint32_t a = s->edges->a[e], b = s->edges->b[e];
    places.push_back(s->ahead[a] ? hsr_sight_event{0, 0, HSR_AT_START, 0, 0}
                                 : near_border());
    end_ =
        s->ahead[b] ? hsr_sight_event{1, 0, HSR_AT_END, 0, 0} : near_border();
    for (uint32_t k = s->world->start[f]; k < s->world->start[f + 1]; k++) {
      add(HSR_AT_SIDE, k);
      // A side that passes through the eye is no side, but its ends are where
      // parity changes, since one is counted without the other.
      if (!has_image(s, side_begins(s->world, k), s->world->vertex[k])) {
        add(HSR_AT_ROW, side_begins(s->world, k));
        add(HSR_AT_ROW, s->world->vertex[k]);
      }
    }
    add(HSR_AT_PLANE, f);
    if (s->view->near > 0)
      add(HSR_AT_NEAR, f);
    places.push_back(end_);
    std::sort(places.begin(), places.end(), [&](const auto &x, const auto &y) {
      return hsr_sight_compare(s, e, &x, &y) < 0;
    });
  }

  std::vector<hsr_sight_event> places;

private:
  const Numbers &n_;
  uint32_t e_;
  hsr_sight_event end_;

  hsr_sight_event near_border() const {
    hsr_sight_event event = {0, 0, HSR_AT_BORDER, NEAR, 0};
    hsr_sight_locate(n_.sight, e_, &event);
    return event;
  }

  void add(enum hsr_event_at at, uint32_t subject) {
    hsr_sight_event event = {0, 0, at, subject, 0};
    const auto sign_at = [&](bool at_a) {
      return sign_of(n_, HSR_ASK_PLACE, [&](auto t) {
        using T = decltype(t);
        const Place<T> place = place_of<T>(n_, e_, event);
        return at_a ? place.from : place.to;
      });
    };
    if (sign_at(true) * sign_at(false) >= 0)
      return;
    hsr_sight_locate(n_.sight, e_, &event);
    if (hsr_sight_compare(n_.sight, e_, &places[0], &event) < 0 &&
        hsr_sight_compare(n_.sight, e_, &event, &end_) < 0)
      places.push_back(event);
  }
};

} // namespace

enum hsr_status hsr_sight_face(const struct hsr_sight *sight, uint32_t e,
                               uint32_t f, struct hsr_arena *arena,
                               struct hsr_growing *events, bool *hidden) {
  const Numbers &n = *sight->numbers;
  *hidden = false;
  try {
    const std::vector<hsr_sight_event> places = Places(n, e, f).places;
    bool first = true, before = false;
    for (size_t k = 0; k + 1 < places.size(); k++) {
      if (hsr_sight_compare(sight, e, &places[k], &places[k + 1]) == 0)
        continue;
      const bool now = hides_between(n, e, f, places[k], places[k + 1]);
      if (first) {
        *hidden = now;
      } else if (now != before) {
        if (!hsr_arena_grow(arena, events, sizeof places[k]))
          return HSR_E_NOMEM;
        hsr_sight_event &event =
            static_cast<hsr_sight_event *>(events->items)[events->n - 1];
        event = places[k];
        event.change = now ? 1 : -1;
      }
      first = false;
      before = now;
    }
    return sight->tally->out_of_memory ? HSR_E_NOMEM : HSR_OK;
  } catch (...) {
    return HSR_E_NOMEM;
  }
}

bool hsr_sight_in_plane(const struct hsr_sight *sight, uint32_t e, uint32_t f) {
  const Numbers &n = *sight->numbers;
  for (uint32_t p : {sight->edges->a[e], sight->edges->b[e]})
    if (sign_of(n, HSR_ASK_VERTEX, [&](auto t) {
          using T = decltype(t);
          return n.plane<T>(f).height(n.point<T>(p));
        }))
      return false;
  return true;
}

// --- Setting up
// ------------------------------------------------------------------------

static void find_points(hsr_sight *sight) {
  const Numbers &n = *sight->numbers;
  for (uint32_t p = 0; p < sight->edges->n_points; p++)
    sight->ahead[p] = border_sign(n, NEAR, p) > 0;
}

static void find_faces(hsr_sight *sight) {
  const Numbers &n = *sight->numbers;
  const hsr_world *w = sight->world;
  for (uint32_t f = 0; f < w->n_faces; f++) {
    int facing = facing_sign(n, f);
    sight->exists[f] = facing > 0 || !w->one_sided[f];
    if (!sight->exists[f])
      facing = 0;
    sight->facing[f] = static_cast<signed char>(facing);
    bool regular = facing && sight->edges->simple[f];
    for (uint32_t k = w->start[f]; regular && k < w->start[f + 1]; k++)
      regular = sight->ahead[w->vertex[k]];
    sight->regular[f] = regular;
    if (regular)
      sight->faces[sight->n_faces++] = f;
    else if (facing)
      sight->loose[sight->n_loose++] = f;
  }
}

static hsr_status make_arrays(hsr_sight *sight, hsr_arena *arena) {
  const size_t np = sight->edges->n_points, nf = sight->world->n_faces;
  const auto array = [&](size_t n, size_t size) {
    return hsr_arena_array(arena, n, size);
  };
  sight->sx = static_cast<double *>(array(np, sizeof(double)));
  sight->sy = static_cast<double *>(array(np, sizeof(double)));
  sight->ahead = static_cast<bool *>(array(np, sizeof(bool)));
  sight->exists = static_cast<bool *>(array(nf, sizeof(bool)));
  sight->facing = static_cast<signed char *>(array(nf, 1));
  sight->regular = static_cast<bool *>(array(nf, sizeof(bool)));
  sight->faces = static_cast<uint32_t *>(array(nf, sizeof(uint32_t)));
  sight->loose = static_cast<uint32_t *>(array(nf, sizeof(uint32_t)));
  return sight->sx && sight->sy && sight->ahead && sight->exists &&
                 sight->facing && sight->regular && sight->faces && sight->loose
             ? HSR_OK
             : HSR_E_NOMEM;
}

enum hsr_status hsr_sight_init(struct hsr_sight *sight,
                               const struct hsr_edges *edges,
                               const struct hsr_view *view,
                               struct hsr_arena *arena,
                               struct hsr_tally *tally) {
  *sight = hsr_sight();
  sight->edges = edges;
  sight->world = edges->world;
  sight->view = view;
  sight->tally = tally;
  hsr_screen screen;
  if (make_arrays(sight, arena) ||
      hsr_screen_init(&screen, edges->world, view, arena))
    return HSR_E_NOMEM;
  hsr_screen_vertices(&screen);
  std::copy(screen.sx, screen.sx + edges->world->n_vertices, sight->sx);
  std::copy(screen.sy, screen.sy + edges->world->n_vertices, sight->sy);
  for (uint32_t p = edges->world->n_vertices; p < edges->n_points; p++)
    sight->sx[p] = sight->sy[p] = NAN;
  try {
    sight->numbers = new hsr_sight_numbers{sight, {}, {}};
    Numbers &n = *sight->numbers;
    const int s = CGAL::sign(
        det(lift<Exact>(view->F), lift<Exact>(view->R), lift<Exact>(view->U)));
    n.exact.set(*view, s);
    {
      CGAL::Protect_FPU_rounding<true> upwards;
      n.rough.set(*view, s);
    }
  } catch (...) {
    return HSR_E_NOMEM;
  }
  find_points(sight);
  find_faces(sight);
  return tally->out_of_memory ? HSR_E_NOMEM : HSR_OK;
}

void hsr_sight_free(struct hsr_sight *sight) {
  delete sight->numbers;
  sight->numbers = nullptr;
}
