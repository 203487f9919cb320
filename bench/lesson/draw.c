/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/lesson/lesson.h"
#include "bench/run/table1.h"

#include <stdlib.h>
#include <string.h>

/* Whether the events are as many as the counters say, and make the answer. */
static enum hsr_status check_events(struct lesson_recorder *recorder,
                                    const struct hsr_tally *tally,
                                    struct hsr_error *err) {
  const struct hsr_algorithm *a = recorder->run->setup.algorithm;
  char text[240];
  for (int k = 0; k < trace_n_counters(a); k++)
    if (recorder->count[k] != (a->counters[k].computed ? 0 : tally->count[k]))
      return hsr_fail(err, HSR_E_INTERNAL, "%s: %s: not as many events",
                      a->name, a->counters[k].name);
  enum hsr_status status =
      trace_answer_compare(&recorder->run->answer, text, sizeof text);
  if (status == HSR_E_NOMEM)
    return hsr_fail_nomem(err);
  return status ? hsr_fail(err, HSR_E_INTERNAL,
                           "%s: its events do not rebuild its answer: %s",
                           a->name, text)
                : HSR_OK;
}

static bool predicts(const struct hsr_algorithm *a) {
  bool any = false;
  for (const struct hsr_step *s = a->steps; s && s->label; s++)
    any = any || s->predict;
  return any;
}

/* The text of all that was recorded, to be freed. NULL: HSR_E_NOMEM. */
static char *pack(const struct lesson_recorder *recorder, json_t *description) {
  enum { FLAGS = JSON_COMPACT | JSON_ENSURE_ASCII | JSON_REAL_PRECISION(9) };
  char *json = description ? json_dumps(description, FLAGS) : NULL;
  json_decref(description);
  if (!json)
    return NULL;
  struct lesson_bytes all = {.at = NULL};
  size_t length = strlen(json);
  for (int k = 0; k < 4; k++)
    lesson_add(&all, &(unsigned char){(unsigned char)(length >> 8 * k)}, 1);
  lesson_add(&all, json, length);
  free(json);
  lesson_add(&all, recorder->counters.at, recorder->counters.n);
  all.failed = all.failed || recorder->counters.failed;
  int n = trace_n_counters(recorder->run->setup.algorithm);
  for (int c = 0; c < n; c++)
    for (int k = 0; k < LESSON_N_FIELDS; k++) {
      const struct lesson_bytes *field = &recorder->column[c].field[k];
      lesson_add(&all, field->at, field->n);
      all.failed = all.failed || field->failed;
    }
  char *text = lesson_squeeze(&all);
  lesson_bytes_free(&all);
  return text;
}

static enum hsr_status record(struct lesson_recorder *recorder, char **text,
                              struct hsr_error *err) {
  struct trace_run *run = recorder->run;
  struct hsr_trace trace = {.listen = lesson_listen, .context = recorder};
  struct hsr_tally tally = {.trace = &trace};
  struct hsr_table1 table;
  enum hsr_status status =
      trace_answer_draw(&run->answer, &run->setup, &tally, err);
  if (!status)
    status = check_events(recorder, &tally, err);
  bool has_table = predicts(run->setup.algorithm);
  if (!status && has_table)
    status = measure_table1(&run->laid_out, &run->view, &table, err);
  if (status)
    return status;
  *text = pack(recorder,
               lesson_describe(recorder, &tally, has_table ? &table : NULL));
  return *text ? HSR_OK : hsr_fail_nomem(err);
}

enum hsr_status lesson_draw(const struct lesson_subject *subject,
                            const struct lesson_limits *limits, char **text,
                            struct hsr_error *err) {
  struct trace_run run = {.command = "lesson",
                          .scene_options = subject->scene,
                          .view_options = subject->view,
                          .variant = subject->variant,
                          .most_faces = limits->faces};
  struct lesson_recorder *recorder = calloc(1, sizeof *recorder);
  if (!recorder)
    return hsr_fail_nomem(err);
  recorder->run = &run;
  recorder->most = (uint64_t)limits->events;
  recorder->parts = json_array();
  enum hsr_status status = trace_run_open(&run, err);
  recorder->has_list = !status && lesson_has_list(&run.setup);
  if (!status)
    status = record(recorder, text, err);
  if (!status && recorder->kept < recorder->events)
    fprintf(stderr,
            "hsr: %s: only the first %llu of %llu steps can be stepped "
            "through (--events)\n",
            run.variant->name, (unsigned long long)recorder->kept,
            (unsigned long long)recorder->events);
  lesson_recorder_free(recorder);
  free(recorder);
  trace_run_close(&run);
  return status;
}
