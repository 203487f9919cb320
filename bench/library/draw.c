/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawing, with or without a listener. */
#include "bench/library/library.h"
#include "bench/run/crew.h"
#include "common/base/clock.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST_THREADS = 64, LEAST_BANDS = 16 };

/* --- The view ------------------------------------------------------------- */

static enum hsr_status take_camera(const struct lib_camera *from,
                                   struct hsr_camera *camera,
                                   struct hsr_error *err) {
  struct lib_camera taken;
  enum hsr_status status = lib_take("camera", &taken, sizeof taken, from, err);
  *camera = (struct hsr_camera){
      .fov = taken.fov, .near = taken.near, .parallel = taken.parallel};
  memcpy(camera->eye, taken.eye, sizeof camera->eye);
  memcpy(camera->at, taken.at, sizeof camera->at);
  memcpy(camera->up, taken.up, sizeof camera->up);
  memcpy(camera->light, taken.light, sizeof camera->light);
  return status;
}

static enum hsr_status choose_camera(const struct lib_scene *scene,
                                     const struct hsr_request *request,
                                     struct hsr_view *view,
                                     struct hsr_error *err) {
  const struct hsr_scene *s = scene->scene;
  if (request->camera) {
    struct hsr_camera camera;
    enum hsr_status status = take_camera(request->camera, &camera, err);
    return status ? status
                  : hsr_view_init(view, &camera, request->m, request->n, err);
  }
  if (request->view >= s->n_views)
    return hsr_fail(err, HSR_E_USAGE, "%s has %u views; there is no view %u",
                    s->name, s->n_views, request->view);
  return hsr_view_init_of(view, s, request->view, request->m, request->n, err);
}

static enum hsr_status set_window(const struct hsr_request *request,
                                  const struct hsr_answer_type *type,
                                  struct hsr_view *view,
                                  struct hsr_error *err) {
  const int *w = request->window;
  if (!w[0] && !w[1] && !w[2] && !w[3])
    return HSR_OK;
  if (w[0] < 0 || w[1] < 0 || w[2] > view->m || w[3] > view->n ||
      w[0] >= w[2] || w[1] >= w[3])
    return hsr_fail(err, HSR_E_USAGE,
                    "window %d, %d, %d, %d: must not be empty, and must be in "
                    "the picture of %d x %d",
                    w[0], w[1], w[2], w[3], view->m, view->n);
  if (!type->by_windows)
    return hsr_fail(err, HSR_E_USAGE,
                    "an answer of the kind %s is made as a whole; it has no "
                    "windows",
                    type->name);
  view->window = (struct hsr_window){w[0], w[1], w[2], w[3]};
  return HSR_OK;
}

static enum hsr_status set_offset(const struct hsr_request *request,
                                  const struct hsr_answer_type *type,
                                  struct hsr_view *view,
                                  struct hsr_error *err) {
  const double *o = request->offset;
  if (o[0] == 0 && o[1] == 0)
    return HSR_OK;
  if (!(fabs(o[0]) < 0.5 && fabs(o[1]) < 0.5))
    return hsr_fail(err, HSR_E_USAGE,
                    "offset %g, %g: must be above -1/2 and below 1/2", o[0],
                    o[1]);
  if (type != HSR_IDS)
    return hsr_fail(err, HSR_E_USAGE, "an answer of the kind %s has no offset",
                    type->name);
  view->offset_x = o[0];
  view->offset_y = o[1];
  return HSR_OK;
}

enum hsr_status lib_view(const struct lib_scene *scene,
                         const struct hsr_request *request,
                         const struct hsr_answer_type *type,
                         struct hsr_view *view, struct hsr_error *err) {
  enum hsr_status status = choose_camera(scene, request, view, err);
  if (!status)
    status = set_window(request, type, view, err);
  return status ? status : set_offset(request, type, view, err);
}

/* --- The answer ----------------------------------------------------------- */

void hsr_free(struct lib_answer *answer) {
  if (!answer)
    return;
  lib_polygons_free(&answer->polygons);
  free(answer->work);
  hsr_answer_free(&answer->answer);
  lib_ready_free(answer->ready);
  hsr_close(answer->scene);
  free(answer);
}

enum hsr_status lib_take_request(const struct lib_scene *scene,
                                 const struct hsr_request *from,
                                 struct hsr_request *request,
                                 struct hsr_error *err) {
  if (!scene || !from)
    return lib_null(scene ? "request" : "scene", err);
  enum hsr_status status =
      lib_take("request", request, sizeof *request, from, err);
  if (!status && !request->algorithm)
    return lib_null("request: algorithm", err);
  if (!status && (request->threads < 0 || request->threads > MOST_THREADS))
    return hsr_fail(err, HSR_E_USAGE, "request: threads must be 0 to %d",
                    MOST_THREADS);
  return status;
}

enum hsr_status lib_answer_aim(struct lib_answer *answer,
                               const struct hsr_request *request,
                               struct hsr_error *err) {
  answer->is_own_view = !request->camera;
  answer->number = request->view;
  return lib_view(answer->scene, request, answer->variant.choice.form.type,
                  &answer->view, err);
}

enum hsr_status lib_answer_begin(struct lib_ready *ready,
                                 const struct hsr_request *request,
                                 struct lib_answer **made,
                                 struct hsr_error *err) {
  struct lib_answer *answer = *made = calloc(1, sizeof *answer);
  if (!answer)
    return hsr_fail_nomem(err);
  answer->scene = lib_scene_share(ready->scene);
  answer->ready = lib_ready_share(ready);
  answer->variant = ready->variant;
  answer->counts = ready->counts;
  return lib_answer_aim(answer, request, err);
}

/* Says what is known of the setup. */
static void say_setup(struct lib_answer *answer,
                      const struct hsr_setup *setup) {
  size_t n = 0, size = sizeof answer->adapted;
  answer->adapt_seconds = setup->adapt_seconds;
  answer->prepare_seconds = setup->prepare_seconds;
  for (int k = 0; k < setup->n_adaptations && n < size; k++)
    n += (size_t)snprintf(answer->adapted + n, size - n, "%s%s", k ? ", " : "",
                          setup->adaptation[k].name);
}

/* --- Drawing -------------------------------------------------------------- */

/* Who is told how far a drawing is. */
struct told {
  int (*progress)(void *context, double share);
  void *context;
};

static bool tell(void *whom, double share) {
  const struct told *told = whom;
  return told->progress(told->context, share);
}

/* The scene is held for reading. */
static enum hsr_status draw_by_crew(struct lib_answer *answer,
                                    struct crew *crew,
                                    const struct hsr_request *request,
                                    struct hsr_error *err) {
  const struct hsr_setup *setup = &answer->ready->setup;
  struct told told = {request->progress, request->context};
  struct crew_watch watch = {request->progress ? tell : NULL, &told,
                             answer->counts ? 1 : LEAST_BANDS};
  crew_watch(crew, &watch);
  enum hsr_status status =
      answer->answer.body
          ? HSR_OK
          : answer_init(&answer->answer, setup, &answer->view, err);
  double begin = hsr_seconds_now();
  if (!status)
    status = crew_render(crew, setup, &answer->view, &answer->answer,
                         &answer->tally, err);
  answer->draw_seconds = hsr_seconds_now() - begin;
  return status;
}

enum hsr_status lib_check_work(const struct hsr_variant *variant,
                               struct hsr_error *err) {
  const struct hsr_answer_type *type = variant->choice.form.type;
  return type->by_places &&
                 !hsr_choice_folds(variant->listed->counting, &variant->choice)
             ? HSR_OK
             : hsr_fail(err, HSR_E_USAGE,
                        "work is only for samples drawn in one picture; %s "
                        "draws %s",
                        variant->name, type->draws);
}

/* Makes the memory of the work at each sample, if it is asked for. */
static enum hsr_status take_work(struct lib_answer *answer,
                                 const struct hsr_request *request,
                                 struct hsr_error *err) {
  const struct hsr_view *view = &answer->view;
  free(answer->work);
  answer->work = NULL;
  if (!request->work)
    return HSR_OK;
  if (!answer->counts)
    return hsr_fail(err, HSR_E_USAGE,
                    "the drawer was prepared without request.counts");
  enum hsr_status status = lib_check_work(&answer->variant, err);
  if (status)
    return status;
  answer->work =
      calloc((size_t)view->m * (size_t)view->n, sizeof *answer->work);
  answer->tally.work = answer->work;
  answer->tally.work_stride = (size_t)view->m;
  return answer->work ? HSR_OK : hsr_fail_nomem(err);
}

enum hsr_status lib_answer_draw(struct lib_answer *answer, struct crew *crew,
                                const struct hsr_request *request,
                                struct hsr_error *err) {
  struct hsr_trace *trace = answer->tally.trace;
  answer->world = answer->ready->world;
  answer->tally = (struct hsr_tally){.trace = trace};
  enum hsr_status status = take_work(answer, request, err);
  if (status)
    return status;
  say_setup(answer, &answer->ready->setup);
  lib_scene_read(answer->scene);
  status = draw_by_crew(answer, crew, request, err);
  if (!status)
    status = lib_polygons_make(answer, err);
  lib_scene_leave(answer->scene);
  return status;
}

/* Makes the algorithm of an answer ready and draws once. Unless the answer may
 * name faces of an adapted world, what was ready is freed then. */
static enum hsr_status draw_once(struct lib_answer *answer,
                                 const struct hsr_request *request,
                                 struct hsr_error *err) {
  enum hsr_status status = lib_ready_prepare(answer->ready, err);
  if (status)
    return status;
  struct crew *crew = crew_new(request->threads);
  if (!crew)
    return hsr_fail_nomem(err);
  status = lib_answer_draw(answer, crew, request, err);
  crew_free(crew);
  if (answer->variant.choice.form.type->by_places) {
    lib_ready_free(answer->ready);
    answer->ready = NULL;
  }
  return status;
}

/* Begins an answer for what a request asks for. */
static enum hsr_status begin(const struct lib_scene *scene,
                             const struct hsr_request *request,
                             struct lib_answer **answer,
                             struct hsr_error *err) {
  struct lib_ready *ready = NULL;
  enum hsr_status status = lib_ready_new(scene, request, &ready, err);
  if (!status)
    status = lib_answer_begin(ready, request, answer, err);
  lib_ready_free(ready);
  return status;
}

enum hsr_status hsr_draw(const struct lib_scene *scene,
                         const struct hsr_request *request,
                         struct lib_answer **answer, struct hsr_error *err) {
  struct hsr_request taken;
  struct lib_answer *made = NULL;
  if (!answer)
    return lib_null("answer", err);
  *answer = NULL;
  enum hsr_status status = lib_take_request(scene, request, &taken, err);
  if (!status)
    status = begin(scene, &taken, &made, err);
  if (!status)
    status = draw_once(made, &taken, err);
  if (status)
    hsr_free(made);
  else
    *answer = made;
  return status;
}

/* --- Tracing -------------------------------------------------------------- */

enum hsr_status lib_check_trace(const struct hsr_variant *variant,
                                struct hsr_error *err) {
  const struct hsr_algorithm *a = variant->listed->counting;
  const struct hsr_answer_type *type = variant->choice.form.type;
  const char *why = NULL;
  if (a->flags & HSR_JUDGE)
    why = "a judge has no steps to trace";
  else if (a->flags & HSR_NO_PICTURE)
    why = "it draws nothing";
  else if ((type != hsr_own_kind(a) && !hsr_makes_also(a, type)) ||
           !type->paint)
    why = "answers of this kind are not traced";
  else if (!a->outline)
    why = "it has no outline, and cannot be traced";
  return why ? hsr_fail(err, HSR_E_USAGE, "%s: %s", variant->name, why)
             : HSR_OK;
}

/* Who listens to a trace. */
struct listener {
  void (*listen)(void *context, const struct lib_event *event);
  void *context;
  const struct hsr_algorithm *algorithm;
};

static struct lib_subject subject_of(const struct hsr_subject *own) {
  return (struct lib_subject){.kind = hsr_subject_kind_name[own->kind],
                              .id = {own->id[0], own->id[1], own->id[2]}};
}

static void listen(void *context, const struct hsr_event *own) {
  const struct listener *l = context;
  const struct hsr_counter *counter = &l->algorithm->counters[own->counter];
  const struct hsr_window *w = &own->window;
  struct lib_event event = {.size = sizeof event,
                            .number = own->number,
                            .counter = (size_t)own->counter,
                            .step = hsr_step_kind_name[counter->kind],
                            .a = subject_of(&own->a),
                            .b = subject_of(&own->b),
                            .window = {w->x0, w->y0, w->x1, w->y1},
                            .outcome = own->outcome};
  l->listen(l->context, &event);
}

enum hsr_status
hsr_trace(const struct lib_scene *scene, const struct hsr_request *request,
          void (*hear)(void *context, const struct lib_event *event),
          void *context, struct lib_answer **answer, struct hsr_error *err) {
  struct hsr_request taken;
  struct lib_answer *made = NULL;
  if (!answer || !hear)
    return lib_null(answer ? "listen" : "answer", err);
  *answer = NULL;
  enum hsr_status status = lib_take_request(scene, request, &taken, err);
  taken.threads = taken.counts = 1;
  if (!status)
    status = begin(scene, &taken, &made, err);
  if (!status)
    status = lib_check_trace(&made->variant, err);
  if (!status) {
    struct listener listener = {hear, context, made->variant.listed->counting};
    struct hsr_trace trace = {.listen = listen, .context = &listener};
    made->tally.trace = &trace;
    status = draw_once(made, &taken, err);
    made->tally.trace = NULL;
  }
  if (status)
    hsr_free(made);
  else
    *answer = made;
  return status;
}
