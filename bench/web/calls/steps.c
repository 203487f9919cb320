/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The steps of a run, as reports/lesson/data/trace.js reads them. */
#include "bench/lesson/lesson.h"
#include "bench/web/web.h"

/* Records the run of a variant. The scene is laid out for it anew. */
static enum hsr_status record(struct lib_scene *scene,
                              const struct web_request *request, double most,
                              struct hsr_variant *variant,
                              struct lesson_record *record_,
                              struct hsr_error *err) {
  const struct hsr_request *r = &request->request;
  const struct hsr_answer_type *type = variant->choice.form.type;
  const struct scene_options named = {.name = scene->scene->name};
  const struct view_options looked = {
      .view = r->camera ? 0 : (long)r->view + 1, .m = r->m, .n = r->n};
  struct trace_run run = {.command = "lesson",
                          .scene_options = &named,
                          .view_options = &looked,
                          .variant = variant,
                          .most_faces = LESSON_MOST_FACES,
                          .scene = scene->scene};
  enum hsr_status status = lib_check_trace(variant, err);
  if (!status)
    status = lib_view(scene, r, type, &run.view, err);
  if (!status)
    status = trace_run_begin(&run, err);
  if (!status)
    status = lesson_record(&run, (long)most, record_, err);
  trace_run_end(&run);
  return status;
}

/* {bytes, size, events, kept}: the most events that are kept are `most`. */
WEB_CALL enum hsr_status web_steps(struct lib_scene *scene, const char *text,
                                   double most) {
  struct hsr_error *err = web_begin();
  struct web_request request;
  struct hsr_variant variant;
  struct lesson_record steps = {.events = 0};
  enum hsr_status status = web_request_read(&request, text, err);
  if (!status && !request.request.algorithm)
    status = hsr_fail(err, HSR_E_USAGE, "a request names an algorithm");
  if (!status)
    status = hsr_variant_parse(request.request.algorithm, &variant, err);
  if (!status)
    status = record(scene, &request, most, &variant, &steps, err);
  web_request_free(&request);
  web_keep(steps.bytes.at);
  return web_end(status, status ? NULL
                                : json_pack("{so sI sI sI}", "bytes",
                                            web_address(steps.bytes.at), "size",
                                            (json_int_t)steps.bytes.n, "events",
                                            (json_int_t)steps.events, "kept",
                                            (json_int_t)steps.kept));
}
