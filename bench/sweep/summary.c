/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a sweep found, as a table: who is right, how long they took, and against
 * whom; and what has changed since an earlier one. */
#include "bench/figures.h"
#include "bench/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A cell's times, start by start. */
struct timed {
  struct samples samples;
  double *seconds;
  double logs[FIGURES_MOST_STARTS];
};

/* --- Reading cells -----------------------------------------------------------
 */

static const char *text_of(const json_t *cell, const char *field) {
  const char *text = json_string_value(json_object_get(cell, field));
  return text ? text : "";
}

static const json_t *seconds_of(const json_t *cell, size_t start) {
  return json_object_get(json_array_get(json_object_get(cell, "starts"), start),
                         "seconds");
}

/* To be freed by timed_free. *timed is empty (starts 0) where the cell has no
 * times. */
static enum hsr_status read_times(const json_t *cell, struct timed *timed,
                                  struct hsr_error *err) {
  *timed = (struct timed){.seconds = NULL};
  int starts = (int)json_array_size(json_object_get(cell, "starts"));
  int each = (int)json_array_size(seconds_of(cell, 0));
  if (!starts || !each || starts > FIGURES_MOST_STARTS)
    return HSR_OK;
  timed->seconds = malloc((size_t)(starts * each) * sizeof *timed->seconds);
  if (!timed->seconds)
    return hsr_fail_nomem(err);
  for (int s = 0; s < starts; s++)
    for (int k = 0; k < each; k++)
      timed->seconds[s * each + k] = json_number_value(
          json_array_get(seconds_of(cell, (size_t)s), (size_t)k));
  timed->samples = (struct samples){timed->seconds, starts, each};
  return figure_logs(&timed->samples, timed->logs) ? HSR_OK
                                                   : hsr_fail_nomem(err);
}

static void timed_free(struct timed *timed) {
  free(timed->seconds);
}

/* The cell of the same place by the reference algorithm on one thread, or NULL.
 */
static const json_t *reference_of(const struct results *results,
                                  const json_t *cell, const char *reference) {
  char key[RESULTS_KEY];
  snprintf(key, sizeof key, "%.300s %d %dx%d %.100s 1", text_of(cell, "scene"),
           (int)json_integer_value(json_object_get(cell, "view")),
           (int)json_integer_value(json_object_get(cell, "width")),
           (int)json_integer_value(json_object_get(cell, "height")), reference);
  return results_cell(results, key);
}

/* The logarithms of a cell's ratios to the reference, start by start: *n, 0
 * where there are none. */
static enum hsr_status read_ratios(const struct results *results,
                                   const json_t *cell, const char *reference,
                                   double *logs, int *n,
                                   struct hsr_error *err) {
  struct timed own, other;
  *n = 0;
  enum hsr_status status = read_times(cell, &own, err);
  if (!status) {
    const json_t *to = reference_of(results, cell, reference);
    status = read_times(to, &other, err);
    if (!status && own.samples.starts == other.samples.starts)
      *n = own.samples.starts;
    for (int k = 0; k < *n; k++)
      logs[k] = own.logs[k] - other.logs[k];
    timed_free(&other);
  }
  timed_free(&own);
  return status;
}

/* --- The table ---------------------------------------------------------------
 */

static void print_seconds(double seconds) {
  if (seconds < 1e-3)
    printf(" %8.3g us", 1e6 * seconds);
  else if (seconds < 1)
    printf(" %8.4g ms", 1e3 * seconds);
  else
    printf(" %8.4g s ", seconds);
}

static void print_ratio(const struct figure *ratio) {
  printf(" %9.3g", ratio->value);
  if (isnan(ratio->low))
    printf(" %-19s", "");
  else
    printf(" [%8.3g,%8.3g]", ratio->low, ratio->high);
}

static enum hsr_status print_times(const struct results *results,
                                   const json_t *cell, const char *reference,
                                   struct hsr_error *err) {
  struct timed timed;
  struct figure median;
  double logs[FIGURES_MOST_STARTS];
  int n = 0;
  enum hsr_status status = read_times(cell, &timed, err);
  if (!status && timed.samples.starts) {
    if (!figure_median(&timed.samples, &median))
      status = hsr_fail_nomem(err);
    if (!status)
      status = read_ratios(results, cell, reference, logs, &n, err);
    if (!status) {
      print_seconds(median.value);
      print_seconds(median.low);
      print_seconds(median.high);
      print_seconds(figure_least(&timed.samples));
    }
    if (!status && n) {
      struct figure ratio = figure_of_logs(logs, n);
      print_ratio(&ratio);
      if (!figure_distinguishable(&ratio) &&
          strcmp(text_of(cell, "algorithm"), reference))
        printf("  not distinguishable");
    }
  }
  timed_free(&timed);
  return status;
}

static void print_cell_name(const json_t *cell) {
  char name[64];
  long threads = (long)json_integer_value(json_object_get(cell, "threads"));
  int length = snprintf(name, sizeof name, "%.40s", text_of(cell, "algorithm"));
  if (threads > 1)
    snprintf(name + length, sizeof name - (size_t)length, " (%ld threads)",
             threads);
  printf("  %-22s %-8s", name, text_of(cell, "status"));
}

enum hsr_status print_summary(const struct results *results,
                              const char *reference, struct hsr_error *err) {
  printf("%-33s %11s %11s %11s %11s %9s\n", "", "median", "95 % from", "to",
         "least", "ratio");
  printf("%-33s %11s %11s %11s %11s   to %s, 99 %%\n", "", "", "", "", "",
         reference);
  enum hsr_status status = HSR_OK;
  char place[RESULTS_KEY] = "";
  size_t k;
  const json_t *cell;
  json_array_foreach(results->cells, k, cell) {
    char key[RESULTS_KEY];
    results_key(cell, key);
    *strrchr(key, ' ') = '\0';
    *strrchr(key, ' ') = '\0';
    if (strcmp(key, place))
      puts(strcpy(place, key));
    print_cell_name(cell);
    status = print_times(results, cell, reference, err);
    long long wrong = json_integer_value(json_object_get(cell, "mismatches"));
    if (wrong)
      printf("  %lld mismatches", wrong);
    const char *reason = text_of(cell, "reason");
    printf("%s%s\n", *reason ? "  " : "", reason);
    if (status)
      break;
  }
  return status;
}

/* --- Changes -----------------------------------------------------------------
 */

struct changes {
  int compared, slower, faster, worse; /* cells */
  int ratios, distinguishable;         /* of their ratios to the reference */
};

static enum hsr_status print_change(const json_t *cell, const json_t *before,
                                    struct changes *changes,
                                    struct hsr_error *err) {
  struct timed now, then;
  enum hsr_status status = read_times(cell, &now, err);
  if (status) {
    timed_free(&now);
    return status;
  }
  status = read_times(before, &then, err);
  if (!status && now.samples.starts && then.samples.starts) {
    struct figure change = figure_quotient(now.logs, now.samples.starts,
                                           then.logs, then.samples.starts);
    changes->compared++;
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
  timed_free(&then);
  timed_free(&now);
  return status;
}

static enum hsr_status
compare_ratios(const struct results *results, const struct results *old,
               const json_t *cell, const json_t *before, const char *reference,
               struct changes *changes, struct hsr_error *err) {
  double now[FIGURES_MOST_STARTS], then[FIGURES_MOST_STARTS];
  int n = 0, m = 0;
  enum hsr_status status = read_ratios(results, cell, reference, now, &n, err);
  if (!status)
    status = read_ratios(old, before, reference, then, &m, err);
  if (status || !n || !m || !strcmp(text_of(cell, "algorithm"), reference))
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
  const char *was = text_of(before, "status"), *is = text_of(cell, "status");
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
  printf("%d ratios to %s: %d distinguishable from before\n", changes.ratios,
         reference, changes.distinguishable);
  return changes.slower || changes.worse ? HSR_E_DIFFERENCE : HSR_OK;
}
