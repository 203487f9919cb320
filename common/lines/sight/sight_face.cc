// SPDX-License-Identifier: GPL-3.0-or-later
// Whether any face hides an edge, by the definition: for faces that are not
// regular, and for those in whose plane the edge lies.
//
// Method      Whether one face hides the edge changes at few places, each the
//             root of a linear function along the edge. Between two successive
//             places it is the same as at any point between them.
// Apart       A face hides nothing outside the hull of its corners' images.
//             Let a line have no corner of the face on its positive side, and
//             let the edge be there but for an end that is a corner. (Or let
//             the edge be on the line, and of the corners at most one, which is
//             an end of the edge.) Then the hull holds no point of the edge
//             between its ends. It is closed, so it holds no displaced point
//             either. Most faces near an edge are its neighbours, for which
//             this is certain in doubles.
#include "common/lines/sight/sight_numbers.h"

#include <algorithm>
#include <vector>

using namespace hsr::sight;
using hsr::Exact;
using hsr::Interval;

namespace {

// --- Apart -------------------------------------------------------------------

// The side of the line from c to d on which p lies, if doubles make it certain;
// else 0. All three are ahead.
int rough_turn(const hsr_sight *sight, uint32_t c, uint32_t d, uint32_t p) {
  double bound;
  const double turn = hsr_sight_turn(sight, c, d, p, &bound);
  return turn > bound ? 1 : turn < -bound ? -1 : 0;
}

// The side of the line from c to d on which all the points certainly lie but
// those that are c or d. 0 if there is no such side, or no such point.
int common_side(const hsr_sight *sight, uint32_t c, uint32_t d,
                const uint32_t *point, uint32_t n) {
  int side = 0;
  for (uint32_t k = 0; k < n; k++) {
    if (point[k] == c || point[k] == d)
      continue;
    const int one = rough_turn(sight, c, d, point[k]);
    if (!one || one == -side)
      return 0;
    side = one;
  }
  return side;
}

bool are_apart(const hsr_sight *sight, uint32_t e, uint32_t f) {
  const hsr_mesh &mesh = sight->world->mesh;
  const uint32_t ends[2] = {sight->edges->a[e], sight->edges->b[e]};
  const uint32_t *corner = mesh.vertex + mesh.start[f];
  const uint32_t n = hsr_face_size(sight->world, f);
  const auto is_ahead = [&](uint32_t p) { return sight->ahead[p]; };
  if (!std::all_of(ends, ends + 2, is_ahead) ||
      !std::all_of(corner, corner + n, is_ahead))
    return false;
  const auto has = [&](uint32_t p) {
    return std::find(corner, corner + n, p) != corner + n;
  };
  if (!(has(ends[0]) && has(ends[1])) &&
      common_side(sight, ends[0], ends[1], corner, n))
    return true;
  for (uint32_t k = 0, l = n - 1; k < n; l = k++) {
    const int side = common_side(sight, corner[l], corner[k], ends, 2);
    if (side && common_side(sight, corner[l], corner[k], corner, n) == -side)
      return true;
  }
  return false;
}

// --- At a point --------------------------------------------------------------

// P(t) of an edge, t = from / (from - to), as a point.
template <class T>
Point<T> point_at(const Numbers &n, uint32_t e, const T &numerator,
                  const T &denominator) {
  const Point<T> A = n.point<T>(n.sight->edges->a[e]);
  const Point<T> B = n.point<T>(n.sight->edges->b[e]);
  const Eye<T> &eye = n.eye<T>();
  const T of_a = (denominator - numerator) * eye.weight(B);
  const T of_b = numerator * eye.weight(A);
  return eye.point(of_a * A.p + of_b * B.p, of_a * A.d + of_b * B.d);
}

// Whether face f hides P(t), which is ahead; t is a double or a quotient.
class At_point {
public:
  At_point(const Numbers &n, uint32_t e, uint32_t f, double t)
      : n_(n), e_(e), f_(f), exact_{Exact(t), Exact(1)} {
    set_rough(t, 1);
  }
  At_point(const Numbers &n, uint32_t e, uint32_t f, const Exact &numerator,
           const Exact &denominator)
      : n_(n), e_(e), f_(f), exact_{numerator, denominator} {
    set_rough(hsr::interval_of(numerator), hsr::interval_of(denominator));
  }

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

  struct {
    Exact numerator, denominator;
  } exact_;
  Point<Interval> rough_;

  void set_rough(const Interval &numerator, const Interval &denominator) {
    CGAL::Protect_FPU_rounding<true> upwards;
    rough_ = point_at(n_, e_, numerator, denominator);
  }
  template <class T> Point<T> point() const {
    if constexpr (std::is_same<T, Exact>::value)
      return point_at(n_, e_, exact_.numerator, exact_.denominator);
    else
      return rough_;
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

  // Whether near < t < w on the plane: N . D and c have the same sign, so have
  // c - near N . D and c, and P' is behind the plane. In parallel nothing is
  // behind the eye.
  bool is_before() const {
    const int c = -n_.sight->facing[f_];
    const int slope =
        n_.sight->view->parallel
            ? c
            : displaced_sign(n_, HSR_ASK_FACING, [&](auto t, int along) {
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
      if (along == VALUE)
        return eye.past_near(plane, P.p, P.w);
      return P.w * eye.past_near(plane, change<T>(n_, along), T(0));
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

// Whether face f hides e between two successive places.
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

// The places where it may change whether f hides e, in order. They are in the
// part of e that is ahead, and include its ends.
class Places {
public:
  Places(const Numbers &n, uint32_t e, uint32_t f) : n_(n), e_(e) {
    const hsr_sight *s = n.sight;
    const uint32_t a = s->edges->a[e], b = s->edges->b[e];
    places.push_back(s->ahead[a] ? hsr_sight_event{0, 0, HSR_AT_START, 0, 0}
                                 : near_border());
    end_ =
        s->ahead[b] ? hsr_sight_event{1, 0, HSR_AT_END, 0, 0} : near_border();
    for (uint32_t k = s->world->mesh.start[f]; k < s->world->mesh.start[f + 1];
         k++) {
      if (may_cross_side(k))
        add(HSR_AT_SIDE, k);
      // The line of this side passes through the eye, so the side itself does
      // not count. Parity may change at its ends, since one may be counted
      // without the other.
      if (!has_image(n, side_begins(s->world, k), s->world->mesh.vertex[k])) {
        add(HSR_AT_ROW, side_begins(s->world, k));
        add(HSR_AT_ROW, s->world->mesh.vertex[k]);
      }
    }
    add(HSR_AT_PLANE, f);
    if (s->view->near > 0 || s->view->parallel)
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

  // Whether e may cross the image of the side that ends in corner k. It does
  // not if it begins or ends on it, or if doubles show that both of its ends,
  // which are ahead, are on one side.
  bool may_cross_side(uint32_t k) const {
    const hsr_sight *s = n_.sight;
    const uint32_t ends[2] = {s->edges->a[e_], s->edges->b[e_]};
    const uint32_t c = side_begins(s->world, k), d = s->world->mesh.vertex[k];
    for (uint32_t p : ends)
      if (p == c || p == d)
        return false;
    return !(s->ahead[ends[0]] && s->ahead[ends[1]] && s->ahead[c] &&
             s->ahead[d] && common_side(s, c, d, ends, 2));
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

// Whether both ends of e are certainly before the plane of face f.
bool lies_before(const hsr_sight *sight, uint32_t e, uint32_t f) {
  for (uint32_t p : {sight->edges->a[e], sight->edges->b[e]})
    if (certain_side(*sight->numbers, f, p) != sight->facing[f])
      return false;
  return true;
}

} // namespace

enum hsr_status hsr_sight_face(const struct hsr_sight *sight, uint32_t e,
                               uint32_t f, struct hsr_arena *arena,
                               struct hsr_growing *events, bool *hidden) {
  const Numbers &n = *sight->numbers;
  *hidden = false;
  if (are_apart(sight, e, f) || lies_before(sight, e, f))
    return HSR_OK;
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
        event.face = f;
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
    if (plane_sign(n, f, p))
      return false;
  return true;
}
