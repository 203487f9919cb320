/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/tables/greene.h"

#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What modules of ours can be asked for; a hierarchical one that is added
 * brings its figures along. */
const struct greene_figure greene_figures[] = {
    {"1995, figure 3.8",
     "depth tests a sample of a naive z-buffer, 538 million polygons",
     83.7,
     {"zbuffer", "depth tests", "office:33", 512},
     {.algorithm = NULL}},
    {"1996, figure 5",
     "painter's algorithm, time of 2048 x 2048 against 512 x 512",
     1.91 / 0.097,
     {"painter", NULL, "color-cube", 2048},
     {"painter", NULL, "color-cube", 512}},
    {NULL, NULL, 0, {.algorithm = NULL}, {.algorithm = NULL}}};

/* The median of all repetitions of all starts. */
static double median_seconds(const json_t *cell) {
  const json_t *starts = json_object_get(cell, "starts");
  size_t n = 0, s, k;
  json_t *start, *sample;
  json_array_foreach(starts, s, start) n +=
      json_array_size(json_object_get(start, "seconds"));
  double *seconds = n ? calloc(n, sizeof *seconds) : NULL;
  if (!seconds)
    return NAN;
  n = 0;
  json_array_foreach(starts, s, start)
      json_array_foreach(json_object_get(start, "seconds"), k, sample)
          seconds[n++] = json_number_value(sample);
  double median = gsl_stats_median(seconds, 1, n);
  free(seconds);
  return median;
}

static double value(const struct greene_term *term,
                    const struct results *results) {
  char key[RESULTS_KEY];
  snprintf(key, sizeof key, "%.300s 1 %dx%d %.100s 1", term->scene, term->size,
           term->size, term->algorithm);
  const json_t *cell = results_cell(results, key);
  const char *status = json_string_value(json_object_get(cell, "status"));
  if (!status || strcmp(status, "ok"))
    return NAN;
  if (!term->counter)
    return median_seconds(cell);
  const json_t *count =
      json_object_get(json_object_get(cell, "counts"), term->counter);
  return json_is_integer(count) ? (double)json_integer_value(count) : NAN;
}

double greene_measured(const struct greene_figure *figure,
                       const struct results *results) {
  const struct greene_term *term = &figure->term;
  return value(term, results) / (figure->to.algorithm
                                     ? value(&figure->to, results)
                                     : (double)term->size * term->size);
}
