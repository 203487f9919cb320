/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples, where not all are asked for, are drawn by the selection sampling
 * technique of Knuth, The Art of Computer Programming, volume 2, 3.4.2,
 * algorithm S. */
#include "bench/judge/wanted.h"
#include "bench/modules/modules.h"
#include "bench/judge/judge.h"
#include "bench/judge/judge_filtered.h"
#include "bench/run/crew.h"
#include "common/answers/kinds/filtered.h"

#include <stdlib.h>

/* --- The oracle ----------------------------------------------------------- */

/* Who finds the right answer of a kind that is folded. The judge draws pictures
 * with the oracle and folds them by code of its own. It judges the places k for
 * which wanted[k] is set, or all of them if `wanted` is NULL. */
struct folded {
  const struct hsr_answer_type *type;
  enum hsr_status (*judge)(const struct hsr_setup *oracle,
                           const struct hsr_view *view, const bool *wanted,
                           struct hsr_answer *answer, struct hsr_error *err);
};
static const struct folded folded[] = {
#define HSR_JUDGED(type, judge) {&hsr_answer_##type, judge},
#include "bench/judge/folded.def"
#undef HSR_JUDGED
    {NULL, NULL}};

static const struct folded *folded_of(const struct hsr_answer_type *type) {
  const struct folded *f = folded;
  while (f->type && f->type != type)
    f++;
  return f->type ? f : NULL;
}

const struct hsr_algorithm *oracle_of(const struct hsr_answer_type *kind) {
  if (kind->fold && folded_of(kind))
    kind = kind->fold->of;
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain; a++)
    if (hsr_own_kind(a->plain) == kind && a->plain->flags & HSR_JUDGE)
      return a->plain;
  return NULL;
}

uint32_t most_to_judge(const struct hsr_listed *listed,
                       const struct hsr_choice *choice) {
  const struct hsr_algorithm *oracle = oracle_of(choice->form.type);
  uint32_t own = hsr_most_laid_out(listed->plain, choice);
  uint32_t its = oracle ? hsr_most_laid_out(oracle, NULL) : 0;
  return own > its ? own : its;
}

/* --- Which places --------------------------------------------------------- */

/* A place of a kind that is folded counts as the samples that it is made of. */
long samples_to_compare(const struct hsr_world *world,
                        const struct hsr_form *form, long wanted) {
  if (wanted)
    return wanted;
  if (!hsr_is_roster(world) || world->n_faces <= HSR_MOST_LAID_OUT)
    return 0;
  int side = HSR_SUB * hsr_filter_cells(hsr_form_filtering(form).filter);
  return form->type->fold ? SAMPLES_OF_MANY_FACES / (side * side)
                          : SAMPLES_OF_MANY_FACES;
}

enum hsr_status choose_places(int number, int m, int n, size_t wanted,
                              uint32_t **place, size_t *n_places) {
  size_t all = (size_t)m * (size_t)n;
  *place = NULL;
  *n_places = all;
  if (!wanted || wanted >= all)
    return HSR_OK;
  *place = malloc(wanted * sizeof **place);
  if (!*place)
    return HSR_E_NOMEM;
  unsigned short random[3] = {(unsigned short)(number + 1), (unsigned short)m,
                              (unsigned short)n};
  *n_places = 0;
  for (size_t s = 0; *n_places < wanted; s++)
    if (erand48(random) * (double)(all - s) < (double)(wanted - *n_places))
      (*place)[(*n_places)++] = (uint32_t)s;
  return HSR_OK;
}

/* The same ones for all algorithms: chosen by the view's number and size. */
static enum hsr_status choose_samples(const struct group *g, int k,
                                      struct wanted *wanted,
                                      struct hsr_error *err) {
  const struct hsr_view *view = &g->view[k];
  size_t n = g->form.type->by_places ? (size_t)g->samples : 0;
  return choose_places(g->number[k], view->m, view->n, n, &wanted->sample,
                       &wanted->n)
             ? hsr_fail_nomem(err)
             : HSR_OK;
}

/* --- What is there -------------------------------------------------------- */

/* One sample at a time, each a window of its own. */
static enum hsr_status ask_samples(const struct hsr_setup *oracle,
                                   const struct hsr_view *all,
                                   struct wanted *wanted,
                                   struct hsr_tally *tally,
                                   struct hsr_error *err) {
  struct crew *crew = crew_new(1);
  enum hsr_status status = crew ? HSR_OK : hsr_fail_nomem(err);
  struct hsr_view view = *all;
  for (size_t k = 0; k < wanted->n && !status; k++) {
    int i = (int)(wanted->sample[k] % (uint32_t)all->m);
    int j = (int)(wanted->sample[k] / (uint32_t)all->m);
    view.window = (struct hsr_window){i, j, i + 1, j + 1};
    status = crew_render(crew, oracle, &view, &wanted->answer, tally, err);
  }
  crew_free(crew);
  return status;
}

static enum hsr_status ask_all(const struct hsr_setup *oracle,
                               const struct hsr_view *view,
                               const struct crew_watch *watch,
                               struct wanted *wanted, struct hsr_tally *tally,
                               struct hsr_error *err) {
  struct crew *crew = crew_new(1);
  if (!crew)
    return hsr_fail_nomem(err);
  if (watch)
    crew_watch(crew, watch);
  enum hsr_status status =
      crew_render(crew, oracle, view, &wanted->answer, tally, err);
  crew_free(crew);
  return status;
}

enum hsr_status clean_answer(struct hsr_answer *answer,
                             const struct hsr_setup *setup,
                             const struct hsr_view *view,
                             struct hsr_error *err) {
  enum hsr_status status = answer_init(answer, setup, view, err);
  if (!status && answer->form.type->unset)
    answer->form.type->unset(answer);
  return status;
}

/* The places of a kind that is folded, by its judge. */
static enum hsr_status ask_folded(const struct group *g,
                                  const struct hsr_setup *oracle,
                                  const struct hsr_view *view,
                                  struct wanted *wanted,
                                  struct hsr_error *err) {
  size_t n = (size_t)view->m * (size_t)view->n;
  bool *chosen = wanted->sample ? calloc(n, sizeof *chosen) : NULL;
  enum hsr_status status =
      hsr_answer_make(&wanted->answer, &g->form, view, false, err);
  if (!status && wanted->sample && !chosen)
    status = hsr_fail_nomem(err);
  for (size_t k = 0; k < wanted->n && chosen; k++)
    chosen[wanted->sample[k]] = true;
  if (!status)
    status = folded_of(g->form.type)
                 ->judge(oracle, view, chosen, &wanted->answer, err);
  free(chosen);
  return status;
}

static enum hsr_status ask_view(const struct group *g,
                                const struct hsr_setup *oracle, int k,
                                struct wanted *wanted, struct hsr_error *err) {
  struct hsr_tally tally = {.out_of_memory = false};
  const struct hsr_view *view = &g->view[k];
  enum hsr_status status = choose_samples(g, k, wanted, err);
  if (!status && g->form.type->fold)
    return ask_folded(g, oracle, view, wanted, err);
  if (!status)
    status = clean_answer(&wanted->answer, oracle, view, err);
  if (status)
    return status;
  return wanted->sample ? ask_samples(oracle, view, wanted, &tally, err)
                        : ask_all(oracle, view, g->watch, wanted, &tally, err);
}

/* Each frame of a walk by an oracle of its own. */
static enum hsr_status ask_walk(const struct group *g,
                                const struct hsr_algorithm *oracle,
                                const struct hsr_choice *choice,
                                struct wanted *wanted, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < g->n_views && !status; k++) {
    struct hsr_world *world = &wanted[k].world;
    struct hsr_setup setup = {.algorithm = NULL};
    status = hsr_setup_world(world, oracle, choice, g->walk->frame[k], err);
    if (!status)
      status = hsr_setup_init(&setup, oracle, choice, world, err);
    if (!status)
      status = ask_view(g, &setup, k, &wanted[k], err);
    if (setup.algorithm)
      hsr_setup_free(&setup);
  }
  return status;
}

enum hsr_status ask_oracle(const struct group *g,
                           const struct hsr_algorithm *oracle,
                           struct wanted *wanted, struct hsr_error *err) {
  struct hsr_setup setup;
  struct hsr_choice choice = hsr_choice_standard(oracle);
  if (!g->form.type->fold)
    choice.form = g->form;
  if (g->walk)
    return ask_walk(g, oracle, &choice, wanted, err);
  enum hsr_status status =
      hsr_setup_init(&setup, oracle, &choice, g->world, err);
  for (int k = 0; k < g->n_views && !status; k++)
    status = ask_view(g, &setup, k, &wanted[k], err);
  hsr_setup_free(&setup);
  return status;
}

void free_wanted(const struct group *g, struct wanted *wanted) {
  for (int k = 0; wanted && k < g->n_views; k++) {
    hsr_answer_free(&wanted[k].answer);
    hsr_world_free(&wanted[k].world);
    free(wanted[k].sample);
  }
  free(wanted);
}
