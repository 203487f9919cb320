/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/light/shadow.h"
#include "common/answers/kinds/shadowed.h"

enum hsr_status hsr_shadow_begin(struct hsr_shadow *shadow,
                                 const struct hsr_job *job,
                                 const struct hsr_screen *screen) {
  const struct hsr_window *w = &job->view->window;
  uint32_t n_faces = job->world->n_faces;
  *shadow =
      (struct hsr_shadow){.lit = hsr_answer_lit_of(job->answer),
                          .job = job,
                          .blocker = HSR_NEW(job->scratch, uint32_t, n_faces)};
  if (!shadow->blocker ||
      hsr_lighting_init(&shadow->lighting, screen, job->scratch, job->tally))
    return HSR_E_NOMEM;
  for (uint32_t f = 0; f < n_faces; f++)
    if (hsr_may_block(&shadow->lighting, f))
      shadow->blocker[shadow->n_blockers++] = f;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      shadow->lit[(size_t)j * (size_t)job->answer->m + (size_t)i] = false;
  return HSR_OK;
}

bool hsr_shadow_faces(struct hsr_shadow *shadow, uint32_t f,
                      struct hsr_window window) {
  struct hsr_tally *tally = shadow->job->tally;
  bool faces = hsr_faces_light(&shadow->lighting, f, tally);
  (void)window; /* for the trace */
  HSR_STEP(tally, HSR_LIGHT_FACINGS, HSR_FACE(f), HSR_THE_WINDOW, window,
           faces);
  return faces;
}

static void count_test(struct hsr_shadow *shadow,
                       const struct hsr_lit_point *point, int i, int j,
                       uint32_t face, bool blocks) {
  struct hsr_tally *tally = shadow->job->tally;
  (void)point, (void)i, (void)j, (void)face, (void)blocks; /* for the trace */
  HSR_TOUCH(tally, i, j);
  HSR_STEP(tally, HSR_SHADOW_TESTS, HSR_FACE(face), HSR_FACE(point->face),
           HSR_AT(i, j), blocks);
}

uint32_t hsr_shadow_test(struct hsr_shadow *shadow,
                         const struct hsr_lit_point *point, int i, int j,
                         const uint32_t *face, uint32_t n) {
  for (uint32_t k = 0; k < n; k++) {
    bool blocks =
        hsr_blocks(&shadow->lighting, point, face[k], shadow->job->tally);
    count_test(shadow, point, i, j, face[k], blocks);
    if (blocks)
      return k;
  }
  return n;
}

bool hsr_shadow_blocked(struct hsr_shadow *shadow,
                        const struct hsr_light_balls *balls,
                        const struct hsr_lit_point *point, int i, int j) {
  enum { AT_ONCE = 256 };
  uint8_t beside[AT_ONCE];
  for (uint32_t k = 0, n; k < shadow->n_blockers; k += n) {
    n = shadow->n_blockers - k < AT_ONCE ? shadow->n_blockers - k : AT_ONCE;
    hsr_light_balls_beside(balls, point, k, n, beside);
    for (uint32_t l = 0; l < n; l++) {
      const uint32_t *face = &shadow->blocker[k + l];
      if (beside[l])
        count_test(shadow, point, i, j, *face, false);
      else if (!hsr_shadow_test(shadow, point, i, j, face, 1))
        return true;
    }
  }
  return false;
}

void hsr_shadow_lit(struct hsr_shadow *shadow, uint32_t f, int x0, int x1,
                    int j) {
  const struct hsr_job *job = shadow->job;
  const bool lit = true;
  (void)f, (void)lit; /* for the trace */
  HSR_ACCEPTED(job->tally, HSR_LIT, HSR_FACE(f), HSR_THE_WINDOW,
               HSR_ON(x0, x1, j), &lit);
  for (int i = x0; i < x1; i++)
    shadow->lit[(size_t)j * (size_t)job->answer->m + (size_t)i] = true;
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"light facings", "visible faces tested for being turned to the light",
     HSR_COMPARE, HSR_OF_FACE, HSR_OF_WINDOW, "turned away|turned to it"},
    {"shadow tests",
     "faces tested for blocking the light from what is seen of a face",
     HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "does not block|blocks"},
    {"lit", "stretches of samples shown lit", HSR_ACCEPT, HSR_OF_FACE,
     HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line facing_lines[] = {
    {"with shadows: is the face turned to the light?",
     HSR_RAISES(HSR_LIGHT_FACINGS)},
    {NULL}};

static const struct hsr_line lines[] = {
    {"does another face block the light from the sample?",
     HSR_RAISES(HSR_SHADOW_TESTS)},
    {"if none does, show the sample lit", HSR_RAISES(HSR_LIT)},
    {NULL}};

const struct hsr_part hsr_shadow_part = {
    HSR_PART_SHADOW, counters, NULL, NULL, {facing_lines, lines}};
