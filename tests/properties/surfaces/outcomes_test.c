/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Events of the image-space algorithms are true: what an event says about its
 * subjects in its window is checked by common/exact/screen.h.
 *
 * Depths      "nearer" and "in front": a is nearer than b at the first sample
 *             of the window; "farther" and "behind": it is not. Watkins'
 *             "undecided" says nothing.
 * Covers      a covers the window's one sample, if the outcome says so.
 * Relations   a surrounder covers all samples of the window, a disjoint face
 *             none.
 * Edges       "to the left": on the window's row, the column of edge a is less
 *             than that of b. An edge is sorted by Y into its first row in the
 *             picture, up to its last.
 * Bits        a bit that is turned on was off; at first all bits are off.
 * Vertices    "in front", "behind", "on the plane": as the vertex is, seen from
 *             the eye. */
#include "bench/modules/modules.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include "common/exact/screen.h"

#include <stdlib.h>

enum { M = 41, N = 29, MOST_FACES = 1 << 14 };

static const char *const scenes[] = {
    "house",       "cyclic-overlap", "lattice:40:3", "coplanar",
    "penetration", "deep-stack",     "one-sided",    "nested-solids",
    "needle-fan",  "sphere",         "soup:4000:1",  "terrain:32"};
enum { N_SCENES = sizeof scenes / sizeof *scenes };

/* The claims that the outcomes of a counter make, in their order. */
enum claim {
  NOTHING_SAID,
  NEARER,
  NOT_NEARER,
  COVERED,
  NOT_COVERED,
  ALL_COVERED,
  NONE_COVERED,
  LEFT,
  NOT_LEFT,
  SORTED,
  VERTEX_ON,
  VERTEX_BEFORE,
  VERTEX_BEHIND,
  TURNED_OFF,
  TURNED_ON
};

static const struct rule {
  const char *algorithm, *counter;
  enum claim claim[3];
} rules[] = {
    {"raycast", "surround tests", {NOT_COVERED, COVERED}},
    {"raycast", "depth tests", {NOT_NEARER, NEARER}},
    {"zbuffer-fast", "depth tests", {NOT_NEARER, NEARER}},
    {"zbuffer-fast", "unsure depths", {NOT_NEARER, NEARER}},
    {"zbuffer-fast", "unsure covers", {NOT_COVERED, COVERED}},
    {"watkins", "Y sort", {SORTED}},
    {"watkins", "X merge", {NOT_LEFT, LEFT}},
    {"watkins", "X sort", {NOT_LEFT, LEFT}},
    {"watkins", "X interchanges", {LEFT}},
    {"watkins", "depth search", {NOTHING_SAID, NOT_NEARER, NEARER}},
    {"bouknight", "depth search", {NOT_NEARER, NEARER}},
    {"bouknight", "span cull", {TURNED_OFF, TURNED_ON}},
    {"romney", "depth search", {NOT_NEARER, NEARER}},
    {"yzx", "implied edges", {NOT_NEARER, NEARER}},
    {"yzx", "priority tests", {NOT_NEARER, NEARER}},
    {"yzx", "Z sort", {VERTEX_ON, VERTEX_BEFORE, VERTEX_BEHIND}},
    {"warnock", "Warnock special", {NONE_COVERED, NOTHING_SAID, ALL_COVERED}},
    {"warnock", "minimax culls", {NONE_COVERED, NOTHING_SAID}},
    {"warnock", "depth search", {NOTHING_SAID, NOT_NEARER, NEARER}},
    {"warnock", "inherited surrounders", {ALL_COVERED}},
    {"warnock-vertices", "inherited surrounders", {ALL_COVERED}}};
enum { N_RULES = sizeof rules / sizeof *rules };

struct watch {
  const struct hsr_screen *screen;
  struct hsr_tally own;
  const struct rule *rule;
  int counter;
  long events, wrong;
  long said[3]; /* events of each outcome */
  bool on[MOST_FACES];
};

/* --- Asking anew ---------------------------------------------------------- */

static bool covers(struct watch *w, uint32_t f, int i, int j) {
  return hsr_covers(w->screen, f, i, j, &w->own);
}

static bool covers_all(struct watch *w, const struct hsr_event *e, bool all) {
  for (int j = e->window.y0; j < e->window.y1; j++)
    for (int i = e->window.x0; i < e->window.x1; i++)
      if (covers(w, e->a.id[0], i, j) != all)
        return false;
  return true;
}

/* The column of an edge on row j; false if it belongs to a cut face. */
static bool find_column(struct watch *w, const struct hsr_subject *edge, int j,
                        int *column) {
  struct hsr_edge line;
  if (edge->id[0] == HSR_NO_ID)
    return false;
  hsr_edge_init(&line, w->screen, edge->id[0], edge->id[1]);
  *column = hsr_edge_column(w->screen, &line, j, &w->own);
  return true;
}

static bool is_left(struct watch *w, const struct hsr_event *e, bool left) {
  int a, b;
  return !find_column(w, &e->a, e->window.y0, &a) ||
         !find_column(w, &e->b, e->window.y0, &b) || (a < b) == left;
}

static bool is_sorted(struct watch *w, const struct hsr_event *e) {
  if (e->a.id[0] == HSR_NO_ID)
    return true;
  int first = hsr_vertex_row(w->screen, e->a.id[0], &w->own);
  int end = hsr_vertex_row(w->screen, e->a.id[1], &w->own);
  return first < end && e->window.y0 == first && e->window.y1 == end;
}

static bool is_true(struct watch *w, const struct hsr_event *e) {
  enum claim claim = w->rule->claim[e->outcome];
  uint32_t f = e->a.id[0], g = e->b.id[0];
  int i = e->window.x0, j = e->window.y0, nearer;
  switch (claim) {
  case NEARER:
  case NOT_NEARER:
    if (e->b.kind != HSR_OF_FACE || g == HSR_BACKGROUND || f == g)
      return claim == NEARER;
    return hsr_nearer(w->screen, f, g, i, j, &w->own) == (claim == NEARER);
  case COVERED:
  case NOT_COVERED:
    return covers(w, f, i, j) == (claim == COVERED);
  case ALL_COVERED:
  case NONE_COVERED:
    return covers_all(w, e, claim == ALL_COVERED);
  case LEFT:
  case NOT_LEFT:
    return is_left(w, e, claim == LEFT);
  case SORTED:
    return is_sorted(w, e);
  case VERTEX_ON:
  case VERTEX_BEFORE:
  case VERTEX_BEHIND:
    /* The vertex is in the planes of all its faces, so any of them will do. */
    nearer = 0;
    for (uint32_t h = 0; h < w->screen->world->n_faces && !nearer; h++)
      for (uint32_t k = w->screen->world->mesh.start[h];
           k < w->screen->world->mesh.start[h + 1]; k++)
        if (w->screen->world->mesh.vertex[k] == f && w->screen->whole[h] &&
            h != g)
          nearer = hsr_vertex_nearer(w->screen, h, g, f, &w->own);
    return claim == VERTEX_ON       ? !nearer
           : claim == VERTEX_BEFORE ? nearer > 0
                                    : nearer < 0;
  case TURNED_OFF:
  case TURNED_ON:
    w->on[f] = !w->on[f];
    return w->on[f] == (claim == TURNED_ON);
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
  w->said[event->outcome]++;
  w->wrong += !is_true(w, event);
}

static int counter_of_rule(const struct rule *rule) {
  return counter_of(hsr_algorithm_find(rule->algorithm)->counting,
                    rule->counter);
}

static void watch_scene(struct watch *w, const char *name) {
  static uint32_t ids[M * N];
  struct both_worlds worlds;
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_screen screen;
  struct hsr_view view;
  open_worlds(&worlds, name);
  if (hsr_view_init(&view, &worlds.scene->views[0], M, N, NULL) ||
      hsr_screen_make(&screen, &worlds.world, &view, &arena, &w->own))
    abort();
  if (worlds.world.n_faces > MOST_FACES)
    abort();
  w->screen = &screen;
  struct hsr_trace trace = {.listen = listen, .context = w};
  struct hsr_tally tally = {.trace = &trace};
  draw_ids(hsr_algorithm_find(w->rule->algorithm)->counting, &worlds.world,
           &view, ids, &tally);
  hsr_arena_free(&arena);
  close_worlds(&worlds);
}

int main(void) {
  struct tap tap = plan(N_RULES);
  for (int r = 0; r < N_RULES; r++) {
    static struct watch w;
    w = (struct watch){.rule = &rules[r],
                       .counter = counter_of_rule(&rules[r])};
    for (int s = 0; s < N_SCENES; s++)
      watch_scene(&w, scenes[s]);
    ok(&tap, w.events && !w.wrong,
       "%s, %s: %ld of %ld events are not true (outcomes: %ld, %ld, %ld)",
       rules[r].algorithm, rules[r].counter, w.wrong, w.events, w.said[0],
       w.said[1], w.said[2]);
  }
  return finish(&tap);
}
