/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Visible polygons against exact areas. The sides of the cycles are lines by
 * name. Their functions are taken from the yardstick, crossed, and the cycles
 * clipped to each pixel, all in rational numbers. The areas that a face has so in
 * each pixel must be those of the yardstick. Both the polygon oracle and the
 * algorithm are put to this; and their samples to the point oracle.
 *
 * usage: polygons_test [SCENES [SEED]]      standard: 60 lattices and 60 hard
 *                                         scenes, seed 1 */
#include "bench/modules/modules.h"
#include "algorithms/setup.h"
#include "bench/judge/areas/cells.h"
#include "tests/areas/shares.h"
#include "tests/conformance/hard_scene.h"
#include "tests/draw.h"
#include "tests/tap.h"
#include "common/answers/kinds/polygons.h"

#include <memory>

namespace {

struct spot {
  mpq_class x, y;
};
using cycle = std::vector<spot>;

/* ---- Lines by name ---- */

class lines {
public:
  lines(const hsr_world &world, const hsr_view &view)
      : view_(view), on_(world, view) {}

  areas::whole_affine of(const hsr_line_name &name) {
    switch (name.kind) {
    case HSR_LINE_EDGE:
      return of_face(name.a).edge[name.b].exactly();
    case HSR_LINE_ROW:
      return of_face(name.a).row[name.b].exactly();
    case HSR_LINE_NEAR:
      return of_face(name.a).near.exactly();
    case HSR_LINE_HORIZON:
      return of_face(name.a).s.exactly();
    case HSR_LINE_MEETING: {
      areas::line difference;
      areas::compare_depths(of_face(name.a), of_face(name.b), &difference);
      return difference.exactly();
    }
    default:
      return border(hsr_border(name.a));
    }
  }

private:
  const hsr_view &view_;
  const areas::stage on_;
  std::map<uint32_t, std::unique_ptr<areas::shape>> shapes_;

  areas::shape &of_face(uint32_t f) {
    std::unique_ptr<areas::shape> &known = shapes_[f];
    if (!known && !(known = areas::make_shape(on_, f)))
      bail("a line of a face that covers nothing");
    return *known;
  }
  areas::whole_affine border(enum hsr_border b) const {
    switch (b) {
    case HSR_LEFT:
      return {1, 0, 0};
    case HSR_TOP:
      return {0, 1, 0};
    case HSR_RIGHT:
      return {1, 0, -view_.m};
    default:
      return {0, 1, -view_.n};
    }
  }
};

spot crossing(const areas::whole_affine &f, const areas::whole_affine &g) {
  const mpz_class w = f.a * g.b - f.b * g.a;
  if (w == 0)
    bail("lines of a cycle do not cross");
  spot s = {mpq_class(mpz_class(f.b * g.c - f.c * g.b), w),
            mpq_class(mpz_class(f.c * g.a - f.a * g.c), w)};
  s.x.canonicalize();
  s.y.canonicalize();
  return s;
}

/* ---- Clipping ---- */

/* Where a x + b y >= c; the part may have sides that run to and fro. */
cycle clipped(const cycle &all, int a, int b, int c) {
  cycle kept;
  const auto side = [&](const spot &p) {
    return mpq_class(a * p.x + b * p.y - c);
  };
  for (size_t i = 0; i < all.size(); i++) {
    const spot &p = all[i], &q = all[(i + 1) % all.size()];
    const mpq_class at_p = side(p), at_q = side(q);
    if (at_p >= 0)
      kept.push_back(p);
    if (sgn(at_p) * sgn(at_q) < 0) {
      const mpq_class t = at_p / (at_p - at_q);
      kept.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
  }
  return kept;
}

mpq_class area(const cycle &around) {
  mpq_class twice = 0;
  for (size_t i = 0; i < around.size(); i++) {
    const spot &p = around[i], &q = around[(i + 1) % around.size()];
    twice += p.x * q.y - q.x * p.y;
  }
  return twice / 2;
}

/* Adds to each pixel what a cycle covers of it. */
void add_cycle(const cycle &all, uint32_t face, const hsr_view &view,
               std::vector<shares> *pixels) {
  for (int j = 0; j < view.n; j++) {
    const cycle row = clipped(clipped(all, 0, 1, j), 0, -1, -(j + 1));
    for (int i = 0; i < view.m && !row.empty(); i++) {
      const mpq_class part =
          area(clipped(clipped(row, 1, 0, i), -1, 0, -(i + 1)));
      if (part != 0)
        (*pixels)[size_t(j * view.m + i)][face] += part;
    }
  }
}

/* Not inlined, so that all of it is done in one rounding mode. */
[[gnu::noinline]] std::vector<shares> areas_of(const hsr_polygons &polygons,
                                               const hsr_world &world,
                                               const hsr_view &view) {
  const areas::Upward upward;
  std::vector<shares> pixels(size_t(view.m) * size_t(view.n));
  lines named(world, view);
  for (size_t r = 0; r < polygons.n_regions; r++) {
    const hsr_polygon_region &region = polygons.region[r];
    for (size_t c = region.first; c < region.first + region.n; c++) {
      const hsr_polygon_side *side = polygons.side + polygons.cycle[c].first;
      const size_t n = polygons.cycle[c].n;
      cycle around;
      for (size_t k = 0; k < n; k++)
        around.push_back(crossing(named.of(side[k ? k - 1 : n - 1].line),
                                  named.of(side[k].line)));
      add_cycle(around, region.face, view, &pixels);
    }
  }
  for (shares &pixel : pixels) {
    mpq_class rest = 1;
    for (auto face = pixel.begin(); face != pixel.end();) {
      rest -= face->second;
      face = face->second == 0 ? pixel.erase(face) : std::next(face);
    }
    if (rest != 0)
      pixel[HSR_BACKGROUND] = rest;
  }
  return pixels;
}

/* ---- Scenes ---- */

struct verdicts {
  long answers, refused, wrong_areas, wrong_ids;
};

void check_answer(const char *name, const hsr_world &world,
                  const hsr_view &view, const std::vector<shares> &wanted,
                  const std::vector<uint32_t> &ids, verdicts *v) {
  hsr_answer answer;
  if (!draw_answer(hsr_algorithm_find(name)->plain, &world, &view, &answer,
                   nullptr)) {
    v->refused++;
    hsr_answer_free(&answer);
    return;
  }
  const hsr_polygons &polygons = *hsr_answer_polygons_of(&answer);
  std::vector<uint32_t> got(ids.size());
  hsr_error err;
  if (hsr_polygons_ids(&polygons, &view, got.data(), &err))
    bail("%s", err.text);
  v->answers++;
  v->wrong_areas += areas_of(polygons, world, view) != wanted;
  v->wrong_ids += got != ids;
  hsr_answer_free(&answer);
}

void check_view(hsr_scene *scene, const hsr_camera &camera, verdicts *oracle,
                verdicts *algorithm) {
  hsr_world world;
  hsr_view view;
  hsr_error err;
  if (hsr_world_init(&world, scene, &err) ||
      hsr_view_init(&view, &camera, 6, 5, &err)) { /* not valid */
    hsr_world_free(&world);
    return;
  }
  const std::vector<shares> wanted = shares_of(world, view);
  std::vector<uint32_t> ids(size_t(view.m) * size_t(view.n));
  draw_ids(hsr_algorithm_find("oracle")->plain, &world, &view, ids.data(),
           nullptr);
  check_answer("polygon-oracle", world, view, wanted, ids, oracle);
  check_answer("weiler-atherton", world, view, wanted, ids, algorithm);
  hsr_world_free(&world);
}

void tell(struct tap *tap, const char *what, const char *who,
          const verdicts &v) {
  ok(tap, v.answers > 0 && !v.wrong_areas,
     "%s, %s: areas in %ld answers, %ld refused", what, who, v.answers,
     v.refused);
  ok(tap, !v.wrong_ids, "%s, %s: samples", what, who);
}

void tell_both(struct tap *tap, const char *what, const verdicts &oracle,
               const verdicts &algorithm) {
  tell(tap, what, "polygon-oracle", oracle);
  tell(tap, what, "weiler-atherton", algorithm);
}

hsr_scene *opened(const char *name) {
  hsr_scene *scene;
  scene = must_open(name);
  return scene;
}

void check_lattice(uint64_t *seed, verdicts *oracle, verdicts *algorithm) {
  char name[64];
  std::snprintf(name, sizeof name, "lattice:%d:%d",
                int(draw_integer(seed, 3, 20)),
                int(draw_integer(seed, 1, 1000000000)));
  hsr_scene *scene = opened(name);
  hsr_camera camera = scene->views[draw_integer(seed, 0, scene->n_views - 1)];
  draw_parallel(seed, &camera, 5);
  check_view(scene, camera, oracle, algorithm);
  hsr_scene_delete(scene);
}

} // namespace

int main(int argc, char **argv) {
  const long n = argc > 1 ? std::atol(argv[1]) : 60;
  uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  static const char *const names[] = {"penetration",  "non-planar",
                                      "behind-eye",   "near-plane",
                                      "eye-in-plane", "house@parallel=same"};
  struct tap tap = plan(4 * (6 + 2));
  for (const char *name : names) {
    verdicts oracle = {}, algorithm = {};
    hsr_scene *scene = opened(name);
    for (uint32_t k = 0; k < scene->n_views && k < 3; k++)
      check_view(scene, scene->views[k], &oracle, &algorithm);
    tell_both(&tap, name, oracle, algorithm);
    hsr_scene_delete(scene);
  }
  verdicts oracle = {}, algorithm = {};
  const uint64_t first = seed;
  for (long k = 0; k < n; k++)
    check_lattice(&seed, &oracle, &algorithm);
  tell_both(&tap, "lattices", oracle, algorithm);
  oracle = algorithm = {};
  for (long k = 0; k < n; k++) {
    hsr_camera camera;
    enum hard_scale scale;
    hsr_scene *scene = hard_scene(first + uint64_t(k), &camera, &scale);
    if (scene)
      check_view(scene, camera, &oracle, &algorithm);
    hsr_scene_delete(scene);
  }
  tell_both(&tap, "hard scenes", oracle, algorithm);
  return finish(&tap);
}
