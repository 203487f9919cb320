/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The oracle of area pictures: the tightest interval of two doubles that holds
 * the value of each pixel and channel.
 *
 * Source      docs/area-picture.md, docs/correct-picture.md.
 * Input       of the world and the view what bench/judge/oracles/oracle.cc takes, and
 *             each face's colour. It shares no code with whom it judges.
 * Method      bench/judge/areas: the picture plane is cut into cells of one
 *             visible face, whose corners are rational, and the filter's pieces
 *             are integrated over them.
 * Ties        equal planes: the lowest face id. On lines they do not matter.
 * Departures  none: there is no paper.
 * Cost        what lies within one face costs next to nothing. A pixel with
 *             edges takes some milliseconds at most, and more where hundreds of
 *             faces meet.
 *
 * Compile with -frounding-math; or, slower, but regardless of rounding modes
 * (valgrind ignores them), with -DCGAL_ALWAYS_ROUND_TO_NEAREST. */
#include "algorithms/algorithm.h"
#include "bench/judge/areas/areas.h"
#include "bench/judge/areas/shapes.h"
#include "common/answers/kinds/area.h"

#include <cstring>
#include <exception>
#include <mutex>
#include <new>

namespace {

enum { AREA_PIXEL };

/* What is kept between the windows of a view. */
struct kept {
  std::mutex guard;
  hsr_view view;
  std::shared_ptr<const std::vector<areas::box>> boxes; /* of `view`, or none */
};

bool is_same_camera(const hsr_view &a, const hsr_view &b) {
  return a.m == b.m && a.n == b.n && a.parallel == b.parallel &&
         !std::memcmp(a.E, b.E, sizeof a.E) &&
         !std::memcmp(a.F, b.F, sizeof a.F) &&
         !std::memcmp(a.R, b.R, sizeof a.R) &&
         !std::memcmp(a.U, b.U, sizeof a.U);
}

std::shared_ptr<const std::vector<areas::box>>
boxes_of(kept *k, const hsr_world &world, const hsr_view &view) {
  const std::lock_guard<std::mutex> lock(k->guard);
  if (!k->boxes || !is_same_camera(k->view, view)) {
    k->boxes = areas::find_boxes(world, view);
    k->view = view;
  }
  return k->boxes;
}

/* Does the work; nothing is thrown out of here. */
template <class Work>
enum hsr_status guarded(struct hsr_error *err, Work work) noexcept {
  try {
    return work();
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (const std::exception &e) {
    return hsr_fail(err, HSR_E_INTERNAL, "area-oracle: %s", e.what());
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "area-oracle: an unknown exception");
  }
}

extern "C" {

static enum hsr_status prepare(const struct hsr_world *, const long *,
                               void **prepared, struct hsr_error *err) {
  return guarded(err, [&] {
    if (!judge::is_rounding_honoured())
      return hsr_fail(err, HSR_E_INTERNAL,
                      "area-oracle: directed rounding has no effect here");
    *prepared = new kept;
    return HSR_OK;
  });
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return guarded(err, [&] {
    const struct hsr_window w = job->view->window;
    const auto boxes =
        boxes_of(static_cast<kept *>(job->prepared), *job->world, *job->view);
    areas::find_bounds(*job->world, *job->view,
                       hsr_form_area(&job->answer->form), *boxes,
                       hsr_answer_areas_of(job->answer));
    for (int j = w.y0; j < w.y1; j++)
      for (int i = w.x0; i < w.x1; i++)
        HSR_STEP(job->tally, AREA_PIXEL, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE,
                 0);
    return HSR_OK;
  });
}

static void release(void *prepared) {
  delete static_cast<kept *>(prepared);
}

} /* extern "C" */

constexpr struct hsr_counter counters[] = {
    {"pixels", "pixels whose values were found", HSR_ACCEPT}, {nullptr}};

constexpr struct hsr_algorithm describe() {
  struct hsr_algorithm a = {};
  a.name = "area-oracle";
  a.title = "Area oracle: exact integrals from the definition";
  a.authors = "hsr";
  a.source = "docs/area-picture.md";
  a.taxonomy = HSR_YARDSTICK;
  a.subjects = 1 << HSR_FACES;
  a.makes[0].kind = HSR_AREAS;
  a.flags = HSR_JUDGE;
  a.counters = counters;
  a.prepare = prepare;
  a.render = render;
  a.release = release;
  return a;
}

} /* namespace */

/* Constant-initialised. Declared first: a const is otherwise private to its
 * file in C++. */
extern "C" const struct hsr_algorithm HSR_ALGORITHM(area_oracle);
constexpr struct hsr_algorithm description = describe();
const struct hsr_algorithm HSR_ALGORITHM(area_oracle) = description;
