/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows for other programs: CSV (RFC 4180) and JSON. */
#include "bench/results/json.h"
#include "bench/times/rows.h"
#include "common/files/json/json.h"

#include <math.h>
#include <string.h>

/* --- CSV ------------------------------------------------------------------ */

static void put_text(const char *text) {
  if (!strpbrk(text, ",\"\r\n")) {
    fputs(text, stdout);
    return;
  }
  putchar('"');
  for (; *text; text++)
    printf(*text == '"' ? "\"\"" : "%c", *text);
  putchar('"');
}

static void put_numbers(const double *x, int n) {
  for (int k = 0; k < n; k++)
    if (isnan(x[k]))
      putchar(',');
    else
      printf(",%.9g", x[k]);
}

void rows_print_csv(const struct rows *rows) {
  puts("scene,view,walk,width,height,algorithm,threads,kind,status,mismatches,"
       "compared,median,median_low,median_high,least,ratio,ratio_low,"
       "ratio_high,memory_kb,depths,run,why_empty");
  for (size_t k = 0; k < rows->n; k++) {
    const struct row *row = &rows->row[k];
    const json_t *c = row->cell;
    long walk = results_number(c, "walk");
    put_text(results_text(c, "scene"));
    printf(",%ld,%ld,%ld,%ld,", results_number(c, "view"), walk ? walk : 1,
           results_number(c, "width"), results_number(c, "height"));
    put_text(results_text(c, "algorithm"));
    printf(",%ld,%s,%s,%ld,%ld", results_number(c, "threads"),
           results_text(c, "kind"), results_text(c, "status"),
           results_number(c, "mismatches"), results_number(c, "compared"));
    put_numbers((double[]){row->median.value, row->median.low, row->median.high,
                           row->least, row->ratio.value, row->ratio.low,
                           row->ratio.high},
                7);
    if (row->memory_kb >= 0)
      printf(",%ld,", row->memory_kb);
    else
      fputs(",,", stdout);
    printf("%ld,", results_number(json_object_get(c, "depths"), "compared"));
    printf("%s,", results_text(c, "run"));
    put_text(rows_why_empty(rows, row));
    putchar('\n');
  }
}

/* --- JSON ----------------------------------------------------------------- */

static json_t *figure_json(const struct figure *figure) {
  return json_pack("{so so so}", "value", number_or_null(figure->value), "low",
                   number_or_null(figure->low), "high",
                   number_or_null(figure->high));
}

/* The record of the cell, with figures in place of its samples. */
static json_t *row_json(const struct row *row) {
  static const char *const left_out[] = {"record", "starts", "counts",
                                         "adapted"};
  json_t *json = json_copy((json_t *)row->cell);
  for (int k = 0; k < 4; k++)
    json_object_del(json, left_out[k]);
  json_t *figures =
      json_pack("{so so so so}", "median", figure_json(&row->median), "least",
                number_or_null(row->least), "ratio", figure_json(&row->ratio),
                "memory_kb",
                row->memory_kb < 0 ? json_null()
                                   : json_integer((json_int_t)row->memory_kb));
  if (!json || !figures || json_object_update(json, figures)) {
    json_decref(json);
    json = NULL;
  }
  json_decref(figures);
  return json;
}

enum hsr_status rows_print_json(const struct rows *rows,
                                struct hsr_error *err) {
  json_t *cells = json_array();
  for (size_t k = 0; k < rows->n; k++)
    hsr_json_append(&cells, row_json(&rows->row[k]));
  return json_print(json_pack("{ss ss so}", "schema", "hsr-times/1",
                              "reference", rows->reference, "cells", cells),
                    err);
}
