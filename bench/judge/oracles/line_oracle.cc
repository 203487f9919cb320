/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The line oracle: the right drawing, from the definition alone.
 *
 * Source      docs/correct-drawing.md and docs/correct-picture.md, in whose
 *             words this file is written.
 * Input       the world's vertices, face lists and one_sided flags, and the
 *             view's E, F, R, U and near; neither the world's approximate
 *             planes nor the view's matrices. The judge shares no code with
 *             whom it judges, nor with the other judge, oracle.cc.
 * Notation    as there; u = P(t) - E, so that u = w D, and a determinant that
 *             has D for a factor has the sign it has with u, w being positive.
 *             In parallel projection u = w F + xR + yU; the ray of P(t) starts
 *             at u - w F.
 * Method      every edge against every face. What decides whether the face
 *             hides P(t) are signs of forms n·u + d, linear in t. Where on the
 *             edge they change is computed; in each gap between the changes one
 *             point is put to the definition. The changes of all faces, sorted,
 *             give the invisibility.
 *             Numbers are intervals first; where these leave open which sign
 *             or which of two places is first, rational.
 * Invariants  a face is passed over only if it hides nothing of the edge:
 *             may_hide() and is_beside() have the proofs. A side of a broad face
 *             is passed over only if it does not matter: `broad` has the proof.
 * Ties        a form that is zero at P(t) has the sign of its derivative along
 *             R, and if that is zero, along -U. t and w stay as they are.
 * Departures  none: there is no paper.
 * Cost        five comparisons for every edge and every face in the cells of the
 *             screen that the edge's box meets; some hundred operations where
 *             boxes overlap, and of a broad face some dozens for each side that
 *             is by the edge in a row. Rational numbers where edges meet by place, not by
 *             vertex number, and where a vertex lies in the plane of a face
 *             that it is not of.
 *
 * Compile with -frounding-math; or, slower, but regardless of rounding modes
 * (valgrind ignores them), with -DCGAL_ALWAYS_ROUND_TO_NEAREST. */
#include "algorithms/algorithm.h"
#include "bench/judge/rounding.h"
#include "bench/judge/vectors.h"
#include "common/answers/kinds/segments.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <vector>

namespace {

using judge::cross, judge::dot, judge::lift, judge::vec;
using judge::Interval, judge::Nearest, judge::Upward;
using Exact = CGAL::Gmpq;

constexpr double infinity = std::numeric_limits<double>::infinity();

enum { LINE_BOX, LINE_PAIR, LINE_POINT, LINE_EXACT };

/* ---- Numbers and vectors ---- */

constexpr int UNKNOWN = 2;

int sign_of(const Interval &a) {
  return a.inf() > 0 ? 1 : a.sup() < 0 ? -1 : a.is_point() ? 0 : UNKNOWN;
}

int sign_of(const Exact &a) {
  return int(CGAL::sign(a));
}

Interval enclose(const Exact &a) {
  return Interval(CGAL::to_interval(a));
}

vec<Interval> enclose(const vec<Exact> &a) {
  return {enclose(a.x), enclose(a.y), enclose(a.z)};
}

/* Whether a vector is zero, as far as an interval tells. */
template <class T> int is_zero(const vec<T> &a) {
  const int x = sign_of(a.x), y = sign_of(a.y), z = sign_of(a.z);
  for (int s : {x, y, z})
    if (s == 1 || s == -1)
      return false;
  return x == UNKNOWN || y == UNKNOWN || z == UNKNOWN ? UNKNOWN : true;
}

/* ---- Faces ---- */

template <class T> inline vec<T> vertex(const hsr_world &world, uint32_t v) {
  return {T(world.mesh.x[v]), T(world.mesh.y[v]), T(world.mesh.z[v])};
}

/* N·(k P - S) = 0, P and S taken from an origin O: kN·(P - O) = c. */
template <class T> struct plane {
  vec<T> kN;
  T c;
};

template <class T>
plane<T> make_plane(const hsr_world &world, uint32_t f, const vec<T> &O) {
  const uint32_t *v = world.mesh.vertex + world.mesh.start[f];
  const uint32_t k = hsr_face_size(&world, f);
  const vec<T> V0 = vertex<T>(world, v[0]);
  vec<T> b = vertex<T>(world, v[1]) - V0;
  vec<T> N = cross(b, b); /* zero */
  vec<T> S = (V0 - O) + (V0 - O) + b;
  for (uint32_t i = 2; i < k; i++) {
    const vec<T> a = b, V = vertex<T>(world, v[i]);
    b = V - V0;
    N = i == 2 ? cross(a, b) : N + cross(a, b);
    S = S + (V - O);
  }
  return {T(double(k)) * N, dot(N, S)};
}

/* Whether all vertices of a face lie in its plane, as far as T tells. */
template <class T> int is_flat(const hsr_world &world, uint32_t f) {
  const uint32_t *v = world.mesh.vertex + world.mesh.start[f];
  const uint32_t k = hsr_face_size(&world, f);
  const vec<T> O = vertex<T>(world, v[0]);
  const plane<T> p = make_plane<T>(world, f, O);
  int all = true;
  for (uint32_t i = 0; i < k; i++) {
    const int sign = sign_of(dot(p.kN, vertex<T>(world, v[i]) - O) - p.c);
    if (sign == 1 || sign == -1)
      return false;
    if (sign == UNKNOWN)
      all = UNKNOWN;
  }
  return all;
}

bool decide_flat(const hsr_world &world, uint32_t f) {
  if (hsr_face_size(&world, f) == 3)
    return true;
  const int guess = is_flat<Interval>(world, f);
  if (guess != UNKNOWN)
    return guess;
  const Nearest to_nearest;
  return is_flat<Exact>(world, f);
}

bool has_vertex(const hsr_world &world, uint32_t f, uint32_t v) {
  const uint32_t *begin = world.mesh.vertex + world.mesh.start[f];
  const uint32_t *end = world.mesh.vertex + world.mesh.start[f + 1];
  return std::find(begin, end, v) != end;
}

/* ---- Edges ---- */

/* A face and one of its sides, a < b. */
struct side {
  uint32_t a, b, face;
};

/* A stretch in which two faces penetrate. */
struct stretch {
  hsr_edge_name name;
  vec<Exact> end[2];
};

/* What does not depend on the view. */
struct shape {
  std::vector<char> flat;       /* a face */
  std::vector<side> sides;      /* ascending */
  std::vector<stretch> implied; /* in the order of edges */
};

/* A side that a face has twice is a bridge to a hole. The face lies on both sides
 * of it, so it is no border of the face. */
void leave_out_bridges(std::vector<side> *sides) {
  const auto same = [](const side &s, const side &t) {
    return s.a == t.a && s.b == t.b && s.face == t.face;
  };
  std::vector<side> kept;
  for (const side &s : *sides)
    if (!kept.empty() && same(kept.back(), s))
      kept.pop_back();
    else
      kept.push_back(s);
  *sides = std::move(kept);
}

void find_sides(const hsr_world &world, shape *made) {
  for (uint32_t f = 0; f < world.n_faces; f++) {
    uint32_t a = world.mesh.vertex[world.mesh.start[f + 1] - 1];
    for (uint32_t c = world.mesh.start[f]; c < world.mesh.start[f + 1]; c++) {
      const uint32_t b = world.mesh.vertex[c];
      made->sides.push_back({std::min(a, b), std::max(a, b), f});
      a = b;
    }
  }
  std::sort(made->sides.begin(), made->sides.end(),
            [](const side &s, const side &t) {
              return std::array<uint32_t, 3>{s.a, s.b, s.face} <
                     std::array<uint32_t, 3>{t.a, t.b, t.face};
            });
  leave_out_bridges(&made->sides);
}

/* ---- Implied edges ---- */

struct box {
  double low[3], high[3];
  uint32_t face;
};

box face_box(const hsr_world &world, uint32_t f) {
  box all = {
      {infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, f};
  for (uint32_t c = world.mesh.start[f]; c < world.mesh.start[f + 1]; c++) {
    const uint32_t v = world.mesh.vertex[c];
    const double p[3] = {world.mesh.x[v], world.mesh.y[v], world.mesh.z[v]};
    for (int axis = 0; axis < 3; axis++) {
      all.low[axis] = std::min(all.low[axis], p[axis]);
      all.high[axis] = std::max(all.high[axis], p[axis]);
    }
  }
  return all;
}

bool overlap(const box &a, const box &b) {
  for (int axis = 0; axis < 3; axis++)
    if (a.high[axis] < b.low[axis] || b.high[axis] < a.low[axis])
      return false;
  return true;
}

/* Whether a flat face has vertices on both sides of another's plane. If it has
 * not, the plane meets it in its border at most. `p` is that plane from the first
 * vertex of g. */
bool is_astride(const hsr_world &world, uint32_t f, uint32_t g,
                const plane<Interval> &p) {
  const uint32_t O = world.mesh.vertex[world.mesh.start[g]];
  const vec<Interval> near_O = vertex<Interval>(world, O);
  std::optional<vec<Exact>> exact_O;
  std::optional<plane<Exact>> q;
  bool before = false, behind = false;
  for (uint32_t c = world.mesh.start[f];
       c < world.mesh.start[f + 1] && !(before && behind); c++) {
    const uint32_t v = world.mesh.vertex[c];
    int sign = sign_of(dot(p.kN, vertex<Interval>(world, v) - near_O) - p.c);
    if (sign == UNKNOWN) {
      if (has_vertex(world, g, v))
        continue;
      const Nearest to_nearest;
      if (!q) {
        exact_O = vertex<Exact>(world, O);
        q = make_plane<Exact>(world, g, *exact_O);
      }
      sign = sign_of(dot(q->kN, vertex<Exact>(world, v) - *exact_O) - q->c);
    }
    before = before || sign > 0;
    behind = behind || sign < 0;
  }
  return before && behind;
}

/* A point of the line of two planes, at s along it. */
struct mark {
  Exact s;
  vec<Exact> at;
};

/* The border of a face, where the other's plane cuts it. */
struct border {
  std::vector<Exact> crossings; /* of sides that lead through the plane, a
                                   vertex in the plane counting as before it */
  std::vector<std::array<Exact, 2>> lying; /* sides that lie in the plane */

  bool is_inside(const Exact &s) const;
};

/* s is nowhere on the border but in a side that lies there. The parity is that
 * of a point next to it on the side of the plane where none is. */
bool border::is_inside(const Exact &s) const {
  for (const auto &l : lying)
    if (std::min(l[0], l[1]) < s && s < std::max(l[0], l[1]))
      return false;
  bool odd = false;
  for (const Exact &c : crossings)
    odd = odd != (c > s);
  return odd;
}

/* Where the border of f meets plane p of the other face; the line runs along
 * `direction`. */
border cut_border(const hsr_world &world, uint32_t f, const plane<Exact> &p,
                  const vec<Exact> &direction, std::vector<mark> *marks) {
  border cut;
  vec<Exact> a =
      vertex<Exact>(world, world.mesh.vertex[world.mesh.start[f + 1] - 1]);
  Exact height_a = dot(p.kN, a) - p.c;
  for (uint32_t c = world.mesh.start[f]; c < world.mesh.start[f + 1]; c++) {
    const vec<Exact> b = vertex<Exact>(world, world.mesh.vertex[c]);
    const Exact height_b = dot(p.kN, b) - p.c;
    const int sign_a = sign_of(height_a), sign_b = sign_of(height_b);
    if (sign_b == 0)
      marks->push_back({dot(direction, b), b});
    if (sign_a == 0 && sign_b == 0)
      cut.lying.push_back({dot(direction, a), dot(direction, b)});
    if ((sign_a >= 0) != (sign_b >= 0)) {
      const Exact part = height_a / (height_a - height_b);
      const vec<Exact> at = a + part * (b - a);
      cut.crossings.push_back(dot(direction, at));
      marks->push_back({cut.crossings.back(), at});
    }
    a = b;
    height_a = height_b;
  }
  return cut;
}

/* The stretches of f < g, both flat and astride each other's plane. */
void penetrate(const hsr_world &world, uint32_t f, uint32_t g, shape *made) {
  const Nearest to_nearest;
  const vec<Exact> origin = {Exact(0), Exact(0), Exact(0)};
  const plane<Exact> p = make_plane<Exact>(world, f, origin);
  const plane<Exact> q = make_plane<Exact>(world, g, origin);
  const vec<Exact> direction = cross(p.kN, q.kN);
  std::vector<mark> marks;
  const border of_f = cut_border(world, f, q, direction, &marks);
  const border of_g = cut_border(world, g, p, direction, &marks);
  std::sort(marks.begin(), marks.end(),
            [](const mark &a, const mark &b) { return a.s < b.s; });
  uint32_t part = 0;
  for (size_t i = 1; i < marks.size(); i++) {
    if (marks[i - 1].s == marks[i].s)
      continue;
    const Exact middle = (marks[i - 1].s + marks[i].s) / Exact(2);
    if (of_f.is_inside(middle) && of_g.is_inside(middle))
      made->implied.push_back(
          {{true, f, g, part++}, {marks[i - 1].at, marks[i].at}});
  }
}

void find_implied(const hsr_world &world, shape *made) {
  std::vector<box> boxes;
  std::vector<plane<Interval>> planes;
  for (uint32_t f = 0; f < world.n_faces; f++) {
    const uint32_t O = world.mesh.vertex[world.mesh.start[f]];
    planes.push_back(make_plane(world, f, vertex<Interval>(world, O)));
    if (made->flat[f])
      boxes.push_back(face_box(world, f));
  }
  std::sort(boxes.begin(), boxes.end(),
            [](const box &a, const box &b) { return a.low[0] < b.low[0]; });
  for (size_t i = 0; i < boxes.size(); i++)
    for (size_t j = i + 1;
         j < boxes.size() && boxes[j].low[0] <= boxes[i].high[0]; j++) {
      if (!overlap(boxes[i], boxes[j]))
        continue;
      uint32_t f = boxes[i].face, g = boxes[j].face;
      if (hsr_face_size(&world, f) > hsr_face_size(&world, g))
        std::swap(f, g); /* few corners first */
      if (is_astride(world, f, g, planes[g]) &&
          is_astride(world, g, f, planes[f]))
        penetrate(world, std::min(f, g), std::max(f, g), made);
    }
  std::sort(made->implied.begin(), made->implied.end(),
            [](const stretch &a, const stretch &b) {
              return hsr_edge_name_compare(&a.name, &b.name) < 0;
            });
}

/* ---- Forms ---- */

/* The frame of the eye; w·u is the depth of u, wx·u and wy·u that times x and
 * y; in parallel x and y themselves. */
template <class T> struct frame {
  bool parallel;
  vec<T> E, F, R, U, w, wx, wy;
  T near;
};

template <class T> frame<T> make_frame(const hsr_view &view) {
  const vec<T> F = lift<T>(view.F), R = lift<T>(view.R), U = lift<T>(view.U);
  const T scale = T(1) / dot(F, cross(R, U));
  return {view.parallel,
          lift<T>(view.E),
          F,
          R,
          U,
          scale * cross(R, U),
          scale * cross(U, F),
          scale * cross(F, R),
          T(view.near)};
}

/* The number n·u + d. */
template <class T> struct form {
  vec<T> n;
  T d;
};

template <class T> T at(const form<T> &l, const vec<T> &u) {
  return dot(l.n, u) + l.d;
}

/* Which form; or, of a place on an edge, where which form is zero. */
enum what : uint32_t {
  START, /* no form: the place t = 0 */
  END,   /* the place t = 1 */
  SIDE,  /* edge(a, b), of vertices a < b */
  ROW,   /* row(a), of a vertex */
  PLANE, /* kN·u - c of face a: of the sign of c where it is hit before P */
  NEAR,  /* w (c - near kN·D), or c (t - near) */
  CLIP_NEAR,
  CLIP_LEFT,
  CLIP_BOTTOM,
  CLIP_RIGHT,
  CLIP_TOP
};

struct recipe {
  what of;
  uint32_t a, b;

  bool operator==(const recipe &other) const {
    return of == other.of && a == other.a && b == other.b;
  }
};

/* ---- The picture ---- */

/* Bounds of x, y and w. */
struct screen_box {
  double left, right, low, high, nearest, farthest;
};

constexpr screen_box empty_image = {infinity,  -infinity, infinity,
                                    -infinity, infinity,  -infinity};
constexpr screen_box whole_screen = {-infinity, infinity,  -infinity,
                                     infinity,  -infinity, infinity};

screen_box hull(const screen_box &a, const screen_box &b) {
  return {std::min(a.left, b.left),       std::max(a.right, b.right),
          std::min(a.low, b.low),         std::max(a.high, b.high),
          std::min(a.nearest, b.nearest), std::max(a.farthest, b.farthest)};
}

/* A face that may hide something: its box, or the whole screen if it reaches
 * from before to behind the eye; it is hit nowhere nearer than box.nearest. */
struct hider {
  screen_box box;
  uint32_t face;
};

/* The screen in square cells, and in each the hiders whose boxes meet it. A hider
 * with a wide box is in no cell, but looked at for every edge. */
struct grid {
  static constexpr int SIDE = 64, MOST_CELLS = 256;
  std::vector<std::vector<uint32_t>> cell{SIDE * SIDE}; /* row after row */
  std::vector<uint32_t> wide;

  /* The row or column, of n, of a coordinate; what is beyond the screen is put to
   * its border. It never decreases as x grows. */
  static int along(double x, int n = SIDE) {
    const double k = (x + 1) * (n / 2);
    return k >= n - 1 ? n - 1 : k >= 0 ? static_cast<int>(k) : 0;
  }
  /* Bounds of the coordinates on the screen in row or column k of n, a power of
   * two. The two roundings of along() move a coordinate by less than 2^-50. */
  static Interval within(int k, int n = SIDE) {
    const double low = k / (n / 2.0) - 1;
    return {low - 0x1p-40, low + 2.0 / n + 0x1p-40};
  }
  void add(uint32_t number, const screen_box &box);
};

/* Bounds of x where the segment from image a to image b has its y in `rows`. */
Interval span_in(const screen_box &a, const screen_box &b,
                 const Interval &rows) {
  const Interval xa(a.left, a.right), ya(a.low, a.high);
  const Interval run = Interval(b.left, b.right) - xa,
                 rise = Interval(b.low, b.high) - ya;
  const screen_box all = hull(a, b);
  const double low = std::max(rows.inf(), all.low),
               high = std::min(rows.sup(), all.high);
  if ((rise.inf() <= 0 && rise.sup() >= 0) || low > high)
    return {all.left, all.right};
  const Interval x = xa + (Interval(low, high) - ya) * (run / rise);
  return {std::max(x.inf(), all.left), std::min(x.sup(), all.right)};
}

/* A side of a face, by the corner that it ends in, and bounds of its x in a row of
 * the screen. If it goes through the row, its x is within `off` of the line from
 * `low` at the row's lower bound to `high` at its upper one. */
struct reach {
  double left, right;
  uint32_t corner;
  double low, high, off;
};

/* The exact x is linear in y, and at both bounds of the row in an interval. So it
 * lies between two lines, and near the one in the middle. */
void set_line(reach *r, const screen_box &a, const screen_box &b,
              const Interval &row) {
  const Interval low = span_in(a, b, row.inf()),
                 high = span_in(a, b, row.sup());
  r->low = low.inf() + (low.sup() - low.inf()) / 2;
  r->high = high.inf() + (high.sup() - high.inf()) / 2;
  const double off = std::max(low.sup() - low.inf(), high.sup() - high.inf());
  const bool is_small = std::fabs(r->low) < 0x1p8 && std::fabs(r->high) < 0x1p8;
  r->off = is_small ? off : infinity;
}

/* Whether a side that goes through a row is right of a point of the row; UNKNOWN:
 * doubles do not tell. `part` is how far up in the row the point is. Where `off` is
 * finite, numbers are below 2^9, so that all roundings are less than 2^-40. */
int is_right_of(const reach &r, const screen_box &at, const Interval &part) {
  const double x = r.low + part.inf() * (r.high - r.low);
  const double off =
      r.off + (part.sup() - part.inf()) * (r.right - r.left) + 0x1p-40;
  return x - off > at.right ? 1 : x + off < at.left ? 0 : UNKNOWN;
}

/* Reaches, by their left ends. */
struct reaches {
  std::vector<reach> all;
  std::vector<double> rightmost; /* of the first k + 1 */

  void sort() {
    std::sort(all.begin(), all.end(),
              [](const reach &a, const reach &b) { return a.left < b.left; });
    double most = -infinity;
    for (const reach &r : all)
      rightmost.push_back(most = std::max(most, r.right));
  }
  /* Those from number `first` on, and before number `end`, may have a point in
   * common with an interval of x. Those before are left of it, those after right
   * of it. */
  size_t first(double left) const {
    return static_cast<size_t>(
        std::lower_bound(rightmost.begin(), rightmost.end(), left) -
        rightmost.begin());
  }
  size_t end(double right) const {
    return static_cast<size_t>(
        std::upper_bound(all.begin(), all.end(), right,
                         [](double x, const reach &r) { return x < r.left; }) -
        all.begin());
  }
};

/* A flat face of many corners, all before the eye. In each of n_rows rows of the
 * screen it has its sides whose y come into that row. Where the y of a ray is
 * in another row, both ends of a side are strictly above the ray or both below, so
 * that the signs of their rows are equal, and the side does not count for the
 * parity. Nor does an edge cross a side whose image is apart from its own in all
 * rows. If one end of a side is above its row and the other below, the side goes
 * through: it crosses the height of every ray whose y is in that row.
 * Let a side's ends a and b have rows of opposite signs, a above the ray. With o =
 * det(F, R, U), row(a) has the sign of o, and edge(a, b) that of o times the turn
 * from a to b to the ray. It counts if these are opposite, and so if the turn is
 * to the right: if the side crosses the ray's height to the right of the ray. */
struct broad {
  static constexpr uint32_t FEWEST = 64, MANY = 1024; /* corners */
  struct row {
    reaches through, other;
  };
  const int n_rows;
  std::vector<row> rows;
  std::vector<screen_box> corner; /* the images of its corners */

  explicit broad(uint32_t n)
      : n_rows(n < MANY ? grid::SIDE : 4 * grid::SIDE),
        rows(static_cast<size_t>(n_rows)) {}
};

struct edge {
  hsr_edge_name name;
  const side *own; /* the own faces, of an edge of faces */
  size_t n_own;
  const stretch *implied; /* or NULL */
  vec<Interval> u[2];
  std::optional<vec<Exact>> exact[2];
};

/* A place on an edge. */
struct place {
  recipe zero;
  Interval t;
  std::optional<Exact> exact;
};

/* A point of an edge, between places. */
struct point {
  vec<Interval> u, u_cross_R;
  double t; /* if not `exact_t` */
  std::optional<Exact> exact_t;
  std::optional<vec<Exact>> exact;
};

/* From `at` on, `change` more faces hide the edge. */
struct event {
  place *at;
  int change;
};

class artist {
public:
  artist(const hsr_job &a_job, const shape &a_shape);
  enum hsr_status draw();

private:
  /* The picture. */
  template <class T> const frame<T> &eye() const;
  template <class T> vec<T> vertex_from_eye(uint32_t v) const;
  template <class T> vec<T> side_from_to(const recipe &which) const;
  template <class T> const plane<T> &plane_of(uint32_t f);
  template <class T> form<T> make_form(const recipe &which);
  template <class T> form<T> make_parallel_form(const recipe &which);
  template <class T> T c_of(uint32_t f);
  int decide_c(uint32_t f);
  bool exists(uint32_t f) const;
  void extend(screen_box *all, const vec<Interval> &u) const;
  void add_hider(uint32_t f);
  void add_broad(uint32_t f);

  /* An edge. */
  enum hsr_status draw_edge();
  Interval columns_in(const Interval &row) const;
  void look_at(uint32_t number);
  bool begin_edge();
  const vec<Exact> &exact_end(int end);
  int sign_at_end(const recipe &which, const Interval &guess, int end);
  bool is_at_end(const recipe &which, int end) const;
  place *cross_zero(const recipe &which, int signs[2]);
  bool clip();
  enum hsr_status emit();
  enum hsr_status emit_part(place *from, place *to, int invisibility);

  /* Places. */
  const Exact &exact_place(place *p);
  int compare(place *p, place *q);
  void sort_places();
  double rounded(place *p);

  /* A face before it. */
  bool is_own(uint32_t f) const;
  bool is_beside(uint32_t f);
  bool may_hide(uint32_t f);
  void hide(uint32_t f);
  int add_candidate(const recipe &which);
  point between(place *p, place *q);
  const vec<Exact> &exact_point(point *p);
  int decide(const recipe &which, const Interval &guess, point *p);
  int sign_at(const recipe &which, point *p);
  int row(uint32_t v, point *p);
  bool is_parity_odd(uint32_t f, point *p);
  bool is_broad_parity_odd(uint32_t f, point *p, const screen_box &at);
  bool crosses_right(uint32_t a, uint32_t b, point *p);
  bool is_side_right(uint32_t f, uint32_t i, point *p, const screen_box &at);
  void add_sides(uint32_t f);
  void add_sides_of_broad(uint32_t f);
  bool hides(uint32_t f, point *p);

  const hsr_job &job;
  const hsr_world &world;
  const shape &known;
  const frame<Interval> about;
  const frame<Exact> exact;
  std::vector<vec<Interval>> v;        /* V - E, a vertex */
  std::vector<plane<Interval>> planes; /* a face */
  std::vector<std::unique_ptr<plane<Exact>>> exact_planes;
  std::vector<signed char> c; /* a face: the sign of its c */
  std::vector<hider> hiders;
  grid cells;                                 /* numbers of hiders */
  std::vector<std::unique_ptr<broad>> broads; /* a face, or NULL */
  std::vector<uint32_t>
      looked,           /* a hider: the last edge it was looked at for */
      looked_side;      /* a side of a broad face, by corner: likewise */
  uint32_t n_edges = 0; /* begun so far */

  edge e;
  form<Interval> across; /* of the plane through the eye and the edge */
  place *lo, *hi;        /* what is in the picture */
  screen_box image, image_end[2];
  bool is_straight; /* the image is from one of these to the other */
  std::deque<place> places;
  std::vector<event> events;
  std::vector<place *> candidates; /* of one face */
  int plane_between,
      near_between; /* the signs of its PLANE and NEAR between the
                                      ends of the edge; UNKNOWN: not one */
  std::vector<signed char> beside; /* of one face, a corner */
};

template <> const frame<Interval> &artist::eye() const {
  return about;
}
template <> const frame<Exact> &artist::eye() const {
  return exact;
}
template <>
vec<Interval> artist::vertex_from_eye<Interval>(uint32_t number) const {
  return v[number];
}
template <> vec<Exact> artist::vertex_from_eye<Exact>(uint32_t number) const {
  return vertex<Exact>(world, number) - exact.E;
}
template <> const plane<Interval> &artist::plane_of(uint32_t f) {
  return planes[f];
}
template <> const plane<Exact> &artist::plane_of(uint32_t f) {
  if (!exact_planes[f])
    exact_planes[f] =
        std::make_unique<plane<Exact>>(make_plane<Exact>(world, f, exact.E));
  return *exact_planes[f];
}

/* From one end of a side to the other. With a the first, det(a, b, u) is
 * det(a, b - a, u), which intervals hold more closely. */
template <class T> vec<T> artist::side_from_to(const recipe &which) const {
  return vertex<T>(world, which.b) - vertex<T>(world, which.a);
}

/* With P0 = u - w F, where the ray starts: SIDE is det(a - P0, b - P0, F), ROW
 * is det(F, R, v - P0), and NEAR is c t - near c = e - kN·P0 - near c, e being
 * the c of PLANE. */
template <class T> form<T> artist::make_parallel_form(const recipe &which) {
  const frame<T> &i = eye<T>();
  const T zero(0), one(1);
  const vec<T> none = {zero, zero, zero};
  switch (which.of) {
  case SIDE: {
    const vec<T> a = vertex_from_eye<T>(which.a);
    const vec<T> n = cross(i.F, side_from_to<T>(which));
    return {n, T(0) - dot(n, a)};
  }
  case ROW:
    return {none - cross(i.F, i.R),
            dot(cross(i.F, i.R), vertex_from_eye<T>(which.a))};
  case PLANE:
    return {plane_of<T>(which.a).kN, -plane_of<T>(which.a).c};
  case NEAR: {
    const plane<T> &p = plane_of<T>(which.a);
    const T along = dot(p.kN, i.F);
    return {along * i.w - p.kN, p.c - i.near * along};
  }
  case CLIP_NEAR:
    return {i.w, -i.near};
  case CLIP_LEFT:
    return {i.wx, one};
  case CLIP_RIGHT:
    return {none - i.wx, one};
  case CLIP_BOTTOM:
    return {i.wy, one};
  case CLIP_TOP:
    return {none - i.wy, one};
  case START:
  case END:
    break;
  }
  return {i.w, zero}; /* never */
}

template <class T> form<T> artist::make_form(const recipe &which) {
  const frame<T> &i = eye<T>();
  const T zero(0);
  if (i.parallel)
    return make_parallel_form<T>(which);
  switch (which.of) {
  case SIDE:
    return {cross(vertex_from_eye<T>(which.a), side_from_to<T>(which)), zero};
  case ROW:
    return {cross(i.R, vertex_from_eye<T>(which.a)), zero};
  case PLANE:
    return {plane_of<T>(which.a).kN, -plane_of<T>(which.a).c};
  case NEAR:
    return {plane_of<T>(which.a).c * i.w - i.near * plane_of<T>(which.a).kN,
            zero};
  case CLIP_NEAR:
    return {i.w, -i.near};
  case CLIP_LEFT:
    return {i.w + i.wx, zero};
  case CLIP_RIGHT:
    return {i.w - i.wx, zero};
  case CLIP_BOTTOM:
    return {i.w + i.wy, zero};
  case CLIP_TOP:
    return {i.w - i.wy, zero};
  case START:
  case END:
    break;
  }
  return {i.w, zero}; /* never */
}

artist::artist(const hsr_job &a_job, const shape &a_shape)
    : job(a_job), world(*a_job.world), known(a_shape),
      about(make_frame<Interval>(*job.view)), exact([&] {
        const Nearest to_nearest;
        return make_frame<Exact>(*job.view);
      }()),
      exact_planes(world.n_faces), c(world.n_faces), broads(world.n_faces),
      looked_side(world.mesh.n_corners) {
  v.reserve(world.mesh.n_vertices);
  for (uint32_t k = 0; k < world.mesh.n_vertices; k++)
    v.push_back(vertex<Interval>(world, k) - about.E);
  planes.reserve(world.n_faces);
  for (uint32_t f = 0; f < world.n_faces; f++)
    planes.push_back(make_plane<Interval>(world, f, about.E));
  for (uint32_t f = 0; f < world.n_faces; f++) {
    c[f] = static_cast<signed char>(decide_c(f));
    if (exists(f) && c[f])
      add_hider(f);
  }
  looked.resize(hiders.size());
  for (uint32_t k = 0; k < hiders.size(); k++)
    cells.add(k, hiders[k].box);
}

void grid::add(uint32_t number, const screen_box &box) {
  const int x0 = along(box.left), x1 = along(box.right), y0 = along(box.low),
            y1 = along(box.high);
  if ((x1 - x0 + 1) * (y1 - y0 + 1) > MOST_CELLS) {
    wide.push_back(number);
    return;
  }
  for (int y = y0; y <= y1; y++)
    for (int x = x0; x <= x1; x++)
      cell[static_cast<size_t>(y * SIDE + x)].push_back(number);
}

int artist::decide_c(uint32_t f) {
  const int sign = sign_of(c_of<Interval>(f));
  if (sign != UNKNOWN)
    return sign;
  HSR_STEP(job.tally, LINE_EXACT, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
  const Nearest to_nearest;
  return sign_of(c_of<Exact>(f));
}

/* c of a face: N·(S - kE), or in parallel kN·F. */
template <class T> T artist::c_of(uint32_t f) {
  const plane<T> &p = plane_of<T>(f);
  return eye<T>().parallel ? dot(p.kN, eye<T>().F) : p.c;
}

/* The eye is in front of a plane if c < 0. */
bool artist::exists(uint32_t f) const {
  return !world.mesh.one_sided[f] || c[f] < 0;
}

/* Adds one point. What is not finite may be anything. */
void artist::extend(screen_box *all, const vec<Interval> &u) const {
  const Interval w = dot(about.w, u), by = about.parallel ? Interval(1) : w;
  const Interval x = dot(about.wx, u) / by, y = dot(about.wy, u) / by;
  if (!CGAL::is_finite(x) || !CGAL::is_finite(y) || !CGAL::is_finite(w)) {
    *all = whole_screen;
    return;
  }
  all->left = std::min(all->left, x.inf());
  all->right = std::max(all->right, x.sup());
  all->low = std::min(all->low, y.inf());
  all->high = std::max(all->high, y.sup());
  all->nearest = std::min(all->nearest, w.inf());
  all->farthest = std::max(all->farthest, w.sup());
}

/* If the ray's line, taken in both directions, misses the convex hull of the
 * vertices, the parity is even. So a face covers nothing outside the hull of
 * its vertices' images if they are all before the eye or all behind it, as in
 * parallel they are before it; images and box are closed, and hold for the
 * displaced ray too. A flat face is hit,
 * where it covers, in the hull: nowhere nearer than its nearest vertex, and
 * not at all if that would be at w <= near. */
void artist::add_hider(uint32_t f) {
  screen_box bounds = empty_image;
  for (uint32_t k = world.mesh.start[f]; k < world.mesh.start[f + 1]; k++)
    extend(&bounds, v[world.mesh.vertex[k]]);
  const bool flat = known.flat[f];
  if (flat && bounds.farthest <= job.view->near)
    return;
  if (!(bounds.nearest > 0 || bounds.farthest < 0 || about.parallel))
    bounds = whole_screen;
  if (!flat)
    bounds.nearest = -infinity;
  if (bounds.left > 1 || bounds.right < -1 || bounds.low > 1 ||
      bounds.high < -1)
    return;
  hiders.push_back({bounds, f});
  if (flat && bounds.left > -infinity &&
      (bounds.nearest > 0 || about.parallel) &&
      hsr_face_size(&world, f) >= broad::FEWEST)
    add_broad(f);
}

void artist::add_broad(uint32_t f) {
  const uint32_t n = hsr_face_size(&world, f), first = world.mesh.start[f];
  broads[f] = std::make_unique<broad>(n);
  broad &made = *broads[f];
  made.corner.assign(n, empty_image);
  for (uint32_t i = 0; i < n; i++)
    extend(&made.corner[i], v[world.mesh.vertex[first + i]]);
  for (uint32_t l = n - 1, i = 0; i < n; l = i++) {
    const screen_box &a = made.corner[l], &b = made.corner[i],
                     side = hull(a, b);
    for (int y = grid::along(side.low, made.n_rows);
         y <= grid::along(side.high, made.n_rows); y++) {
      const Interval here = grid::within(y, made.n_rows),
                     x = span_in(a, b, here);
      const bool through = (a.high < here.inf() && b.low > here.sup()) ||
                           (b.high < here.inf() && a.low > here.sup());
      broad::row &row = made.rows[static_cast<size_t>(y)];
      reach r = {x.inf(), x.sup(), i, 0, 0, 0};
      if (through)
        set_line(&r, a, b, here);
      (through ? row.through : row.other).all.push_back(r);
    }
  }
  for (broad::row &row : made.rows) {
    row.through.sort();
    row.other.sort();
  }
}

/* ---- Places on an edge ---- */

const vec<Exact> &artist::exact_end(int end) {
  if (!e.exact[end])
    e.exact[end] = e.implied
                       ? e.implied->end[end] - exact.E
                       : vertex_from_eye<Exact>(end ? e.name.b : e.name.a);
  return *e.exact[end];
}

/* Whether the form is zero at an end since vertices are the same. */
bool artist::is_at_end(const recipe &which, int end) const {
  if (e.implied)
    return false;
  const uint32_t vertex_there = end ? e.name.b : e.name.a;
  if (which.of == SIDE)
    return which.a == vertex_there || which.b == vertex_there;
  return which.of == PLANE && known.flat[which.a] &&
         has_vertex(world, which.a, vertex_there);
}

int artist::sign_at_end(const recipe &which, const Interval &guess, int end) {
  if (is_at_end(which, end))
    return 0;
  const int sign = sign_of(guess);
  if (sign != UNKNOWN)
    return sign;
  HSR_STEP(job.tally, LINE_EXACT, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
  const Nearest to_nearest;
  return sign_of(at(make_form<Exact>(which), exact_end(end)));
}

/* The signs of a form at both ends; and, if they are opposite, the place where
 * it is zero, else NULL. */
place *artist::cross_zero(const recipe &which, int signs[2]) {
  const form<Interval> l = make_form<Interval>(which);
  Interval a, b;
  if (which.of == SIDE && !e.implied) { /* zero at the side's first end */
    const vec<Interval> first = vertex<Interval>(world, which.a);
    a = dot(l.n, vertex<Interval>(world, e.name.a) - first);
    b = dot(l.n, vertex<Interval>(world, e.name.b) - first);
  } else {
    a = at(l, e.u[0]);
    b = at(l, e.u[1]);
  }
  signs[0] = sign_at_end(which, a, 0);
  signs[1] = sign_at_end(which, b, 1);
  if (signs[0] * signs[1] >= 0)
    return nullptr;
  const Interval t = a / (a - b); /* a NaN is taken for 0 and 1 below */
  places.push_back(
      {which, {std::max(0.0, t.inf()), std::min(1.0, t.sup())}, std::nullopt});
  return &places.back();
}

const Exact &artist::exact_place(place *p) {
  if (!p->exact) {
    HSR_STEP(job.tally, LINE_EXACT, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
    const Nearest to_nearest;
    if (p->zero.of == START || p->zero.of == END) {
      p->exact = Exact(p->zero.of == END);
    } else {
      const form<Exact> l = make_form<Exact>(p->zero);
      const Exact a = at(l, exact_end(0)), b = at(l, exact_end(1));
      p->exact = a / (a - b);
    }
    p->t = enclose(*p->exact);
  }
  return *p->exact;
}

int artist::compare(place *p, place *q) {
  if (p == q || p->zero == q->zero)
    return 0;
  if (p->zero.of == START || q->zero.of == END)
    return -1;
  if (q->zero.of == START || p->zero.of == END)
    return 1;
  if (p->t.sup() < q->t.inf())
    return -1;
  if (p->t.inf() > q->t.sup())
    return 1;
  const Exact &a = exact_place(p), &b = exact_place(q);
  const Nearest to_nearest;
  return int(CGAL::compare(a, b));
}

/* The point between a and b, at t from 0 to 1. It is rounded to nearest, also where
 * intervals round upwards. The compiler does not move arithmetic on opaque numbers
 * out of this function, where the mode of rounding is another. */
double between_at(double a, double b, double t) {
  const Nearest to_nearest;
  const double x = CGAL::IA_opacify(a), y = CGAL::IA_opacify(b);
  return CGAL::IA_opacify((1 - t) * x + t * y);
}

double middle(double a, double b) {
  const Nearest to_nearest;
  const double x = CGAL::IA_opacify(a), y = CGAL::IA_opacify(b);
  return CGAL::IA_opacify(x + (y - x) / 2);
}

/* Within 1e-13, relatively. */
double artist::rounded(place *p) {
  const double t = middle(p->t.inf(), p->t.sup());
  if (p->t.sup() - p->t.inf() <= 1e-13 * p->t.inf())
    return t;
  const Exact &exact_t = exact_place(p);
  const Nearest to_nearest;
  return CGAL::to_double(exact_t);
}

/* ---- Points of an edge ---- */

point artist::between(place *p, place *q) {
  point m = {};
  const double a = p->t.sup(), b = q->t.inf();
  m.t = middle(a, b);
  Interval t(m.t);
  if (!(a < m.t && m.t < b)) {
    const Exact &s = exact_place(p), &r = exact_place(q);
    const Nearest to_nearest;
    m.exact_t = (s + r) / Exact(2);
    t = enclose(*m.exact_t);
  }
  m.u = e.u[0] + t * (e.u[1] - e.u[0]);
  m.u_cross_R = cross(m.u, about.R);
  return m;
}

const vec<Exact> &artist::exact_point(point *p) {
  if (!p->exact) {
    const Exact t = p->exact_t ? *p->exact_t : Exact(p->t);
    p->exact = exact_end(0) + t * (exact_end(1) - exact_end(0));
  }
  return *p->exact;
}

/* The displaced sign of a form, of which an interval is known. */
int artist::decide(const recipe &which, const Interval &guess, point *p) {
  const int sign = sign_of(guess);
  if (sign == 1 || sign == -1)
    return sign;
  HSR_STEP(job.tally, LINE_EXACT, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
  const Nearest to_nearest;
  const form<Exact> l = make_form<Exact>(which);
  if (const int there = sign_of(at(l, exact_point(p))))
    return there;
  if (const int along_R = sign_of(dot(l.n, exact.R)))
    return along_R;
  return -sign_of(dot(l.n, exact.U));
}

int artist::sign_at(const recipe &which, point *p) {
  return decide(which, at(make_form<Interval>(which), p->u), p);
}

/* ---- Hiding ---- */

/* row(v) = det(D, R, v), or det(F, R, V - P). A vertex in the direction of R
 * counts as positive. */
int artist::row(uint32_t number, point *p) {
  const recipe which = {ROW, number, 0};
  const int sign = about.parallel
                       ? sign_at(which, p)
                       : decide(which, dot(p->u_cross_R, v[number]), p);
  return sign ? sign : 1;
}

/* Whether a side crosses to the right of the point. */
bool artist::crosses_right(uint32_t a, uint32_t b, point *p) {
  const int row_a = row(a, p);
  if (row_a == row(b, p))
    return false;
  const recipe which = {SIDE, std::min(a, b), std::max(a, b)};
  return sign_at(which, p) * (a < b ? 1 : -1) == -row_a;
}

/* Whether the side of a broad face that ends in corner i crosses to the right of
 * the point, whose image is in the box `at`: by the images of its ends, if they
 * are certainly above and below the point and it is beside the side. */
bool artist::is_side_right(uint32_t f, uint32_t i, point *p,
                           const screen_box &at) {
  const uint32_t l = i ? i - 1 : hsr_face_size(&world, f) - 1,
                 *corner = world.mesh.vertex + world.mesh.start[f];
  const screen_box &a = broads[f]->corner[l], &b = broads[f]->corner[i];
  if ((a.low > at.high && b.low > at.high) ||
      (a.high < at.low && b.high < at.low))
    return false;
  if ((a.low > at.high && b.high < at.low) ||
      (a.high < at.low && b.low > at.high)) {
    const Interval x = span_in(a, b, {at.low, at.high});
    if (x.inf() > at.right || x.sup() < at.left)
      return x.inf() > at.right;
  }
  return crosses_right(corner[l], corner[i], p);
}

/* The parity of a broad face at a point, by the sides in the row that the point
 * is in, which must be one. */
bool artist::is_broad_parity_odd(uint32_t f, point *p, const screen_box &at) {
  const int y = grid::along(at.low, broads[f]->n_rows);
  const broad::row &row = broads[f]->rows[static_cast<size_t>(y)];
  const Interval here = grid::within(y, broads[f]->n_rows);
  const Interval part = (Interval(at.low, at.high) - Interval(here.inf())) /
                        (Interval(here.sup()) - Interval(here.inf()));
  const size_t right_of = row.through.end(at.right);
  bool odd = (row.through.all.size() - right_of) % 2;
  for (size_t k = row.through.first(at.left); k < right_of; k++) {
    const reach &r = row.through.all[k];
    const int guess = is_right_of(r, at, part);
    if (guess == UNKNOWN ? is_side_right(f, r.corner, p, at) : guess)
      odd = !odd;
  }
  for (size_t k = row.other.first(at.left); k < row.other.all.size(); k++)
    if (row.other.all[k].right >= at.left &&
        is_side_right(f, row.other.all[k].corner, p, at))
      odd = !odd;
  return odd;
}

bool artist::is_parity_odd(uint32_t f, point *p) {
  bool odd = false;
  if (broads[f]) {
    screen_box at = empty_image;
    extend(&at, p->u);
    if (grid::along(at.low, broads[f]->n_rows) ==
        grid::along(at.high, broads[f]->n_rows))
      return is_broad_parity_odd(f, p, at);
  }
  uint32_t a = world.mesh.vertex[world.mesh.start[f + 1] - 1];
  int row_a = row(a, p);
  for (uint32_t k = world.mesh.start[f]; k < world.mesh.start[f + 1]; k++) {
    const uint32_t b = world.mesh.vertex[k];
    const int row_b = row(b, p);
    if (row_a != row_b) {
      const recipe which = {SIDE, std::min(a, b), std::max(a, b)};
      const int sign = sign_at(which, p) * (a < b ? 1 : -1);
      odd = odd != (sign == -row_a);
    }
    a = b;
    row_a = row_b;
  }
  return odd;
}

/* Whether the face hides the point, if it is none of the edge's own faces and
 * its plane does not contain the edge. Where kN·u - c has the sign of c, so has
 * N·D. */
bool artist::hides(uint32_t f, point *p) {
  HSR_STEP(job.tally, LINE_POINT, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
  const int side = c[f];
  const auto is_side = [&](int between, what of) {
    return (between == UNKNOWN ? sign_at({of, f, 0}, p) : between) == side;
  };
  return is_side(plane_between, PLANE) && is_parity_odd(f, p) &&
         is_side(near_between, NEAR);
}

bool artist::is_own(uint32_t f) const {
  if (e.implied)
    return f == e.name.a || f == e.name.b;
  for (size_t i = 0; i < e.n_own; i++)
    if (e.own[i].face == f)
      return true;
  return false;
}

/* Whether all vertices of the face lie strictly on one side of the plane
 * through the eye and the edge, but for one that is an end of the edge. The
 * rays of the edge's points, ends apart, lie in that plane and miss the hull of
 * the vertices, and so do displaced ones: the parity is even.
 * Notes for each corner on which side it certainly is, else 0. */
bool artist::is_beside(uint32_t f) {
  int n_ends = 0;
  bool right_of = false, left_of = false, open = false;
  beside.clear();
  for (uint32_t k = world.mesh.start[f]; k < world.mesh.start[f + 1]; k++) {
    const uint32_t number = world.mesh.vertex[k];
    int sign = 0;
    if (!e.implied && (number == e.name.a || number == e.name.b)) {
      n_ends++;
    } else {
      sign = sign_of(at(across, v[number]));
      open = open || sign == UNKNOWN || sign == 0;
      sign = sign == UNKNOWN ? 0 : sign;
    }
    left_of = left_of || sign > 0;
    right_of = right_of || sign < 0;
    beside.push_back(static_cast<signed char>(sign));
  }
  return !open && n_ends <= 1 && left_of != right_of;
}

/* The sign of a form between the ends of an edge, where it has these signs. It is
 * linear; if it is zero at both ends, the displacement decides. */
int sign_between(const int signs[2]) {
  if (signs[0] * signs[1] < 0 || (signs[0] == 0 && signs[1] == 0))
    return UNKNOWN;
  return signs[0] ? signs[0] : signs[1];
}

/* False if the face is not before the edge, which only its plane tells; or if
 * its plane contains both ends. What is strictly hit before P has, where c is
 * positive, kN·u - c > 0: if that is so at neither end, it is so nowhere
 * between. Adds the place where it changes. */
bool artist::may_hide(uint32_t f) {
  int signs[2];
  place *there = cross_zero({PLANE, f, 0}, signs);
  if (there)
    candidates.push_back(there);
  plane_between = sign_between(signs);
  return signs[0] * c[f] > 0 || signs[1] * c[f] > 0;
}

/* Returns the sign of the form between the ends of the edge. */
int artist::add_candidate(const recipe &which) {
  int signs[2];
  if (place *there = cross_zero(which, signs))
    candidates.push_back(there);
  return sign_between(signs);
}

/* The places where the edge crosses sides of a face: both ends of such a side
 * are not on one side of the plane through the eye and the edge. */
void artist::add_sides(uint32_t f) {
  const uint32_t *corner = world.mesh.vertex + world.mesh.start[f];
  const uint32_t n = hsr_face_size(&world, f);
  for (uint32_t i = n - 1, k = 0; k < n; i = k++) {
    if (beside[i] * beside[k] <= 0)
      add_candidate({SIDE, std::min(corner[i], corner[k]),
                     std::max(corner[i], corner[k])});
    if (!known.flat[f])
      add_candidate({ROW, corner[k], 0});
  }
}

/* The same, of sides in the rows of the edge. */
void artist::add_sides_of_broad(uint32_t f) {
  const uint32_t n = hsr_face_size(&world, f), first = world.mesh.start[f],
                 *corner = world.mesh.vertex + first;
  const auto look = [&](const reaches &in, const Interval &x) {
    for (size_t k = in.first(x.inf()), end = in.end(x.sup()); k < end; k++) {
      const uint32_t i = in.all[k].corner, a = corner[i ? i - 1 : n - 1],
                     b = corner[i];
      if (in.all[k].right < x.inf() || looked_side[first + i] == n_edges)
        continue;
      looked_side[first + i] = n_edges;
      const int sign = sign_of(at(across, v[a]));
      if (sign == UNKNOWN || sign == 0 || sign != sign_of(at(across, v[b])))
        add_candidate({SIDE, std::min(a, b), std::max(a, b)});
    }
  };
  const int n_rows = broads[f]->n_rows;
  for (int y = grid::along(image.low, n_rows);
       y <= grid::along(image.high, n_rows); y++) {
    const broad::row &row = broads[f]->rows[static_cast<size_t>(y)];
    const Interval x = columns_in(grid::within(y, n_rows));
    look(row.through, x);
    look(row.other, x);
  }
}

/* The events of one face. The parity changes only where the ray crosses a side:
 * both ends of which are then not on one side of the plane through the eye and
 * the edge. Where a side's line passes through the eye, it is skipped, and the
 * parity may change with a row; the face is then not flat, or c were 0. */
void artist::hide(uint32_t f) {
  HSR_STEP(job.tally, LINE_PAIR, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
  candidates.clear();
  if ((!broads[f] && is_beside(f)) || !may_hide(f))
    return;
  near_between = UNKNOWN;
  if (job.view->near > 0 || about.parallel)
    near_between = add_candidate({NEAR, f, 0});
  if (near_between != UNKNOWN && near_between != c[f])
    return;
  if (broads[f])
    add_sides_of_broad(f);
  else
    add_sides(f);
  sort_places();
  for (size_t i = 1; i < candidates.size(); i++) {
    point p = between(candidates[i - 1], candidates[i]);
    if (!hides(f, &p))
      continue;
    events.push_back({candidates[i - 1], 1});
    events.push_back({candidates[i], -1});
  }
}

/* The candidates between lo and hi, sorted, each once, and these themselves. */
void artist::sort_places() {
  auto outside = [&](place *p) {
    return compare(p, lo) <= 0 || compare(p, hi) >= 0;
  };
  candidates.erase(
      std::remove_if(candidates.begin(), candidates.end(), outside),
      candidates.end());
  std::sort(candidates.begin(), candidates.end(),
            [&](place *p, place *q) { return compare(p, q) < 0; });
  candidates.erase(
      std::unique(candidates.begin(), candidates.end(),
                  [&](place *p, place *q) { return compare(p, q) == 0; }),
      candidates.end());
  candidates.insert(candidates.begin(), lo);
  candidates.push_back(hi);
}

/* ---- An edge ---- */

/* Places lo and hi around what is in the picture; false if that is nothing. */
bool artist::clip() {
  places.push_back({{START, 0, 0}, Interval(0), std::nullopt});
  lo = &places.back();
  places.push_back({{END, 0, 0}, Interval(1), std::nullopt});
  hi = &places.back();
  for (what of : {CLIP_NEAR, CLIP_LEFT, CLIP_RIGHT, CLIP_BOTTOM, CLIP_TOP}) {
    const bool closed = of == CLIP_LEFT || of == CLIP_TOP;
    int signs[2];
    place *there = cross_zero({of, 0, 0}, signs);
    if (!there) {
      const int sign = signs[0] ? signs[0] : signs[1];
      if (sign < 0 || (sign == 0 && !closed))
        return false;
    } else if (signs[0] < 0) {
      lo = compare(there, lo) > 0 ? there : lo;
    } else {
      hi = compare(there, hi) < 0 ? there : hi;
    }
  }
  return compare(lo, hi) < 0;
}

/* The plane through the eye and two points. */
template <class T>
form<T> through(const frame<T> &eye, const vec<T> &a, const vec<T> &b) {
  const vec<T> n = eye.parallel ? cross(eye.F, b - a) : cross(a, b);
  return {n, eye.parallel ? -dot(n, a) : T(0)};
}

/* False if it is no edge, or nothing of it is in the picture. */
bool artist::begin_edge() {
  places.clear();
  events.clear();
  across = through(about, e.u[0], e.u[1]);
  int no_image = is_zero(across.n);
  if (no_image == UNKNOWN) {
    HSR_STEP(job.tally, LINE_EXACT, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
    const Nearest to_nearest;
    no_image = is_zero(through(exact, exact_end(0), exact_end(1)).n);
  }
  if (no_image || !clip())
    return false;

  for (int end : {0, 1}) {
    image_end[end] = empty_image;
    extend(&image_end[end], e.u[end]);
  }
  image = hull(image_end[0], image_end[1]);
  is_straight = (image.nearest > 0 || about.parallel) && image.left > -infinity;
  if (!(image.nearest > 0 || about.parallel)) {
    const double farthest = image.farthest;
    image = whole_screen;
    image.farthest = farthest;
  }
  image.left = std::max(image.left, -1.0);
  image.right = std::min(image.right, 1.0);
  image.low = std::max(image.low, -1.0);
  image.high = std::min(image.high, 1.0);
  return true;
}

enum hsr_status artist::emit_part(place *from, place *to, int invisibility) {
  const hsr_drawing &d = *hsr_answer_drawing_of(job.answer);
  const hsr_segment *last = d.n ? &d.segment[d.n - 1] : nullptr;
  const bool is_next = last && !hsr_edge_name_compare(&last->edge, &e.name);
  struct hsr_segment part = {e.name, uint32_t(invisibility), 0, rounded(to), {},
                             {}};

  /* In the exact order, also where one is rounded in one way, one in another.
   */
  part.t0 = is_next ? last->t1 : rounded(from);
  part.t1 = std::max(part.t0, part.t1);

  double A[3], B[3];
  if (e.implied) {
    const Nearest to_nearest;
    const vec<Exact> &a = e.implied->end[0], &b = e.implied->end[1];
    const Exact *of_a[3] = {&a.x, &a.y, &a.z}, *of_b[3] = {&b.x, &b.y, &b.z};
    for (int k = 0; k < 3; k++) {
      A[k] = CGAL::to_double(*of_a[k]);
      B[k] = CGAL::to_double(*of_b[k]);
    }
  } else {
    const double *xyz[3] = {world.mesh.x, world.mesh.y, world.mesh.z};
    for (int k = 0; k < 3; k++) {
      A[k] = xyz[k][e.name.a];
      B[k] = xyz[k][e.name.b];
    }
  }
  for (int k = 0; k < 3; k++) {
    part.from[k] = between_at(A[k], B[k], part.t0);
    part.to[k] = between_at(A[k], B[k], part.t1);
  }
  return hsr_drawing_add(hsr_answer_drawing_of(job.answer), &part);
}

/* The intervals, from the events. */
enum hsr_status artist::emit() {
  std::sort(events.begin(), events.end(), [&](const event &a, const event &b) {
    return compare(a.at, b.at) < 0;
  });
  place *from = lo;
  int invisibility = 0;
  enum hsr_status status = HSR_OK;
  for (size_t i = 0; i < events.size() && !status;) {
    place *to = events[i].at;
    int change = 0;
    for (; i < events.size() && compare(to, events[i].at) == 0; i++)
      change += events[i].change;
    if (change == 0)
      continue;
    if (compare(from, to) < 0)
      status = emit_part(from, to, invisibility);
    from = to;
    invisibility += change;
  }
  if (!status && compare(from, hi) < 0)
    status = emit_part(from, hi, invisibility);
  return status;
}

void artist::look_at(uint32_t number) {
  const hider &h = hiders[number];
  if (looked[number] == n_edges)
    return;
  looked[number] = n_edges;
  HSR_STEP(job.tally, LINE_BOX, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
  if (h.box.left > image.right || h.box.right < image.left ||
      h.box.low > image.high || h.box.high < image.low ||
      h.box.nearest >= image.farthest)
    return;
  if (!is_own(h.face))
    hide(h.face);
}

/* Bounds of x where the edge is in the picture and in a row of the screen. */
Interval artist::columns_in(const Interval &row) const {
  if (!is_straight)
    return {image.left, image.right};
  const Interval x = span_in(image_end[0], image_end[1], row);
  return {std::min(std::max(x.inf(), image.left), image.right),
          std::max(std::min(x.sup(), image.right), image.left)};
}

enum hsr_status artist::draw_edge() {
  if (!begin_edge())
    return HSR_OK;
  n_edges++;
  for (uint32_t number : cells.wide)
    look_at(number);
  const int y1 = grid::along(image.high);
  for (int y = grid::along(image.low); y <= y1; y++) {
    const Interval columns = columns_in(grid::within(y));
    for (int x = grid::along(columns.inf()); x <= grid::along(columns.sup());
         x++)
      for (uint32_t number :
           cells.cell[static_cast<size_t>(y * grid::SIDE + x)])
        look_at(number);
  }
  return emit();
}

enum hsr_status artist::draw() {
  enum hsr_status status = HSR_OK;
  const std::vector<side> &sides = known.sides;
  for (size_t i = 0; i < sides.size() && !status;) {
    const side *first = &sides[i];
    bool there = false;
    size_t n = 0;
    for (; i < sides.size() && sides[i].a == first->a && sides[i].b == first->b;
         i++, n++)
      there = there || exists(sides[i].face);
    e = {{false, first->a, first->b, 0}, first, n, nullptr,
         {v[first->a], v[first->b]},     {}};
    if (there && first->a != first->b)
      status = draw_edge();
  }
  for (const stretch &s : known.implied) {
    if (status)
      break;
    if (!exists(s.name.a) || !exists(s.name.b))
      continue;
    e = {s.name, nullptr, 0, &s, {}, {}};
    for (int end : {0, 1})
      e.u[end] = enclose([&] {
        const Nearest to_nearest;
        return exact_end(end);
      }());
    status = draw_edge();
  }
  return status;
}

/* ---- The algorithm ---- */

/* Does the work; nothing is thrown out of here. */
template <class Work>
enum hsr_status guarded(struct hsr_error *err, Work work) noexcept {
  try {
    return work();
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (const std::exception &e) {
    return hsr_fail(err, HSR_E_INTERNAL, "line-oracle: %s", e.what());
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "line-oracle: an unknown exception");
  }
}

extern "C" {

static double expense(const struct hsr_world *world, const struct hsr_view *) {
  return 0.125 * world->n_faces * world->mesh.n_corners;
}

static enum hsr_status prepare(const struct hsr_world *world, const long *,
                               void **prepared, struct hsr_error *err) {
  return guarded(err, [&] {
    if (!judge::is_rounding_honoured())
      return hsr_fail(err, HSR_E_INTERNAL,
                      "line-oracle: directed rounding has no effect here");
    const Upward upward;
    auto made = std::make_unique<shape>();
    for (uint32_t f = 0; f < world->n_faces; f++)
      made->flat.push_back(decide_flat(*world, f));
    find_sides(*world, made.get());
    find_implied(*world, made.get());
    *prepared = made.release();
    return HSR_OK;
  });
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return guarded(err, [&] {
    const Upward upward;
    artist a(*job, *static_cast<const shape *>(job->prepared));
    const enum hsr_status status = a.draw();
    return status ? hsr_fail_nomem(err) : HSR_OK;
  });
}

static void release(void *prepared) {
  delete static_cast<shape *>(prepared);
}

} /* extern "C" */

constexpr struct hsr_counter counters[] = {
    {"boxes", "boxes of faces compared with that of an edge", HSR_COMPARE},
    {"pairs", "faces compared with an edge, their boxes overlapping",
     HSR_COMPARE},
    {"points", "points of edges tested for whether a face hides them",
     HSR_COMPARE},
    {"exact", "signs and places that were sought in rational numbers",
     HSR_COMPARE},
    {nullptr}};

constexpr struct hsr_algorithm describe() {
  struct hsr_algorithm a = {};
  a.name = "line-oracle";
  a.title = "Line oracle: exact invisibility from the definition";
  a.authors = "hsr";
  a.source = "docs/correct-drawing.md";
  a.taxonomy = HSR_YARDSTICK;
  a.subjects = 1 << HSR_FACES;
  a.makes[0].kind = HSR_SEGMENTS;
  a.flags = HSR_JUDGE;
  a.counters = counters;
  a.expense = expense;
  a.prepare = prepare;
  a.render = render;
  a.release = release;
  return a;
}

} /* namespace */

/* Constant-initialised. Declared first: a const is otherwise private to its
 * file in C++. */
extern "C" const struct hsr_algorithm HSR_ALGORITHM(line_oracle);
constexpr struct hsr_algorithm description = describe();
const struct hsr_algorithm HSR_ALGORITHM(line_oracle) = description;
