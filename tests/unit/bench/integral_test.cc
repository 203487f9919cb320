/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The intervals of bench/judge/integral: against closed forms; against a sum over
 * thousands of points a cell, written here a second time from docs/integral.md in
 * long doubles; and how they narrow.
 *
 * With -ln(1 - a) from a = p to q on one cell, the optical depth is
 *     (F(1 - p) - F(1 - q)) / (q - p), F(x) = x - x ln x:
 * of a ramp from 0 to 1 it is 1. */
#include "tests/unit/bench/checks.h"
#include "bench/judge/integral/integral.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace {

using Real = long double;
constexpr uint16_t ONE = 65535, NO_NORMAL = 4096;

/* ---- Grids and views ---- */

/* All samples of a grid; those that are kept can be chosen. */
class little_grid {
  std::array<std::vector<double>, 3> at_, bound_;
  std::vector<uint32_t> row_, x_;
  std::vector<uint8_t> level_, steep_;
  std::vector<uint16_t> normal_;
  std::vector<std::array<uint8_t, 3>> rgb_;

public:
  hsr_grid grid = {};

  /* keep(i, j, k) of a sample: its level, or -1. Palette: white, without light,
   * and opacities as the levels: level l is l 257 of 65535. */
  template <class Keep>
  little_grid(const std::array<std::vector<double>, 3> &at, Keep keep)
      : at_(at) {
    for (size_t a = 0; a < 3; a++) {
      const std::vector<double> &p = at_[a];
      const size_t n = p.size();
      for (size_t k = 1; k < n; k++)
        bound_[a].push_back(p[k - 1] / 2 + p[k] / 2);
      bound_[a].insert(bound_[a].begin(),
                       n > 1 ? 2 * p[0] - bound_[a][0] : p[0] - 0.5);
      bound_[a].push_back(n > 1 ? 2 * p[n - 1] - bound_[a][n - 1] : p[0] + 0.5);
      grid.n[a] = uint32_t(n);
      grid.at[a] = at_[a].data();
      grid.bound[a] = bound_[a].data();
    }
    for (uint32_t k = 0; k < grid.n[2]; k++)
      for (uint32_t j = 0; j < grid.n[1]; j++) {
        row_.push_back(uint32_t(x_.size()));
        for (uint32_t i = 0; i < grid.n[0]; i++) {
          const int level = keep(int(i), int(j), int(k));
          if (level < 0)
            continue;
          x_.push_back(i);
          level_.push_back(uint8_t(level));
          steep_.push_back(uint8_t(level * 7 % 256));
          normal_.push_back(NO_NORMAL);
          rgb_.push_back({uint8_t(level), uint8_t(255 - level), 100});
        }
      }
    row_.push_back(uint32_t(x_.size()));
    grid.n_cells = uint32_t(x_.size());
    grid.row = row_.data();
    grid.x = x_.data();
    grid.level = level_.data();
    grid.steep = steep_.data();
    grid.normal = normal_.data();
    for (int l = 0; l < HSR_LEVELS; l++) {
      grid.palette.opacity[l] = uint16_t(257 * l);
      grid.palette.gradient[l] = ONE;
      std::fill(grid.palette.rgb[l], grid.palette.rgb[l] + 3, ONE);
    }
    grid.palette.ambient = ONE;
    grid.palette.exponent = 1;
  }
  little_grid(const little_grid &) = delete;
  little_grid &operator=(const little_grid &) = delete;

  void set_normals(uint16_t code) {
    std::fill(normal_.begin(), normal_.end(), code);
  }
  void use_colours() {
    grid.rgb = reinterpret_cast<uint8_t(*)[3]>(rgb_.data());
    grid.palette.own_colours = true;
  }
};

std::vector<double> steps(int n, double by = 1, double from = 0) {
  std::vector<double> p;
  for (int k = 0; k < n; k++)
    p.push_back(from + k * by);
  return p;
}

/* Looks along -z from (x, y, z), with pixels `apart` from one another. */
hsr_view looking(double x, double y, double z, int m = 1, double apart = 1,
                 bool parallel = true) {
  hsr_view v = {};
  v.m = v.n = v.whole_m = v.whole_n = m;
  v.window = {0, 0, m, m};
  v.parallel = parallel;
  v.E[0] = x, v.E[1] = y, v.E[2] = z;
  v.F[2] = -1;
  v.R[0] = v.U[1] = m * apart / 2;
  return v;
}

using bounds = std::vector<std::array<double, 2>>;

hsr_status find(const hsr_grid &grid, const hsr_view &view,
                integral_options options, bounds *out,
                integral_reach *reach = nullptr) {
  integral_reach unused;
  hsr_error err;
  out->assign(4 * size_t(view.m) * size_t(view.n), {-1, -1});
  const hsr_status status = integral_find(
      &grid, &view, &options, reinterpret_cast<double(*)[2]>(out->data()),
      reach ? reach : &unused, &err);
  if (status && status != HSR_E_STOPPED)
    std::printf("# %s\n", err.text);
  return status;
}

integral_options asked(integral_field field, double width, int threads = 1) {
  return {field, width, threads, nullptr, nullptr};
}

/* Whether channel c of the first pixel holds a value and is narrow. */
void holds(const hsr_grid &grid, const hsr_view &view, integral_field field,
           double width, int c, Real value, const std::string &what) {
  bounds found;
  const bool done = find(grid, view, asked(field, width), &found) == HSR_OK;
  const auto [lo, hi] = found[size_t(c)];
  const Real slack = 1e-17L;
  const bool good =
      done && lo <= value + slack && value - slack <= hi && hi - lo <= width;
  ok(good, what);
  if (!good)
    std::printf("# wanted %.18Lg, got %.17g .. %.17g\n", value, lo, hi);
}

/* ---- Closed forms ---- */

Real ramp(Real p, Real q) {
  const auto F = [](Real x) { return x > 0 ? x - x * std::log(x) : 0; };
  return p == q ? -std::log(1 - p) : (F(1 - p) - F(1 - q)) / (q - p);
}

/* 9 x 9 samples of level l through `n` of them along z. */
template <class Level>
void along_z(int n, Level level, const std::string &what) {
  const auto all = [&](int, int, int k) { return level(k); };
  const little_grid g({steps(9), steps(9), steps(n)}, all);
  const auto a = [&](int k) { /* of sample k; -1: clear */
                              return k < 0 || k >= n || level(k) < 0
                                         ? 0
                                         : Real(level(k)) / 255;
  };
  Real depth = 0, sum = 0;
  for (int k = -1; k < n; k++) {
    depth += ramp(a(k), a(k + 1));
    sum += (a(k) + a(k + 1)) / 2;
  }
  const hsr_view view = looking(4.25, 4.5, 100);
  for (int c : {0, 3}) {
    const std::string channel = c == 3 ? ", opacity" : ", red";
    holds(g.grid, view, INTEGRAL_PRE, 1e-9, c, 1 - std::exp(-depth),
          what + channel);
    holds(g.grid, view, INTEGRAL_POST, 1e-5, c, 1 - std::exp(-depth),
          what + channel + ", classified after");
    holds(g.grid, view, INTEGRAL_SUMS, 1e-12, c, sum, what + channel + ", sum");
  }
}

void try_closed_forms() {
  along_z(
      12, [](int) { return 51; }, "a slab of opacity .2");
  along_z(
      2, [](int k) { return k ? 200 : 20; }, "a ramp");
  along_z(
      7, [](int k) { return k % 2 ? 0 : 250; }, "slats");
  along_z(
      7, [](int k) { return k % 3 ? 90 : -1; }, "gaps");
  along_z(
      1, [](int) { return 254; }, "a sheet");
  along_z(
      1, [](int) { return 255; }, "an opaque sheet");
  along_z(
      5, [](int k) { return k == 2 ? 255 : 30; }, "an opaque sheet within");

  for (double x : {0., .25, .625}) {
    const little_grid one({steps(1), steps(1), steps(1)},
                          [](int, int, int) { return 255; });
    const Real top = 1 - x;
    holds(one.grid, looking(x, 0, 9), INTEGRAL_PRE, 1e-9, 3,
          1 - std::exp(-2 * ramp(0, top)),
          "a single opaque sample, " + std::to_string(x) + " beside it");
  }
  /* Cells of 1 x 1 x 3 units: their own length counts. */
  const little_grid tall({steps(9), steps(9), steps(8, 3)},
                         [](int, int, int) { return 102; });
  holds(tall.grid, looking(4.5, 4.5, 100), INTEGRAL_PRE, 1e-9, 3,
        1 - std::exp(-7 * ramp(.4L, .4L) - 2 * ramp(0, .4L)),
        "long cells are as opaque as short ones");
}

void try_light() {
  /* Codes of (0, 0, 63), nearly, and of (63, 0, 0), nearly. */
  const auto lit = [](uint16_t code) {
    little_grid g({steps(9), steps(9), steps(4)},
                  [](int, int, int) { return 255; });
    g.set_normals(code);
    g.grid.palette.ambient = ONE / 5;
    g.grid.palette.diffuse = ONE - ONE / 5;
    g.grid.palette.eye_light = true;
    bounds found;
    find(g.grid, looking(4.5, 4.5, 20), asked(INTEGRAL_PRE, 1e-4), &found);
    return found[0];
  };
  const uint16_t towards = 31 + 64 * 31, across = 63 + 64 * 31;
  ok(lit(towards)[0] > .98 && lit(across)[1] < .3 && lit(across)[0] > .19,
     "a face towards the eye is lit, one across is in ambient light");
}

/* ---- A sum over many points ---- */

/* As docs/integral.md has it, at points. */
class definition {
  const hsr_grid &g_;
  integral_field field_;

  static Real table(const uint16_t *t, Real level, size_t stride, size_t c) {
    const int k = std::min(int(level), 254);
    const Real part = level - k;
    return (t[size_t(k) * stride + c] * (1 - part) +
            t[(size_t(k) + 1) * stride + c] * part) /
           65535;
  }
  Real plane(int a, int k) const {
    const int n = int(g_.n[a]);
    return k < 0    ? 2 * g_.bound[a][0] - g_.at[a][0]
           : k == n ? 2 * g_.bound[a][n] - g_.at[a][n - 1]
                    : g_.at[a][k];
  }
  bool is_kept(const std::array<int, 3> &at, uint32_t *cell) const {
    for (size_t a = 0; a < 3; a++)
      if (at[a] < 0 || at[a] >= int(g_.n[a]))
        return false;
    const uint32_t r = uint32_t(at[1]) + g_.n[1] * uint32_t(at[2]);
    for (*cell = g_.row[r]; *cell < g_.row[r + 1]; ++*cell)
      if (g_.x[*cell] == uint32_t(at[0]))
        return true;
    return false;
  }
  Real own(uint32_t cell, size_t c) const {
    const unsigned byte = g_.rgb[cell][c];
    return Real(65535u * byte * byte / 65025) / 65535;
  }

public:
  definition(const hsr_grid &g, integral_field field) : g_(g), field_(field) {}

  /* Premultiplied colours and opacity at a point, and the size of its box. */
  std::array<Real, 4> at(const std::array<Real, 3> &p,
                         std::array<Real, 3> *size) const {
    std::array<int, 3> low;
    std::array<Real, 3> part;
    for (int a = 0; a < 3; a++) {
      int k = -1;
      while (k + 1 < int(g_.n[a]) && plane(a, k + 1) <= p[size_t(a)])
        k++;
      low[size_t(a)] = k;
      (*size)[size_t(a)] = plane(a, k + 1) - plane(a, k);
      part[size_t(a)] = (p[size_t(a)] - plane(a, k)) / (*size)[size_t(a)];
      if (part[size_t(a)] < 0 || part[size_t(a)] > 1)
        return {0, 0, 0, 0};
    }
    const hsr_palette &pal = g_.palette;
    Real kept = 0, level = 0, steep = 0;
    std::array<Real, 3> mean = {};
    std::array<Real, 4> sum = {};
    for (int c = 0; c < 8; c++) {
      uint32_t cell;
      if (!is_kept({low[0] + (c & 1), low[1] + (c >> 1 & 1), low[2] + (c >> 2)},
                   &cell))
        continue;
      Real w = 1;
      for (int a = 0; a < 3; a++)
        w *= c >> a & 1 ? part[size_t(a)] : 1 - part[size_t(a)];
      const uint64_t A = uint64_t(pal.opacity[g_.level[cell]]) *
                         pal.gradient[g_.steep[cell]] / 65535;
      for (size_t k = 0; k < 3; k++) {
        const uint64_t lit = g_.rgb ? uint64_t(65535 * own(cell, k) + .5L)
                                    : pal.rgb[g_.level[cell]][k];
        sum[k] += w * Real(lit * A / 65535) / 65535;
        if (g_.rgb)
          mean[k] += w * own(cell, k);
      }
      sum[3] += w * Real(A) / 65535;
      kept += w;
      level += w * g_.level[cell];
      steep += w * g_.steep[cell];
    }
    if (field_ != INTEGRAL_POST || !(kept > 0))
      return sum;
    const Real alpha = kept * table(pal.opacity, level / kept, 1, 0) *
                       table(pal.gradient, steep / kept, 1, 0);
    for (size_t c = 0; c < 3; c++)
      sum[c] = alpha * (g_.rgb ? mean[c] / kept
                               : table(&pal.rgb[0][0], level / kept, 3, c));
    sum[3] = alpha;
    return sum;
  }

  /* Of a ray from the depth `near` on: `n` points between every two planes. */
  std::array<Real, 4> integral(const std::array<Real, 3> &O,
                               const std::array<Real, 3> &D, Real near,
                               int n) const {
    std::vector<Real> cut = {near};
    for (int a = 0; a < 3; a++)
      for (int k = -1; k <= int(g_.n[a]); k++) {
        const Real t = (plane(a, k) - O[size_t(a)]) / D[size_t(a)];
        if (t > near && t < 1e6L)
          cut.push_back(t);
      }
    std::sort(cut.begin(), cut.end());
    std::array<Real, 4> sum = {};
    Real depth = 0;
    for (size_t c = 0; c + 1 < cut.size(); c++)
      for (int k = 0; k < n; k++)
        add(O, D, cut[c] + (k + .5L) * (cut[c + 1] - cut[c]) / n,
            (cut[c + 1] - cut[c]) / n, &depth, &sum);
    return sum;
  }

private:
  void add(const std::array<Real, 3> &O, const std::array<Real, 3> &D, Real t,
           Real step, Real *depth, std::array<Real, 4> *sum) const {
    std::array<Real, 3> size;
    const auto here =
        at({O[0] + t * D[0], O[1] + t * D[1], O[2] + t * D[2]}, &size);
    if (!(here[3] > 0))
      return;
    Real length = 0;
    for (size_t a = 0; a < 3; a++)
      length += D[a] / size[a] * D[a] / size[a];
    length = std::sqrt(length) * step;
    const Real tau = -std::log1p(-here[3]) * length;
    const Real seen = field_ == INTEGRAL_SUMS
                          ? here[3] * length
                          : std::exp(-*depth) * -std::expm1(-tau);
    for (size_t c = 0; c < 4; c++)
      (*sum)[c] += here[c] / here[3] * seen;
    *depth += tau;
  }
};

/* A camera anywhere, with numbers that are not round. */
hsr_view random_view(std::mt19937 *random, const hsr_grid &g, bool inside,
                     bool parallel) {
  std::uniform_real_distribution<double> unit(-1, 1);
  hsr_view v = looking(0, 0, 0, 2, .3, parallel);
  double long_F = 0;
  for (int a = 0; a < 3; a++) {
    const double low = g.bound[a][0], high = g.bound[a][g.n[a]];
    v.F[a] = unit(*random);
    v.R[a] = .4 * unit(*random) * (parallel ? high - low : 1);
    v.U[a] = .4 * unit(*random) * (parallel ? high - low : 1);
    v.E[a] = (low + high) / 2;
    long_F += v.F[a] * v.F[a];
  }
  for (int a = 0; a < 3; a++) {
    v.F[a] /= std::sqrt(long_F);
    v.E[a] -= inside ? 0 : 15 * v.F[a];
  }
  v.near = inside ? .3 : 2;
  return v;
}

void compare(const little_grid &g, const hsr_view &view, integral_field field,
             double width, double slack, const std::string &what) {
  const definition by(g.grid, field);
  bounds found;
  integral_reach reach;
  if (find(g.grid, view, asked(field, width), &found, &reach) != HSR_OK) {
    ok(false, what);
    return;
  }
  double worst = 0, shown = 0;
  for (int j = 0; j < view.n; j++)
    for (int i = 0; i < view.m; i++) {
      const Real x = (2 * i + 1 - view.m) / Real(view.m),
                 y = (view.n - 2 * j - 1) / Real(view.n);
      std::array<Real, 3> O, D;
      for (size_t a = 0; a < 3; a++) {
        const Real across = x * view.R[a] + y * view.U[a];
        O[a] = view.E[a] + (view.parallel ? across : 0);
        D[a] = view.F[a] + (view.parallel ? 0 : across);
      }
      const auto wanted = by.integral(O, D, view.near, 500);
      for (size_t c = 0; c < 4; c++) {
        const auto [lo, hi] = found[4 * size_t(j * view.m + i) + c];
        worst =
            std::max({worst, double(lo - wanted[c]), double(wanted[c] - hi)});
        shown = std::max(shown, hi);
        if (std::getenv("VERBOSE"))
          std::printf("# %d %d %zu: %.12g .. %.12g, %.12Lg\n", i, j, c, lo, hi,
                      wanted[c]);
      }
    }
  ok(worst <= slack && reach.widest <= width && !reach.n_wide && shown > .02,
     what);
  if (worst > slack || reach.widest > width || !(shown > .02))
    std::printf("# off by %g; width %g; shown %g\n", worst, reach.widest,
                shown);
}

void try_many_points() {
  std::mt19937 random(7);
  const auto keep = [&](int, int, int) {
    return random() % 3 ? int(random() % 250) : -1;
  };
  const std::vector<double> uneven = {-2, -1.5, 0, .25, 2, 2.5};
  for (int k = 0; k < 12; k++) {
    const bool is_uneven = k % 3 == 2;
    little_grid g({is_uneven ? uneven : steps(7), steps(5, 1.25),
                   is_uneven ? uneven : steps(6, .75, -3)},
                  keep);
    for (int l = 0; l < HSR_LEVELS; l++)
      for (int c = 0; c < 3; c++) {
        g.grid.palette.rgb[l][c] = uint16_t(l * 257 * (c + 1) / 3);
        g.grid.palette.gradient[l] = uint16_t(ONE - 100 * (l % 64));
      }
    if (k % 2)
      g.use_colours();
    const bool inside = k % 4 == 1, parallel = k % 4 == 2;
    const hsr_view view = random_view(&random, g.grid, inside, parallel);
    const std::string what = std::string(inside     ? "from inside"
                                         : parallel ? "in parallel"
                                                    : "in perspective") +
                             (is_uneven ? ", uneven" : "") +
                             (k % 2 ? ", own colours" : "");
    /* The sum is off by the square of its steps, and where tables bend. */
    compare(g, view, INTEGRAL_PRE, 1e-7, 5e-7, "pre " + what);
    compare(g, view, INTEGRAL_POST, 2e-5, 5e-7, "post " + what);
    compare(g, view, INTEGRAL_SUMS, 1e-12, 5e-7, "sums " + what);
  }
}

/* ---- Narrower and narrower, and what is hostile ---- */

bool is_nested(const bounds &narrow, const bounds &wide) {
  for (size_t k = 0; k < wide.size(); k++)
    if (narrow[k][0] < wide[k][0] || narrow[k][1] > wide[k][1] ||
        narrow[k][0] > narrow[k][1])
      return false;
  return true;
}

double widest(const bounds &b) {
  double most = 0;
  for (const auto &[lo, hi] : b)
    most = std::max(most, hi - lo);
  return most;
}

void try_nested() {
  std::mt19937 random(3);
  const little_grid g({steps(8), steps(8), steps(8)}, [&](int, int, int) {
    return random() % 4 ? int(random() % 256) : -1;
  });
  const hsr_view view = random_view(&random, g.grid, false, false);
  for (integral_field field : {INTEGRAL_PRE, INTEGRAL_POST}) {
    bounds wide, narrow;
    find(g.grid, view, asked(field, 1), &wide);
    bool nested = true, narrows = true;
    for (double width : {.1, .01, .001, 1e-4, 1e-5}) {
      integral_reach reach;
      find(g.grid, view, asked(field, width), &narrow, &reach);
      nested = nested && is_nested(narrow, wide);
      narrows =
          narrows && widest(narrow) <= width && widest(narrow) == reach.widest;
      wide = narrow;
    }
    ok(nested, std::string(integral_fields[field].name) +
                   ": narrower intervals lie within wider ones");
    ok(narrows && widest(wide) > 0, std::string(integral_fields[field].name) +
                                        ": and are as narrow as asked");
  }
}

void try_hostile() {
  const auto opaque = [](int, int, int) { return 255; };
  const little_grid block({steps(5), steps(5), steps(5)}, opaque);
  bounds found;
  for (integral_field field : {INTEGRAL_PRE, INTEGRAL_POST}) {
    const std::string name = integral_fields[field].name;
    /* Rays through samples, and through the middles of edges. */
    find(block.grid, looking(2, 2, 50, 4, .5), asked(field, 1e-6), &found);
    ok(widest(found) <= 1e-6 && found[3][0] > .999999,
       name + ": an opaque block, along an axis");
    hsr_view diagonal = looking(50, 50, 50, 1);
    for (int a = 0; a < 3; a++)
      diagonal.F[a] = -1;
    diagonal.U[2] = .5;
    find(block.grid, diagonal, asked(field, 1e-6), &found);
    ok(widest(found) <= 1e-6 && found[3][0] > .999999,
       name + ": an opaque block, through corners of its boxes");
    find(block.grid, looking(2, 2, 2, 3, .3, false), asked(field, 1e-6),
         &found);
    ok(widest(found) <= 1e-6 && found[3][0] > .999999,
       name + ": an opaque block, from inside");

    const little_grid two({steps(2), steps(2), steps(2)},
                          [](int i, int j, int k) {
                            return i == 0 && j == 0 && k == 0   ? 255
                                   : i == 1 && j == 1 && k == 1 ? 100
                                                                : -1;
                          });
    find(two.grid, diagonal, asked(field, 1e-4), &found);
    ok(widest(found) <= 1e-4 && found[3][0] > .8 && found[3][1] < .99,
       name + ": along a diagonal through an opaque sample: " +
           std::to_string(found[3][0]));
  }
  const little_grid empty({steps(3), steps(3), steps(3)},
                          [](int, int, int) { return -1; });
  find(empty.grid, looking(1, 1, 9, 3), asked(INTEGRAL_PRE, 1e-3), &found);
  ok(widest(found) == 0 && found[0][0] == 0, "an empty grid is black");
  find(block.grid, looking(1, 1, -9, 3), asked(INTEGRAL_PRE, 1e-3), &found);
  ok(widest(found) == 0, "a grid behind the eye is black");
  hsr_view cut = looking(2, 2, 50);
  cut.near = 60;
  find(block.grid, cut, asked(INTEGRAL_PRE, 1e-3), &found);
  ok(widest(found) == 0, "what is before `near` is not there");

  /* Round numbers beside numbers that are rounded far off. */
  const double far = 1e9;
  const little_grid away({steps(5, 1, far), steps(5, 1, far), steps(5, 1, far)},
                         [](int i, int j, int k) { return 20 * (i + j + k); });
  const little_grid here({steps(5), steps(5), steps(5)},
                         [](int i, int j, int k) { return 20 * (i + j + k); });
  bounds near;
  find(away.grid, looking(far + 2.3, far + 1.7, far + 50),
       asked(INTEGRAL_PRE, 1e-4), &found);
  find(here.grid, looking(2.3, 1.7, 50), asked(INTEGRAL_PRE, 1e-4), &near);
  ok(widest(found) <= 1e-4 && std::abs(found[3][0] - near[3][0]) < 3e-4,
     "a grid that is far from the origin");
}

bool stop_at_2(void *seen, size_t rows, size_t all) {
  *static_cast<size_t *>(seen) = rows;
  return rows < 2 && all == 6;
}

void try_calls() {
  std::mt19937 random(5);
  const little_grid g({steps(6), steps(6), steps(6)},
                      [&](int, int, int) { return int(random() % 256); });
  const hsr_view view = looking(2.5, 2.5, 30, 6);
  bounds one, three;
  integral_reach reach;
  find(g.grid, view, asked(INTEGRAL_PRE, 1e-4), &one);
  find(g.grid, view, asked(INTEGRAL_PRE, 1e-4, 3), &three);
  ok(one == three, "the same on three threads");
  size_t seen = 0;
  const integral_options stopped = {INTEGRAL_PRE, 1e-4, 1, stop_at_2, &seen};
  ok(find(g.grid, view, stopped, &one) == HSR_E_STOPPED && seen == 2,
     "work is told of, and stops");
  find(g.grid, looking(2.2, 2.4, 30), asked(INTEGRAL_PRE, 1e-18), &one, &reach);
  ok(reach.n_wide > 0 && reach.widest < 1e-11,
     "what is too much to ask is told, and comes close");
  hsr_view part = view;
  part.window = {2, 1, 4, 3};
  find(g.grid, part, asked(INTEGRAL_PRE, 1e-4), &one);
  ok(one[0][0] == -1 && one[4 * (1 * 6 + 2)] == three[4 * (1 * 6 + 2)],
     "a window has the pixels of the whole");
  hsr_view tile = view;
  tile.m = tile.n = 3;
  tile.left = 3;
  tile.window = {0, 0, 3, 3};
  find(g.grid, tile, asked(INTEGRAL_PRE, 1e-4), &one);
  ok(one[0] == three[4 * 3], "a tile has the pixels of the whole");

  bool all = true;
  int n = 0;
  for (; n < 20000; n += 1 + n / 4) {
    allocations_left = n;
    integral_reach unused;
    hsr_error err;
    const integral_options o = asked(INTEGRAL_PRE, 1e-2);
    const hsr_status status = integral_find(
        &g.grid, &view, &o, reinterpret_cast<double(*)[2]>(three.data()),
        &unused, &err);
    allocations_left = -1;
    if (status == HSR_OK)
      break;
    all = all && status == HSR_E_NOMEM;
  }
  ok(all && n > 2 && n < 20000, "memory that runs out is told of");
}

} // namespace

int main() {
  try_closed_forms();
  try_light();
  try_many_points();
  try_nested();
  try_hostile();
  try_calls();
  return finish();
}
