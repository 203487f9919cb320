/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/shadow.h"

enum hsr_status hsr_shadow_begin(struct hsr_shadow *shadow,
                                 const struct hsr_job *job,
                                 const struct hsr_screen *screen, int first) {
  const struct hsr_window *w = &job->view->window;
  uint32_t n_faces = job->world->n_faces;
  *shadow =
      (struct hsr_shadow){.job = job,
                          .first = first,
                          .blocker = HSR_NEW(job->scratch, uint32_t, n_faces)};
  if (!shadow->blocker ||
      hsr_lighting_init(&shadow->lighting, screen, job->scratch, job->tally))
    return HSR_E_NOMEM;
  for (uint32_t f = 0; f < n_faces; f++)
    if (hsr_may_block(&shadow->lighting, f))
      shadow->blocker[shadow->n_blockers++] = f;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      job->lit[(size_t)j * job->ids_stride + (size_t)i] = false;
  return HSR_OK;
}

bool hsr_shadow_faces(struct hsr_shadow *shadow, uint32_t f,
                      struct hsr_window window) {
  struct hsr_tally *tally = shadow->job->tally;
  bool faces = hsr_faces_light(&shadow->lighting, f, tally);
  (void)window; /* for the trace */
  HSR_STEP(tally, shadow->first + HSR_LIGHT_FACINGS, HSR_FACE(f),
           HSR_THE_WINDOW, window, faces);
  return faces;
}

uint32_t hsr_shadow_test(struct hsr_shadow *shadow,
                         const struct hsr_lit_point *point, int i, int j,
                         const uint32_t *face, uint32_t n) {
  struct hsr_tally *tally = shadow->job->tally;
  (void)i, (void)j; /* for the trace */
  for (uint32_t k = 0; k < n; k++) {
    bool blocks = hsr_blocks(&shadow->lighting, point, face[k], tally);
    HSR_TOUCH(tally, i, j);
    HSR_STEP(tally, shadow->first + HSR_SHADOW_TESTS, HSR_FACE(face[k]),
             HSR_FACE(point->face), HSR_AT(i, j), blocks);
    if (blocks)
      return k;
  }
  return n;
}

void hsr_shadow_lit(struct hsr_shadow *shadow, uint32_t f, int x0, int x1,
                    int j) {
  const struct hsr_job *job = shadow->job;
  const bool lit = true;
  (void)f, (void)lit; /* for the trace */
  HSR_ACCEPTED(job->tally, shadow->first + HSR_LIT, HSR_FACE(f), HSR_THE_WINDOW,
               HSR_ON(x0, x1, j), &lit);
  for (int i = x0; i < x1; i++)
    job->lit[(size_t)j * job->ids_stride + (size_t)i] = true;
}
