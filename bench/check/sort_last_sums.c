/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr check --sort-last of what is summed: judges the answers that are added up
 * from those of a grid's parts. The oracle gets the whole scene; rank 0 opens it
 * once all parts are drawn. */
#include "bench/modules/variant.h"
#include "bench/check/check.h"
#include "bench/ranks/ranks.h"
#include "bench/ranks/sums.h"
#include "bench/run/crew.h"
#include "bench/terminal/terminal.h"

#include <stdlib.h>
#include <string.h>

enum { BUILDS = 2 }; /* of an algorithm: the timed one, the counting one */

struct summing {
  struct scene_run *run;
  struct hsr_scene_part part;
  struct hsr_scene *scene; /* the part's */
  struct hsr_world world;
  struct hsr_answer *sums; /* a size and view, algorithm and build; a body of
                              NULL: not begun */
  bool *refused;           /* an algorithm */
  char (*why)[sizeof((struct cell *)0)->refusal];
};

bool is_summed(const struct check_options *o, int algorithm) {
  const struct hsr_variant *v = &o->algorithm[algorithm];
  const struct hsr_form *form = &v->choice.form;
  return form->type->summing && form->type->summing->fits(form) &&
         hsr_makes_how(v->listed->plain, v->choice.form.type) & HSR_SUMS;
}

static int n_pictures(const struct summing *s) {
  return s->run->options->n_sizes * s->run->options->n_views;
}

static const struct hsr_form *form_of(const struct summing *s, int algorithm) {
  return &s->run->options->algorithm[algorithm].choice.form;
}

static struct hsr_answer *sums_of(const struct summing *s, int picture,
                                  int algorithm, int build) {
  int n = s->run->options->n_algorithms;
  return &s->sums[(picture * n + algorithm) * BUILDS + build];
}

/* --- Parts ---------------------------------------------------------------- */

static enum hsr_status begin_sums(const struct summing *s, int picture,
                                  int algorithm, int build,
                                  struct hsr_error *err) {
  struct hsr_answer *sums = sums_of(s, picture, algorithm, build);
  const struct hsr_form *form = form_of(s, algorithm);
  if (sums->body)
    return HSR_OK;
  enum hsr_status status =
      hsr_answer_make(sums, form, &s->run->view[picture], false, err);
  return status ? status : form->type->summing->begin(sums, err);
}

/* Adds the part to the sums of all pictures. */
static enum hsr_status draw_build(struct summing *s, int algorithm, int build,
                                  struct hsr_error *err) {
  const struct hsr_variant *v = &s->run->options->algorithm[algorithm];
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_setup setup;
  enum hsr_status status =
      hsr_setup_init(&setup, build ? v->listed->counting : v->listed->plain,
                     &v->choice, &s->world, err);
  for (int k = 0; k < n_pictures(s) && !status; k++) {
    status = begin_sums(s, k, algorithm, build, err);
    if (!status)
      status = render_view(&setup, &s->run->view[k], 1,
                           sums_of(s, k, algorithm, build), &tally, NULL, err);
  }
  hsr_setup_free(&setup);
  return status;
}

/* By both builds; a refusal is noted. */
static enum hsr_status draw_algorithm(struct summing *s, int algorithm,
                                      struct hsr_error *err) {
  const struct hsr_variant *v = &s->run->options->algorithm[algorithm];
  enum hsr_status status =
      hsr_setup_world(&s->world, v->listed->plain, &v->choice, s->scene, err);
  for (int build = 0; build < BUILDS && !status; build++)
    status = draw_build(s, algorithm, build, err);
  hsr_world_free(&s->world);
  if (status != HSR_E_REFUSED)
    return status;
  s->refused[algorithm] = true;
  snprintf(s->why[algorithm], sizeof s->why[algorithm], "refused by %s: %s",
           v->listed->plain->name, err->text);
  return HSR_OK;
}

static enum hsr_status draw_part(struct summing *s, uint32_t number,
                                 struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  struct hsr_import import = o->import;
  s->part.number = number;
  enum hsr_status status =
      hsr_scene_open_part(s->run->name, &import, &s->part, &s->scene, err);
  if (!status && !s->run->view)
    status = init_views(s->run, s->scene, err);
  for (int a = 0; a < o->n_algorithms && !status && s->part.n_faces; a++)
    if (is_summed(o, a) && !s->refused[a])
      status = draw_algorithm(s, a, err);
  hsr_scene_delete(s->scene);
  s->scene = NULL;
  return status;
}

/* A rank takes the part of its own number, and then whichever is left. */
static enum hsr_status draw_parts(struct summing *s, struct hsr_error *err) {
  long ranks = ranks_count(), all = s->part.of;
  enum hsr_status status = HSR_OK;
  struct queue queue;
  queue_open(&queue, all - ranks, true);
  for (long k = ranks_own(); k >= 0 && k < all && !status;) {
    progress_tell(s->run->progress, (size_t)k, (size_t)all, "parts",
                  s->run->name);
    status = draw_part(s, (uint32_t)k, err);
    k = queue_take(&queue);
    k += k < 0 ? 0 : ranks;
  }
  return status;
}

/* --- The verdict ---------------------------------------------------------- */

/* The sums of all ranks become the answer of rank 0. */
static enum hsr_status gather(const struct summing *s, int picture,
                              int algorithm, int build, struct hsr_error *err) {
  const struct hsr_summing *summing = form_of(s, algorithm)->type->summing;
  struct hsr_answer *answer = sums_of(s, picture, algorithm, build);
  struct sums_sent sent;
  uint64_t *sums;
  enum hsr_status status = begin_sums(s, picture, algorithm, build, err);
  if (!status) {
    size_t n = summing->sums(answer, &sums);
    status = sums_gather(sums, n, &sent, err);
  }
  if (!status && !ranks_own())
    summing->finish(answer);
  return status;
}

static void compare(const struct summing *s, int picture, int algorithm,
                    const struct wanted *wanted, struct cell *cell) {
  for (int build = 0; build < BUILDS; build++) {
    struct hsr_comparison comparison = {
        .view = &s->run->view[picture],
        .got = sums_of(s, picture, algorithm, build),
        .wanted = &wanted->answer,
        .place = wanted->sample,
        .n = wanted->n};
    struct hsr_difference difference = {.first = ""};
    wanted->answer.form.type->compare(&comparison, &difference);
    if (!cell->mismatches)
      memcpy(cell->first, difference.first, sizeof cell->first);
    cell->compared = difference.compared;
    *(build ? &cell->counting_mismatches : &cell->mismatches) =
        difference.differing;
  }
  cell->builds = BUILDS;
  cell->verdict = cell->mismatches || cell->counting_mismatches ? WRONG : RIGHT;
}

static enum hsr_status judge(const struct summing *s, int picture,
                             int algorithm, struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  const struct hsr_form *form = form_of(s, algorithm);
  struct group of = {.form = *form,
                     .samples = samples_to_compare(&s->world, form, o->samples),
                     .world = &s->world,
                     .view = &s->run->view[picture],
                     .number = &o->view[picture % o->n_views],
                     .n_views = 1};
  struct wanted *wanted = calloc(1, sizeof *wanted);
  enum hsr_status status =
      wanted ? ask_oracle(&of, oracle_of(form->type), wanted, err)
             : hsr_fail_nomem(err);
  if (!status)
    compare(
        s, picture, algorithm, wanted,
        cell_at(s->run, picture / o->n_views, picture % o->n_views, algorithm));
  free_wanted(&of, wanted);
  return status;
}

static void note_refusal(const struct summing *s, int algorithm) {
  const struct check_options *o = s->run->options;
  for (int k = 0; k < n_pictures(s); k++) {
    struct cell *cell =
        cell_at(s->run, k / o->n_views, k % o->n_views, algorithm);
    cell->verdict = REFUSED;
    snprintf(cell->refusal, sizeof cell->refusal, "%s",
             *s->why[algorithm] ? s->why[algorithm]
                                : "it does not take a part of the scene");
  }
}

/* All ranks together. */
static enum hsr_status gather_all(const struct summing *s,
                                  struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  enum hsr_status status = HSR_OK;
  for (int a = 0; a < o->n_algorithms; a++)
    for (int k = 0; k < BUILDS * n_pictures(s) && !status; k++)
      if (is_summed(o, a) && !s->refused[a])
        status = gather(s, k / BUILDS, a, k % BUILDS, err);
  return status;
}

/* In rank 0. */
static enum hsr_status judge_all(struct summing *s, struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  struct hsr_import import = o->import;
  enum hsr_status status =
      hsr_scene_open(s->run->name, &import, &s->scene, err);
  if (!status)
    status = hsr_world_open(&s->world, s->scene, most_laid_out(o), err);
  for (int a = 0; a < o->n_algorithms; a++) {
    if (!is_summed(o, a))
      continue;
    if (s->refused[a])
      note_refusal(s, a);
    for (int k = 0; k < n_pictures(s) && !status && !s->refused[a]; k++)
      status = judge(s, k, a, err);
  }
  hsr_world_free(&s->world);
  hsr_scene_delete(s->scene);
  return status;
}

enum hsr_status judge_summed_parts(struct scene_run *run,
                                   const struct hsr_scene_part *part,
                                   struct hsr_error *err) {
  size_t n_algorithms = (size_t)run->options->n_algorithms;
  struct summing s = {.run = run, .part = *part};
  size_t n = (size_t)n_pictures(&s) * n_algorithms * BUILDS;
  s.part.keeps_grid = true;
  s.sums = calloc(n, sizeof *s.sums);
  s.refused = calloc(n_algorithms, sizeof *s.refused);
  s.why = calloc(n_algorithms, sizeof *s.why);
  enum hsr_status status =
      s.sums && s.refused && s.why ? draw_parts(&s, err) : hsr_fail_nomem(err);
  if (!status) {
    ranks_unite(s.refused, n_algorithms * sizeof *s.refused);
    status = gather_all(&s, err);
  }
  if (!status && !ranks_own())
    status = judge_all(&s, err);
  for (size_t k = 0; s.sums && k < n; k++)
    if (s.sums[k].body)
      hsr_answer_free(&s.sums[k]);
  if (!run->world.n_faces)
    run->world.n_faces = s.part.all;
  free(s.sums);
  free(s.refused);
  free(s.why);
  return status;
}
