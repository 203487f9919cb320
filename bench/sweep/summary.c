/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The results of a sweep as a table: which entrants are right, their times, and
 * their ratios to the reference; and what has changed since an earlier sweep.
 */
#include "bench/sweep/sweep.h"
#include "bench/results/times.h"

#include <math.h>
#include <string.h>

/* --- The table ------------------------------------------------------------ */

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
  struct times timed;
  struct figure median;
  double logs[FIGURES_MOST_STARTS];
  int n = 0;
  enum hsr_status status = times_read(cell, &timed, err);
  if (!status && timed.samples.starts) {
    if (!figure_median(&timed.samples, &median))
      status = hsr_fail_nomem(err);
    if (!status)
      status = times_ratios(results, cell, reference, logs, &n, err);
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
          strcmp(results_text(cell, "algorithm"), reference))
        printf("  not distinguishable");
    }
  }
  times_free(&timed);
  return status;
}

static void print_cell_name(const json_t *cell) {
  char name[64];
  long threads = results_number(cell, "threads");
  int length =
      snprintf(name, sizeof name, "%.40s", results_text(cell, "algorithm"));
  if (threads > 1)
    snprintf(name + length, sizeof name - (size_t)length, " (%ld threads)",
             threads);
  printf("  %-22s %-8s", name, results_text(cell, "status"));
}

/* Says how many samples were compared, if not all were. */
static void print_samples(const json_t *cell) {
  long compared = results_number(cell, "compared");
  long walk = results_number(cell, "walk");
  long all = results_number(cell, "width") * results_number(cell, "height") *
             (walk ? walk : 1);
  const char *kind = results_text(cell, "kind");
  if (compared && compared < all && strcmp(kind, "segments"))
    printf("  at %ld %s", compared,
           strcmp(kind, "filtered") ? "samples" : "pixels");
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
    long wrong = results_number(cell, "mismatches");
    if (wrong)
      printf("  %ld mismatches", wrong);
    print_samples(cell);
    const char *reason = results_text(cell, "reason");
    printf("%s%s\n", *reason ? "  " : "", reason);
    if (status)
      break;
  }
  return status;
}

/* --- Changes -------------------------------------------------------------- */

struct changes {
  int compared, slower, faster, worse; /* cells */
  int ratios, distinguishable;         /* of their ratios to the reference */
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
  printf("%d ratios to %s: %d distinguishable from before\n", changes.ratios,
         reference, changes.distinguishable);
  return changes.slower || changes.worse ? HSR_E_DIFFERENCE : HSR_OK;
}
