/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notation    P the point; V the direction to the eye; n, m the normals of the face
 *             and of the bumps; Q the point of the board that is seen through them;
 *             r the direction that is mirrored. docs/area-picture.md has the
 *             formulas.
 * Points      on a plane q = 1/t is linear on the screen, and P = E + D/q, so each
 *             coordinate of P is a quotient of two linear functions. On a square
 *             where q is positive it is monotone along both sides: its range is that
 *             of the four corners. In parallel P is linear itself. Likewise
 *             Gouraud's colours, which are affine on the plane. Where q may be 0,
 *             P is in the box of the face's corners, if the face is flat.
 * Bumps       the slope σ rises for s from -1/6 to 1/6 and falls from there to 5/6.
 *             s(x) rises; its enclosure is found by Newton's iteration and proved by
 *             the residue, as the left side's slope is at least 1/2. Sines are
 *             Taylor's series of intervals; the remainder is below 2^-59. */
#include "algorithms/hierarchical/bounded/surface.h"

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <cmath>

namespace {

using Interval = CGAL::Interval_nt<false>; /* only while an Upward lives */
using Upward = CGAL::Protect_FPU_rounding<true>;

struct Vector {
  Interval x[3];
};

Interval operator*(const Vector &a, const Vector &b) {
  return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}

Vector vector(const double v[3]) {
  return {{Interval(v[0]), Interval(v[1]), Interval(v[2])}};
}

/* k a - b */
Vector minus(const Interval &k, const Vector &a, const Vector &b) {
  return {{k * a.x[0] - b.x[0], k * a.x[1] - b.x[1], k * a.x[2] - b.x[2]}};
}

Vector hull(const Vector &a, const Vector &b) {
  return {{CGAL::hull(a.x[0], b.x[0]), CGAL::hull(a.x[1], b.x[1]),
           CGAL::hull(a.x[2], b.x[2])}};
}

Interval clamp(const Interval &a, double least, double most) {
  return {std::min(most, std::max(least, a.inf())),
          std::max(least, std::min(most, a.sup()))};
}

Interval positive(const Interval &a) {
  return {std::max(0., a.inf()), std::max(0., a.sup())};
}

/* Of a number that cannot be negative. */
Interval root(const Interval &a) {
  return CGAL::sqrt(positive(a));
}

/* Whether the length is certain not to be 0; then it becomes 1. */
bool make_unit(Vector *v) {
  Interval sum(0);
  for (const Interval &x : v->x)
    sum += CGAL::square(x);
  const Interval length = CGAL::sqrt(sum);
  if (!(length.inf() > 0) || !(length.sup() < INFINITY))
    return false;
  for (Interval &x : v->x)
    x = clamp(x / length, -1, 1);
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

Interval slope(const Interval &x) {
  const double whole = std::floor(x.inf()), top = steepest.sup();
  if (!(x.sup() - x.inf() < 1) || !(std::fabs(whole) < 0x1p30))
    return {-top, top};
  const double from = (Interval(x.inf()) - Interval(whole)).inf();
  const double to = (Interval(x.sup()) - Interval(whole)).sup();
  const Interval first = wheel_at(from);
  const Interval last = to < 1 ? wheel_at(to) : wheel_at(to - 1) + Interval(1);
  const Interval ends = CGAL::hull(slope_at(first), slope_at(last));
  /* Near an extreme the ends are as good as it is. */
  const auto passes = [&](double at) {
    return first.inf() <= at + 0x1p-40 && last.sup() >= at - 0x1p-40;
  };
  const bool highest = passes(1. / 6) || passes(7. / 6);
  const bool lowest = passes(5. / 6) || passes(11. / 6);
  return {lowest ? -top : ends.inf(), highest ? top : ends.sup()};
}

/* --- The shader ----------------------------------------------------------- */

/* Where the ray of -V, bent at m, comes to the board below P. */
bool refract(const hsr_shades &s, const hsr_shaded_face &face, const Vector &V,
             const Vector &m, Vector *P) {
  const Interval index(HSR_SHADER_INDEX), one(1);
  const Interval k = clamp(m * V, 0, 1);
  const Interval bend =
      root(one - CGAL::square(index) * (one - CGAL::square(k)));
  Vector down;
  /* index (k m - V) - bend m, with m taken once */
  for (int c = 0; c < 3; c++)
    down.x[c] = (index * k - bend) * m.x[c] - index * V.x[c];
  const Interval sinking = -(down * vector(face.normal));
  if (!(sinking.inf() > 0))
    return false;
  const Interval far = Interval(HSR_SHADER_DEPTH) * Interval(s.side) / sinking;
  for (int c = 0; c < 3; c++)
    P->x[c] += far * down.x[c];
  return true;
}

bool tilt(const hsr_shades &s, const hsr_shaded_face &face, const Vector &P,
          Vector *m) {
  const Interval wave = Interval(HSR_SHADER_WAVE) * Interval(s.side);
  for (int axis : {face.u, face.v})
    m->x[axis] -= Interval(HSR_SHADER_TILT) * slope(P.x[axis] / wave);
  return make_unit(m);
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

/* The colours before anything is mirrored. */
void begin_colours(const hsr_surface &on, const Vector &P, Interval rgb[3]) {
  for (int c = 0; c < 3; c++) {
    rgb[c] = Interval(on.face.rgb[c]) / Interval(65535);
    if (on.face.by_corners) {
      const auto range = std::minmax(
          {on.face.corner[0][c], on.face.corner[1][c], on.face.corner[2][c]});
      rgb[c] = Interval(range.first, range.second) / Interval(65535);
    }
  }
  if (on.face.by_corners)
    blend_corners(on, P, rgb);
}

/* What lies between the whole ranges, where nothing else is known. */
void give_up(const hsr_shades &s, Interval rgb[3]) {
  for (int c = 0; c < 3 && s.parts & ~unsigned(HSR_PART_CORNERS); c++)
    rgb[c] = Interval(0, 1);
}

void shade(const hsr_shades &s, const hsr_surface &on, const Vector &P,
           Vector V, Interval rgb[3]) {
  const Interval one(1);
  Vector m = vector(on.face.normal), Q = P;
  begin_colours(on, P, rgb);
  if (!(s.parts & ~unsigned(HSR_PART_CORNERS)))
    return;
  const bool needs_eye = s.parts & ~unsigned(HSR_PART_BOARD);
  if ((needs_eye && !make_unit(&V)) ||
      (s.parts & HSR_PART_BUMPS &&
       (!tilt(s, on.face, P, &m) || !refract(s, on.face, V, m, &Q)))) {
    give_up(s, rgb);
    return;
  }
  if (s.parts & HSR_PART_BOARD) {
    const Interval factor = squares(s, on.face, Q);
    for (int c = 0; c < 3; c++)
      rgb[c] = factor * rgb[c];
  }
  if (!(s.parts & (HSR_PART_SKY | HSR_PART_HIGHLIGHT)))
    return;
  const Vector r = minus(Interval(2) * clamp(m * V, -1, 1), m, V);
  if (s.parts & HSR_PART_SKY) {
    const Interval up = clamp(r.x[1], 0, 1), share(HSR_SHADER_REFLECTION);
    for (int c = 0; c < 3; c++) {
      const Interval low(hsr_sky_low[c]), high(hsr_sky_high[c]);
      rgb[c] = (one - share) * rgb[c] + share * (low + up * (high - low));
    }
  }
  if (s.parts & HSR_PART_HIGHLIGHT) {
    Interval shine = positive(r * vector(s.light));
    for (int k = 0; k < HSR_SHADER_GLOSS; k++)
      shine = CGAL::square(shine);
    shine = shine * Interval(HSR_SHADER_HIGHLIGHT);
    /* C + (1 - C) h, with C taken once */
    for (int c = 0; c < 3; c++)
      rgb[c] = one - (one - rgb[c]) * (one - shine);
  }
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
    s.ray[c] = ray_at(view, x, y);
    s.is_known = q.sup() < INFINITY && (view.parallel || q.inf() > 0);
    for (int k = 0; k < 3 && s.is_known; k++)
      s.point[c].x[k] = Interval(view.E[k]) +
                        (view.parallel ? s.ray[c].x[k] - q * Interval(view.F[k])
                                       : s.ray[c].x[k] / q);
  }
  return s;
}

/* All points of the polygon in the square. False if they may be anywhere. */
bool find_points(const hsr_surface &on, const seen &s, Vector *P) {
  if (s.is_known) {
    *P = s.point[0];
    for (int c = 1; c < 4; c++)
      *P = hull(*P, s.point[c]);
  }
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
  shade(*s, *surface, P, V, found);
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
      begin_colours(*surface, at.point[c], rgb);
      for (int k = 0; k < 3; k++)
        all[k] = c ? CGAL::hull(all[k], rgb[k]) : rgb[k];
    }
  } else if (find_points(*surface, at, &P)) {
    shade(*s, *surface, P, find_directions(view, *square), all);
  } else {
    begin_colours(*surface, P, all);
    give_up(*s, all);
  }
  for (int c = 0; c < 3; c++) {
    low[c] = std::fmax(0, all[c].inf());
    high[c] = std::fmin(1, all[c].sup());
  }
}

} /* extern "C" */
