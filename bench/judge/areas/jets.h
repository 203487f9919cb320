/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions of the picture plane on a rectangle of it, in intervals: their
 * values and, in order 2, their first and second derivatives by sx and sy.
 *
 * known       false: a value may be anything, since something was divided by 0
 * smooth      false: the derivatives may not exist
 * Rounding    only while an Upward lives. Sines are taken of long doubles,
 *             rounded to nearest, and moved outward by 2^-44: far more than any
 *             C library is off. */
#ifndef HSR_BENCH_JUDGE_AREAS_JETS_H
#define HSR_BENCH_JUDGE_AREAS_JETS_H

#include "bench/judge/rounding.h"

namespace areas {

using judge::Interval;

template <int ORDER> struct jet {
  Interval v;
  Interval x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  bool known = true, smooth = true;

  jet(const Interval &value = 0) : v(value) {}
  jet(double value) : v(value) {}

  /* What a function with this value and these derivatives makes of it. */
  jet through(const Interval &f, const Interval &f1, const Interval &f2) const {
    jet made(f);
    made.known = known;
    made.smooth = smooth;
    if constexpr (ORDER == 2) {
      made.x = f1 * x;
      made.y = f1 * y;
      made.xx = f2 * CGAL::square(x) + f1 * xx;
      made.xy = f2 * x * y + f1 * xy;
      made.yy = f2 * CGAL::square(y) + f1 * yy;
    }
    return made;
  }
  static jet unknown() {
    jet made;
    made.known = made.smooth = false;
    return made;
  }
};

template <int O> jet<O> operator+(const jet<O> &a, const jet<O> &b) {
  jet<O> c(a.v + b.v);
  c.known = a.known && b.known;
  c.smooth = a.smooth && b.smooth;
  if constexpr (O == 2) {
    c.x = a.x + b.x, c.y = a.y + b.y;
    c.xx = a.xx + b.xx, c.xy = a.xy + b.xy, c.yy = a.yy + b.yy;
  }
  return c;
}

template <int O> jet<O> operator*(const jet<O> &a, const jet<O> &b) {
  jet<O> c(a.v * b.v);
  c.known = a.known && b.known;
  c.smooth = a.smooth && b.smooth;
  if constexpr (O == 2) {
    const Interval two(2);
    c.x = a.x * b.v + a.v * b.x;
    c.y = a.y * b.v + a.v * b.y;
    c.xx = a.xx * b.v + two * a.x * b.x + a.v * b.xx;
    c.xy = a.xy * b.v + a.x * b.y + a.y * b.x + a.v * b.xy;
    c.yy = a.yy * b.v + two * a.y * b.y + a.v * b.yy;
  }
  return c;
}

template <int O> jet<O> operator-(const jet<O> &a, const jet<O> &b) {
  return a + b * jet<O>(-1);
}

template <int O> jet<O> square(const jet<O> &a) {
  return a.through(CGAL::square(a.v), Interval(2) * a.v, Interval(2));
}

template <int O> jet<O> operator/(const jet<O> &a, const jet<O> &b) {
  if (!b.known || !(b.v.inf() > 0 || b.v.sup() < 0))
    return jet<O>::unknown();
  const Interval f = Interval(1) / b.v, f1 = -CGAL::square(f);
  return a * b.through(f, f1, Interval(-2) * f * f1);
}

/* Of what is not negative. */
template <int O> jet<O> root(const jet<O> &a) {
  if (!a.known || a.v.sup() < 0)
    return jet<O>::unknown();
  const Interval f = CGAL::sqrt(Interval(std::max(0., a.v.inf()), a.v.sup()));
  if (!(f.inf() > 0)) {
    jet<O> made(f);
    made.smooth = false;
    return made;
  }
  const Interval f1 = Interval(.5) / f;
  return a.through(f, f1, Interval(-.5) * f1 / CGAL::square(f));
}

/* max(0, a). */
template <int O> jet<O> positive(const jet<O> &a) {
  if (!a.known)
    return a;
  if (a.v.inf() >= 0)
    return a;
  jet<O> made(Interval(0, std::max(0., a.v.sup())));
  made.smooth = a.v.sup() <= 0;
  return made;
}

/* The slope of the curtate cycloid at x, and its first two derivatives. */
struct slopes {
  Interval f, f1, f2;
};
slopes slope_of(const Interval &x);

template <int O> jet<O> slope(const jet<O> &x) {
  if (!x.known)
    return x;
  const slopes s = slope_of(x.v);
  return x.through(s.f, s.f1, s.f2);
}

/* 1 on even squares, DARK on odd ones. */
template <int O> jet<O> squares(const jet<O> &u, const jet<O> &v, double dark) {
  const auto same = [](const Interval &a) {
    return std::floor(a.inf()) == std::floor(a.sup()) &&
           std::fabs(a.inf()) < 1e15;
  };
  jet<O> made(Interval(dark, 1));
  made.smooth = u.known && v.known && same(u.v) && same(v.v);
  if (made.smooth) {
    const bool odd =
        std::fmod(std::floor(u.v.inf()) + std::floor(v.v.inf()), 2) != 0;
    made.v = odd ? Interval(dark) : Interval(1);
  }
  return made;
}

} // namespace areas

#endif
