/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/judge/integral/path.h"

#include <algorithm>

namespace integral {

using CGAL::Gmpq;

namespace {

Interval interval_of(const Gmpq &x) {
  const std::pair<double, double> p = CGAL::to_interval(x);
  return {p.first, p.second};
}

} // namespace

ray::ray(const hsr_view &view, int i, int j) {
  const int W = view.whole_m, H = view.whole_n;
  const Gmpq sx = Gmpq(hsr_sample_x(&view, i)) + Gmpq(view.left),
             sy = Gmpq(hsr_sample_y(&view, j)) + Gmpq(view.top);
  const Gmpq x = (Gmpq(2) * sx - Gmpq(W)) / Gmpq(W),
             y = (Gmpq(H) - Gmpq(2) * sy) / Gmpq(H);
  for (size_t a = 0; a < 3; a++) {
    const Gmpq across = x * Gmpq(view.R[a]) + y * Gmpq(view.U[a]);
    exact_O[a] = Gmpq(view.E[a]);
    exact_D[a] = Gmpq(view.F[a]);
    (view.parallel ? exact_O : exact_D)[a] += across;
    O[a] = interval_of(exact_O[a]);
    D[a] = interval_of(exact_D[a]);
  }
}

namespace {

/* Where a ray passes a plane of samples. */
struct crossing {
  Interval depth;
  size_t axis;
  double plane;
};

Gmpq exact_depth(const ray &r, const crossing &c) {
  return (Gmpq(c.plane) - r.exact_O[c.axis]) / r.exact_D[c.axis];
}

/* By the exact depths, which are only computed where it matters. */
bool is_before(const ray &r, const crossing &a, const crossing &b) {
  if (a.depth.sup() < b.depth.inf())
    return true;
  if (b.depth.sup() < a.depth.inf())
    return false;
  return a.axis == b.axis
             ? (r.D[a.axis].inf() > 0 ? a.plane < b.plane : a.plane > b.plane)
             : exact_depth(r, a) < exact_depth(r, b);
}

bool is_behind(const ray &r, const crossing &c, double depth) {
  return c.depth.inf() > depth ||
         (c.depth.sup() > depth && exact_depth(r, c) > Gmpq(depth));
}

/* The box along an axis that a ray across it is in; -1: none. On a plane of
 * samples either box says the same. */
int box_beside(const field &f, const ray &r, size_t a) {
  const std::vector<double> &p = f.plane[a];
  const auto after = std::upper_bound(
      p.begin(), p.end(), r.exact_O[a],
      [](const Gmpq &x, double plane) { return x < Gmpq(plane); });
  if (after == p.begin() || r.exact_O[a] > Gmpq(p.back()))
    return -1;
  return std::min(int(after - p.begin()) - 1, f.n[a] - 2);
}

class cutter {
  const field &f_;
  const ray &r_;
  const double near_;
  std::vector<crossing> crossings_; /* behind `near`, in order */
  std::array<int, 3> at_, step_;

  void list_crossings(size_t axis);
  bool is_inside() const;

public:
  cutter(const field &f, const hsr_view &view, const ray &r)
      : f_(f), r_(r), near_(view.near) {}
  void run(std::vector<stretch> *out);
};

/* Those before `near` take the ray into the box where it begins. */
void cutter::list_crossings(size_t a) {
  const std::vector<double> &p = f_.plane[a];
  at_[a] = step_[a] > 0 ? -1 : f_.n[a] - 1;
  for (size_t k = 0; k < p.size(); k++) {
    const double plane = p[step_[a] > 0 ? k : p.size() - 1 - k];
    const crossing c = {(Interval(plane) - r_.O[a]) / r_.D[a], a, plane};
    if (is_behind(r_, c, near_))
      crossings_.push_back(c);
    else
      at_[a] += step_[a];
  }
}

bool cutter::is_inside() const {
  for (size_t a = 0; a < 3; a++)
    if (at_[a] < 0 || at_[a] > f_.n[a] - 2)
      return false;
  return true;
}

void cutter::run(std::vector<stretch> *out) {
  for (size_t a = 0; a < 3; a++) {
    step_[a] = int(CGAL::sign(r_.exact_D[a]));
    if (step_[a])
      list_crossings(a);
    else if ((at_[a] = box_beside(f_, r_, a)) < 0)
      return;
  }
  std::sort(crossings_.begin(), crossings_.end(),
            [this](const crossing &a, const crossing &b) {
              return is_before(r_, a, b);
            });
  Interval here(near_);
  unsigned entered = 0;
  for (size_t k = 0; k < crossings_.size();) {
    /* All planes that it passes at once. */
    const size_t first = k;
    Interval there = crossings_[k].depth;
    unsigned left = 0;
    const std::array<int, 3> at = at_;
    const bool inside = is_inside();
    for (; k < crossings_.size() &&
           !is_before(r_, crossings_[first], crossings_[k]);
         k++) {
      there = common(there, crossings_[k].depth);
      left |= 1u << crossings_[k].axis;
      at_[crossings_[k].axis] += step_[crossings_[k].axis];
    }
    if (inside)
      out->push_back({here, there, at, entered, left});
    here = there;
    entered = left;
  }
}

/* At a depth, on the upper or lower planes along some axes. */
point place_in_box(const field &f, const ray &r, const std::array<int, 3> &at,
                   const Interval &depth, unsigned on, bool is_end) {
  point u;
  for (size_t a = 0; a < 3; a++) {
    if (on >> a & 1) {
      u[a] = Interval((r.D[a].inf() > 0) == is_end ? 1 : 0);
      continue;
    }
    const double low = f.plane[a][size_t(at[a])],
                 high = f.plane[a][size_t(at[a]) + 1];
    const Interval place = r.O[a] + depth * r.D[a];
    u[a] = unit((place - Interval(low)) / (Interval(high) - Interval(low)));
  }
  return u;
}

} // namespace

void cut_ray(const field &f, const hsr_view &view, const ray &r,
             std::vector<stretch> *out) {
  out->clear();
  cutter(f, view, r).run(out);
}

point first_point(const field &f, const ray &r, const stretch &s) {
  return place_in_box(f, r, s.at, s.from, s.entered, false);
}

point last_point(const field &f, const ray &r, const stretch &s) {
  return place_in_box(f, r, s.at, s.to, s.left, true);
}

Interval length_in_box(const field &f, const ray &r, const stretch &s) {
  Interval square(0);
  for (size_t a = 0; a < 3; a++) {
    const double low = f.plane[a][size_t(s.at[a])],
                 high = f.plane[a][size_t(s.at[a]) + 1];
    square = square + CGAL::square(r.D[a] / (Interval(high) - Interval(low)));
  }
  return clamped(s.to - s.from, 0, infinity) * CGAL::sqrt(square);
}

} // namespace integral
