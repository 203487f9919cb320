/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr check --sort-last: judges the pictures that are put together from those of
 * a scene's parts, and what is folded from such pictures. What is right is found
 * by bench/check/candidates.h; nothing here says which of two faces is nearer. */
#include "bench/modules/variant.h"
#include "bench/check/candidates.h"
#include "bench/check/check.h"
#include "bench/ranks/composite.h"
#include "bench/ranks/ranks.h"
#include "bench/run/crew.h"
#include "bench/terminal/terminal.h"

#include <stdlib.h>
#include <string.h>

enum { BUILDS = 2 }; /* of an algorithm: the timed one, the counting one */

/* What a build of an algorithm has drawn of a view: the picture of ids, or those
 * that are folded. */
struct drawn {
  struct composite *composite;
  long n;
};

/* A view that is judged, in one size. */
struct judged {
  const struct hsr_view *view;
  struct loose_faces candidates; /* of all forms */
  struct drawn *drawn;           /* an algorithm and build */
};

struct sorting {
  struct scene_run *run;
  struct hsr_scene_part part;
  struct hsr_scene *scene; /* the part's */
  struct hsr_world world;
  struct judged *judged; /* a size and view */
  bool *refused;         /* an algorithm */
  char (*why)[sizeof((struct cell *)0)->refusal];
};

static int n_judged(const struct sorting *s) {
  return s->run->options->n_sizes * s->run->options->n_views;
}

static const struct hsr_form *form_of(const struct sorting *s, int algorithm) {
  return &s->run->options->algorithm[algorithm].choice.form;
}

/* Whether no algorithm before this one has its form. */
static bool is_first(const struct sorting *s, int algorithm) {
  for (int a = 0; a < algorithm; a++)
    if (hsr_same_form(form_of(s, a), form_of(s, algorithm)))
      return false;
  return true;
}

/* Whether an algorithm draws this form, and does not refuse the scene. */
static bool is_drawn(const struct sorting *s, const struct hsr_form *form) {
  for (int a = 0; a < s->run->options->n_algorithms; a++)
    if (hsr_same_form(form_of(s, a), form) && !s->refused[a] &&
        !is_summed(s->run->options, a))
      return true;
  return false;
}

/* What the oracle is asked about picture k, in the form of an algorithm. */
static struct group question(const struct sorting *s, int k, int algorithm,
                             const struct hsr_world *world) {
  const struct check_options *o = s->run->options;
  struct hsr_world all = {.n_faces = s->part.all};
  const struct hsr_form *form = form_of(s, algorithm);
  return (struct group){.form = *form,
                        .samples = samples_to_compare(&all, form, o->samples),
                        .world = world,
                        .view = s->judged[k].view,
                        .number = &o->view[k % o->n_views],
                        .n_views = 1};
}

/* --- What algorithms draw ------------------------------------------------- */

static struct drawn *drawn_of(const struct judged *j, int algorithm,
                              int build) {
  return &j->drawn[algorithm * BUILDS + build];
}

/* The view of the k-th picture that is drawn for an answer. */
static enum hsr_status picture_view(const struct hsr_form *form,
                                    const struct hsr_view *view, long k,
                                    struct hsr_view *picture,
                                    struct hsr_error *err) {
  const struct hsr_fold *fold = form->type->fold;
  *picture = *view;
  return fold ? fold->view(form, view, k, picture, err) : HSR_OK;
}

static enum hsr_status draw_picture(struct sorting *s,
                                    const struct hsr_setup *setup,
                                    const struct hsr_view *view,
                                    struct composite *composite,
                                    struct hsr_error *err) {
  struct hsr_answer answer;
  struct hsr_tally tally = {.out_of_memory = false};
  enum hsr_status status = answer_init(&answer, setup, view, err);
  if (!status)
    status = render_view(setup, view, 1, &answer, &tally, NULL, err);
  if (!status && !composite->ids)
    status = composite_init(composite, view, err);
  if (!status)
    status = composite_add(composite, &s->world, s->part.first,
                           hsr_answer_ids_of(&answer), err);
  hsr_answer_free(&answer);
  return status;
}

static enum hsr_status draw_view(struct sorting *s,
                                 const struct hsr_setup *setup,
                                 const struct hsr_form *form,
                                 const struct judged *j, struct drawn *drawn,
                                 struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (long k = 0; k < drawn->n && !status; k++) {
    struct hsr_view view;
    status = picture_view(form, j->view, k, &view, err);
    if (!status)
      status = draw_picture(s, setup, &view, &drawn->composite[k], err);
  }
  return status;
}

/* All views, in order, by one prepared object. */
static enum hsr_status draw_size(struct sorting *s, int algorithm, int build,
                                 int size, struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  const struct hsr_variant *v = &o->algorithm[algorithm];
  struct hsr_setup setup;
  struct hsr_choice of_ids = v->choice;
  of_ids.form = hsr_form_standard(HSR_IDS);
  enum hsr_status status =
      hsr_setup_init(&setup, build ? v->listed->counting : v->listed->plain,
                     &of_ids, &s->world, err);
  for (int k = 0; k < o->n_views && !status; k++) {
    const struct judged *j = &s->judged[size * o->n_views + k];
    status = draw_view(s, &setup, &v->choice.form, j,
                       drawn_of(j, algorithm, build), err);
  }
  hsr_setup_free(&setup);
  return status;
}

/* By both builds; a refusal is noted. */
static enum hsr_status draw_algorithm(struct sorting *s, int algorithm,
                                      struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < BUILDS * o->n_sizes && !status; k++)
    status = draw_size(s, algorithm, k % BUILDS, k / BUILDS, err);
  if (status != HSR_E_REFUSED)
    return status;
  s->refused[algorithm] = true;
  snprintf(s->why[algorithm], sizeof s->why[algorithm], "refused by %s: %s",
           o->algorithm[algorithm].listed->plain->name, err->text);
  return HSR_OK;
}

/* --- A part --------------------------------------------------------------- */

static enum hsr_status begin_drawn(const struct hsr_form *form,
                                   struct drawn *drawn) {
  const struct hsr_fold *fold = form->type->fold;
  drawn->n = fold ? fold->n(form) : 1;
  drawn->composite = calloc((size_t)drawn->n, sizeof *drawn->composite);
  return drawn->composite ? HSR_OK : HSR_E_NOMEM;
}

static enum hsr_status begin_view(struct sorting *s, int k,
                                  struct hsr_error *err) {
  struct judged *j = &s->judged[k];
  int n = BUILDS * s->run->options->n_algorithms;
  j->view = &s->run->view[k];
  j->drawn = calloc((size_t)n, sizeof *j->drawn);
  enum hsr_status status = j->drawn ? HSR_OK : HSR_E_NOMEM;
  for (int a = 0; a < n && !status; a++)
    status = begin_drawn(form_of(s, a / BUILDS), &j->drawn[a]);
  return status ? hsr_fail_nomem(err) : HSR_OK;
}

/* With the first part it is known what there is to judge. */
static enum hsr_status begin(struct sorting *s, struct hsr_error *err) {
  if (s->run->view)
    return HSR_OK;
  enum hsr_status status = init_views(s->run, s->scene, err);
  for (int k = 0; k < n_judged(s) && !status; k++)
    status = begin_view(s, k, err);
  return status;
}

/* The faces of this part that may be seen in a form that is judged. */
static enum hsr_status add_candidates(struct sorting *s, int algorithm,
                                      struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < n_judged(s) && !status; k++) {
    struct group of = question(s, k, algorithm, &s->world);
    status = candidates_add(&s->judged[k].candidates, &of, s->part.first, err);
  }
  return status;
}

static enum hsr_status judge_open_part(struct sorting *s,
                                       struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  enum hsr_status status =
      hsr_world_open(&s->world, s->scene, most_laid_out(o), err);
  for (int a = 0; a < o->n_algorithms && !status; a++)
    if (!s->refused[a] && !is_summed(o, a))
      status = draw_algorithm(s, a, err);
  for (int a = 0; a < o->n_algorithms && !status; a++)
    if (is_first(s, a) && is_drawn(s, form_of(s, a)))
      status = add_candidates(s, a, err);
  hsr_world_free(&s->world);
  return status;
}

static enum hsr_status judge_part(struct sorting *s, uint32_t number,
                                  struct hsr_error *err) {
  struct hsr_import import = s->run->options->import;
  s->part.number = number;
  enum hsr_status status =
      hsr_scene_open_part(s->run->name, &import, &s->part, &s->scene, err);
  if (!status)
    status = begin(s, err);
  if (!status && s->part.n_faces)
    status = judge_open_part(s, err);
  hsr_scene_delete(s->scene);
  s->scene = NULL;
  return status;
}

/* A rank takes the part of its own number, and then whichever is left. */
static enum hsr_status take_parts(struct sorting *s, struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  long ranks = ranks_count(), all = s->part.of;
  enum hsr_status status = HSR_OK;
  struct queue queue;
  queue_open(&queue, all - ranks, true);
  for (long k = ranks_own(); k >= 0 && k < all && !status;) {
    progress_tell(s->run->progress, (size_t)(s->run->number * all + k),
                  (size_t)(o->n_scenes * all), "parts", s->run->name);
    status = judge_part(s, (uint32_t)k, err);
    k = queue_take(&queue);
    k += k < 0 ? 0 : ranks;
  }
  return status;
}

/* --- The verdict ---------------------------------------------------------- */

/* What is folded from the pictures, which are put together. */
static enum hsr_status fold(const struct sorting *s, const struct judged *j,
                            const struct drawn *drawn,
                            const struct hsr_form *form, struct hsr_answer *got,
                            struct hsr_error *err) {
  enum hsr_status status = hsr_answer_make(got, form, j->view, true, err);
  for (long k = 0; k < drawn->n && !status; k++) {
    struct hsr_scene *scene;
    struct hsr_world world;
    status = composite_lay_out(&drawn->composite[k], s->run->name, &scene,
                               &world, hsr_answer_ids_of(got->picture), err);
    if (!status)
      form->type->fold->add(got, &world, j->view, k);
    hsr_world_free(&world);
    hsr_scene_delete(scene);
  }
  return status;
}

/* What a build has drawn, by the scene's ids. */
static void compare_answer(const struct judged *j, int build,
                           const struct hsr_answer *got,
                           const struct wanted *wanted, struct cell *cell) {
  struct hsr_comparison comparison = {.view = j->view,
                                      .got = got,
                                      .wanted = &wanted->answer,
                                      .place = wanted->sample,
                                      .n = wanted->n};
  struct hsr_difference difference = {.first = ""};
  got->form.type->compare(&comparison, &difference);
  if (!cell->mismatches)
    memcpy(cell->first, difference.first, sizeof cell->first);
  cell->compared = difference.compared;
  *(build ? &cell->counting_mismatches : &cell->mismatches) =
      difference.differing;
}

static enum hsr_status compare(const struct sorting *s, const struct judged *j,
                               int algorithm, const struct wanted *wanted,
                               struct cell *cell, struct hsr_error *err) {
  const struct hsr_form *form = form_of(s, algorithm);
  enum hsr_status status = HSR_OK;
  for (int build = 0; build < BUILDS && !status; build++) {
    const struct drawn *drawn = drawn_of(j, algorithm, build);
    struct hsr_answer folded = {.body = NULL};
    struct hsr_answer ids =
        hsr_answer_of_ids(drawn->composite[0].ids, j->view->m, j->view->n);
    if (form->type->fold)
      status = fold(s, j, drawn, form, &folded, err);
    if (!status)
      compare_answer(j, build, form->type->fold ? &folded : &ids, wanted, cell);
    if (form->type->fold)
      hsr_answer_free(&folded);
  }
  cell->builds = BUILDS;
  cell->verdict = cell->mismatches || cell->counting_mismatches ? WRONG : RIGHT;
  return status;
}

/* Another rank may have been told why. */
static void note_refusal(const struct sorting *s, int algorithm,
                         struct cell *cell) {
  const struct check_options *o = s->run->options;
  cell->verdict = REFUSED;
  if (*s->why[algorithm])
    snprintf(cell->refusal, sizeof cell->refusal, "%s", s->why[algorithm]);
  else
    snprintf(cell->refusal, sizeof cell->refusal,
             "refused by %s: it does not take a part of the scene",
             o->algorithm[algorithm].listed->plain->name);
}

/* Puts together what the ranks have drawn, in rank 0. */
static enum hsr_status gather(const struct judged *j, int algorithm,
                              struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (int b = 0; b < BUILDS; b++)
    for (long k = 0; k < drawn_of(j, algorithm, b)->n && !status; k++)
      status = composite_gather(&drawn_of(j, algorithm, b)->composite[k], err);
  return status;
}

/* The algorithms that have the form of this one, which is the first of them. All
 * ranks together; rank 0 fills the cells. */
static enum hsr_status judge_form(struct sorting *s, int k, int first,
                                  struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  struct judged *j = &s->judged[k];
  const struct hsr_form *form = form_of(s, first);
  struct group of = question(s, k, first, NULL);
  struct wanted *wanted = calloc(1, sizeof *wanted);
  enum hsr_status status = wanted ? HSR_OK : hsr_fail_nomem(err);
  if (!status && !ranks_own() && is_drawn(s, form))
    status = candidates_ask(&j->candidates, &of, s->run->name, wanted, err);
  for (int a = first; a < o->n_algorithms && !status; a++) {
    struct cell *cell = cell_at(s->run, k / o->n_views, k % o->n_views, a);
    if (!hsr_same_form(form_of(s, a), form))
      continue;
    if (s->refused[a])
      note_refusal(s, a, cell);
    else
      status = gather(j, a, err);
    if (!status && !s->refused[a] && !ranks_own())
      status = compare(s, j, a, wanted, cell, err);
  }
  free_wanted(&of, wanted);
  return status;
}

static enum hsr_status judge_picture(struct sorting *s, int k,
                                     struct hsr_error *err) {
  enum hsr_status status =
      composite_gather_faces(&s->judged[k].candidates, err);
  for (int a = 0; a < s->run->options->n_algorithms && !status; a++)
    if (is_first(s, a) && !is_summed(s->run->options, a))
      status = judge_form(s, k, a, err);
  return status;
}

/* Pictures of which this rank had no part that was not empty. */
static enum hsr_status make_missing_of(const struct judged *j,
                                       const struct hsr_form *form,
                                       struct drawn *drawn,
                                       struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (long k = 0; k < drawn->n && !status; k++) {
    struct hsr_view view;
    status = picture_view(form, j->view, k, &view, err);
    if (!status && !drawn->composite[k].ids)
      status = composite_init(&drawn->composite[k], &view, err);
  }
  return status;
}

static enum hsr_status make_missing(struct sorting *s, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < n_judged(s); k++)
    for (int a = 0; a < BUILDS * s->run->options->n_algorithms && !status; a++)
      if (!s->refused[a / BUILDS])
        status = make_missing_of(&s->judged[k], form_of(s, a / BUILDS),
                                 &s->judged[k].drawn[a], err);
  return status;
}

static void free_drawn(struct drawn *drawn) {
  for (long k = 0; drawn->composite && k < drawn->n; k++)
    composite_free(&drawn->composite[k]);
  free(drawn->composite);
}

static void free_all(struct sorting *s) {
  for (int k = 0; s->judged && k < n_judged(s); k++) {
    struct judged *j = &s->judged[k];
    for (int a = 0; j->drawn && a < BUILDS * s->run->options->n_algorithms; a++)
      free_drawn(&j->drawn[a]);
    free(j->drawn);
    loose_faces_free(&j->candidates);
  }
  free(s->judged);
  free(s->refused);
  free(s->why);
}

static enum hsr_status judge_ids(struct sorting *s, struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  enum hsr_status status = take_parts(s, err);
  if (!status)
    ranks_unite(s->refused, (size_t)o->n_algorithms * sizeof *s->refused);
  if (!status)
    status = make_missing(s, err);
  for (int k = 0; k < n_judged(s) && !status; k++)
    status = judge_picture(s, k, err);
  s->run->world.n_faces = s->part.all;
  return status;
}

/* How many algorithms draw what is summed. */
static int count_summed(const struct check_options *o) {
  int n = 0;
  for (int a = 0; a < o->n_algorithms; a++)
    n += is_summed(o, a);
  return n;
}

static enum hsr_status judge_all(struct sorting *s, struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  const struct hsr_scene_part part = s->part;
  int n_summed = count_summed(o);
  enum hsr_status status =
      n_summed < o->n_algorithms ? judge_ids(s, err) : HSR_OK;
  if (!status && n_summed)
    status = judge_summed_parts(s->run, &part, err);
  s->run->scene = hsr_scene_new(s->run->name); /* of faces */
  return !status && !s->run->scene ? hsr_fail_nomem(err) : status;
}

enum hsr_status judge_parts(struct scene_run *run, struct hsr_error *err) {
  const struct check_options *o = run->options;
  struct sorting s = {.run = run,
                      .part.of =
                          (uint32_t)(o->parts ? o->parts : ranks_count()),
                      .part.least_views = last_view(o) + 1};
  if (s.part.of < (uint32_t)ranks_count())
    return hsr_fail(err, HSR_E_USAGE,
                    "--sort-last=%ld: for %d ranks there must be as many "
                    "parts at least",
                    o->parts, ranks_count());
  s.judged = calloc((size_t)n_judged(&s), sizeof *s.judged);
  s.refused = calloc((size_t)o->n_algorithms, sizeof *s.refused);
  s.why = calloc((size_t)o->n_algorithms, sizeof *s.why);
  enum hsr_status status =
      s.judged && s.refused && s.why ? judge_all(&s, err) : hsr_fail_nomem(err);
  free_all(&s);
  return status;
}
