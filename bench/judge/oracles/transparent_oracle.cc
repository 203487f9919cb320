/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The transparent oracle: the faces over each sample, folded, from the
 * definition alone.
 *
 * Source      docs/transparent-picture.md, in whose words this file is written;
 *             bench/judge/surface.h has the faces that cover a sample, and
 *             their order.
 * Method      all faces that cover a sample and are not certainly farther than
 *             the nearest opaque one found so far are kept; the rest is sorted
 *             out exactly. The fold is in 64 bits.
 * Cost        that of the oracle, and a comparison for each pair of faces in
 *             front of the nearest opaque one, or about so. */
#include "bench/judge/surface.h"

#include "common/answers/answer.h"
#include "common/answers/filter.h"
#include "common/answers/kinds/transparent.h"

namespace {

using namespace judge::surface;
using judge::Nearest, judge::Upward;

/* What the definition asks of a face: its id, and of that A and C. */
struct tint {
  bool known;
  uint64_t A, C[3];
};

/* 65535 times the opacity, rounded to the nearest integer, a half upwards. The
 * opacity is a float, so all of this is exact in doubles. */
uint64_t opacity_of(const hsr_world &world, uint32_t id) {
  const hsr_place at = hsr_place_of(&world, id);
  const double o = double(hsr_face_opacity(at.object, at.face));
  return uint64_t(std::floor(65535 * o + 0.5));
}

tint tint_of(const hsr_job &job, uint32_t id) {
  const Nearest to_nearest;
  uint16_t rgb[3];
  hsr_filter_colour(job.world, job.view, id, rgb);
  const uint64_t A = id == HSR_BACKGROUND ? 65535 : opacity_of(*job.world, id);
  return {true, A, {rgb[0], rgb[1], rgb[2]}};
}

/* The tints of faces, by the scene's ids; found once where there is room. */
class palette {
public:
  explicit palette(const hsr_job &asked) : job(asked) {
    background = tint_of(job, HSR_BACKGROUND);
    if (!hsr_is_roster(job.world))
      kept.resize(job.world->n_faces);
  }
  const tint &of(uint32_t id) {
    if (id >= kept.size())
      return last = tint_of(job, id);
    if (!kept[id].known)
      kept[id] = tint_of(job, id);
    return kept[id];
  }
  tint background;

private:
  const hsr_job &job;
  std::vector<tint> kept;
  tint last = {};
};

/* The nearest opaque face O, and the transparent faces that are not certainly
 * farther than it. */
struct faces_met {
  explicit faces_met(palette *tints) : known(tints) {}

  palette *known;
  hit O = {HSR_BACKGROUND, 0};
  std::vector<hit> transparent;
  double farthest = infinity; /* the depth of O is not greater */

  void take(const sample &s, const hit &found) {
    if (known->of(id_of(s, found.face)).A < 65535) {
      transparent.push_back(found);
    } else if (is_nearer(s, found, O)) {
      O = found;
      farthest = farthest_depth(s, found.face);
    }
  }
};

/* B becomes what it is with a face in front of it. */
void fold(const tint &face, enum hsr_mix mix, uint64_t B[3]) {
  const uint64_t *C = face.C, A = face.A;
  const bool brighter = C[0] + C[1] + C[2] > B[0] + B[1] + B[2];
  for (int c = 0; c < 3; c++)
    B[c] = mix == HSR_MIX_NEWELL && brighter
               ? C[c]
               : (A * C[c] + (65535 - A) * B[c] + 32767) / 65535;
}

/* The colour of the sample whose faces these are. */
void fold_all(const sample &s, faces_met *met, enum hsr_mix mix,
              uint16_t out[3]) {
  std::vector<hit> &front = met->transparent;
  if (met->O.face != HSR_BACKGROUND)
    front.erase(
        std::remove_if(front.begin(), front.end(),
                       [&](const hit &f) { return is_nearer(s, met->O, f); }),
        front.end());
  /* The farthest first. Faces differ, so one of two is nearer. */
  std::sort(front.begin(), front.end(), [&](const hit &f, const hit &g) {
    return f.face != g.face && is_nearer(s, g, f);
  });
  const tint &behind = met->O.face == HSR_BACKGROUND
                           ? met->known->background
                           : met->known->of(id_of(s, met->O.face));
  uint64_t B[3] = {behind.C[0], behind.C[1], behind.C[2]};
  for (const hit &f : front)
    fold(met->known->of(id_of(s, f.face)), mix, B);
  for (int c = 0; c < 3; c++)
    out[c] = uint16_t(B[c]);
}

/* The colour of the sample at (sx, sy). Not inlined, so that sx and sy are
 * computed before the rounding mode is changed. */
[[gnu::noinline]] void colour_of(const hsr_job &job, const trees &t,
                                 faces_at_hand *faces, palette *known,
                                 double sx, double sy, uint16_t out[3]) {
  const Upward upward;
  const hsr_scene *instanced =
      hsr_is_roster(job.world) ? job.world->roster.scene : nullptr;
  faces->begin_sample();
  const sample s = make_sample(job, &faces->world, &faces->known, sx, sy);
  faces_met met(known);
  way w(s, t, instanced, faces, &met);
  w.go();
  fold_all(s, &met, hsr_form_mix(&job.answer->form), out);
}

/* ---- The algorithm ---- */

extern "C" {

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return guarded(err, [&] {
    const struct hsr_view *view = job->view;
    const struct hsr_window w = view->window;
    const trees &t = *static_cast<const trees *>(job->prepared);
    uint16_t *colours = hsr_answer_colours_of(job->answer);
    faces_at_hand faces(*job->world, w);
    palette known(*job);
    for (int j = w.y0; j < w.y1; j++) {
      faces.begin_row();
      for (int i = w.x0; i < w.x1; i++) {
        HSR_TOUCH(job->tally, i, j);
        colour_of(*job, t, &faces, &known, hsr_sample_x(view, i),
                  hsr_sample_y(view, j),
                  colours + 3 * (size_t(j) * size_t(view->m) + size_t(i)));
      }
    }
    return HSR_OK;
  });
}

} /* extern "C" */

constexpr struct hsr_counter counters[] = {HSR_ORACLE_COUNTERS, {nullptr}};

constexpr struct hsr_algorithm describe() {
  struct hsr_algorithm a = {};
  a.name = "transparent-oracle";
  a.title = "Transparent oracle: all faces over a sample, folded";
  a.authors = "hsr";
  a.source = "docs/transparent-picture.md";
  a.taxonomy = HSR_YARDSTICK;
  a.subjects = 1 << HSR_FACES;
  a.makes[0].kind = HSR_TRANSPARENT;
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
extern "C" const struct hsr_algorithm HSR_ALGORITHM(transparent_oracle);
constexpr struct hsr_algorithm description = describe();
const struct hsr_algorithm HSR_ALGORITHM(transparent_oracle) = description;
