/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A piece of a ray within one box of samples, and what it emits and absorbs.
 *
 * Along a piece whatever is interpolated is a cubic polynomial of the place on it,
 * from 0 to 1. It is held by Bernstein's coefficients, between whose least and
 * greatest its values are, and which a piece is halved by taking means of
 * (de Casteljau). Coefficients are intervals.
 *
 * Taylor      a function is developed about the middle of a piece up to order 3;
 *             the term of order 4 has an interval of its coefficient that holds
 *             it anywhere in the piece. What is integrated is then known up to
 *             1/80 of that interval's width.
 * Everywhere  only while doubles are rounded upwards. */
#ifndef HSR_BENCH_JUDGE_INTEGRAL_PIECES_H
#define HSR_BENCH_JUDGE_INTEGRAL_PIECES_H

#include "bench/judge/integral/field.h"
#include "bench/judge/integral/numbers.h"

namespace integral {

/* What a piece does, if all light reaches it. */
struct effect {
  Interval depth;                  /* optical: the integral of tau */
  Interval opacity;                /* 1 - exp(-depth) */
  std::array<Interval, 3> emitted; /* what leaves its front */
  std::array<Interval, 3> colour;  /* of any of its points */
};

inline Interval unit(const Interval &x) {
  return clamped(x, 0, 1);
}

/* A cubic polynomial on a piece. */
struct cubic {
  std::array<Interval, 4> b;

  double least() const {
    return std::min(std::min(b[0].inf(), b[1].inf()),
                    std::min(b[2].inf(), b[3].inf()));
  }
  double most() const {
    return std::max(std::max(b[0].sup(), b[1].sup()),
                    std::max(b[2].sup(), b[3].sup()));
  }
  Interval range() const { return {least(), most()}; }
  Interval mean() const { return (b[0] + b[1] + b[2] + b[3]) * Interval(0.25); }
  Interval slopes() const {
    return Interval(3) * hull(hull(b[1] - b[0], b[2] - b[1]), b[3] - b[2]);
  }
  Interval middle() const {
    return (b[0] + Interval(3) * (b[1] + b[2]) + b[3]) * Interval(0.125);
  }

  /* Taylor's coefficients in the middle, and those of any of the points. */
  std::array<Interval, 4> at_middle() const {
    const Interval bend = (b[0] - b[1]) + (b[3] - b[2]);
    return {middle(), Interval(0.75) * ((b[3] - b[0]) + (b[2] - b[1])),
            Interval(1.5) * bend, third()};
  }
  std::array<Interval, 4> anywhere() const {
    const Interval before = (b[2] - b[1]) - (b[1] - b[0]),
                   after = (b[3] - b[2]) - (b[2] - b[1]);
    return {range(), slopes(), Interval(3) * hull(before, after), third()};
  }

  void split(cubic *low, cubic *high) const {
    const Interval half(0.5), ab = (b[0] + b[1]) * half,
                              bc = (b[1] + b[2]) * half,
                              cd = (b[2] + b[3]) * half, abc = (ab + bc) * half,
                              bcd = (bc + cd) * half, all = (abc + bcd) * half;
    low->b = {b[0], ab, abc, all};
    high->b = {all, bcd, cd, b[3]};
  }

private:
  Interval third() const { return (b[3] - b[0]) - Interval(3) * (b[2] - b[1]); }
};

/* The polynomial of one part of the samples on the way from the point `from` of a
 * box to `to`, both from 0 to 1 along each axis; interpolation is linear along
 * each of them. So coefficient k is the mean of the values at the corners of the
 * way's own box with k coordinates of `to`. */
using point = std::array<Interval, 3>;
cubic cubic_on(const uint16_t *const corner[8], size_t part, const point &from,
               const point &to);

/* The quotient of two polynomials with a >= 0, which is at least 0 and at most
 * `most` where a > 0. */
inline Interval ratio(const cubic &c, const cubic &a, double most) {
  double lo = most, hi = 0;
  for (size_t k = 0; k < 4; k++) {
    if (!(a.b[k].sup() > 0))
      continue;
    lo = std::min(lo, (Interval(c.b[k].inf()) / Interval(a.b[k].sup())).inf());
    hi = a.b[k].inf() > 0
             ? std::max(hi,
                        (Interval(c.b[k].sup()) / Interval(a.b[k].inf())).sup())
         : c.b[k].sup() > 0 ? most
                            : hi;
  }
  lo = std::max(lo, 0.0);
  return {std::min(lo, most), std::max(std::min(hi, most), std::min(lo, most))};
}

/* What a path of this length in cells does at least and at most where opacity has
 * this range, and is not more than the polynomial, if there is one: where it
 * reaches 1, -ln(1 - a) has an integral all the same. */
Interval depth_of(const Interval &length, const Interval &range,
                  const cubic *opacity);

/* Pieces of either field have
 *   length()       at most, in cells
 *   find()         the effect
 *   split()        into halves */

/* Classified and then interpolated. */
class pre_piece {
  cubic colour_[3], opacity_;
  Interval length_; /* in cells */

  void develop(effect *e) const;

public:
  pre_piece() = default;
  pre_piece(const field &, const uint16_t *const corner[8], const point &from,
            const point &to, const Interval &length);
  double length() const { return length_.sup(); }
  effect find() const;
  void split(pre_piece *low, pre_piece *high) const;
  /* Of a channel, if nothing is absorbed. */
  Interval sum(size_t channel) const {
    return length_ * (channel < 3 ? colour_[channel] : opacity_).mean();
  }
};

/* Interpolated and then classified. */
class post_piece {
  const field *of_ = nullptr;
  std::array<cubic, MOST_PARTS> part_;
  Interval length_;

  void bound_depth(Interval *depth, const Interval &slope,
                   const Interval &level) const;

public:
  post_piece() = default;
  post_piece(const field &, const uint16_t *const corner[8], const point &from,
             const point &to, const Interval &length);
  double length() const { return length_.sup(); }
  effect find() const;
  void split(post_piece *low, post_piece *high) const;
};

} // namespace integral

#endif
