/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is left after each cull and sort, for the survey's ten algorithms beside
 * one another on one scene. They run without a listener. */
#include "bench/lesson/lesson.h"
#include "bench/run/table1.h"
#include "common/files/json/json.h"

const char *const lesson_ten[LESSON_TEN] = {
    "roberts", "appel",   "loutrel", "galimberti", "schumacker",
    "newell",  "warnock", "romney",  "bouknight",  "watkins"};
enum { SIDE = 128 };
#define SCENE "house"

/* Draws once, and adds what was counted to the lists. */
static enum hsr_status count(struct trace_run *run, json_t **algorithms,
                             json_t **letters, struct hsr_error *err) {
  const struct hsr_algorithm *a = run->setup.algorithm;
  struct hsr_tally tally = {.trace = NULL};
  struct hsr_table1 table;
  enum hsr_status status =
      trace_answer_draw(&run->answer, &run->setup, &tally, err);
  if (!status)
    status = measure_table1(&run->laid_out, &run->view, &table, err);
  if (status)
    return status;
  hsr_json_append(algorithms,
                  json_pack("{ss ss so so}", "name", a->name, "title", a->title,
                            "costs", lesson_costs_json(a, &table), "counts",
                            lesson_counts_json(a, tally.count)));
  if (!*letters)
    *letters = lesson_letters_json(&table);
  return HSR_OK;
}

static enum hsr_status add(const char *name, json_t **algorithms,
                           json_t **letters, struct hsr_error *err) {
  const struct hsr_listed *listed = hsr_algorithm_find(name);
  if (!listed)
    return HSR_OK;
  struct scene_options scene = {.name = SCENE};
  struct view_options view = VIEW_OPTIONS_STANDARD;
  view.m = view.n = SIDE;
  struct hsr_variant variant = hsr_variant_standard(listed);
  struct trace_run run = {.command = "lesson",
                          .scene_options = &scene,
                          .view_options = &view,
                          .variant = &variant,
                          .most_faces = LESSON_MOST_FACES};
  enum hsr_status status = trace_run_open(&run, err);
  if (!status)
    status = count(&run, algorithms, letters, err);
  trace_run_close(&run);
  return status;
}

enum hsr_status lesson_survivors(json_t **survivors, struct hsr_error *err) {
  json_t *algorithms = json_array(), *letters = NULL;
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < LESSON_TEN && !status; k++)
    status = add(lesson_ten[k], &algorithms, &letters, err);
  if (status) {
    json_decref(algorithms);
    json_decref(letters);
    return status;
  }
  *survivors = json_pack("{ss so so}", "scene", SCENE, "letters", letters,
                         "algorithms", algorithms);
  return *survivors ? HSR_OK : hsr_fail_nomem(err);
}
