/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notation    P the point; V the direction to the eye; n, m the normals of the
 *             face and of the bumps; Q the point of the board that is seen
 *             through them; r the direction that is mirrored.
 *             docs/area-picture.md has the formulas.
 * Points      on a plane q = 1/t is linear on the screen, and P = E + D/q, so
 *             each coordinate of P is a quotient of two linear functions. On a
 *             square where q is positive it is monotone along both sides: its
 *             range is that of the four corners. In parallel P is linear
 *             itself. Likewise Gouraud's colours, which are affine on the
 *             plane. Where q may be 0, P is in the box of the face's corners,
 *             if the face is flat.
 * Bumps       the slope σ rises for s from -1/6 to 1/6 and falls from there to
 *             5/6. s(x) rises; its enclosure is found by Newton's iteration and
 *             proved by the residue, as the left side's slope is at least 1/2.
 *             Sines are Taylor's series of intervals; the remainder is below
 *             2^-59.
 * Means       where a colour is not narrow, Q and r are found once more, with
 *             bounds on their derivatives by sx and sy: by the mean value
 *             theorem they are in the value at the middle, and the derivatives
 *             times half a side to either side. That narrows with the square of
 *             the side, but for their true range. Where max(0, x) has no
 *             derivative, all between the two of its sides will do. */
#include "algorithms/hierarchical/bounded/surface.h"

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <cmath>

namespace {

using Interval = CGAL::Interval_nt<false>; /* only while an Upward lives */
using Upward = CGAL::Protect_FPU_rounding<true>;

/* A function of sx and sy on a square: its values, and its derivatives. */
struct Dual {
  Interval v, by[2] = {0, 0};
  Dual(const Interval &value = 0) : v(value) {}
  Dual(double value) : v(value) {}
};

Dual with(const Interval &value, const Interval &x, const Interval &y) {
  Dual made(value);
  made.by[0] = x;
  made.by[1] = y;
  return made;
}
Dual operator+(const Dual &a, const Dual &b) {
  return with(a.v + b.v, a.by[0] + b.by[0], a.by[1] + b.by[1]);
}
Dual operator-(const Dual &a, const Dual &b) {
  return with(a.v - b.v, a.by[0] - b.by[0], a.by[1] - b.by[1]);
}
Dual operator*(const Dual &a, const Dual &b) {
  return with(a.v * b.v, a.by[0] * b.v + a.v * b.by[0],
              a.by[1] * b.v + a.v * b.by[1]);
}
/* b is certain not to be 0. */
Dual operator/(const Dual &a, const Dual &b) {
  const Interval v = a.v / b.v;
  return with(v, (a.by[0] - v * b.by[0]) / b.v, (a.by[1] - v * b.by[1]) / b.v);
}

Interval square(const Interval &a) {
  return CGAL::square(a);
}
Dual square(const Dual &a) {
  const Interval twice = Interval(2) * a.v;
  return with(CGAL::square(a.v), twice * a.by[0], twice * a.by[1]);
}
/* Of what is certain to be positive. */
Interval root(const Interval &a) {
  return CGAL::sqrt(a);
}
Dual root(const Dual &a) {
  const Interval v = CGAL::sqrt(a.v), twice = Interval(2) * v;
  return with(v, a.by[0] / twice, a.by[1] / twice);
}

const Interval &value_of(const Interval &a) {
  return a;
}
const Interval &value_of(const Dual &a) {
  return a.v;
}

Interval clamp(const Interval &a, double least, double most) {
  return {std::min(most, std::max(least, a.inf())),
          std::max(least, std::min(most, a.sup()))};
}

/* Of a value that is known to be within these bounds. */
Interval within(double least, const Interval &a, double most) {
  return clamp(a, least, most);
}
Dual within(double least, const Dual &a, double most) {
  return with(clamp(a.v, least, most), a.by[0], a.by[1]);
}

Interval positive(const Interval &a) {
  return {std::max(0., a.inf()), std::max(0., a.sup())};
}
Dual positive(const Dual &a) {
  if (a.v.inf() >= 0)
    return a;
  const Interval some(0, a.v.sup() > 0 ? 1 : 0);
  return with(positive(a.v), some * a.by[0], some * a.by[1]);
}

template <class N> struct Vector_of { N x[3]; };
using Vector = Vector_of<Interval>;

template <class N> N operator*(const Vector_of<N> &a, const Vector_of<N> &b) {
  return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}

template <class N> Vector_of<N> vector(const double v[3]) {
  return {{N(v[0]), N(v[1]), N(v[2])}};
}

Vector hull(const Vector &a, const Vector &b) {
  return {{CGAL::hull(a.x[0], b.x[0]), CGAL::hull(a.x[1], b.x[1]),
           CGAL::hull(a.x[2], b.x[2])}};
}

/* Whether the length is certain not to be 0; then it becomes 1. */
template <class N> bool make_unit(Vector_of<N> *v) {
  const N sum = square(v->x[0]) + square(v->x[1]) + square(v->x[2]);
  if (!(value_of(sum).inf() > 0) || !(value_of(sum).sup() < INFINITY))
    return false;
  const N length = root(sum);
  for (N &x : v->x)
    x = within(-1, x / length, 1);
  return true;
}

/* --- Bumps ---------------------------------------------------------------- */

const Interval pi(3.14159265358979311, 3.14159265358979356);

/* sin 2πs, |s| <= 1/4. */
Interval sine_near_0(const Interval &s) {
  const Interval angle = Interval(2) * pi * s, squared = CGAL::square(angle);
  Interval sum(1);
  for (int n = 21; n > 1; n -= 2)
    sum = Interval(1) - squared / Interval(n * (n - 1)) * sum;
  return angle * sum + Interval(-0x1p-58, 0x1p-58);
}

/* sin 2πs of a narrow interval between -1 and 3. */
Interval sine(const Interval &s) {
  const double half = std::round(2 * s.inf()) / 2; /* s - half is near 0 */
  const Interval there = s - Interval(half);
  if (!(there.sup() < .26 && there.inf() > -.26))
    return {-1, 1};
  Interval value = sine_near_0(
      Interval(std::max(-.25, there.inf()), std::min(.25, there.sup())));
  /* It is symmetrical to 1/4, and to -1/4. */
  if (there.sup() > .25)
    value = CGAL::hull(
        value, CGAL::hull(Interval(1),
                          sine_near_0(Interval(.5) - Interval(there.sup()))));
  if (there.inf() < -.25)
    value = CGAL::hull(
        value, CGAL::hull(Interval(-1),
                          sine_near_0(Interval(-.5) - Interval(there.inf()))));
  return clamp(std::fmod(2 * half, 2) != 0 ? -value : value, -1, 1);
}

/* s where s - sin(2πs)/4π is x, 0 <= x <= 1. */
Interval wheel_at(double x) {
  double s = x;
  for (int k = 0; k < 8; k++) {
    const double angle = 6.283185307179586 * s;
    s -= (s - std::sin(angle) / 12.566370614359172 - x) /
         (1 - std::cos(angle) / 2);
    s = std::min(1., std::max(0., s));
  }
  const Interval residue =
      Interval(s) - sine(Interval(s)) / (Interval(4) * pi) - Interval(x);
  const double off = 2 * std::max(-residue.inf(), residue.sup());
  return {-(off - s), s + off}; /* both rounded outward */
}

const Interval steepest(.5773502691896257, .5773502691896258); /* 1/√3 */

Interval slope_at(const Interval &s) {
  return clamp(sine(s) / (Interval(2) - sine(s + Interval(.25))),
               -steepest.sup(), steepest.sup());
}

/* The stretch of s that belongs to one of x. */
struct Stretch {
  Interval first, last;
  bool is_known;

  explicit Stretch(const Interval &x) {
    const double whole = std::floor(x.inf());
    is_known = x.sup() - x.inf() < 1 && std::fabs(whole) < 0x1p30;
    if (!is_known)
      return;
    const double from = (Interval(x.inf()) - Interval(whole)).inf();
    const double to = (Interval(x.sup()) - Interval(whole)).sup();
    first = wheel_at(from);
    last = to < 1 ? wheel_at(to) : wheel_at(to - 1) + Interval(1);
  }
  /* Whether it may hold a place, or comes so near to it that an extreme there
   * is no more than the value at its end. */
  bool passes(double at) const {
    for (int k = 0; k < 3; k++)
      if (first.inf() <= at + k + 0x1p-40 && last.sup() >= at + k - 0x1p-40)
        return true;
    return false;
  }
};

Interval slope_on(const Stretch &s) {
  const double top = steepest.sup();
  if (!s.is_known)
    return {-top, top};
  const Interval ends = CGAL::hull(slope_at(s.first), slope_at(s.last));
  return {s.passes(5. / 6) ? -top : ends.inf(),
          s.passes(1. / 6) ? top : ends.sup()};
}

/* σ'(x) = 4π (2c - 1) / (2 - c)³, c = cos 2πs: least where c = -1/4, and rising
 * and falling from there. */
Interval derivative_on(const Stretch &s) {
  Interval c(-1, 1);
  if (s.is_known) {
    c = CGAL::hull(sine(s.first + Interval(.25)), sine(s.last + Interval(.25)));
    c = Interval(s.passes(.5) ? -1 : c.inf(), s.passes(0) ? 1 : c.sup());
  }
  const auto at = [](const Interval &cosine) {
    const Interval under = Interval(2) - cosine;
    return Interval(4) * pi * (Interval(2) * cosine - Interval(1)) /
           (CGAL::square(under) * under);
  };
  const Interval ends =
      CGAL::hull(at(Interval(c.inf())), at(Interval(c.sup())));
  return c.inf() < -.25 && c.sup() > -.25 ? CGAL::hull(ends, at(Interval(-.25)))
                                          : ends;
}

Interval slope(const Interval &x) {
  return slope_on(Stretch(x));
}
Dual slope(const Dual &x) {
  const Stretch s(x.v);
  const Interval by = derivative_on(s);
  return with(slope_on(s), by * x.by[0], by * x.by[1]);
}

/* --- The shader ----------------------------------------------------------- */

/* What a shader sees at a point of the face: Q of it, and r. */
template <class N> struct Optics { Vector_of<N> Q, r; };

/* Where the ray of -V, bent at m, comes to the board below P. */
template <class N>
bool refract(const hsr_shades &s, const hsr_shaded_face &face,
             const Vector_of<N> &V, const Vector_of<N> &m, Vector_of<N> *P) {
  const N index(HSR_SHADER_INDEX), one(1.);
  const N k = within(0, positive(m * V), 1);
  const N bend = root(one - square(index) * (one - square(k)));
  Vector_of<N> down;
  /* index (k m - V) - bend m, with m taken once */
  for (int c = 0; c < 3; c++)
    down.x[c] = (index * k - bend) * m.x[c] - index * V.x[c];
  const N sinking = N(0.) - down * vector<N>(face.normal);
  if (!(value_of(sinking).inf() > 0))
    return false;
  const N far = N(HSR_SHADER_DEPTH) * N(s.side) / sinking;
  for (int axis : {face.u, face.v})
    P->x[axis] = P->x[axis] + far * down.x[axis];
  return true;
}

template <class N>
bool tilt(const hsr_shades &s, const hsr_shaded_face &face,
          const Vector_of<N> &P, Vector_of<N> *m) {
  const N wave = N(HSR_SHADER_WAVE) * N(s.side);
  for (int axis : {face.u, face.v})
    m->x[axis] = m->x[axis] - N(HSR_SHADER_TILT) * slope(N(P.x[axis] / wave));
  return make_unit(m);
}

/* False if it may be anything. */
template <class N>
bool see(const hsr_shades &s, const hsr_shaded_face &face,
         const Vector_of<N> &P, Vector_of<N> V, Optics<N> *to) {
  Vector_of<N> m = vector<N>(face.normal);
  to->Q = P;
  if (s.parts == HSR_PART_BOARD)
    return true;
  if (!make_unit(&V))
    return false;
  if (s.parts & HSR_PART_BUMPS &&
      (!tilt(s, face, P, &m) || !refract(s, face, V, m, &to->Q)))
    return false;
  const N twice = N(2.) * within(-1, m * V, 1);
  for (int c = 0; c < 3; c++)
    to->r.x[c] = within(-1, twice * m.x[c] - V.x[c], 1);
  return true;
}

/* The board's factor. */
Interval squares(const hsr_shades &s, const hsr_shaded_face &face,
                 const Vector &P) {
  bool odd = false;
  for (int axis : {face.u, face.v}) {
    const Interval at = P.x[axis] / Interval(s.side);
    const double square = std::floor(at.inf());
    if (square != std::floor(at.sup()) || !(std::fabs(square) < 0x1p52))
      return {HSR_SHADER_DARK, 1};
    odd ^= std::fmod(square, 2) != 0;
  }
  return odd ? Interval(HSR_SHADER_DARK) : Interval(1);
}

/* A triangle's colours, by the areas that P makes with two corners each. */
void blend_corners(const hsr_surface &on, const Vector &P, Interval rgb[3]) {
  const int u = on.face.u, v = on.face.v;
  const auto twice = [&](const double *a, const double *b, const Interval &x,
                         const Interval &y) {
    return (Interval(b[u]) - Interval(a[u])) * (y - Interval(a[v])) -
           (Interval(b[v]) - Interval(a[v])) * (x - Interval(a[u]));
  };
  const Interval whole =
      twice(on.corner[0], on.corner[1], Interval(on.corner[2][u]),
            Interval(on.corner[2][v]));
  if (whole.inf() <= 0 && whole.sup() >= 0)
    return;
  Interval share[3];
  for (int k = 0; k < 3; k++)
    share[k] =
        twice(on.corner[(k + 1) % 3], on.corner[(k + 2) % 3], P.x[u], P.x[v]) /
        whole;
  for (int c = 0; c < 3; c++) {
    const uint16_t *a = on.face.corner[0], *b = on.face.corner[1],
                   *d = on.face.corner[2];
    /* The shares add up to 1: one of them is left out. */
    const Interval sum = Interval(a[c]) +
                         share[1] * Interval(double(b[c]) - a[c]) +
                         share[2] * Interval(double(d[c]) - a[c]);
    rgb[c] =
        clamp(sum, std::min({a[c], b[c], d[c]}), std::max({a[c], b[c], d[c]})) /
        Interval(65535);
  }
}

/* The colours before anything is mirrored; P is NULL if it may be anywhere. */
void begin_colours(const hsr_surface &on, const Vector *P, Interval rgb[3]) {
  for (int c = 0; c < 3; c++) {
    rgb[c] = Interval(on.face.rgb[c]) / Interval(65535);
    if (on.face.by_corners) {
      const auto range = std::minmax(
          {on.face.corner[0][c], on.face.corner[1][c], on.face.corner[2][c]});
      rgb[c] = Interval(range.first, range.second) / Interval(65535);
    }
  }
  if (on.face.by_corners && P)
    blend_corners(on, *P, rgb);
}

/* What lies between the whole ranges, where nothing else is known. */
void give_up(const hsr_shades &s, Interval rgb[3]) {
  for (int c = 0; c < 3 && s.parts & ~unsigned(HSR_PART_CORNERS); c++)
    rgb[c] = Interval(0, 1);
}

/* What follows of the optics for colours that are begun. */
void finish_colours(const hsr_shades &s, const hsr_surface &on,
                    const Optics<Interval> &seen, Interval rgb[3]) {
  const Interval one(1);
  if (s.parts & HSR_PART_BOARD) {
    const Interval factor = squares(s, on.face, seen.Q);
    for (int c = 0; c < 3; c++)
      rgb[c] = factor * rgb[c];
  }
  if (s.parts & HSR_PART_SKY) {
    const Interval up = positive(seen.r.x[1]), share(HSR_SHADER_REFLECTION);
    for (int c = 0; c < 3; c++) {
      const Interval low(hsr_sky_low[c]), high(hsr_sky_high[c]);
      rgb[c] = (one - share) * rgb[c] + share * (low + up * (high - low));
    }
  }
  if (s.parts & HSR_PART_HIGHLIGHT) {
    Interval shine = positive(seen.r * vector<Interval>(s.light));
    for (int k = 0; k < HSR_SHADER_GLOSS; k++)
      shine = CGAL::square(shine);
    shine = shine * Interval(HSR_SHADER_HIGHLIGHT);
    /* C + (1 - C) h, with C taken once */
    for (int c = 0; c < 3; c++)
      rgb[c] = one - (one - rgb[c]) * (one - shine);
  }
}

/* So narrow that nothing is gained by looking again. */
bool is_narrow(const Interval rgb[3]) {
  return rgb[0].sup() - rgb[0].inf() < 0x1p-8 &&
         rgb[1].sup() - rgb[1].inf() < 0x1p-8 &&
         rgb[2].sup() - rgb[2].inf() < 0x1p-8;
}

/* Is there more than what `begin_colours` says? */
bool has_optics(const hsr_shades &s) {
  return s.parts & ~unsigned(HSR_PART_CORNERS);
}

/* --- Squares -------------------------------------------------------------- */

/* D, or in parallel P - E. */
Vector ray_at(const hsr_view &view, double x, double y) {
  const Interval off(1 - 0x1p-52, 1 + 0x1p-52);
  Vector D;
  for (int k = 0; k < 3; k++)
    D.x[k] = off * Interval(view.ray[0][k]) +
             Interval(x) * (off * Interval(view.ray[1][k])) +
             Interval(y) * (off * Interval(view.ray[2][k]));
  return D;
}

Interval depth_at(const hsr_screen_line &q, double x, double y) {
  return Interval(q.a) * Interval(x) + Interval(q.b) * Interval(y) +
         Interval(q.c) + Interval(-q.error, q.error);
}

/* Where a face is at the four corners of a square. */
struct seen {
  Vector ray[4], point[4];
  Interval q[4];
  bool is_known; /* the points are, and between them it is no other */
};

seen look(const hsr_view &view, const hsr_screen_line &line,
          const hsr_square &square) {
  seen s;
  s.is_known = true;
  for (int c = 0; c < 4 && s.is_known; c++) {
    const double x = square.x + (c & 1 ? square.half : -square.half);
    const double y = square.y + (c & 2 ? square.half : -square.half);
    const Interval q = depth_at(line, x, y);
    s.q[c] = q;
    s.ray[c] = ray_at(view, x, y);
    s.is_known = q.sup() < INFINITY && (view.parallel || q.inf() > 0);
    for (int k = 0; k < 3 && s.is_known; k++)
      s.point[c].x[k] = Interval(view.E[k]) +
                        (view.parallel ? s.ray[c].x[k] - q * Interval(view.F[k])
                                       : s.ray[c].x[k] / q);
  }
  return s;
}

/* What is seen at the middle of a square. */
bool see_middle(const hsr_view &view, const hsr_screen_line &line,
                const hsr_square &square, const hsr_shades &s,
                const hsr_shaded_face &face, Optics<Interval> *to) {
  const Interval q = depth_at(line, square.x, square.y);
  const Vector ray = ray_at(view, square.x, square.y);
  Vector P, V;
  for (int k = 0; k < 3; k++) {
    const Interval F(view.F[k]);
    P.x[k] =
        Interval(view.E[k]) + (view.parallel ? ray.x[k] - q * F : ray.x[k] / q);
    V.x[k] = view.parallel ? -F : -ray.x[k];
  }
  return see(s, face, P, V, to);
}

/* The same of all points, with derivatives. They are those of the whole plane,
 * as the way from the middle to a point of the polygon may lead outside of it.
 * q's own ones are within 2 error of a and b, as q is linear on at least a
 * pixel. */
bool see_slopes(const hsr_view &view, const hsr_screen_line &line,
                const Vector &points, const Vector &directions,
                const Interval &q, const hsr_shades &s,
                const hsr_shaded_face &face, Optics<Dual> *to) {
  const Interval off(1 - 0x1p-52, 1 + 0x1p-52);
  const Interval error(-2 * line.error, 2 * line.error);
  const Interval slope[2] = {Interval(line.a) + error,
                             Interval(line.b) + error};
  Vector_of<Dual> P, V;
  for (int k = 0; k < 3; k++) {
    P.x[k] = Dual(points.x[k]);
    V.x[k] = Dual(directions.x[k]);
    for (int i = 0; i < 2; i++) {
      const Interval ray = off * Interval(view.ray[1 + i][k]);
      P.x[k].by[i] =
          view.parallel
              ? ray - slope[i] * Interval(view.F[k])
              : (ray - (points.x[k] - Interval(view.E[k])) * slope[i]) / q;
      V.x[k].by[i] = view.parallel ? Interval(0) : -ray;
    }
  }
  return see(s, face, P, V, to);
}

/* The mean value theorem. */
Interval narrowed(const Interval &all, const Interval &middle, const Dual &a,
                  double half) {
  const Interval by = CGAL::abs(a.by[0]) + CGAL::abs(a.by[1]);
  const double most = (Interval(half) * by).sup();
  const Interval near = middle + Interval(-most, most);
  const double low = std::max(all.inf(), near.inf()),
               high = std::min(all.sup(), near.sup());
  return low <= high ? Interval(low, high) : all;
}

/* All points of the plane in the square, where they are known. */
Vector between(const seen &s) {
  return hull(hull(s.point[0], s.point[1]), hull(s.point[2], s.point[3]));
}

/* All points of the polygon in the square. False if they may be anywhere. */
bool find_points(const hsr_surface &on, const seen &s, Vector *P) {
  if (s.is_known)
    *P = between(s);
  for (int k = 0; k < 3 && on.is_flat; k++)
    P->x[k] = s.is_known ? clamp(P->x[k], on.least[k], on.most[k])
                         : Interval(on.least[k], on.most[k]);
  return s.is_known || on.is_flat;
}

/* All directions to the eye. */
Vector find_directions(const hsr_view &view, const hsr_square &square) {
  if (view.parallel)
    return {{Interval(-view.F[0]), Interval(-view.F[1]), Interval(-view.F[2])}};
  Vector all;
  for (int c = 0; c < 4; c++) {
    const Vector D =
        ray_at(view, square.x + (c & 1 ? square.half : -square.half),
               square.y + (c & 2 ? square.half : -square.half));
    all = c ? hull(all, D) : D;
  }
  return {{-all.x[0], -all.x[1], -all.x[2]}};
}

/* Adds the optics of a square to colours that are begun. */
void shade_square(const hsr_shades &s, const hsr_surface &on,
                  const hsr_screen_line &line, const hsr_square &square,
                  const seen &at, const Vector &P, Interval rgb[3]) {
  const hsr_view &view = *s.view;
  const Vector V = find_directions(view, square);
  const Interval begun[3] = {rgb[0], rgb[1], rgb[2]};
  Optics<Interval> all, middle;
  Optics<Dual> slopes;
  if (!see(s, on.face, P, V, &all)) {
    give_up(s, rgb);
    return;
  }
  finish_colours(s, on, all, rgb);
  if (!at.is_known || s.parts == HSR_PART_BOARD || is_narrow(rgb))
    return;
  const Interval q =
      CGAL::hull(CGAL::hull(at.q[0], at.q[1]), CGAL::hull(at.q[2], at.q[3]));
  if (!see_middle(view, line, square, s, on.face, &middle) ||
      !see_slopes(view, line, between(at), V, q, s, on.face, &slopes))
    return;
  for (int c = 0; c < 3; c++) {
    if (c == on.face.u || c == on.face.v)
      all.Q.x[c] =
          narrowed(all.Q.x[c], middle.Q.x[c], slopes.Q.x[c], square.half);
    all.r.x[c] =
        narrowed(all.r.x[c], middle.r.x[c], slopes.r.x[c], square.half);
    rgb[c] = begun[c];
  }
  finish_colours(s, on, all, rgb);
}

} // namespace

extern "C" {

bool hsr_surface_make(struct hsr_surface *surface, struct hsr_shades *shades,
                      const struct hsr_shape *shape, bool is_flat) {
  if (!hsr_shades_face(shades, shape->id, &surface->face))
    return false;
  surface->is_flat = is_flat;
  for (int c = 0; c < 3; c++) {
    surface->least[c] = INFINITY;
    surface->most[c] = -INFINITY;
  }
  for (uint32_t k = 0; k < shape->n_corners; k++)
    for (int c = 0; c < 3; c++) {
      const double at = shape->corner[k][c];
      surface->least[c] = std::fmin(surface->least[c], at);
      surface->most[c] = std::fmax(surface->most[c], at);
      if (k < 3)
        surface->corner[k][c] = at;
    }
  return true;
}

struct hsr_interval hsr_bump_slope(struct hsr_interval at) {
  const Upward upward;
  const Interval found = slope(Interval(at.lo, at.hi));
  return {found.inf(), found.sup()};
}

void hsr_interval_shade(const struct hsr_shades *s,
                        const struct hsr_surface *surface,
                        const struct hsr_interval point[3],
                        const struct hsr_interval to_eye[3],
                        struct hsr_interval rgb[3]) {
  const Upward upward;
  Vector P, V;
  Interval found[3];
  for (int k = 0; k < 3; k++) {
    P.x[k] = Interval(point[k].lo, point[k].hi);
    V.x[k] = Interval(to_eye[k].lo, to_eye[k].hi);
  }
  Optics<Interval> seen;
  begin_colours(*surface, &P, found);
  if (has_optics(*s)) {
    if (see(*s, surface->face, P, V, &seen))
      finish_colours(*s, *surface, seen, found);
    else
      give_up(*s, found);
  }
  for (int c = 0; c < 3; c++)
    rgb[c] = {std::fmax(0, found[c].inf()), std::fmin(1, found[c].sup())};
}

void hsr_surface_colours(const struct hsr_shades *s,
                         const struct hsr_surface *surface,
                         const struct hsr_shape *shape,
                         const struct hsr_square *square, double low[3],
                         double high[3]) {
  const Upward upward;
  const hsr_view &view = *s->view;
  const seen at = look(view, shape->q, *square);
  Vector P;
  Interval all[3];
  if (surface->face.by_corners && at.is_known) {
    for (int c = 0; c < 4; c++) {
      Interval rgb[3];
      begin_colours(*surface, &at.point[c], rgb);
      for (int k = 0; k < 3; k++)
        all[k] = c ? CGAL::hull(all[k], rgb[k]) : rgb[k];
    }
  } else if (find_points(*surface, at, &P)) {
    begin_colours(*surface, &P, all);
    if (has_optics(*s))
      shade_square(*s, *surface, shape->q, *square, at, P, all);
  } else {
    begin_colours(*surface, NULL, all);
    give_up(*s, all);
  }
  for (int c = 0; c < 3; c++) {
    low[c] = std::fmax(0, all[c].inf());
    high[c] = std::fmin(1, all[c].sup());
  }
}

} /* extern "C" */
