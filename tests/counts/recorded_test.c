/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The counts of reports/1974/counts.ndjson, by sample: of the scenes below,
 * each algorithm counts again what the record says.
 *
 *   recorded_test [NAME...]          all algorithms, or these */
#include "bench/results/results.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

static const char *const scenes[] = {"house", "harbor:100", "harbor:500",
                                     "harbor:2500"};
enum { N_SCENES = sizeof scenes / sizeof *scenes };

/* How many counters differ, of the record's and of the algorithm's. */
static int compare(const json_t *counts, const struct hsr_algorithm *a,
                   const struct hsr_tally *tally) {
  int differ = 0;
  size_t n = 0;
  for (; a->counters[n].name; n++) {
    const json_t *recorded = json_object_get(counts, a->counters[n].name);
    if (json_is_integer(recorded) &&
        (uint64_t)json_integer_value(recorded) == tally->count[n])
      continue;
    printf("# %s, %s: recorded %lld, counted %llu\n", a->name,
           a->counters[n].name, (long long)json_integer_value(recorded),
           (unsigned long long)tally->count[n]);
    differ++;
  }
  return differ + (json_object_size(counts) != n);
}

static int check_cell(const json_t *cell, const struct hsr_algorithm *a,
                      struct both_worlds *worlds) {
  struct hsr_view view;
  struct hsr_answer answer;
  struct hsr_tally tally = {.trace = NULL};
  must_view(&view, &worlds->scene->views[results_number(cell, "view") - 1],
            (int)results_number(cell, "width"),
            (int)results_number(cell, "height"));
  bool drawn = draw_answer(a, &worlds->world, &view, &answer, &tally);
  hsr_answer_free(&answer);
  return drawn ? compare(json_object_get(cell, "counts"), a, &tally) : 1;
}

/* One scene, by those that are asked for. */
static void check_scene(struct tap *tap, const struct results *results,
                        const char *scene, int n_names, char **names) {
  struct both_worlds worlds;
  open_worlds(&worlds, scene);
  int differ = 0, n = 0;
  size_t k;
  const json_t *cell;
  json_array_foreach(results->cells, k, cell) {
    const struct hsr_algorithm *a =
        find_counting(results_text(cell, "algorithm"));
    if (strcmp(results_text(cell, "scene"), scene) ||
        !is_asked(a, n_names, names))
      continue;
    n++;
    differ += check_cell(cell, a, &worlds);
  }
  if (n_names && n == 0)
    ok(tap, true, "# SKIP %s: the record has none of these", scene);
  else
    ok(tap, n > (n_names ? 0 : 20) && !differ,
       "%s: %d algorithms count what is recorded (%d counters differ)", scene,
       n, differ);
  close_worlds(&worlds);
}

int main(int argc, char **argv) {
  char path[4096];
  const char *source = getenv("HSR_SOURCE");
  struct results results = {NULL, NULL, NULL, NULL};
  struct hsr_error err = {.text = "out of memory"};
  struct tap tap = plan(N_SCENES);
  snprintf(path, sizeof path, "%s/reports/1974/counts.ndjson",
           source ? source : ".");
  if (results_read(&results, path, &err))
    bail("%s", err.text);
  for (int s = 0; s < N_SCENES; s++)
    check_scene(&tap, &results, scenes[s], argc - 1, argv + 1);
  results_free(&results);
  return finish(&tap);
}
