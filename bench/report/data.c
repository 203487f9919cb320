/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers of the report: the records of hsr bench and their statistics. */
#include "bench/tables/growth.h"
#include "bench/results/json.h"
#include "bench/list.h"
#include "bench/report/report.h"
#include "bench/tables/greene.h"
#include "bench/tables/tables.h"
#include "bench/results/times.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_POINTS = 64, LEAST_POINTS = 3 };

/* --- Cells ---------------------------------------------------------------- */

static json_t *seconds_json(const struct times *times) {
  struct figure median;
  if (!times->samples.starts)
    return json_null();
  if (!figure_median(&times->samples, &median))
    return NULL;
  json_t *all = json_array();
  for (int k = 0; k < times->samples.starts * times->samples.each; k++)
    hsr_json_append(&all, json_real(times->seconds[k]));
  return json_pack("{sf so so sf si so}", "median", median.value, "low",
                   number_or_null(median.low), "high",
                   number_or_null(median.high), "min",
                   figure_least(&times->samples), "starts",
                   times->samples.starts, "samples", all);
}

static json_t *ratio_json(const struct figure *ratio, const char *to) {
  return json_pack("{ss sf so so sb}", "to", to, "value", ratio->value, "low",
                   number_or_null(ratio->low), "high",
                   number_or_null(ratio->high), "distinguishable",
                   figure_distinguishable(ratio));
}

/* The mean of a phase over the starts that have it. */
static json_t *phase_json(const json_t *starts, const char *group,
                          const char *name) {
  double sum = 0;
  int n = 0;
  size_t k;
  const json_t *start;
  json_array_foreach(starts, k, start) {
    const json_t *value = json_object_get(json_object_get(start, group), name);
    if (json_is_number(value)) {
      sum += json_number_value(value);
      n++;
    }
  }
  return n ? json_real(sum / n) : json_null();
}

static void set_phases(json_t *out, const json_t *starts) {
  static const char *const phase[] = {"import", "adapt", "prepare", "shade",
                                      "write"};
  json_t *phases = json_object();
  for (size_t k = 0; k < sizeof phase / sizeof *phase; k++)
    json_object_set_new(phases, phase[k],
                        phase_json(starts, "phases", phase[k]));
  json_object_set_new(out, "phases", phases);
  json_object_set_new(
      out, "memory_kb",
      json_pack("{so so}", "before", phase_json(starts, "memory_kb", "before"),
                "peak", phase_json(starts, "memory_kb", "peak")));
  json_object_set(out, "inner",
                  json_object_get(json_array_get(starts, 0), "inner"));
}

/* Copies the record, with the statistics of its starts in place of the starts.
 */
static enum hsr_status summarize(const struct report *report,
                                 const json_t *cell, json_t *out,
                                 struct hsr_error *err) {
  struct times times;
  double logs[FIGURES_MOST_STARTS];
  int n = 0;
  enum hsr_status status = times_read(cell, &times, err);
  if (!status)
    status =
        times_ratios(report->results, cell, report->reference, logs, &n, err);
  json_t *seconds = status ? NULL : seconds_json(&times);
  if (!status && !seconds)
    status = hsr_fail_nomem(err);
  times_free(&times);
  if (status)
    return status;
  json_object_set_new(out, "seconds", seconds);
  struct figure ratio = {.value = 1};
  if (n)
    ratio = figure_of_logs(logs, n);
  json_object_set_new(out, "ratio",
                      n ? ratio_json(&ratio, report->reference) : json_null());
  const json_t *starts = json_object_get(cell, "starts");
  if (json_array_size(starts)) {
    set_phases(out, starts);
  } else {
    json_object_set_new(out, "phases", json_null());
    json_object_set_new(out, "memory_kb", json_null());
  }
  json_object_del(out, "starts");
  return HSR_OK;
}

static enum hsr_status add_cells(const struct report *report, json_t *cells,
                                 struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  size_t k;
  json_t *cell;
  json_array_foreach(report->results->cells, k, cell) {
    json_t *out = json_copy(cell);
    status = out ? summarize(report, cell, out, err) : hsr_fail_nomem(err);
    if (!status && json_array_append(cells, out))
      status = hsr_fail_nomem(err);
    json_decref(out);
    if (status)
      break;
  }
  return status;
}

/* --- Growth --------------------------------------------------------------- */

/* Cells of one algorithm that differ in one thing only. */
struct ladder {
  const char *algorithm, *over;
  int n;
  const json_t *cell[MOST_POINTS]; /* with "seconds" */
  double x[MOST_POINTS], y[MOST_POINTS];
};

/* The name of a scene without its parameters: "harbor" of "harbor:500". */
static bool same_family(const char *a, const char *b) {
  size_t n = strcspn(a, ":");
  return n == strcspn(b, ":") && !strncmp(a, b, n) && strcmp(a, "mesh") &&
         strncmp(a, "mesh:", 5);
}

static double table1_of(const struct report *report, const json_t *cell,
                        const char *symbol) {
  char key[RESULTS_KEY];
  results_picture_key(results_text(cell, "scene"), results_number(cell, "view"),
                      results_number(cell, "walk"),
                      results_number(cell, "width"),
                      results_number(cell, "height"), key);
  const json_t *view = results_view(report->results, key);
  const json_t *x = json_object_get(json_object_get(view, "table1"), symbol);
  return json_is_number(x) ? json_number_value(x) : NAN;
}

static double samples_of(const json_t *cell) {
  return (double)results_number(cell, "width") *
         (double)results_number(cell, "height");
}

static bool equal(const json_t *a, const json_t *b, const char *field) {
  return json_equal(json_object_get(a, field), json_object_get(b, field));
}

/* Whether b is on the ladder that a begins. Then it is the same picture in
 * another size, or another scene of the same family. */
static bool is_rung(const json_t *a, const json_t *b, bool of_sizes) {
  if (!equal(a, b, "algorithm") || !equal(a, b, "threads") ||
      !equal(a, b, "view") ||
      results_number(a, "walk") != results_number(b, "walk") ||
      !json_is_object(json_object_get(b, "seconds")))
    return false;
  if (of_sizes)
    return equal(a, b, "scene") && samples_of(a) > 0;
  return equal(a, b, "width") && equal(a, b, "height") &&
         same_family(results_text(a, "scene"), results_text(b, "scene"));
}

static double median_of(const json_t *cell) {
  return json_number_value(
      json_object_get(json_object_get(cell, "seconds"), "median"));
}

static double spread(const double *x, int n) {
  double low = INFINITY, high = -INFINITY;
  for (int k = 0; k < n; k++) {
    low = fmin(low, x[k]);
    high = fmax(high, x[k]);
  }
  return high / low;
}

/* Scenes of a family grow in faces, in depth complexity, or in both. The ladder
 * is over the one that grows most. */
static void measure_rungs(const struct report *report, struct ladder *ladder,
                          bool of_sizes) {
  double faces[MOST_POINTS], depth[MOST_POINTS];
  for (int k = 0; k < ladder->n; k++) {
    ladder->y[k] = median_of(ladder->cell[k]);
    ladder->x[k] = samples_of(ladder->cell[k]);
    faces[k] = table1_of(report, ladder->cell[k], "F_r");
    depth[k] = table1_of(report, ladder->cell[k], "D_c");
  }
  ladder->over = "samples";
  if (of_sizes)
    return;
  bool deeper = spread(depth, ladder->n) >= spread(faces, ladder->n);
  ladder->over = deeper ? "depth" : "faces";
  memcpy(ladder->x, deeper ? depth : faces,
         (size_t)ladder->n * sizeof *ladder->x);
}

static json_t *points_json(const struct ladder *ladder) {
  json_t *points = json_array();
  for (int k = 0; k < ladder->n; k++) {
    const json_t *cell = ladder->cell[k];
    hsr_json_append(&points,
                    json_pack("{ss si si si sf sf}", "scene",
                              results_text(cell, "scene"), "view",
                              (int)results_number(cell, "view"), "width",
                              (int)results_number(cell, "width"), "height",
                              (int)results_number(cell, "height"), "x",
                              ladder->x[k], "seconds", ladder->y[k]));
  }
  return points;
}

/* A name for what all its rungs share: "house", or "harbor:N, 500x500". */
static void name_ladder(const struct ladder *ladder, char *name, size_t size) {
  const json_t *cell = ladder->cell[0];
  const char *scene = results_text(cell, "scene");
  if (!strcmp(ladder->over, "samples"))
    snprintf(name, size, "%.200s", scene);
  else
    snprintf(name, size, "%.*s:N, %ldx%ld", (int)strcspn(scene, ":"), scene,
             results_number(cell, "width"), results_number(cell, "height"));
}

static json_t *ladder_json(const struct ladder *ladder) {
  char name[300];
  name_ladder(ladder, name, sizeof name);
  struct growth growth = growth_fit(ladder->x, ladder->y, ladder->n);
  if (isnan(growth.exponent))
    return NULL;
  return json_pack("{ss ss si ss so so so so}", "algorithm", ladder->algorithm,
                   "of", name, "threads",
                   (int)results_number(ladder->cell[0], "threads"), "over",
                   ladder->over, "exponent", number_or_null(growth.exponent),
                   "low", number_or_null(growth.low), "high",
                   number_or_null(growth.high), "points", points_json(ladder));
}

/* Makes the ladder that cell k begins; none if an earlier cell is on it. */
static bool climb(const json_t *cells, size_t k, bool of_sizes,
                  struct ladder *ladder) {
  const json_t *first = json_array_get(cells, k);
  *ladder = (struct ladder){.algorithm = results_text(first, "algorithm")};
  size_t i;
  const json_t *cell;
  if (!is_rung(first, first, of_sizes))
    return false;
  json_array_foreach(cells, i, cell) {
    if (!is_rung(first, cell, of_sizes))
      continue;
    if (i < k)
      return false;
    if (ladder->n < MOST_POINTS)
      ladder->cell[ladder->n++] = cell;
  }
  return ladder->n >= LEAST_POINTS;
}

static json_t *growth_json(const struct report *report, const json_t *cells) {
  json_t *all = json_array();
  for (int of_sizes = 0; of_sizes < 2; of_sizes++)
    for (size_t k = 0; k < json_array_size(cells); k++) {
      struct ladder ladder;
      if (!climb(cells, k, of_sizes, &ladder))
        continue;
      measure_rungs(report, &ladder, of_sizes);
      json_t *one = ladder_json(&ladder);
      if (one)
        hsr_json_append(&all, one);
    }
  return all;
}

/* --- Geometric means ------------------------------------------------------ */

/* The mean of an algorithm's ratios, over the cells that both solved. */
static json_t *mean_json(const json_t *cells, const char *algorithm,
                         const char *to) {
  size_t n = 0, k;
  const json_t *cell;
  double *logs = malloc(json_array_size(cells) * sizeof *logs + 1);
  if (!logs)
    return NULL;
  json_array_foreach(cells, k, cell) {
    const json_t *ratio = json_object_get(cell, "ratio");
    if (json_is_object(ratio) && results_number(cell, "threads") == 1 &&
        !strcmp(results_text(cell, "algorithm"), algorithm))
      logs[n++] = log(json_number_value(json_object_get(ratio, "value")));
  }
  json_t *mean = NULL;
  if (n) {
    struct figure ratio = figure_of_logs(logs, (int)n);
    mean = json_pack("{ss ss sI sf so so}", "algorithm", algorithm, "to", to,
                     "cells", (json_int_t)n, "ratio", ratio.value, "low",
                     number_or_null(ratio.low), "high",
                     number_or_null(ratio.high));
  }
  free(logs);
  return mean;
}

static json_t *geometric_json(const json_t *cells, const char *to) {
  json_t *means = json_array(), *done = json_object();
  size_t k;
  const json_t *cell;
  json_array_foreach(cells, k, cell) {
    const char *algorithm = results_text(cell, "algorithm");
    if (json_object_get(done, algorithm))
      continue;
    json_object_set_new(done, algorithm, json_true());
    json_t *mean = mean_json(cells, algorithm, to);
    if (mean)
      hsr_json_append(&means, mean);
  }
  json_decref(done);
  return means;
}

/* --- All ------------------------------------------------------------------ */

/* Only Greene's tables if the results have none of the scenes of 1974. */
static json_t *all_tables(const struct report *report) {
  struct tables *tables;
  json_t *json = tables_new(&tables, report->results, NULL)
                     ? json_pack("{so}", "greene", greene_json(report->results))
                     : tables_json(tables);
  tables_delete(tables);
  return json;
}

json_t *report_data(const struct report *report, struct hsr_error *err) {
  json_t *cells = json_array();
  enum hsr_status status =
      cells ? add_cells(report, cells, err) : hsr_fail_nomem(err);
  if (status) {
    json_decref(cells);
    return NULL;
  }
  json_t *data = json_pack(
      "{ss sO sO so so ss so so}", "schema", "hsr-report/1", "headers",
      report->results->headers, "views", report->results->views, "growth",
      growth_json(report, cells), "geometric",
      geometric_json(cells, report->reference), "baseline", report->reference,
      "tables", all_tables(report), "algorithms", algorithms_json());
  if (data && json_object_set(data, "cells", cells)) {
    json_decref(data);
    data = NULL;
  }
  json_decref(cells);
  if (!data)
    hsr_fail_nomem(err);
  return data;
}
