/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/judge/areas/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace areas {

using judge::cross;
using judge::det;
using judge::dot;
using judge::lift;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr box everywhere = {-infinity, infinity, -infinity, infinity};
constexpr box nowhere = {infinity, -infinity, infinity, -infinity};

template <class T> frame<T> make_frame(const hsr_view &view) {
  frame<T> f;
  const T m(view.m), n(view.n), two(2);
  f.parallel = view.parallel;
  f.E = lift<T>(view.E);
  f.F = lift<T>(view.F);
  f.R = lift<T>(view.R);
  f.U = lift<T>(view.U);
  f.mn = m * n;
  f.near = T(view.near);
  f.X = T(two * n) * f.R;
  f.Y = lift<T>(0, 0, 0) - T(two * m) * f.U;
  const vec<T> corner = f.U - f.R;
  f.O = f.mn * (f.parallel ? corner : f.F + corner);
  return f;
}

/* G·D, or G·(P - E) + mn k, as a function of (sx, sy). */
template <class T>
affine<T> function(const frame<T> &on, const vec<T> &G, const T &k) {
  const T at_corner = dot(G, on.O);
  return {dot(G, on.X), dot(G, on.Y),
          on.parallel ? T(at_corner + on.mn * k) : at_corner};
}

template <class T>
vec<T> from_eye(const frame<T> &on, const hsr_world &world, uint32_t v) {
  return lift<T>(world.mesh.x[v], world.mesh.y[v], world.mesh.z[v]) - on.E;
}

/* row(v): det(D, R, v) or det(F, R, V - P); with U, the column. Of the row the
 * coefficient of sx is zero, of the column that of sy. */
template <class T>
affine<T> track(const frame<T> &on, const vec<T> &along, const vec<T> &v) {
  if (!on.parallel)
    return function(on, cross(along, v), T(0));
  const vec<T> across = cross(on.F, along);
  return function(on, lift<T>(0, 0, 0) - across, T(dot(across, v)));
}

template <class T> affine<T> row_of(const frame<T> &on, const vec<T> &v) {
  affine<T> f = track(on, on.R, v);
  f.a = T(0);
  return f;
}

template <class T> affine<T> column_of(const frame<T> &on, const vec<T> &v) {
  affine<T> f = track(on, on.U, v);
  f.b = T(0);
  return f;
}

/* edge(a, b): det(a, b, D) or det(A - P, B - P, F). */
template <class T>
affine<T> edge_of(const frame<T> &on, const vec<T> &a, const vec<T> &b) {
  return on.parallel
             ? function(on, cross(vec<T>(a - b), on.F), T(det(a, b, on.F)))
             : function(on, cross(a, b), T(0));
}

/* Zero if the tracks of a and b along this vector are proportional. */
template <class T>
T spread(const frame<T> &on, const vec<T> &along, const vec<T> &a,
         const vec<T> &b) {
  return on.parallel ? det(on.F, along, vec<T>(a - b)) : det(a, b, along);
}

template <class T> struct surface {
  vec<T> kN;
  T e, c; /* N·(S - kE); the same, or kN·F */
};

template <class T>
surface<T> surface_of(const frame<T> &on, const hsr_world &world, uint32_t f) {
  const uint32_t *vertex = world.mesh.vertex + world.mesh.start[f];
  const uint32_t k = hsr_face_size(&world, f);
  const vec<T> first = from_eye(on, world, vertex[0]);
  vec<T> N = lift<T>(0, 0, 0), S = first, before = N;
  for (uint32_t i = 1; i < k; i++) {
    const vec<T> v = from_eye(on, world, vertex[i]);
    const vec<T> here = v - first;
    N = N + cross(before, here);
    S = S + v;
    before = here;
  }
  surface<T> p;
  p.kN = T(double(k)) * N;
  p.e = dot(N, S);
  p.c = on.parallel ? dot(p.kN, on.F) : p.e;
  return p;
}

template <class T> affine<T> times(const T &k, const affine<T> &f) {
  return {k * f.a, k * f.b, k * f.c};
}

/* s, c and near, all times `side`. */
template <class T>
void find_depths(const frame<T> &on, const surface<T> &p, int side,
                 affine<T> *s, T *c, affine<T> *near) {
  const T sign(side);
  *s = times(sign, function(on, p.kN, T(T(0) - p.e)));
  *c = sign * p.c;
  if (on.parallel) {
    *near = times(T(-1), *s);
    near->c = near->c - on.near * on.mn * *c;
  } else {
    *near = times(T(T(0) - on.near), *s);
    near->c = near->c + on.mn * *c;
  }
}

int sign_of_c(const stage &on, uint32_t f) {
  const int guess = sign_of(surface_of(on.rough, on.world, f).c);
  if (guess != UNSURE)
    return guess;
  return int(CGAL::sign(surface_of(on.exact, on.world, f).c));
}

bool is_apart(const stage &on, bool columns, uint32_t a, uint32_t b) {
  const int guess = sign_of(spread(on.rough, columns ? on.rough.U : on.rough.R,
                                   from_eye(on.rough, on.world, a),
                                   from_eye(on.rough, on.world, b)));
  if (guess != UNSURE)
    return guess != 0;
  return !CGAL::is_zero(spread(on.exact, columns ? on.exact.U : on.exact.R,
                               from_eye(on.exact, on.world, a),
                               from_eye(on.exact, on.world, b)));
}

template <class T> bool is_zero(const vec<T> &v) {
  return CGAL::is_zero(v.x) && CGAL::is_zero(v.y) && CGAL::is_zero(v.z);
}

meeting meeting_of(const stage &on, uint32_t a, uint32_t b) {
  if (is_apart(on, false, a, b))
    return BY_ROWS;
  if (is_apart(on, true, a, b))
    return BY_COLUMNS;
  const vec<Exact> u = from_eye(on.exact, on.world, a),
                   v = from_eye(on.exact, on.world, b);
  if (on.view.parallel || !is_zero(cross(u, v)))
    return NO_BOUNDARY;
  return is_zero(u) ? ALL_OF_NEXT_ROW : ALL_OF_ROW;
}

/* ---- Where things are ---- */

void extend(box *all, const box &part) {
  all->x0 = std::min(all->x0, part.x0);
  all->x1 = std::max(all->x1, part.x1);
  all->y0 = std::min(all->y0, part.y0);
  all->y1 = std::max(all->y1, part.y1);
}

/* The image of a vertex, by its row and its column. */
box image(const affine<Interval> &row, const affine<Interval> &column) {
  const Interval x = -column.c / column.a, y = -row.c / row.b;
  if (!(x.inf() <= x.sup()) || !(y.inf() <= y.sup()))
    return everywhere;
  return {x.inf(), x.sup(), y.inf(), y.sup()};
}

/* The box of two vertices' images, if both are on one side of the eye's plane,
 * which the sign of row.b tells. */
box between(const affine<Interval> &row_a, const box &a,
            const affine<Interval> &row_b, const box &b) {
  const int side = sign_of(row_a.b);
  if (side == UNSURE || side == 0 || side != sign_of(row_b.b))
    return everywhere;
  box both = a;
  extend(&both, b);
  return both;
}

} // namespace

stage::stage(const hsr_world &w, const hsr_view &v) : world(w), view(v) {
  rough = make_frame<Interval>(v);
  const Nearest to_nearest;
  exact = make_frame<Exact>(v);
}

box bounds_of(const stage &on, uint32_t f) {
  const hsr_mesh &mesh = on.world.mesh;
  box all = nowhere;
  int side = 0;
  for (uint32_t c = mesh.start[f]; c < mesh.start[f + 1]; c++) {
    const vec<Interval> v = from_eye(on.rough, on.world, mesh.vertex[c]);
    const affine<Interval> row = row_of(on.rough, v);
    const int here = sign_of(row.b);
    if (here == UNSURE || here == 0 || (side && side != here))
      return everywhere;
    side = here;
    extend(&all, image(row, column_of(on.rough, v)));
  }
  return all;
}

/* ---- Exact functions ---- */

const exact_shape &shape::exactly() const {
  if (known)
    return *known;
  const Nearest to_nearest;
  known = std::make_unique<exact_shape>();
  const frame<Exact> &frame = on.exact;
  const uint32_t *vertex = on.world.mesh.vertex + on.world.mesh.start[id];
  std::vector<vec<Exact>> v;
  for (uint32_t k = 0; k < n; k++)
    v.push_back(from_eye(frame, on.world, vertex[k]));
  for (uint32_t k = 0; k < n; k++) {
    known->row.push_back(row_of(frame, v[k]));
    known->column.push_back(column_of(frame, v[k]));
    known->edge.push_back(edge_of(frame, v[k], v[next(k)]));
  }
  find_depths(frame, surface_of(frame, on.world, id), side, &known->s,
              &known->c, &known->near);
  return *known;
}

namespace {

affine<Exact> find_row(const line &l) {
  return l.f->exactly().row[size_t(l.k)];
}
affine<Exact> find_column(const line &l) {
  return l.f->exactly().column[size_t(l.k)];
}
affine<Exact> find_edge(const line &l) {
  return l.f->exactly().edge[size_t(l.k)];
}
affine<Exact> find_s(const line &l) {
  return l.f->exactly().s;
}
affine<Exact> find_near(const line &l) {
  return l.f->exactly().near;
}

affine<Exact> find_difference(const line &l) {
  const exact_shape &f = l.f->exactly(), &g = l.g->exactly();
  return {f.s.a * g.c - g.s.a * f.c, f.s.b * g.c - g.s.b * f.c,
          f.s.c * g.c - g.s.c * f.c};
}

line make_line(line_of of, const affine<Interval> &rough,
               affine<Exact> (*find)(const line &), const shape *f,
               uint32_t k) {
  return {of, rough, find, f, nullptr, int(k), {}};
}

} // namespace

void compare_depths(const shape &f, const shape &g, line *made) {
  const affine<Interval> &s = f.s.rough, &t = g.s.rough;
  made->rough = {s.a * g.c - t.a * f.c, s.b * g.c - t.b * f.c,
                 s.c * g.c - t.c * f.c};
  made->of = MEETING_LINE;
  made->find = find_difference;
  made->f = &f;
  made->g = &g;
}

/* ---- Shapes ---- */

shape::shape(const stage &stage, uint32_t face, int sign_c)
    : on(stage), id(face), n(hsr_face_size(&stage.world, face)), side(sign_c),
      bounds(bounds_of(stage, face)) {
  const frame<Interval> &frame = on.rough;
  const uint32_t *vertex = on.world.mesh.vertex + on.world.mesh.start[id];
  std::vector<vec<Interval>> v;
  std::vector<box> at;
  for (uint32_t k = 0; k < n; k++) {
    v.push_back(from_eye(frame, on.world, vertex[k]));
    row.push_back(make_line(ROW_LINE, row_of(frame, v[k]), find_row, this, k));
    column.push_back(
        make_line(COLUMN_LINE, column_of(frame, v[k]), find_column, this, k));
    at.push_back(image(row[k].rough, column[k].rough));
  }
  for (uint32_t k = 0; k < n; k++) {
    const uint32_t a = vertex[k], b = vertex[next(k)];
    edge.push_back(make_line(EDGE_LINE, edge_of(frame, v[k], v[next(k)]),
                             find_edge, this, k));
    edge_box.push_back(
        between(row[k].rough, at[k], row[next(k)].rough, at[next(k)]));
    by.push_back(meeting_of(on, a, b));
  }
  affine<Interval> to_s, to_near;
  find_depths(frame, surface_of(frame, on.world, id), side, &to_s, &c,
              &to_near);
  s = make_line(HORIZON_LINE, to_s, find_s, this, 0);
  near = make_line(NEAR_LINE, to_near, find_near, this, 0);
}

std::unique_ptr<shape> make_shape(const stage &on, uint32_t f) {
  const int side = sign_of_c(on, f);
  if (side == 0 || (on.world.mesh.one_sided[f] && side > 0))
    return nullptr;
  return std::make_unique<shape>(on, f, side);
}

/* ---- Covering ---- */

namespace {

/* The sign at the point, or where that is zero, of the derivatives along R and
 * along -U, which run to greater sx and to greater sy. */
int perturbed_sign(line &f, point &at) {
  if (const int sign = sign_at(f, at))
    return sign;
  if (const int sign = sgn(f.exactly().a))
    return sign;
  return sgn(f.exactly().b);
}

} // namespace

bool shape::is_odd_at(point &at) {
  const auto row_sign = [&](uint32_t k) {
    const int sign = perturbed_sign(row[k], at);
    return sign ? sign : 1;
  };
  bool odd = false;
  const int first = row_sign(0);
  int here = first;
  for (uint32_t k = 0; k < n; k++) {
    const int there = next(k) ? row_sign(next(k)) : first;
    if (here != there && perturbed_sign(edge[k], at) == -here)
      odd = !odd;
    here = there;
  }
  return odd;
}

} // namespace areas
