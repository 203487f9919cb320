/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hsr check --json prints. */
#include "bench/check/check.h"
#include "bench/results/json.h"

/* Fields that are there only where there is something to tell. */
static json_t *told_json(const struct cell *c) {
  json_t *told = json_object();
  if (c->refusal[0])
    json_object_set_new(told, "refusal", json_string(c->refusal));
  if (c->verdict == WRONG)
    json_object_set_new(told, "first", json_string(c->first));
  if (c->counting_mismatches != c->mismatches)
    json_object_set_new(told, "counting_mismatches",
                        json_integer((json_int_t)c->counting_mismatches));
  if (c->why[0])
    json_object_set_new(told, "why", json_string(c->why));
  if (c->signal)
    json_object_set_new(told, "signal", json_integer(c->signal));
  return told;
}

json_t *cell_json(const struct scene_run *run, int size, int view, int a) {
  const struct check_options *o = run->options;
  const struct cell *c = cell_at(run, size, view, a);
  json_t *cell = json_pack(
      "{ss si si si ss ss ss sI sI sb so}", "scene", run->name, "view",
      o->view[view] + 1, "width", o->m[size], "height", o->n[size], "algorithm",
      o->algorithm[a].name, "kind", kind_of(o, a)->name, "status",
      verdict_name(c->verdict), "mismatches", (json_int_t)c->mismatches,
      "compared", (json_int_t)c->compared, "known_wrong", is_known_wrong(o, a),
      "adapted", adapted_json(c));
  json_t *told = told_json(c);
  if (!cell || json_object_update(cell, told)) {
    json_decref(cell);
    cell = NULL;
  }
  json_decref(told);
  return cell;
}

/* How much was compared, under the names of places. */
static json_t *compared_json(const struct totals *totals) {
  json_t *json = json_pack("{ss}", "schema", "hsr-check/1");
  for (int k = 0; json && hsr_answer_types[k]; k++)
    if (!json_object_get(json, hsr_answer_types[k]->places))
      json_object_set_new(json, hsr_answer_types[k]->places,
                          json_integer((json_int_t)totals->compared[k]));
  return json;
}

json_t *totals_json(const struct totals *totals) {
  json_t *all = compared_json(totals);
  json_t *rest =
      json_pack("{sI sI sI sO}", "mismatches", (json_int_t)totals->mismatches,
                "depths_compared", (json_int_t)totals->depths, "depths_exact",
                (json_int_t)totals->depths_exact, "cells", totals->cells);
  if (!all || !rest || json_object_update(all, rest)) {
    json_decref(all);
    all = NULL;
  }
  json_decref(rest);
  return all;
}
