/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Algorithms that are ready for a scene, and drawing again and again. */
#include "bench/library/library.h"
#include "bench/run/crew.h"

#include <stdlib.h>

/* --- What is ready -------------------------------------------------------- */

enum hsr_status lib_ready_new(const struct lib_scene *scene,
                              const struct hsr_request *request,
                              struct lib_ready **ready, struct hsr_error *err) {
  struct lib_ready *made = calloc(1, sizeof *made);
  if (!made)
    return hsr_fail_nomem(err);
  *made = (struct lib_ready){.users = 1,
                             .scene = lib_scene_share(scene),
                             .counts = request->counts || request->work,
                             .threads = request->threads};
  enum hsr_status status =
      hsr_variant_parse(request->algorithm, &made->variant, err);
  if (!status && request->work)
    status = lib_check_work(&made->variant, err);
  if (status)
    lib_ready_free(made);
  else
    *ready = made;
  return status;
}

enum hsr_status lib_ready_prepare(struct lib_ready *ready,
                                  struct hsr_error *err) {
  const struct hsr_variant *v = &ready->variant;
  const struct hsr_algorithm *build =
      ready->counts ? v->listed->counting : v->listed->plain;
  enum hsr_status status =
      lib_scene_world(ready->scene, build, &v->choice, &ready->world, err);
  if (status)
    return status;
  lib_scene_read(ready->scene);
  status = hsr_setup_init(&ready->setup, build, &v->choice, ready->world, err);
  lib_scene_leave(ready->scene);
  return status;
}

struct lib_ready *lib_ready_share(struct lib_ready *ready) {
  if (ready)
    ready->users++;
  return ready;
}

void lib_ready_free(struct lib_ready *ready) {
  if (!ready || --ready->users)
    return;
  if (ready->setup.algorithm)
    hsr_setup_free(&ready->setup);
  hsr_close(ready->scene);
  free(ready);
}

/* --- Drawers -------------------------------------------------------------- */

struct hsr_drawer {
  pthread_mutex_t turn; /* held by who draws */
  struct lib_ready *ready;
  struct crew *crew;
  int m, n; /* of the last picture */
};

void hsr_release(struct hsr_drawer *drawer) {
  if (!drawer)
    return;
  crew_free(drawer->crew);
  lib_ready_free(drawer->ready);
  pthread_mutex_destroy(&drawer->turn);
  free(drawer);
}

/* Makes a drawer of what is ready, which becomes the drawer's. */
static enum hsr_status make_drawer(struct lib_ready *ready,
                                   struct hsr_drawer **drawer,
                                   struct hsr_error *err) {
  struct hsr_drawer *made = calloc(1, sizeof *made);
  if (!made || pthread_mutex_init(&made->turn, NULL)) {
    free(made);
    lib_ready_free(ready);
    return hsr_fail_nomem(err);
  }
  made->ready = ready;
  made->crew = crew_new(ready->threads);
  if (!made->crew) {
    hsr_release(made);
    return hsr_fail_nomem(err);
  }
  *drawer = made;
  return HSR_OK;
}

enum hsr_status hsr_prepare(const struct lib_scene *scene,
                            const struct hsr_request *request,
                            struct hsr_drawer **drawer, struct hsr_error *err) {
  struct hsr_request taken;
  struct lib_ready *ready = NULL;
  if (!drawer)
    return lib_null("drawer", err);
  *drawer = NULL;
  enum hsr_status status = lib_take_request(scene, request, &taken, err);
  if (!status)
    status = lib_ready_new(scene, &taken, &ready, err);
  if (!status)
    status = lib_ready_prepare(ready, err);
  if (status) {
    lib_ready_free(ready);
    return status;
  }
  return make_drawer(ready, drawer, err);
}

/* --- Drawing again -------------------------------------------------------- */

/* What an algorithm keeps from picture to picture is of pictures of one size. */
static enum hsr_status fit_size(struct hsr_drawer *drawer, int m, int n,
                                struct hsr_error *err) {
  struct lib_ready *ready = NULL;
  const struct lib_ready *last = drawer->ready;
  bool keeps = last->setup.flags & HSR_FRAME_STATE && drawer->m;
  if (keeps && (drawer->m != m || drawer->n != n)) {
    const struct hsr_request request = {.algorithm = last->variant.name,
                                        .threads = (int)last->threads,
                                        .counts = last->counts};
    enum hsr_status status = lib_ready_new(last->scene, &request, &ready, err);
    if (!status)
      status = lib_ready_prepare(ready, err);
    if (status) {
      lib_ready_free(ready);
      return status;
    }
    lib_ready_free(drawer->ready);
    drawer->ready = ready;
  }
  drawer->m = m;
  drawer->n = n;
  return HSR_OK;
}

/* Makes a new answer and draws it. */
static enum hsr_status draw_new(struct hsr_drawer *drawer,
                                const struct hsr_request *request,
                                struct lib_answer **answer,
                                struct hsr_error *err) {
  struct lib_answer *made = NULL;
  enum hsr_status status = fit_size(drawer, request->m, request->n, err);
  if (!status)
    status = lib_answer_begin(drawer->ready, request, &made, err);
  if (!status)
    status = lib_answer_draw(made, drawer->crew, request, err);
  if (status)
    hsr_free(made);
  else
    *answer = made;
  return status;
}

/* Draws over an answer. If that fails, it is freed. */
static enum hsr_status draw_over(struct hsr_drawer *drawer,
                                 const struct hsr_request *request,
                                 struct lib_answer **over,
                                 struct hsr_error *err) {
  struct lib_answer *answer = *over;
  if (answer->ready != drawer->ready)
    return hsr_fail(err, HSR_E_USAGE,
                    "the answer is of another drawer, or of an earlier size");
  if (request->m != answer->view.m || request->n != answer->view.n)
    return hsr_fail(err, HSR_E_USAGE,
                    "the answer is of %d x %d samples, not %d x %d",
                    answer->view.m, answer->view.n, request->m, request->n);
  enum hsr_status status = fit_size(drawer, request->m, request->n, err);
  if (!status)
    status = lib_answer_aim(answer, request, err);
  if (status)
    return status;
  status = lib_answer_draw(answer, drawer->crew, request, err);
  if (status) {
    hsr_free(answer);
    *over = NULL;
  }
  return status;
}

enum hsr_status hsr_redraw(struct hsr_drawer *drawer,
                           const struct hsr_request *request,
                           struct lib_answer **answer, struct hsr_error *err) {
  struct hsr_request taken;
  if (!drawer || !request || !answer)
    return lib_null(!drawer ? "drawer" : !request ? "request" : "answer", err);
  enum hsr_status status =
      lib_take("request", &taken, sizeof taken, request, err);
  if (status)
    return status;
  pthread_mutex_lock(&drawer->turn);
  status = *answer ? draw_over(drawer, &taken, answer, err)
                   : draw_new(drawer, &taken, answer, err);
  pthread_mutex_unlock(&drawer->turn);
  return status;
}
