/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The splat oracle: the right picture of a grid's splats, pixel after pixel,
 * from the definition alone.
 *
 * Source      docs/composited-picture.md, in whose words this file is written.
 * Input       the grid's arrays and its palette; the view's E, F, R, U, near,
 *             m, n, offsets and window, but not its matrices; the view before;
 *             the options. The views between two views are doubles by
 *             definition, too. It is checked that they are on the way. With
 *             those whom it judges it shares no order, no normals, no tables
 *             and no numbers.
 * Notation    as there. A vector with a prime is `in_cells`. What is called
 *             `scale` is 1024 / (g^2 r^2).
 * Method      for every pixel, the splats in sequence are gathered and then
 *             composited. Each floor is sought in CGAL's interval arithmetic;
 *             where the interval has more than one, it is taken in rational
 *             numbers. Roots are compared by their squares. The kernels are
 *             integrated by Gauss' quadrature.
 * Invariants  a splat is left out of a window only if it covers no pixel of it:
 *             find_box() has the proof.
 * Ties        none: all floors are exact. No entry of a table is near a half.
 * Departures  none: there is no paper.
 * Cost        a splat costs eight projected corners a window, or 16 if it is
 *             blurred, and a few dozen interval operations for each pixel of
 *             its rectangle. A sort of all kept samples a window.
 *
 * Compile with -frounding-math; or, slower, but regardless of rounding modes
 * (valgrind ignores them), with -DCGAL_ALWAYS_ROUND_TO_NEAREST. */
#include "algorithms/algorithm.h"
#include "bench/judge/oracles/steps.h"
#include "bench/judge/rounding.h"
#include "bench/judge/samples.h"
#include "common/answers/kinds/composited.h"
#include "common/view/path.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Interval_nt.h>
#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using judge::Interval, judge::Nearest, judge::Upward;
using judge::light, judge::looks, judge::looks_of, judge::root,
    judge::whole_vec;
using Exact = CGAL::Gmpq;
using Real = long double;

enum { ORACLE_SPLAT, ORACLE_EXACT };

constexpr int UNDECIDED = -1;

/* --- Vectors, of intervals or of exact numbers ---------------------------- */

template <class T> using vec = std::array<T, 3>;

template <class T> vec<T> lift(const double v[3]) {
  return {T(v[0]), T(v[1]), T(v[2])};
}

template <class T> vec<T> operator+(const vec<T> &a, const vec<T> &b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

template <class T> vec<T> operator-(const vec<T> &a, const vec<T> &b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class T> vec<T> operator*(const T &s, const vec<T> &a) {
  return {s * a[0], s * a[1], s * a[2]};
}

template <class T> T dot(const vec<T> &a, const vec<T> &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T> T square(const vec<T> &a) {
  return CGAL::square(a[0]) + CGAL::square(a[1]) + CGAL::square(a[2]);
}

template <class T> vec<T> cross(const vec<T> &a, const vec<T> &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

/* X', a vector divided by a cell's size. */
template <class T> vec<T> in_cells(const vec<T> &a, const vec<T> &size) {
  return {a[0] / size[0], a[1] / size[1], a[2] / size[2]};
}

/* --- Floors --------------------------------------------------------------- */

/* The least of floor(x) and `most`, x not being negative. */
int whole(const Exact &x, int most) {
  if (x >= Exact(most))
    return most;
  mpz_t floor;
  mpz_init(floor);
  mpz_fdiv_q(floor, x.numerator().mpz(), x.denominator().mpz());
  const int found = int(mpz_get_si(floor));
  mpz_clear(floor);
  return found;
}

int whole(double x, int most) {
  return x >= most ? most : x > 0 ? int(x) : 0;
}

/* The same of a number in an interval; UNDECIDED: there are several. */
int whole(const Interval &x, int most) {
  if (std::isnan(x.inf()) || std::isnan(x.sup()))
    return UNDECIDED;
  const int floor = whole(x.inf(), most);
  return whole(x.sup(), most) == floor ? floor : UNDECIDED;
}

Interval greater(const Interval &a, const Interval &b) {
  return {std::max(a.inf(), b.inf()), std::max(a.sup(), b.sup())};
}

Exact greater(const Exact &a, const Exact &b) {
  return a < b ? b : a;
}

/* x, but at least 0 and at most 1. */
template <class T> T part_of_one(const T &x) {
  return T(1) - greater(T(0), T(1) - greater(T(0), x));
}

/* --- Channels -------------------------------------------------------------  */

enum { OPACITY = 3, WEIGHT = 4, CHANNELS = 5 };
using channels = std::array<uint64_t, CHANNELS>;

/* What the model slab sums of a sample: weight, levels of density and gradient,
 * light, its own colour. */
enum { SUM_WEIGHT, SUM_LEVEL, SUM_STEEP, SUM_BRIGHT, SUM_SHINE, SUM_RGB };
using measures = std::array<uint64_t, SUM_RGB + 3>;

measures measures_of(const hsr_grid &grid, uint32_t cell, const whole_vec &V) {
  const hsr_palette &p = grid.palette;
  const light l(p, grid.normal[cell], V);
  measures x = {65536, 257ul * grid.level[cell], 257ul * grid.steep[cell],
                p.ambient + p.diffuse * uint64_t(l.diffuse) / 8192,
                p.specular * uint64_t(l.specular) / 8192};
  for (size_t c = 0; c < 3 && grid.rgb; c++) {
    const uint64_t byte = grid.rgb[cell][c];
    x[SUM_RGB + c] = 65535 * byte * byte / 65025;
  }
  return x;
}

/* A table of a palette at a level of 65535ths. */
uint64_t entry_at(const uint16_t *table, size_t stride, uint64_t level) {
  const uint64_t i = level / 257, f = level % 257,
                 next = std::min<uint64_t>(i + 1, 255);
  return ((257 - f) * table[i * stride] + f * table[next * stride]) / 257;
}

/* --- Opacity per length --------------------------------------------------- */

/* Lambda of an opacity. */
uint64_t length_of(uint64_t A) {
  return uint64_t(std::llround(-65536 * std::log2(1 - Real(A) / 65536)));
}

/* V of M. What is rounded is positive, and far from halves, so that a mode of
 * rounding that is not the usual one does no harm. */
uint64_t veil_of(uint64_t M) {
  const uint64_t least = std::min<uint64_t>(M, (1 << 20) - 1);
  const auto H =
      uint64_t(std::floor(65536 * std::exp2(-Real(least / 256) / 256) + 0.5L));
  const auto L = uint64_t(
      std::floor(65536 * (1 - std::exp2(-Real(least % 256) / 65536)) + 0.5L));
  return 65536 - H + H * L / 65536;
}

/* --- Kernels -------------------------------------------------------------- */

/* Values of kappa, knots and pieces between them; parts of a reach. */
constexpr int ENTRIES = 1024, KNOTS = 64, PIECES = ENTRIES / KNOTS, PARTS = 32;

struct crawfis_max {
  static constexpr Real reach = 1.556228L, bend = 0.88L, end = reach;
  static Real h(Real x2) {
    const Real x = std::sqrt(x2), y = reach - x;
    if (x <= bend)
      return 0.557526L - 1.157744L * x2 + 0.671033L * x * x2;
    return y > 0 ? 0.067599L * y * y + 0.282474L * y * y * y : 0;
  }
};

/* Beyond `end` is nothing that would count. */
struct gaussian {
  static constexpr Real reach = 2, bend = 0, end = 6;
  static Real h(Real x2) {
    const Real v = 0.36L;
    const Real pi = 3.141592653589793238462643383279502884L;
    return std::exp(-x2 / (2 * v)) / (2 * pi * v * std::sqrt(2 * pi * v));
  }
};

/* Where a line at a distance whose square is given crosses a sphere. */
Real crossing(Real radius, Real rho2) {
  const Real x2 = radius * radius - rho2;
  return x2 > 0 ? std::sqrt(x2) : 0;
}

/* The integral of the kernel along such a line, over x from a to b; between
 * them the line leaves no part of the kernel. */
template <class Kernel> Real smooth_part(Real rho2, Real a, Real b) {
  return boost::math::quadrature::gauss<Real, 15>::integrate(
      [&](Real x) { return Kernel::h(rho2 + x * x); }, a, b);
}

/* The same, wherever the line goes. */
template <class Kernel> Real part(Real rho2, Real a, Real b) {
  const Real bend = crossing(Kernel::bend, rho2),
             end = crossing(Kernel::end, rho2);
  Real sum = 0;
  for (const Real x : {-end, -bend, bend, end})
    if (a < x && x < b) {
      sum += smooth_part<Kernel>(rho2, a, x);
      a = x;
    }
  return sum + smooth_part<Kernel>(rho2, a, b);
}

/* The weights of a kernel before lambda = -32, ..., 32, which is the last: all
 * of it. */
class tables {
  std::array<std::array<int32_t, 2 * PARTS + 1>, KNOTS + 1> before = {};

public:
  template <class Kernel> explicit tables(Kernel) {
    const Real step = Kernel::reach / PARTS;
    const int far = int(std::lround(Kernel::end / step));
    for (size_t i = 0; i < KNOTS; i++) {
      const Real rho2 = Kernel::reach * Kernel::reach * Real(i) / KNOTS;
      Real sum = 0;
      for (int l = -far; l < far; l++) {
        if (std::abs(l) < PARTS)
          before[i][size_t(l + PARTS)] = int32_t(std::lround(65536 * sum));
        sum += part<Kernel>(rho2, Real(l) * step, Real(l + 1) * step);
      }
      before[i][0] = 0;
      before[i][2 * PARTS] = int32_t(std::lround(65536 * sum));
    }
  }

  /* No knot is less than the next one, so that nothing negative is divided. */
  uint64_t weight_before(int kappa, int lambda) const {
    const size_t i = size_t(kappa / PIECES), l = size_t(lambda + PARTS);
    const int j = kappa % PIECES, here = before[i][l], next = before[i + 1][l];
    return uint64_t(here - (2 * j + 1) * (here - next) / (2 * PIECES));
  }
  uint64_t weight(int kappa) const { return weight_before(kappa, PARTS); }
};

/* Made when they are first asked for, which is while doubles are rounded to
 * nearest. */
const tables &tables_of(hsr_splat_kernel kernel) {
  if (kernel == HSR_GAUSSIAN) {
    static const tables made{gaussian()};
    return made;
  }
  static const tables made{crawfis_max()};
  return made;
}

/* r^2, of the decimal number. */
Exact squared_reach(hsr_splat_kernel kernel) {
  return CGAL::square(kernel == HSR_GAUSSIAN ? Exact(2)
                                             : Exact(1556228, 1000000));
}

/* c, by which a splat that moves loses energy. */
Exact paling(const hsr_splatting &options) {
  const bool area = options.blur == HSR_BLUR_BY_AREA;
  if (options.kernel == HSR_GAUSSIAN)
    return Exact(area ? 318310 : 666911, 1000000);
  return Exact(area ? 409079 : 850918, 1000000);
}

/* --- What a window is made of, in doubles and integers -------------------- */

/* A kept sample. */
struct place {
  uint32_t cell;
  std::array<int, 3> at;
};

struct scenery {
  const hsr_view &view;
  const hsr_grid &grid;
  hsr_splatting options;
  std::array<std::vector<double>, 3> size; /* of the cells of each axis */
  std::array<int, 3> eye;                  /* q */
  whole_vec V;                             /* -F in 1024ths, rounded */
  std::vector<place> sequence;             /* from front to back */
  std::vector<double> sx, sy; /* of the window's columns and rows */

  scenery(const hsr_view &seen, const hsr_grid &of, const hsr_splatting &asked);

private:
  int eye_cell(size_t axis) const;
  void list_places();
};

/* The last cell whose lower bound is not above the eye, or -1. */
int scenery::eye_cell(size_t axis) const {
  const int n = int(grid.n[axis]);
  if (view.parallel)
    return view.F[axis] < 0 ? n - 1 : -1;
  int q = -1;
  while (q + 1 < n && grid.bound[axis][q + 1] <= view.E[axis])
    q++;
  return q;
}

/* The kept samples, by key. */
void scenery::list_places() {
  const uint32_t rows = grid.n[1] * grid.n[2];
  for (uint32_t row = 0; row < rows; row++)
    for (uint32_t cell = grid.row[row]; cell < grid.row[row + 1]; cell++)
      sequence.push_back(
          {cell,
           {int(grid.x[cell]), int(row % grid.n[1]), int(row / grid.n[1])}});

  const auto key = [&](const place &p) {
    int high = 0;
    std::array<int, 3> away;
    for (size_t a = 0; a < 3; a++) {
      high += (p.at[a] > eye[a]) << a;
      away[a] = std::abs(p.at[a] - eye[a]);
    }
    return std::make_tuple(high, away[2], away[1], away[0]);
  };
  std::sort(sequence.begin(), sequence.end(),
            [&](const place &p, const place &q) { return key(p) < key(q); });
}

/* Doubles are rounded to nearest here. */
scenery::scenery(const hsr_view &seen, const hsr_grid &of,
                 const hsr_splatting &asked)
    : view(seen), grid(of), options(asked) {
  for (size_t a = 0; a < 3; a++) {
    for (uint32_t i = 0; i < grid.n[a]; i++)
      size[a].push_back(grid.bound[a][i + 1] - grid.bound[a][i]);
    eye[a] = eye_cell(a);
    V[a] = -int64_t(std::llrint(1024 * view.F[a]));
  }
  list_places();
  for (int i = view.window.x0; i < view.window.x1; i++)
    sx.push_back(hsr_sample_x(&view, i));
  for (int j = view.window.y0; j < view.window.y1; j++)
    sy.push_back(hsr_sample_y(&view, j));
}

/* --- Footprints ----------------------------------------------------------- */

/* From where a splat is seen, now or before. */
template <class T> struct outlook {
  bool parallel;
  vec<T> E, F, R, U;
  T near;
  vec<T> along_F, along_R, along_U; /* their products with P - E are t, alpha
                                       and beta */

  template <class View> explicit outlook(const View &view);
};

template <class T>
template <class View>
outlook<T>::outlook(const View &view)
    : parallel(view.parallel), E(lift<T>(view.E)), F(lift<T>(view.F)),
      R(lift<T>(view.R)), U(lift<T>(view.U)), near(view.near) {
  const vec<T> RU = cross(R, U);
  const T by = T(1) / dot(F, RU);
  along_F = by * RU;
  along_R = by * cross(U, F);
  along_U = by * cross(F, R);
}

/* What is the same for all splats. */
template <class T> struct camera : outlook<T> {
  bool antialias;
  T m, n, width2, r2, c, threshold2;
  std::optional<outlook<T>> before; /* if splats may be blurred */

  camera(const scenery &of, const T &squared_reach_of_kernel, const T &c_of);
};

template <class T>
camera<T>::camera(const scenery &of, const T &squared_reach_of_kernel,
                  const T &c_of)
    : outlook<T>(of.view), antialias(of.options.antialias), m(of.view.m),
      n(of.view.n), width2(CGAL::square(T(of.options.width))),
      r2(squared_reach_of_kernel), c(c_of),
      threshold2(CGAL::square(T(of.options.threshold))) {
  if (of.options.blur != HSR_SHARP && of.view.before.exists)
    before.emplace(of.view.before);
}

template <class T> struct footprint {
  vec<T> P, size;
  T depth, g2, scale;
  CGAL::Uncertain<bool> blurred = false;
  vec<T> Q = {T(0), T(0), T(0)}; /* if it is blurred, and l^2 */
  T l2 = T(0);

  footprint(const scenery &of, const camera<T> &c, const place &p);

private:
  CGAL::Uncertain<bool> move(const camera<T> &c);
};

template <class T>
footprint<T>::footprint(const scenery &of, const camera<T> &c, const place &p)
    : g2(c.width2) {
  for (size_t a = 0; a < 3; a++) {
    P[a] = T(of.grid.at[a][p.at[a]]);
    size[a] = T(of.size[a][size_t(p.at[a])]);
  }
  depth = dot(c.along_F, P - c.E);
  if (c.antialias) {
    const T t2 = c.parallel ? T(1) : CGAL::square(depth);
    const T pixel = square(in_cells(c.U, size)) / CGAL::square(c.n) +
                    square(in_cells(c.R, size)) / CGAL::square(c.m);
    g2 = c.width2 * greater(T(1), T(2) * t2 * pixel);
  }
  scale = T(1024) / (g2 * c.r2);
  blurred = move(c);
}

struct splat {
  place where;
  footprint<Interval> about;
  mutable std::unique_ptr<const footprint<Exact>> exactly; /* once needed */
  looks colour;
  uint64_t e;
  bool blurred;
  hsr_window box; /* the pixels of the window that it may cover */
};

/* --- A pixel's ray and a splat -------------------------------------------- */

template <class T> struct ray { vec<T> start, along; };

template <class T>
ray<T> ray_through(const outlook<T> &c, const T &x, const T &y) {
  const vec<T> across = x * c.R + y * c.U;
  if (c.parallel)
    return {c.E + across, c.F};
  return {c.E, c.F + across};
}

template <class T> ray<T> make_ray(const camera<T> &c, double sx, double sy) {
  return ray_through<T>(c, (T(2) * T(sx) - c.m) / c.m,
                        (c.n - T(2) * T(sy)) / c.n);
}

/* Where a ray passes the middle of a kernel: |D'|^2, and V'.D', or
 * (V' + s Q).D' if the splat is blurred. */
template <class T> struct passage {
  T DD, middle;

  /* The sign of t_b - t*, and tau^2. */
  T beyond(const T &t_b) const { return t_b * DD - middle; }
  T apart2(const T &t_b) const { return CGAL::square(beyond(t_b)) / DD; }
};

/* V' and D', or F' in parallel projection, and their products. The middle and
 * rho^2 are right once they are measured. */
template <class T> struct meeting : passage<T> {
  using passage<T>::DD;
  using passage<T>::middle;
  vec<T> V, D, across; /* D' x V' */
  T VD, rho2;

  meeting(const footprint<T> &s, const ray<T> &r)
      : V(in_cells(s.P - r.start, s.size)), D(in_cells(r.along, s.size)),
        across(cross(D, V)), VD(dot(V, D)) {
    DD = square(D);
    middle = VD;
  }

  /* Y; like all below, in perspective only if V'.D' is positive. */
  vec<T> point(bool parallel) const {
    return parallel ? T(1) / DD * cross(D, across)
                    : T(1) / VD * cross(V, across);
  }

  /* |D' x V'|^2 = |V'|^2 |D'|^2 - (V'.D')^2. */
  void measure(bool parallel) {
    rho2 = parallel ? square(across) / DD
                    : square(V) * square(across) / CGAL::square(VD);
  }
  void measure_blurred(const footprint<T> &s, bool parallel) {
    const vec<T> Y = point(parallel),
                 moved = part_of_one<T>(dot(Y, s.Q) / s.l2) * s.Q;
    rho2 = square(Y - moved);
    middle = VD + dot(moved, D);
  }
};

/* Finds Q and l^2, and whether the splat is blurred. */
template <class T>
CGAL::Uncertain<bool> footprint<T>::move(const camera<T> &c) {
  if (!c.before)
    return false;
  const outlook<T> &before = *c.before;
  const vec<T> away = P - before.E;
  const T t_0 = dot(before.along_F, away);
  const CGAL::Uncertain<bool> seen = t_0 > before.near;
  if (!CGAL::certainly(seen))
    return seen;

  const T w = before.parallel ? T(1) : t_0;
  const meeting<T> m(*this, ray_through<T>(c, dot(before.along_R, away) / w,
                                           dot(before.along_U, away) / w));
  const CGAL::Uncertain<bool> ahead = m.VD > T(0);
  if (!c.parallel && !CGAL::certainly(ahead))
    return ahead;

  Q = m.point(c.parallel);
  l2 = square(Q);
  return l2 > c.threshold2;
}

/* A splat that covers a pixel. */
struct covering {
  const splat *of;
  int kappa;
  passage<Interval> about;
};

/* --- Judging -------------------------------------------------------------- */

class judge {
  const scenery &seen;
  const tables &kernel;
  hsr_tally *tally;
  camera<Exact> exact_camera;
  camera<Interval> about_camera;
  std::vector<splat> splats; /* that may cover a pixel of the window, from front
                                to back */
  std::vector<Exact> exact_ends; /* of buckets: all t_b */
  std::vector<Interval> ends;
  size_t across; /* the axis that sheets are across */

  /* The current pixel. */
  double sx = 0, sy = 0;
  std::vector<covering> covered; /* from front to back */

  const footprint<Exact> &exact(const splat &s) const;
  bool exists(const splat &s) const;
  void find_motion(splat *s) const;
  uint64_t energy(const splat &s) const;
  uint64_t exact_energy(const splat &s) const;
  hsr_window find_box(const splat &s) const;
  void find_splats();
  void find_buckets();

  meeting<Exact> exact_meeting(const splat &s) const;
  int kappa(const splat &s, meeting<Interval> *about) const;
  int exact_kappa(const splat &s) const;
  int lambda(const covering &c, size_t bucket) const;
  int exact_lambda(const splat &s, size_t bucket) const;
  void gather(const std::vector<const splat *> &row, int i);

  channels given(const splat &s, uint64_t weight) const;
  channels given(const covering &c) const;
  channels part(const covering &c) const;
  void put_sum_over(channels *E, channels sum) const;
  channels over() const;
  channels under() const;
  channels xray() const;
  channels sheet() const;
  template <class Give> void each_part(Give give) const;
  channels volume() const;
  channels slab_of(const measures &sum) const;
  channels slab() const;
  channels composite() const;
  void write(const channels &E, uint16_t *rgba) const;
  void count_exact() const {
    HSR_STEP(tally, ORACLE_EXACT, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
  }

public:
  judge(const scenery &of, const tables &made, hsr_tally *counts);
  void draw(uint16_t *rgba);
};

judge::judge(const scenery &of, const tables &made, hsr_tally *counts)
    : seen(of), kernel(made), tally(counts), exact_camera([&] {
        const Nearest to_nearest;
        return camera<Exact>(of, squared_reach(of.options.kernel),
                             paling(of.options));
      }()),
      about_camera(of, Interval(CGAL::to_interval(exact_camera.r2)),
                   Interval(CGAL::to_interval(exact_camera.c))),
      across(0) {
  const double *F = of.view.F;
  for (size_t a = 1; a < 3; a++)
    if (std::fabs(F[a]) > std::fabs(F[across]))
      across = a;
  find_splats();
  if (of.options.model == HSR_VOLUME || of.options.model == HSR_SLAB)
    find_buckets();
}

/* --- Splats of a window --------------------------------------------------- */

const footprint<Exact> &judge::exact(const splat &s) const {
  if (!s.exactly)
    s.exactly =
        std::make_unique<const footprint<Exact>>(seen, exact_camera, s.where);
  return *s.exactly;
}

/* Whether t > near. */
bool judge::exists(const splat &s) const {
  const CGAL::Uncertain<bool> guess = s.about.depth > about_camera.near;
  if (guess.is_certain())
    return guess.make_certain();
  const Nearest to_nearest;
  count_exact();
  return exact(s).depth > exact_camera.near;
}

/* Where the intervals do not know whether it is blurred, they may not know Q
 * either. */
void judge::find_motion(splat *s) const {
  footprint<Interval> &about = s->about;
  if (about.blurred.is_certain()) {
    s->blurred = about.blurred.make_certain();
    return;
  }
  count_exact();
  {
    const Nearest to_nearest;
    s->blurred = exact(*s).blurred.make_certain();
  }
  about.l2 = Interval(CGAL::to_interval(exact(*s).l2));
  for (size_t a = 0; a < 3; a++)
    about.Q[a] = Interval(CGAL::to_interval(exact(*s).Q[a]));
}

uint64_t judge::energy(const splat &s) const {
  Interval area = s.about.g2;
  if (s.blurred)
    area += about_camera.c * CGAL::sqrt(s.about.g2 * s.about.l2);
  const int guess = whole(Interval(65536) / area, 65536);
  return guess != UNDECIDED ? uint64_t(guess) : exact_energy(s);
}

/* e >= k if 65536 / k - g^2 >= c g l, whose right side is not negative. As g^2
 * is at least 1, e is at most 65536. */
uint64_t judge::exact_energy(const splat &s) const {
  const Nearest to_nearest;
  count_exact();
  const footprint<Exact> &f = exact(s);
  const Exact c = s.blurred ? exact_camera.c : Exact(0),
              right2 = CGAL::square(c) * f.g2 * f.l2;
  int e = 0;
  for (int bit = 65536; bit > 0; bit /= 2) {
    const Exact left = Exact(65536, e + bit) - f.g2;
    if (left >= Exact(0) && CGAL::square(left) >= right2)
      e += bit;
  }
  return uint64_t(e);
}

/* The place of an interval among the pixels from `first` to `last`, one more on
 * either side. */
std::pair<int, int> pixels(const Interval &at, int first, int last) {
  const auto clamped = [&](double x) {
    return int(std::clamp(x, first - 4.0, last + 4.0));
  };
  return {std::max(clamped(at.inf()) - 2, first),
          std::min(clamped(at.sup()) + 3, last)};
}

/* Where the ray is at the distance rho from P, rho < g r in units of cells, it
 * is in the box of P and g r cells on all sides. In perspective it is there at
 * |V'|^2 / V'.D' > 0 times D. So if the box is before the eye, the pixel is
 * between the images of the corners; else the splat may be anywhere.
 * If the splat is blurred, this point of the ray is at such a distance from a
 * point of the way from P to P + Q, Q being in cells. So it is in the hull of
 * the boxes of the two, which have 16 corners. */
hsr_window judge::find_box(const splat &s) const {
  const camera<Interval> &c = about_camera;
  const hsr_window all = seen.view.window, none = {0, 0, 0, 0};
  const Interval reach = CGAL::sqrt(s.about.g2 * c.r2);
  Interval x, y;
  for (int corner = 0; corner < (s.blurred ? 16 : 8); corner++) {
    vec<Interval> at = s.about.P - c.E;
    for (size_t a = 0; a < 3; a++) {
      const Interval side = corner >> a & 1 ? reach : -reach;
      at[a] += s.about.size[a] * (corner < 8 ? side : s.about.Q[a] + side);
    }
    const Interval w = c.parallel ? Interval(1) : dot(c.along_F, at);
    if (!(w.inf() > 0))
      return all;
    const Interval sx_of = (dot(c.along_R, at) / w + Interval(1)) * c.m /
                           Interval(2),
                   sy_of = (Interval(1) - dot(c.along_U, at) / w) * c.n /
                           Interval(2);
    if (!CGAL::is_finite(sx_of) || !CGAL::is_finite(sy_of))
      return all;
    x = corner ? Interval(std::min(x.inf(), sx_of.inf()),
                          std::max(x.sup(), sx_of.sup()))
               : sx_of;
    y = corner ? Interval(std::min(y.inf(), sy_of.inf()),
                          std::max(y.sup(), sy_of.sup()))
               : sy_of;
  }
  const auto columns = pixels(x, all.x0, all.x1),
             rows = pixels(y, all.y0, all.y1);
  if (columns.first >= columns.second || rows.first >= rows.second)
    return none;
  return {columns.first, rows.first, columns.second, rows.second};
}

void judge::find_splats() {
  for (const place &p : seen.sequence) {
    splat s = {p, footprint<Interval>(seen, about_camera, p), {}, {}, 0, false,
               {}};
    find_motion(&s);
    s.box = find_box(s);
    if (s.box.x0 >= s.box.x1 || !exists(s))
      continue;
    s.e = energy(s);
    s.colour = looks_of(seen.grid, p.cell, seen.V, seen.options.attenuate);
    splats.push_back(std::move(s));
  }
}

/* All ends of buckets but the last. */
void judge::find_buckets() {
  {
    const Nearest to_nearest;
    const hsr_grid &g = seen.grid;
    Exact least, greatest;
    for (int corner = 0; corner < 8; corner++) {
      vec<Exact> P;
      for (size_t a = 0; a < 3; a++)
        P[a] = Exact(g.at[a][corner >> a & 1 ? g.n[a] - 1 : 0]);
      const Exact t = dot(exact_camera.along_F, P - exact_camera.E);
      least = corner && least < t ? least : t;
      greatest = corner && greatest > t ? greatest : t;
    }
    least = greater(least, exact_camera.near);
    for (int b = 1; b < seen.options.buckets && least < greatest; b++)
      exact_ends.push_back(least +
                           (greatest - least) * Exact(b, seen.options.buckets));
  }
  for (const Exact &end : exact_ends)
    ends.emplace_back(CGAL::to_interval(end));
}

/* --- Splats of a pixel ---------------------------------------------------- */

meeting<Exact> judge::exact_meeting(const splat &s) const {
  const bool parallel = exact_camera.parallel;
  meeting<Exact> m(exact(s), make_ray(exact_camera, sx, sy));
  if (parallel || m.VD > Exact(0)) {
    if (s.blurred)
      m.measure_blurred(exact(s), parallel);
    else
      m.measure(parallel);
  }
  return m;
}

/* 1024: the splat does not cover the pixel. */
int judge::kappa(const splat &s, meeting<Interval> *about) const {
  const bool parallel = about_camera.parallel;
  if (!parallel && about->VD.sup() <= 0)
    return ENTRIES;
  if (!parallel && !(about->VD.inf() > 0)) {
    about->middle = Interval::largest();
    return exact_kappa(s);
  }
  if (s.blurred)
    about->measure_blurred(s.about, parallel);
  else
    about->measure(parallel);
  const int found = whole(about->rho2 * s.about.scale, ENTRIES);
  return found != UNDECIDED ? found : exact_kappa(s);
}

int judge::exact_kappa(const splat &s) const {
  const Nearest to_nearest;
  count_exact();
  const meeting<Exact> m = exact_meeting(s);
  if (!exact_camera.parallel && m.VD <= Exact(0))
    return ENTRIES;
  return whole(m.rho2 * exact(s).scale, ENTRIES);
}

/* If there is one floor only, and it is not 0, the sign is certain. */
int judge::lambda(const covering &c, size_t bucket) const {
  const Interval &t_b = ends[bucket];
  const int lambda2 = whole(c.about.apart2(t_b) * c.of->about.scale, ENTRIES);
  if (lambda2 == UNDECIDED)
    return exact_lambda(*c.of, bucket);
  const int size = int(root(lambda2));
  return c.about.beyond(t_b).inf() < 0 ? -size : size;
}

int judge::exact_lambda(const splat &s, size_t bucket) const {
  const Nearest to_nearest;
  count_exact();
  const meeting<Exact> m = exact_meeting(s);
  const Exact &t_b = exact_ends[bucket];
  const int size = int(root(whole(m.apart2(t_b) * exact(s).scale, ENTRIES)));
  return m.beyond(t_b) < 0 ? -size : size;
}

/* The splats that cover pixel i of a row, of those that may. */
void judge::gather(const std::vector<const splat *> &row, int i) {
  const ray<Interval> r = make_ray(about_camera, sx, sy);
  covered.clear();
  for (const splat *s : row) {
    if (i < s->box.x0 || i >= s->box.x1)
      continue;
    HSR_STEP(tally, ORACLE_SPLAT, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
    meeting<Interval> about(s->about, r);
    const int k = kappa(*s, &about);
    if (k < ENTRIES)
      covered.push_back({s, k, about});
  }
}

/* --- Models --------------------------------------------------------------- */

/* D. With opacity per length its last channel is M. */
channels judge::given(const splat &s, uint64_t weight) const {
  channels D;
  for (size_t c = 0; c < WEIGHT; c++)
    D[c] = weight * (s.colour.C[c] * s.e / 65536) / 65536;
  D[WEIGHT] = seen.options.per_length
                  ? weight * (length_of(s.colour.A) * s.e / 65536) / 65536
                  : weight * s.e / 65536;
  return D;
}

/* D of a splat that is composited by itself. */
channels judge::given(const covering &c) const {
  channels D = given(*c.of, kernel.weight(c.kappa));
  if (!seen.options.per_length)
    return D;
  const uint64_t V = veil_of(D[WEIGHT]);
  for (size_t k = 0; k < OPACITY; k++)
    D[k] = V * c.of->colour.lit[k] / 65536;
  D[OPACITY] = V * 65535 / 65536;
  return D;
}

/* D of a splat that is summed. */
channels judge::part(const covering &c) const {
  return given(*c.of, kernel.weight(c.kappa));
}

void add(channels *E, const channels &D) {
  for (size_t c = 0; c < CHANNELS; c++)
    (*E)[c] += D[c];
}

void put_over(channels *E, const channels &D) {
  for (size_t c = 0; c < CHANNELS; c++)
    (*E)[c] = D[c] + (*E)[c] * (65536 - D[OPACITY]) / 65536;
}

/* A sum takes the place of a splat. */
void judge::put_sum_over(channels *E, channels sum) const {
  if (seen.options.per_length) {
    const uint64_t S = 65535 * veil_of(sum[WEIGHT]) / 65536, all = sum[OPACITY];
    for (size_t c = 0; c < OPACITY; c++)
      sum[c] = all ? S * sum[c] / all : 0;
    sum[OPACITY] = S;
  }
  for (uint64_t &c : sum)
    c = std::min<uint64_t>(c, 65535);
  put_over(E, sum);
}

channels judge::over() const {
  channels E = {};
  for (auto c = covered.rbegin(); c != covered.rend(); ++c)
    put_over(&E, given(*c));
  return E;
}

channels judge::under() const {
  channels E = {};
  for (const covering &splat : covered) {
    const channels D = given(splat);
    const uint64_t left = 65536 - E[OPACITY];
    for (size_t c = 0; c < CHANNELS; c++)
      E[c] += D[c] * left / 65536;
  }
  return E;
}

channels judge::xray() const {
  channels E = {};
  for (const covering &c : covered)
    add(&E, part(c));
  return E;
}

channels judge::sheet() const {
  std::map<int, channels> sums; /* by index along the axis */
  for (const covering &c : covered)
    add(&sums[c.of->where.at[across]], part(c));
  channels E = {};
  const int q = seen.eye[across];
  for (auto s = sums.rbegin(); s != sums.rend() && s->first > q; ++s)
    put_sum_over(&E, s->second);
  for (auto s = sums.begin(); s != sums.end() && s->first <= q; ++s)
    put_sum_over(&E, s->second);
  return E;
}

/* Calls give(bucket, splat, weight) for all parts of all splats. Lambda does not
 * fall from one end of a bucket to the next. So the first one that a splat reaches
 * is found by halving. */
template <class Give> void judge::each_part(Give give) const {
  for (const covering &c : covered) {
    size_t b = 0, reached = ends.size();
    while (b < reached) {
      const size_t middle = b + (reached - b) / 2;
      if (lambda(c, middle) > -PARTS)
        reached = middle;
      else
        b = middle + 1;
    }
    const uint64_t all = kernel.weight(c.kappa);
    for (uint64_t before = 0; before < all; b++) {
      const uint64_t next =
          b < ends.size() ? kernel.weight_before(c.kappa, lambda(c, b)) : all;
      give(b, *c.of, next - before);
      before = next;
    }
  }
}

channels judge::volume() const {
  std::vector<channels> sums(ends.size() + 1);
  each_part([&](size_t b, const splat &s, uint64_t weight) {
    add(&sums[b], given(s, weight));
  });
  channels E = {};
  for (auto s = sums.rbegin(); s != sums.rend(); ++s)
    put_sum_over(&E, *s);
  return E;
}

/* What the means of a slab show; the sums of weights are not 0. */
channels judge::slab_of(const measures &sum) const {
  const hsr_palette &p = seen.grid.palette;
  const auto mean = [&](size_t x, uint64_t most) {
    return std::min(65536 * sum[x] / sum[SUM_WEIGHT], most);
  };
  const uint64_t level = mean(SUM_LEVEL, 65535), steep = mean(SUM_STEEP, 65535);
  const uint64_t O = entry_at(p.opacity, 1, level),
                 G = entry_at(p.gradient, 1, steep),
                 A = O * G / 65535 * seen.options.attenuate / 65536;
  const uint64_t S =
      65535 * veil_of(length_of(A) * sum[SUM_WEIGHT] / 65536) / 65536;
  channels D = {};
  for (size_t c = 0; c < OPACITY; c++) {
    const uint64_t T = seen.grid.rgb && p.own_colours
                           ? mean(SUM_RGB + c, 65535)
                           : entry_at(p.rgb[0] + c, 3, level);
    const uint64_t lit = std::min<uint64_t>(
        T * mean(SUM_BRIGHT, 131070) / 65535 + mean(SUM_SHINE, 65535), 65535);
    D[c] = lit * S / 65535;
  }
  D[OPACITY] = S;
  return D;
}

channels judge::slab() const {
  std::vector<measures> sums(ends.size() + 1);
  each_part([&](size_t b, const splat &s, uint64_t weight) {
    const measures x = measures_of(seen.grid, s.where.cell, seen.V);
    for (size_t k = 0; k < x.size(); k++)
      sums[b][k] += weight * (x[k] * s.e / 65536) / 65536;
  });
  channels E = {};
  for (auto s = sums.rbegin(); s != sums.rend(); ++s)
    if ((*s)[SUM_WEIGHT])
      put_over(&E, slab_of(*s));
  return E;
}

channels judge::composite() const {
  switch (seen.options.model) {
  case HSR_OVER:
    return over();
  case HSR_UNDER:
    return under();
  case HSR_SHEET:
    return sheet();
  case HSR_VOLUME:
    return volume();
  case HSR_SLAB:
    return slab();
  case HSR_XRAY:
    break;
  }
  return xray();
}

/* --- The picture ---------------------------------------------------------- */

__extension__ typedef unsigned __int128 wide;

void judge::write(const channels &E, uint16_t *rgba) const {
  const hsr_splatting &o = seen.options;
  for (size_t c = 0; c < WEIGHT; c++) {
    wide v = E[c];
    if (o.normalise)
      v = E[WEIGHT] ? 65536 * v / E[WEIGHT] : 0;
    else if (o.model == HSR_XRAY)
      v = v * o.exposure / 65536;
    rgba[c] = uint16_t(std::min<wide>(v, 65535));
  }
}

void judge::draw(uint16_t *rgba) {
  const hsr_window &w = seen.view.window;
  std::vector<const splat *> row;
  for (int j = w.y0; j < w.y1; j++) {
    row.clear();
    for (const splat &s : splats)
      if (s.box.y0 <= j && j < s.box.y1)
        row.push_back(&s);
    sy = seen.sy[size_t(j - w.y0)];
    for (int i = w.x0; i < w.x1; i++) {
      HSR_TOUCH(tally, i, j);
      sx = seen.sx[size_t(i - w.x0)];
      gather(row, i);
      write(composite(),
            rgba + 4 * (size_t(j) * size_t(seen.view.m) + size_t(i)));
    }
  }
}

/* --- The algorithm -------------------------------------------------------- */

/* Not inlined, so that the scenery is computed before the rounding mode is
 * changed. */
[[gnu::noinline]] void draw(const scenery &seen, const tables &kernel,
                            const hsr_job &job) {
  const Upward upward;
  judge j(seen, kernel, job.tally);
  j.draw(hsr_answer_rgba_of(job.answer));
}

/* --- Frames between two views --------------------------------------------- */

/* Calls act(number in the picture) for all channels of the window. */
template <class Act> void each_channel(const hsr_view &view, Act act) {
  const hsr_window &w = view.window;
  for (int j = w.y0; j < w.y1; j++)
    for (size_t k = 4 * size_t(w.x0); k < 4 * size_t(w.x1); k++)
      act(4 * size_t(j) * size_t(view.m) + k);
}

/* Each frame is drawn into the answer, and added. */
enum hsr_status draw_frames(const hsr_splatting &frame, const hsr_job &job,
                            hsr_error *err) {
  const hsr_view &last = *job.view;
  uint16_t *rgba = hsr_answer_rgba_of(job.answer);
  std::vector<uint64_t> sums(4 * size_t(last.m) * size_t(last.n));
  std::vector<::judge::pose> poses;
  for (int k = 0; k < frame.frames; k++) {
    hsr_view view;
    const hsr_status status =
        hsr_view_between(&last, k, frame.frames - 1, &view, err);
    if (status)
      return status;
    poses.emplace_back(view);
    draw(scenery(view, *job.world->roster.scene->grid, frame),
         tables_of(frame.kernel), job);
    each_channel(last, [&](size_t at) { sums[at] += rgba[at]; });
  }
  each_channel(last, [&](size_t at) {
    rgba[at] = uint16_t(sums[at] / uint64_t(frame.frames));
  });
  return ::judge::are_steps(poses, last)
             ? HSR_OK
             : hsr_fail(
                   err, HSR_E_INTERNAL,
                   "splat-oracle: frames are not on the way of the camera");
}

/* Of one frame, or several. */
enum hsr_status draw_picture(hsr_splatting asked, const hsr_job &job,
                             hsr_error *err) {
  const hsr_view &view = *job.view;
  const bool accumulates = asked.blur == HSR_BLUR_ACCUMULATE;
  if (accumulates)
    asked.blur = HSR_SHARP;
  if (accumulates && view.before.exists &&
      view.before.parallel == view.parallel)
    return draw_frames(asked, job, err);
  draw(scenery(view, *job.world->roster.scene->grid, asked),
       tables_of(asked.kernel), job);
  return HSR_OK;
}

/* Does the work; nothing is thrown out of here. */
template <class Work>
enum hsr_status guarded(struct hsr_error *err, Work work) noexcept {
  try {
    return work();
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (const std::exception &e) {
    return hsr_fail(err, HSR_E_INTERNAL, "splat-oracle: %s", e.what());
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "splat-oracle: an unknown exception");
  }
}

extern "C" {

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return guarded(err, [&] {
    if (!::judge::is_rounding_honoured())
      return hsr_fail(err, HSR_E_INTERNAL,
                      "splat-oracle: directed rounding has no effect here");
    return draw_picture(hsr_form_splatting(&job->answer->form), *job, err);
  });
}

} /* extern "C" */

constexpr struct hsr_counter counters[] = {
    {"splats", "splats tested for whether they cover a pixel", HSR_COMPARE},
    {"exact", "floors and signs that were sought in rational numbers",
     HSR_COMPARE},
    {nullptr}};

constexpr struct hsr_algorithm describe() {
  struct hsr_algorithm a = {};
  a.name = "splat-oracle";
  a.title = "Splat oracle: exact splats from the definition";
  a.authors = "hsr";
  a.source = "docs/composited-picture.md";
  a.taxonomy = HSR_YARDSTICK;
  a.subjects = 1 << HSR_GRID;
  a.makes[0].kind = HSR_COMPOSITED;
  a.flags = HSR_JUDGE | HSR_INSTANCED;
  a.counters = counters;
  a.render = render;
  return a;
}

} /* namespace */

/* Constant-initialised. Declared first: a const is otherwise private to its
 * file in C++. */
extern "C" const struct hsr_algorithm HSR_ALGORITHM(splat_oracle);
constexpr struct hsr_algorithm description = describe();
const struct hsr_algorithm HSR_ALGORITHM(splat_oracle) = description;
