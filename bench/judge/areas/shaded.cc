/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/judge/areas/shaded.h"
#include "bench/judge/areas/moments.h"

#include <algorithm>
#include <cmath>

namespace areas {

namespace {

constexpr double MARGIN = 0x1p-44;

/* ---- The cycloid ---- */

constexpr long double TURN = 6.283185307179586476925286766559L;

/* s with s - sin(2πs)/4π = x, 0 <= x <= 1, but for some units in the last
 * place: by halving, since the left side rises. */
long double wheel_at(long double x) {
  long double from = 0, to = 1;
  for (int k = 0; k < 60; k++) {
    const long double s = (from + to) / 2;
    (s - std::sin(TURN * s) / (2 * TURN) < x ? from : to) = s;
  }
  return from;
}

/* The range of a function of period 1 that has its greatest value at `top` and
 * its least one half a period later. */
template <class F>
Interval periodic(long double from, long double to, long double top, F f) {
  const auto passes = [&](long double at) {
    return std::floor(to - at) > std::floor(from - at);
  };
  const long double a = f(from), b = f(to);
  return {passes(top + .5L) ? -1 : double(std::min(a, b)) - MARGIN,
          passes(top) ? 1 : double(std::max(a, b)) + MARGIN};
}

struct waves {
  Interval sine, cosine;
};

waves waves_of(const Interval &x) {
  const Nearest to_nearest;
  const double whole = std::floor(x.inf());
  if (!(x.sup() - x.inf() < 1) || std::fabs(whole) > 0x1p20)
    return {{-1, 1}, {-1, 1}};
  long double end[2] = {x.inf() - (long double)whole,
                        x.sup() - (long double)whole};
  for (long double &at : end)
    at = at < 1 ? wheel_at(at) : 1 + wheel_at(at - 1);
  end[0] -= MARGIN, end[1] += MARGIN;
  return {periodic(end[0], end[1], .25L,
                   [](long double s) { return std::sin(TURN * s); }),
          periodic(end[0], end[1], 0,
                   [](long double s) { return std::cos(TURN * s); })};
}

} // namespace

/* With the angle a, c = cos a, s = sin a: the slope is s / (2 - c), and da/dx
 * is 4π / (2 - c). */
slopes slope_of(const Interval &x) {
  const waves w = waves_of(x);
  const Interval &s = w.sine, &c = w.cosine, two(2);
  const Interval pi(3.14159265358979311, 3.14159265358979356);
  const Interval under = Interval(1) / (two - c);
  const Interval f = s * under;
  const Interval by_angle = (two * c - Interval(1)) * CGAL::square(under);
  const Interval again =
      -two * s * (Interval(1) + c) * under * CGAL::square(under);
  const Interval turning = Interval(4) * pi * under;
  const Interval turning_by_angle = -turning * s * under;
  return {f, by_angle * turning,
          (again * turning + by_angle * turning_by_angle) * turning};
}

/* ---- Triangles ---- */

namespace {

double low(const double v[3]) {
  return std::min({v[0], v[1], v[2]});
}
double high(const double v[3]) {
  return std::max({v[0], v[1], v[2]});
}

Interval between_0_and_1(const Interval &a) {
  return {std::min(1., std::max(0., a.inf())),
          std::min(1., std::max(0., a.sup()))};
}

double width_of(const Interval &a) {
  return a.sup() - a.inf();
}

/* Piece k of the filter, d! times. */
template <int O> jet<O> piece_at(int degree, int k, const jet<O> &x) {
  jet<O> sum(0.);
  for (int e = degree; e >= 0; e--)
    sum = sum * x + jet<O>(double(piece[degree][k][e]));
  return sum;
}

Interval area_of(const double x[3], const double y[3]) {
  const Interval a =
      (Interval(x[1]) - Interval(x[0])) * (Interval(y[2]) - Interval(y[0]));
  const Interval b =
      (Interval(x[2]) - Interval(x[0])) * (Interval(y[1]) - Interval(y[0]));
  return CGAL::abs(a - b) / Interval(2);
}

Interval centre_of(const double v[3]) {
  return (Interval(v[0]) + Interval(v[1]) + Interval(v[2])) / Interval(3);
}

/* The mean of (v - centre)² over a triangle. */
Interval moment_of(const double v[3], const Interval &centre) {
  Interval sum(0);
  for (int k = 0; k < 3; k++)
    sum += CGAL::square(Interval(v[k]) - centre);
  return sum / Interval(12);
}

} // namespace

/* f times the colour, on a rectangle of an atom. */
template <int O>
void shaded_pixel::look(const triangle &t, const Interval &x, const Interval &y,
                        jet<O> rgb[3]) const {
  jet<O> u(x), v(y);
  u.x = v.y = 1;
  const double half = (degree_ % 2) / 2.;
  const jet<O> sx = u + jet<O>(t.atom_x - half),
               sy = v + jet<O>(t.atom_y - half);
  if (!t.face) {
    for (int c = 0; c < 3; c++)
      rgb[c] = jet<O>(Interval(background_[c]) / Interval(65535));
  } else {
    const auto raise = [](const vec<Interval> &a) {
      return vec<jet<O>>{jet<O>(a.x), jet<O>(a.y), jet<O>(a.z)};
    };
    const frame<Interval> &f = on_.rough;
    /* mn times D, or P - E. */
    const vec<jet<O>> ray = raise(f.O) + sx * raise(f.X) + sy * raise(f.Y);
    const vec<jet<O>> N = raise(t.face->normal), E = raise(f.E);
    const jet<O> height(t.face->height), mn(f.mn);
    vec<jet<O>> P, to_eye;
    if (f.parallel) {
      const vec<jet<O>> F = raise(f.F), from = jet<O>(jet<O>(1.) / mn) * ray;
      P = E + from + jet<O>((height - dot(N, from)) / dot(N, F)) * F;
      to_eye = jet<O>(-1.) * F;
    } else {
      const vec<jet<O>> from_eye = jet<O>(height / dot(N, ray)) * ray;
      P = E + from_eye;
      to_eye = jet<O>(-1.) * from_eye;
    }
    shade(shading_, t.face->surface, P, to_eye, rgb);
  }
  for (int c = 0; c < 3; c++) {
    rgb[c].v = rgb[c].known ? between_0_and_1(rgb[c].v) : Interval(0, 1);
    rgb[c] = rgb[c] * piece_at(degree_, t.k, u) * piece_at(degree_, t.l, v);
  }
}

void shaded_pixel::bound(triangle *t) const {
  const Interval area = area_of(t->x, t->y);
  const Interval x(low(t->x), high(t->x)), y(low(t->y), high(t->y));
  jet<0> rough[3];
  look(*t, x, y, rough);
  double widest = 0;
  bool smooth = true;
  for (int c = 0; c < 3; c++) {
    t->part[c] = area * rough[c].v;
    widest = std::max(widest, width_of(t->part[c]));
    smooth = smooth && rough[c].known && rough[c].smooth;
  }
  if (smooth && widest > 0x1p-30) {
    const Interval gx = centre_of(t->x), gy = centre_of(t->y);
    const Interval mxx = moment_of(t->x, gx), myy = moment_of(t->y, gy);
    const double mixed = CGAL::sqrt(mxx * myy).sup();
    const Interval mxy(-mixed, mixed), half(.5);
    jet<0> middle[3];
    jet<2> all[3];
    look(*t, gx, gy, middle);
    look(*t, x, y, all);
    widest = 0;
    for (int c = 0; c < 3; c++) {
      const Interval mean = middle[c].v + half * all[c].xx * mxx +
                            all[c].xy * mxy + half * all[c].yy * myy;
      const Interval part = area * mean;
      if (all[c].known && all[c].smooth &&
          width_of(part) < width_of(t->part[c]))
        t->part[c] = part;
      widest = std::max(widest, width_of(t->part[c]));
    }
  }
  t->uncertainty = widest;
}

void shaded_pixel::add(const patch &p, int atom_x, int atom_y, int k, int l) {
  for (size_t i = 1; i + 1 < p.x.size(); i++) {
    triangle t = {{p.x[0], p.x[i], p.x[i + 1]},
                  {p.y[0], p.y[i], p.y[i + 1]},
                  p.face,
                  atom_x,
                  atom_y,
                  k,
                  l,
                  {},
                  0};
    bound(&t);
    all_.push_back(t);
  }
}

namespace {

/* The longest side, from its corner to the next one. */
template <class Triangle> int longest(const Triangle &t) {
  int best = 0;
  double most = -1;
  for (int k = 0; k < 3; k++) {
    const int next = (k + 1) % 3;
    const double length = std::hypot(t.x[next] - t.x[k], t.y[next] - t.y[k]);
    if (length > most)
      most = length, best = k;
  }
  return best;
}

} // namespace

void shaded_pixel::enclose(double width, size_t most, Interval sum[3]) {
  double uncertain = 0, slack = slack_;
  for (const triangle &t : all_)
    uncertain += t.uncertainty;
  std::make_heap(all_.begin(), all_.end());
  while (uncertain > width && all_.size() < most) {
    std::pop_heap(all_.begin(), all_.end());
    triangle one = all_.back(), two = one;
    all_.pop_back();
    uncertain -= one.uncertainty;
    const int k = longest(one), next = (k + 1) % 3;
    one.x[next] = two.x[k] = (one.x[k] + one.x[next]) / 2;
    one.y[next] = two.y[k] = (one.y[k] + one.y[next]) / 2;
    slack += 0x1p-50;
    for (triangle *t : {&one, &two}) {
      bound(t);
      uncertain += t->uncertainty;
      all_.push_back(*t);
      std::push_heap(all_.begin(), all_.end());
    }
  }
  /* f is at most 1; it is taken (d!)² times. */
  const double f = factorial[degree_];
  for (int c = 0; c < 3; c++) {
    sum[c] = Interval(-slack, slack);
    for (const triangle &t : all_)
      sum[c] += t.part[c] / Interval(f * f);
  }
}

} // namespace areas
