/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Brute force without memory: at every raster element, search all faces.
 *
 * Source      Sutherland, Sproull and Schumacker 1974, appendix B, "Brute-Force
 *             Image-Space": the cost of finding the visible face at each
 *             element by examining every face. In form it is the ray casting of
 *             A. Appel, "Some techniques for shading machine renderings of
 *             solids", AFIPS SJCC 1968.
 * Notation    raster element -> sample (i, j); minimax box -> screen.bounds
 * Invariant   nearest is the visible one of the faces seen so far
 * Ties        by hsr_nearer: the picture's order
 * Shadows     Appel's own: from what is seen at an element, a ray to the light;
 *             every face is tested for blocking it, until one does
 * Departures  the culls that the paper calls universally applicable come first;
 *             the minimax test precedes the surround test
 * Cost        100 n m F_r predicted: the minimax tests are n m F_r */
#include "algorithms/engines/light/shadow.h"
#include "common/answers/kinds/shadowed.h"

enum { MINIMAX, SURROUND, DEPTH, SHOWN };

static uint32_t visible_face(const struct hsr_screen *screen, int i, int j,
                             struct hsr_tally *tally) {
  uint32_t nearest = HSR_BACKGROUND;
  for (uint32_t r = 0; r < screen->n_relevant; r++) {
    uint32_t f = screen->relevant[r];
    const struct hsr_bounds *box = &screen->bounds[f];
    bool inside = i >= box->x0 && i < box->x1 && j >= box->y0 && j < box->y1;
    HSR_STEP(tally, MINIMAX, HSR_FACE(f), HSR_THE_WINDOW, HSR_AT(i, j), inside);
    if (!inside)
      continue;
    HSR_TOUCH(tally, i, j);
    bool surrounds = hsr_covers(screen, f, i, j, tally);
    HSR_STEP(tally, SURROUND, HSR_FACE(f), HSR_THE_WINDOW, HSR_AT(i, j),
             surrounds);
    if (!surrounds)
      continue;
    if (nearest != HSR_BACKGROUND) {
      bool nearer = hsr_nearer(screen, f, nearest, i, j, tally);
      HSR_STEP(tally, DEPTH, HSR_FACE(f), HSR_FACE(nearest), HSR_AT(i, j),
               nearer);
      if (!nearer)
        continue;
    }
    nearest = f;
  }
  if (nearest != HSR_BACKGROUND)
    HSR_STEP(tally, SHOWN, HSR_FACE(nearest), HSR_THE_WINDOW, HSR_AT(i, j), 0);
  return nearest;
}

/* Shows the sample lit, if f faces the light and no face blocks it. */
static void cast_shadow_ray(struct hsr_shadow *shadow,
                            const struct hsr_light_balls *balls, uint32_t f,
                            int i, int j) {
  struct hsr_lit_point point;
  if (!hsr_shadow_faces(shadow, f, HSR_AT(i, j)))
    return;
  hsr_lit_point_find(&shadow->lighting, f, i, j, &point);
  if (!hsr_shadow_blocked(shadow, balls, &point, i, j))
    hsr_shadow_lit(shadow, f, i, i + 1, j);
}

static double expense(const struct hsr_world *world,
                      const struct hsr_view *view) {
  return (double)view->m * view->n * world->n_faces;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_screen screen;
  if (hsr_screen_make(&screen, job->world, job->view, job->scratch, job->tally))
    return hsr_fail_nomem(err);
  struct hsr_shadow shadow;
  struct hsr_light_balls balls;
  if (hsr_answer_lit_of(job->answer) &&
      (hsr_shadow_begin(&shadow, job, &screen) ||
       hsr_light_balls_make(&balls, job->world, shadow.blocker,
                            shadow.n_blockers, job->scratch)))
    return hsr_fail_nomem(err);
  const struct hsr_window *w = &job->view->window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      uint32_t f = visible_face(&screen, i, j, job->tally);
      hsr_job_row(job, j)[i] = f;
      if (hsr_answer_lit_of(job->answer) && f != HSR_BACKGROUND)
        cast_shadow_ray(&shadow, &balls, f, i, j);
    }
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_shadow_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [MINIMAX] = {"minimax tests", "faces whose box was compared with a sample",
                 HSR_COMPARE, HSR_OF_FACE, HSR_OF_WINDOW, "outside|inside",
                 .outcome_keys = "boxes|boxes"},
    [SURROUND] = {"surround tests", "faces tested for surrounding a sample",
                  HSR_SAMPLE, HSR_OF_FACE, HSR_OF_WINDOW,
                  "does not surround|surrounds"},
    [DEPTH] = {"depth tests", "depths compared", HSR_COMPARE, HSR_OF_FACE,
               HSR_OF_FACE, "farther|nearer"},
    [SHOWN] = {"samples shown", "samples at which a face is visible",
               HSR_ACCEPT, HSR_OF_FACE, HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line outline[] = {
    {"for each raster element"},
    {"  for each relevant face"},
    {"    minimax test: is the element inside the face's box?",
     HSR_RAISES(MINIMAX)},
    {"    does the face surround the element?", HSR_RAISES(SURROUND)},
    {"    is it nearer than the nearest face so far?", HSR_RAISES(DEPTH)},
    {"  show the nearest face", HSR_RAISES(SHOWN)},
    {"  ", .part = &hsr_shadow_part, .group = HSR_SHADOW_FACING_LINES},
    {"    ", .part = &hsr_shadow_part, .group = HSR_SHADOW_LINES},
    {NULL}};

static double predict_search(const struct hsr_table1 *t) {
  return 100 * t->n * t->m * t->F_r;
}

static const struct hsr_step steps[] = {{"search of all faces",
                                         SURROUND,
                                         HSR_KIND_FACE_ELEMENT,
                                         "100 n m F_r",
                                         predict_search,
                                         {{MINIMAX, HSR_KIND_BOX}}},
                                        {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(raycast) = {
    .name = "raycast",
    .title = "Brute force without memory",
    .authors = "A. Appel; Sutherland, Sproull and Schumacker",
    .year = 1968,
    .source = "Appel, AFIPS SJCC 1968; Sutherland et al., Computing Surveys "
              "6(1), 1974, appendix B",
    .taxonomy = HSR_BRUTE_FORCE,
    .sort_order = "(XY)Z",
    .coherence = NULL,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}, {HSR_SHADOWED}},
    .parts = uses,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .expense = expense,
    .render = render};
