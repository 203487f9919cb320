/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of one visible face, in random pixels of random scenes: on lattices
 * of whole numbers, where many lines meet, and those that are hard on floating
 * point numbers. Half of the views are parallel.
 *
 * In each pixel the areas of the cells add up to 1 exactly. Points at random,
 * and points next to the corners of cells, show the face that the point oracle
 * says, which shares no code with the cells. A point on a line shows that of one
 * of the cells beside it. And the picture, which finds by halved windows what
 * may be seen in a pixel, has the same areas.
 *
 * usage: cells_test [SCENES [SEED]]    standard: 400 of either sort, seed 1 */
#include "bench/modules/modules.h"
#include "algorithms/setup.h"
#include "bench/judge/areas/cells.h"
#include "tests/areas/shares.h"
#include "tests/conformance/hard_scene.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <cmath>
#include <cstdlib>
#include <vector>

namespace {

using areas::Upward;

/* ---- Cells ---- */

/* A cell that is kept. */
struct kept_cell {
  uint32_t face;
  std::vector<std::array<mpz_class, 3>> corner; /* X, Y, W */
};

struct keeper : areas::sink {
  std::vector<kept_cell> all;
  void take(const areas::cell &part, const areas::shape *seen) override {
    kept_cell made = {seen ? seen->id : HSR_BACKGROUND, {}};
    for (areas::point *p : part.corner) {
      p->make_exact();
      made.corner.push_back({p->X, p->Y, p->W});
    }
    all.push_back(made);
  }
};

mpq_class area(const kept_cell &c) {
  mpq_class twice = 0;
  for (size_t i = 0; i < c.corner.size(); i++) {
    const auto &a = c.corner[i], &b = c.corner[(i + 1) % c.corner.size()];
    mpq_class turn(a[0] * b[1] - b[0] * a[1], a[2] * b[2]);
    turn.canonicalize();
    twice += turn;
  }
  return twice / 2;
}

/* 1: inside; 0: on the border; -1: outside. */
int side_of(const kept_cell &c, const std::array<mpz_class, 3> &p) {
  int least = 1;
  for (size_t i = 0; i < c.corner.size(); i++) {
    const auto &a = c.corner[i], &b = c.corner[(i + 1) % c.corner.size()];
    const mpz_class turn = a[0] * (b[1] * p[2] - p[1] * b[2]) -
                           a[1] * (b[0] * p[2] - p[0] * b[2]) +
                           a[2] * (b[0] * p[1] - p[0] * b[1]);
    least = std::min(least, sgn(turn));
  }
  return least;
}

/* Not inlined, so that all of it is done in one rounding mode. */
[[gnu::noinline]] std::vector<kept_cell>
cells_of(const hsr_world &world, const hsr_view &view, int i, int j) {
  const Upward upward;
  const areas::stage on(world, view);
  std::vector<std::unique_ptr<areas::shape>> shapes;
  std::vector<areas::shape *> all;
  for (uint32_t f = 0; f < world.n_faces; f++)
    if (auto made = areas::make_shape(on, f)) {
      all.push_back(made.get());
      shapes.push_back(std::move(made));
    }
  keeper to;
  areas::cut({2 * i, 2 * j, 2 * i + 2, 2 * j + 2}, all, to);
  return to.all;
}

/* ---- The point oracle ---- */

class asked {
public:
  explicit asked(const hsr_world &world) {
    must_setup(&setup_, hsr_algorithm_find("oracle")->plain, nullptr, &world);
  }
  ~asked() {
    hsr_setup_free(&setup_);
    hsr_arena_free(&scratch_);
  }
  asked(const asked &) = delete;
  asked &operator=(const asked &) = delete;

  /* The face at (i + 1/2 + x, j + 1/2 + y). */
  uint32_t face_at(const hsr_view &of, int i, int j, double x, double y) {
    hsr_view view = of;
    view.offset_x = x;
    view.offset_y = y;
    view.window = {i, j, i + 1, j + 1};
    std::vector<uint32_t> ids(size_t(view.m) * size_t(view.n));
    hsr_tally tally = {};
    hsr_error err;
    hsr_job job = {};
    job.view = &view;
    job.scratch = &scratch_;
    job.tally = &tally;
    hsr_answer answer = hsr_answer_of_ids(ids.data(), view.m, view.n);
    job.answer = &answer;
    if (hsr_setup_render(&setup_, &job, &err))
      bail("%s", err.text);
    return ids[size_t(j) * size_t(view.m) + size_t(i)];
  }

private:
  hsr_setup setup_;
  hsr_arena scratch_ = HSR_ARENA_EMPTY;
};

/* ---- Pixels ---- */

struct tally {
  long scenes, pixels, cells, points, on_lines, sums, faces, shares;
};

constexpr long UNIT = 1L << 40; /* points are multiples of 1/UNIT */

/* A point of the pixel, in units from its corner. */
struct spot {
  long x, y;
};

/* Puts a point to the cells and to the oracle. */
void check_point(asked *oracle, const hsr_view &view, int i, int j,
                 const std::vector<kept_cell> &cells, spot at, tally *t) {
  if (at.x <= 0 || at.y <= 0 || at.x >= UNIT || at.y >= UNIT)
    return;
  const uint32_t face =
      oracle->face_at(view, i, j, double(at.x - UNIT / 2) / double(UNIT),
                      double(at.y - UNIT / 2) / double(UNIT));
  const std::array<mpz_class, 3> p = {
      i * mpz_class(UNIT) + at.x, j * mpz_class(UNIT) + at.y, mpz_class(UNIT)};
  bool good = false, inside = false;
  for (const kept_cell &c : cells) {
    const int side = side_of(c, p);
    inside = inside || side > 0;
    good = good || (side >= 0 && c.face == face);
  }
  if (!good && t->faces < 5) {
    std::printf("# pixel (%d, %d), point (%ld, %ld) / 2^40: face %d; cells:", i,
                j, at.x, at.y, int(face));
    for (const kept_cell &c : cells)
      if (side_of(c, p) >= 0)
        std::printf(" of face %d", int(c.face));
    std::puts("");
  }
  t->points++;
  t->on_lines += !inside;
  t->faces += !good;
}

void check_points(uint64_t *seed, asked *oracle, const hsr_view &view, int i,
                  int j, const std::vector<kept_cell> &cells, tally *t) {
  for (int k = 0; k < 30; k++)
    check_point(
        oracle, view, i, j, cells,
        {draw_integer(seed, 1, UNIT - 1), draw_integer(seed, 1, UNIT - 1)}, t);
  for (int k = 0; k < 30; k++) {
    const kept_cell &c =
        cells[size_t(draw_integer(seed, 0, int64_t(cells.size()) - 1))];
    const auto &corner =
        c.corner[size_t(draw_integer(seed, 0, int64_t(c.corner.size()) - 1))];
    const mpz_class x = UNIT * (corner[0] - i * corner[2]) / corner[2],
                    y = UNIT * (corner[1] - j * corner[2]) / corner[2];
    const long far = 1L << draw_integer(seed, 0, 36);
    check_point(oracle, view, i, j, cells,
                {x.get_si() + draw_integer(seed, -far, far),
                 y.get_si() + draw_integer(seed, -far, far)},
                t);
  }
}

void check_pixel(uint64_t *seed, const hsr_world &world, const hsr_view &of,
                 asked *oracle, tally *t) {
  hsr_view view = of;
  const int i = int(draw_integer(seed, 0, view.m - 1)),
            j = int(draw_integer(seed, 0, view.n - 1));
  const std::vector<kept_cell> cells = cells_of(world, view, i, j);
  mpq_class sum = 0;
  shares by_face;
  for (const kept_cell &c : cells) {
    const mpq_class a = area(c);
    sum += a;
    by_face[c.face] += a;
    t->sums += a <= 0;
  }
  t->sums += sum != 1;
  check_points(seed, oracle, view, i, j, cells, t);
  view.window = {i, j, i + 1, j + 1};
  t->shares += shares_of(world, view).front() != by_face;
  t->pixels++;
  t->cells += long(cells.size());
}

/* ---- Scenes ---- */

/* False if the scene is not valid. */
bool check_scene(uint64_t *seed, hsr_scene *scene, const hsr_camera &camera,
                 const char *name, tally *t) {
  hsr_world world;
  hsr_view view;
  const int m = int(draw_integer(seed, 1, 8)),
            n = int(draw_integer(seed, 1, 8));
  const bool valid = !hsr_world_init(&world, scene, nullptr) &&
                     !hsr_view_init(&view, &camera, m, n, nullptr);
  if (valid) {
    const tally before = *t;
    asked oracle(world);
    for (int k = 0; k < 3; k++)
      check_pixel(seed, world, view, &oracle, t);
    t->scenes++;
    if (t->sums + t->faces + t->shares !=
        before.sums + before.faces + before.shares)
      std::printf("# %s, %d x %d: %ld sums, %ld faces, %ld shares\n", name, m,
                  n, t->sums - before.sums, t->faces - before.faces,
                  t->shares - before.shares);
  }
  hsr_world_free(&world);
  return valid;
}

void check_lattice(uint64_t *seed, tally *t) {
  char name[64];
  std::snprintf(name, sizeof name, "lattice:%d:%d",
                int(draw_integer(seed, 3, 40)),
                int(draw_integer(seed, 1, 1000000000)));
  hsr_scene *scene;
  scene = must_open(name);
  hsr_camera camera = scene->views[draw_integer(seed, 0, scene->n_views - 1)];
  draw_parallel(seed, &camera, 8);
  check_scene(seed, scene, camera, name, t);
  hsr_scene_delete(scene);
}

void check_hard(uint64_t number, tally *t) {
  char name[64];
  std::snprintf(name, sizeof name, "hard scene %llu",
                static_cast<unsigned long long>(number));
  hsr_camera camera;
  enum hard_scale scale;
  hsr_scene *scene = hard_scene(number, &camera, &scale);
  if (!scene)
    return;
  check_scene(&number, scene, camera, name, t);
  hsr_scene_delete(scene);
}

void tell(struct tap *tap, const char *what, const tally &t) {
  ok(tap, t.sums == 0 && t.pixels > 0,
     "%s: the areas of a pixel are positive and add up to 1: %ld pixels, %ld "
     "cells",
     what, t.pixels, t.cells);
  ok(tap, t.faces == 0 && t.points > t.on_lines,
     "%s: the oracle's faces: %ld points, %ld of them on lines", what, t.points,
     t.on_lines);
  ok(tap, t.shares == 0, "%s: the same areas from halved windows", what);
}

} // namespace

int main(int argc, char **argv) {
  const long n = argc > 1 ? std::atol(argv[1]) : 400;
  uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  struct tap tap = plan(6);
  tally lattices = {}, hard = {};
  const uint64_t first = seed;
  for (long k = 0; k < n; k++)
    check_lattice(&seed, &lattices);
  for (long k = 0; k < n; k++)
    check_hard(first + uint64_t(k), &hard);
  tell(&tap, "lattices", lattices);
  tell(&tap, "hard scenes", hard);
  return finish(&tap);
}
