/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/results/times.h"

#include <stdio.h>
#include <stdlib.h>

static const json_t *seconds_of(const json_t *cell, size_t start) {
  return json_object_get(json_array_get(json_object_get(cell, "starts"), start),
                         "seconds");
}

enum hsr_status times_read(const json_t *cell, struct times *times,
                           struct hsr_error *err) {
  *times = (struct times){.seconds = NULL};
  int starts = (int)json_array_size(json_object_get(cell, "starts"));
  int each = (int)json_array_size(seconds_of(cell, 0));
  if (!starts || !each || starts > FIGURES_MOST_STARTS)
    return HSR_OK;
  times->seconds =
      malloc((size_t)starts * (size_t)each * sizeof *times->seconds);
  if (!times->seconds)
    return hsr_fail_nomem(err);
  for (int s = 0; s < starts; s++)
    for (int k = 0; k < each; k++)
      times->seconds[s * each + k] = json_number_value(
          json_array_get(seconds_of(cell, (size_t)s), (size_t)k));
  struct samples samples = {times->seconds, starts, each};
  if (figure_least(&samples) <= 0) /* a start with fewer than the first */
    return HSR_OK;
  times->samples = samples;
  return figure_logs(&times->samples, times->logs) ? HSR_OK
                                                   : hsr_fail_nomem(err);
}

void times_free(struct times *times) {
  free(times->seconds);
}

const json_t *times_reference(const struct results *results, const json_t *cell,
                              const char *reference) {
  char key[RESULTS_KEY];
  int length = results_picture_key(
      results_text(cell, "scene"), results_number(cell, "view"),
      results_number(cell, "walk"), results_number(cell, "width"),
      results_number(cell, "height"), key);
  snprintf(key + length, sizeof key - (size_t)length, " %.*s 1",
           (int)RESULTS_MOST_NAME, reference);
  return results_cell(results, key);
}

enum hsr_status times_ratios(const struct results *results, const json_t *cell,
                             const char *reference, double *logs, int *n,
                             struct hsr_error *err) {
  struct times own, other = {.seconds = NULL};
  *n = 0;
  enum hsr_status status = times_read(cell, &own, err);
  if (!status)
    status = times_read(times_reference(results, cell, reference), &other, err);
  if (!status && own.samples.starts == other.samples.starts)
    *n = own.samples.starts;
  for (int k = 0; k < *n; k++)
    logs[k] = own.logs[k] - other.logs[k];
  times_free(&other);
  times_free(&own);
  return status;
}
