/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What has changed since an earlier sweep. */
#include "bench/sweep/sweep.h"
#include "bench/results/times.h"

#include <math.h>
#include <string.h>

struct changes {
  int compared, slower, faster, worse; /* cells */
  int ratios, distinguishable;         /* of their ratios to the reference */
  int few;                             /* cells with too few starts to tell */
};

static enum hsr_status print_change(const json_t *cell, const json_t *before,
                                    struct changes *changes,
                                    struct hsr_error *err) {
  struct times now, then;
  enum hsr_status status = times_read(cell, &now, err);
  if (status) {
    times_free(&now);
    return status;
  }
  status = times_read(before, &then, err);
  if (!status && now.samples.starts && then.samples.starts) {
    struct figure change = figure_quotient(now.logs, now.samples.starts,
                                           then.logs, then.samples.starts);
    changes->compared++;
    changes->few += !figure_has_interval(&change);
    if (figure_distinguishable(&change)) {
      char key[RESULTS_KEY];
      results_key(cell, key);
      bool slower = change.value > 1;
      changes->slower += slower;
      changes->faster += !slower;
      printf("%s: %s, %.3g of the time before [%.3g, %.3g]\n", key,
             slower ? "slower" : "faster", change.value, change.low,
             change.high);
    }
  }
  times_free(&then);
  times_free(&now);
  return status;
}

static enum hsr_status
compare_ratios(const struct results *results, const struct results *old,
               const json_t *cell, const json_t *before, const char *reference,
               struct changes *changes, struct hsr_error *err) {
  double now[FIGURES_MOST_STARTS], then[FIGURES_MOST_STARTS];
  int n = 0, m = 0;
  enum hsr_status status = times_ratios(results, cell, reference, now, &n, err);
  if (!status)
    status = times_ratios(old, before, reference, then, &m, err);
  if (status || !n || !m || !strcmp(results_text(cell, "algorithm"), reference))
    return status;
  struct figure change = figure_quotient(now, n, then, m);
  changes->ratios++;
  changes->distinguishable += figure_distinguishable(&change);
  return HSR_OK;
}

static enum hsr_status compare_cell(const struct results *results,
                                    const struct results *old,
                                    const json_t *cell, const char *reference,
                                    struct changes *changes,
                                    struct hsr_error *err) {
  char key[RESULTS_KEY];
  results_key(cell, key);
  const json_t *before = results_cell(old, key);
  if (!before)
    return HSR_OK;
  const char *was = results_text(before, "status"),
             *is = results_text(cell, "status");
  if (strcmp(was, is)) {
    printf("%s: %s, before: %s\n", key, is, was);
    changes->worse += !strcmp(was, "ok");
  }
  enum hsr_status status = print_change(cell, before, changes, err);
  if (!status)
    status =
        compare_ratios(results, old, cell, before, reference, changes, err);
  return status;
}

enum hsr_status print_changes(const struct results *results,
                              const struct results *old, const char *reference,
                              struct hsr_error *err) {
  struct changes changes = {.compared = 0};
  enum hsr_status status = HSR_OK;
  size_t k;
  const json_t *cell;
  puts("");
  json_array_foreach(results->cells, k, cell) {
    status = compare_cell(results, old, cell, reference, &changes, err);
    if (status)
      return status;
  }
  printf("%d cells timed in both: %d slower, %d faster; %d no longer right\n",
         changes.compared, changes.slower, changes.faster, changes.worse);
  if (changes.few)
    printf("%d of them have too few starts to tell: three are needed\n",
           changes.few);
  printf("%d ratios to %s: %d distinguishable from before\n", changes.ratios,
         reference, changes.distinguishable);
  return changes.slower || changes.worse ? HSR_E_DIFFERENCE : HSR_OK;
}
