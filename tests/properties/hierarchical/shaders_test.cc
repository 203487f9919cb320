/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interval shaders: a colour that the judge's formulas give at a point lies in
 * what the interval shader says of a box around the point. The intervals shrink
 * with their boxes.
 *
 * usage: shaders_test [POINTS [SEED]]       standard: 120000 1 */
#include "algorithms/hierarchical/bounded/surface.h"
#include "bench/judge/areas/shading.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <algorithm>
#include <cmath>

namespace areas {

/* A long double, with what shading.h needs. */
struct real {
  long double v;
  real(long double value = 0) : v(value) {}
};
real operator+(real a, real b) {
  return a.v + b.v;
}
real operator-(real a, real b) {
  return a.v - b.v;
}
real operator*(real a, real b) {
  return a.v * b.v;
}
real operator/(real a, real b) {
  return a.v / b.v;
}
real root(real a) {
  return std::sqrt(a.v);
}
real square(real a) {
  return a.v * a.v;
}
real positive(real a) {
  return std::max(0.L, a.v);
}

constexpr long double TURN = 6.283185307179586476925286766559L;

/* By halving until s is within 2^-13, and then by Newton's iteration: from e off,
 * a step leads to within 2 e^2, so three of them to within 2^-90. */
real slope(real x) {
  const long double at = x.v - std::floor(x.v);
  long double from = 0, to = 1;
  for (int k = 0; k < 12; k++) {
    const long double s = (from + to) / 2;
    (s - std::sin(TURN * s) / (2 * TURN) < at ? from : to) = s;
  }
  long double s = (from + to) / 2;
  for (int k = 0; k < 3; k++)
    s -= (s - std::sin(TURN * s) / (2 * TURN) - at) /
         (1 - std::cos(TURN * s) / 2);
  return std::sin(TURN * s) / (2 - std::cos(TURN * s));
}

real squares(real u, real v, double dark) {
  return std::fmod(std::floor(u.v) + std::floor(v.v), 2) != 0 ? dark : 1;
}

} // namespace areas

namespace {

using areas::real;

/* More than long doubles are off by. */
constexpr long double OFF = 0x1p-54L;

struct dice {
  uint64_t seed;
  double between(double a, double b) {
    return a + (b - a) * (double(draw_integer(&seed, 0, 1 << 30)) / (1 << 30));
  }
  /* Of any size from 2^-44 to 2^most; now and then 0. */
  double size(int most) {
    return draw_integer(&seed, 0, 9) ? std::exp2(between(-44, most)) : 0;
  }
};

struct subject {
  hsr_shades shades;
  hsr_surface surface;
  areas::surface_of_shader same;
};

void normalise(double v[3]) {
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  for (int k = 0; k < 3; k++)
    v[k] /= length;
}

/* A triangle, and its normal; one in three lies across an axis. */
subject draw_subject(dice *d, hsr_shader shader) {
  subject s = {};
  s.shades.parts = hsr_shader_parts(shader);
  s.shades.side = d->between(.1, 3);
  const int across = int(draw_integer(&d->seed, 0, 8));
  double(*corner)[3] = s.surface.corner;
  for (int k = 0; k < 3; k++) {
    s.shades.light[k] = d->between(-1, 1);
    for (int c = 0; c < 3; c++)
      corner[k][c] = c == across && k ? corner[0][c] : d->between(-9, 9);
  }
  normalise(s.shades.light);
  hsr_shaded_face &f = s.surface.face;
  for (int c = 0; c < 3; c++) {
    const int l = (c + 1) % 3, m = (c + 2) % 3;
    f.normal[c] =
        (corner[1][l] - corner[0][l]) * (corner[2][m] - corner[0][m]) -
        (corner[1][m] - corner[0][m]) * (corner[2][l] - corner[0][l]);
    f.rgb[c] = uint16_t(draw_integer(&d->seed, 0, 65535));
    for (int k = 0; k < 3; k++)
      f.corner[k][c] = uint16_t(draw_integer(&d->seed, 0, 65535));
  }
  int most = 0;
  for (int k = 1; k < 3; k++)
    most = std::fabs(f.normal[k]) > std::fabs(f.normal[most]) ? k : most;
  f.u = (most + 1) % 3;
  f.v = (most + 2) % 3;
  normalise(f.normal);
  f.by_corners = s.shades.parts & HSR_PART_CORNERS;
  s.same.face = f;
  std::copy(&corner[0][0], &corner[0][0] + 9, &s.same.corner[0][0]);
  return s;
}

/* A point of the triangle. */
void draw_point(dice *d, const subject &s, double point[3]) {
  double a = d->between(0, 1), b = d->between(0, 1);
  if (a + b > 1)
    a = 1 - a, b = 1 - b;
  for (int c = 0; c < 3; c++) {
    const double *const o = &s.surface.corner[0][c];
    point[c] = o[0] + a * (o[3] - o[0]) + b * (o[6] - o[0]);
  }
}

void draw_box(dice *d, const double around[3], double by, hsr_interval box[3]) {
  for (int c = 0; c < 3; c++) {
    const double left = d->between(0, 1) * by, right = d->between(0, 1) * by;
    box[c] = {around[c] - left, around[c] + right};
  }
}

struct found {
  long outside = 0, boxes = 0;
};

void check_box(dice *d, hsr_shader shader, found *to) {
  const subject s = draw_subject(d, shader);
  double point[3], eye[3];
  hsr_interval box[3], directions[3], rgb[3];
  draw_point(d, s, point);
  double above = 0;
  for (int c = 0; c < 3; c++)
    above += (eye[c] = d->between(-5, 5)) * s.surface.face.normal[c];
  for (int c = 0; c < 3 && above < 0; c++)
    eye[c] = -eye[c];
  const double by = d->size(2);
  draw_box(d, point, by, box);
  draw_box(d, eye, d->size(0), directions);
  hsr_interval_shade(&s.shades, &s.surface, box, directions, rgb);
  to->boxes++;
  /* Corners and the inside; for Gouraud only where the triangle is. */
  for (int k = 0; k < 4; k++) {
    areas::vec<real> P, V;
    real *const p[] = {&P.x, &P.y, &P.z}, *const v[] = {&V.x, &V.y, &V.z};
    const bool stay = s.surface.face.by_corners;
    for (int c = 0; c < 3; c++) {
      const double a = k & 1 ? d->between(0, 1) : double(k & 2 ? 1 : 0);
      *p[c] =
          stay ? point[c]
               : std::min(box[c].hi, box[c].lo + a * (box[c].hi - box[c].lo));
      const double b = k & 1 ? d->between(0, 1) : double(k & 2 ? 0 : 1);
      *v[c] = std::min(directions[c].hi,
                       directions[c].lo +
                           b * (directions[c].hi - directions[c].lo));
    }
    real colour[3];
    areas::shade(s.shades, s.same, P, V, colour);
    for (int c = 0; c < 3; c++)
      to->outside +=
          !(colour[c].v >= rgb[c].lo - OFF && colour[c].v <= rgb[c].hi + OFF);
  }
}

/* Boxes of 2^-30 have narrow colours, but on lines of the board. */
bool is_narrow(dice *d, hsr_shader shader) {
  const subject s = draw_subject(d, shader);
  double point[3], eye[3];
  hsr_interval box[3], directions[3], rgb[3];
  draw_point(d, s, point);
  for (int c = 0; c < 3; c++)
    eye[c] = 3 * s.surface.face.normal[c] + d->between(-1, 1);
  draw_box(d, point, 0x1p-30, box);
  draw_box(d, eye, 0x1p-30, directions);
  hsr_interval_shade(&s.shades, &s.surface, box, directions, rgb);
  return rgb[0].hi - rgb[0].lo < 0x1p-16 && rgb[1].hi - rgb[1].lo < 0x1p-16 &&
         rgb[2].hi - rgb[2].lo < 0x1p-16;
}

/* --- Squares of the screen ------------------------------------------------ */

struct plane_of_screen {
  long double N[3], height; /* N·(A - E) */
};

/* q and, of a ray, t: in long doubles. */
long double along(const plane_of_screen &on, const long double v[3]) {
  return on.N[0] * v[0] + on.N[1] * v[1] + on.N[2] * v[2];
}

bool draw_view(dice *d, hsr_view *view, hsr_error *err) {
  hsr_camera camera = {
      {d->between(-9, 9), d->between(-9, 9), d->between(-9, 9)},
      {0, 0, 0},
      {.1, 1, .2},
      d->between(20, 90),
      0,
      draw_integer(&d->seed, 0, 1) ? 9. : 0.};
  return hsr_view_init(view, &camera, 64, 48, err) == HSR_OK;
}

/* The plane on the screen: as hsr_shape has it. */
hsr_screen_line find_line(const hsr_view &view, const subject &s,
                          plane_of_screen *on) {
  const double(*a)[3] = s.surface.corner;
  long double of[3];
  on->height = 0;
  for (int c = 0; c < 3; c++) {
    const int l = (c + 1) % 3, m = (c + 2) % 3;
    on->N[c] =
        ((long double)a[1][l] - a[0][l]) * ((long double)a[2][m] - a[0][m]) -
        ((long double)a[1][m] - a[0][m]) * ((long double)a[2][l] - a[0][l]);
    on->height += on->N[c] * ((long double)a[0][c] - view.E[c]);
  }
  for (int i = 0; i < 3; i++) {
    const long double ray[3] = {view.ray[i][0], view.ray[i][1], view.ray[i][2]};
    of[i] = along(*on, ray);
  }
  if (view.parallel) { /* -t = (N·ray - height) / N·F */
    const long double F[3] = {view.F[0], view.F[1], view.F[2]};
    const long double by = along(*on, F);
    of[0] = (of[0] - on->height) / by, of[1] /= by, of[2] /= by;
  } else {
    for (long double &k : of)
      k /= on->height;
  }
  const double size =
      double(std::fabs(of[0]) + 64 * std::fabs(of[1]) + 48 * std::fabs(of[2]));
  return {double(of[1]), double(of[2]), double(of[0]), 0x1p-48 * size};
}

/* Beyond the triangle, Gouraud's colours go on. At its edges, long doubles do
 * not tell. */
bool is_inside(const subject &s, const areas::vec<real> &P) {
  return areas::share_of(s.same, 0, P).v > 0x1p-16L &&
         areas::share_of(s.same, 1, P).v > 0x1p-16L &&
         areas::share_of(s.same, 2, P).v > 0x1p-16L;
}

void check_square(dice *d, hsr_shader shader, const hsr_view &view, found *to) {
  subject s = draw_subject(d, shader);
  plane_of_screen on;
  hsr_shape shape = {};
  shape.q = find_line(view, s, &on);
  const long double F[3] = {view.F[0], view.F[1], view.F[2]};
  if ((view.parallel ? along(on, F) : on.height) > 0)
    for (int c = 0; c < 3; c++)
      s.surface.face.normal[c] *=
          s.surface.face.normal[c] * on.N[c] > 0 ? -1 : 1;
  s.same.face = s.surface.face;
  s.shades.view = &view;
  const double half = std::exp2(-double(draw_integer(&d->seed, 1, 16)));
  const hsr_square square = {d->between(1, 63), d->between(1, 47), half};
  double low[3], high[3];
  hsr_surface_colours(&s.shades, &s.surface, &shape, &square, low, high);
  for (int k = 0; k < 4; k++) {
    const long double x = square.x + d->between(-half, half);
    const long double y = square.y + d->between(-half, half);
    long double ray[3], q = 0, P[3];
    for (int c = 0; c < 3; c++)
      ray[c] = view.ray[0][c] + x * view.ray[1][c] + y * view.ray[2][c];
    q = view.parallel ? (along(on, ray) - on.height) / along(on, F)
                      : along(on, ray) / on.height;
    if (!view.parallel && !(q > 0x1p-20L))
      continue;
    for (int c = 0; c < 3; c++)
      P[c] = view.E[c] + (view.parallel ? ray[c] - q * F[c] : ray[c] / q);
    const areas::vec<real> point = {P[0], P[1], P[2]};
    areas::vec<real> to_eye = {-ray[0], -ray[1], -ray[2]};
    if (view.parallel)
      to_eye = {-F[0], -F[1], -F[2]};
    real colour[3];
    if (s.same.face.by_corners && !is_inside(s, point))
      continue;
    areas::shade(s.shades, s.same, point, to_eye, colour);
    to->boxes++;
    for (int c = 0; c < 3; c++)
      if (!(colour[c].v >= low[c] - OFF && colour[c].v <= high[c] + OFF) &&
          !to->outside++)
        printf("# %.21Lg is not in [%.17g, %.17g], parallel %d, half %g\n",
               colour[c].v, low[c], high[c], view.parallel, half);
  }
}

/* A view takes longer than a square: it is of eight. */
void check_squares(dice *d, hsr_shader shader, long squares, found *to) {
  hsr_view view;
  hsr_error err;
  bool good = false;
  for (long k = 0; k < squares; k++) {
    good = k % 8 ? good : draw_view(d, &view, &err);
    if (good)
      check_square(d, shader, view, to);
  }
}

void check_shader(struct tap *tap, hsr_shader shader, const char *name,
                  long points, uint64_t seed) {
  dice d = {seed + uint64_t(shader) * 1000003};
  found all, squares;
  long narrow = 0;
  constexpr long SMALL = 1000;
  for (long k = 0; k < points; k += 4)
    check_box(&d, shader, &all);
  check_squares(&d, shader, (points + 3) / 4, &squares);
  for (long k = 0; k < SMALL; k++)
    narrow += is_narrow(&d, shader);
  ok(tap, all.outside == 0, "%s: %ld colours of %ld points outside", name,
     all.outside, 4 * all.boxes);
  ok(tap, squares.outside == 0,
     "%s: %ld colours of %ld points of squares outside", name, squares.outside,
     squares.boxes);
  ok(tap, narrow >= SMALL - SMALL / 100,
     "%s: %ld of %ld small boxes are narrow", name, narrow, SMALL);
}

/* The slope by itself. */
void check_slopes(struct tap *tap, long points, uint64_t seed) {
  dice d = {seed};
  long outside = 0;
  for (long k = 0; k < points; k++) {
    const double at = d.between(-3, 3), by = d.size(1);
    const hsr_interval box = {at - d.between(0, 1) * by,
                              at + d.between(0, 1) * by};
    const hsr_interval all = hsr_bump_slope(box);
    for (const double x : {box.lo, at, box.hi}) {
      const long double s = areas::slope(x).v;
      const bool in = s >= all.lo - OFF && s <= all.hi + OFF;
      if (!in && !outside++)
        printf("# %.17g in [%.17g, %.17g]: %.21Lg is not in [%.17g, %.17g]\n",
               x, box.lo, box.hi, s, all.lo, all.hi);
    }
  }
  ok(tap, outside == 0, "slopes: %ld of %ld outside", outside, 3 * points);
}

} // namespace

int main(int argc, char **argv) {
  static const struct {
    hsr_shader shader;
    const char *name;
  } shaders[] = {
      {HSR_SHADER_FLAT, "flat"},       {HSR_SHADER_GOURAUD, "gouraud"},
      {HSR_SHADER_CHECKER, "checker"}, {HSR_SHADER_BUMPS, "bumps"},
      {HSR_SHADER_PHONG, "phong"},     {HSR_SHADER_SKY, "sky"},
      {HSR_SHADER_WATER, "water"}};
  const long points = argc > 1 ? atol(argv[1]) : 120000;
  const uint64_t seed = argc > 2 ? strtoull(argv[2], nullptr, 10) : 1;
  struct tap tap = plan(3 * 7 + 1);
  for (const auto &s : shaders)
    check_shader(&tap, s.shader, s.name, points, seed);
  check_slopes(&tap, points, seed);
  return finish(&tap);
}
