/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/light/glass.h"
#include "common/answers/kinds/transparent.h"

#include <string.h>

enum hsr_status hsr_glass_begin(struct hsr_glass *glass,
                                const struct hsr_job *job) {
  const struct hsr_world *world = job->world;
  const struct hsr_window *w = &job->view->window;
  *glass = (struct hsr_glass){
      .job = job,
      .colours = hsr_answer_colours_of(job->answer),
      .mix = hsr_form_mix(&job->answer->form),
      .background = hsr_tint_of(world, job->view, HSR_BACKGROUND),
      .tint = HSR_NEW(job->scratch, struct hsr_tint, world->n_faces),
      .known = HSR_NEW_ZEROED(job->scratch, bool, world->n_faces)};
  if (!glass->tint || !glass->known)
    return HSR_E_NOMEM;
  for (int j = w->y0; j < w->y1; j++)
    hsr_glass_show(glass, glass->background.rgb, w->x0, w->x1, j);
  return HSR_OK;
}

const struct hsr_tint *hsr_glass_tint(struct hsr_glass *glass, uint32_t f) {
  const struct hsr_world *world = glass->job->world;
  if (!glass->known[f]) {
    glass->tint[f] =
        hsr_tint_of(world, glass->job->view, hsr_world_parent(world, f));
    glass->known[f] = true;
  }
  return &glass->tint[f];
}

enum hsr_status hsr_glass_allow_disputes(struct hsr_glass *glass,
                                         const struct hsr_screen *screen) {
  const struct hsr_window *w = &glass->job->view->window;
  size_t samples = (size_t)(w->x1 - w->x0) * (size_t)(w->y1 - w->y0);
  struct hsr_arena *arena = glass->job->scratch;
  glass->screen = screen;
  glass->disputed = HSR_NEW_ZEROED(arena, bool, samples);
  glass->over = HSR_NEW(arena, uint32_t, screen->n_relevant);
  return glass->disputed && glass->over ? HSR_OK : HSR_E_NOMEM;
}

static bool *disputed_at(const struct hsr_glass *glass, int i, int j) {
  const struct hsr_window *w = &glass->job->view->window;
  return glass->disputed + (size_t)(j - w->y0) * (size_t)(w->x1 - w->x0) +
         (i - w->x0);
}

void hsr_glass_dispute(struct hsr_glass *glass, int x0, int x1, int j) {
  for (int i = x0; i < x1; i++)
    *disputed_at(glass, i, j) = true;
  glass->any_disputed |= x0 < x1;
}

static bool is_nearer(const struct hsr_glass *glass, uint32_t f, uint32_t g,
                      int i, int j, int compare) {
  struct hsr_tally *tally = glass->job->tally;
  bool nearer = hsr_nearer(glass->screen, f, g, i, j, tally);
  HSR_STEP(tally, compare, HSR_FACE(f), HSR_FACE(g), HSR_AT(i, j), nearer);
  return nearer;
}

/* Sorts the faces that cover the sample, the farthest first; returns how many
 * there are. */
static uint32_t sort_faces(struct hsr_glass *glass, int i, int j, int compare) {
  const struct hsr_screen *screen = glass->screen;
  uint32_t n_over = 0;
  for (uint32_t k = 0; k < screen->n_relevant; k++) {
    uint32_t f = screen->relevant[k], at = n_over;
    const struct hsr_bounds *b = &screen->bounds[f];
    if (i < b->x0 || i >= b->x1 || j < b->y0 || j >= b->y1 ||
        !hsr_covers(screen, f, i, j, glass->job->tally))
      continue;
    for (; at && is_nearer(glass, glass->over[at - 1], f, i, j, compare); at--)
      glass->over[at] = glass->over[at - 1];
    glass->over[at] = f;
    n_over++;
  }
  return n_over;
}

void hsr_glass_settle(struct hsr_glass *glass, int compare, int accept) {
  const struct hsr_window *w = &glass->job->view->window;
  if (!glass->any_disputed)
    return;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      if (!*disputed_at(glass, i, j))
        continue;
      uint16_t *rgb = hsr_glass_at(glass, i, j);
      uint32_t n_over = sort_faces(glass, i, j, compare);
      hsr_glass_clear(glass, rgb);
      for (uint32_t k = 0; k < n_over; k++)
        hsr_glass_over(glass, glass->over[k], rgb);
      HSR_TOUCH(glass->job->tally, i, j);
      HSR_ACCEPTED(glass->job->tally, accept, HSR_FACE(glass->over[n_over - 1]),
                   HSR_THE_WINDOW, HSR_AT(i, j), rgb);
    }
}
