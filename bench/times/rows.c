/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/times/rows.h"
#include "bench/results/times.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The most that any start took, or -1. */
static long memory_of(const json_t *cell) {
  size_t k;
  const json_t *start;
  long most = -1;
  json_array_foreach(json_object_get(cell, "starts"), k, start) {
    const json_t *memory = json_object_get(start, "memory_kb");
    long taken =
        results_number(memory, "peak") - results_number(memory, "before");
    if (json_is_integer(json_object_get(memory, "before")) && taken > most)
      most = taken;
  }
  return most;
}

static enum hsr_status fill(struct row *row, const struct results *results,
                            const char *reference, struct hsr_error *err) {
  struct times times;
  double logs[FIGURES_MOST_STARTS];
  int n = 0;
  row->median = row->ratio = (struct figure){NAN, NAN, NAN};
  row->least = NAN;
  row->memory_kb = memory_of(row->cell);
  enum hsr_status status = times_read(row->cell, &times, err);
  if (!status && times.samples.starts) {
    row->timed = true;
    row->least = figure_least(&times.samples);
    if (!figure_median(&times.samples, &row->median))
      status = hsr_fail_nomem(err);
    if (!status)
      status = times_ratios(results, row->cell, reference, logs, &n, err);
    row->has_ratio = n > 0;
    if (n)
      row->ratio = figure_of_logs(logs, n);
  }
  times_free(&times);
  return status;
}

/* The reference, if it was timed; else the algorithm of the first cell that was.
 */
static const char *present(const struct results *results,
                           const char *reference) {
  const char *first = NULL;
  size_t k;
  json_t *cell;
  json_array_foreach(results->cells, k, cell) {
    const char *name = results_text(cell, "algorithm");
    if (!json_object_get(cell, "starts"))
      continue;
    if (!strcmp(name, reference))
      return reference;
    first = first ? first : name;
  }
  return first ? first : reference;
}

enum hsr_status rows_make(struct rows *rows, const struct results *results,
                          const char *reference, struct hsr_error *err) {
  size_t n = json_array_size(results->cells);
  reference = present(results, reference);
  *rows = (struct rows){.reference = reference};
  rows->row = calloc(n ? n : 1, sizeof *rows->row);
  if (!rows->row)
    return hsr_fail_nomem(err);
  enum hsr_status status = HSR_OK;
  for (; rows->n < n && !status; rows->n++) {
    struct row *row = &rows->row[rows->n];
    row->cell = json_array_get(results->cells, rows->n);
    status = fill(row, results, reference, err);
  }
  return status;
}

void rows_free(struct rows *rows) {
  free(rows->row);
}

bool rows_same_place(const struct row *a, const struct row *b) {
  static const char *const field[] = {"view", "walk", "width", "height"};
  bool same =
      !strcmp(results_text(a->cell, "scene"), results_text(b->cell, "scene"));
  for (int k = 0; k < 4; k++)
    same = same && results_number(a->cell, field[k]) ==
                       results_number(b->cell, field[k]);
  return same;
}

bool rows_is_reference(const struct rows *rows, const struct row *row) {
  return !strcmp(results_text(row->cell, "algorithm"), rows->reference);
}

bool rows_is_alike(const struct rows *rows, const struct row *row) {
  return row->has_ratio && !rows_is_reference(rows, row) &&
         figure_has_interval(&row->ratio) &&
         !figure_distinguishable(&row->ratio);
}

bool rows_has_few_starts(const struct rows *rows, const struct row *row) {
  return row->has_ratio && !rows_is_reference(rows, row) &&
         !figure_has_interval(&row->ratio);
}

const char *rows_why_empty(const struct rows *rows, const struct row *row) {
  if (!row->timed)
    return "not timed";
  if (!figure_has_interval(&row->median))
    return "too few samples for an interval";
  if (!row->has_ratio)
    return "no time of the reference";
  if (rows_has_few_starts(rows, row))
    return "too few starts for an interval";
  return "";
}

void rows_say_status(const struct row *row, char text[ROWS_STATUS]) {
  const char *status = results_text(row->cell, "status"),
             *reason = results_text(row->cell, "reason");
  long wrong = results_number(row->cell, "mismatches");
  long compared = results_number(row->cell, "compared");
  int length = 0;
  if (strcmp(status, "ok") && strncmp(reason, status, strlen(status)))
    length = snprintf(text, ROWS_STATUS, "%s%s", status,
                      *reason || wrong ? ": " : "");
  if (wrong)
    length +=
        snprintf(text + length, ROWS_STATUS - (size_t)length,
                 "%ld of %ld differ%s", wrong, compared, *reason ? ", " : "");
  snprintf(text + length, ROWS_STATUS - (size_t)length, "%s", reason);
}

void rows_name_place(const struct row *row, char name[RESULTS_KEY]) {
  const json_t *c = row->cell;
  results_picture_key(results_text(c, "scene"), results_number(c, "view"),
                      results_number(c, "walk"), results_number(c, "width"),
                      results_number(c, "height"), name);
}

char *rows_time(double seconds, char text[ROWS_TIME]) {
  if (seconds < 1e-3)
    snprintf(text, ROWS_TIME, "%.4g us", 1e6 * seconds);
  else if (seconds < 1)
    snprintf(text, ROWS_TIME, "%.4g ms", 1e3 * seconds);
  else
    snprintf(text, ROWS_TIME, "%.4g s ", seconds);
  return text;
}
