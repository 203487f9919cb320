/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The trace of every module, on small scenes full of ties:
 *
 *  - each counter has as many events as it counted;
 *  - the subjects and the outcome of an event are those that its counter
 *    declares, and each counter belongs to one line of the outline;
 *  - the accepted events, in their order, repaint the answer exactly. */
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const scenes[] = {
    "house",      "cyclic-overlap", "penetration",  "coplanar",
    "one-sided",  "t-junction",     "shared-edges", "near-plane",
    "non-convex", "eye-in-plane",   "color-cube:2", "nested-solids",
    "sphere:200"};
static const char *const grids[] = {
    "checker-cube:5", "checker-cube:6", "grid",
    "grid:7:3",       "grid:4:9",       /* of one layer: */ "heights:2",
    "heights:3",      "heights:4",      "heights:4:2"};
enum {
  N_SCENES = sizeof scenes / sizeof *scenes,
  N_GRIDS = sizeof grids / sizeof *grids,
  M = 33,
  N = 24
};

static const char *const transparent[] = {"greenhouse", "panes:30",
                                          "panes:40:5", "house", "non-planar"};
enum { N_TRANSPARENT = sizeof transparent / sizeof *transparent };

/* The events of one run. */
struct heard {
  const struct hsr_algorithm *algorithm;
  const struct hsr_answer_type *kind;
  uint64_t n[HSR_MAX_COUNTERS];
  uint64_t bad_subjects, bad_outcomes, bad_order;
  struct hsr_answer painted;
};

static int n_counters(const struct hsr_algorithm *a) {
  int n = 0;
  while (a->counters && a->counters[n].name)
    n++;
  return n;
}

/* A counter of edges also counts implied edges. */
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
  if (counter->kind == HSR_ACCEPT && heard->kind->paint(&heard->painted, event))
    abort();
}

static bool are_counts_equal(const struct heard *heard,
                             const struct hsr_tally *tally, const char *scene) {
  const struct hsr_algorithm *a = heard->algorithm;
  uint64_t not_listed = 0;
  for (int k = 0; k < HSR_PART_SIZE; k++)
    not_listed += tally->count[HSR_MAX_COUNTERS + k];
  if (not_listed)
    printf("# %s, %s: %llu steps are of a part that .parts does not list\n",
           a->name, scene, (unsigned long long)not_listed);
  bool equal = !not_listed;
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

/* Compares both ways round, since one drawing may lack edges. */
static bool is_equal(const struct hsr_answer *got,
                     const struct hsr_answer *wanted,
                     const struct hsr_view *view, const char *who) {
  const struct hsr_comparison c = {
      .view = view, .got = got, .wanted = wanted, .n = M * N};
  struct hsr_difference found = {.differing = 0};
  got->form.type->compare(&c, &found);
  if (found.differing)
    printf("# %s: %llu %s\n", who, (unsigned long long)found.differing,
           found.first);
  return !found.differing;
}

static bool is_repainted(struct heard *heard, const struct hsr_answer *drawn,
                         const struct hsr_view *view, const char *scene) {
  const struct hsr_answer_type *kind = heard->kind;
  char who[100];
  snprintf(who, sizeof who, "%s, %s", heard->algorithm->name, scene);
  if (kind->settle && kind->settle(&heard->painted))
    abort();
  return is_equal(&heard->painted, drawn, view, who) &&
         is_equal(drawn, &heard->painted, view, who);
}

/* One scene by one algorithm, so chosen. */
static bool check_scene(const struct hsr_algorithm *a,
                        const struct hsr_choice *choice, const char *name,
                        int *n_drawn) {
  struct both_worlds worlds;
  open_worlds(&worlds, name);
  struct hsr_view view;
  const struct hsr_form *form = &choice->form;
  struct heard heard = {.algorithm = a, .kind = form->type};
  must_view(&view, &worlds.scene->views[0], M, N);
  if (hsr_answer_make(&heard.painted, form, &view, false, NULL))
    abort();
  struct hsr_trace trace = {.listen = listen, .context = &heard};
  struct hsr_tally tally = {.trace = &trace};
  struct hsr_answer drawn;
  bool good = true;
  if (draw_chosen(a, choice, &worlds.world, &view, &drawn, &tally)) {
    ++*n_drawn;
    good = are_counts_equal(&heard, &tally, name);
    good &= is_repainted(&heard, &drawn, &view, name);
  }
  if (heard.bad_subjects || heard.bad_outcomes || heard.bad_order) {
    printf("# %s, %s: events of other subjects %llu, outcomes %llu, numbers "
           "%llu\n",
           a->name, name, (unsigned long long)heard.bad_subjects,
           (unsigned long long)heard.bad_outcomes,
           (unsigned long long)heard.bad_order);
    good = false;
  }
  hsr_answer_free(&drawn);
  hsr_answer_free(&heard.painted);
  close_worlds(&worlds);
  return good;
}

/* Each counter belongs to one line, and every line's counters exist. */
static bool has_outline(const struct hsr_algorithm *a) {
  int lines[HSR_MAX_COUNTERS] = {0};
  for (const struct hsr_line *l = a->outline; l && l->text; l++)
    for (int k = 0; k < HSR_MAX_COUNTERS; k++)
      for (int r = 0; r < l->n_raises; r++)
        lines[k] += l->raises[r] == k;
  bool good = a->outline != NULL;
  for (int k = 0; k < HSR_MAX_COUNTERS; k++)
    if (lines[k] != (k < n_counters(a))) {
      printf("# %s: the counter \"%s\" is in %d lines of the outline\n",
             a->name, k < n_counters(a) ? a->counters[k].name : "?", lines[k]);
      good = false;
    }
  return good;
}

/* No trace holds a kind of answer that events cannot paint. */
static bool is_player(const struct hsr_algorithm *a) {
  return !(a->flags & (HSR_JUDGE | HSR_NO_PICTURE)) && hsr_own_kind(a)->paint;
}

static void check_algorithm(struct tap *tap, const struct hsr_algorithm *a) {
  struct hsr_choice choice = hsr_choice_standard(a);
  bool good = true;
  int n_drawn = 0;
  bool takes_faces = a->subjects & 1 << HSR_FACES;
  ok(tap, has_outline(a), "%s: each counter belongs to a line", a->name);
  for (int s = 0; s < (takes_faces ? N_SCENES : N_GRIDS); s++)
    good &=
        check_scene(a, &choice, takes_faces ? scenes[s] : grids[s], &n_drawn);
  ok(tap, good && n_drawn > 3,
     "%s: events are its counts, and repaint its answer, on %d scenes", a->name,
     n_drawn);
}

/* A further kind that it makes. */
static void check_also(struct tap *tap, const struct hsr_algorithm *a,
                       const struct hsr_answer_type *type) {
  struct hsr_choice choice = choose_also(a, type);
  bool good = true;
  int n_drawn = 0;
  for (int s = 0; s < N_TRANSPARENT; s++)
    good &= check_scene(a, &choice, transparent[s], &n_drawn);
  ok(tap, good && n_drawn > 3, "%s: and likewise its %s answer, on %d scenes",
     a->name, type->name, n_drawn);
}

static int count_also(const struct hsr_algorithm *a) {
  int n = 0;
  while (hsr_makes_besides(a, n))
    n++;
  return n;
}

/* usage: trace_test [NAME...]      only these algorithms and their variants;
 *                                  standard: all */
int main(int argc, char **argv) {
  int n = 0;
  for (const struct hsr_listed *a = all_listed(); a->plain; a++)
    if (is_player(a->plain) && is_asked(a->plain, argc - 1, argv + 1))
      n += 2 + count_also(a->plain);
  if (n == 0)
    bail("no module of such a name");
  struct tap tap = plan(n);
  for (const struct hsr_listed *l = all_listed(); l->plain; l++) {
    const struct hsr_algorithm *a = l->counting;
    if (!is_player(a) || !is_asked(a, argc - 1, argv + 1))
      continue;
    check_algorithm(&tap, a);
    for (int k = 0; hsr_makes_besides(a, k); k++)
      check_also(&tap, a, hsr_makes_besides(a, k));
  }
  return finish(&tap);
}
