/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every module's trace must hold, on small scenes full of ties:
 *
 *  - each counter has as many events as it counted;
 *  - the subjects and the outcome of an event are those that its counter
 *    declares, and each counter belongs to one line of the outline;
 *  - the accepted events, in their order, repaint the answer exactly. */
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

static const char *const scenes[] = {
    "house",      "cyclic-overlap", "penetration",  "coplanar",
    "one-sided",  "t-junction",     "shared-edges", "near-plane",
    "non-convex", "eye-in-plane",   "color-cube:2", "nested-solids",
    "sphere:200"};
enum { N_SCENES = sizeof scenes / sizeof *scenes, M = 33, N = 24 };

/* What one run told. */
struct heard {
  const struct hsr_algorithm *algorithm;
  uint64_t n[HSR_MAX_COUNTERS];
  uint64_t bad_subjects, bad_outcomes, bad_order;
  uint32_t ids[M * N];
  struct hsr_drawing drawing;
};

static int n_counters(const struct hsr_algorithm *a) {
  int n = 0;
  while (a->counters && a->counters[n].name)
    n++;
  return n;
}

/* A counter of edges counts implied edges, too. */
static bool is_subject(struct hsr_subject subject, enum hsr_subject_kind kind) {
  return subject.kind == kind || subject.kind == HSR_OF_NOTHING ||
         (kind == HSR_OF_EDGE && subject.kind == HSR_OF_IMPLIED);
}

static int n_outcomes(const struct hsr_counter *counter) {
  int n = 1;
  for (const char *at = counter->outcomes; at && (at = strchr(at, '|')); at++)
    n++;
  return n;
}

static void repaint(struct heard *heard, const struct hsr_event *event) {
  const struct hsr_window *w = &event->window;
  if (event->part) {
    if (hsr_drawing_add(&heard->drawing, event->part))
      abort();
    return;
  }
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      heard->ids[j * M + i] = event->a.id[0];
}

static void listen(void *context, const struct hsr_event *event) {
  struct heard *heard = context;
  uint64_t before = 0;
  for (int k = 0; k < HSR_MAX_COUNTERS; k++)
    before += heard->n[k];
  heard->bad_order += event->number != before;
  heard->n[event->counter]++;
  if (event->counter >= n_counters(heard->algorithm))
    return;
  const struct hsr_counter *counter =
      &heard->algorithm->counters[event->counter];
  heard->bad_subjects +=
      !is_subject(event->a, counter->a) || !is_subject(event->b, counter->b);
  heard->bad_outcomes +=
      event->outcome < 0 || event->outcome >= n_outcomes(counter);
  if (counter->kind == HSR_ACCEPT)
    repaint(heard, event);
}

static bool are_counts_equal(const struct heard *heard,
                             const struct hsr_tally *tally, const char *scene) {
  const struct hsr_algorithm *a = heard->algorithm;
  bool equal = true;
  for (int k = 0; k < HSR_MAX_COUNTERS; k++) {
    bool known = k < n_counters(a);
    bool computed = known && a->counters[k].computed;
    if (heard->n[k] == (computed ? 0 : tally->count[k]))
      continue;
    printf("# %s, %s: %s: %llu counted, %llu events\n", a->name, scene,
           known ? a->counters[k].name : "no such counter",
           (unsigned long long)tally->count[k],
           (unsigned long long)heard->n[k]);
    equal = false;
  }
  return equal;
}

static bool is_repainted(struct heard *heard, const uint32_t *ids,
                         const struct hsr_drawing *drawing, const char *scene) {
  const struct hsr_algorithm *a = heard->algorithm;
  if (hsr_drawing_sort(&heard->drawing))
    abort();
  long differ = 0;
  for (int k = 0; ids && k < M * N; k++)
    differ += ids[k] != heard->ids[k];
  if (!ids) {
    struct hsr_drawing_difference found;
    hsr_drawing_compare(&heard->drawing, drawing, false, &found);
    differ = (long)found.differing + (heard->drawing.n != drawing->n);
  }
  if (differ)
    printf("# %s, %s: %ld of the answer not as the events say\n", a->name,
           scene, differ);
  return !differ;
}

/* One scene by one algorithm. */
static bool check_scene(const struct hsr_algorithm *a, const char *name) {
  struct both_worlds worlds;
  open_worlds(&worlds, name);
  struct hsr_view view;
  if (hsr_view_init(&view, &worlds.scene->views[0], M, N, NULL))
    abort();
  struct heard *heard = calloc(1, sizeof *heard);
  static uint32_t ids[M * N];
  memset(heard->ids, 0xff, sizeof heard->ids); /* HSR_BACKGROUND */
  heard->algorithm = a;
  struct hsr_trace trace = {.listen = listen, .context = heard};
  struct hsr_tally tally = {.trace = &trace};
  struct hsr_drawing drawing = {.n = 0};
  bool lines = a->kind == HSR_SEGMENTS;
  if (lines)
    draw_lines(a, &worlds.world, &view, &drawing, &tally);
  else
    draw_ids(a, &worlds.world, &view, ids, &tally);
  bool good = are_counts_equal(heard, &tally, name);
  good &= is_repainted(heard, lines ? NULL : ids, &drawing, name);
  if (heard->bad_subjects || heard->bad_outcomes || heard->bad_order) {
    printf("# %s, %s: events of other subjects %llu, outcomes %llu, numbers "
           "%llu\n",
           a->name, name, (unsigned long long)heard->bad_subjects,
           (unsigned long long)heard->bad_outcomes,
           (unsigned long long)heard->bad_order);
    good = false;
  }
  hsr_drawing_free(&drawing);
  hsr_drawing_free(&heard->drawing);
  free(heard);
  close_worlds(&worlds);
  return good;
}

/* Each counter belongs to one line, and no line to a counter that is not. */
static bool has_outline(const struct hsr_algorithm *a) {
  int lines[HSR_MAX_COUNTERS] = {0};
  for (const struct hsr_line *l = a->outline; l && l->text; l++)
    for (int k = 0; k < HSR_MAX_COUNTERS; k++)
      lines[k] += (l->counters & HSR_RAISES(k)) != 0;
  bool good = a->outline != NULL;
  for (int k = 0; k < HSR_MAX_COUNTERS; k++)
    if (lines[k] != (k < n_counters(a))) {
      printf("# %s: counter %d is in %d lines of the outline\n", a->name, k,
             lines[k]);
      good = false;
    }
  return good;
}

static bool is_player(const struct hsr_algorithm *a) {
  return !(a->flags & (HSR_JUDGE | HSR_NO_PICTURE));
}

/* With names: of those only. */
int main(int argc, char **argv) {
  int n = 0;
  for (const struct hsr_listed *a = hsr_algorithms; a->plain; a++)
    n += is_player(a->plain);
  struct tap tap = plan(argc > 1 ? 2 * (argc - 1) : 2 * n);
  for (const struct hsr_listed *l = hsr_algorithms; l->plain; l++) {
    const struct hsr_algorithm *a = l->counting;
    bool asked = argc == 1;
    for (int k = 1; k < argc; k++)
      asked |= !strcmp(argv[k], a->name);
    if (!asked || !is_player(a))
      continue;
    ok(&tap, has_outline(a), "%s: each counter belongs to a line", a->name);
    bool good = true;
    for (int s = 0; s < N_SCENES; s++)
      good &= check_scene(a, scenes[s]);
    ok(&tap, good, "%s: events are its counts, and repaint its answer",
       a->name);
  }
  return finish(&tap);
}
