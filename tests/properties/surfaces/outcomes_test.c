/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Events of the algorithms that draw faces are true: what an event says about
 * its subjects in its window is checked by common/exact/screen.h.
 *
 * Depths        "nearer" and "in front": a is nearer than b at the first sample
 *               of the window; "farther" and "behind": it is not. Watkins'
 *               "undecided" says nothing.
 * Covers        a covers the window's one sample, or all samples, if the
 *               outcome says so.
 * Relations     a surrounder covers all samples of the window, a disjoint face
 *               none.
 * Edges         "to the left": on the window's row, the column of edge a is
 *               less than that of b. An edge is sorted by Y into its first row
 *               in the picture, up to its last. Edge a crosses the window's
 *               row, or does not; only for whole faces.
 * Bits          a bit that is turned on was off; at first all bits are off.
 * Vertices      "in front", "behind", "on the plane": as the vertex is, seen
 *               from the eye.
 * Never before  at no sample of both is face a nearer than b; only for whole
 *               faces, not for pieces of divided ones.
 * Apart, meet   no sample is in both, or one is; also only for whole faces.
 * Sorted by Z   the farthest vertex of a is farther than that of b, or is not.
 *
 * Events of the list-priority algorithms are those of the adapted world, and
 * their faces, too. */
#include "bench/modules/modules.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include "common/exact/order.h"
#include "common/exact/screen.h"

#include <stdlib.h>

enum { M = 41, N = 29, MOST_FACES = 1 << 14 };

static const char *const image_scenes[] = {
    "house",       "cyclic-overlap", "lattice:40:3", "coplanar",
    "penetration", "deep-stack",     "one-sided",    "nested-solids",
    "needle-fan",  "sphere",         "soup:4000:1",  "terrain:32",
    NULL};
static const char *const list_scenes[] = {
    "house",      "cyclic-overlap", "lattice:40:3", "coplanar",   "penetration",
    "deep-stack", "one-sided",      "non-planar",   "near-plane", NULL};

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
  SORTED, /* by Y */
  VERTEX_ON,
  VERTEX_BEFORE,
  VERTEX_BEHIND,
  TURNED_OFF,
  TURNED_ON,
  NEVER_BEFORE,
  APART,
  MEET,
  BEHIND_B, /* a covers the sample, and so does b, which is nearer */
  FARTHER,  /* by Z */
  NOT_FARTHER,
  CROSSES,
  DOES_NOT_CROSS,
  OTHER_PLANE /* a and b are in different planes */
};

struct rule {
  const char *algorithm, *counter;
  enum claim claim[9];
  bool rare; /* there may be no such event */
};
static const struct rule image_rules[] = {
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
    {"warnock-vertices", "inherited surrounders", {ALL_COVERED}},
    {NULL, NULL, {0}}};
static const struct rule list_rules[] = {
    {"newell",
     "Newell special",
     {NEVER_BEFORE, NEVER_BEFORE, APART, APART, NEVER_BEFORE, NEVER_BEFORE,
      APART, NOTHING_SAID, MEET}},
    {"newell", "plane tests", {NEVER_BEFORE, NEVER_BEFORE}},
    {"newell", "overlap tests", {MEET, APART, APART}},
    {"newell", "divisions", {OTHER_PLANE}},
    {"newell", "circle search", {NOTHING_SAID, OTHER_PLANE}},
    {"newell", "segments", {ALL_COVERED}},
    {"newell-previous", "Newell special", {NEVER_BEFORE, NEVER_BEFORE, APART}},
    {"newell-frame-buffer", "segments", {ALL_COVERED}},
    {"newell-frame-buffer", "spans written", {ALL_COVERED}},
    {"schumacker-newell", "segments", {ALL_COVERED}},
    {"schumacker-watkins", "depth search", {NOTHING_SAID, NOT_NEARER, NEARER}},
    {"schumacker-watkins", "thickness checks", {NOT_NEARER, NEARER}, true},
    {"schumacker-watkins", "loose samples", {COVERED}},
    {"newell-watkins", "Newell special", {NEVER_BEFORE, NEVER_BEFORE, APART}},
    {"painter", "Z sort", {NOT_FARTHER, FARTHER}},
    {"painter", "samples", {COVERED}},
    {"schumacker", "Y cull", {DOES_NOT_CROSS, CROSSES}},
    {"schumacker", "counter pairs", {ALL_COVERED}},
    {"schumacker", "priority search", {NOT_COVERED, COVERED, COVERED}},
    {"schumacker", "thickness checks", {NOT_NEARER, NEARER}, true},
    {"schumacker", "samples shown", {COVERED}},
    {"bsp-painter", "samples", {COVERED}},
    {"bsp-painter", "overwrites", {BEHIND_B}},
    {"bsp-front", "samples", {COVERED}},
    {"bsp-front", "samples taken", {BEHIND_B}},
    {NULL, NULL, {0}}};

struct watch {
  const struct hsr_screen *screen;
  struct hsr_tally own;
  const struct rule *rule;
  const struct hsr_algorithm *algorithm;
  int counter;
  long events, wrong;
  long said[9]; /* events of each outcome */
  bool on[MOST_FACES];
};

/* --- Asking anew ---------------------------------------------------------- */

static bool covers(struct watch *w, uint32_t f, int i, int j) {
  return f == HSR_BACKGROUND || hsr_covers(w->screen, f, i, j, &w->own);
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

/* How a vertex lies to the plane of g: 0, or positive if it is before it. It is
 * in the planes of all its faces, so any of them will do. */
static int vertex_nearer(struct watch *w, uint32_t vertex, uint32_t g) {
  const struct hsr_world *world = w->screen->world;
  int nearer = 0;
  for (uint32_t h = 0; h < world->n_faces && !nearer; h++)
    for (uint32_t k = world->mesh.start[h]; k < world->mesh.start[h + 1]; k++)
      if (world->mesh.vertex[k] == vertex && w->screen->whole[h] && h != g)
        nearer = hsr_vertex_nearer(w->screen, h, g, vertex, &w->own);
  return nearer;
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

static bool is_farther(const struct watch *w, uint32_t a, uint32_t b) {
  double far_a = farthest(w, a), far_b = farthest(w, b);
  return far_a != far_b ? far_a > far_b : a > b;
}

static bool crosses(struct watch *w, const struct hsr_event *e) {
  int first = hsr_vertex_row(w->screen, e->a.id[0], &w->own);
  int end = hsr_vertex_row(w->screen, e->a.id[1], &w->own);
  return first < end ? e->window.y0 >= first && e->window.y0 < end
                     : e->window.y0 >= end && e->window.y0 < first;
}

/* Of whole faces: whether they share samples, and if a is nearer in one. */
static bool is_true_of_both(struct watch *w, const struct hsr_event *e,
                            enum claim claim) {
  long both, nearer;
  if (!is_whole(w, &e->a) || !is_whole(w, &e->b))
    return true;
  share(w, e->a.id[0], e->b.id[0], &both, &nearer);
  return claim == NEVER_BEFORE ? !nearer : (claim == MEET) == (both > 0);
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
    nearer = vertex_nearer(w, f, g);
    return claim == VERTEX_ON       ? !nearer
           : claim == VERTEX_BEFORE ? nearer > 0
                                    : nearer < 0;
  case TURNED_OFF:
  case TURNED_ON:
    w->on[f] = !w->on[f];
    return w->on[f] == (claim == TURNED_ON);
  case NEVER_BEFORE:
  case APART:
  case MEET:
    return is_true_of_both(w, e, claim);
  case BEHIND_B:
    return f != g && covers(w, f, i, j) && covers(w, g, i, j) &&
           hsr_nearer(w->screen, g, f, i, j, &w->own);
  case FARTHER:
  case NOT_FARTHER:
    return is_farther(w, f, g) == (claim == FARTHER);
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
  w->said[event->outcome]++;
  w->wrong += !is_true(w, event);
}

/* In the adapted world, whose faces events name then; draw_ids has the scene's.
 */
static void draw_adapted(struct watch *w, const struct hsr_setup *setup,
                         const struct hsr_view *view, struct hsr_tally *tally) {
  static uint32_t ids[M * N];
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
  struct hsr_job job = {.world = setup->world,
                        .view = view,
                        .prepared = setup->prepared,
                        .option = setup->choice.values.option,
                        .scratch = &scratch,
                        .tally = tally,
                        .answer = &answer};
  hsr_tally_begin(tally, w->algorithm);
  if (w->algorithm->render(&job, &err))
    bail("%s: %s", w->algorithm->name, err.text);
  hsr_arena_free(&scratch);
}

static void watch_scene(struct watch *w, const char *name, bool adapted) {
  static uint32_t ids[M * N];
  struct hsr_error err = {.text = "out of memory"};
  struct both_worlds worlds;
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_screen screen;
  struct hsr_view view;
  struct hsr_setup setup;
  open_worlds(&worlds, name);
  must_view(&view, &worlds.scene->views[0], M, N);
  must_setup(&setup, w->algorithm, NULL, &worlds.world);
  if (hsr_screen_make(&screen, adapted ? setup.world : &worlds.world, &view,
                      &arena, &w->own) ||
      screen.world->n_faces > MOST_FACES)
    bail("%s: %s", name, err.text);
  w->screen = &screen;
  struct hsr_trace trace = {.listen = listen, .context = w};
  struct hsr_tally tally = {.trace = &trace};
  if (adapted)
    draw_adapted(w, &setup, &view, &tally);
  else
    draw_ids(w->algorithm, &worlds.world, &view, ids, &tally);
  hsr_setup_free(&setup);
  hsr_arena_free(&arena);
  close_worlds(&worlds);
}

static void check_rules(struct tap *tap, const struct rule *rule,
                        const char *const *scenes, bool adapted) {
  for (; rule->algorithm; rule++) {
    static struct watch w;
    w = (struct watch){.rule = rule,
                       .algorithm = find_counting(rule->algorithm)};
    w.counter = counter_of(w.algorithm, rule->counter);
    for (int s = 0; scenes[s]; s++)
      watch_scene(&w, scenes[s], adapted);
    ok(tap, (w.events || rule->rare) && !w.wrong,
       "%s, %s: %ld of %ld events are not true (outcomes: %ld, %ld, %ld)",
       rule->algorithm, rule->counter, w.wrong, w.events, w.said[0], w.said[1],
       w.said[2]);
  }
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
    must_view(&view, &worlds.scene->views[v], M, N);
    draw_plain(name, &worlds.world, &view, got);
    draw_plain("raycast", &worlds.world, &view, wanted);
    differ += count_differences(&view, got, wanted);
  }
  close_worlds(&worlds);
  ok(tap, !differ, "%s: faces that are not flat (%ld wrong)", name, differ);
}

int main(void) {
  enum { N_IMAGE = sizeof image_rules / sizeof *image_rules - 1 };
  enum { N_LIST = sizeof list_rules / sizeof *list_rules - 1 };
  struct tap tap = plan(N_IMAGE + N_LIST + 5);
  check_loose(&tap, "schumacker");
  check_loose(&tap, "schumacker-newell");
  check_loose(&tap, "schumacker-watkins");
  check_loose(&tap, "schumacker-newell-watkins");
  check_loose(&tap, "bsp-painter");
  check_rules(&tap, image_rules, image_scenes, false);
  check_rules(&tap, list_rules, list_scenes, true);
  return finish(&tap);
}
