/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What Sutherland et al. 1974 say about Warnock's algorithm, checked in its
 * trace: sub-windows inherit surrounders and disjoints, and most windows lie
 * near the leaves of the tree, so that about L_v of them are examined. */
#include "bench/modules/modules.h"
#include "common/statistics/statistics.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

enum { SIZE = 128, MOST_LEVELS = 64 };

static const char *const scene_names[] = {
    "house",    "harbor",        "color-cube",  "terrain",    "soup",
    "lattice",  "nested-solids", "penetration", "deep-stack", "needle-fan",
    "coplanar", "non-convex",    "behind-eye",  "near-plane", "eye-in-plane"};
enum { N_SCENES = sizeof scene_names / sizeof scene_names[0] };

static void *grown(void *memory, size_t bytes) {
  memory = realloc(memory, bytes);
  if (!memory)
    bail("out of memory");
  return memory;
}

/* --- Watching a run ------------------------------------------------------- */

static bool is_within(struct hsr_window a, struct hsr_window b) {
  return a.x0 >= b.x0 && a.y0 >= b.y0 && a.x1 <= b.x1 && a.y1 <= b.y1;
}

/* A window that a face was found to surround, or to be disjoint from. */
struct settled {
  struct hsr_window window;
  size_t next; /* of the same face; 0: none */
};

/* A window that was divided, and may not be finished yet. */
struct open_window {
  struct hsr_window window;
  int height; /* of the tree below it, so far */
};

struct watch {
  int special; /* the counter of the tests */
  int subdivisions, first_decision, last_decision;
  struct settled *settled; /* from 1 */
  size_t n_settled, room;
  size_t *of_face;
  long n_repeated; /* tests whose result was there to inherit */
  struct open_window open[MOST_LEVELS];
  int n_open, deepest;
  long n_windows[MOST_LEVELS]; /* by their height above the leaves */
};

static void watch_test(struct watch *w, const struct hsr_event *event) {
  struct hsr_window window = {event->window.x0, event->window.y0,
                              event->window.x1, event->window.y1};
  for (size_t k = w->of_face[event->a.id[0]]; k; k = w->settled[k].next)
    if (is_within(window, w->settled[k].window)) {
      w->n_repeated++;
      return;
    }
  enum { DISJOINT, INTERSECTER, SURROUNDER }; /* outcomes of Warnock special */
  if (event->outcome == INTERSECTER)
    return;
  if (++w->n_settled >= w->room) {
    w->room = 2 * w->n_settled;
    w->settled = grown(w->settled, w->room * sizeof *w->settled);
  }
  w->settled[w->n_settled] =
      (struct settled){window, w->of_face[event->a.id[0]]};
  w->of_face[event->a.id[0]] = w->n_settled;
}

/* Finishes the innermost open window. */
static void close_window(struct watch *w) {
  int height = w->open[--w->n_open].height;
  w->n_windows[height]++;
  if (w->n_open && w->open[w->n_open - 1].height <= height)
    w->open[w->n_open - 1].height = height + 1;
}

static void watch_window(struct watch *w, const struct hsr_event *event) {
  struct hsr_window window = {event->window.x0, event->window.y0,
                              event->window.x1, event->window.y1};
  while (w->n_open && !is_within(window, w->open[w->n_open - 1].window))
    close_window(w);
  w->open[w->n_open++] = (struct open_window){window, 0};
  if (w->deepest < w->n_open - 1)
    w->deepest = w->n_open - 1;
  if (event->counter != w->subdivisions)
    close_window(w);
}

static void watch_event(void *context, const struct hsr_event *event) {
  struct watch *w = context;
  if (event->counter == w->special)
    watch_test(w, event);
  else if (event->counter == w->subdivisions ||
           (event->counter >= w->first_decision &&
            event->counter <= w->last_decision))
    watch_window(w, event);
}

/* --- One algorithm on all scenes ------------------------------------------ */

struct findings {
  long n_tests;          /* of a face against a window */
  long n_repeated;       /* tests of a relation that was known already */
  long n_unaccounted;    /* faces neither tested, nor inherited, nor hidden */
  long n_windows_amiss;  /* not examined, or neither decided nor divided */
  long n_windows, n_low; /* all, and those at most one level above a leaf */
};

static void watch_scene(const struct hsr_algorithm *algorithm, const char *name,
                        struct findings *findings) {
  static uint32_t ids[SIZE * SIZE];
  struct hsr_error err;
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_scene *scene = must_open(name);
  must_world(&world, scene);
  must_view(&view, &scene->views[0], SIZE, SIZE);
  struct watch w = {.special = counter_of(algorithm, "Warnock special"),
                    .subdivisions = counter_of(algorithm, "subdivisions"),
                    .first_decision = counter_of(algorithm, "empty windows"),
                    .last_decision = counter_of(algorithm, "samples"),
                    .of_face = grown(NULL, world.n_faces * sizeof *w.of_face)};
  memset(w.of_face, 0, world.n_faces * sizeof *w.of_face);
  struct hsr_trace trace = {.listen = watch_event, .context = &w};
  struct hsr_tally tally = {.trace = &trace};
  draw_ids(algorithm, &world, &view, ids, &tally);
  while (w.n_open)
    close_window(&w);

  struct hsr_table1 table;
  if (hsr_statistics_measure(&world, &view, ids, &table, &err))
    bail("%s: %s", name, err.text);
  const uint64_t *count = tally.count;
  long n_windows = (long)count[counter_of(algorithm, "windows")], n_seen = 0;
  for (int height = 0; height < MOST_LEVELS; height++)
    n_seen += w.n_windows[height];
  long n_faces = (long)count[counter_of(algorithm, "Z sort")] / 2;
  long n_tests = (long)count[w.special];
  long n_inherited =
      (long)(count[counter_of(algorithm, "inherited surrounders")] +
             count[counter_of(algorithm, "inherited disjoints")]);
  long n_hidden = (long)count[counter_of(algorithm, "hidden faces")];
  findings->n_tests += n_tests;
  findings->n_repeated += w.n_repeated;
  findings->n_unaccounted +=
      labs(n_faces * n_windows - n_tests - n_inherited - n_hidden);
  findings->n_windows_amiss += labs(n_windows - n_seen);
  findings->n_windows += n_windows;
  findings->n_low += w.n_windows[0] + w.n_windows[1];
  printf("# %s, %s: %ld windows (L_v %.0f) in %d levels, %.1f %% leaves, "
         "%.1f %% at most one above; a window: %.1f faces tested (D_c %.1f), "
         "%.1f inherited, %.1f hidden, of %ld\n",
         algorithm->name, name, n_windows, table.L_v, w.deepest + 1,
         100.0 * (double)w.n_windows[0] / (double)n_windows,
         100.0 * (double)(w.n_windows[0] + w.n_windows[1]) / (double)n_windows,
         (double)n_tests / (double)n_windows, table.D_c,
         (double)n_inherited / (double)n_windows,
         (double)n_hidden / (double)n_windows, n_faces);
  free(w.settled);
  free(w.of_face);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

int main(void) {
  static const char *const names[] = {"warnock", "warnock-vertices"};
  struct tap tap = plan(8);
  for (int a = 0; a < 2; a++) {
    const struct hsr_algorithm *algorithm =
        hsr_algorithm_find(names[a])->counting;
    struct findings f = {0};
    for (int k = 0; k < N_SCENES; k++)
      watch_scene(algorithm, scene_names[k], &f);
    ok(&tap, f.n_repeated == 0 && f.n_tests > 0,
       "%s: surrounders and disjoints are inherited; %ld of %ld tests could "
       "have been",
       names[a], f.n_repeated, f.n_tests);
    ok(&tap, f.n_unaccounted == 0,
       "%s: a relation is tested, inherited, or of no account since the face "
       "is hidden; %ld are neither",
       names[a], f.n_unaccounted);
    ok(&tap, f.n_windows_amiss == 0,
       "%s: a window is decided or divided; %ld are neither", names[a],
       f.n_windows_amiss);
    ok(&tap, 5 * f.n_low > 4 * f.n_windows,
       "%s: most windows lie near the leaves: %ld of %ld at most one level "
       "above",
       names[a], f.n_low, f.n_windows);
  }
  return finish(&tap);
}
