/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pictures of a scene as somebody may have seen it. What hsr.h can draw are
 * cameras; here samples lie at other places too, so the views are the core's
 * own. */
#include "bench/judge/judge.h"
#include "bench/judge/wanted.h"
#include "bench/run/crew.h"
#include "bench/stranger/parts.h"
#include "common/answers/kinds/ids.h"

#include <stdlib.h>
#include <string.h>

static const char QUICK[] = "zbuffer-fast";

enum hsr_status studio_open(struct studio *studio,
                            const struct stranger_question *question,
                            struct hsr_error *err) {
  struct lib_scene *scene = question->scene;
  struct hsr_variant quick;
  const struct hsr_algorithm *oracle = oracle_of(&hsr_answer_ids);
  *studio = (struct studio){
      .question = question, .scene = scene, .own = question->own};
  enum hsr_status status = hsr_variant_parse(QUICK, &quick, err);
  if (!status)
    status = lib_scene_world(scene, oracle, NULL, &studio->of_oracle, err);
  if (!status)
    status = lib_scene_world(scene, quick.listed->plain, &quick.choice,
                             &studio->world, err);
  if (status)
    return status;
  lib_scene_read(scene);
  studio->is_ready = true;
  if (hsr_is_roster(studio->world))
    return hsr_fail(err, HSR_E_REFUSED,
                    "the scene has too many faces to be laid out");
  return hsr_setup_init(&studio->fast, quick.listed->plain, &quick.choice,
                        studio->world, err);
}

void studio_close(struct studio *studio) {
  if (studio->fast.algorithm)
    hsr_setup_free(&studio->fast);
  if (studio->is_ready)
    lib_scene_leave(studio->scene);
}

/* Takes the ids out of an answer. */
static enum hsr_status copy_ids(const struct hsr_answer *answer, uint32_t **ids,
                                struct hsr_error *err) {
  size_t n = (size_t)answer->m * (size_t)answer->n;
  *ids = malloc(n * sizeof **ids);
  if (!*ids)
    return hsr_fail_nomem(err);
  memcpy(*ids, hsr_answer_ids_of(answer), n * sizeof **ids);
  return HSR_OK;
}

enum hsr_status studio_draw(const struct studio *studio,
                            const struct hsr_view *view, uint32_t **ids,
                            struct hsr_error *err) {
  struct hsr_answer answer = {.body = NULL};
  struct hsr_tally tally = {.out_of_memory = false};
  *ids = NULL;
  enum hsr_status status = answer_init(&answer, &studio->fast, view, err);
  if (!status)
    status = render_view(&studio->fast, view, 1, &answer, &tally, NULL, err);
  if (!status)
    status = copy_ids(&answer, ids, err);
  hsr_answer_free(&answer);
  return status;
}

enum hsr_status studio_draw_right(const struct studio *studio,
                                  const struct hsr_view *view, uint32_t **ids,
                                  struct hsr_error *err) {
  const int number = 0;
  struct group group = {.world = studio->of_oracle,
                        .form = hsr_form_standard(&hsr_answer_ids),
                        .view = view,
                        .number = &number,
                        .n_views = 1};
  struct wanted *wanted = calloc(1, sizeof *wanted);
  *ids = NULL;
  if (!wanted)
    return hsr_fail_nomem(err);
  enum hsr_status status =
      ask_oracle(&group, oracle_of(&hsr_answer_ids), wanted, err);
  if (!status)
    status = copy_ids(&wanted->answer, ids, err);
  free_wanted(&group, wanted);
  return status;
}

/* Corner k of each pixel: columns from x on and rows from y on of `ids`, which
 * has m columns. */
static enum hsr_status draw_corner(const struct studio *studio,
                                   const struct hsr_view *view, int k,
                                   bool right, int m, uint32_t *ids,
                                   struct hsr_error *err) {
  struct hsr_view corner = *view;
  const int x = k % 2, y = k / 2;
  uint32_t *some;
  corner.offset_x = x - .5;
  corner.offset_y = y - .5;
  enum hsr_status status = right
                               ? studio_draw_right(studio, &corner, &some, err)
                               : studio_draw(studio, &corner, &some, err);
  for (int j = 0; j < view->n && !status; j++)
    memcpy(ids + (size_t)(j + y) * (size_t)m + x,
           some + (size_t)j * (size_t)view->m, (size_t)view->m * sizeof *ids);
  free(some);
  return status;
}

enum hsr_status studio_draw_corners(const struct studio *studio,
                                    const struct hsr_view *view, bool right,
                                    uint32_t **ids, struct hsr_error *err) {
  const size_t all = (size_t)view->m * (size_t)view->n;
  bool out_of_memory = false;
  struct hsr_view less;
  enum hsr_status status =
      hsr_view_init(&less, &view->camera, view->m - 1, view->n - 1, err);
  *ids = NULL;
  if (status)
    return status;
  memcpy(less.R, view->R, sizeof less.R);
  memcpy(less.U, view->U, sizeof less.U);
  less.near = view->near;
  *ids = malloc(all * sizeof **ids);
  if (!*ids || !hsr_exact_view_matrices(&less, &out_of_memory))
    status = hsr_fail_nomem(err);
  for (int k = 0; k < 4 && !status; k++)
    status = draw_corner(studio, &less, k, right, view->m, *ids, err);
  if (status) {
    free(*ids);
    *ids = NULL;
  }
  return status;
}
