/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/tiling/sampling.h"

static struct hsr_mask_places places_of(const struct hsr_jitter *jitter) {
  struct hsr_mask_places places;
  for (int bit = 0; bit < 64; bit++) {
    places.x[bit] = bit % 8 + 0.5 + jitter->x[bit];
    places.y[bit] = bit / 8 + 0.5 + jitter->y[bit];
  }
  return places;
}

enum hsr_status HSR_OF_BUILD(hsr_sampling_init)(struct hsr_sampling *s,
                                                int intervals,
                                                struct hsr_error *err) {
  for (int pattern = 0; pattern < HSR_PATTERNS; pattern++) {
    struct hsr_jitter jitter = {{0}, {0}};
    if (pattern < HSR_MOST_PATTERNS)
      hsr_jitter_init(&jitter, pattern);
    s->places[pattern] = places_of(&jitter);
  }
  hsr_kernel_init(&s->cosine, HSR_FILTER_COSINE);
  return hsr_triage_init(&s->tables, intervals, err);
}

void HSR_OF_BUILD(hsr_sampling_free)(struct hsr_sampling *s) {
  hsr_triage_free(&s->tables);
}

struct hsr_view HSR_OF_BUILD(hsr_sampling_view)(const struct hsr_job *job) {
  struct hsr_view view = *job->view;
  if (!job->filtering)
    return view;
  view.m *= HSR_SUB;
  view.n *= HSR_SUB;
  view.window = (struct hsr_window){0, 0, view.m, view.n};
  for (int k = 0; k < 3; k++) {
    view.screen[0][k] *= HSR_SUB;
    view.screen[1][k] *= HSR_SUB;
    view.ray[1][k] /= HSR_SUB;
    view.ray[2][k] /= HSR_SUB;
  }
  return view;
}

int HSR_OF_BUILD(hsr_sampling_first)(const struct hsr_job *job) {
  return job->filtering && job->filtering->patterns ? 0 : HSR_MOST_PATTERNS;
}

/* The samples of a view that is not filtered may be displaced, all alike. */
static struct hsr_mask_places *displaced(const struct hsr_job *job,
                                         const struct hsr_view *view) {
  struct hsr_mask_places *places =
      HSR_NEW(job->scratch, struct hsr_mask_places, 1);
  for (int bit = 0; places && bit < 64; bit++) {
    places->x[bit] = hsr_sample_x(view, bit % 8);
    places->y[bit] = hsr_sample_y(view, bit / 8);
  }
  return places;
}

enum hsr_status HSR_OF_BUILD(hsr_sampling_begin)(
    const struct hsr_sampling *s, const struct hsr_job *job,
    const struct hsr_view *view, uint32_t most, struct hsr_masks *masks,
    struct hsr_mask_work *work, struct hsr_canvas *canvas) {
  const struct hsr_filtering *filtering = job->filtering;
  bool jittered = filtering && filtering->patterns;
  bool moved = !filtering && (view->offset_x != 0 || view->offset_y != 0);
  *masks = (struct hsr_masks){
      .tables = &s->tables,
      .places = moved ? displaced(job, view)
                      : s->places + HSR_OF_BUILD(hsr_sampling_first)(job),
      .filtering = jittered ? filtering : NULL,
      .anywhere = jittered || moved,
      .work = work,
      .touched = job->tally->work,
      .touched_stride = job->tally->work_stride,
      .pixel = filtering ? HSR_SUB : 1};
  HSR_OF_BUILD(hsr_canvas_begin)
  (canvas, job, view->window, &s->cosine);
  if (!masks->places)
    return HSR_E_NOMEM;
  return HSR_OF_BUILD(hsr_masks_init)(masks, &view->window, most, job->scratch);
}
