/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr check --sort-last: judges the pictures that are put together from those of
 * a scene's parts.
 *
 * The oracle answers for each part at the places that are compared. Rank 0 gets
 * the faces that it saw there, and asks it again of these alone: the face that
 * is seen of a scene is seen of its part too, so it is among them. Nothing here
 * says which of two faces is nearer. */
#include "bench/check/check.h"
#include "bench/run/composite.h"
#include "bench/run/ranks.h"
#include "bench/terminal/terminal.h"

#include <stdlib.h>
#include <string.h>

enum { BUILDS = 2 }; /* of an algorithm: the timed one, the counting one */

/* A picture that is judged: of a size and view. */
struct judged {
  const struct hsr_view *view;
  uint32_t *place; /* to be compared; NULL: all */
  size_t n_places;
  struct loose_faces candidates;
  struct composite *composite; /* an algorithm and build */
};

struct sorting {
  struct scene_run *run;
  struct hsr_part part;
  struct hsr_scene *scene; /* the part's */
  struct hsr_world world;
  struct judged *judged; /* a size and view */
  bool *refused;         /* an algorithm */
  char (*why)[sizeof((struct cell *)0)->refusal];
};

static int n_judged(const struct sorting *s) {
  return s->run->options->n_sizes * s->run->options->n_views;
}

/* --- What the oracle sees ------------------------------------------------- */

/* Draws all of a view, or some places of it, one by one. */
static enum hsr_status ask(const struct hsr_world *world,
                           const struct judged *j, struct hsr_answer *answer,
                           struct hsr_error *err) {
  struct hsr_setup oracle;
  struct hsr_tally tally = {.out_of_memory = false};
  struct crew *crew = crew_new(1);
  struct hsr_view view = *j->view;
  enum hsr_status status =
      hsr_setup_init(&oracle, oracle_of(HSR_IDS), NULL, world, err);
  if (!status && !crew)
    status = hsr_fail_nomem(err);
  for (size_t k = 0; k < (j->place ? j->n_places : 1) && !status; k++) {
    if (j->place) {
      int x = (int)(j->place[k] % (uint32_t)view.m);
      int y = (int)(j->place[k] / (uint32_t)view.m);
      view.window = (struct hsr_window){x, y, x + 1, y + 1};
    }
    status = crew_render(crew, &oracle, &view, answer, &tally, err);
  }
  crew_free(crew);
  hsr_setup_free(&oracle);
  return status;
}

/* Adds the faces of this part that may be seen. */
static enum hsr_status add_candidates(struct sorting *s, struct judged *j,
                                      struct hsr_error *err) {
  struct hsr_answer answer;
  struct hsr_form form = hsr_form_standard(HSR_IDS);
  struct loose_faces more = {.n = 0}, all = {.n = 0};
  enum hsr_status status = hsr_answer_make(&answer, &form, j->view, false, err);
  if (!status)
    status = ask(&s->world, j, &answer, err);
  if (!status && (loose_faces_seen(&more, &s->world, s->part.first,
                                   hsr_answer_ids_of(&answer),
                                   (size_t)j->view->m * (size_t)j->view->n) ||
                  loose_faces_unite(&all, &j->candidates, &more)))
    status = hsr_fail_nomem(err);
  hsr_answer_free(&answer);
  loose_faces_free(&more);
  if (status)
    return status;
  loose_faces_free(&j->candidates);
  j->candidates = all;
  return HSR_OK;
}

/* --- What algorithms draw ------------------------------------------------- */

static struct composite *composite_of(const struct judged *j, int algorithm,
                                      int build) {
  return &j->composite[algorithm * BUILDS + build];
}

static enum hsr_status draw_view(struct sorting *s,
                                 const struct hsr_setup *setup,
                                 struct judged *j, struct composite *composite,
                                 struct hsr_error *err) {
  struct hsr_answer answer;
  struct hsr_tally tally = {.out_of_memory = false};
  enum hsr_status status = answer_init(&answer, setup, j->view, err);
  if (!status)
    status = render_view(setup, j->view, 1, &answer, &tally, NULL, err);
  if (!status && !composite->ids)
    status = composite_init(composite, j->view, err);
  if (!status)
    status = composite_add(composite, &s->world, s->part.first,
                           hsr_answer_ids_of(&answer), err);
  hsr_answer_free(&answer);
  return status;
}

/* All views, in order, by one prepared object. */
static enum hsr_status draw_size(struct sorting *s, int algorithm, int build,
                                 int size, struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  const struct hsr_variant *v = &o->algorithm[algorithm];
  struct hsr_setup setup;
  enum hsr_status status =
      hsr_setup_init(&setup, build ? v->listed->counting : v->listed->plain,
                     &v->choice, &s->world, err);
  for (int k = 0; k < o->n_views && !status; k++) {
    struct judged *j = &s->judged[size * o->n_views + k];
    status = draw_view(s, &setup, j, composite_of(j, algorithm, build), err);
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

static enum hsr_status begin_view(struct sorting *s, int k,
                                  struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  struct judged *j = &s->judged[k];
  struct hsr_world all = {.n_faces = s->part.all};
  struct hsr_form form = hsr_form_standard(HSR_IDS);
  j->view = &s->run->view[k];
  j->composite =
      calloc((size_t)(BUILDS * o->n_algorithms), sizeof *j->composite);
  long wanted = samples_to_compare(&all, &form, o->samples);
  return j->composite &&
                 !choose_places(o->view[k % o->n_views], j->view->m, j->view->n,
                                (size_t)wanted, &j->place, &j->n_places)
             ? HSR_OK
             : hsr_fail_nomem(err);
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

static enum hsr_status judge_open_part(struct sorting *s,
                                       struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  enum hsr_status status =
      hsr_world_open(&s->world, s->scene, most_laid_out(o), err);
  for (int k = 0; k < n_judged(s) && !status; k++)
    status = add_candidates(s, &s->judged[k], err);
  for (int a = 0; a < o->n_algorithms && !status; a++)
    if (!s->refused[a])
      status = draw_algorithm(s, a, err);
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

/* The oracle's picture, of the faces that may be seen; by the scene's ids. */
static enum hsr_status ask_of_candidates(struct scene_run *run,
                                         const struct judged *j,
                                         struct hsr_answer *wanted,
                                         struct hsr_error *err) {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_form form = hsr_form_standard(HSR_IDS);
  enum hsr_status status = hsr_answer_make(wanted, &form, j->view, false, err);
  if (status || !j->candidates.n)
    return status;
  status = loose_faces_lay_out(&j->candidates, run->name, &scene, &world, err);
  if (!status)
    status = ask(&world, j, wanted, err);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
  uint32_t *ids = hsr_answer_ids_of(wanted);
  for (size_t k = 0; k < (size_t)j->view->m * (size_t)j->view->n; k++)
    if (ids[k] != HSR_BACKGROUND)
      ids[k] = j->candidates.id[ids[k]];
  return status;
}

static void compare(const struct judged *j, int algorithm,
                    const struct hsr_answer *wanted, struct cell *cell) {
  for (int build = 0; build < BUILDS; build++) {
    struct hsr_answer got = hsr_answer_of_ids(
        composite_of(j, algorithm, build)->ids, j->view->m, j->view->n);
    struct hsr_comparison comparison = {.view = j->view,
                                        .got = &got,
                                        .wanted = wanted,
                                        .place = j->place,
                                        .n = j->n_places};
    struct hsr_difference difference = {.first = ""};
    HSR_IDS->compare(&comparison, &difference);
    if (!cell->mismatches)
      memcpy(cell->first, difference.first, sizeof cell->first);
    cell->compared = difference.compared;
    *(build ? &cell->counting_mismatches : &cell->mismatches) =
        difference.differing;
  }
  cell->builds = BUILDS;
  cell->verdict = cell->mismatches || cell->counting_mismatches ? WRONG : RIGHT;
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

/* All ranks together; rank 0 fills the cells. */
static enum hsr_status judge_picture(struct sorting *s, int k,
                                     struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  struct judged *j = &s->judged[k];
  struct hsr_answer wanted = {.body = NULL};
  enum hsr_status status = composite_gather_faces(&j->candidates, err);
  if (!status && !ranks_own())
    status = ask_of_candidates(s->run, j, &wanted, err);
  for (int a = 0; a < o->n_algorithms && !status; a++) {
    struct cell *cell = cell_at(s->run, k / o->n_views, k % o->n_views, a);
    for (int b = 0; b < BUILDS && !s->refused[a] && !status; b++)
      status = composite_gather(composite_of(j, a, b), err);
    if (s->refused[a])
      note_refusal(s, a, cell);
    else if (!status && !ranks_own())
      compare(j, a, &wanted, cell);
  }
  if (wanted.body)
    hsr_answer_free(&wanted);
  return status;
}

/* A picture of which this rank had no part that was not empty. */
static enum hsr_status make_missing(struct sorting *s, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < n_judged(s); k++)
    for (int a = 0; a < BUILDS * s->run->options->n_algorithms && !status; a++)
      if (!s->judged[k].composite[a].ids)
        status =
            composite_init(&s->judged[k].composite[a], s->judged[k].view, err);
  return status;
}

static void free_all(struct sorting *s) {
  for (int k = 0; s->judged && k < n_judged(s); k++) {
    struct judged *j = &s->judged[k];
    for (int a = 0; j->composite && a < BUILDS * s->run->options->n_algorithms;
         a++)
      composite_free(&j->composite[a]);
    free(j->composite);
    free(j->place);
    loose_faces_free(&j->candidates);
  }
  free(s->judged);
  free(s->refused);
  free(s->why);
}

static enum hsr_status judge_all(struct sorting *s, struct hsr_error *err) {
  const struct check_options *o = s->run->options;
  enum hsr_status status = take_parts(s, err);
  if (!status)
    status = make_missing(s, err);
  if (!status)
    ranks_unite(s->refused, (size_t)o->n_algorithms * sizeof *s->refused);
  for (int k = 0; k < n_judged(s) && !status; k++)
    status = judge_picture(s, k, err);
  s->run->world.n_faces = s->part.all;
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
