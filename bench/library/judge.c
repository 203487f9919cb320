/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Judging: an answer, or a stranger's ids, beside those of the oracle. */
#include "bench/library/library.h"
#include "bench/judge/judge.h"
#include "bench/judge/wanted.h"
#include "bench/run/crew.h"

#include <stdio.h>
#include <stdlib.h>

/* What is judged. All borrowed. */
struct case_ {
  struct lib_scene *scene;
  const struct hsr_view *view;
  const struct hsr_answer *got;
  bool coarse;
  const struct hsr_request *request; /* whose progress() is told; or NULL */
};

/* The oracle draws in so many bands at least. */
enum { BANDS = 50 };

static bool tell(void *whom, double share) {
  const struct hsr_request *request = whom;
  return request->progress(request->context, share);
}

/* --- Places --------------------------------------------------------------- */

/* Sets *place to the places of the view's window, ascending; NULL if that is
 * all of it. The caller frees it. HSR_E_NOMEM. */
static enum hsr_status list_places(const struct hsr_view *view,
                                   uint32_t **place, size_t *n) {
  const struct hsr_window *w = &view->window;
  *n = (size_t)(w->x1 - w->x0) * (size_t)(w->y1 - w->y0);
  *place = NULL;
  if (*n == (size_t)view->m * (size_t)view->n)
    return HSR_OK;
  uint32_t *list = *place = malloc(*n * sizeof *list);
  for (int j = w->y0; list && j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      *list++ = (uint32_t)j * (uint32_t)view->m + (uint32_t)i;
  return *place ? HSR_OK : HSR_E_NOMEM;
}

static struct hsr_difference compare(const struct hsr_comparison *comparison) {
  struct hsr_difference difference = {.first = ""};
  comparison->got->form.type->compare(comparison, &difference);
  return difference;
}

/* Adds the places that differ among n places from place[0] on, by halves. */
static void find_places(const struct hsr_comparison *comparison,
                        const uint32_t *place, size_t n,
                        struct hsr_verdict *verdict) {
  struct hsr_comparison some = *comparison;
  some.place = place;
  some.n = n;
  if (verdict->n_places == verdict->room || !compare(&some).differing)
    return;
  if (n == 1) {
    verdict->place[verdict->n_places++] = *place;
    return;
  }
  find_places(comparison, place, n / 2, verdict);
  find_places(comparison, place + n / 2, n - n / 2, verdict);
}

static enum hsr_status list_differences(const struct hsr_comparison *comparison,
                                        struct hsr_verdict *verdict,
                                        struct hsr_error *err) {
  uint32_t *all = NULL;
  if (!comparison->place) {
    all = malloc(comparison->n * sizeof *all);
    if (!all)
      return hsr_fail_nomem(err);
    for (size_t k = 0; k < comparison->n; k++)
      all[k] = (uint32_t)k;
  }
  find_places(comparison, all ? all : comparison->place, comparison->n,
              verdict);
  free(all);
  return HSR_OK;
}

/* --- The oracle ----------------------------------------------------------- */

/* Fills *verdict. The scene is held for reading. */
static enum hsr_status say(const struct case_ *c, const struct wanted *wanted,
                           struct hsr_verdict *verdict, struct hsr_error *err) {
  const struct hsr_answer_type *type = c->got->form.type;
  uint32_t *place = NULL;
  size_t n = 0;
  if (type->by_places && list_places(c->view, &place, &n))
    return hsr_fail_nomem(err);
  struct hsr_comparison comparison = {.view = c->view,
                                      .got = c->got,
                                      .wanted = &wanted->answer,
                                      .place = place,
                                      .n = n,
                                      .coarse = c->coarse};
  struct hsr_difference difference = compare(&comparison);
  verdict->compared = difference.compared;
  verdict->differing = difference.differing;
  snprintf(verdict->first, sizeof verdict->first, "%s", difference.first);
  enum hsr_status status =
      difference.differing && type->by_places && verdict->place
          ? list_differences(&comparison, verdict, err)
          : HSR_OK;
  free(place);
  return status;
}

static enum hsr_status judge(const struct case_ *c, struct hsr_verdict *verdict,
                             struct hsr_error *err) {
  const struct hsr_form *form = &c->got->form;
  const struct hsr_algorithm *oracle = oracle_of(form->type);
  const struct hsr_world *world;
  const int number = 0;
  if (!oracle)
    return hsr_fail(err, HSR_E_REFUSED,
                    "no oracle makes answers of the kind %s", form->type->name);
  enum hsr_status status = lib_scene_world(c->scene, oracle, NULL, &world, err);
  if (status)
    return status;
  const struct crew_watch watch = {tell, (void *)c->request, BANDS};
  struct group group = {.world = world,
                        .form = *form,
                        .view = c->view,
                        .number = &number,
                        .n_views = 1};
  if (c->request && c->request->progress)
    group.watch = &watch;
  struct wanted *wanted = calloc(1, sizeof *wanted);
  if (!wanted)
    return hsr_fail_nomem(err);
  lib_scene_read(c->scene);
  status = ask_oracle(&group, oracle, wanted, err);
  if (!status)
    status = say(c, wanted, verdict, err);
  lib_scene_leave(c->scene);
  free_wanted(&group, wanted);
  return status;
}

/* --- What is judged ------------------------------------------------------- */

/* Takes what the caller sets of a verdict; all else becomes 0. */
static enum hsr_status take_verdict(const struct hsr_verdict *from,
                                    struct hsr_verdict *verdict,
                                    struct hsr_error *err) {
  struct hsr_verdict taken;
  if (!from)
    return lib_null("verdict", err);
  enum hsr_status status = lib_take("verdict", &taken, sizeof taken, from, err);
  *verdict = (struct hsr_verdict){.place = taken.place, .room = taken.room};
  return status;
}

enum hsr_status hsr_judge(const struct lib_answer *answer,
                          struct hsr_verdict *verdict, struct hsr_error *err) {
  struct hsr_verdict found;
  if (!answer)
    return lib_null("answer", err);
  enum hsr_status status = take_verdict(verdict, &found, err);
  if (status)
    return status;
  const struct hsr_algorithm *a = answer->variant.listed->plain;
  if (a->flags & HSR_NO_PICTURE)
    return hsr_fail(err, HSR_E_REFUSED, "%s draws nothing", a->name);
  struct case_ c = {.scene = answer->scene,
                    .view = &answer->view,
                    .got = &answer->answer,
                    .coarse = hsr_makes_how(a, answer->answer.form.type) &
                              HSR_VISIBLE_ONLY};
  status = judge(&c, &found, err);
  return status ? status
                : lib_give("verdict", verdict, sizeof found, &found, err);
}

enum hsr_status hsr_judge_ids(const struct lib_scene *scene,
                              const struct hsr_request *request,
                              const uint32_t *ids, struct hsr_verdict *verdict,
                              struct hsr_error *err) {
  struct hsr_request taken;
  struct hsr_verdict found;
  struct hsr_view view;
  if (!scene || !request || !ids)
    return lib_null(!scene ? "scene" : !request ? "request" : "ids", err);
  enum hsr_status status = take_verdict(verdict, &found, err);
  if (!status)
    status = lib_take("request", &taken, sizeof taken, request, err);
  if (!status)
    status = lib_view(scene, &taken, HSR_IDS, &view, err);
  if (status)
    return status;
  /* Nothing writes to it. */
  struct hsr_answer got = hsr_answer_of_ids((uint32_t *)ids, view.m, view.n);
  struct case_ c = {.scene = (struct lib_scene *)scene,
                    .view = &view,
                    .got = &got,
                    .request = &taken};
  status = judge(&c, &found, err);
  return status ? status
                : lib_give("verdict", verdict, sizeof found, &found, err);
}
