/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The events of the hierarchical modules, with many options: of the
 * hierarchical z-buffer, of Clark's culling, and of tiling with masks.
 *
 * Counts      Each counter has as many events as it counted, also for filtered
 *             pictures. The accepted ones repaint the picture.
 * Depths      A comparison of two faces has the outcome of the exact services.
 * Masks       Cells are where their number says, and are visited for the
 *             current polygon or cube. Those of the finest level are counted as
 *             such. Samples are written in the last active cell, each once. A
 *             sample that was decided exactly is written if, and only if, the
 *             event says so.
 * Cubes       A cube is hidden or visible as the last entry or sample read for
 *             it says; it is outside the frustum as the last inequality says.
 * Faces       A face that is culled is not written. A face that is repeated was
 *             met before.
 * Bodies      There are events for what moves: instances that move down an
 *             octree, trees of bodies, and merges of different faces, in
 *             ascending order.
 *
 * usage: steps_test [WORD...]    only variants whose names begin with a WORD */
#include "bench/modules/variant.h"
#include "common/answers/kinds/filtered.h"
#include "common/exact/screen.h"
#include "common/scene/motion.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

enum { M = 45, N = 27, VIEWS = 3, SUB = 8 };

/* --- The events of one frame ---------------------------------------------- */

struct frame {
  const struct hsr_algorithm *algorithm;
  const struct hsr_world *world;
  struct hsr_view view;
  int m, n; /* samples: sub-samples, if it is filtered */
  bool filtered;
  struct hsr_event *event;
  size_t n_events, room;
  struct hsr_tally tally;
  uint32_t ids[M * N], sums[3 * M * N];
  const char *wrong; /* the first thing that is wrong, or NULL */
  uint64_t divided;  /* clusters, in this frame or an earlier one of the run */
};

static void listen(void *context, const struct hsr_event *event) {
  struct frame *f = context;
  if (f->n_events == f->room) {
    f->room = 2 * f->room + 4096;
    f->event = realloc(f->event, f->room * sizeof *f->event);
    if (!f->event)
      bail("events: out of memory");
  }
  f->event[f->n_events++] = *event;
}

/* Keeps the first thing that is wrong. */
static void expect(struct frame *f, bool good, const char *what) {
  if (!good && !f->wrong)
    f->wrong = what;
}

/* The number of a counter; -1: there is none of that name. */
static int counter(const struct frame *f, const char *name) {
  for (int k = 0; f->algorithm->counters[k].name; k++)
    if (!strcmp(f->algorithm->counters[k].name, name))
      return k;
  return -1;
}

static bool same(struct hsr_subject a, struct hsr_subject b) {
  return a.kind == b.kind && !memcmp(a.id, b.id, sizeof a.id);
}

static bool same_window(struct hsr_window a, struct hsr_window b) {
  return !memcmp(&a, &b, sizeof a);
}

/* The event after number k if it is of this counter, otherwise NULL. */
static const struct hsr_event *next_is(const struct frame *f, size_t k,
                                       int of) {
  return k + 1 < f->n_events && f->event[k + 1].counter == of ? &f->event[k + 1]
                                                              : NULL;
}

/* --- Counts and pictures -------------------------------------------------- */

static void check_counts(struct frame *f) {
  uint64_t n[HSR_MAX_COUNTERS] = {0};
  for (size_t k = 0; k < f->n_events; k++)
    n[f->event[k].counter]++;
  expect(f, !memcmp(n, f->tally.count, sizeof n), "events are not the counts");
}

static void check_picture(struct frame *f) {
  static uint32_t painted[M * N];
  memset(painted, 0xff, sizeof painted); /* HSR_BACKGROUND */
  for (size_t k = 0; k < f->n_events; k++) {
    const struct hsr_event *e = &f->event[k];
    if (f->algorithm->counters[e->counter].kind != HSR_ACCEPT)
      continue;
    for (int j = e->window.y0; j < e->window.y1; j++)
      for (int i = e->window.x0; i < e->window.x1; i++)
        painted[j * M + i] = e->a.id[0];
  }
  expect(f, !memcmp(painted, f->ids, sizeof painted),
         "accepted events do not repaint the picture");
}

/* --- Depths --------------------------------------------------------------- */

static void check_depths(struct frame *f) {
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_screen screen;
  struct hsr_tally tally = {.trace = NULL};
  const int of[] = {counter(f, "depth tests"), counter(f, "unsure depths"),
                    counter(f, "samples compared"),
                    counter(f, "thickness checks")};
  if (hsr_screen_make(&screen, f->world, &f->view, &arena, &tally))
    bail("depths: out of memory");
  for (size_t k = 0; k < f->n_events; k++) {
    const struct hsr_event *e = &f->event[k];
    if (e->counter != of[0] && e->counter != of[1] && e->counter != of[2] &&
        e->counter != of[3])
      continue;
    uint32_t a = e->a.id[0], b = e->b.id[0];
    bool nearer = b == HSR_BACKGROUND ||
                  (a != b && hsr_nearer(&screen, a, b, e->window.x0,
                                        e->window.y0, &tally));
    expect(f, e->outcome == nearer, "a depth is compared wrongly");
  }
  hsr_arena_free(&arena);
}

/* --- Masks ---------------------------------------------------------------- */

/* The levels of the pyramid for a picture of this size. */
static int levels_of(const struct frame *f) {
  int n = 1;
  for (int size = 8; size < f->m || size < f->n; size *= 8)
    n++;
  return n;
}

/* A visit has an event as a cell, as a finest cell if it is one, and as a cell
 * of a pixel or more, which all cells are. */
static void check_visit(struct frame *f, size_t k) {
  const struct hsr_event *e = &f->event[k];
  int n = levels_of(f), level = (int)e->a.id[0], size = 1;
  for (int l = level; l < n; l++)
    size *= 8;
  int x = (int)e->a.id[1] * size, y = (int)e->a.id[2] * size;
  struct hsr_window window = {x, y, x + size < f->m ? x + size : f->m,
                              y + size < f->n ? y + size : f->n};
  expect(f, level < n && same_window(e->window, window),
         "a cell is not where its number says");
  if (level == n - 1) {
    const struct hsr_event *finest =
        next_is(f, k++, counter(f, "finest cells"));
    expect(f, finest && same(finest->a, e->a) && finest->outcome == e->outcome,
           "a finest cell is not told");
  }
  const struct hsr_event *pixels = next_is(f, k, counter(f, "pixel cells"));
  expect(f, pixels && same(pixels->a, e->a) && pixels->outcome == e->outcome,
         "a cell of a pixel or more is not told");
}

static void check_masks(struct frame *f) {
  int cube_cells = counter(f, "cube cells"), asked = counter(f, "cubes tested");
  int polygon_cells = counter(f, "polygon cells");
  int hidden = counter(f, "cubes culled"), pieces = counter(f, "pieces");
  struct hsr_subject cube = HSR_NOTHING, face = HSR_FACE(HSR_BACKGROUND);
  if (pieces < 0)
    pieces = counter(f, "polygons");
  bool visited = false;
  for (size_t k = 0; k < f->n_events; k++) {
    const struct hsr_event *e = &f->event[k];
    if (e->counter == cube_cells || e->counter == polygon_cells)
      check_visit(f, k);
    if (e->counter == cube_cells) {
      expect(f, !visited || same(cube, e->b),
             "a cell is visited for two cubes");
      cube = e->b;
      visited = true;
    } else if (e->counter == asked) {
      const struct hsr_event *next = next_is(f, k, hidden);
      expect(f, visited && same(cube, e->a), "another cube is asked about");
      expect(f, e->outcome ? !next : next && same(next->a, e->a),
             "a cube is hidden and not told so, or told so and not hidden");
      visited = false;
    } else if (e->counter == pieces) {
      face = HSR_FACE(e->a.id[0]);
    } else if (e->counter == polygon_cells) {
      expect(f, same(e->b, face) || e->b.id[0] == HSR_BACKGROUND,
             "a cell is visited for another face");
      face = HSR_FACE(e->b.id[0]);
    }
  }
  expect(f, !visited, "cells are visited for a cube that is not asked about");
}

/* Samples are written where they are decided. Not for tiling-lazy, which writes
 * at the end. */
static void check_writing(struct frame *f) {
  int cells = counter(f, "polygon cells"), samples = counter(f, "samples");
  int finest = counter(f, "finest cells"), pixels = counter(f, "pixel cells");
  int unsure = counter(f, "unsure samples");
  size_t all = (size_t)f->m * (size_t)f->n, n_written = 0;
  unsigned char *written = calloc(all, 1);
  const struct hsr_event *cell = NULL;
  if (!written)
    bail("samples: out of memory");
  for (size_t k = 0; k < f->n_events; k++) {
    const struct hsr_event *e = &f->event[k];
    const struct hsr_window *w = &e->window;
    size_t at = (size_t)w->y0 * (size_t)f->m + (size_t)w->x0;
    if (e->counter == cells)
      cell = e;
    if (e->counter != samples)
      continue;
    expect(f,
           cell && cell->outcome == 1 && same(cell->b, e->a) &&
               w->x0 >= cell->window.x0 && w->x1 <= cell->window.x1 &&
               w->y0 >= cell->window.y0 && w->y1 <= cell->window.y1,
           "a sample is written outside of the cell at hand");
    expect(f, !written[at], "a sample is written twice");
    written[at] = 1;
    n_written++;
  }
  expect(f, n_written == all, "a sample is not written");
  /* The events of samples that are decided exactly come before that of their
   * cell, and that comes before those of the samples written in it. */
  for (size_t k = 0; k < f->n_events; k++) {
    const struct hsr_event *e = &f->event[k];
    if (e->counter != unsure)
      continue;
    size_t l = k + 1;
    while (l < f->n_events && f->event[l].counter == unsure)
      l++;
    while (l < f->n_events &&
           (f->event[l].counter == cells || f->event[l].counter == finest ||
            f->event[l].counter == pixels))
      l++;
    bool found = false;
    for (; l < f->n_events && f->event[l].counter == samples; l++)
      found |= same_window(f->event[l].window, e->window) &&
               same(f->event[l].a, e->a);
    expect(f, found == (e->outcome == 1),
           "a sample that was decided exactly is not as was said");
  }
  free(written);
}

static void check_lazy(struct frame *f) {
  int entered = counter(f, "pixels entered");
  int z_buffered = counter(f, "pixels z-buffered");
  int demoted = counter(f, "pixels demoted"),
      fragments = counter(f, "fragments");
  size_t n = (size_t)((f->m + 7) / 8 * ((f->n + 7) / 8)), columns;
  unsigned char *state = calloc(n, 1); /* of each pixel; 1: demoted */
  columns = (size_t)((f->m + 7) / 8);
  if (!state)
    bail("pixels: out of memory");
  for (size_t k = 0; k < f->n_events; k++) {
    const struct hsr_event *e = &f->event[k];
    const struct hsr_subject *pixel = e->counter == fragments ? &e->b : &e->a;
    if (e->counter != fragments && e->counter != demoted &&
        e->counter != entered)
      continue;
    size_t at = pixel->id[2] * columns + pixel->id[1];
    expect(f,
           at < n && e->window.x0 == 8 * (int)pixel->id[1] &&
               e->window.y0 == 8 * (int)pixel->id[2],
           "a pixel is not where its number says");
    if (e->counter != entered) {
      state[at] = e->counter == demoted;
      continue;
    }
    const struct hsr_event *next = next_is(f, k, z_buffered);
    expect(f, e->outcome ? next && same(next->a, e->a) : !next,
           "a pixel is z-buffered and not told so");
    expect(f, !e->outcome || state[at], "a pixel was not demoted");
  }
  free(state);
}

/* --- Cubes ---------------------------------------------------------------- */

/* Inequalities agree with the outcome for their nodes. */
static void check_frustum(struct frame *f) {
  int nodes = counter(f, "nodes visited"), out = counter(f, "nodes out");
  int inequalities = counter(f, "inequalities");
  struct hsr_subject node = HSR_NOTHING;
  for (size_t k = 0; k < f->n_events; k++) {
    const struct hsr_event *e = &f->event[k];
    if (e->counter == nodes)
      node = e->a;
    if (e->counter == out)
      expect(f,
             k && e[-1].counter == inequalities && e[-1].outcome == 1 &&
                 same(node, e->a),
             "a node is outside, and no inequality says so");
    if (e->counter != inequalities)
      continue;
    expect(f, same(node, e->a), "an inequality is of another node");
    expect(f, !e->outcome || next_is(f, k, out),
           "an inequality says that a node is outside, and it is not");
  }
}

/* Reads of the pyramid and samples of sides agree with the outcome for cubes.
 */
static void check_cubes(struct frame *f, bool by_reads) {
  int reads = counter(f, "cube reads"), tested = counter(f, "cubes tested");
  int culled = counter(f, "cubes culled");
  int sides = counter(f, "sides scanned"), samples = counter(f, "side samples");
  const struct hsr_event *read = NULL, *sample = NULL, *side = NULL;
  for (size_t k = 0; k < f->n_events; k++) {
    const struct hsr_event *e = &f->event[k];
    if (e->counter == reads) {
      int level = (int)e->a.id[0];
      int x = (int)e->a.id[1] << level, y = (int)e->a.id[2] << level;
      expect(f,
             e->window.x0 == x && e->window.y0 == y &&
                 e->window.x1 <= x + (1 << level) && e->window.x1 <= M &&
                 e->window.y1 <= y + (1 << level) && e->window.y1 <= N,
             "an entry is not where its number says");
      expect(f, !read || same(read->b, e->b), "an entry is read for two cubes");
      read = e;
    } else if (e->counter == samples) {
      expect(f, !sample || (sample->outcome == 0 && same(sample->a, e->a)),
             "a side is looked at further than the first visible sample");
      sample = e;
    } else if (e->counter == sides) {
      expect(f, e->outcome == (sample && sample->outcome),
             "a side is not as its last sample says");
      side = e;
      sample = NULL;
    } else if (e->counter == tested) {
      const struct hsr_event *next = next_is(f, k, culled);
      expect(f, !read || same(read->b, e->a), "entries were read for another");
      expect(f, e->outcome ? !next : next && same(next->a, e->a),
             "a cube is hidden and not culled");
      if (by_reads)
        expect(f, e->outcome == (read && read->outcome == 0),
               "a cube is not as the last entry says");
      else if (side)
        expect(f, e->outcome == side->outcome,
               "a cube is not as its last side says");
      read = side = NULL;
    } else if (e->counter == culled) {
      expect(f, k && e[-1].counter == tested && e[-1].outcome == 0,
             "a cube is culled and was not tested");
    }
  }
}

/* --- Faces ---------------------------------------------------------------- */

/* fast: a face is tested by one read after another, and the last one decides.
 */
static void check_faces(struct frame *f, bool fast) {
  int met = counter(f, "faces met"), repeated = counter(f, "faces repeated");
  int tested = counter(f, "faces tested"), culled = counter(f, "faces culled");
  int tiled = counter(f, "faces tiled"), before = counter(f, "faces before");
  int reads = counter(f, "face reads"), writes = counter(f, "writes");
  int visible = counter(f, "cubes visible");
  struct of {
    int met, last_read;
    bool culled;
  } *of = calloc(f->world->n_faces, sizeof *of);
  struct hsr_subject cube = HSR_NOTHING;
  if (!of)
    bail("faces: out of memory");
  for (size_t k = 0; k < f->n_events; k++) {
    const struct hsr_event *e = &f->event[k];
    if (e->counter == visible)
      cube = e->a;
    if (e->counter == reads)
      of[e->b.id[0]].last_read = 1 + e->outcome;
    struct of *face = e->a.kind == HSR_OF_FACE ? &of[e->a.id[0]] : NULL;
    if (e->counter == met) {
      face->met++;
      expect(f, fast ? same(e->b, cube) : true, "a face is met elsewhere");
    } else if (e->counter == repeated) {
      expect(f, face->met > 1, "a face is repeated and was not met before");
    } else if (e->counter == tested) {
      const struct hsr_event *next = next_is(f, k, culled);
      expect(f, e->outcome ? !next : next && same(next->a, e->a),
             "a face is hidden and not culled");
      expect(f, !fast || e->outcome == (face->last_read == 1),
             "a face is not as the last entry says");
    } else if (e->counter == culled) {
      face->culled = true;
    } else if (e->counter == before) {
      expect(f, k && e[-1].counter == tiled && same(e[-1].a, e->a),
             "a face is before all and not tiled");
    } else if (e->counter == writes || e->counter == tiled) {
      expect(f, !face->culled, "a face that is culled is written");
    }
  }
  free(of);
}

/* --- Bodies --------------------------------------------------------------- */

/* Where a box stays from frame 0 on, and how fast it may be. */
static void promise(struct hsr_scene *scene, const double at[3]) {
  static const double half[3] = {1.5, 1, 1.25};
  struct hsr_motion motion = {.speed = 0.125};
  struct hsr_key key[2] = {{.frame = 0}, {.frame = 64}};
  for (int a = 0; a < 3; a++) {
    motion.lo[a] = key[0].lo[a] = key[1].lo[a] = at[a] - half[a];
    motion.hi[a] = key[0].hi[a] = key[1].hi[a] = at[a] + half[a];
  }
  key[1].lo[0] -= 4;
  key[1].hi[0] += 4;
  motion.lo[0] -= 4;
  motion.hi[0] += 4;
  if (hsr_scene_set_motion(scene, &motion, key, 2))
    bail("bodies: their motion is refused");
}

/* Six boxes that move and meet, and one that stands still. It stands among
 * them, or behind the eye, so that all others are outside its cube. */
static struct hsr_scene *make_bodies(bool behind) {
  static const uint32_t side[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  static const float red[3] = {0.8f, 0.3f, 0.2f};
  static const double at[7][3] = {{0, -2, 0}, {-3, 0, 0},  {-2, 0.5, 0.25},
                                  {3, 1, -2}, {2.5, 0, 1}, {0, 2, 3},
                                  {0.5, 2, 2}};
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *scene = hsr_scene_new("bodies");
  for (int moves = 0; moves < 2; moves++) {
    struct hsr_object *box = hsr_scene_object(scene, "box");
    box->moves = moves;
    for (int k = 0; k < 8; k++)
      hsr_object_vertex(box, k & 1 ? 1.25 : -1.25, k & 2 ? 0.75 : -0.75,
                        k & 4 ? 1 : -1, NULL);
    for (int s = 0; s < 6; s++)
      for (uint32_t k = 1; k < 3; k++) {
        const uint32_t triangle[3] = {side[s][0], side[s][k], side[s][k + 1]};
        hsr_object_face(box, triangle, 3, red);
      }
  }
  for (int k = 0; k < 7; k++) {
    double m[12] = {1, 0, 0, at[k][0], 0, 1, 0, at[k][1], 0, 0, 1, at[k][2]};
    if (behind && !k)
      m[11] = 30;
    hsr_scene_instance(scene, k > 0, m);
    if (k)
      promise(scene, at[k]);
  }
  const struct hsr_camera camera[2] = {
      {.eye = {3, 4, 9}, .at = {0, 0, 0}, .up = {0, 1, 0}, .fov = 50},
      {.eye = {4, 3, 9}, .at = {0, 0, 0}, .up = {0, 1, 0}, .fov = 50}};
  if (hsr_scene_view(scene, &camera[0]) || hsr_scene_view(scene, &camera[1]))
    bail("bodies: %s", err.text);
  must_finish(scene);
  return scene;
}

/* Merges and moves of all runs: there must be some. */
static long n_merges, n_moved;

static void check_merges(struct frame *f) {
  int regions = counter(f, "regions"), merges = counter(f, "merges");
  int trees = counter(f, "trees"), faces = counter(f, "merged faces");
  uint64_t made = 0;
  for (size_t k = 0; k < f->n_events; k++) {
    const struct hsr_event *e = &f->event[k];
    if (e->counter == trees) {
      expect(f, e->a.id[0] < 32 && !(made >> e->a.id[0] & 1),
             "a tree is made twice of one body");
      made |= (uint64_t)1 << e->a.id[0];
    } else if (e->counter == merges) {
      n_merges++;
      expect(f, k && e[-1].counter == regions && e[-1].outcome == 3,
             "a merge is not of the region at hand");
      size_t n = 0;
      for (; next_is(f, k + n, faces); n++)
        expect(f, !n || e[n].a.id[0] < e[n + 1].a.id[0],
               "merged faces do not ascend");
      expect(f, n > 1, "a merge is of one face");
    }
  }
}

/* Steps of what is known of motion, of all runs: there must be some. */
static long n_looked, n_bounded, n_in_time, n_down;

/* An instance is looked at once a frame at most. With movers=update all six of
 * the bodies are, and stay where they are after the first frame. */
static void check_looked(struct frame *f, const char *text, bool again) {
  int looked = counter(f, "movers looked at");
  unsigned seen = 0;
  for (size_t k = 0; k < f->n_events; k++) {
    const struct hsr_event *e = &f->event[k];
    if (e->counter != looked)
      continue;
    n_looked++;
    expect(f, e->a.id[0] < 7 && !(seen >> e->a.id[0] & 1),
           "an instance is looked at twice");
    expect(f, !again || e->outcome, "what has not moved leaves its cube");
    seen |= 1u << e->a.id[0];
  }
  bool bodies = f->world->roster.scene->n_objects == 2 &&
                hsr_scene_moves(f->world->roster.scene);
  expect(f, !bodies || !strstr(text, "update") || seen == 0x7e,
         "an instance is not looked at");
}

/* A cluster is divided once, also over several frames. The way of an instance is known, and bounded before
 * it is handed down. */
static void check_clusters(struct frame *f) {
  int bounded = counter(f, "ways bounded"),
      in_time = counter(f, "splits in time");
  for (size_t k = 0; k < f->n_events; k++) {
    const struct hsr_event *e = &f->event[k];
    if (e->counter == bounded) {
      n_bounded++;
      expect(f, e->a.id[0] > 0 && e->a.id[0] < 7 && e->outcome,
             "the way of an instance is not known");
    } else if (e->counter == in_time) {
      n_in_time++;
      expect(f, e->a.id[0] < 64 && !(f->divided >> e->a.id[0] & 1),
             "a cluster is divided twice");
      f->divided |= (uint64_t)1 << e->a.id[0];
    }
  }
}

/* What is handed down goes into an octant of the cube that was divided last. */
static void check_lazy_cubes(struct frame *f) {
  int divided = counter(f, "cubes divided"), faces = counter(f, "faces down");
  int still = counter(f, "instances down");
  const struct hsr_event *last = NULL;
  for (size_t k = 0; k < f->n_events; k++) {
    const struct hsr_event *e = &f->event[k];
    if (e->counter == divided) {
      last = e;
    } else if (e->counter == faces || e->counter == still) {
      n_down++;
      expect(f,
             last && e->b.id[1] == last->a.id[1] && e->b.id[0] != last->a.id[0],
             "what is handed down is not of the cube that was divided");
      expect(f, (e->counter == faces) == (e->a.kind == HSR_OF_FACE),
             "faces are taken for instances");
    }
  }
}

/* Before an instance moves down, its cube was divided; where the octree is kept,
 * perhaps in an earlier frame, or it was made for the instance. */
static void check_movers(struct frame *f, const char *text) {
  int moved = counter(f, "moved down"), splits = counter(f, "splits");
  bool divided = strstr(text, "update") || strstr(text, "bounded") ||
                 strstr(text, "fixed") || strstr(text, "space-time");
  for (size_t k = 0; k < f->n_events; k++) {
    const struct hsr_event *e = &f->event[k];
    divided |= e->counter == splits;
    n_moved += e->counter == moved;
    expect(f, e->counter != moved || (divided && e->a.id[0] < 7),
           "an instance is moved down from a cube that is not divided");
  }
}

/* --- Runs ----------------------------------------------------------------- */

static void check_frame(struct frame *f, const char *text, bool again) {
  check_counts(f);
  if (!f->filtered) {
    check_picture(f);
    check_depths(f);
  }
  if (counter(f, "polygon cells") >= 0) {
    check_masks(f);
    if (counter(f, "merges") >= 0)
      check_merges(f);
    if (counter(f, "fragments") >= 0)
      check_lazy(f);
    else
      check_writing(f);
    return;
  }
  check_frustum(f);
  if (counter(f, "cube reads") < 0)
    return;
  check_movers(f, text);
  check_looked(f, text, again);
  check_clusters(f);
  check_lazy_cubes(f);
  bool one_by_one = !strstr(text, "coherence") && !strstr(text, "octree=off");
  if (one_by_one) {
    check_cubes(f, !strstr(text, "dual") && !strstr(text, "sides") &&
                       !strstr(text, "entry"));
    check_faces(f, !strstr(text, "dual") && !strstr(text, "polygons") &&
                       !strstr(text, "pyramid"));
  }
}

/* The picture equals the z-buffer's. */
static void check_truth(struct frame *f) {
  static uint32_t right[M * N];
  draw_plain("zbuffer-fast", f->world, &f->view, right);
  expect(f, !memcmp(right, f->ids, sizeof right), "the picture is wrong");
}

static size_t try_variant(const struct both_worlds *worlds, const char *text,
                          const char **wrong) {
  static struct frame f;
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_variant variant;
  struct hsr_setup setup;
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  size_t events = 0;
  if (hsr_variant_parse(text, &variant, &err))
    bail("%s: %s", text, err.text);
  must_setup(&setup, variant.listed->counting, &variant.choice, &worlds->world);
  f = (struct frame){.algorithm = setup.algorithm, .world = &worlds->world};
  f.filtered = strstr(text, "filter");
  f.m = f.filtered ? SUB * M : M;
  f.n = f.filtered ? SUB * N : N;
  for (uint32_t v = 0; v < VIEWS && v < worlds->scene->n_views; v++) {
    must_view(&f.view, &worlds->scene->views[v], M, N);
    struct hsr_trace trace = {.listen = listen, .context = &f};
    f.tally = (struct hsr_tally){.trace = &trace};
    f.n_events = 0;
    memset(f.ids, 0xfe, sizeof f.ids);
    struct hsr_answer answer = hsr_answer_of_ids(f.ids, M, N);
    if (f.filtered &&
        hsr_answer_make(&answer, &variant.choice.form, &f.view, false, &err))
      bail("%s: %s", text, err.text);
    struct hsr_job job = {.view = &f.view,
                          .scratch = &scratch,
                          .tally = &f.tally,
                          .answer = &answer};
    hsr_arena_reset(&scratch);
    if (hsr_setup_render(&setup, &job, &err))
      bail("%s: %s", text, err.text);
    if (f.filtered) {
      memcpy(f.sums, hsr_answer_sums_of(&answer), sizeof f.sums);
      hsr_answer_free(&answer);
    }
    check_frame(&f, text, v > 0);
    if (!f.filtered && !strstr(text, "table"))
      check_truth(&f);
    events += f.n_events;
  }
  *wrong = f.wrong;
  free(f.event);
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  return events;
}

static const char *const variants[] = {
    "clark",
    "hzbuffer",
    "hzbuffer:cubes=sides",
    "hzbuffer:cubes=entry",
    "hzbuffer:cubes=whole:volumes=tight:least=4",
    "hzbuffer:pyramid=dual",
    "hzbuffer:pyramid=dual:cubes=sides",
    "hzbuffer:pyramid=masked",
    "hzbuffer:pyramid=maps:occluders=5",
    "hzbuffer:pyramid=maps:occluders=10:coherence=passes",
    "hzbuffer:pyramid=masked:polygons=definitive:coherence=list",
    "hzbuffer:polygons=basic",
    "hzbuffer:polygons=definitive",
    "hzbuffer:polygons=none:placement=enclosing:least=2",
    "hzbuffer:pyramid=off:cubes=sides",
    "hzbuffer:octree=off",
    "hzbuffer:octree=lazy:least=4",
    "hzbuffer:coherence=list",
    "hzbuffer:coherence=passes",
    "hzbuffer:coherence=chc",
    "hzbuffer:coherence=chc++:assumed=2",
    "hzbuffer-moving",
    "hzbuffer-moving:movers=lazy",
    "hzbuffer-moving:movers=update",
    "hzbuffer-moving:movers=bounded:interval=3",
    "hzbuffer-moving:movers=fixed",
    "hzbuffer-moving:movers=space-time:interval=8",
    "hzbuffer-moving:movers=space-time:octree=lazy",
    "hzbuffer-moving:movers=lazy:octree=lazy",
    "hzbuffer-moving:movers=update:octree=lazy:coherence=list",
    "tiling",
    "tiling:leaf=2",
    "tiling:start=root:intervals=8",
    "tiling:octree=off:masks=table",
    "tiling:filter=box",
    "tiling:filter=cosine:jitter=3",
    "tiling-merged",
    "tiling-merged:leaf=1",
    "tiling-merged:leaf=2:filter=box",
    "tiling-lazy",
    "tiling-lazy:leaf=2",
    "tiling-lazy:order=back",
    "tiling-lazy:order=input:filter=box:jitter=2"};

/* Variants that refuse filtered scenes that are not flat are not asked. */
static const char *const scenes[] = {
    "penetration",  "coplanar",   "lattice:40:3",   "deep-stack",
    "color-cube:4", "near-plane", "cyclic-overlap", "office:1"};

enum {
  VARIANTS = sizeof variants / sizeof *variants,
  NAMED = sizeof scenes / sizeof *scenes,
  SCENES = NAMED + 2
};

static bool is_variant_asked(const char *variant, int argc, char **argv) {
  bool asked = argc == 1;
  for (int k = 1; k < argc; k++)
    asked |= !strncmp(variant, argv[k], strlen(argv[k]));
  return asked;
}

int main(int argc, char **argv) {
  static const char *name[SCENES];
  struct both_worlds worlds[SCENES];
  int n = 0;
  for (int k = 0; k < VARIANTS; k++)
    n += is_variant_asked(variants[k], argc, argv);
  struct tap tap = plan(n + 2 * (argc == 1));
  for (int s = 0; s < NAMED; s++) {
    open_worlds(&worlds[s], scenes[s]);
    name[s] = scenes[s];
  }
  for (int s = NAMED; s < SCENES; s++) {
    name[s] = s == NAMED ? "bodies" : "bodies outside";
    worlds[s] = (struct both_worlds){.scene = make_bodies(s > NAMED)};
    must_world(&worlds[s].world, worlds[s].scene);
    must_roster(&worlds[s].roster, worlds[s].scene);
  }
  for (int k = 0; k < VARIANTS; k++) {
    if (!is_variant_asked(variants[k], argc, argv))
      continue;
    const char *wrong = NULL, *where = "";
    size_t events = 0;
    bool divides = !strncmp(variants[k], "hzbuffer-moving", 15) &&
                   !strstr(variants[k], "octree");
    long moved = n_moved;
    for (int s = 0; s < SCENES; s++) {
      const char *found = NULL;
      events += try_variant(&worlds[s], variants[k], &found);
      if (found && !wrong) {
        wrong = found;
        where = name[s];
      }
    }
    if (divides && n_moved == moved)
      wrong = "nothing is moved down";
    ok(&tap, !wrong, "%s: %zu events%s%s%s%s", variants[k], events,
       wrong ? "; " : "", where, wrong ? ": " : "", wrong ? wrong : "");
  }
  if (argc == 1)
    ok(&tap, n_looked > 30 && n_bounded > 10 && n_in_time > 0 && n_down > 100,
       "%ld movers looked at, %ld ways bounded, %ld splits in time, %ld handed "
       "down",
       n_looked, n_bounded, n_in_time, n_down);
  if (argc == 1)
    ok(&tap, n_merges > 1 && n_moved > 10, "%ld merges, %ld moved down",
       n_merges, n_moved);
  for (int s = 0; s < SCENES; s++)
    close_worlds(&worlds[s]);
  return finish(&tap);
}
