/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/lesson/lesson.h"
#include "bench/results/json.h"
#include "common/files/json/json.h"

#include <math.h>

json_t *lesson_counts_json(const struct hsr_algorithm *a,
                           const uint64_t *count) {
  json_t *counts = json_array();
  for (int k = 0; k < trace_n_counters(a); k++)
    hsr_json_append(&counts, json_integer((json_int_t)count[k]));
  return counts;
}

/* [counter, price], for each term of the step's cost. The price is less than 0
 * where the cost is taken off. */
static json_t *terms_json(const struct hsr_step *step) {
  json_t *terms = json_array();
  struct hsr_term term;
  for (int k = 0; hsr_step_term(step, k, &term); k++)
    hsr_json_append(&terms,
                    json_pack("[if]", term.counter,
                              hsr_term_price(&term, &hsr_prices_standard)));
  return terms;
}

json_t *lesson_costs_json(const struct hsr_algorithm *a,
                          const struct hsr_table1 *table) {
  json_t *costs = json_array();
  for (const struct hsr_step *s = a->steps; s && s->label; s++)
    hsr_json_append(
        &costs, json_pack("{ss so ss? so}", "label", s->label, "terms",
                          terms_json(s), "formula", s->formula, "predicted",
                          number_or_null(s->predict && table ? s->predict(table)
                                                             : NAN)));
  return costs;
}

json_t *lesson_letters_json(const struct hsr_table1 *table) {
  json_t *letters = json_array();
#define X(field, symbol, meaning)                                              \
  hsr_json_append(&letters,                                                    \
                  json_pack("[sso]", symbol, meaning,                          \
                            number_or_null(table ? table->field : NAN)));
  HSR_TABLE1(X)
#undef X
  return letters;
}

/* Where the vertices of the header are in the world. */
static json_t *points_json(const struct trace_run *run) {
  const struct hsr_world *world =
      hsr_is_roster(run->setup.world) ? &run->laid_out : run->setup.world;
  const struct hsr_mesh *mesh = &world->mesh;
  json_t *points = json_array();
  for (uint32_t v = 0; v < mesh->n_vertices; v++)
    hsr_json_append(&points,
                    json_pack("[fff]", mesh->x[v], mesh->y[v], mesh->z[v]));
  return points;
}

/* Whether the algorithm, as chosen, is known to be wrong sometimes. */
static bool is_known_wrong(const struct trace_run *run) {
  return hsr_choice_flags(run->setup.algorithm, &run->setup.choice) &
         HSR_KNOWN_WRONG;
}

json_t *lesson_describe(const struct lesson_recorder *recorder,
                        const struct hsr_tally *tally,
                        const struct hsr_table1 *table) {
  const struct hsr_algorithm *a = recorder->run->setup.algorithm;
  const struct trace_answer *answer = &recorder->run->answer;
  static const struct trace_filter all = {.every = 1, .keyframe = 1};
  struct trace_header header = {.run = recorder->run, .filter = &all};
  json_t *parts = recorder->parts;
  return json_pack(
      "{ss so sI sI so sO sO so so so ss? ss? so so so sb}", "schema",
      "hsr-lesson/2", "header", trace_header_json(&header), "events",
      (json_int_t)recorder->events, "kept", (json_int_t)recorder->kept,
      "counts", lesson_counts_json(a, tally->count), "parts", parts, "shapes",
      recorder->shapes, "answer",
      answer->drawn.form.type->json(&answer->drawn, answer->view), "costs",
      lesson_costs_json(a, table), "letters", lesson_letters_json(table),
      "order", a->sort_order, "coherence", a->coherence, "lists",
      lesson_lists_json(recorder->run, &recorder->notes), "structure",
      lesson_structure_json(recorder->run), "points",
      points_json(recorder->run), "knownWrong", is_known_wrong(recorder->run));
}
