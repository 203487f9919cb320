/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The oracle: the visible face of each sample, from the definition alone.
 *
 * Source      docs/correct-picture.md; bench/judge/surface.h has the faces that
 *             cover a sample, and their order, and the rest of what is to be
 *             said here. */
#include "bench/judge/surface.h"

namespace {

using namespace judge::surface;
using judge::Upward;

/* The nearest of the faces met. */
struct nearest_face {
  hit nearest = {HSR_BACKGROUND, 0};
  double farthest = infinity; /* the depth of `nearest` is not greater */

  void take(const sample &s, const hit &found) {
    if (!is_nearer(s, found, nearest))
      return;
    nearest = found;
    farthest = farthest_depth(s, found.face);
  }
};

/* The visible face of the sample at (sx, sy), or HSR_BACKGROUND. Not inlined,
 * so that sx and sy are computed before the rounding mode is changed. */
[[gnu::noinline]] uint32_t visible_face(const hsr_job &job, const trees &t,
                                        faces_at_hand *faces, double sx,
                                        double sy) {
  const Upward upward;
  const bool instanced = hsr_is_roster(job.world);
  faces->begin_sample();
  const sample s = make_sample(job, &faces->world, &faces->known, sx, sy);
  nearest_face seen;
  way w(s, t, instanced ? job.world->roster.scene : nullptr, faces, &seen);
  w.go();
  const uint32_t f = seen.nearest.face;
  return instanced && f != HSR_BACKGROUND ? id_of(s, f) : f;
}

/* ---- The algorithm ---- */

extern "C" {

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return guarded(err, [&] {
    const struct hsr_view *view = job->view;
    const struct hsr_window w = view->window;
    const trees &t = *static_cast<const trees *>(job->prepared);
    faces_at_hand faces(*job->world, w);
    for (int j = w.y0; j < w.y1; j++) {
      faces.begin_row();
      for (int i = w.x0; i < w.x1; i++) {
        HSR_TOUCH(job->tally, i, j);
        job->answer->ids[size_t(j) * size_t(job->answer->m) + size_t(i)] =
            visible_face(*job, t, &faces, hsr_sample_x(view, i),
                         hsr_sample_y(view, j));
      }
    }
    return HSR_OK;
  });
}

} /* extern "C" */

constexpr struct hsr_counter counters[] = {HSR_ORACLE_COUNTERS, {nullptr}};

constexpr struct hsr_algorithm describe() {
  struct hsr_algorithm a = {};
  a.name = "oracle";
  a.title = "Oracle: exact ray casting from the definition";
  a.authors = "hsr";
  a.source = "docs/correct-picture.md";
  a.taxonomy = HSR_YARDSTICK;
  a.subjects = 1 << HSR_FACES;
  a.makes[0].kind = HSR_IDS;
  a.flags = HSR_JUDGE | HSR_INSTANCED;
  a.counters = counters;
  a.prepare = prepare;
  a.render = render;
  a.release = release;
  return a;
}

} /* namespace */

/* Constant-initialised. Declared first: a const is otherwise private to its
 * file in C++. */
extern "C" const struct hsr_algorithm HSR_ALGORITHM(oracle);
constexpr struct hsr_algorithm description = describe();
const struct hsr_algorithm HSR_ALGORITHM(oracle) = description;
