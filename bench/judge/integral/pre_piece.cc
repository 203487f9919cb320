/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/judge/integral/pieces.h"

namespace integral {

namespace {

Interval between(const Interval &a, const Interval &b, const Interval &at) {
  return a + at * (b - a);
}

} // namespace

cubic cubic_on(const uint16_t *const corner[8], size_t part, const point &from,
               const point &to) {
  const point *const end[2] = {&from, &to};
  int least = corner[0][part], most = least;
  Interval value[8];
  for (int c = 0; c < 8; c++) {
    const int v = corner[c][part];
    value[c] = v;
    least = std::min(least, v);
    most = std::max(most, v);
  }
  cubic made;
  if (least == most) {
    made.b.fill(value[0]);
    return made;
  }
  /* Axis by axis: along[x][y z], then along[x y][z], then at[x y z]. */
  Interval along_x[2][4], along_y[4][2], at[8];
  for (int x = 0; x < 2; x++)
    for (int k = 0; k < 4; k++)
      along_x[x][k] = between(value[2 * k], value[2 * k + 1], (*end[x])[0]);
  for (int xy = 0; xy < 4; xy++)
    for (int k = 0; k < 2; k++)
      along_y[xy][k] = between(along_x[xy & 1][2 * k],
                               along_x[xy & 1][2 * k + 1], (*end[xy >> 1])[1]);
  for (int c = 0; c < 8; c++)
    at[c] = between(along_y[c & 3][0], along_y[c & 3][1], (*end[c >> 2])[2]);
  const Interval three(3);
  made.b = {at[0], (at[1] + at[2] + at[4]) / three,
            (at[3] + at[5] + at[6]) / three, at[7]};
  for (Interval &b : made.b)
    b = clamped(b, least, most);
  return made;
}

/* With left_k = 1 - a_k and Bernstein's polynomials B_k, 1 - a >= left_k B_k for
 * each k, and the integral of -ln B_k is 3, 3 - ln 3, 3 - ln 3, 3. */
Interval depth_of(const Interval &length, const Interval &range,
                  const cubic *opacity) {
  const Interval left = Interval(1) - range;
  const double least = minus_log(std::min(left.sup(), 1.0)).inf();
  double most = minus_log(std::max(left.inf(), 0.0)).sup();
  if (opacity && most > 1)
    for (size_t k = 0; k < 4; k++) {
      const double here = (Interval(1) - opacity->b[k]).inf();
      if (here > 0)
        most = std::min(
            most,
            (minus_log(here) + Interval(k == 0 || k == 3 ? 3 : 1.9014)).sup());
    }
  /* Products of doubles are rounded upwards; either may be infinite. */
  const double shortest = length.inf(), longest = length.sup();
  return {shortest > 0 && least > 0 ? -(-shortest * least) : 0,
          longest > 0 && most > 0 ? longest * most : 0};
}

pre_piece::pre_piece(const field &, const uint16_t *const corner[8],
                     const point &from, const point &to, const Interval &length)
    : length_(length) {
  static const Interval part = Interval(1) / Interval(65535);
  for (size_t c = 0; c < 4; c++) {
    cubic &made = c < 3 ? colour_[c] : opacity_;
    made = cubic_on(corner, c, from, to);
    for (Interval &b : made.b)
      b = b.inf() == 65535 ? Interval(1) : unit(b * part);
  }
}

void pre_piece::split(pre_piece *low, pre_piece *high) const {
  for (int c = 0; c < 3; c++)
    colour_[c].split(&low->colour_[c], &high->colour_[c]);
  opacity_.split(&low->opacity_, &high->opacity_);
  low->length_ = high->length_ = length_ * Interval(0.5);
}

effect pre_piece::find() const {
  effect e;
  const Interval range = unit(opacity_.range());
  e.depth = depth_of(length_, range, &opacity_);
  e.opacity = Interval(1) - exp_minus(e.depth);
  for (size_t c = 0; c < 3; c++) {
    e.colour[c] = ratio(colour_[c], opacity_, 1);
    e.emitted[c] = e.colour[c] * e.opacity;
  }
  /* Not where derivatives say little. */
  const double left = (Interval(1) - Interval(range.sup())).inf();
  if (left > 0.1 * (1 - range.inf()) && range.sup() > 0 && e.depth.sup() < 4)
    develop(&e);
  return e;
}

namespace {

/* The terms of order 0 to `orders` - 1 of f(p), f being given by its derivatives
 * at p[0]. */
series composed(const series &f, const std::array<Interval, 4> &p, int orders) {
  series s;
  const Interval square = CGAL::square(p[1]);
  s[0] = f[0];
  s[1] = f[1] * p[1];
  s[2] = f[1] * p[2] + f[2] * square;
  const Interval twice = Interval(2) * p[1] * p[2];
  s[3] = f[1] * p[3] + f[2] * twice + f[3] * square * p[1];
  if (orders == ORDERS)
    s[4] = f[2] * (Interval(2) * p[1] * p[3] + CGAL::square(p[2])) +
           f[3] * Interval(3) * square * p[2] + f[4] * CGAL::square(square);
  return s;
}

/* exp(-d), whose term of order 0 is given, up to `orders` - 1. */
series decayed(const Interval &first, const series &d, int orders) {
  series e;
  e[0] = first;
  for (size_t k = 1; k < size_t(orders); k++) {
    Interval sum(0);
    for (size_t j = 1; j <= k; j++)
      sum = sum + Interval(double(j)) * d[j] * e[k - j];
    e[k] = -sum * inverse_of(int(k));
  }
  return e;
}

Interval term(const series &f, const series &g, size_t k) {
  Interval sum = f[0] * g[k];
  for (size_t j = 1; j <= k; j++)
    sum = sum + f[j] * g[k - j];
  return sum;
}

/* Of the optical depth, from its derivative tau: but for order 0. */
series depths(const Interval &length, const series &tau, int orders) {
  series d;
  for (size_t k = 1; k < size_t(orders); k++)
    d[k] = length * tau[k - 1] * inverse_of(int(k));
  return d;
}

} // namespace

/* Narrows an effect. */
void pre_piece::develop(effect *e) const {
  const auto middle = opacity_.at_middle(), any = opacity_.anywhere();
  const emission here(unit(middle[0]), 4), all(unit(any[0]), ORDERS);
  const series tau = composed(here.log, middle, 4),
               tau_all = composed(all.log, any, ORDERS);
  const Interval whole =
      length_ * (tau[0] + tau[2] / Interval(12) + tau_all[4] / Interval(80));
  e->depth = narrowed(e->depth, whole);
  e->opacity = narrowed(e->opacity,
                        Interval(1) -
                            exp_minus(Interval(std::max(e->depth.inf(), 0.0),
                                               std::max(e->depth.sup(), 0.0))));

  const Interval before =
      length_ * (tau[0] * Interval(0.5) - tau[1] * Interval(0.125) +
                 tau[2] / Interval(24) - tau[3] * Interval(0.015625) +
                 tau_all[4] / Interval(160));
  const Interval reached = clamped(before, 0, e->depth.sup());
  const series e_here = decayed(exp_minus(reached), depths(length_, tau, 4), 3),
               e_all = decayed(Interval((Interval(1) - e->opacity).inf(), 1),
                               depths(length_, tau_all, ORDERS), ORDERS);
  const series g_here = composed(here.g, middle, 4),
               g_all = composed(all.g, any, ORDERS);
  series w, w_all;
  for (size_t k = 0; k < 3; k++)
    w[k] = term(g_here, e_here, k);
  for (size_t k = 0; k < ORDERS; k++)
    w_all[k] = term(g_all, e_all, k);
  for (size_t c = 0; c < 3; c++) {
    const auto p = colour_[c].at_middle(), q = colour_[c].anywhere();
    const Interval fourth =
        q[0] * w_all[4] + q[1] * w_all[3] + q[2] * w_all[2] + q[3] * w_all[1];
    const Interval found =
        length_ * (p[0] * w[0] +
                   (p[0] * w[2] + p[1] * w[1] + p[2] * w[0]) / Interval(12) +
                   fourth / Interval(80));
    e->emitted[c] = narrowed(e->emitted[c], found);
  }
}

} // namespace integral
