/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/report/data.h"
#include "bench/results/json.h"
#include "bench/results/times.h"
#include "bench/run/crew.h"
#include "bench/terminal/terminal.h"
#include "common/files/json/json.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_THREADS = 64, TAKEN_AT_ONCE = 64 };

/* --- Statistics ----------------------------------------------------------- */

/* The cells, of which a thread that is free takes the next ones. */
struct work {
  const struct report *report;
  struct cell_figures *figures;
  size_t n;
  atomic_size_t next;
  atomic_bool failed;
};

static enum hsr_status measure(const struct report *report, const json_t *cell,
                               struct cell_figures *f, struct hsr_error *err) {
  struct times times;
  double logs[FIGURES_MOST_STARTS];
  int n = 0;
  enum hsr_status status = times_read(cell, &times, err);
  if (!status && times.samples.starts) {
    f->starts = times.samples.starts;
    f->least = figure_least(&times.samples);
    if (!figure_median(&times.samples, &f->median))
      status = hsr_fail_nomem(err);
  }
  times_free(&times);
  if (!status && f->starts)
    status =
        times_ratios(report->results, cell, report->reference, logs, &n, err);
  f->compared = n > 0;
  if (n > 0)
    f->ratio = figure_of_logs(logs, n);
  return status;
}

static bool measure_next(struct work *w) {
  size_t first = atomic_fetch_add(&w->next, TAKEN_AT_ONCE);
  for (size_t k = first; k < w->n && k < first + TAKEN_AT_ONCE; k++)
    if (measure(w->report, json_array_get(w->report->results->cells, k),
                &w->figures[k], NULL))
      atomic_store(&w->failed, true);
  return first < w->n && !atomic_load(&w->failed);
}

static void *measure_some(void *work) {
  while (measure_next(work)) {
  }
  return NULL;
}

static void measure_all(struct work *w) {
  pthread_t thread[MOST_THREADS];
  int n = 0;
  long most = processors() - 1; /* this thread is one of them */
  while (n < most && n < MOST_THREADS &&
         !pthread_create(&thread[n], NULL, measure_some, w))
    n++;
  struct progress progress = progress_begin(stderr);
  while (measure_next(w))
    progress_tell(&progress, atomic_load(&w->next), w->n, "cells",
                  "statistics");
  progress_end(&progress);
  for (int k = 0; k < n; k++)
    pthread_join(thread[k], NULL);
}

struct cell_figures *cells_measure(const struct report *report,
                                   struct hsr_error *err) {
  struct work work = {.report = report,
                      .n = json_array_size(report->results->cells)};
  work.figures = calloc(work.n + 1, sizeof *work.figures);
  if (work.figures)
    measure_all(&work);
  if (!work.figures || atomic_load(&work.failed)) {
    free(work.figures);
    hsr_fail_nomem(err);
    return NULL;
  }
  return work.figures;
}

/* --- Cells ---------------------------------------------------------------- */

static json_t *figure_json(const struct figure *f) {
  return json_pack("[foo]", f->value, number_or_null(f->low),
                   number_or_null(f->high));
}

static json_t *seconds_json(const struct cell_figures *f) {
  json_t *seconds = figure_json(&f->median);
  hsr_json_append(&seconds, json_real(f->least));
  return seconds;
}

/* Sets a field and takes the reference to its value. If that fails, or the
 * value is NULL, *out is freed and becomes NULL. */
static void set(json_t **out, const char *field, json_t *value) {
  if (json_object_set_new(*out, field, value)) {
    json_decref(*out);
    *out = NULL;
  }
}

/* The mean of a phase over the starts that have it; NULL: none has. */
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
  return n ? json_real(sum / n) : NULL;
}

static json_t *phases_json(const json_t *starts) {
  static const char *const phase[] = {"import", "adapt", "prepare", "shade",
                                      "write"};
  json_t *phases = json_object();
  for (size_t k = 0; k < sizeof phase / sizeof *phase; k++) {
    json_t *seconds = phase_json(starts, "phases", phase[k]);
    if (seconds)
      set(&phases, phase[k], seconds);
  }
  return phases;
}

/* The number of a thing in a list, which has each thing once. `numbers` knows
 * the numbers by the things' names. Takes the reference to the thing. */
static json_t *number_in(json_t *list, json_t *numbers, const char *name,
                         json_t *thing) {
  json_t *number = json_object_get(numbers, name);
  if (number) {
    json_decref(thing);
    return json_incref(number);
  }
  number = json_integer((json_int_t)json_array_size(list));
  if (json_array_append_new(list, thing) ||
      json_object_set(numbers, name, number)) {
    json_decref(number);
    return NULL;
  }
  return number;
}

/* The lists to which cells refer. */
struct lists {
  json_t *places, *place_numbers, *counters, *counter_numbers;
};

static json_t *place_json(struct lists *lists, const json_t *cell) {
  char key[RESULTS_KEY];
  const char *scene = results_text(cell, "scene");
  long view = results_number(cell, "view"), walk = results_number(cell, "walk"),
       m = results_number(cell, "width"), n = results_number(cell, "height");
  results_picture_key(scene, view, walk, m, n, key);
  return number_in(lists->places, lists->place_numbers, key,
                   json_pack("{ss sI sI sI sI}", "scene", scene, "view",
                             (json_int_t)view, "walk",
                             (json_int_t)(walk > 1 ? walk : 1), "width",
                             (json_int_t)m, "height", (json_int_t)n));
}

/* The number of the list of names, and the counts in its order. */
static json_t *counts_json(struct lists *lists, const json_t *counts) {
  json_t *names = json_array(), *values = json_array();
  const char *name;
  json_t *count;
  json_object_foreach((json_t *)counts, name, count) {
    hsr_json_append(&names, json_string(name));
    hsr_json_append(&values, json_incref(count));
  }
  char *key = names ? json_dumps(names, JSON_COMPACT) : NULL;
  json_t *number = key ? number_in(lists->counters, lists->counter_numbers, key,
                                   json_incref(names))
                       : NULL;
  free(key);
  json_decref(names);
  if (values && json_array_insert_new(values, 0, number)) {
    json_decref(values);
    return NULL;
  }
  return values;
}

/* Sets what is not null, and no empty array. */
static void set_what_is_there(json_t **out, const json_t *cell,
                              const char *field) {
  json_t *value = json_object_get(cell, field);
  if (value && !json_is_null(value) && !json_is_false(value) &&
      !(json_is_array(value) && !json_array_size(value)))
    set(out, field, json_incref(value));
}

static json_t *cell_json(struct lists *lists, const json_t *cell,
                         const struct cell_figures *f) {
  static const char *const copied[] = {"algorithm",  "status",   "kind",
                                       "mismatches", "compared", "reason",
                                       "adapted",    "peer",     "threads"};
  json_t *out = json_object();
  set(&out, "place", place_json(lists, cell));
  for (size_t k = 0; k < sizeof copied / sizeof *copied; k++)
    set_what_is_there(&out, cell, copied[k]);
  const json_t *counts = json_object_get(cell, "counts");
  if (json_object_size(counts))
    set(&out, "counts", counts_json(lists, counts));
  if (f->starts)
    set(&out, "seconds", seconds_json(f));
  if (f->compared)
    set(&out, "ratio", figure_json(&f->ratio));
  const json_t *starts = json_object_get(cell, "starts");
  if (!json_array_size(starts))
    return out;
  set(&out, "phases", phases_json(starts));
  json_t *peak = phase_json(starts, "memory_kb", "peak");
  if (peak)
    set(&out, "peak_kb", peak);
  return out;
}

json_t *cells_json(const struct report *report,
                   const struct cell_figures *figures) {
  struct lists lists = {.places = json_array(),
                        .place_numbers = json_object(),
                        .counters = json_array(),
                        .counter_numbers = json_object()};
  json_t *cells = json_array();
  size_t k;
  const json_t *cell;
  struct progress progress = progress_begin(stderr);
  json_array_foreach(report->results->cells, k, cell) {
    progress_tell(&progress, k, json_array_size(report->results->cells),
                  "cells", "data");
    hsr_json_append(&cells, cell_json(&lists, cell, &figures[k]));
  }
  progress_end(&progress);
  json_decref(lists.place_numbers);
  json_decref(lists.counter_numbers);
  return json_pack("{so so so}", "places", lists.places, "counters",
                   lists.counters, "cells", cells);
}
