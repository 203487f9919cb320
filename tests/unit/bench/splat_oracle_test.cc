/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The splat oracle against pixels derived by hand, and against the definition
 * written a second time: in rational numbers alone, with the kernels in closed
 * form, and the sequence by nested loops.
 *
 * By hand: samples stand at integers. The eye looks along -z, and in parallel
 * projection pixels are `apart` units from one another, with the middle of the
 * picture on the axis. Where a kernel is not said to be another one it is
 * `gaussian`, so that kappa = floor(256 rho^2 / g^2). Of its table,
 *     T_0 = 28973, T_1 = 26564, T_32 = 1801, T_33 = 1652, T_63 = 122,
 *     W_0 = 28898, W_1 = 28748, W_4 = 28296, W_16 = 26495, W_64 = 20421,
 *     W_256 = 7207, W_512 = 1797, W_961 = 158, W_1023 = 4
 * and W_0 before -8, -4, 0, 8 is 5847, 9781, 14450, 23051. */
#include "tests/unit/bench/checks.h"
#include "common/answers/kinds/composited.h"

#include <CGAL/Gmpq.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <random>
#include <string>
#include <vector>

extern "C" const struct hsr_algorithm hsr_counting_splat_oracle;

namespace {

const struct hsr_algorithm &oracle = hsr_counting_splat_oracle;

/* The options of a composited picture, as common/answers/composited.c has them.
 */
enum {
  MODEL,
  KERNEL,
  WIDTH,
  ANTIALIAS,
  ATTENUATE,
  NORMALISE,
  EXPOSURE,
  BUCKETS,
  BLUR,
  THRESHOLD,
  OPACITY_OF,
  FRAMES
};

constexpr uint16_t ONE = 65535, NO_NORMAL = 4096;

/* ---- Grids, views and forms, filled by hand ---- */

/* A kept sample. */
struct sample {
  std::array<uint32_t, 3> at;
  uint8_t level = 0, steep = 0;
  uint16_t normal = NO_NORMAL;
  std::array<uint8_t, 3> rgb = {};
};

/* Has the fields of hsr_grid that the oracle may read; the others are NULL. */
struct little_grid {
  std::array<std::vector<double>, 3> at, bound;
  std::vector<sample> kept; /* in any order */
  hsr_palette palette = {};
  bool colours = false;

  /* White, opaque and without light. */
  little_grid(const std::vector<double> &x, const std::vector<double> &y,
              const std::vector<double> &z)
      : at{x, y, z} {
    for (size_t a = 0; a < 3; a++) {
      const std::vector<double> &p = at[a];
      const size_t n = p.size();
      for (size_t k = 1; k < n; k++)
        bound[a].push_back(p[k - 1] / 2 + p[k] / 2);
      bound[a].insert(bound[a].begin(),
                      n > 1 ? 2 * p[0] - bound[a][0] : p[0] - 0.5);
      bound[a].push_back(n > 1 ? 2 * p[n - 1] - bound[a][n - 1] : p[0] + 0.5);
    }
    for (int l = 0; l < HSR_LEVELS; l++) {
      palette.opacity[l] = palette.gradient[l] = ONE;
      std::fill(palette.rgb[l], palette.rgb[l] + 3, ONE);
    }
    palette.ambient = ONE;
    palette.exponent = 1;
  }

  little_grid &keep(const sample &s) {
    kept.push_back(s);
    return *this;
  }
};

/* The arrays of a grid, and a world around them. */
class stage {
  std::vector<uint32_t> row, x;
  std::vector<uint8_t> level, steep;
  std::vector<uint16_t> normal;
  std::vector<std::array<uint8_t, 3>> rgb;

public:
  hsr_grid grid = {};
  hsr_scene scene = {};
  hsr_world world = {};

  explicit stage(little_grid &of) {
    for (size_t a = 0; a < 3; a++) {
      grid.n[a] = uint32_t(of.at[a].size());
      grid.at[a] = of.at[a].data();
      grid.bound[a] = of.bound[a].data();
    }
    for (uint32_t k = 0; k < grid.n[2]; k++)
      for (uint32_t j = 0; j < grid.n[1]; j++) {
        row.push_back(uint32_t(x.size()));
        for (uint32_t i = 0; i < grid.n[0]; i++)
          for (const sample &s : of.kept)
            if (s.at == std::array<uint32_t, 3>{i, j, k}) {
              x.push_back(i);
              level.push_back(s.level);
              steep.push_back(s.steep);
              normal.push_back(s.normal);
              rgb.push_back(s.rgb);
            }
      }
    row.push_back(uint32_t(x.size()));
    grid.n_cells = uint32_t(x.size());
    grid.row = row.data();
    grid.x = x.data();
    grid.level = level.data();
    grid.steep = steep.data();
    grid.normal = normal.data();
    grid.rgb =
        of.colours ? reinterpret_cast<uint8_t(*)[3]>(rgb.data()) : nullptr;
    grid.palette = of.palette;
    scene.subject = HSR_GRID;
    scene.grid = &grid;
    world.roster.scene = &scene;
  }
  stage(const stage &) = delete;
  stage &operator=(const stage &) = delete;
};

/* Parallel: see above. In perspective, D = (x, y, -1) with x and y by `apart`
 * from pixel to pixel. */
struct hsr_view plain_view(int m, int n, double apart, bool parallel = true) {
  struct hsr_view v = {};
  v.m = v.whole_m = m;
  v.n = v.whole_n = n;
  v.window = {0, 0, m, n};
  v.parallel = parallel;
  v.F[2] = -1;
  v.R[0] = m * apart / 2;
  v.U[1] = n * apart / 2;
  return v;
}

void set_before(struct hsr_view *view, const struct hsr_view &before) {
  struct hsr_view_before *b = &view->before;
  b->exists = true;
  b->parallel = before.parallel;
  b->near = before.near;
  for (size_t a = 0; a < 3; a++) {
    b->E[a] = before.E[a];
    b->F[a] = before.F[a];
    b->R[a] = before.R[a];
    b->U[a] = before.U[a];
  }
}

/* `view`, with the eye moved by (x, y, 0) since the view before. In parallel
 * projection a splat was then seen so far from where it is; in perspective too,
 * if it lies on the axis. */
struct hsr_view moved(struct hsr_view view, double x, double y = 0) {
  struct hsr_view before = view;
  before.E[0] -= x;
  before.E[1] -= y;
  set_before(&view, before);
  return view;
}

struct hsr_form plain_form(hsr_model model = HSR_OVER,
                           hsr_splat_kernel kernel = HSR_GAUSSIAN) {
  struct hsr_form form = hsr_form_standard(HSR_COMPOSITED);
  form.values.option[MODEL] = model;
  form.values.option[KERNEL] = kernel;
  return form;
}

struct hsr_form blurred_form(hsr_splat_blur blur = HSR_BLUR_BY_AREA,
                             hsr_model model = HSR_OVER,
                             hsr_splat_kernel kernel = HSR_GAUSSIAN) {
  struct hsr_form form = plain_form(model, kernel);
  form.values.option[BLUR] = blur;
  return form;
}

using pixel = std::array<int, 4>;
using picture = std::vector<pixel>;

/* In pixels that are not written. */
constexpr uint16_t UNTOUCHED = 0xBEEF;

uint64_t n_exact; /* floors and signs sought in rational numbers so far */

picture render(const struct hsr_world &world, const struct hsr_view &view,
               const struct hsr_form &form) {
  struct hsr_answer answer = {};
  struct hsr_error err = {};
  struct hsr_tally tally = {};
  struct hsr_job job = {};
  picture seen;
  if (hsr_answer_make(&answer, &form, &view, false, &err) == HSR_OK) {
    const size_t n = size_t(view.m) * size_t(view.n);
    uint16_t *rgba = hsr_answer_rgba_of(&answer);
    std::fill(rgba, rgba + 4 * n, UNTOUCHED);
    job.world = &world;
    job.view = &view;
    job.tally = &tally;
    job.answer = &answer;
    if (oracle.render(&job, &err) == HSR_OK)
      for (size_t k = 0; k < n; k++)
        seen.push_back(
            {rgba[4 * k], rgba[4 * k + 1], rgba[4 * k + 2], rgba[4 * k + 3]});
  }
  n_exact += tally.count[1];
  if (seen.empty())
    std::printf("# render: %s\n", err.text);
  hsr_answer_free(&answer);
  return seen;
}

picture see(little_grid grid, const struct hsr_view &view,
            const struct hsr_form &form) {
  const stage s(grid);
  return render(s.world, view, form);
}

void ok_pixel(const picture &seen, size_t k, const pixel &wanted,
              const std::string &what) {
  const pixel got = k < seen.size() ? seen[k] : pixel{-1, -1, -1, -1};
  ok(got == wanted, what);
  if (got != wanted)
    std::printf("# got %d %d %d %d, not %d %d %d %d\n", got[0], got[1], got[2],
                got[3], wanted[0], wanted[1], wanted[2], wanted[3]);
}

pixel grey(int value) {
  return {value, value, value, value};
}

/* ---- By hand: one splat ---- */

/* At (0, 0, -4), of a cell of size 1. */
little_grid single() {
  return little_grid({0}, {0}, {-4}).keep({{0, 0, 0}});
}

/* The middle pixel of a row of n of them. */
size_t middle(const struct hsr_view &view) {
  return size_t(view.m) * size_t(view.n / 2) + size_t(view.m / 2);
}

pixel see_middle(const little_grid &grid, const struct hsr_view &view,
                 const struct hsr_form &form) {
  const picture seen = see(grid, view, form);
  return seen.empty() ? pixel{-1, -1, -1, -1} : seen[middle(view)];
}

void ok_middle(const little_grid &grid, const struct hsr_view &view,
               const struct hsr_form &form, const pixel &wanted,
               const std::string &what) {
  ok_pixel({see_middle(grid, view, form)}, 0, wanted, what);
}

/* D = floor(W 65535 / 65536) = W - 1. At a distance of k / 16, kappa is k^2
 * exactly. 67 is no power of two, so that intervals cannot know. */
void test_boundaries() {
  const struct hsr_view view = plain_view(67, 1, 1.0 / 16);
  const picture seen = see(single(), view, plain_form());
  const int weight[][2] = {{0, 28898}, {1, 28748}, {2, 28296}, {4, 26495},
                           {8, 20421}, {16, 7207}, {31, 158}};
  for (const auto &w : weight)
    for (int side : {-1, 1})
      ok_pixel(seen, size_t(33 + side * w[0]), grey(w[1] - 1),
               "kappa is " + std::to_string(w[0] * w[0]) + " exactly");
  ok_pixel(seen, 1, grey(0), "kappa is 1024 exactly");
  ok_pixel(seen, 65, grey(0), "and so on the other side");
  ok_pixel(seen, 66, grey(0), "beyond the splat");

  ok(n_exact > 32, "which intervals did not know");

  struct hsr_view column = plain_view(1, 67, 1.0 / 16);
  const picture down = see(single(), column, plain_form());
  ok(down == seen, "the same down a column");

  /* In perspective D = (x, 0, -1), and rho^2 = 16 x^2. */
  const picture cone =
      see(single(), plain_view(67, 1, 1.0 / 64, false), plain_form());
  ok(cone == seen, "the same in perspective");

  struct hsr_view moved = view;
  moved.offset_x = 0.25;
  moved.E[0] = 1.0 / 64;
  moved.R[0] = view.R[0];
  little_grid grid({1.0 / 32}, {0}, {-4});
  ok(see(grid.keep({{0, 0, 0}}), moved, plain_form()) == seen,
     "with an offset, and the eye and the sample moved as far");
}

/* A cell of 2 x 1 x 1 units around (-1, 0, -4). Pixels of 1/8 unit are k/16
 * cells from its middle. */
void test_oblong() {
  little_grid grid({-1, 1}, {0}, {-4});
  grid.keep({{0, 0, 0}});
  const struct hsr_view view = plain_view(67, 1, 1.0 / 8);
  const picture seen = see(grid, view, plain_form());
  ok_pixel(seen, 33 - 8, grey(28897), "the middle of an oblong cell");
  ok_pixel(seen, 33, grey(20420), "half a cell away");
  ok_pixel(seen, 33 + 8, grey(7206), "a cell away");
}

void test_near() {
  struct hsr_view view = plain_view(3, 3, 1);
  for (const bool parallel : {false, true})
    for (const double near : {3.0, 4.0, 5.0}) {
      view = plain_view(3, 3, 0.25, parallel);
      view.near = near;
      ok_middle(single(), view, plain_form(), grey(near < 4 ? 28897 : 0),
                near < 4   ? "beyond near"
                : near > 4 ? "before near"
                           : "on near");
    }
}

/* R = (3/2, 0, 0), so that D = (-1, 0, -1), (0, 0, -1), (1, 0, -1). */
void test_eye() {
  const struct hsr_view view = plain_view(3, 1, 1, false);
  little_grid behind({0}, {0}, {4});
  ok_middle(behind.keep({{0, 0, 0}}), view, plain_form(), grey(0),
            "behind the eye");
  little_grid at({0}, {0}, {0});
  ok_middle(at.keep({{0, 0, 0}}), view, plain_form(), grey(0), "at the eye");

  /* V = (0, 0, -1): rho = 1 for the outer rays. */
  little_grid around({0}, {0}, {-1});
  picture seen = see(around.keep({{0, 0, 0}}), view, plain_form());
  ok_pixel(seen, 1, grey(28897), "the eye is inside a kernel");
  ok_pixel(seen, 0, grey(7206), "and looks aside, left");
  ok_pixel(seen, 2, grey(7206), "and right");

  /* V = (1, 0, -1) is across the first ray, along the last. With the middle one
   * V.D = 1, |V|^2 = 2, rho^2 = 2 (2 - 1) / 1 = 2: kappa is 512. */
  little_grid aside({1}, {0}, {-1});
  seen = see(aside.keep({{0, 0, 0}}), view, plain_form());
  ok_pixel(seen, 0, grey(0), "a splat across the ray");
  ok_pixel(seen, 2, grey(28897), "a splat on the ray");
  /* W_512 = 1801 - floor(149 / 32) = 1797 */
  ok_pixel(seen, 1, grey(1796), "a splat at half a right angle");

  /* V = (2, 0, -1): V.D = -1 for the first ray. */
  little_grid beside({2}, {0}, {-1});
  seen = see(beside.keep({{0, 0, 0}}), view, plain_form());
  ok_pixel(seen, 0, grey(0), "a splat behind the ray, but before the eye");

  /* V = (3, 0, -1/2) is along D = (6, 0, -1), far from where the part of the
   * kernel that is before the eye seems to be. */
  little_grid wide({3}, {0}, {-0.5});
  seen = see(wide.keep({{0, 0, 0}}), plain_view(13, 1, 1, false), plain_form());
  ok_pixel(seen, 12, grey(28897), "a kernel that reaches behind the eye");
}

/* g = width; e = floor(65536 / width^2). */
void test_width() {
  struct hsr_form form = plain_form();
  const struct hsr_view view = plain_view(67, 1, 1.0 / 16);
  form.values.real[WIDTH] = 2;
  picture seen = see(single(), view, form);
  /* floor(65535 16384 / 65536) = 16383, floor(28898 16383 / 65536) = 7224 */
  ok_pixel(seen, 33, grey(7224), "twice as wide: a quarter of the energy");
  /* floor(20421 16383 / 65536) = 5104 */
  ok_pixel(seen, 33 + 16, grey(5104), "and twice as far");
  /* floor(7207 16383 / 65536) = 1801 */
  ok_pixel(seen, 65, grey(1801), "where a splat not so wide ends");
  form.values.real[WIDTH] = 3;
  /* e = floor(7281.8) = 7281; floor(65535 7281 / 65536) = 7280;
   * floor(28898 7280 / 65536) = 3210 */
  ok_middle(single(), view, form, grey(3210), "thrice as wide");
  form.values.real[WIDTH] = 1.5;
  /* e = floor(29127.1) = 29127; 29126; floor(28898 29126 / 65536) = 12843 */
  ok_middle(single(), view, form, grey(12843), "and by a half");
}

/* Pixels p apart in both directions make g^2 = max(1, p^2), times t^2 in
 * perspective. */
void test_antialias() {
  struct hsr_form form = plain_form();
  form.values.option[ANTIALIAS] = 1;
  for (const double p : {0.5, 1.0})
    ok_middle(single(), plain_view(5, 5, p), form, grey(28897),
              "pixels as far apart as samples, or less");
  ok_middle(single(), plain_view(5, 5, 2), form, grey(7224),
            "pixels twice as far apart");
  /* kappa = floor(64 2^2) = 256; floor(7207 16383 / 65536) = 1801 */
  ok_pixel(see(single(), plain_view(5, 5, 2), form), 13, grey(1801),
           "and a pixel away");
  ok_middle(single(), plain_view(5, 5, 0.25, false), form, grey(28897),
            "at k, in perspective");
  ok_middle(single(), plain_view(5, 5, 0.5, false), form, grey(7224),
            "at 2 k, in perspective");
  form.values.option[ANTIALIAS] = 0;
  ok_middle(single(), plain_view(5, 5, 2), form, grey(28897), "but not if off");
}

/* ---- By hand: colours ---- */

void test_colours() {
  const struct hsr_view view = plain_view(3, 3, 1);
  struct hsr_form form = plain_form();

  /* q = 32768, A = 32767, C = 32767, floor(28898 32767 / 65536) = 14448 */
  form.values.real[ATTENUATE] = 0.5;
  ok_middle(single(), view, form, grey(14448), "attenuated by a half");
  form.values.real[ATTENUATE] = 1;

  /* floor(65536 28897 / 28898) = 65536 - ceil(2.27) */
  form.values.option[NORMALISE] = 1;
  const picture seen = see(single(), view, form);
  ok_pixel(seen, 4, grey(65533), "normalised");
  ok_pixel(see(single(), plain_view(3, 3, 4), form), 0, grey(0),
           "normalised, where no splat is");
  form.values.option[NORMALISE] = 0;

  /* O = 40000, G = 30000: floor(O G / 65535) = 18310. Own colour of bytes 51,
   * 102, 255: 65535 / 25 = 2621, 10485, 65535; times 18310 / 65535: 732, 2929,
   * 18310; and floor(28895 C / 65536). */
  little_grid grid = single();
  grid.kept[0].level = 7;
  grid.kept[0].steep = 9;
  grid.kept[0].rgb = {51, 102, 255};
  grid.palette.opacity[7] = 40000;
  grid.palette.gradient[9] = 30000;
  grid.palette.own_colours = grid.colours = true;
  ok_middle(grid, view, form, {322, 1291, 8073, 8073}, "a colour of its own");
  grid.palette.own_colours = false;
  ok_middle(grid, view, form, grey(8073), "which the palette does not use");
}

/* The code 32 + 64 32 is N = (1, 1, 61). With L = V = (0, 0, 1024), N.N = 3723,
 * the root of N.N L.L is 62480 and c = floor(8192 62464 / 62480) = 8189;
 * x = 2 62464^2 - 1024^2 3723 = 3899654144, s = floor(8192 x / (3723 1024^2)) =
 * 8183 and s_2 = 8174. */
void test_light() {
  const struct hsr_view view = plain_view(3, 3, 1);
  little_grid grid = single();
  grid.kept[0].normal = 32 + 64 * 32;
  grid.palette.eye_light = true;
  grid.palette.ambient = 10000;
  grid.palette.diffuse = 30000;
  grid.palette.specular = 20000;
  grid.palette.exponent = 2;
  /* 10000 + 29989 + floor(20000 8174 / 8192) = 59945; floor(28898 59945 /
   * 65536) = 26432 */
  ok_middle(grid, view, plain_form(), {26432, 26432, 26432, 28897},
            "lit from the eye");
  grid.palette.eye_light = false;
  std::fill(grid.palette.light, grid.palette.light + 3, int16_t(0));
  grid.palette.light[2] = 1024;
  ok_middle(grid, view, plain_form(), {26432, 26432, 26432, 28897},
            "lit from there");
  /* floor(28898 10000 / 65536) = 4409 */
  grid.palette.light[2] = -1024;
  ok_middle(grid, view, plain_form(), {4409, 4409, 4409, 28897},
            "lit from behind");
  grid.palette.light[2] = 0;
  ok_middle(grid, view, plain_form(), {4409, 4409, 4409, 28897},
            "lit from nowhere");
  /* The code 0 is x = y = -63, z = -63: N = (0, 0, -63). */
  grid.kept[0].normal = 0;
  grid.palette.eye_light = true;
  ok_middle(grid, view, plain_form(), {4409, 4409, 4409, 28897}, "turned away");
  /* 10000 + 30000; floor(28898 40000 / 65536) = 17637 */
  grid.kept[0].normal = NO_NORMAL;
  ok_middle(grid, view, plain_form(), {17637, 17637, 17637, 28897},
            "without a normal");
}

/* ---- By hand: models ---- */

/* At t = 2 a half opaque green splat, at t = 4 an opaque red one. Cells are 2
 * long. Given to the middle pixel: floor(28898 32768 / 65536) = 14449 and
 * 28897. */
little_grid two() {
  little_grid grid({0}, {0}, {-4, -2});
  grid.keep({{0, 0, 0}, 0}).keep({{0, 0, 1}, 1});
  grid.palette.opacity[1] = 32768;
  grid.palette.rgb[0][1] = grid.palette.rgb[0][2] = 0;
  grid.palette.rgb[1][0] = grid.palette.rgb[1][2] = 0;
  return grid;
}

void test_two() {
  const struct hsr_view view = plain_view(3, 3, 1);
  /* floor(28897 (65536 - 14449) / 65536) = 22525 */
  for (const hsr_model model : {HSR_OVER, HSR_UNDER, HSR_SHEET})
    ok_middle(two(), view, plain_form(model), {22525, 14449, 0, 36974},
              "two splats, one behind the other");
  struct hsr_form form = plain_form(HSR_XRAY);
  ok_middle(two(), view, form, {28897, 14449, 0, 43346}, "and in xray");
  form.values.real[EXPOSURE] = 2;
  ok_middle(two(), view, form, {57794, 28898, 0, 65535}, "twice exposed");

  /* From the other side green is behind: floor(14449 (65536 - 28897) / 65536) =
   * 8077. */
  struct hsr_view back = view;
  back.F[2] = 1;
  back.R[0] = -view.R[0];
  back.E[2] = -6;
  for (const hsr_model model : {HSR_OVER, HSR_UNDER, HSR_SHEET})
    ok_middle(two(), back, plain_form(model), {28897, 8077, 0, 36974},
              "two splats from behind");

  /* With the eye between them only red is left. */
  struct hsr_view between = view;
  between.E[2] = -3;
  ok_middle(two(), between, plain_form(), {28897, 0, 0, 28897},
            "the eye between two splats");
}

/* Buckets from 2 to 3 and from 3 to 4. Each end is half a cell from a middle:
 * lambda^2 = 1024 (1/4) / 4 = 64. So green gives 23051 to the first and 5847 to
 * the second, and red the other way round:
 *   first: red 5846, green 11525; second: red 23050, green 2923. */
void test_volume() {
  const struct hsr_view view = plain_view(3, 3, 1);
  struct hsr_form form = plain_form(HSR_VOLUME);
  form.values.option[BUCKETS] = 2;
  ok_middle(two(), view, form, {22786, 13673, 0, 36459}, "two buckets");
  form.values.option[BUCKETS] = 1;
  ok_middle(two(), view, form, {28897, 14449, 0, 43346}, "one bucket");

  /* From t = 3 to 4, whose middle is 1/4 of a cell before red, so that lambda =
   * -4: near is where the first begins. Only red exists, and 28898 is divided
   * into 9781 and 19117. */
  form.values.option[BUCKETS] = 2;
  struct hsr_view close = view;
  close.near = 3;
  const pixel red = see_middle(two(), close, form);
  const int wanted = 9780 + 19116 * (65536 - 9780) / 65536;
  ok(red == pixel{wanted, 0, 0, wanted}, "buckets begin at near");
}

/* Beside each other, a pixel between them: kappa = 64, 20420 and 10210. */
void test_sheet() {
  little_grid grid({-0.5, 0.5}, {0}, {-4});
  grid.keep({{0, 0, 0}, 0}).keep({{1, 0, 0}, 1});
  grid.palette = two().palette;
  const struct hsr_view view = plain_view(3, 3, 1);
  ok_middle(grid, view, plain_form(HSR_SHEET), {20420, 10210, 0, 30630},
            "a sheet is a sum");
  /* q = -1 for x, where F is 0, so that the lower index is in front, and
   * floor(10210 (65536 - 20420) / 65536) = 7028. */
  ok_middle(grid, view, plain_form(HSR_OVER), {20420, 7028, 0, 27448},
            "and not what over makes");

  /* F = (0, -1, -1) is as great along y as along z: the two are in different
   * slices of y, and in the one of z. The lower one is behind, and red. */
  little_grid upright({0}, {-0.5, 0.5}, {-4});
  upright.keep({{0, 0, 0}, 0}).keep({{0, 1, 0}, 1});
  upright.palette = grid.palette;
  struct hsr_view down = view;
  down.F[1] = -1;
  down.E[1] = 4;
  const picture sheets = see(upright, down, plain_form(HSR_SHEET));
  ok(!sheets.empty() && sheets == see(upright, down, plain_form(HSR_OVER)) &&
         sheets[4][0] > 0 && sheets[4][1] > 0,
     "of two axes the first");
}

/* Given are 8818, 13228 and 22047 from front to back.
 *   over: 22047, 13228 + floor(22047 52308 / 65536) = 30824,
 *         8818 + floor(30824 56718 / 65536) = 35494
 *   under: 8818, 8818 + floor(13228 56718 / 65536) = 20266,
 *         20266 + floor(22047 45270 / 65536) = 35495 */
void test_three() {
  little_grid grid({0}, {0}, {-6, -4, -2});
  grid.keep({{0, 0, 0}, 2}).keep({{0, 0, 1}, 1}).keep({{0, 0, 2}, 0});
  const struct hsr_view view = plain_view(3, 3, 1);
  grid.palette.opacity[0] = 20000;
  grid.palette.opacity[1] = 30000;
  grid.palette.opacity[2] = 50000;
  ok_middle(grid, view, plain_form(HSR_OVER), grey(35494), "three, over");
  ok_middle(grid, view, plain_form(HSR_UNDER), grey(35495), "three, under");
}

void test_window() {
  struct hsr_view view = plain_view(9, 9, 0.25);
  const picture all = see(two(), view, plain_form());
  view.window = {2, 3, 7, 5};
  const picture part = see(two(), view, plain_form());
  bool good = !all.empty() && !part.empty();
  for (int j = 0; j < 9 && good; j++)
    for (int i = 0; i < 9; i++) {
      const size_t k = size_t(9 * j + i);
      const bool inside = 2 <= i && i < 7 && 3 <= j && j < 5;
      good = good && part[k] == (inside ? all[k] : grey(UNTOUCHED));
    }
  ok(good, "only the window is written");
}

/* ---- By hand: motion blur ---- */

/* A row of pixels 1/16 apart, and a way of 16 of them to the right. By area
 * e = floor(65536 / 1.318310) = 49712; floor(65535 e / 65536) = 49711, and
 * floor(W_k 49711 / 65536). */
const struct {
  int kappa_root, value;
} along_capsule[] = {{0, 21919}, {1, 21806}, {4, 20097},
                     {8, 15489}, {16, 5466}, {31, 119}};

bool is_capsule(const picture &seen, size_t begin, size_t end) {
  if (seen.empty())
    return false;
  for (size_t k = begin; k <= end; k++)
    if (seen[k] != grey(21919))
      return false;
  for (const auto &at : along_capsule)
    if (seen[begin - size_t(at.kappa_root)] != grey(at.value) ||
        seen[end + size_t(at.kappa_root)] != grey(at.value))
      return false;
  return seen[begin - 32] == grey(0) && seen[end + 32] == grey(0) &&
         seen[begin - 31] == grey(119) && seen[end + 31] == grey(119);
}

void test_capsule() {
  const struct hsr_form form = blurred_form();
  const struct hsr_view row = plain_view(99, 1, 1.0 / 16),
                        cone = plain_view(99, 1, 1.0 / 64, false);
  const uint64_t n_before = n_exact;
  const picture seen = see(single(), moved(row, 1), form);
  ok(is_capsule(seen, 49, 49 + 16), "a splat that moved to the right");
  ok(n_exact > n_before + 32, "where intervals did not know");
  ok(is_capsule(see(single(), moved(row, -1), form), 49 - 16, 49),
     "to the left");
  ok(see(single(), moved(plain_view(1, 99, 1.0 / 16), 0, -1), form) == seen,
     "downwards");

  /* D_0 = (1/4, 0, -1), V.D_0 = 4, |V|^2 = 16: Q = (1, 0, 0). */
  ok(see(single(), moved(cone, 1), form) == seen, "in perspective");

  /* The eye before is at -1/4, and sees it at 1/4; or at -4, and at 4/4. */
  struct hsr_view mixed = cone;
  set_before(&mixed, moved(row, 0.25));
  std::copy_n(cone.R, 3, mixed.before.R);
  mixed.before.E[0] = -0.25;
  ok(see(single(), mixed, form) == seen, "in perspective, and parallel before");
  mixed = row;
  set_before(&mixed, cone);
  std::copy_n(row.R, 3, mixed.before.R);
  mixed.before.E[0] = -4;
  ok(see(single(), mixed, form) == seen, "parallel, and in perspective before");

  little_grid other({1}, {0}, {-4});
  other.keep({{0, 0, 0}});
  ok(see(other, moved(row, -1), form) == seen,
     "from the other end, and back: the same");

  for (const bool gone : {false, true}) {
    struct hsr_view first = moved(row, 1);
    first.before.exists = !gone;
    const picture sharp = see(single(), first, gone ? form : plain_form());
    ok(!sharp.empty() && sharp == see(single(), row, plain_form()),
       gone ? "the first view is sharp" : "sharp without blur");
  }
}

/* In the middle pixel, W_0 floor(65535 e / 65536) / 65536. W_0 of crawfis-max
 * is 45871 - floor((45871 - 42622) / 32) = 45770. */
void test_energies() {
  const struct {
    hsr_splat_blur blur;
    hsr_splat_kernel kernel;
    int value;
    const char *what;
  } all[] = {
      {HSR_BLUR_BY_AREA, HSR_GAUSSIAN, 21919, "49712, gaussian by area"},
      {HSR_BLUR_EXACTLY, HSR_GAUSSIAN, 17335, "39315, gaussian exactly"},
      {HSR_BLUR_BY_AREA, HSR_CRAWFIS_MAX, 32480, "46509, crawfis-max by area"},
      {HSR_BLUR_EXACTLY, HSR_CRAWFIS_MAX, 24727, "35407, crawfis-max exactly"}};
  for (const auto &e : all)
    ok_middle(single(), moved(plain_view(3, 3, 1), 1),
              blurred_form(e.blur, HSR_OVER, e.kernel), grey(e.value),
              std::string("e is ") + e.what);
}

/* A way of (1, 1), over pixels 1/2 apart: e = floor(65536 / (1 + c l)) = 45192,
 * l being the root of 2; 45191. */
void test_diagonal() {
  const struct hsr_view view = moved(plain_view(9, 9, 0.5), 1, 1);
  const picture seen = see(single(), view, blurred_form());
  const auto at = [](int x, int y) { return size_t(9 * (4 - y) + 4 + x); };
  ok_pixel(seen, at(0, 0), grey(19926), "the beginning of a diagonal way");
  ok_pixel(seen, at(1, 1), grey(19926), "its middle");
  ok_pixel(seen, at(2, 2), grey(19926), "its end");
  ok_pixel(seen, at(2, 0), grey(9951), "beside it, where kappa is 128 exactly");
  ok_pixel(seen, at(0, 2), grey(9951), "on the other side");
  ok_pixel(seen, at(4, 2), grey(4969), "beyond it, where kappa is 256");
  ok_pixel(seen, at(-2, 0), grey(4969), "and before it");
}

/* A cell of 2 x 1 x 1 units around (-1, 0, -4), which moves by 1 unit: half a
 * cell. e = floor(65536 / 1.159155) = 56537; 56536. Pixels are 1/16 cells. */
void test_oblong_way() {
  little_grid grid({-1, 1}, {0}, {-4});
  grid.keep({{0, 0, 0}});
  const picture seen =
      see(grid, moved(plain_view(67, 1, 1.0 / 8), 1), blurred_form());
  ok_pixel(seen, 33 - 8, grey(24929), "an oblong cell, the beginning");
  ok_pixel(seen, 33, grey(24929), "its end");
  ok_pixel(seen, 33 + 8, grey(17616), "half a cell beyond");
  ok_pixel(seen, 33 - 8 - 16, grey(6217), "a cell before");
}

/* V = (3, 0, -4), |V|^2 = 25. It was seen at D_0 = (0, 0, -1): V.D_0 = 4,
 * Q = 25/4 D_0 - V = (-3, 0, -9/4), l = 15/4. e = floor(65536 / 2.1936625) =
 * 29875; 29874. The pixels have D = (x, 0, -1) with x of -3/4, 0 and 3/4. The
 * splat lies on the last ray, and was on the middle one. */
little_grid passing() {
  little_grid grid({3}, {0}, {-8.5, -4});
  grid.bound[2] = {-9, -4.5, -3.5};
  return grid.keep({{0, 0, 1}});
}

void test_perspective_way() {
  const struct hsr_view view = moved(plain_view(3, 1, 0.75, false), -3);
  picture seen = see(passing(), view, blurred_form());
  ok_pixel(seen, 2, grey(13172), "perspective, the beginning of the way");
  ok_pixel(seen, 1, grey(13172), "its end");
  /* D = (-3/4, 0, -1): V.D = 7/4, Y = 100/7 D - V, which is further along the
   * way by more than the reach. */
  ok_pixel(seen, 0, grey(0), "far beyond its end");

  /* Buckets from 4 to 6.25 and from there to 8.5. The middle ray has V + Q =
   * (0, 0, -25/4), so that t* = 6.25 and lambda = 0: 14450 before and 14448
   * behind. floor(14450 29874 / 65536) = 6586, and 6585: 6586 + floor(6585
   * (65536 - 6586) / 65536) = 12509. The last ray has t* = 4 and tau = 2.25 5/4
   * = 2.8125, more than the reach. */
  struct hsr_form form = blurred_form(HSR_BLUR_BY_AREA, HSR_VOLUME);
  form.values.option[BUCKETS] = 2;
  seen = see(passing(), view, form);
  ok_pixel(seen, 1, grey(12509), "its end is halved by two buckets");
  ok_pixel(seen, 2, grey(13172), "its beginning is in the first one");
}

/* In the middle pixel a blurred splat gives 21919, one that is not 28897. */
void test_threshold() {
  struct hsr_form form = blurred_form();
  const struct hsr_view view = plain_view(3, 3, 1);
  const struct {
    double threshold, x, y;
    int value;
  } all[] = {{0.75, 1, 0, 21919},
             {1, 1, 0, 28897},
             {1, 0, -1, 28897},
             {std::nextafter(1.0, 0.0), 1, 0, 21919},
             {1000, 1, 0, 28897},
             /* The double above the root of 2, and the one below. */
             {0x1.6a09e667f3bcdp+0, 1, 1, 28897},
             {0x1.6a09e667f3bccp+0, 1, 1, 19926},
             {0, 0, 0, 28897}};
  for (const auto &t : all) {
    form.values.real[THRESHOLD] = t.threshold;
    ok_middle(single(), moved(view, t.x, t.y), form, grey(t.value),
              "a way of " + std::to_string(t.x) + ", " + std::to_string(t.y) +
                  " and a threshold of " + std::to_string(t.threshold));
  }
  /* e = floor(65536 / (1 + c 2^-40)) = 65535. floor(65532 e / 65536) = 65531;
   * floor(28898 65531 / 65536) = 28895, and 28896 if it is sharp. */
  little_grid grid = single();
  grid.palette.opacity[0] = 65532;
  ok_middle(grid, view, blurred_form(), grey(28896), "no way");
  ok_middle(grid, moved(view, 0x1p-40), blurred_form(), grey(28895),
            "a very short way");
  ok_middle(grid, moved(view, 0x1p-600), blurred_form(), grey(28895),
            "one whose square is no double");
}

/* t_0 is 4, and the way is a cell long. The pixel to the right is on it, after
 * 7/32 or, in perspective, 7/8 cells. If the splat is sharp kappa is 12 or 196
 * there. */
void test_seen_before() {
  for (const bool parallel : {false, true})
    for (const bool was_parallel : {false, true})
      for (const double near : {3.0, std::nextafter(4.0, 0.0), 4.0, 5.0}) {
        struct hsr_view view = plain_view(3, 3, 7.0 / 32, parallel),
                        before = plain_view(3, 3, 7.0 / 32, was_parallel);
        before.E[0] = was_parallel == parallel ? -1 : parallel ? -4 : -0.25;
        before.near = near;
        set_before(&view, before);
        const int sharp = parallel ? 27090 : 9984;
        ok_pixel(see(single(), view, blurred_form()), 5,
                 grey(near < 4 ? 21919 : sharp),
                 near < 4 ? "it was beyond near" : "it was not beyond near");
      }

  struct hsr_view view = moved(plain_view(3, 3, 0.25, false), 1);
  view.before.E[2] = -8;
  ok_middle(single(), view, blurred_form(), grey(28897),
            "it was behind the eye");
  view.before.E[2] = -4;
  ok_middle(single(), view, blurred_form(), grey(28897),
            "it was beside the eye");
}

/* V = (2, 0, -1) is seen by the last pixel, D = (2, 0, -1), of five. D_0 = (x,
 * 0, -1), V.D_0 = 2 x + 1. The eye before saw it at the depth of 1. */
void test_aside() {
  little_grid grid({2}, {0}, {-1});
  grid.keep({{0, 0, 0}});
  const struct hsr_view view = plain_view(5, 1, 1, false);
  const auto last = [&](double x) {
    const picture seen = see(grid, moved(view, x - 2), blurred_form());
    return seen.empty() ? pixel{} : seen[4];
  };
  ok(last(-1) == grey(28897), "it was seen more than a right angle aside");
  ok(last(-0.5) == grey(28897), "or a right angle exactly");
  ok(last(-0.5 + 0x1p-40) == grey(0), "and by less it is too long to be seen");
  /* D_0 = (0, 0, -1), Q = 5 D_0 - V = (-2, 0, -4); l^2 = 20, e = 27041 */
  ok(last(0) == grey(11923), "before the eye");
}

/* The cell is so many units wide and high. */
little_grid large(double units) {
  little_grid grid({0}, {0}, {-4});
  grid.bound[0] = grid.bound[1] = {-units / 2, units / 2};
  return grid.keep({{0, 0, 0}});
}

double less(double x) {
  return std::nextafter(x, 0);
}

double more(double x) {
  return std::nextafter(x, 2 * x);
}

/* Of ways of so many millions of units, in cells of 1000000 c units: c l is
 * that many. If it is 3, e = 16384: floor(28898 16383 / 65536) = 7224, and 7223
 * if it is 16383. If it is 1, e = 32768: floor(45770 32767 / 65536) = 22884,
 * and 22883 if it is 32767. */
void test_whole_energy() {
  const struct {
    hsr_splat_blur blur;
    hsr_splat_kernel kernel;
    double c, l;
    int value;
  } all[] = {{HSR_BLUR_BY_AREA, HSR_GAUSSIAN, 318310, 3, 7224},
             {HSR_BLUR_EXACTLY, HSR_GAUSSIAN, 666911, 3, 7224},
             {HSR_BLUR_BY_AREA, HSR_CRAWFIS_MAX, 409079, 1, 22884},
             {HSR_BLUR_EXACTLY, HSR_CRAWFIS_MAX, 850918, 1, 22884}};
  const struct hsr_view view = plain_view(3, 3, 1);
  for (const auto &e : all) {
    const struct hsr_form form = blurred_form(e.blur, HSR_OVER, e.kernel);
    const double l = 1000000 * e.l;
    ok_middle(large(e.c), moved(view, l), form, grey(e.value), "e is whole");
    ok_middle(large(e.c), moved(view, less(l)), form, grey(e.value),
              "a shorter way");
    ok_middle(large(e.c), moved(view, more(l)), form, grey(e.value - 1),
              "a longer one");
  }
}

/* The cells are 31831 units. Pixels are 1 x 3 cells: g^2 = 2 (1/4 + 9/4) = 5.
 * The way is (q, 2 q) cells, q = 1180000/31831, so that l^2 = 5 q^2 and g l = 5
 * q: g^2 + c g l = 5 (1 + 11.8) = 64. e = 1024: floor(28898 1023 / 65536) =
 * 451, and 450 if it is 1023. */
void test_irrational_energy() {
  struct hsr_form form = blurred_form();
  form.values.option[ANTIALIAS] = 1;
  struct hsr_view view = plain_view(3, 3, 31831);
  view.U[1] *= 3;
  const double x = 1180000, y = 2360000;
  ok_middle(large(31831), moved(view, x, y), form, grey(451),
            "e is whole, g and l are irrational");
  ok_middle(large(31831), moved(view, less(x), y), form, grey(451),
            "a shorter way");
  ok_middle(large(31831), moved(view, more(x), y), form, grey(450),
            "a longer one");

  /* g^2 = 2 (9/25 + 16/25) = 2, e = 32768; floor(28898 32767 / 65536). */
  view = moved(plain_view(5, 5, 1), 1);
  view.R[0] = 4;
  view.U[1] = 3;
  set_before(&view, moved(view, 1));
  view.before.E[0] = -1;
  form.values.real[THRESHOLD] = 1;
  ok_middle(single(), view, form, grey(14448), "e of one that is not blurred");
}

void test_blurred_window() {
  struct hsr_view view = moved(plain_view(9, 9, 0.25, false), 1.25, -0.75);
  const picture all = see(two(), view, blurred_form());
  bool good = !all.empty();
  for (int j = 0; j < 9; j++)
    for (int i = 0; i < 9 && good; i++) {
      const size_t k = size_t(9 * j + i);
      view.window = {i, j, i + 1, j + 1};
      const picture part = see(two(), view, blurred_form());
      good = part.size() == 81 && part[k] == all[k];
    }
  ok(good && all[40] != grey(0), "blurred, window by window");
}

/* ---- Tables, in closed form ---- */

using Real = long double;
const Real pi = 3.141592653589793238462643383279502884L;

/* The part of a kernel's integral before x, along a line at the distance rho
 * from its middle. */
struct closed_form {
  Real rho2;

  /* Of the gaussian. */
  Real gaussian(Real x) const {
    const Real v = 0.36L;
    return std::exp(-rho2 / (2 * v)) / (2 * pi * v) *
           std::erfc(-x / std::sqrt(2 * v)) / 2;
  }

  /* Half a chord of the sphere of this radius. */
  Real half(Real radius) const {
    return rho2 < radius * radius ? std::sqrt(radius * radius - rho2) : 0;
  }

  /* The integral from 0 to x of a0 + a1 s + a2 s^2 + a3 s^3, where s^2 = rho^2
   * + x^2. */
  Real power(Real x, Real a0, Real a1, Real a2, Real a3) const {
    const Real s = std::sqrt(rho2 + x * x);
    const Real bent =
        rho2 > 0 ? rho2 * std::asinh(x / std::sqrt(rho2)) : Real(0);
    const Real i1 = (x * s + bent) / 2;
    return a0 * x + a1 * i1 + a2 * (rho2 * x + x * x * x / 3) +
           a3 * (x * s * s * s / 4 + 3 * rho2 / 4 * i1);
  }

  /* From 0 to x, x >= 0. */
  Real crawfis_max_from_0(Real x) const {
    const Real r = 1.556228L, b = 0.067599L, c = 0.282474L;
    const Real bend = half(0.88L);
    x = std::min(x, half(r));
    Real sum = power(std::min(x, bend), 0.557526L, 0, -1.157744L, 0.671033L);
    if (x > bend) {
      const Real a0 = b * r * r + c * r * r * r,
                 a1 = -2 * b * r - 3 * c * r * r, a2 = b + 3 * c * r, a3 = -c;
      sum += power(x, a0, a1, a2, a3) - power(bend, a0, a1, a2, a3);
    }
    return sum;
  }
  Real crawfis_max(Real x) const {
    const Real all = crawfis_max_from_0(2),
               part = crawfis_max_from_0(std::fabs(x));
    return x < 0 ? all - part : all + part;
  }
};

constexpr Real ALL = 1000;

/* 65536 times that, for knot i of the tables. x in 32nds of the reach. */
Real entry(hsr_splat_kernel kernel, int i, Real x) {
  const Real r = kernel == HSR_GAUSSIAN ? 2.0L : 1.556228L;
  const closed_form at = {r * r * Real(i) / 64};
  x *= r / 32;
  return 65536 * (kernel == HSR_GAUSSIAN ? at.gaussian(x) : at.crawfis_max(x));
}

/* All weights: at 64 knots, then between them by the mean of two knots,
 * rounded up. */
struct table {
  using knot = std::array<int64_t, 65>; /* lambda + 32; the last is all */
  std::vector<knot> before;             /* by kappa */
  bool falls = true;                    /* no knot is less than the next one */
  Real weights_margin = 1, parts_margin = 1; /* least distances from a half */

  explicit table(hsr_splat_kernel kernel) : before(1024) {
    std::vector<knot> T(65);
    for (int i = 0; i < 64; i++) {
      for (int l = -31; l < 32; l++)
        T[size_t(i)][size_t(l + 32)] =
            rounded(entry(kernel, i, l), &parts_margin);
      T[size_t(i)][64] = rounded(entry(kernel, i, ALL), &weights_margin);
    }
    for (size_t i = 0; i < 64; i++)
      for (size_t l = 0; l < 65; l++)
        falls = falls && T[i][l] >= T[i + 1][l];
    for (size_t k = 0; k < 1024; k++)
      for (size_t l = 0; l < 65; l++) {
        const int64_t part = int64_t(2 * (k % 16) + 1);
        before[k][l] =
            ((32 - part) * T[k / 16][l] + part * T[k / 16 + 1][l] + 31) / 32;
      }
  }

private:
  static int64_t rounded(Real x, Real *margin) {
    *margin = std::min(*margin, std::fabs(x - std::floor(x) - 0.5L));
    return int64_t(std::llround(x));
  }
};

const table &table_of(hsr_splat_kernel kernel) {
  static const table gaussian(HSR_GAUSSIAN), crawfis_max(HSR_CRAWFIS_MAX);
  return kernel == HSR_GAUSSIAN ? gaussian : crawfis_max;
}

const char *name_of(hsr_splat_kernel kernel) {
  return kernel == HSR_GAUSSIAN ? "gaussian" : "crawfis-max";
}

/* floor(1024 x^2 / r^2), with x = a / b, in whole numbers. */
__extension__ typedef __int128 wide;
int square_in_reach(hsr_splat_kernel kernel, int64_t a, int64_t b) {
  const int64_t r = kernel == HSR_GAUSSIAN ? 2000000 : 1556228;
  const wide square = wide(a) * a * 1024 * 1000000 * 1000000;
  return int(std::min<wide>(square / (wide(b) * b * r * r), 1024));
}

/* ---- By hand: frames between two views ---- */

struct hsr_form framed_form(int frames) {
  struct hsr_form form = blurred_form(HSR_BLUR_ACCUMULATE);
  form.values.option[FRAMES] = frames;
  return form;
}

/* A way of 16 pixels to the right. At distances of 0, 8 and 16 pixels a splat
 * gives 28897, 20420 and 7206, as above. The threshold says nothing. */
void test_frames() {
  const struct hsr_view view = moved(plain_view(99, 1, 1.0 / 16), 1);
  struct hsr_form form = framed_form(2);
  form.values.real[THRESHOLD] = 1000;
  const picture two = see(single(), view, form);
  ok_pixel(two, 49, grey((28897 + 7206) / 2), "two frames, the beginning");
  ok_pixel(two, 57, grey(20420), "between them");
  ok_pixel(two, 65, grey((28897 + 7206) / 2), "the end");
  const picture three = see(single(), view, framed_form(3));
  ok_pixel(three, 49, grey((28897 + 20420 + 7206) / 3), "three frames");
  ok_pixel(three, 57, grey((20420 + 28897 + 20420) / 3), "the middle one");
}

/* The eye turns by 90 degrees on the spot, in four frames. Each sees at most one
 * of two splats, which are 30 and 60 degrees from where it began. On the chord it
 * would have turned by 26.6 and 63.4. */
void test_turn() {
  struct hsr_view view = plain_view(3, 3, 1.0 / 64, false), before = view;
  view.F[0] = 1;
  view.F[2] = 0;
  view.R[2] = view.R[0];
  view.R[0] = 0;
  set_before(&view, before);
  const double side = 2 * std::sqrt(3.0);
  little_grid one({2}, {0}, {-side}), other({side}, {0}, {-2});
  for (little_grid *grid : {&one, &other})
    ok_middle(grid->keep({{0, 0, 0}}), view, framed_form(4), grey(28897 / 4),
              "a turn is no chord");
}

/* Without a view before, or from another projection, the picture is sharp. */
void test_no_way() {
  const struct hsr_view row = plain_view(99, 1, 1.0 / 16);
  const picture sharp = see(single(), row, plain_form());
  ok(!sharp.empty() && see(single(), row, framed_form(5)) == sharp,
     "frames without a view before: one");
  struct hsr_view mixed = row;
  set_before(&mixed, plain_view(99, 1, 1.0 / 64, false));
  ok(see(single(), mixed, framed_form(5)) == sharp,
     "and none from another projection");
}

/* The claim of the definition, and the same of parts. */
void test_margins() {
  for (const hsr_splat_kernel kernel : {HSR_CRAWFIS_MAX, HSR_GAUSSIAN}) {
    const table &t = table_of(kernel);
    std::printf("# %s: no weight is within %.3Le of a half, no weight before "
                "lambda within %.3Le\n",
                name_of(kernel), t.weights_margin, t.parts_margin);
    ok(t.weights_margin > 1e-6L,
       std::string("weights are not near halves, ") + name_of(kernel));
    ok(t.parts_margin > 1e-6L,
       std::string("weights before lambda are not near halves, ") +
           name_of(kernel));
    ok(t.falls,
       std::string("no knot is less than the next one, ") + name_of(kernel));
  }
}

/* All weights, from a row of 16384 pixels across a splat. */
void test_weights() {
  const int m = 16384;
  for (const hsr_splat_kernel kernel : {HSR_CRAWFIS_MAX, HSR_GAUSSIAN}) {
    const picture seen = see(single(), plain_view(m, 1, 1.0 / 4096),
                             plain_form(HSR_OVER, kernel));
    std::vector<bool> met(1025);
    bool good = !seen.empty();
    for (int i = 0; i < m && good; i++) {
      const int kappa = square_in_reach(kernel, 2 * i + 1 - m, 8192);
      const int64_t W =
          kappa < 1024 ? table_of(kernel).before[size_t(kappa)][64] : 1;
      met[size_t(kappa)] = true;
      good = seen[size_t(i)] == grey(W ? int(W - 1) : 0);
    }
    ok(good && std::count(met.begin(), met.begin() + 1024, true) == 1024,
       std::string("all weights, ") + name_of(kernel));
  }
}

/* All weights before lambda: the middle of five samples, a cell apart, and
 * depths of it from -2 to 2. By buckets of 1/16 cells lambda is exactly reached
 * at each end, if the kernel is the gaussian. */
void test_parts() {
  const int m = 1024;
  const hsr_splat_kernel kernels[] = {HSR_GAUSSIAN, HSR_CRAWFIS_MAX};
  for (const hsr_splat_kernel kernel : kernels) {
    const int buckets = kernel == HSR_GAUSSIAN ? 64 : 1024;
    little_grid grid({0}, {0}, {-12, -11, -10, -9, -8});
    grid.keep({{0, 0, 2}});
    struct hsr_form form = plain_form(HSR_VOLUME, kernel);
    form.values.option[BUCKETS] = buckets;
    const picture seen = see(grid, plain_view(m, 1, 1.0 / 256), form);

    bool good = !seen.empty();
    for (int i = 0; i < m && good; i++) {
      const int kappa = square_in_reach(kernel, 2 * i + 1 - m, 512);
      int64_t E = 0, after = 0;
      if (kappa < 1024) {
        const auto &before = table_of(kernel).before[size_t(kappa)];
        after = before[64];
        for (int b = buckets - 1; b >= 0; b--) {
          const int64_t x = 4 * b - 2 * buckets;
          const int size =
              int(std::sqrt(double(square_in_reach(kernel, x, buckets))));
          const int64_t w = b ? before[size_t(32 + (x < 0 ? -size : size))] : 0;
          const int64_t D = (after - w) * 65535 / 65536;
          E = D + E * (65536 - D) / 65536;
          after = w;
        }
      }
      good = seen[size_t(i)] == grey(int(E));
    }
    ok(good, std::string("weights before lambda, ") + name_of(kernel));
  }
}

/* R = 389057 / 64 and m = 5^6, so that pixels are 2 R / m = r / 2 apart:
 * kappa is 0, 256 and 1024. */
void test_reach() {
  struct hsr_view view = plain_view(15625, 1, 0);
  view.R[0] = 389057.0 / 64;
  view.U[1] = 1;
  view.window = {7812, 0, 7815, 1};
  const picture seen =
      see(single(), view, plain_form(HSR_OVER, HSR_CRAWFIS_MAX));
  const auto &before = table_of(HSR_CRAWFIS_MAX).before;
  for (const int k : {0, 1})
    ok_pixel(seen, size_t(7812 + k), grey(int(before[size_t(256 * k)][64]) - 1),
             "at 0 or half the reach of crawfis-max exactly");
  ok_pixel(seen, 7814, grey(0), "at its reach exactly");

  /* The double nearest to 1.556228 is less than r. Pixels are 2 R / 3 apart:
   * less than r / 2, and more than half of that double. */
  struct hsr_view close = plain_view(3, 1, 0);
  close.R[0] = 0x1.2acbb7f9d6f11p+0;
  close.U[1] = 1;
  ok_pixel(see(single(), close, plain_form(HSR_OVER, HSR_CRAWFIS_MAX)), 2,
           grey(int(before[255][64]) - 1), "less than half the reach by 1e-17");
}

/* ---- The definition, written a second time ---- */

using Q = CGAL::Gmpq;
using triple = std::array<Q, 3>;

Q dot(const triple &a, const triple &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* det(a, b, c). */
Q det(const triple &a, const triple &b, const triple &c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) +
         a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* The greatest integer that is at most x, but at most 2^20. */
int64_t floor_of(const Q &x) {
  if (x >= Q(1 << 20))
    return 1 << 20;
  int64_t k = int64_t(std::floor(CGAL::to_double(x)));
  while (Q(double(k)) > x)
    k--;
  while (Q(double(k + 1)) <= x)
    k++;
  return k;
}

int64_t root_of(wide x) {
  int64_t low = 0, high = INT64_C(1) << 40;
  while (high - low > 1) {
    const int64_t middle = (low + high) / 2;
    (wide(middle) * middle <= x ? low : high) = middle;
  }
  return low;
}

int64_t floor_quotient(wide a, wide b) {
  return b == 0 ? 0 : int64_t(a >= 0 ? a / b : -((-a + b - 1) / b));
}

triple operator-(const triple &a, const triple &b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/* What became of the splats of a picture, as to blur. */
struct fates {
  size_t blurred = 0, unseen = 0, aside = 0, still = 0;
};

class definition {
  const hsr_grid &g;
  const hsr_view &v;
  const hsr_splatting o; /* all but its model */
  triple from, F, R, U;
  std::array<int, 3> eye;

  struct splat {
    std::array<int, 3> at;
    triple P, size;
    Q g2, g2r2;
    bool blurred = false;
    triple way; /* Q, if blurred, and l^2 */
    Q way2;
    int64_t e, C[4];
  };
  std::vector<splat> splats; /* from front to back */
  std::vector<Q> ends;       /* of buckets, but for the last */

  /* One that covers the pixel, its kappa, and its lambda at all ends. */
  struct covering {
    const splat *s;
    int64_t kappa;
    std::vector<int64_t> lambda;
  };
  using sums = std::array<int64_t, 5>;

  static triple as_triple(const double a[3]) {
    return {Q(a[0]), Q(a[1]), Q(a[2])};
  }
  triple divided(const triple &a, const triple &size) const {
    return {a[0] / size[0], a[1] / size[1], a[2] / size[2]};
  }
  Q depth(const triple &P) const {
    const triple d = {P[0] - from[0], P[1] - from[1], P[2] - from[2]};
    return det(d, R, U) / det(F, R, U);
  }
  struct line {
    triple begin, along;
  };
  line line_at(const Q &x, const Q &y) const {
    line l = {from, F};
    for (size_t a = 0; a < 3; a++)
      (v.parallel ? l.begin : l.along)[a] += x * R[a] + y * U[a];
    return l;
  }
  /* Y, by V' and D'. */
  triple nearest(const triple &V, const triple &D) const {
    const Q VD = dot(V, D),
            times = v.parallel ? VD / dot(D, D) : dot(V, V) / VD;
    return triple{times * D[0], times * D[1], times * D[2]} - V;
  }
  Q c() const {
    const bool area = o.blur == HSR_BLUR_BY_AREA;
    return (o.kernel == HSR_GAUSSIAN ? Q(area ? 318310 : 666911)
                                     : Q(area ? 409079 : 850918)) /
           Q(1000000);
  }
  Q r2() const {
    return o.kernel == HSR_GAUSSIAN ? Q(4) : Q(1556228) * Q(1556228) / Q(1e12);
  }

  void find_eye();
  void find_ends();
  void find_splats();
  void add_splat(const std::array<int, 3> &at, uint32_t cell);
  void find_way(splat *s);
  int64_t energy(const splat &s) const;
  void find_colour(uint32_t cell, int64_t C[4]) const;
  std::vector<covering> covers(int i, int j) const;
  sums given(const covering &c, int64_t weight) const;
  int64_t weight(const covering &c, int64_t lambda) const {
    return table_of(o.kernel).before[size_t(c.kappa)][size_t(lambda + 32)];
  }
  static void over(sums *E, sums D);
  sums sheet(const std::vector<covering> &all) const;
  sums volume(const std::vector<covering> &all) const;
  sums fold(hsr_model model, const std::vector<covering> &all) const;
  pixel finish(hsr_model model, const sums &E) const;

public:
  definition(const hsr_grid &grid, const hsr_view &view,
             const hsr_splatting &options)
      : g(grid), v(view), o(options), from(as_triple(view.E)),
        F(as_triple(view.F)), R(as_triple(view.R)), U(as_triple(view.U)) {
    find_eye();
    find_ends();
    find_splats();
  }

  size_t n_covered = 0;
  fates fate;
  /* The pictures of all models. */
  std::array<picture, HSR_XRAY + 1> draw();
};

void definition::find_eye() {
  for (size_t a = 0; a < 3; a++) {
    const double *begin = g.bound[a], *end = begin + g.n[a];
    eye[a] = int(std::upper_bound(begin, end, v.E[a]) - begin) - 1;
    if (v.parallel)
      eye[a] = v.F[a] < 0 ? int(g.n[a]) - 1 : -1;
  }
}

void definition::find_ends() {
  std::vector<Q> depths;
  for (const double x : {g.at[0][0], g.at[0][g.n[0] - 1]})
    for (const double y : {g.at[1][0], g.at[1][g.n[1] - 1]})
      for (const double z : {g.at[2][0], g.at[2][g.n[2] - 1]})
        depths.push_back(depth({Q(x), Q(y), Q(z)}));
  const Q first = std::max(*std::min_element(depths.begin(), depths.end()),
                           Q(v.near)),
          last = *std::max_element(depths.begin(), depths.end());
  if (first < last)
    for (int b = 1; b < o.buckets; b++)
      ends.push_back(first + (last - first) * Q(b) / Q(o.buckets));
}

/* By octants, then by distances from the eye's cell. */
void definition::find_splats() {
  const auto place = [&](size_t a, int high, int away) {
    const int k = high >> a & 1 ? eye[a] + 1 + away : eye[a] - away;
    return k >= 0 && k < int(g.n[a]) ? k : -1;
  };
  const int most = int(std::max({g.n[0], g.n[1], g.n[2]})) + 1;
  for (int high = 0; high < 8; high++)
    for (int z = 0; z < most; z++)
      for (int y = 0; y < most; y++)
        for (int x = 0; x < most; x++) {
          const std::array<int, 3> at = {place(0, high, x), place(1, high, y),
                                         place(2, high, z)};
          if (at[0] < 0 || at[1] < 0 || at[2] < 0)
            continue;
          const uint32_t row = uint32_t(at[1]) + g.n[1] * uint32_t(at[2]);
          for (uint32_t c = g.row[row]; c < g.row[row + 1]; c++)
            if (g.x[c] == uint32_t(at[0]))
              add_splat(at, c);
        }
}

void definition::add_splat(const std::array<int, 3> &at, uint32_t cell) {
  splat s;
  s.at = at;
  for (size_t a = 0; a < 3; a++) {
    s.P[a] = Q(g.at[a][at[a]]);
    const double size = g.bound[a][at[a] + 1] - g.bound[a][at[a]];
    s.size[a] = Q(size);
  }
  const Q t = depth(s.P);
  if (t <= Q(v.near))
    return;
  Q g2 = 1;
  if (o.antialias) {
    const triple u = divided(U, s.size), r = divided(R, s.size);
    g2 = Q(2) * (dot(u, u) / Q(v.n) / Q(v.n) + dot(r, r) / Q(v.m) / Q(v.m));
    if (!v.parallel)
      g2 *= t * t;
    g2 = std::max(g2, Q(1));
  }
  s.g2 = g2 * Q(o.width) * Q(o.width);
  s.g2r2 = s.g2 * r2();
  find_way(&s);
  s.e = energy(s);
  find_colour(cell, s.C);
  splats.push_back(s);
}

/* By Cramer's rule: away = t_0 F_0 + a R_0 + b U_0. */
void definition::find_way(splat *s) {
  if (o.blur == HSR_SHARP || !v.before.exists)
    return;
  const triple F_0 = as_triple(v.before.F), R_0 = as_triple(v.before.R),
               U_0 = as_triple(v.before.U), away = s->P - as_triple(v.before.E);
  const Q all = det(F_0, R_0, U_0), t_0 = det(away, R_0, U_0) / all;
  Q x = det(F_0, away, U_0) / all, y = det(F_0, R_0, away) / all;
  if (t_0 <= Q(v.before.near)) {
    fate.unseen++;
    return;
  }
  if (!v.before.parallel) {
    x /= t_0;
    y /= t_0;
  }
  const line l = line_at(x, y);
  const triple V = divided(s->P - l.begin, s->size),
               D = divided(l.along, s->size);
  if (!v.parallel && dot(V, D) <= Q(0)) {
    fate.aside++;
    return;
  }
  s->way = nearest(V, D);
  s->way2 = dot(s->way, s->way);
  s->blurred = s->way2 > Q(o.threshold) * Q(o.threshold);
  (s->blurred ? fate.blurred : fate.still)++;
}

/* The greatest k with k (g^2 + c g l) <= 65536. */
int64_t definition::energy(const splat &s) const {
  if (!s.blurred)
    return floor_of(Q(65536) / s.g2);
  const auto fits = [&](int64_t k) {
    const Q times = Q(double(k)), left = Q(65536) - times * s.g2,
            right = times * c();
    return left >= Q(0) && left * left >= right * right * s.g2 * s.way2;
  };
  int64_t k = 0;
  for (int64_t step = 1 << 17; step > 0; step /= 2)
    while (fits(k + step))
      k += step;
  return k;
}

void definition::find_colour(uint32_t cell, int64_t C[4]) const {
  const hsr_palette &p = g.palette;
  const int level = g.level[cell], code = g.normal[cell];
  int64_t A = int64_t(p.opacity[level]) * p.gradient[g.steep[cell]] / 65535;
  A = A * o.attenuate / 65536;
  int64_t c = 8192, s_n = 0;
  if (code < 4096) {
    const int x = 2 * (code & 63) - 63, y = 2 * (code >> 6) - 63,
              z = 63 - std::abs(x) - std::abs(y);
    wide N[3] = {x, y, z}, L[3], V[3], NL = 0, NN = 0, LL = 0, NV = 0, LV = 0,
         VV = 0;
    if (z < 0) {
      N[0] = (63 - std::abs(y)) * (x > 0 ? 1 : -1);
      N[1] = (63 - std::abs(x)) * (y > 0 ? 1 : -1);
    }
    for (int a = 0; a < 3; a++) {
      V[a] = -wide(std::nearbyint(1024 * v.F[a]));
      L[a] = p.eye_light ? V[a] : p.light[a];
      NL += N[a] * L[a], NN += N[a] * N[a], LL += L[a] * L[a];
      NV += N[a] * V[a], LV += L[a] * V[a], VV += V[a] * V[a];
    }
    const auto clamped = [](int64_t k) {
      return std::min<int64_t>(8192, std::max<int64_t>(0, k));
    };
    c = clamped(floor_quotient(8192 * NL, root_of(NN * LL)));
    int64_t s = clamped(
        floor_quotient(8192 * (2 * NL * NV - LV * NN), NN * root_of(LL * VV)));
    if (c == 0)
      s = 0;
    s_n = s;
    for (int k = 1; k < p.exponent; k++)
      s_n = s_n * s / 8192;
  }
  for (int k = 0; k < 3; k++) {
    int64_t B = p.rgb[level][k];
    if (g.rgb && p.own_colours)
      B = int64_t(65535) * g.rgb[cell][k] * g.rgb[cell][k] / 65025;
    const int64_t lit = B * (p.ambient + p.diffuse * c / 8192) / 65535 +
                        p.specular * s_n / 8192;
    C[k] = std::min<int64_t>(65535, lit) * A / 65535;
  }
  C[3] = A;
}

std::vector<definition::covering> definition::covers(int i, int j) const {
  const Q m(v.m), n(v.n);
  const Q x = (Q(2) * Q(hsr_sample_x(&v, i)) - m) / m,
          y = (n - Q(2) * Q(hsr_sample_y(&v, j))) / n;
  const line l = line_at(x, y);
  std::vector<covering> all;
  for (const splat &s : splats) {
    const triple V = divided(s.P - l.begin, s.size),
                 along = divided(l.along, s.size);
    const Q VV = dot(V, V), VD = dot(V, along), DD = dot(along, along);
    if (!v.parallel && VD <= Q(0))
      continue;
    Q rho2 =
        v.parallel ? VV - VD * VD / DD : VV * (VV * DD - VD * VD) / (VD * VD);
    Q middle = VD / DD;
    if (s.blurred) {
      const triple Y = nearest(V, along), left = Y - s.way;
      const Q YQ = dot(Y, s.way);
      if (YQ >= s.way2) {
        rho2 = dot(left, left);
        middle += dot(s.way, along) / DD;
      } else if (YQ > Q(0)) {
        rho2 -= YQ * YQ / s.way2;
        middle += YQ / s.way2 * dot(s.way, along) / DD;
      }
    }
    covering c = {&s, floor_of(Q(1024) * rho2 / s.g2r2), {}};
    if (c.kappa >= 1024)
      continue;
    for (const Q &t_b : ends) {
      const Q past = t_b - middle, tau2 = past * past * DD;
      const int64_t size =
          std::min<int64_t>(32, root_of(floor_of(Q(1024) * tau2 / s.g2r2)));
      c.lambda.push_back(past < Q(0) ? -size : size);
    }
    all.push_back(c);
  }
  return all;
}

definition::sums definition::given(const covering &c, int64_t weight) const {
  sums D;
  for (size_t k = 0; k < 4; k++)
    D[k] = weight * (c.s->C[k] * c.s->e / 65536) / 65536;
  D[4] = weight * c.s->e / 65536;
  return D;
}

void definition::over(sums *E, sums D) {
  for (size_t k = 0; k < 5; k++)
    (*E)[k] = D[k] + (*E)[k] * (65536 - D[3]) / 65536;
}

definition::sums definition::sheet(const std::vector<covering> &all) const {
  size_t a = 0;
  for (size_t b = 1; b < 3; b++)
    if (std::fabs(v.F[b]) > std::fabs(v.F[a]))
      a = b;
  std::vector<int> slices;
  for (int k = int(g.n[a]) - 1; k > eye[a]; k--)
    slices.push_back(k);
  for (int k = 0; k <= eye[a]; k++)
    slices.push_back(k);
  sums E = {};
  for (const int k : slices) {
    sums sheet = {};
    for (const covering &c : all)
      for (size_t l = 0; l < 5 && c.s->at[a] == k; l++)
        sheet[l] += given(c, weight(c, 32))[l];
    for (int64_t &l : sheet)
      l = std::min<int64_t>(l, 65535);
    over(&E, sheet);
  }
  return E;
}

definition::sums definition::volume(const std::vector<covering> &all) const {
  sums E = {};
  for (size_t b = ends.size() + 1; b-- > 0;) {
    sums bucket = {};
    for (const covering &c : all) {
      const int64_t end = b < ends.size() ? c.lambda[b] : 32,
                    begin = b > 0 ? c.lambda[b - 1] : -32;
      const sums D = given(c, weight(c, end) - weight(c, begin));
      for (size_t l = 0; l < 5; l++)
        bucket[l] += D[l];
    }
    for (int64_t &l : bucket)
      l = std::min<int64_t>(l, 65535);
    over(&E, bucket);
  }
  return E;
}

definition::sums definition::fold(hsr_model model,
                                  const std::vector<covering> &all) const {
  sums E = {};
  if (model == HSR_SHEET)
    return sheet(all);
  if (model == HSR_VOLUME)
    return volume(all);
  for (size_t k = 0; k < all.size(); k++) {
    const covering &c = all[model == HSR_OVER ? all.size() - 1 - k : k];
    const sums D = given(c, weight(c, 32));
    const int64_t left = model == HSR_UNDER ? 65536 - E[3] : 65536;
    if (model == HSR_OVER)
      over(&E, D);
    else
      for (size_t l = 0; l < 5; l++)
        E[l] += D[l] * left / 65536;
  }
  return E;
}

pixel definition::finish(hsr_model model, const sums &E) const {
  pixel p;
  for (size_t k = 0; k < 4; k++) {
    wide x = E[k];
    if (o.normalise)
      x = floor_quotient(65536 * x, E[4]);
    else if (model == HSR_XRAY)
      x = x * wide(o.exposure) / 65536;
    p[k] = int(std::min<wide>(x, 65535));
  }
  return p;
}

std::array<picture, HSR_XRAY + 1> definition::draw() {
  std::array<picture, HSR_XRAY + 1> all;
  for (int j = 0; j < v.n; j++)
    for (int i = 0; i < v.m; i++) {
      const std::vector<covering> here = covers(i, j);
      n_covered += here.size();
      for (int model = HSR_OVER; model <= HSR_XRAY; model++)
        all[size_t(model)].push_back(
            finish(hsr_model(model), fold(hsr_model(model), here)));
    }
  return all;
}

/* ---- Random grids ---- */

class dice {
  std::mt19937_64 engine;

public:
  explicit dice(uint64_t seed) : engine(seed) {}
  int whole(int low, int high) {
    return low + int(engine() % uint64_t(high - low + 1));
  }
  bool odd() { return whole(0, 1); }
  uint16_t word() { return uint16_t(whole(0, 65535)); }
  double real(double low, double high) {
    return low + (high - low) * double(engine() >> 11) / 0x1p53;
  }
};

/* Positions by quarters, or by any doubles. */
std::vector<double> random_positions(dice &d, bool by_quarters) {
  std::vector<double> at;
  double x = by_quarters ? d.whole(-4, 4) : d.real(-2, 2);
  for (int n = d.whole(2, 4); n > 0; n--) {
    at.push_back(x);
    x += by_quarters ? d.whole(1, 6) / 4.0 : d.real(0.3, 1.6);
  }
  return at;
}

void random_palette(dice &d, hsr_palette *p) {
  const bool faint = d.odd();
  for (int l = 0; l < HSR_LEVELS; l++) {
    p->opacity[l] = uint16_t(faint ? d.word() / 4 : d.word());
    p->gradient[l] = uint16_t(d.odd() ? ONE : d.word());
    for (uint16_t &c : p->rgb[l])
      c = d.word();
  }
  p->own_colours = d.odd();
  p->ambient = d.word() / 2;
  p->diffuse = d.word();
  p->specular = d.word();
  p->exponent = d.whole(1, 12);
  p->eye_light = d.odd();
  for (int16_t &l : p->light)
    l = int16_t(d.whole(-700, 700));
}

little_grid random_grid(dice &d, bool by_quarters) {
  std::vector<double> at[3];
  for (auto &axis : at)
    axis = random_positions(d, by_quarters);
  little_grid grid(at[0], at[1], at[2]);
  random_palette(d, &grid.palette);
  grid.colours = d.odd();
  for (uint32_t k = 0; k < at[2].size(); k++)
    for (uint32_t j = 0; j < at[1].size(); j++)
      for (uint32_t i = 0; i < at[0].size(); i++)
        if (d.whole(0, 2) || grid.kept.empty()) {
          sample s = {{i, j, k}};
          s.level = uint8_t(d.whole(0, 255));
          s.steep = uint8_t(d.whole(0, 255));
          s.normal = uint16_t(d.whole(0, 4200));
          for (uint8_t &c : s.rgb)
            c = uint8_t(d.whole(0, 255));
          grid.keep(s);
        }
  return grid;
}

/* From anywhere around or inside, towards a sample; or along an axis, from the
 * bound of a cell. */
struct hsr_view random_view(dice &d, const little_grid &grid, bool parallel) {
  struct hsr_camera c = {};
  const bool along = d.whole(0, 3) == 0;
  const size_t axis = size_t(d.whole(0, 2));
  for (size_t a = 0; a < 3; a++) {
    const std::vector<double> &at = grid.at[a], &bound = grid.bound[a];
    const double size = bound.back() - bound.front();
    c.at[a] = at[size_t(d.whole(0, int(at.size()) - 1))];
    c.eye[a] = d.real(bound[0] - size, bound.back() + size);
    if (along)
      c.eye[a] = c.at[a] = bound[size_t(d.whole(0, int(at.size())))];
  }
  if (along)
    c.eye[axis] += d.odd() ? 3.5 : -3.5;
  c.up[(axis + 1) % 3] = 1;
  c.up[(axis + 2) % 3] = 0.25;
  c.fov = d.real(30, 110);
  c.near = d.odd() ? 0 : d.real(0, 3);
  c.parallel = parallel ? d.real(2, 8) : 0;
  struct hsr_view view = {};
  struct hsr_error err = {};
  const int m = d.whole(4, 7), n = d.whole(4, 6);
  if (hsr_view_init(&view, &c, m, n, &err))
    std::printf("# view: %s\n", err.text);
  if (d.odd()) {
    view.offset_x = d.whole(-7, 7) / 16.0;
    view.offset_y = d.whole(-7, 7) / 16.0;
  }
  return view;
}

struct hsr_form random_form(dice &d, hsr_splat_kernel kernel) {
  struct hsr_form form = plain_form(HSR_OVER, kernel);
  long *option = form.values.option;
  double *real = form.values.real;
  real[WIDTH] = d.odd() ? 1 : d.real(1, 2.5);
  option[ANTIALIAS] = d.odd();
  real[ATTENUATE] = d.odd() ? 1 : d.real(0, 1);
  option[NORMALISE] = d.whole(0, 3) == 0;
  real[EXPOSURE] = d.odd() ? 1 : d.real(0, 3);
  option[BUCKETS] = d.whole(1, 9);
  return form;
}

/* A view before that is `near` a view: by a quarter of a unit, or less, or not
 * at all. */
struct hsr_view little_earlier(dice &d, const struct hsr_view &view) {
  struct hsr_view before = view;
  const int how = d.whole(0, 3);
  for (size_t a = 0; a < 3; a++) {
    before.E[a] += how == 1  ? d.whole(-2, 2) / 4.0
                   : how > 1 ? d.real(-0.3, 0.3)
                             : 0;
    if (how == 3)
      before.F[a] += d.real(-0.1, 0.1);
  }
  return before;
}

/* One from anywhere; or one that goes far, even to behind the splats; or one
 * whose screen is small and upside down, so that splats were seen far from its
 * middle, on the other side. */
struct hsr_view much_earlier(dice &d, const little_grid &grid,
                             const struct hsr_view &view) {
  struct hsr_view before = random_view(d, grid, d.odd());
  const int how = d.whole(0, 2);
  if (how == 0)
    return before;
  before = view;
  const double far = d.real(-4, 8);
  for (size_t a = 0; a < 3; a++) {
    if (how == 1)
      before.E[a] += far * view.F[a];
    if (how == 2) {
      before.R[a] /= -8;
      before.U[a] /= -8;
    }
  }
  return before;
}

/* What random pictures are made of. */
struct subject {
  little_grid grid;
  struct hsr_view view;
  struct hsr_form form;

  subject(int number, bool parallel, hsr_splat_kernel kernel, bool moves)
      : subject(dice(uint64_t(4 * number + 2 * parallel + kernel)), number,
                parallel, kernel, moves) {}

  subject(const little_grid &of, const struct hsr_view &seen,
          const struct hsr_form &asked)
      : grid(of), view(seen), form(asked) {}

private:
  subject(dice d, int number, bool parallel, hsr_splat_kernel kernel,
          bool moves)
      : grid(random_grid(d, number % 2)), view(random_view(d, grid, parallel)),
        form(random_form(d, kernel)) {
    if (!moves)
      return;
    set_before(&view,
               d.odd() ? little_earlier(d, view) : much_earlier(d, grid, view));
    view.before.near = d.odd() ? view.near : d.real(0, 3);
    form.values.option[BLUR] = d.whole(HSR_BLUR_BY_AREA, HSR_BLUR_EXACTLY);
    form.values.real[THRESHOLD] = d.odd() ? 0 : d.real(0, 1.5);
  }
};

struct tried {
  size_t wrong = 0, pictures = 0, covered = 0;
  fates fate;
};

void try_subject(const subject &of, const std::string &what, tried *sum) {
  little_grid grid = of.grid;
  const stage s(grid);
  struct hsr_form form = of.form;
  definition wanted(s.grid, of.view, hsr_form_splatting(&form));
  const auto pictures = wanted.draw();
  sum->covered += wanted.n_covered;
  sum->fate.blurred += wanted.fate.blurred;
  sum->fate.unseen += wanted.fate.unseen;
  sum->fate.aside += wanted.fate.aside;
  sum->fate.still += wanted.fate.still;
  for (int model = HSR_OVER; model <= HSR_XRAY; model++) {
    form.values.option[MODEL] = model;
    sum->pictures++;
    if (render(s.world, of.view, form) == pictures[size_t(model)])
      continue;
    std::printf("# %s, model %d\n", what.c_str(), model);
    sum->wrong++;
  }
}

tried try_all(int grids, bool moves) {
  tried sum;
  for (int k = 0; k < grids; k++)
    for (const bool parallel : {false, true})
      for (const hsr_splat_kernel kernel : {HSR_CRAWFIS_MAX, HSR_GAUSSIAN})
        try_subject(subject(k, parallel, kernel, moves),
                    "grid " + std::to_string(k) +
                        (parallel ? ", parallel" : "") + ", " + name_of(kernel),
                    &sum);
  std::printf("# %zu pictures, %zu times a splat over a pixel\n", sum.pictures,
              sum.covered);
  return sum;
}

void test_random() {
  const tried sharp = try_all(24, false);
  ok(sharp.wrong == 0 && sharp.covered > 5000,
     "as the definition written a second time");
}

/* V = (1, 0, -1) / 2^40 of the near splat. In the first pixel D = (b - 1, 0,
 * -1) with b = 1 / (3 2^51), and D_0 is the same. V.D = b / 2^40, whose sign no
 * interval knows; Y = Q, which has 17378 cells. It is seen at the depth |V|^2 /
 * V.D = 12288, in the second of four buckets. The other one is in the first. */
void test_distant_way() {
  little_grid grid({-1, 0x1p-40}, {0}, {-40000, -1, -0x1p-40});
  grid.bound[0] = {-1.5, -0.5, 0.5};
  grid.bound[2] = {-40000.5, -1.5, -0.5, 0.5};
  grid.keep({{1, 0, 2}}).keep({{0, 0, 1}});
  struct hsr_view view = plain_view(3, 1, 1, false),
                  before = plain_view(3, 1, 2);
  view.R[0] = less(1.5);
  before.E[0] = 2 + 0x1p-40;
  set_before(&view, before);
  struct hsr_form form = blurred_form();
  form.values.option[BUCKETS] = 4;
  tried sum;
  try_subject({grid, view, form}, "a distant way", &sum);
  ok(sum.wrong == 0 && sum.fate.blurred == 2,
     "a way from the eye to the far distance");
}

/* Models of random grids that did not move, and of some that did not move
 * enough. */
void test_still() {
  bool good = true;
  for (int k = 0; k < 10 && good; k++)
    for (int model = HSR_OVER; model <= HSR_XRAY; model++) {
      subject s(k, k % 4 < 2, HSR_CRAWFIS_MAX, false);
      s.form.values.option[MODEL] = model;
      const picture sharp = see(s.grid, s.view, s.form);
      s.form.values.option[BLUR] = HSR_BLUR_BY_AREA;
      const picture same = see(s.grid, moved(s.view, 0), s.form);
      s.form.values.real[THRESHOLD] = 1000;
      const picture close = see(s.grid, moved(s.view, 0.25), s.form);
      good = good && !sharp.empty() && sharp == same && sharp == close;
    }
  ok(good, "what is still is sharp");
}

void test_random_motion() {
  const tried moved = try_all(40, true);
  const fates &n = moved.fate;
  std::printf("# splats: %zu blurred; not seen before %zu, aside %zu, hardly "
              "moved %zu\n",
              n.blurred, n.unseen, n.aside, n.still);
  ok(moved.wrong == 0 && moved.covered > 10000, "and with motion blur");
  ok(n.blurred > 1000 && n.unseen > 100 && n.aside > 50 && n.still > 100,
     "in all cases");
}

/* ---- Without memory ---- */

void test_memory() {
  little_grid grid = two();
  const stage s(grid);
  const struct hsr_view view = moved(plain_view(2, 2, 1), 1);
  struct hsr_form form = blurred_form(HSR_BLUR_EXACTLY, HSR_VOLUME);
  struct hsr_answer answer = {};
  struct hsr_tally tally = {};
  struct hsr_error err = {};
  const bool made =
      hsr_answer_make(&answer, &form, &view, false, &err) == HSR_OK;
  struct hsr_job job = {};
  job.world = &s.world;
  job.view = &view;
  job.tally = &tally;
  job.answer = &answer;
  if (!made)
    std::exit(99);
  ok_without_memory(oracle, job, true, [] {});
  hsr_answer_free(&answer);
}

void test_descriptor() {
  ok(!std::strcmp(oracle.name, "splat-oracle") &&
         oracle.taxonomy == HSR_YARDSTICK && oracle.flags & HSR_JUDGE &&
         oracle.makes[0].kind == HSR_COMPOSITED &&
         oracle.subjects == 1 << HSR_GRID && oracle.makes[0].words == 0,
     "the descriptor");
}

} /* namespace */

int main() {
  test_descriptor();
  test_boundaries();
  test_oblong();
  test_near();
  test_eye();
  test_width();
  test_antialias();
  test_colours();
  test_light();
  test_two();
  test_volume();
  test_sheet();
  test_three();
  test_window();
  test_capsule();
  test_energies();
  test_diagonal();
  test_oblong_way();
  test_perspective_way();
  test_threshold();
  test_seen_before();
  test_aside();
  test_whole_energy();
  test_irrational_energy();
  test_blurred_window();
  test_frames();
  test_turn();
  test_no_way();
  test_margins();
  test_weights();
  test_parts();
  test_reach();
  test_random();
  test_still();
  test_distant_way();
  test_random_motion();
  test_memory();
  return finish();
}
