/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr worker: an algorithm that draws frames for hsr bench (bench/run/serve.h).
 */
#include "bench/modules/variant.h"
#include "bench/options/command.h"
#include "bench/run/crew.h"
#include "bench/run/serve.h"

#include <stdlib.h>

/* What one round needs. */
struct round {
  const struct hsr_setup *setup;
  const struct hsr_view *view; /* the walk's, n of them */
  int n;
  struct crew *crew;
  struct hsr_answer answer;
};

static enum hsr_status draw_round(void *state, struct hsr_error *err) {
  struct round *round = state;
  struct hsr_tally tally = {.work = NULL};
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < round->n && !status; k++)
    status = crew_render(round->crew, round->setup, &round->view[k],
                         &round->answer, &tally, err);
  return status;
}

static enum hsr_status serve_walk(const struct serve_request *request,
                                  const struct stage *stage,
                                  const struct hsr_setup *setup,
                                  const struct hsr_view *view, long before,
                                  struct hsr_error *err) {
  const struct hsr_algorithm *algorithm = setup->algorithm;
  struct round round = {.setup = setup,
                        .view = view,
                        .n = request->walk,
                        .crew = crew_new(request->threads)};
  enum hsr_status status =
      round.crew ? answer_init(&round.answer, setup, &stage->view, err)
                 : hsr_fail_nomem(err);
  struct served served = {
      .request = request,
      .stage = stage,
      .adapt_seconds = setup->adapt_seconds,
      .prepare_seconds = setup->prepare_seconds,
      .before_kb = before,
      .round = draw_round,
      .state = &round,
      .answer = algorithm->flags & HSR_NO_PICTURE ? NULL : &round.answer};
  if (!status)
    status = serve(&served, err);
  hsr_answer_free(&round.answer);
  crew_free(round.crew);
  return status;
}

static enum hsr_status serve_setup(const struct serve_request *request,
                                   const struct stage *stage,
                                   const struct hsr_setup *setup, long before,
                                   struct hsr_error *err) {
  struct hsr_view *view = calloc((size_t)request->walk, sizeof *view);
  enum hsr_status status =
      view ? stage_walk(stage, request->view, request->walk, view, err)
           : hsr_fail_nomem(err);
  if (!status)
    status = serve_walk(request, stage, setup, view, before, err);
  free(view);
  return status;
}

/* The stage's own view is the last of the walk: after a round, the answer is
 * the picture of that view. */
enum hsr_status command_worker(int argc, char **argv, struct hsr_error *err) {
  struct serve_request request;
  struct hsr_variant variant;
  enum hsr_status status = serve_parse(argc, argv, &request, err);
  if (!status)
    status = hsr_variant_parse(request.name, &variant, err);
  if (status)
    return status;
  struct stage stage;
  uint32_t most = hsr_most_laid_out(variant.listed->plain, &variant.choice);
  status =
      stage_open(&stage, request.scene, most, request.view + request.walk - 1,
                 request.m, request.n, request.threads, err);
  if (!status) {
    long before = memory_kb();
    struct hsr_setup setup;
    status = hsr_setup_init(&setup, variant.listed->plain, &variant.choice,
                            &stage.world, err);
    if (!status)
      status = serve_setup(&request, &stage, &setup, before, err);
    hsr_setup_free(&setup);
  }
  stage_close(&stage);
  return status;
}
