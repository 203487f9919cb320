/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hsr check prints: a table, or one JSON object. */
#include "bench/check/check.h"
#include "bench/results/json.h"

#include <string.h>

static const struct hsr_answer_type *kind_of(const struct check_options *o,
                                             int algorithm) {
  return o->algorithm[algorithm].choice.form.type;
}

static void print_header(const struct check_options *o) {
  printf("%-22s %8s %9s %5s ", "scene", "faces", "samples", "views");
  for (int a = 0; a < o->n_algorithms; a++)
    printf(" %9s", o->algorithm[a].name);
  puts("   mismatches");
}

/* Prints one line a size: the mismatches over all views, or the worst verdict.
 */
static void print_scene(const struct scene_run *run) {
  const struct check_options *o = run->options;
  for (int size = 0; size < o->n_sizes; size++) {
    char samples[24];
    snprintf(samples, sizeof samples, "%dx%d", o->m[size], o->n[size]);
    printf("%-22s %8u %9s %5d ", run->name, run->world.n_faces, samples,
           o->n_views);
    for (int a = 0; a < o->n_algorithms; a++) {
      uint64_t mismatches = 0;
      enum verdict worst = RIGHT;
      for (int view = 0; view < o->n_views; view++) {
        const struct cell *cell = cell_at(run, size, view, a);
        mismatches += cell->mismatches;
        if (cell->verdict > worst || cell->verdict == PENDING)
          worst = cell->verdict;
      }
      int width = (int)strlen(o->algorithm[a].name);
      width = width > 9 ? width : 9;
      bool known = o->algorithm[a].listed->plain->flags & HSR_KNOWN_WRONG;
      char cell[32];
      snprintf(cell, sizeof cell, known && mismatches ? "(%llu)" : "%llu",
               (unsigned long long)mismatches);
      if (worst == RIGHT || worst == WRONG)
        printf(" %*s", width, cell);
      else
        printf(" %*s", width, verdict_name(worst));
    }
    putchar('\n');
  }
}

static void print_difference(const struct scene_run *run, int size, int view,
                             int a) {
  const struct check_options *o = run->options;
  const struct cell *c = cell_at(run, size, view, a);
  if (c->verdict != WRONG ||
      o->algorithm[a].listed->plain->flags & HSR_KNOWN_WRONG)
    return;
  printf("  wrong: %s, view %d, %dx%d, %s: %llu %s\n", run->name,
         o->view[view] + 1, o->m[size], o->n[size], o->algorithm[a].name,
         (unsigned long long)c->mismatches, c->first);
}

/* Prints only the first reason: it is often the same for all views of an
 * algorithm. */
static void print_refusal(const struct scene_run *run, int a) {
  const struct check_options *o = run->options;
  for (int size = 0; size < o->n_sizes; size++)
    for (int view = 0; view < o->n_views; view++) {
      const struct cell *c = cell_at(run, size, view, a);
      if (c->refusal[0]) {
        printf("  %s\n", c->refusal);
        return;
      }
    }
}

/* Says how much was compared, if pictures of a kind were not compared whole. */
static void print_compared(const struct scene_run *run,
                           const struct hsr_answer_type *kind) {
  const struct check_options *o = run->options;
  struct hsr_form form = hsr_form_standard(kind);
  long n = samples_to_compare(&run->world, &form, o->samples);
  bool any = false;
  for (int a = 0; a < o->n_algorithms; a++)
    any |= kind_of(o, a) == kind;
  if (n && any && kind->by_places)
    printf("  compared: %ld random %s of each picture\n", n, kind->places);
}

static void print_differences(const struct scene_run *run) {
  const struct check_options *o = run->options;
  for (int k = 0; hsr_answer_types[k]; k++)
    print_compared(run, hsr_answer_types[k]);
  for (int a = 0; a < o->n_algorithms; a++)
    print_refusal(run, a);
  for (int size = 0; size < o->n_sizes; size++)
    for (int view = 0; view < o->n_views; view++)
      for (int a = 0; a < o->n_algorithms; a++)
        print_difference(run, size, view, a);
}

static json_t *adapted_json(const struct cell *c) {
  json_t *names = json_array();
  for (int k = 0; k < c->n_adaptations; k++)
    hsr_json_append(&names, json_string(c->adapted[k]));
  return names;
}

static json_t *cell_json(const struct scene_run *run, int size, int view,
                         int a) {
  const struct check_options *o = run->options;
  const struct cell *c = cell_at(run, size, view, a);
  const struct hsr_algorithm *algorithm = o->algorithm[a].listed->plain;
  return json_pack(
      "{ss si si si ss ss ss sI sI sb ss* so}", "scene", run->name, "view",
      o->view[view] + 1, "width", o->m[size], "height", o->n[size], "algorithm",
      o->algorithm[a].name, "kind", kind_of(o, a)->name, "status",
      verdict_name(c->verdict), "mismatches", (json_int_t)c->mismatches,
      "compared", (json_int_t)c->compared, "known_wrong",
      (algorithm->flags & HSR_KNOWN_WRONG) != 0, "refusal",
      c->refusal[0] ? c->refusal : NULL, "adapted", adapted_json(c));
}

static enum hsr_status add_up(const struct scene_run *run,
                              struct totals *totals) {
  const struct check_options *o = run->options;
  for (int size = 0; size < o->n_sizes; size++)
    for (int view = 0; view < o->n_views; view++)
      for (int a = 0; a < o->n_algorithms; a++) {
        const struct cell *c = cell_at(run, size, view, a);
        if (c->failure == HSR_E_NOMEM)
          return HSR_E_NOMEM;
        if (c->verdict == RIGHT || c->verdict == WRONG)
          totals->compared[hsr_answer_number(kind_of(o, a))] += c->compared;
        totals->depths += c->depths_compared;
        totals->depths_exact += c->depths_exact;
        if (o->algorithm[a].listed->plain->flags & HSR_KNOWN_WRONG &&
            c->verdict == WRONG) {
          totals->expected += c->mismatches;
        } else {
          totals->mismatches += c->mismatches;
          totals->failures += c->verdict != RIGHT && c->verdict != REFUSED;
        }
        if (o->json)
          hsr_json_append(&totals->cells, cell_json(run, size, view, a));
      }
  return HSR_OK;
}

/* How much was compared of each kind, under the name of its places. */
static json_t *totals_json(const struct totals *totals) {
  json_t *json = json_pack("{ss}", "schema", "hsr-check/1");
  for (int k = 0; json && hsr_answer_types[k]; k++)
    json_object_set_new(json, hsr_answer_types[k]->places,
                        json_integer((json_int_t)totals->compared[k]));
  return json;
}

static enum hsr_status print_json(struct totals *totals,
                                  struct hsr_error *err) {
  json_t *all = totals_json(totals);
  json_t *rest =
      json_pack("{sI sI sI so}", "mismatches", (json_int_t)totals->mismatches,
                "depths_compared", (json_int_t)totals->depths, "depths_exact",
                (json_int_t)totals->depths_exact, "cells", totals->cells);
  if (!all || !rest || json_object_update(all, rest)) {
    json_decref(all);
    all = NULL;
  }
  json_decref(rest);
  return json_print(all, err);
}

/* "3 samples and 2 edges": only the kinds of which anything was compared. */
static void print_totals(const struct totals *totals) {
  int n = 0, said = 0;
  for (int k = 0; hsr_answer_types[k]; k++)
    n += totals->compared[k] > 0;
  putchar('\n');
  for (int k = 0; hsr_answer_types[k]; k++)
    if (totals->compared[k] && ++said)
      printf("%s%llu %s",
             said == 1   ? ""
             : said == n ? " and "
                         : ", ",
             (unsigned long long)totals->compared[k],
             hsr_answer_types[k]->places);
  printf("%s compared, %llu mismatches\n", n ? "" : "nothing",
         (unsigned long long)totals->mismatches);
}

enum hsr_status report_end(const struct check_options *o, struct totals *totals,
                           struct hsr_error *err) {
  if (o->json)
    return print_json(totals, err);
  print_totals(totals);
  if (totals->expected)
    printf("%llu more of algorithms that are known to be wrong\n",
           (unsigned long long)totals->expected);
  if (!totals->depths)
    return HSR_OK;
  printf("%llu depth comparisons, %llu by the exact path",
         (unsigned long long)totals->depths,
         (unsigned long long)totals->depths_exact);
  if (totals->depths_exact)
    printf(" (1 in %.0f)",
           (double)totals->depths / (double)totals->depths_exact);
  putchar('\n');
  return HSR_OK;
}

void report_begin(const struct check_options *o, struct totals *totals) {
  if (o->json)
    totals->cells = json_array();
  else
    print_header(o);
}

enum hsr_status report_scene(const struct scene_run *run, struct totals *totals,
                             struct hsr_error *err) {
  if (!run->options->json) {
    print_scene(run);
    print_differences(run);
    fflush(stdout);
  }
  return add_up(run, totals) ? hsr_fail_nomem(err) : HSR_OK;
}

void report_abandon(struct totals *totals) {
  json_decref(totals->cells);
}
