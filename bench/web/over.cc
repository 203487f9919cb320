/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The faces that lie over a sample, by the means of the judge: its words for
 * which faces cover a sample and which of two is nearer (bench/judge/surface.h),
 * in exact numbers where intervals leave it open. */
#include "bench/judge/surface.h"
#include "bench/web/over.h"

namespace {

using namespace judge::surface;
using judge::Interval, judge::Upward;

/* All faces that cover the sample. */
struct all_faces {
  std::vector<hit> met;
  double farthest = infinity;

  void take(const sample &, const hit &found) { met.push_back(found); }
};

/* An interval that holds the depth where the ray meets the plane of a face. The
 * ray runs along D times mn. */
Interval depth_of(const sample &s, uint32_t f) {
  const plane<Interval> p = make_plane(s.r, *s.world, f);
  const Interval at = p.s(s.r, s.r.along_D);
  return s.r.parallel ? -at / (s.r.mn * p.c) : s.r.mn * (p.c / at);
}

/* Not inlined, so that sx and sy are computed before the rounding mode is
 * changed. */
[[gnu::noinline]] std::vector<over_face>
faces_over(const hsr_job &job, const trees &t, double sx, double sy) {
  const Upward upward;
  faces_at_hand faces(*job.world, job.view->window);
  faces.begin_row();
  faces.begin_sample();
  const sample s = make_sample(job, &faces.world, &faces.known, sx, sy);
  all_faces all;
  way w(s, t, static_cast<const hsr_scene *>(nullptr), &faces, &all);
  w.go();
  /* Faces differ, so one of two is nearer. */
  std::sort(all.met.begin(), all.met.end(), [&](const hit &f, const hit &g) {
    return f.face != g.face && is_nearer(s, f, g);
  });
  std::vector<over_face> found;
  for (const hit &f : all.met) {
    const Interval depth = depth_of(s, f.face);
    found.push_back({f.face, depth.inf() / 2 + depth.sup() / 2});
  }
  return found;
}

/* The trees of the world that was last asked about. */
const hsr_world *known;
std::unique_ptr<trees> kept;
std::vector<over_face> found;

} // namespace

extern "C" void over_forget() {
  known = nullptr;
  kept.reset();
}

extern "C" enum hsr_status over_find(const struct hsr_world *world,
                                     const struct hsr_view *view, int i, int j,
                                     const struct over_face **faces, size_t *n,
                                     struct hsr_error *err) {
  try {
    if (known != world) {
      over_forget();
      kept = std::make_unique<trees>();
      build_trees(*world, kept.get());
      known = world;
    }
    hsr_view only = *view;
    only.window = {i, j, i + 1, j + 1};
    hsr_tally tally = {};
    hsr_job job = {};
    job.world = world;
    job.view = &only;
    job.tally = &tally;
    found =
        faces_over(job, *kept, hsr_sample_x(view, i), hsr_sample_y(view, j));
    *faces = found.data();
    *n = found.size();
    return HSR_OK;
  } catch (const std::bad_alloc &) {
    over_forget();
    return hsr_fail_nomem(err);
  }
}
