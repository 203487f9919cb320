/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables are linear between levels, so functions have bends. They are developed to
 * order 0, with an interval of the slope, which holds the slopes on both sides of
 * a bend: f(x) is in f(0) + slope x, and its integral over -1/2 .. 1/2 is known up
 * to 1/8 of the slope's width on either side. */
#include "bench/judge/integral/pieces.h"

namespace integral {

namespace {

constexpr int LAST = HSR_LEVELS - 1;

/* A table at levels from 0 to 255, of 65535: its values, and its slopes. */
struct looked_up {
  Interval value, slope;
};

template <class At> looked_up look_up(const At &at, const Interval &level) {
  const int lo = std::min(int(std::max(level.inf(), 0.0)), LAST - 1),
            hi = std::max(lo + 1, std::min(int(std::ceil(level.sup())), LAST));
  const auto between = [&](double x) {
    const int k = std::min(int(std::max(x, 0.0)), LAST - 1);
    const Interval part = unit(Interval(std::max(x, 0.0)) - Interval(k));
    return Interval(at(k)) + part * Interval(at(k + 1) - at(k));
  };
  looked_up found = {hull(between(level.inf()), between(level.sup())),
                     Interval(at(lo + 1) - at(lo))};
  for (int k = lo; k < hi; k++) {
    found.slope = hull(found.slope, Interval(at(k + 1) - at(k)));
    if (k > level.inf() && k < level.sup())
      found.value = hull(found.value, Interval(at(k)));
  }
  static const Interval part = Interval(1) / Interval(65535);
  return {found.value * part, found.slope * part};
}

/* What is mixed of samples. `kept` is that of POST_KEPT; the others are means over
 * the kept samples: levels, or numbers of 1. */
struct mixed {
  Interval kept, level, steep, bright, shine;
  std::array<Interval, 3> own;
};

/* What it looks like: lit colour, and how opaque. */
struct looks {
  looked_up opacity, gradient;
  std::array<looked_up, 3> table;         /* colours */
  std::array<Interval, 3> own, open, lit; /* `open` may exceed 1 */
  Interval alpha;
};

looks classify(const field &f, const mixed &m) {
  const hsr_palette &p = f.palette;
  looks l;
  l.opacity = look_up([&](int k) { return int(p.opacity[k]); }, m.level);
  l.gradient = look_up([&](int k) { return int(p.gradient[k]); }, m.steep);
  l.alpha = unit(m.kept * l.opacity.value * l.gradient.value);
  for (size_t c = 0; c < 3; c++) {
    if (!f.own)
      l.table[c] = look_up([&](int k) { return int(p.rgb[k][c]); }, m.level);
    l.own[c] = f.own ? m.own[c] : l.table[c].value;
    l.open[c] = l.own[c] * m.bright + m.shine;
    l.lit[c] = unit(l.open[c]);
  }
  return l;
}

} // namespace

post_piece::post_piece(const field &f, const uint16_t *const corner[8],
                       const point &from, const point &to,
                       const Interval &length)
    : of_(&f), length_(length) {
  for (size_t k = 0; k < size_t(f.parts); k++)
    part_[k] = cubic_on(corner, k, from, to);
}

void post_piece::split(post_piece *low, post_piece *high) const {
  low->of_ = high->of_ = of_;
  for (size_t k = 0; k < size_t(of_->parts); k++)
    part_[k].split(&low->part_[k], &high->part_[k]);
  low->length_ = high->length_ = length_ * Interval(0.5);
}

namespace {

/* The greatest value of a part. */
double most_of(size_t part) {
  return part == POST_KEPT                          ? 1
         : part == POST_LEVEL || part == POST_STEEP ? LAST
                                                    : 65535;
}

/* From means of parts, in their own units. */
template <class Mean>
mixed mix(const field &f, const Interval &kept, Mean mean) {
  static const Interval part = Interval(1) / Interval(65535);
  mixed m;
  m.kept = kept;
  m.level = mean(POST_LEVEL);
  m.steep = mean(POST_STEEP);
  m.bright = unit(mean(POST_BRIGHT) * part);
  m.shine = unit(mean(POST_SHINE) * part);
  for (size_t c = 0; f.own && c < 3; c++)
    m.own[c] = unit(mean(POST_OWN + c) * part);
  return m;
}

} // namespace

/* Opacity is at most that of the table. Where this rises by at least s a level, up
 * to level k, it is at most 1 - s (k - level) there; and kept (k - level) is a
 * polynomial, which is no more than k - level. Likewise where it falls. */
void post_piece::bound_depth(Interval *depth, const Interval &slope,
                             const Interval &level) const {
  const bool rises = slope.inf() > 0;
  if (!rises && !(slope.sup() < 0))
    return;
  const Interval k(rises ? std::ceil(level.sup()) : std::floor(level.inf())),
      by(rises ? slope.inf() : slope.sup());
  cubic most;
  for (size_t c = 0; c < 4; c++)
    most.b[c] =
        Interval(1) - by * (k * part_[POST_KEPT].b[c] - part_[POST_LEVEL].b[c]);
  const Interval found = depth_of(length_, Interval(0, 1), &most);
  *depth = {std::min(depth->inf(), found.sup()),
            std::min(depth->sup(), found.sup())};
}

effect post_piece::find() const {
  const cubic &kept = part_[POST_KEPT];
  const Interval kept_range = unit(kept.range());
  const mixed any = mix(*of_, kept_range, [&](size_t k) {
    return ratio(part_[k], kept, most_of(k));
  });
  const looks l = classify(*of_, any);
  effect e;
  e.depth = depth_of(length_, l.alpha, &kept);
  if (l.alpha.sup() >= 1)
    bound_depth(&e.depth, l.opacity.slope, any.level);
  e.opacity = Interval(1) - exp_minus(e.depth);
  e.colour = l.lit;
  for (size_t c = 0; c < 3; c++)
    e.emitted[c] = e.colour[c] * e.opacity;
  const Interval middle_kept = unit(kept.middle());
  if (!(l.alpha.sup() < 1) || !(l.alpha.sup() > 0) ||
      !(middle_kept.inf() > 0) || !(e.depth.sup() < 4))
    return e;

  static const Interval part = Interval(1) / Interval(65535);
  const mixed middle = mix(*of_, middle_kept, [&](size_t k) {
    return common(ratio(part_[k], kept, most_of(k)),
                  part_[k].middle() / middle_kept);
  });
  looks at = classify(*of_, middle);
  at.alpha = common(at.alpha, l.alpha);
  const Interval kept_slope = kept.slopes();
  /* kept times the slope of a mean */
  const auto slope = [&](size_t k, const Interval &mean) {
    return part_[k].slopes() - mean * kept_slope;
  };
  const Interval both = l.opacity.value * l.gradient.value;
  const Interval level_slope = slope(POST_LEVEL, any.level);
  const Interval alpha_slope =
      kept_slope * both + l.opacity.slope * l.gradient.value * level_slope +
      l.opacity.value * l.gradient.slope * slope(POST_STEEP, any.steep);

  const emission all(l.alpha, 2), here(at.alpha, 2);
  const Interval tau_slope = all.log[1] * alpha_slope;
  const double half_width =
      (Interval(tau_slope.sup()) - Interval(tau_slope.inf())).sup() * 0.125;
  const Interval found =
      length_ * (here.log[0] + Interval(-half_width, half_width));
  e.depth = narrowed(e.depth, found);
  e.opacity = narrowed(e.opacity,
                       Interval(1) - exp_minus(clamped(e.depth, 0, infinity)));

  const Interval before = clamped(
      length_ * (here.log[0] * Interval(0.5) - tau_slope * Interval(0.125)), 0,
      std::max(e.depth.sup(), 0.0));
  const Interval left((Interval(1) - e.opacity).inf(), 1),
      left_here = exp_minus(before);
  const Interval bright_slope =
                     slope(POST_BRIGHT, any.bright * Interval(65535)) * part,
                 shine_slope =
                     slope(POST_SHINE, any.shine * Interval(65535)) * part;
  for (size_t c = 0; c < 3; c++) {
    const Interval own_slope =
        of_->own ? slope(POST_OWN + c, any.own[c] * Interval(65535)) * part
                 : l.table[c].slope * level_slope;
    Interval lit_slope =
        own_slope * any.bright + l.own[c] * bright_slope + shine_slope;
    if (l.open[c].sup() >= 1)
      lit_slope = hull(lit_slope, Interval(0));
    const Interval colour = l.alpha * l.lit[c],
                   colour_slope = alpha_slope * l.lit[c] + both * lit_slope;
    const Interval rise =
        left * (colour_slope * all.g[0] + colour * all.g[1] * alpha_slope -
                colour * all.g[0] * length_ * all.log[0]);
    const double uncertain =
        (Interval(rise.sup()) - Interval(rise.inf())).sup() * 0.125;
    const Interval emitted =
        length_ * (at.alpha * at.lit[c] * here.g[0] * left_here +
                   Interval(-uncertain, uncertain));
    e.emitted[c] = narrowed(e.emitted[c], emitted);
  }
  return e;
}

} // namespace integral
