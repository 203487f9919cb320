/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Events of the line algorithms are true: what an event says about its subjects
 * is checked by common/lines.
 *
 * Side         edge a bounds face b
 * Corner       face b has a corner at an end of edge a, which does not bound it
 * End          vertex b, or a, is an end of the edge
 * Related      edges a and b cross in the picture, or share a vertex, as the
 *              outcome says; and b is nearer there, or farther
 * Hides        face b hides vertex a, or does not */
#include "bench/modules/modules.h"
#include "tests/counts/by_hand/objects.h"

#include "algorithms/object_space/edges/edge_intersection.h"

#include <stdlib.h>
#include <string.h>

enum { M = 41, N = 29 };

static const char *const scenes[] = {"house",       "cyclic-overlap",
                                     "penetration", "lattice:40:3",
                                     "coplanar",    "near-plane"};
enum { N_SCENES = sizeof scenes / sizeof *scenes };

enum claim {
  SIDE,
  CORNER,
  END_B,
  END_A,
  RELATED, /* by the outcomes of the edge intersection */
  CROSSES, /* by two outcomes: farther, nearer */
  CROSSES_NEARER,
  HIDES,
  NOT_A_SIDE
};

static const struct rule {
  const char *algorithm, *counter;
  enum claim claim;
} rules[] = {{"appel", "edge cull", SIDE},
             {"appel", "searches", END_B},
             {"appel", "promoted", END_A},
             {"appel", "initial visibility", HIDES},
             {"appel", "edge intersection", RELATED},
             {"appel", "crossings", CROSSES_NEARER},
             {"appel", "correction", CORNER},
             {"appel", "pierced faces", NOT_A_SIDE},
             {"loutrel", "edge intersection", RELATED},
             {"loutrel", "plane intersections", CROSSES},
             {"loutrel", "nearer boundary edges", CROSSES_NEARER},
             {"galimberti", "edge intersection", RELATED},
             {"galimberti", "initial visibility", HIDES},
             {"galimberti", "hiding", HIDES},
             {"galimberti", "correction", CORNER},
             {"galimberti", "promoted", END_A},
             {"warnock-edges", "edge intersection", RELATED},
             {"warnock-edges", "crossings confirmed", CROSSES},
             {"roberts", "back-edge cull", SIDE},
             {"roberts", "faces apart", NOT_A_SIDE}};
enum { N_RULES = sizeof rules / sizeof *rules };

struct watch {
  const struct hsr_edges *edges;
  const struct hsr_sight *sight;
  const struct rule *rule;
  int counter;
  long events, wrong;
};

/* --- Asking anew ---------------------------------------------------------- */

/* The number of an edge; false if it has none. */
static bool find_edge(const struct watch *w, const struct hsr_subject *s,
                      uint32_t *e) {
  const struct hsr_edges *edges = w->edges;
  bool implied = s->kind == HSR_OF_IMPLIED;
  for (*e = 0; *e < edges->n; (*e)++) {
    const struct hsr_edge_name *name = &edges->name[*e];
    if (name->implied == implied &&
        (implied ? name->a == s->id[0] && name->b == s->id[1] &&
                       name->part == s->id[2]
                 : edges->a[*e] == s->id[0] && edges->b[*e] == s->id[1]))
      return true;
  }
  return false;
}

static bool is_end(const struct watch *w, uint32_t e,
                   const struct hsr_subject *v) {
  return v->kind == HSR_OF_NOTHING || w->edges->a[e] == v->id[0] ||
         w->edges->b[e] == v->id[0];
}

static bool cross(const struct watch *w, uint32_t e, uint32_t c) {
  return !hsr_edges_meet(w->edges, e, c) && hsr_images_cross(w->sight, e, c);
}

static bool are_related(const struct watch *w, uint32_t e, uint32_t c,
                        int outcome) {
  switch ((enum hsr_crossing)outcome) {
  case HSR_BOXES_APART:
    return hsr_edges_meet(w->edges, e, c) || !cross(w, e, c);
  case HSR_SHARE_A_VERTEX:
    return hsr_edges_meet(w->edges, e, c);
  case HSR_DO_NOT_CROSS:
    return !hsr_edges_meet(w->edges, e, c) && !cross(w, e, c);
  case HSR_CROSSES_FARTHER:
  case HSR_CROSSES_NEARER:
    return cross(w, e, c) &&
           hsr_sight_nearer(w->sight, e, c) == (outcome == HSR_CROSSES_NEARER);
  }
  return false;
}

static bool hides(const struct watch *w, uint32_t f, uint32_t p) {
  return !hsr_is_corner(w->edges, p, f) && hsr_sight_covers(w->sight, f, p) &&
         hsr_sight_behind(w->sight, f, p);
}

static bool is_true(const struct watch *w, const struct hsr_event *event) {
  uint32_t e = 0, c = 0, f = event->b.id[0];
  enum claim claim = w->rule->claim;
  if (claim == HIDES)
    return event->a.kind == HSR_OF_NOTHING ||
           hides(w, f, event->a.id[0]) ==
               (event->outcome == 1 || !strcmp(w->rule->counter, "hiding"));
  if (claim == END_A)
    return find_edge(w, &event->b, &e) && is_end(w, e, &event->a);
  if (!find_edge(w, &event->a, &e))
    return false;
  switch (claim) {
  case SIDE:
    return hsr_is_own(w->edges, e, f);
  case NOT_A_SIDE:
    return !hsr_is_own(w->edges, e, f);
  case CORNER:
    return !hsr_is_own(w->edges, e, f) &&
           (hsr_is_corner(w->edges, w->edges->a[e], f) ||
            hsr_is_corner(w->edges, w->edges->b[e], f));
  case END_B:
    return is_end(w, e, &event->b);
  default:
    break;
  }
  if (!find_edge(w, &event->b, &c))
    return false;
  return claim == RELATED ? are_related(w, e, c, event->outcome)
         : claim == CROSSES
             ? are_related(w, e, c, HSR_CROSSES_FARTHER + event->outcome)
             : are_related(w, e, c, HSR_CROSSES_NEARER);
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

static void watch_scene(struct watch *w, const char *name) {
  struct hsr_error err = {.text = "out of memory"};
  struct both_worlds worlds;
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_edges edges;
  struct hsr_sight sight;
  struct hsr_view view;
  struct hsr_tally own = {.out_of_memory = false};
  struct hsr_drawing drawing = {.n = 0};
  open_worlds(&worlds, name);
  must_view(&view, &worlds.scene->views[0], M, N);
  if (hsr_edges_init(&edges, &worlds.world, &err) ||
      hsr_sight_init(&sight, &edges, &view, &arena, &own))
    abort();
  w->edges = &edges;
  w->sight = &sight;
  struct hsr_trace trace = {.listen = listen, .context = w};
  struct hsr_tally tally = {.trace = &trace};
  draw_lines(hsr_algorithm_find(w->rule->algorithm)->counting, &worlds.world,
             &view, &drawing, &tally);
  hsr_drawing_free(&drawing);
  hsr_sight_free(&sight);
  hsr_edges_free(&edges);
  hsr_arena_free(&arena);
  close_worlds(&worlds);
}

/* --- Edges whose images are not known ------------------------------------- */

/* The left ends of N are so far away that its long edges have no coordinates,
 * so warnock-edges cannot sort them. Its upper edge crosses those of F. */
static const struct hand_object far_away[] = {
    HAND_RECTANGLE(2, 2, 10, 6, 8), HAND_RECTANGLE(-1e6, 4, 12, 7, 4)};

static void draw_far_away(const char *name, const struct hand_picture *p,
                          struct hsr_drawing *drawing) {
  const struct hsr_algorithm *a = hsr_algorithm_find(name)->counting;
  *drawing = (struct hsr_drawing){.n = 0};
  draw_lines(a, &p->world, &p->view, drawing, NULL);
}

static void check_far_away(struct tap *tap) {
  struct hand_picture p;
  struct hsr_drawing got, wanted;
  struct hsr_drawing_difference found;
  hand_open(&p, far_away, 2);
  draw_far_away("appel", &p, &wanted);
  draw_far_away("warnock-edges", &p, &got);
  hsr_drawing_compare(&got, &wanted, false, &found);
  ok(tap, found.edges == 7 && !found.differing,
     "warnock-edges: edges without coordinates, as appel draws them");
  hsr_drawing_free(&got);
  hsr_drawing_free(&wanted);
  hand_close(&p);
}

int main(void) {
  struct tap tap = plan(N_RULES + 1);
  check_far_away(&tap);
  for (int r = 0; r < N_RULES; r++) {
    struct watch w = {.rule = &rules[r], .counter = counter_of_rule(&rules[r])};
    for (int s = 0; s < N_SCENES; s++)
      watch_scene(&w, scenes[s]);
    ok(&tap, w.events && !w.wrong, "%s, %s: %ld of %ld events are not true",
       rules[r].algorithm, rules[r].counter, w.wrong, w.events);
  }
  return finish(&tap);
}
