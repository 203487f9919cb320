/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers of the report: the records of hsr bench and their statistics. */
#include "bench/report/data.h"
#include "bench/results/descriptor.h"
#include "bench/results/json.h"
#include "bench/tables/greene.h"
#include "bench/tables/tables.h"

#include "common/answers/answer.h"
#include "common/files/json/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- Geometric means ------------------------------------------------------ */

/* The logarithms of an algorithm's ratios. */
struct ratios {
  const char *algorithm;
  size_t n, room;
  double *logs;
};

static bool add_log(struct ratios *r, double log) {
  if (r->n == r->room) {
    size_t room = 2 * r->room + 16;
    double *logs = realloc(r->logs, room * sizeof *logs);
    if (!logs)
      return false;
    r->logs = logs;
    r->room = room;
  }
  r->logs[r->n++] = log;
  return true;
}

/* The logarithms of every algorithm, on one thread. `number` knows algorithms'
 * numbers by their names. */
static bool collect(const struct report *report,
                    const struct cell_figures *figures, json_t *number,
                    struct ratios *ratios) {
  size_t k;
  const json_t *cell;
  json_array_foreach(report->results->cells, k, cell) {
    if (!figures[k].compared || results_number(cell, "threads") != 1)
      continue;
    const char *algorithm = results_text(cell, "algorithm");
    size_t own = (size_t)results_number(number, algorithm);
    if (!json_object_get(number, algorithm)) {
      own = json_object_size(number);
      ratios[own].algorithm = algorithm;
      json_object_set_new(number, algorithm, json_integer((json_int_t)own));
    }
    if (!add_log(&ratios[own], log(figures[k].ratio.value)))
      return false;
  }
  return true;
}

static json_t *mean_json(const struct ratios *r, const char *to) {
  struct figure ratio = figure_of_logs(r->logs, (int)r->n);
  return json_pack("{ss ss sI sf so so}", "algorithm", r->algorithm, "to", to,
                   "cells", (json_int_t)r->n, "ratio", ratio.value, "low",
                   number_or_null(ratio.low), "high",
                   number_or_null(ratio.high));
}

/* The mean of each algorithm's ratios, over the cells that both solved. */
static json_t *geometric_json(const struct report *report,
                              const struct cell_figures *figures) {
  size_t most = json_array_size(report->results->cells);
  struct ratios *ratios = calloc(most + 1, sizeof *ratios);
  json_t *number = json_object(), *means = json_array();
  bool good = ratios && collect(report, figures, number, ratios);
  for (size_t k = 0; ratios && k < json_object_size(number); k++) {
    hsr_json_append(&means,
                    good ? mean_json(&ratios[k], report->reference) : NULL);
    free(ratios[k].logs);
  }
  free(ratios);
  json_decref(number);
  return means;
}

/* --- Kinds of answers ----------------------------------------------------- */

static json_t *kinds_json(void) {
  json_t *kinds = json_array();
  for (const struct hsr_answer_type *const *kind = hsr_answer_types; *kind;
       kind++)
    hsr_json_append(&kinds,
                    json_pack("{ss ss ss}", "name", (*kind)->name, "meaning",
                              (*kind)->meaning, "places", (*kind)->places));
  return kinds;
}

/* --- All ------------------------------------------------------------------ */

/* Only Greene's tables if the results have none of the scenes of 1974. */
static json_t *all_tables(const struct report *report) {
  struct tables *tables;
  json_t *json =
      tables_new(&tables, report->results, &hsr_prices_standard, NULL)
          ? json_pack("{so}", "greene", greene_json(report->results))
          : tables_json(tables);
  tables_delete(tables);
  return json;
}

json_t *report_data(const struct report *report, struct hsr_error *err) {
  struct cell_figures *figures = cells_measure(report, err);
  if (!figures)
    return NULL;
  json_t *data = cells_json(report, figures);
  json_t *rest =
      json_pack("{ss sO sO so so ss so so so}", "schema", "hsr-report/2",
                "headers", report->results->headers, "views",
                report->results->views, "growth", ladders_json(report, figures),
                "geometric", geometric_json(report, figures), "baseline",
                report->reference, "tables", all_tables(report), "kinds",
                kinds_json(), "algorithms", algorithms_json());
  free(figures);
  if (data && rest && !json_object_update(data, rest)) {
    json_decref(rest);
    return data;
  }
  json_decref(rest);
  json_decref(data);
  hsr_fail_nomem(err);
  return NULL;
}
