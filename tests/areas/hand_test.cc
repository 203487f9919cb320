/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Areas in pixels that are computed by hand, in both projections; sums under
 * subdivision of the picture; and the intervals of the area oracle, which must be
 * the tightest around the exact values. */
#include "bench/modules/modules.h"
#include "algorithms/setup.h"
#include "tests/areas/shares.h"
#include "tests/draw.h"
#include "tests/tap.h"
#include "common/answers/filter.h"
#include "common/answers/kinds/area.h"

#include <cmath>
#include <cstring>

namespace {

struct tap tests;

/* The share of a face in pixel (i, j) of a drawn scene. */
void is(drawn &scene, int i, int j, uint32_t face, const mpq_class &wanted,
        const char *what) {
  const mpq_class got = scene.share_of(i, j, face);
  if (!ok(&tests, got == wanted, "%s: %s of pixel (%d, %d)", what,
          wanted.get_str().c_str(), i, j))
    std::printf("# got %s\n", got.get_str().c_str());
}

const char *projection(bool parallel) {
  return parallel ? "parallel" : "perspective";
}

std::vector<corner> rectangle(double x0, double y0, double x1, double y1,
                              double w) {
  return {{x0, y0, w}, {x0, y1, w}, {x1, y1, w}, {x1, y0, w}};
}

/* ---- One face ---- */

void check_triangles(bool parallel) {
  const char *how = projection(parallel);
  drawn inside(4, parallel);
  inside.face({{1.25, 1.25, 3}, {1.75, 1.5, 3}, {1.5, 1.75, 3}});
  is(inside, 1, 1, 0, mpq_class(3, 32), how);
  is(inside, 1, 1, HSR_BACKGROUND, mpq_class(29, 32), how);
  is(inside, 2, 1, 0, 0, how);

  drawn cutting(4, parallel);
  cutting.face({{.5, .5, 2}, {.5, 3.5, 2}, {3.5, .5, 2}});
  is(cutting, 0, 0, 0, mpq_class(1, 4), how);
  is(cutting, 1, 1, 0, 1, how);
  is(cutting, 2, 1, 0, mpq_class(1, 2), how);
  is(cutting, 3, 0, 0, mpq_class(1, 8), how);
  is(cutting, 3, 3, 0, 0, how);

  /* Corners outside of the picture. To its right are x = (y + 1)/2 until y = 3,
   * and x = (7 - y)/2. */
  drawn far(4, parallel);
  far.face({{-1, -3, 2}, {-1, 9, 2}, {2, 3, 2}});
  is(far, 0, 0, 0, mpq_class(3, 4), how);
  is(far, 0, 3, 0, 1, how);
  is(far, 1, 0, 0, 0, how);
  is(far, 1, 3, 0, mpq_class(3, 4), how);
}

/* A frame whose hole is joined to its border by a cut of no width; through the
 * hole a face behind it is seen, over half of it. */
void check_hole(bool parallel) {
  const char *how = projection(parallel);
  drawn scene(4, parallel);
  scene.face({{1, 1, 2},
              {1, 2, 2},
              {2, 2, 2},
              {2, 1, 2},
              {1, 1, 2},
              {1.25, 1.25, 2},
              {1.75, 1.25, 2},
              {1.75, 1.75, 2},
              {1.25, 1.75, 2},
              {1.25, 1.25, 2}});
  scene.face(rectangle(0, 0, 1.5, 4, 5));
  is(scene, 1, 1, 0, mpq_class(3, 4), how);
  is(scene, 1, 1, 1, mpq_class(1, 8), how);
  is(scene, 1, 1, HSR_BACKGROUND, mpq_class(1, 8), how);
}

void check_sides(bool parallel) {
  const char *how = projection(parallel);
  drawn scene(4, parallel);
  std::vector<corner> back = rectangle(0, 0, 4, 4, 2);
  scene.face({back[3], back[2], back[1], back[0]}, true);
  scene.face(rectangle(0, 0, 2.5, 4, 3), true);
  is(scene, 2, 1, 0, 0, how);
  is(scene, 2, 1, 1, mpq_class(1, 2), how);
}

/* ---- Several faces ---- */

/* Along sx, 1/w falls from 1/2 to 1/8 and is 1/4 at 8/3; w rises from 2 to 8 and
 * is 4 at 4/3. */
void check_planes_that_meet(bool parallel) {
  const char *how = projection(parallel);
  drawn scene(4, parallel);
  scene.face(rectangle(0, 0, 4, 4, 4));
  scene.face({{0, 0, 2}, {0, 4, 2}, {4, 4, 8}, {4, 0, 8}});
  is(scene, 0, 2, 1, 1, how);
  is(scene, 3, 2, 0, 1, how);
  is(scene, parallel ? 1 : 2, 2, 1,
     parallel ? mpq_class(1, 3) : mpq_class(2, 3), how);
  is(scene, parallel ? 1 : 2, 2, 0,
     parallel ? mpq_class(2, 3) : mpq_class(1, 3), how);
}

void check_twins(bool parallel) {
  const char *how = projection(parallel);
  drawn scene(4, parallel);
  scene.face(rectangle(0, 0, 1.5, 4, 3));
  scene.face(rectangle(0, 0, 1.75, 4, 3));
  scene.face(rectangle(0, 0, 4, 4, 3));
  is(scene, 1, 1, 0, mpq_class(1, 2), how);
  is(scene, 1, 1, 1, mpq_class(1, 4), how);
  is(scene, 1, 1, 2, mpq_class(1, 4), how);
}

/* ---- Near ---- */

/* A floor one below the eye, from behind it to w = 8: abs x <= 1/w and y = -1/w.
 * So it shows where abs(sx - 2) <= sy - 2 and 9/4 <= sy; up to w = 2 it does not
 * exist if that is near, which is sy = 3. */
void check_floor() {
  const std::vector<std::array<double, 3>> floor = {
      {-1, -1, 8}, {1, -1, 8}, {1, -1, -8}, {-1, -1, -8}};
  drawn whole(4, false), cut(4, false, 2), deep(4, false, 1.6);
  whole.face_at(floor);
  cut.face_at(floor);
  deep.face_at(floor);
  is(whole, 2, 2, 0, mpq_class(15, 32), "a floor");
  is(whole, 2, 3, 0, 1, "a floor");
  is(whole, 3, 3, 0, mpq_class(1, 2), "a floor");
  is(whole, 2, 1, 0, 0, "a floor");
  is(cut, 1, 2, 0, mpq_class(15, 32), "a floor from near on");
  is(cut, 1, 3, 0, 0, "a floor from near on");
  /* sy - 2 = 2/near, near being the double next to 8/5 */
  const mpq_class height = 2 / mpq_class(1.6) - 1;
  is(deep, 2, 3, 0, height, "a floor from near on");
}

/* In parallel a plane that rises from w = -4 to w = 4, seen beyond near = 1: 5/8
 * of its length on, which is sx = 5/2. */
void check_slope() {
  drawn scene(4, true, 1);
  scene.face({{0, 0, -4}, {0, 4, -4}, {4, 4, 4}, {4, 0, 4}});
  is(scene, 2, 0, 0, mpq_class(1, 2), "a slope from near on");
  is(scene, 1, 0, 0, 0, "a slope from near on");
  is(scene, 3, 0, 0, 1, "a slope from near on");
}

/* ---- Sums ---- */

/* A pixel of m x n is four of 2m x 2n. */
bool is_quartered(const hsr_world &world, const hsr_camera &camera, int m,
                  int n) {
  hsr_view coarse, fine;
  must_view(&coarse, &camera, m, n);
  must_view(&fine, &camera, 2 * m, 2 * n);
  const std::vector<shares> one = shares_of(world, coarse),
                            four = shares_of(world, fine);
  bool good = true;
  for (int j = 0; j < n; j++)
    for (int i = 0; i < m; i++) {
      shares sum;
      mpq_class all = 0;
      for (int k = 0; k < 4; k++)
        for (const auto &s :
             four[size_t((2 * j + k / 2) * 2 * m + 2 * i + k % 2)])
          sum[s.first] += s.second / 4;
      for (const auto &s : sum)
        all += s.second;
      good = good && all == 1 && sum == one[size_t(j * m + i)];
    }
  return good;
}

/* All windows that the picture is cut into give the same shares. */
bool is_windowed(const hsr_world &world, const hsr_view &whole, int filter) {
  const enum hsr_area_filter f = hsr_area_filter(filter);
  const std::vector<shares> all = shares_of(world, whole, f);
  const int m = whole.m, n = whole.n, x = m / 3 + 1, y = n / 2 + 1;
  bool good = true;
  for (const hsr_window &w : {hsr_window{0, 0, x, y}, hsr_window{x, 0, m, y},
                              hsr_window{0, y, x, n}, hsr_window{x, y, m, n}}) {
    hsr_view part = whole;
    part.window = w;
    const std::vector<shares> some = shares_of(world, part, f);
    size_t k = 0;
    for (int j = w.y0; j < w.y1; j++)
      for (int i = w.x0; i < w.x1; i++)
        good = good && some[k++] == all[size_t(j * m + i)];
  }
  return good;
}

/* ---- Intervals ---- */

mpq_class exactly(double x) {
  return mpq_class(x);
}

bool is_tightest(const hsr_area_bounds &b, const mpq_class &value) {
  if (exactly(b.lo) == value)
    return b.hi == b.lo;
  return exactly(b.lo) < value && value < exactly(b.hi) &&
         b.hi == std::nextafter(b.lo, INFINITY);
}

/* The area oracle's answer against the values by definition. */
bool has_tightest(const hsr_world &world, const hsr_view &view, int filter) {
  const hsr_algorithm *oracle = hsr_algorithm_find("area-oracle")->plain;
  hsr_choice choice = hsr_choice_standard(oracle);
  choice.form.values.option[0] = filter;
  hsr_setup setup;
  hsr_answer answer;
  hsr_error err;
  hsr_tally tally = {};
  hsr_arena scratch = HSR_ARENA_EMPTY;
  hsr_job job = {};
  job.view = &view;
  job.tally = &tally;
  job.scratch = &scratch;
  job.answer = &answer;
  must_setup(&setup, oracle, &choice, &world);
  if (hsr_answer_make(&answer, &choice.form, &view, false, &err) ||
      hsr_setup_render(&setup, &job, &err))
    bail("%s", err.text);
  const std::vector<shares> all =
      shares_of(world, view, hsr_area_filter(filter));
  const hsr_area_bounds *bounds = hsr_answer_areas_of(&answer);
  bool good = true;
  for (const shares &pixel : all)
    for (int c = 0; c < 3; c++) {
      mpq_class value = 0;
      for (const auto &s : pixel) {
        uint16_t rgb[3];
        hsr_filter_colour(&world, &view, s.first, rgb);
        value += s.second * mpq_class(rgb[c], 65535);
      }
      good = good && is_tightest(*bounds++, value);
    }
  hsr_answer_free(&answer);
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  return good;
}

void check_scene(const char *name, int most_degree) {
  hsr_scene *scene;
  hsr_world world;
  hsr_view view;
  scene = must_open(name);
  must_world(&world, scene);
  must_view(&view, &scene->views[0], 11, 9);
  ok(&tests, is_quartered(world, scene->views[0], 11, 9),
     "%s: quarters of pixels add up to the same areas, and to 1", name);
  for (int filter = 0; filter <= most_degree; filter++) {
    ok(&tests, is_windowed(world, view, filter),
       "%s, degree %d: the same in windows", name, filter);
    ok(&tests, has_tightest(world, view, filter),
       "%s, degree %d: the tightest intervals", name, filter);
  }
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* Values that are doubles: a half of a colour of 65535. */
void check_doubles() {
  drawn scene(4, false);
  scene.face(rectangle(0, 0, 1.5, 4, 2));
  scene.face(rectangle(1.25, 0, 4, 4, 5));
  for (int filter = 0; filter < 4; filter++)
    ok(&tests, has_tightest(scene.world(), scene.view(), filter),
       "halves, degree %d: the tightest intervals", filter);
}

} // namespace

int main() {
  tests = plan(2 * (12 + 3 + 2 + 4 + 3) + 7 + 3 + 3 * 9 + 5 + 4);
  for (const bool parallel : {false, true}) {
    check_triangles(parallel);
    check_hole(parallel);
    check_sides(parallel);
    check_planes_that_meet(parallel);
    check_twins(parallel);
  }
  check_floor();
  check_slope();
  check_scene("house", 3);
  check_scene("harbor@parallel=same", 1);
  check_scene("penetration", 3);
  check_scene("lattice:30:5@parallel=same", 3);
  check_doubles();
  return finish(&tests);
}
