// SPDX-License-Identifier: GPL-3.0-or-later
// The exact arithmetic behind common/lines/sight/sight.h, over CGAL's number
// types. For the core's own C++ files.
//
// Notation    a point P is (p, d) with P - E = p / d and d > 0, so that ends of
//             implied edges need no division. w(p) is its depth times d and a
//             positive constant. v = e R - e^2 U is the displacement of a
//             direction, with e infinitesimal. A displaced point is p' = p +
//             w(p) v.
// Parallel    the eye is at infinity. A projective transformation takes it to
//             the origin and leaves the screen as it is: a point t F + x R + y
//             U becomes p = F + x R + y U with d = -t. So w is the same for all
//             points, and d is the negative depth. In perspective d is positive
//             and w has any sign; here w is positive and d has any sign. So two
//             things differ below: the test against near, and the weights of
//             points in an average.
// Method      every question but one is the sign of a function that is linear
//             in v. (The exception is whether a face covers the place where an
//             edge pierces its plane.) The sign is that of the function's
//             value. If that is zero, it is the sign of the change along R; if
//             that is zero too, of the change along -U. Each of these is a
//             polynomial in the input doubles. It is evaluated in intervals
//             and, if the interval holds zero, in exact numbers.
#ifndef HSR_COMMON_SIGHT_NUMBERS_H
#define HSR_COMMON_SIGHT_NUMBERS_H

#include "common/lines/exact_points.h"
#include "common/lines/sight/sight.h"

#include <algorithm>
#include <memory>
#include <type_traits>
#include <vector>

namespace hsr {
namespace sight {

// Vectors of three numbers of type T, with their usual operations.
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

// A point as (p, d), and w(p).
template <class T> struct Point {
  vec<T> p;
  T d, w;
};

// A plane. kN . p - c d is positive in front of it, and -c at the eye.
template <class T> struct Plane {
  vec<T> kN;
  T c;
  T height(const Point<T> &P) const { return dot(kN, P.p) - c * P.d; }
};

// The eye. W . p is w(p), X . p is x w and Y . p is y w, each times the same
// positive factor; `scale` is W . F.
template <class T> struct Eye {
  vec<T> E, F, R, U, W, X, Y;
  T scale, near;
  bool parallel;

  // s is the sign of det(R, U, F).
  void set(const hsr_view &view, int s) {
    const T sign = T(double(s));
    parallel = view.parallel;
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

  Point<T> point(const vec<T> &p, const T &d) const {
    return {p, d, dot(W, p)};
  }

  // The point P of the world with P - E = v / d, and the plane whose value at a
  // point P of the world is kN . (P - E) - c.
  Point<T> seen_point(const vec<T> &v, const T &d) const {
    if (!parallel)
      return point(v, d);
    const T t = dot(W, v); // times scale
    return point(scale * v + (d * scale - t) * F, -t);
  }
  Plane<T> seen_plane(const vec<T> &kN, const T &c) const {
    if (!parallel)
      return {kN, c};
    const T along = dot(kN, F);
    return {scale * kN - (along + c) * W, scale * along};
  }

  // The denominator of a point, times a positive factor that all points share.
  const T &weight(const Point<T> &P) const { return parallel ? P.w : P.d; }

  // Numbers with the sign of t - near at a point; and, times the sign of c, at
  // the place where the ray of p meets a plane. w is w(p).
  T past_near(const Point<T> &P) const {
    return parallel ? -(scale * P.d) - near * P.w : P.w - near * scale * P.d;
  }
  T past_near(const Plane<T> &plane, const vec<T> &p, const T &w) const {
    const T slope = scale * dot(plane.kN, p);
    return parallel ? -slope - near * (plane.c * w)
                    : plane.c * w - near * slope;
  }
};

// The exact services' data of one view.
struct Numbers {
  const hsr_sight *sight;
  Eye<Interval> rough;
  Eye<Exact> exact;

  // The eye, point p and the plane of face f, in intervals or in exact numbers.
  template <class T> const Eye<T> &eye() const;
  template <class T> Point<T> point(uint32_t p) const {
    if constexpr (std::is_same<T, Exact>::value)
      return exact_point.get(p, [&] { return found_point<T>(p); });
    else
      return rough_point[p];
  }
  template <class T> Plane<T> plane(uint32_t f) const {
    if constexpr (std::is_same<T, Exact>::value)
      return exact_plane.get(f, [&] { return found_plane<T>(f); });
    else
      return rough_plane[f];
  }

  // Finds the intervals of all points and planes.
  void find_rough() {
    CGAL::Protect_FPU_rounding<true> upwards;
    rough_point.reserve(sight->edges->n_points);
    for (uint32_t p = 0; p < sight->edges->n_points; p++)
      rough_point.push_back(found_point<Interval>(p));
    rough_plane.reserve(sight->world->n_faces);
    for (uint32_t f = 0; f < sight->world->n_faces; f++)
      rough_plane.push_back(found_plane<Interval>(f));
  }

private:
  // A cache of N items by their numbers. Of numbers that are equal modulo N,
  // the one that was asked for last is kept. Exact points and planes take long
  // to compute if coordinates have very different scales, since an exact number
  // has all digits from its first to its last.
  template <class Item> class Kept {
  public:
    template <class Find> Item get(uint32_t number, const Find &find) const {
      Place &place = places_[number % N];
      if (!place.item || place.number != number) {
        place.item.reset(new Item(find()));
        place.number = number;
      }
      return *place.item;
    }

  private:
    enum { N = 64 };
    struct Place {
      uint32_t number;
      std::unique_ptr<const Item> item;
    };
    mutable std::vector<Place> places_ = std::vector<Place>(N);
  };
  Kept<Point<Exact>> exact_point;
  Kept<Plane<Exact>> exact_plane;
  std::vector<Point<Interval>> rough_point;
  std::vector<Plane<Interval>> rough_plane;

  template <class T> Point<T> found_point(uint32_t p) const;
  template <class T> Plane<T> found_plane(uint32_t f) const;
};

template <> inline const Eye<Interval> &Numbers::eye<Interval>() const {
  return rough;
}
template <> inline const Eye<Exact> &Numbers::eye<Exact>() const {
  return exact;
}

// Point n_vertices + k, which is not a vertex.
template <class T>
const auto &given_point(const hsr_exact_points &given, uint32_t k) {
  if constexpr (std::is_same<T, Exact>::value)
    return given.points[k];
  else
    return given.rough[k];
}

template <class T> Point<T> Numbers::found_point(uint32_t p) const {
  const hsr_world *w = sight->world;
  if (p < w->mesh.n_vertices) {
    const double v[3] = {w->mesh.x[p], w->mesh.y[p], w->mesh.z[p]};
    return eye<T>().seen_point(lift<T>(v) - eye<T>().E, T(1));
  }
  const auto &from =
      given_point<T>(*sight->edges->exact, p - w->mesh.n_vertices);
  const vec<T> at = {from.at[0], from.at[1], from.at[2]};
  const T &d = from.denominator;
  return eye<T>().seen_point(at - d * eye<T>().E, d);
}

template <class T> Plane<T> Numbers::found_plane(uint32_t f) const {
  const hsr::FacePlane<T> plane(sight->world, f);
  const vec<T> kN = {plane.k * plane.normal[0], plane.k * plane.normal[1],
                     plane.k * plane.normal[2]};
  return eye<T>().seen_plane(kN, plane.offset - dot(kN, eye<T>().E));
}

// --- Signs -----------------------------------------------------------------

enum { VALUE, ALONG_R, ALONG_MINUS_U };

inline int certain_sign(const Interval &number) {
  return number.inf() > 0 ? 1 : number.sup() < 0 ? -1 : 0;
}
inline int certain_sign(const Exact &number) {
  return CGAL::sign(number);
}

// The direction of a change: R or -U.
template <class T> vec<T> change(const Numbers &n, int along) {
  const Eye<T> &eye = n.eye<T>();
  return along == ALONG_R ? eye.R : vec<T>{-eye.U.x, -eye.U.y, -eye.U.z};
}

inline void count_exact(const Numbers &n, enum hsr_question question) {
  n.sight->tally->exact[question]++;
}

// Returns the sign of value(T(), along), a function that is linear in the
// displacement. `along` is VALUE for its value, or else asks for its change. 0
// if the value and both changes are zero.
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
    for (int along : {VALUE, ALONG_R, ALONG_MINUS_U}) {
      if (along != VALUE) {
        CGAL::Protect_FPU_rounding<true> upwards;
        if (const int sign = certain_sign(value(Interval(), along)))
          return sign;
      }
      if (const int sign = certain_sign(value(Exact(), along)))
        return sign;
    }
    return 0;
  } catch (...) {
    n.sight->tally->out_of_memory = true;
    return 1;
  }
}

// Returns the sign of value(T()), which does not depend on the displacement.
template <class Value>
int sign_of(const Numbers &n, enum hsr_question question,
            const Value &value) noexcept {
  return displaced_sign(n, question, [&](auto t, int along) {
    using T = decltype(t);
    return along == VALUE ? value(t) : T(0);
  });
}

// det(c, d, p'), or its change. w is w(p), or that of the end from which p is
// found.
template <class T>
T side_value(const Numbers &n, const Point<T> &c, const Point<T> &d,
             const Point<T> &p, const T &w, int along) {
  if (along == VALUE)
    return det(c.p, d.p, p.p);
  return w * det(c.p, d.p, change<T>(n, along));
}

// The height of p' over a plane, or its change.
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

// The sign of the height of the displaced point p over the plane of face f.
inline int height_sign(const Numbers &n, uint32_t f, uint32_t p) {
  return displaced_sign(n, HSR_ASK_VERTEX, [&](auto t, int along) {
    using T = decltype(t);
    const Point<T> P = n.point<T>(p);
    return height_value(n, n.plane<T>(f), P, P.w, along);
  });
}

// The side of the plane of face f that point p, not displaced, is on, as far as
// it is certain without exact numbers; else 0.
inline int certain_side(const Numbers &n, uint32_t f, uint32_t p) {
  const hsr_world *w = n.sight->world;
  if (p < w->mesh.n_vertices)
    if (const int side = hsr::rough_side(w, f, p))
      return side;
  CGAL::Protect_FPU_rounding<true> upwards;
  return certain_sign(n.plane<Interval>(f).height(n.point<Interval>(p)));
}

// The same, by exact numbers where needed.
inline int plane_sign(const Numbers &n, uint32_t f, uint32_t p) {
  const hsr_world *w = n.sight->world;
  if (p < w->mesh.n_vertices) {
    if (const int side = hsr::rough_side(w, f, p))
      return side;
    if (hsr_on_plane(w, f, p))
      return 0;
  }
  return sign_of(n, HSR_ASK_VERTEX, [&](auto t) {
    using T = decltype(t);
    return n.plane<T>(f).height(n.point<T>(p));
  });
}

// +1 if the eye is in front of the plane of face f, -1 behind, 0 on it.
inline int facing_sign(const Numbers &n, uint32_t f) {
  return -sign_of(n, HSR_ASK_FACING, [&](auto t) {
    using T = decltype(t);
    return n.plane<T>(f).c;
  });
}

// --- Faces and edges ---------------------------------------------------------

// Whether face f covers a direction D: an odd number of its sides cross to the
// right. row(q) is the sign of det(D, R, q); side(c, d) is that of det(c, d,
// D).
template <class Row, class Side>
bool has_odd_parity(const hsr_world *w, uint32_t f, const Row &row,
                    const Side &side) {
  bool odd = false;
  uint32_t p = w->mesh.vertex[w->mesh.start[f + 1] - 1];
  int row_p = row(p);
  for (uint32_t k = w->mesh.start[f]; k < w->mesh.start[f + 1]; k++) {
    const uint32_t q = w->mesh.vertex[k];
    const int row_q = row(q);
    if (row_p != row_q)
      odd ^= side(p, q) == -row_p;
    p = q;
    row_p = row_q;
  }
  return odd;
}

// Whether the line through a and b has an image, which it has unless it passes
// through the eye.
inline bool has_image(const Numbers &n, uint32_t a, uint32_t b) {
  const hsr_sight *sight = n.sight;
  const double dx = sight->sx[a] - sight->sx[b];
  const double dy = sight->sy[a] - sight->sy[b];
  if (std::fabs(dx) > 4 * HSR_DELTA || std::fabs(dy) > 4 * HSR_DELTA)
    return true;
  try {
    const vec<Exact> normal = cross(n.point<Exact>(a).p, n.point<Exact>(b).p);
    return CGAL::sign(normal.x) || CGAL::sign(normal.y) || CGAL::sign(normal.z);
  } catch (...) {
    sight->tally->out_of_memory = true;
    return false;
  }
}

// --- Places of events --------------------------------------------------------

// The borders of the visible space: the subjects of HSR_AT_BORDER.
enum { NEAR, LEFT, RIGHT, BOTTOM, TOP, N_BORDERS };

// A number that is positive if P is inside the border.
template <class T>
T border_value(const Eye<T> &eye, uint32_t border, const Point<T> &P) {
  switch (border) {
  case NEAR:
    return eye.past_near(P);
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

// The vertex at which the edge of a face begins that ends in corner k.
inline uint32_t side_begins(const hsr_world *w, uint32_t k) {
  // The face of the corner: the last that starts at or before it.
  const uint32_t *face =
      std::upper_bound(w->mesh.start, w->mesh.start + w->n_faces + 1, k) - 1;
  return w->mesh.vertex[k == face[0] ? face[1] - 1 : k - 1];
}

// The normal of the plane through the eye and a line. For two planes it follows
// from the eye's height over each, which is -c.
template <class T>
vec<T> normal_of_image(const Numbers &n, const hsr_sight_line &line) {
  if (!line.of_planes)
    return cross(n.point<T>(line.a).p, n.point<T>(line.b).p);
  const Plane<T> a = n.plane<T>(line.a), b = n.plane<T>(line.b);
  return b.c * a.kN - a.c * b.kN;
}

// The place of an event is t = from / (from - to). `from` and `to` are the
// values of a function at the two ends of the edge. The function is zero at the
// event.
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
  if (event.at == HSR_AT_LINE) {
    const vec<T> normal = normal_of_image<T>(n, s->line[event.subject]);
    from = dot(normal, A.p);
    to = dot(normal, B.p);
  } else if (event.at == HSR_AT_EDGE || event.at == HSR_AT_SIDE) {
    const bool is_edge = event.at == HSR_AT_EDGE;
    const uint32_t c = is_edge ? edges->a[event.subject]
                               : side_begins(s->world, event.subject);
    const uint32_t d = is_edge ? edges->b[event.subject]
                               : s->world->mesh.vertex[event.subject];
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
      from = eye.past_near(plane, A.p, A.w);
      to = eye.past_near(plane, B.p, B.w);
    }
  }
  return {from * n.eye<T>().weight(B), to * n.eye<T>().weight(A)};
}

// An interval that holds the place.
inline Interval rough_place(const Numbers &n, uint32_t e,
                            const hsr_sight_event &event) {
  CGAL::Protect_FPU_rounding<true> upwards;
  const Place<Interval> place = place_of<Interval>(n, e, event);
  return place.from / (place.from - place.to);
}

inline int border_sign(const Numbers &n, uint32_t border, uint32_t p) {
  return sign_of(n, HSR_ASK_EDGE, [&](auto t) {
    using T = decltype(t);
    return border_value(n.eye<T>(), border, n.point<T>(p));
  });
}

} // namespace sight
} // namespace hsr

struct hsr_sight_numbers : hsr::sight::Numbers {};

#endif
