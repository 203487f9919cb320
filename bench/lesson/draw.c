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

bool lesson_predicts(const struct hsr_algorithm *a) {
  bool any = false;
  for (const struct hsr_step *s = a->steps; s && s->label; s++)
    any = any || s->predict;
  return any;
}

/* Adds all that was recorded to *bytes. HSR_E_NOMEM. */
static enum hsr_status pack(const struct lesson_recorder *recorder,
                            json_t *description, struct lesson_bytes *bytes) {
  enum { FLAGS = JSON_COMPACT | JSON_ENSURE_ASCII | JSON_REAL_PRECISION(9) };
  char *json = description ? json_dumps(description, FLAGS) : NULL;
  json_decref(description);
  if (!json)
    return HSR_E_NOMEM;
  size_t length = strlen(json);
  for (int k = 0; k < 4; k++)
    lesson_add(bytes, &(unsigned char){(unsigned char)(length >> 8 * k)}, 1);
  lesson_add(bytes, json, length);
  free(json);
  lesson_add(bytes, recorder->counters.at, recorder->counters.n);
  bytes->failed = bytes->failed || recorder->counters.failed;
  int n = trace_n_counters(recorder->run->setup.algorithm);
  for (int c = 0; c < n; c++)
    for (int k = 0; k < LESSON_N_FIELDS; k++) {
      const struct lesson_bytes *field = &recorder->column[c].field[k];
      lesson_add(bytes, field->at, field->n);
      bytes->failed = bytes->failed || field->failed;
    }
  return bytes->failed ? HSR_E_NOMEM : HSR_OK;
}

static enum hsr_status draw(struct lesson_recorder *recorder,
                            struct lesson_bytes *bytes, struct hsr_error *err) {
  struct trace_run *run = recorder->run;
  struct hsr_trace trace = {.listen = lesson_listen, .context = recorder};
  struct hsr_tally tally = {.trace = &trace};
  struct hsr_table1 table;
  enum hsr_status status =
      trace_answer_draw(&run->answer, &run->setup, &tally, err);
  if (!status)
    status = check_events(recorder, &tally, err);
  bool has_table = lesson_predicts(run->setup.algorithm);
  if (!status && has_table)
    status = measure_table1(&run->laid_out, &run->view, &table, err);
  if (status)
    return status;
  json_t *description =
      lesson_describe(recorder, &tally, has_table ? &table : NULL);
  return pack(recorder, description, bytes) ? hsr_fail_nomem(err) : HSR_OK;
}

enum hsr_status lesson_record(struct trace_run *run, long most,
                              struct lesson_record *record,
                              struct hsr_error *err) {
  struct lesson_recorder *recorder = calloc(1, sizeof *recorder);
  if (!recorder)
    return hsr_fail_nomem(err);
  recorder->run = run;
  recorder->most = (uint64_t)most;
  recorder->parts = json_array();
  recorder->shapes = json_array();
  recorder->places = json_object();
  recorder->has_list = lesson_has_list(&run->setup);
  enum hsr_status status = draw(recorder, &record->bytes, err);
  record->events = recorder->events;
  record->kept = recorder->kept;
  lesson_recorder_free(recorder);
  free(recorder);
  return status;
}

/* Records a run that is open, and says on stderr what was left out. */
static enum hsr_status record_text(struct trace_run *run, long most,
                                   char **text, struct hsr_error *err) {
  struct lesson_record record = {.events = 0};
  enum hsr_status status = lesson_record(run, most, &record, err);
  if (!status) {
    *text = lesson_squeeze(&record.bytes);
    status = *text ? HSR_OK : hsr_fail_nomem(err);
  }
  lesson_bytes_free(&record.bytes);
  if (!status && record.kept < record.events)
    fprintf(stderr,
            "hsr: %s: only the first %llu of %llu steps can be stepped "
            "through (--events)\n",
            run->variant->name, (unsigned long long)record.kept,
            (unsigned long long)record.events);
  return status;
}

enum hsr_status lesson_draw(const struct lesson_subject *subject,
                            const struct lesson_limits *limits, char **text,
                            struct hsr_error *err) {
  struct trace_run run = {.command = "lesson",
                          .scene_options = subject->scene,
                          .view_options = subject->view,
                          .variant = subject->variant,
                          .most_faces = limits->faces};
  enum hsr_status status = trace_run_open(&run, err);
  if (!status)
    status = record_text(&run, limits->events, text, err);
  trace_run_close(&run);
  return status;
}
