/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hsr check prints: a table, or one JSON object. */
#include "bench/check/check.h"
#include "bench/results/json.h"

#include <string.h>

static enum hsr_kind kind_of(const struct check_options *o, int algorithm) {
  const struct hsr_variant *v = &o->algorithm[algorithm];
  return hsr_choice_kind(v->listed->plain, &v->choice);
}

static void print_header(const struct check_options *o) {
  printf("%-22s %8s %9s %5s ", "scene", "faces", "samples", "views");
  for (int a = 0; a < o->n_algorithms; a++)
    printf(" %9s", o->algorithm[a].name);
  puts("   mismatches");
}

/* One line a size: mismatches over all views, or the worst verdict. */
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

static void print_edge(struct hsr_edge_name edge) {
  if (edge.implied)
    printf("the implied one of faces %u and %u, number %u\n", edge.a, edge.b,
           edge.part);
  else
    printf("from vertex %u to %u\n", edge.a, edge.b);
}

static void print_difference(const struct scene_run *run, int size, int view,
                             int a) {
  const struct check_options *o = run->options;
  const struct cell *c = cell_at(run, size, view, a);
  const uint32_t *sums = c->first.sums, *wanted = c->first.wanted_sums;
  if (c->verdict != WRONG ||
      o->algorithm[a].listed->plain->flags & HSR_KNOWN_WRONG)
    return;
  printf("  wrong: %s, view %d, %dx%d, %s: %llu ", run->name, o->view[view] + 1,
         o->m[size], o->n[size], o->algorithm[a].name,
         (unsigned long long)c->mismatches);
  switch (kind_of(o, a)) {
  case HSR_SEGMENTS:
    printf("edges, the first ");
    print_edge(c->first.edge);
    break;
  case HSR_IDS:
    printf("samples, the first (%d, %d): face %u, not %u\n", c->first.i,
           c->first.j, c->first.got, c->first.wanted);
    break;
  default:
    printf("pixels, the first (%d, %d): sums %u %u %u, not %u %u %u\n",
           c->first.i, c->first.j, sums[0], sums[1], sums[2], wanted[0],
           wanted[1], wanted[2]);
  }
}

/* The first reason, as it is often the same for all of an algorithm's views. */
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

/* Where pictures of a kind were not compared wholly. */
static void print_compared(const struct scene_run *run, enum hsr_kind kind,
                           const char *what) {
  const struct check_options *o = run->options;
  long n = samples_to_compare(&run->world, kind, o->samples);
  bool any = false;
  for (int a = 0; a < o->n_algorithms; a++)
    any |= kind_of(o, a) == kind;
  if (n && any)
    printf("  compared: %ld random %s of each picture\n", n, what);
}

static void print_differences(const struct scene_run *run) {
  const struct check_options *o = run->options;
  print_compared(run, HSR_IDS, "samples");
  print_compared(run, HSR_FILTERED, "filtered pixels");
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
    json_append(&names, json_string(c->adapted[k]));
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
      o->algorithm[a].name, "kind", kind_name(kind_of(o, a)), "status",
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
          totals->compared[kind_of(o, a)] += c->compared;
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
          json_append(&totals->cells, cell_json(run, size, view, a));
      }
  return HSR_OK;
}

enum hsr_status report_end(const struct check_options *o, struct totals *totals,
                           struct hsr_error *err) {
  uint64_t samples = totals->compared[HSR_IDS];
  uint64_t edges = totals->compared[HSR_SEGMENTS];
  uint64_t pixels = totals->compared[HSR_FILTERED];
  if (o->json)
    return json_print(
        json_pack("{ss sI sI sI sI sI sI so}", "schema", "hsr-check/1",
                  "samples", (json_int_t)samples, "edges", (json_int_t)edges,
                  "pixels", (json_int_t)pixels, "mismatches",
                  (json_int_t)totals->mismatches, "depths_compared",
                  (json_int_t)totals->depths, "depths_exact",
                  (json_int_t)totals->depths_exact, "cells", totals->cells),
        err);
  printf("\n%llu samples and %llu edges compared", (unsigned long long)samples,
         (unsigned long long)edges);
  if (pixels)
    printf(", %llu filtered pixels", (unsigned long long)pixels);
  printf(", %llu mismatches\n", (unsigned long long)totals->mismatches);
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
