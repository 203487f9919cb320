/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Events of the list-priority algorithms are true: what an event says about its
 * subjects is checked by common/exact/screen.h, sample by sample. Faces are
 * those of the adapted world.
 *
 * Never before  at no sample of both is face a nearer than b; only for whole
 *               faces, not for pieces of divided ones
 * Apart, meet   no sample is in both, or one is; also only for whole faces
 * Covers        a covers the window's one sample, or all samples, or does not
 * Depths        a is nearer than b at the window's first sample, or is not
 * Sorted        the farthest vertex of a is farther than that of b, or is not
 * Crosses       edge a crosses the window's row, or does not; only for whole
 *               faces */
#include "bench/modules/modules.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include "common/exact/order.h"
#include "common/exact/screen.h"

#include <stdlib.h>

enum { M = 41, N = 29 };

static const char *const scenes[] = {
    "house",      "cyclic-overlap", "lattice:40:3", "coplanar",  "penetration",
    "deep-stack", "one-sided",      "non-planar",   "near-plane"};
enum { N_SCENES = sizeof scenes / sizeof *scenes };

/* The claims that the outcomes of a counter make, in their order. */
enum claim {
  NOTHING_SAID,
  NEVER_BEFORE,
  APART,
  MEET,
  COVERED,
  NOT_COVERED,
  ALL_COVERED,
  NEARER,
  NOT_NEARER,
  BEHIND_B, /* a covers the sample, and so does b, which is nearer */
  SORTED,
  NOT_SORTED,
  CROSSES,
  DOES_NOT_CROSS,
  OTHER_PLANE /* a and b are in different planes */
};

static const struct rule {
  const char *algorithm, *counter;
  enum claim claim[9];
} rules[] = {
    {"newell",
     "Newell special",
     {NEVER_BEFORE, NEVER_BEFORE, APART, APART, NEVER_BEFORE, NEVER_BEFORE,
      APART, NOTHING_SAID, MEET}},
    {"newell", "plane tests", {MEET, NEVER_BEFORE}},
    {"newell", "overlap tests", {MEET, APART}},
    {"newell", "divisions", {OTHER_PLANE}},
    {"newell", "circle search", {NOTHING_SAID, OTHER_PLANE}},
    {"newell", "segments", {ALL_COVERED}},
    {"newell-previous", "Newell special", {NEVER_BEFORE, NEVER_BEFORE, APART}},
    {"newell-frame-buffer", "segments", {ALL_COVERED}},
    {"newell-frame-buffer", "spans written", {ALL_COVERED}},
    {"schumacker-newell", "segments", {ALL_COVERED}},
    {"schumacker-watkins", "depth search", {NOTHING_SAID, NOT_NEARER, NEARER}},
    {"schumacker-watkins", "thickness checks", {NOT_NEARER, NEARER}},
    {"schumacker-watkins", "loose samples", {COVERED}},
    {"newell-watkins", "Newell special", {NEVER_BEFORE, NEVER_BEFORE, APART}},
    {"painter", "Z sort", {NOT_SORTED, SORTED}},
    {"painter", "samples", {COVERED}},
    {"schumacker", "Y cull", {DOES_NOT_CROSS, CROSSES}},
    {"schumacker", "counter pairs", {ALL_COVERED}},
    {"schumacker", "priority search", {NOT_COVERED, COVERED, COVERED}},
    {"schumacker", "thickness checks", {NOT_NEARER, NEARER}},
    {"schumacker", "samples shown", {COVERED}},
    {"bsp-painter", "samples", {COVERED}},
    {"bsp-painter", "overwrites", {BEHIND_B}},
    {"bsp-front", "samples", {COVERED}},
    {"bsp-front", "samples taken", {BEHIND_B}}};
enum { N_RULES = sizeof rules / sizeof *rules };

struct watch {
  const struct hsr_screen *screen;
  struct hsr_tally own;
  const struct rule *rule;
  int counter;
  long events, wrong;
};

/* --- Asking anew ---------------------------------------------------------- */

static bool covers(struct watch *w, uint32_t f, int i, int j) {
  return f == HSR_BACKGROUND || hsr_covers(w->screen, f, i, j, &w->own);
}

static bool covers_all(struct watch *w, const struct hsr_event *e) {
  bool all = true;
  for (int j = e->window.y0; j < e->window.y1; j++)
    for (int i = e->window.x0; i < e->window.x1; i++)
      all &= covers(w, e->a.id[0], i, j);
  return all;
}

/* A whole face, or the piece that it is before any division. */
static bool is_whole(const struct watch *w, const struct hsr_subject *s) {
  return s->kind == HSR_OF_FACE ||
         (s->kind == HSR_OF_PIECE && s->id[1] < w->screen->n_relevant);
}

/* Counts the samples that are in a and in b, and those where a is nearer. */
static void share(struct watch *w, uint32_t a, uint32_t b, long *both,
                  long *nearer) {
  *both = *nearer = 0;
  for (int j = 0; j < N; j++)
    for (int i = 0; i < M; i++)
      if (covers(w, a, i, j) && covers(w, b, i, j)) {
        (*both)++;
        *nearer += a != b && hsr_nearer(w->screen, a, b, i, j, &w->own);
      }
}

static double farthest(const struct watch *w, uint32_t f) {
  double near, far;
  hsr_depth_range(w->screen, (struct hsr_polygon){.face = f}, &near, &far);
  return far;
}

static bool is_sorted(const struct watch *w, uint32_t a, uint32_t b) {
  double far_a = farthest(w, a), far_b = farthest(w, b);
  return far_a != far_b ? far_a > far_b : a > b;
}

static bool crosses(struct watch *w, const struct hsr_event *e) {
  int first = hsr_vertex_row(w->screen, e->a.id[0], &w->own);
  int end = hsr_vertex_row(w->screen, e->a.id[1], &w->own);
  return first < end ? e->window.y0 >= first && e->window.y0 < end
                     : e->window.y0 >= end && e->window.y0 < first;
}

static bool is_true(struct watch *w, const struct hsr_event *e) {
  enum claim claim = w->rule->claim[e->outcome];
  uint32_t f = e->a.id[0], g = e->b.id[0];
  int i = e->window.x0, j = e->window.y0;
  long both = 0, nearer = 0;
  if (claim == NEVER_BEFORE || claim == APART || claim == MEET) {
    if (!is_whole(w, &e->a) || !is_whole(w, &e->b))
      return true;
    share(w, f, g, &both, &nearer);
  }
  switch (claim) {
  case NEVER_BEFORE:
    return !nearer;
  case APART:
    return !both;
  case MEET:
    return both;
  case COVERED:
  case NOT_COVERED:
    return covers(w, f, i, j) == (claim == COVERED);
  case ALL_COVERED:
    return covers_all(w, e);
  case NEARER:
  case NOT_NEARER:
    return hsr_nearer(w->screen, f, g, i, j, &w->own) == (claim == NEARER);
  case BEHIND_B:
    return f != g && covers(w, f, i, j) && covers(w, g, i, j) &&
           hsr_nearer(w->screen, g, f, i, j, &w->own);
  case SORTED:
  case NOT_SORTED:
    return is_sorted(w, f, g) == (claim == SORTED);
  case CROSSES:
  case DOES_NOT_CROSS:
    f = e->a.id[2];
    return !w->screen->whole[f] || w->screen->world->mesh.deviation[f] > 0 ||
           crosses(w, e) == (claim == CROSSES);
  case OTHER_PLANE:
    return w->screen->world->mesh.plane[f] != w->screen->world->mesh.plane[g];
  default:
    return true;
  }
}

/* --- Watching ------------------------------------------------------------- */

static void listen(void *context, const struct hsr_event *event) {
  struct watch *w = context;
  if (event->counter != w->counter)
    return;
  w->events++;
  w->wrong += !is_true(w, event);
}

static int counter_of_rule(const struct rule *rule) {
  return counter_of(hsr_algorithm_find(rule->algorithm)->counting,
                    rule->counter);
}

/* Not by draw_ids: events name the faces of the adapted world here. */
static void watch_scene(struct watch *w, const char *name) {
  static uint32_t ids[M * N];
  struct hsr_error err = {.text = "out of memory"};
  struct both_worlds worlds;
  struct hsr_arena arena = HSR_ARENA_EMPTY, scratch = HSR_ARENA_EMPTY;
  struct hsr_screen screen;
  struct hsr_view view;
  struct hsr_setup setup;
  const struct hsr_algorithm *a =
      hsr_algorithm_find(w->rule->algorithm)->counting;
  open_worlds(&worlds, name);
  if (hsr_view_init(&view, &worlds.scene->views[0], M, N, NULL) ||
      hsr_setup_init(&setup, a, NULL, &worlds.world, &err) ||
      hsr_screen_make(&screen, setup.world, &view, &arena, &w->own))
    abort();
  w->screen = &screen;
  struct hsr_trace trace = {.listen = listen, .context = w};
  struct hsr_tally tally = {.trace = &trace};
  struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
  struct hsr_job job = {.world = setup.world,
                        .view = &view,
                        .prepared = setup.prepared,
                        .option = setup.choice.values.option,
                        .scratch = &scratch,
                        .tally = &tally,
                        .answer = &answer};
  hsr_tally_begin(&tally, a);
  if (a->render(&job, &err))
    abort();
  hsr_setup_free(&setup);
  hsr_arena_free(&arena);
  hsr_arena_free(&scratch);
  close_worlds(&worlds);
}

/* --- Faces without a place in the order ----------------------------------- */

/* Faces that are not flat have no place in the order of clusters and are
 * painted last. The picture is right, and they are in it. */
static void check_loose(struct tap *tap, const char *name) {
  static uint32_t got[M * N], wanted[M * N];
  struct both_worlds worlds;
  long differ = 0;
  open_worlds(&worlds, "non-planar");
  for (uint32_t v = 0; v < worlds.scene->n_views; v++) {
    struct hsr_view view;
    if (hsr_view_init(&view, &worlds.scene->views[v], M, N, NULL))
      abort();
    draw_ids(hsr_algorithm_find(name)->plain, &worlds.world, &view, got, NULL);
    draw_ids(hsr_algorithm_find("raycast")->plain, &worlds.world, &view, wanted,
             NULL);
    differ += count_differences(&view, got, wanted);
  }
  close_worlds(&worlds);
  ok(tap, !differ, "%s: faces that are not flat (%ld wrong)", name, differ);
}

int main(void) {
  struct tap tap = plan(N_RULES + 4);
  check_loose(&tap, "schumacker");
  check_loose(&tap, "schumacker-newell");
  check_loose(&tap, "schumacker-watkins");
  check_loose(&tap, "bsp-painter");
  for (int r = 0; r < N_RULES; r++) {
    struct watch w = {.rule = &rules[r], .counter = counter_of_rule(&rules[r])};
    for (int s = 0; s < N_SCENES; s++)
      watch_scene(&w, scenes[s]);
    ok(&tap, !w.wrong, "%s, %s: %ld of %ld events are not true",
       rules[r].algorithm, rules[r].counter, w.wrong, w.events);
  }
  return finish(&tap);
}
