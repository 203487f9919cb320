/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr worker: an algorithm that draws frames for hsr bench (bench/serve.h). */
#include "bench/command.h"
#include "bench/serve.h"

/* What one frame takes. */
struct frame {
  const struct hsr_setup *setup;
  const struct hsr_view *view;
  struct crew *crew;
  struct answer answer;
};

static enum hsr_status draw_frame(void *state, struct hsr_error *err) {
  struct frame *frame = state;
  struct hsr_tally tally = {.work = NULL};
  return crew_render(frame->crew, frame->setup, frame->view, &frame->answer,
                     &tally, err);
}

static enum hsr_status serve_setup(const struct serve_request *request,
                                   const struct stage *stage,
                                   const struct hsr_setup *setup, long before,
                                   struct hsr_error *err) {
  const struct hsr_algorithm *algorithm = setup->algorithm;
  struct frame frame = {
      .setup = setup, .view = &stage->view, .crew = crew_new(request->threads)};
  enum hsr_status status =
      frame.crew ? answer_init(&frame.answer, algorithm, &stage->view, err)
                 : hsr_fail_nomem(err);
  struct served served = {
      .request = request,
      .stage = stage,
      .adapt_seconds = setup->adapt_seconds,
      .prepare_seconds = setup->prepare_seconds,
      .before_kb = before,
      .frame = draw_frame,
      .state = &frame,
      .ids = algorithm->flags & HSR_NO_PICTURE ? NULL : frame.answer.ids};
  if (!status)
    status = serve(&served, err);
  answer_free(&frame.answer);
  crew_free(frame.crew);
  return status;
}

enum hsr_status command_worker(int argc, char **argv, struct hsr_error *err) {
  struct serve_request request;
  struct hsr_variant variant;
  enum hsr_status status = serve_parse(argc, argv, &request, err);
  if (!status)
    status = hsr_variant_parse(request.name, &variant, err);
  if (status)
    return status;
  struct stage stage;
  bool lay_out = !(variant.listed->plain->flags & HSR_INSTANCED);
  status = stage_open(&stage, request.scene, lay_out, request.view, request.m,
                      request.n, err);
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
