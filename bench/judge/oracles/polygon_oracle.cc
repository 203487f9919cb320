/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The oracle of visible polygons: the picture cut into cells of one visible face
 * each, whose sides are on named lines.
 *
 * Source      docs/visible-polygons.md, docs/correct-picture.md.
 * Input       of the world and the view what bench/judge/oracles/oracle.cc takes. It
 *             shares no code with whom it judges, but the names of lines.
 * Method      bench/judge/areas/cells.h, on the whole picture. Each cell is a
 *             region: a convex cycle. Cells of one face touch, so an answer has
 *             more regions than it needs; but sides between two of them cancel,
 *             and the definition compares what is left.
 * Ties        equal planes: the lowest face id.
 * Departures  none: there is no paper.
 * Cost        every cut that is made passes on the list of faces. So it is for
 *             some hundreds of faces. */
#include "algorithms/algorithm.h"
#include "bench/judge/areas/cells.h"
#include "bench/judge/areas/numbers.h"
#include "common/answers/kinds/polygons.h"

#include <exception>
#include <new>

namespace {

enum { POLYGON_CELL };

struct no_memory {
  enum hsr_status status;
};

void check(enum hsr_status status) {
  if (status)
    throw no_memory{status};
}

/* The name of a cell's side. */
hsr_line_name name_of(const areas::line &line) {
  static constexpr enum hsr_border border[4] = {HSR_TOP, HSR_RIGHT, HSR_BOTTOM,
                                                HSR_LEFT};
  const uint32_t f = line.f ? line.f->id : 0, g = line.g ? line.g->id : 0;
  switch (line.of) {
  case areas::EDGE_LINE:
    return {HSR_LINE_EDGE, f, uint32_t(line.k)};
  case areas::ROW_LINE:
    return {HSR_LINE_ROW, f, uint32_t(line.k)};
  case areas::HORIZON_LINE:
    return {HSR_LINE_HORIZON, f, 0};
  case areas::NEAR_LINE:
    return {HSR_LINE_NEAR, f, 0};
  case areas::MEETING_LINE:
    return {HSR_LINE_MEETING, std::min(f, g), std::max(f, g)};
  default: /* nothing is cut by columns */
    return {HSR_LINE_BORDER, uint32_t(border[line.k]), 0};
  }
}

double rounded(const mpz_class &num, const mpz_class &den) {
  double low;
  areas::down_to_double(num, den, &low);
  return low;
}

/* Appends each cell of a face to the answer. */
struct writer : areas::sink {
  hsr_polygons &to;
  const hsr_job &job;

  writer(hsr_polygons &polygons, const hsr_job &asked)
      : to(polygons), job(asked) {}
  void take(const areas::cell &part, const areas::shape *seen) override {
    HSR_STEP(job.tally, POLYGON_CELL, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
    if (!seen)
      return;
    const uint32_t f = seen->id;
    check(hsr_polygons_add_region(&to, job.world->id ? job.world->id[f] : f));
    check(hsr_polygons_add_cycle(&to));
    for (size_t i = 0; i < part.corner.size(); i++) {
      areas::point &p = *part.corner[i];
      p.make_exact();
      const hsr_polygon_side side = {name_of(*part.side[i]),
                                     {rounded(p.X, p.W), rounded(p.Y, p.W)}};
      check(hsr_polygons_add_side(&to, &side));
    }
  }
};

/* Not inlined, so that all of it is done in one rounding mode. */
[[gnu::noinline]] void draw(const hsr_job &job) {
  const areas::Upward upward;
  const hsr_world &world = *job.world;
  const areas::stage on(world, *job.view);
  std::vector<std::unique_ptr<areas::shape>> shapes;
  std::vector<areas::shape *> all;
  for (uint32_t f = 0; f < world.n_faces; f++)
    if (auto made = areas::make_shape(on, f)) {
      all.push_back(made.get());
      shapes.push_back(std::move(made));
    }
  hsr_polygons &to = *hsr_answer_polygons_of(job.answer);
  to.world = &world;
  writer writes(to, job);
  areas::cut({0, 0, 2 * job.view->m, 2 * job.view->n}, all, writes);
  hsr_polygons_sort(&to);
}

/* Nothing is thrown out of here. */
extern "C" {
static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  try {
    if (!judge::is_rounding_honoured())
      return hsr_fail(err, HSR_E_INTERNAL,
                      "polygon-oracle: directed rounding has no effect here");
    draw(*job);
    return HSR_OK;
  } catch (const no_memory &) {
    return hsr_fail_nomem(err);
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (const std::exception &e) {
    return hsr_fail(err, HSR_E_INTERNAL, "polygon-oracle: %s", e.what());
  }
}
} /* extern "C" */

constexpr struct hsr_counter counters[] = {
    {"cells", "cells that the picture was cut into", HSR_ACCEPT}, {nullptr}};

constexpr struct hsr_algorithm describe() {
  struct hsr_algorithm a = {};
  a.name = "polygon-oracle";
  a.title = "Polygon oracle: exact cells from the definition";
  a.authors = "hsr";
  a.source = "docs/visible-polygons.md";
  a.taxonomy = HSR_YARDSTICK;
  a.subjects = 1 << HSR_FACES;
  a.makes[0].kind = HSR_POLYGONS;
  a.flags = HSR_JUDGE;
  a.counters = counters;
  a.render = render;
  return a;
}

} /* namespace */

/* Constant-initialised. Declared first: a const is otherwise private to its
 * file in C++. */
extern "C" const struct hsr_algorithm HSR_ALGORITHM(polygon_oracle);
constexpr struct hsr_algorithm description = describe();
const struct hsr_algorithm HSR_ALGORITHM(polygon_oracle) = description;
