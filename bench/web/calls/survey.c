/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the survey says of a scene: Table I, and Table III beside what was
 * counted. */
#include "bench/lesson/lesson.h"
#include "bench/run/table1.h"
#include "bench/web/web.h"
#include "common/files/json/json.h"

/* Measures the view of a request. */
static enum hsr_status measure(struct lib_scene *scene,
                               const struct web_request *request,
                               struct hsr_table1 *table,
                               struct hsr_error *err) {
  struct hsr_geometry laid_out = {.size = sizeof laid_out};
  struct hsr_view view;
  enum hsr_status status = hsr_get_geometry(scene, &laid_out, err);
  if (!status)
    status = lib_view(scene, &request->request, HSR_IDS, &view, err);
  return status ? status : measure_table1(&scene->laid_out, &view, table, err);
}

/* [[symbol, meaning, measured], ...] */
WEB_CALL enum hsr_status web_table1(struct lib_scene *scene, const char *text) {
  struct hsr_error *err = web_begin();
  struct web_request request;
  struct hsr_table1 table;
  enum hsr_status status = web_request_read(&request, text, err);
  if (!status)
    status = measure(scene, &request, &table, err);
  web_request_free(&request);
  return web_end(status, status ? NULL : lesson_letters_json(&table));
}

/* Adds what was counted to each step: the sum of its terms. */
static void add_measured(json_t *costs, const uint64_t *count) {
  size_t k, l;
  json_t *cost, *term;
  json_array_foreach(costs, k, cost) {
    double sum = 0;
    json_array_foreach(json_object_get(cost, "terms"), l, term) sum +=
        json_number_value(json_array_get(term, 1)) *
        (double)count[json_integer_value(json_array_get(term, 0))];
    json_object_set_new(cost, "measured", json_real(sum));
  }
}

/* [{label, terms, formula, predicted, measured}, ...] */
WEB_CALL enum hsr_status web_predicted(struct lib_scene *scene,
                                       const char *text) {
  struct hsr_error *err = web_begin();
  struct web_request request;
  struct hsr_table1 table;
  struct lib_answer *answer = NULL;
  const uint64_t *count;
  size_t n;
  json_t *costs = NULL;
  enum hsr_status status = web_request_read(&request, text, err);
  request.request.counts = 1;
  if (!status)
    status = hsr_draw(scene, &request.request, &answer, err);
  if (!status)
    status = hsr_get_counts(answer, &count, &n, err);
  const struct hsr_algorithm *a =
      status ? NULL : answer->variant.listed->counting;
  const bool predicts = a && lesson_predicts(a);
  if (!status && predicts)
    status = measure(scene, &request, &table, err);
  if (!status) {
    costs = lesson_costs_json(a, predicts ? &table : NULL);
    add_measured(costs, count);
  }
  hsr_free(answer);
  web_request_free(&request);
  return web_end(status, costs);
}
