/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The B-splines of the area picture against another formula for them: with
 * truncated powers, in place of pieces. A corner of a face, parallel to the axes,
 * gives products of one-dimensional integrals, which are compared exactly. A
 * triangle is compared with numerical integrals. Away from the borders the
 * B-splines of all pixels add up to 1, so a face's shares add up to its area. */
#include "tests/areas/shares.h"
#include "tests/tap.h"
#include "common/answers/kinds/area.h"

#include <algorithm>
#include <cmath>

namespace {

struct tap tests;

/* The integral of the B-spline of this degree up to u. */
template <class T> T integral_to(int degree, const T &u) {
  T sum = 0, binomial = 1;
  const int e = degree + 1;
  for (int k = 0; k <= e; k++) {
    const T x = u + T(e) / T(2) - T(k);
    T power = x;
    for (int i = 1; i < e; i++)
      power *= x;
    if (x > 0)
      sum += k % 2 ? T(-binomial * power) : T(binomial * power);
    binomial = binomial * T(e - k) / T(k + 1);
  }
  for (int i = 2; i <= e; i++)
    sum /= T(i);
  return sum;
}

/* Of pixel i of n, the share of [from, n]. */
mpq_class share_from(int degree, int n, int i, const mpq_class &from) {
  const mpq_class middle(2 * i + 1, 2);
  const mpq_class begin = integral_to(degree, mpq_class(0 - middle)),
                  end = integral_to(degree, mpq_class(n - middle));
  return (end - integral_to(degree, mpq_class(from - middle))) / (end - begin);
}

/* A face from (9/4, 27/8) to the lower right corner of the picture. */
void check_corner(int degree, bool parallel) {
  /* In perspective the depth is n, so that the corners are whole multiples. */
  const int n = parallel ? 8 : 7;
  const double x = 2.25, y = 3.375, scale = parallel ? 1.0 / n : 1;
  drawn scene(n, parallel);
  std::vector<std::array<double, 3>> corners = {{{2 * x - n, n - 2 * y, 0}},
                                                {{2 * x - n, double(-n), 0}},
                                                {{double(n), double(-n), 0}},
                                                {{double(n), n - 2 * y, 0}}};
  for (auto &c : corners)
    c = {c[0] * scale, c[1] * scale, double(-n)};
  scene.face_at(corners);
  const std::vector<shares> all =
      shares_of(scene.world(), scene.view(), hsr_area_filter(degree));
  bool good = true;
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++)
      good = good && share(all[size_t(j * n + i)], 0) ==
                         share_from(degree, n, i, mpq_class(x)) *
                             share_from(degree, n, j, mpq_class(y));
  ok(&tests, good, "degree %d, %s: a corner, in all %d pixels, exactly", degree,
     parallel ? "parallel" : "perspective", n * n);
}

/* ---- A triangle ---- */

struct place {
  double x, y;
};

/* Where the triangle is on the column at x. */
void column_of(const place t[3], double x, double *low, double *high) {
  *low = INFINITY;
  *high = -INFINITY;
  for (int k = 0; k < 3; k++) {
    const place &a = t[k], &b = t[(k + 1) % 3];
    if (a.x == b.x || x < std::min(a.x, b.x) || x > std::max(a.x, b.x))
      continue;
    const double y = a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
    *low = std::min(*low, y);
    *high = std::max(*high, y);
  }
}

/* The filter's integral over the triangle, for the pixel at (i, j), by Simpson's
 * rule between the places where something of x changes its formula. */
double numerical(const place t[3], int degree, int n, int i, int j) {
  std::vector<double> cuts = {t[0].x, t[1].x, t[2].x};
  for (int k = 0; k <= 2 * n; k++)
    cuts.push_back(k / 2.0);
  std::sort(cuts.begin(), cuts.end());
  const auto at = [&](double x) {
    double low, high;
    column_of(t, x, &low, &high);
    if (!(low < high))
      return 0.0;
    const double u = x - i - .5;
    const double slope = 1e-4; /* f by the difference of its integral */
    const double f = degree == 0 ? (std::fabs(u) < .5)
                                 : (integral_to(degree, u + slope) -
                                    integral_to(degree, u - slope)) /
                                       (2 * slope);
    return f * (integral_to(degree, high - j - .5) -
                integral_to(degree, low - j - .5));
  };
  double sum = 0;
  for (size_t k = 0; k + 1 < cuts.size(); k++) {
    const double a = cuts[k], b = cuts[k + 1];
    constexpr int steps = 200;
    if (b <= t[0].x || a >= t[2].x || !(a < b))
      continue;
    const double h = (b - a) / steps, in = 1e-9 * (b - a);
    for (int s = 0; s < steps; s++) {
      const double from = a + s * h + in, to = a + (s + 1) * h - in;
      sum += (to - from) / 6 * (at(from) + 4 * at((from + to) / 2) + at(to));
    }
  }
  return sum;
}

double weight(int degree, int n, int i) {
  return integral_to(degree, n - i - .5) - integral_to(degree, -i - .5);
}

/* In the middle of 8 x 8 pixels, 2 and more from the borders. */
void check_triangle(int degree) {
  constexpr int n = 8;
  const place t[3] = {{2.25, 3.5}, {3.875, 5.75}, {5.5, 2.125}};
  drawn scene(n, false);
  scene.face({{t[0].x, t[0].y, 2}, {t[1].x, t[1].y, 4}, {t[2].x, t[2].y, 1}});
  const std::vector<shares> all =
      shares_of(scene.world(), scene.view(), hsr_area_filter(degree));
  double worst = 0;
  mpq_class area = 0;
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) {
      const mpq_class got = share(all[size_t(j * n + i)], 0);
      worst = std::max(
          worst, std::fabs(got.get_d() -
                           numerical(t, degree, n, i, j) /
                               (weight(degree, n, i) * weight(degree, n, j))));
      mpq_class whole = 1; /* the filter's integral over the screen */
      for (const int k : {i, j}) {
        const mpq_class middle(2 * k + 1, 2);
        whole *= integral_to(degree, mpq_class(n - middle)) -
                 integral_to(degree, mpq_class(0 - middle));
      }
      area += got * whole;
    }
  /* The error of the numerical f is of the order of its step, at its kinks. */
  ok(&tests, worst < 2e-6, "degree %d: a triangle, by numerical integrals: %g",
     degree, worst);
  const mpq_class wanted =
      abs((mpq_class(t[1].x) - t[0].x) * (mpq_class(t[2].y) - t[0].y) -
          (mpq_class(t[2].x) - t[0].x) * (mpq_class(t[1].y) - t[0].y)) /
      2;
  ok(&tests, area == wanted, "degree %d: its shares add up to its area, %s",
     degree, wanted.get_str().c_str());
}

} // namespace

int main() {
  tests = plan(4 * 4);
  for (int degree = 0; degree < 4; degree++) {
    check_corner(degree, false);
    check_corner(degree, true);
    check_triangle(degree);
  }
  return finish(&tests);
}
