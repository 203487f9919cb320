/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What stands out: from an earlier sweep, or from a module's other cells. */
#include "bench/sweep/sweep.h"
#include "bench/results/times.h"

#include <math.h>
#include <stdlib.h>
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

/* --- Cliffs --------------------------------------------------------------- */

/* How long a cell took, as the logarithm of the ratio to the reference. */
struct ratio {
  const json_t *cell;
  double log;
};

static enum hsr_status find_ratios(const struct results *results,
                                   const char *reference, struct ratio *ratio,
                                   size_t *n_ratios, struct hsr_error *err) {
  size_t k;
  const json_t *cell;
  json_array_foreach(results->cells, k, cell) {
    double logs[FIGURES_MOST_STARTS], sum = 0;
    int n = 0;
    enum hsr_status status =
        times_ratios(results, cell, reference, logs, &n, err);
    if (status)
      return status;
    for (int l = 0; l < n; l++)
      sum += logs[l];
    if (n)
      ratio[(*n_ratios)++] = (struct ratio){cell, sum / n};
  }
  return HSR_OK;
}

static int by_size(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static bool same_module(const json_t *a, const json_t *b) {
  return !strcmp(results_text(a, "algorithm"), results_text(b, "algorithm")) &&
         results_number(a, "threads") == results_number(b, "threads");
}

/* The median of a module's ratios; `room` has a place for each. */
static double usual(const struct ratio *ratio, size_t n, const json_t *cell,
                    double *room) {
  size_t kept = 0;
  for (size_t k = 0; k < n; k++)
    if (same_module(ratio[k].cell, cell))
      room[kept++] = ratio[k].log;
  qsort(room, kept, sizeof *room, by_size);
  return 0.5 * (room[kept / 2] + room[(kept - 1) / 2]);
}

static int print_cliffs_of(const struct ratio *ratio, size_t n, double *room,
                           long times) {
  int found = 0;
  for (size_t k = 0; k < n; k++) {
    double over = exp(ratio[k].log - usual(ratio, n, ratio[k].cell, room));
    char key[RESULTS_KEY];
    if (!(over > (double)times))
      continue;
    results_key(ratio[k].cell, key);
    printf(
        "%s: %.3g times as long as the module's other cells lead to expect\n",
        key, over);
    found++;
  }
  return found;
}

enum hsr_status print_cliffs(const struct results *results,
                             const char *reference, long times,
                             struct hsr_error *err) {
  size_t most = json_array_size(results->cells) + 1, n = 0;
  struct ratio *ratio = calloc(most, sizeof *ratio);
  double *room = calloc(most, sizeof *room);
  enum hsr_status status = ratio && room
                               ? find_ratios(results, reference, ratio, &n, err)
                               : hsr_fail_nomem(err);
  if (!status) {
    puts("");
    int found = print_cliffs_of(ratio, n, room, times);
    printf("%d of %zu cells take over %ld times as long as expected\n", found,
           n, times);
  }
  free(room);
  free(ratio);
  return status;
}
