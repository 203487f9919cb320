/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The adapters: from a scene adapted in every way, algorithms that demand
 * nothing make the same picture as the oracle makes from the scene itself. The
 * pieces of a face, flat or not, cover by parity the same samples as the face.
 */
#include "bench/modules/modules.h"
#include "common/exact/screen.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 97, N = 61, VIEWS = 3 };

static const unsigned demands[] = {HSR_TR,
                                   HSR_CF,
                                   HSR_NP,
                                   HSR_TR | HSR_NP,
                                   HSR_CF | HSR_NP,
                                   HSR_LS,
                                   HSR_CF | HSR_NP | HSR_LS | HSR_TP,
                                   HSR_TR | HSR_NP | HSR_LS | HSR_TP};
enum { DEMANDS = sizeof demands / sizeof *demands };

static const char *const scenes[] = {
    "house",      "penetration", "cyclic-overlap", "non-convex",
    "behind-eye", "coplanar",    "t-junction",     "color-cube",
    "keyholes",   "soup:200:3",  "lattice:40:5",   "non-planar"};
enum { SCENES = sizeof scenes / sizeof *scenes };

struct fixture {
  struct hsr_scene *scene;
  struct hsr_world world;
  uint32_t wanted[M * N], got[M * N];
};

static void open_scene(struct fixture *x, const char *name) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_import import = {.strict = true};
  if (hsr_scene_open(name, &import, &x->scene, &err) ||
      hsr_scene_add_orbit(x->scene, VIEWS))
    bail("%s", err.text);
  must_world(&x->world, x->scene);
}

static void close_scene(struct fixture *x) {
  hsr_world_free(&x->world);
  hsr_scene_delete(x->scene);
  free(x);
}

/* The number of samples that differ from `wanted`, drawn by an algorithm that
 * is made to demand what the adapters give. */
static long differences(struct fixture *x, const struct hsr_view *view,
                        const char *name, unsigned demanded) {
  struct hsr_algorithm algorithm = *hsr_algorithm_find(name)->plain;
  algorithm.restrictions = demanded;
  draw_ids(&algorithm, &x->world, view, x->got, NULL);
  return count_differences(view, x->got, x->wanted);
}

static void check_pictures(struct tap *tap, struct fixture *x,
                           const char *name) {
  static const char *const algorithms[] = {"raycast", "watkins"};
  long wrong = 0;
  bool flat = true; /* the triangles of other polygons overlap from some eyes */
  for (uint32_t f = 0; f < x->world.n_faces; f++)
    flat &= x->world.mesh.deviation[f] == 0;
  for (uint32_t v = 0; v < VIEWS; v++) {
    struct hsr_view view;
    must_view(&view, &x->scene->views[v], M, N);
    draw_plain("oracle", &x->world, &view, x->wanted);
    for (int d = 0; d < DEMANDS; d++)
      for (int a = 0; a < 2 && (flat || !(demands[d] & HSR_TR)); a++) {
        long w = differences(x, &view, algorithms[a], demands[d]);
        wrong += w;
        if (w)
          printf("# v%u %s demand %u: %ld\n", v, algorithms[a], demands[d], w);
      }
  }
  ok(tap, !wrong, "%s: the adapted scene's pictures are the scene's (%ld off)",
     name, wrong);
}

/* What the adapters promise of the faces. */
static void check_faces(struct tap *tap, struct fixture *x, const char *name) {
  struct hsr_algorithm algorithm = *hsr_algorithm_find("null")->plain;
  algorithm.restrictions = HSR_TR | HSR_NP;
  struct hsr_setup setup;
  must_setup(&setup, &algorithm, NULL, &x->world);
  bool good = setup.world->roster.all_triangles;
  for (uint32_t f = 0; f + 1 < setup.world->n_faces; f++)
    good &= hsr_world_parent(setup.world, f) <=
            hsr_world_parent(setup.world, f + 1);
  const uint32_t *first = setup.world->roster.first;
  for (uint32_t i = 0; i < x->scene->n_instances; i++)
    for (uint32_t f = first[i]; f < first[i + 1]; f++)
      good &= setup.world->mesh.instance[f] == i;
  good &= first[x->scene->n_instances] == setup.world->n_faces;
  ok(tap, good, "%s: triangles, in the order of their parents (%u of %u)", name,
     setup.world->n_faces, x->world.n_faces);
  hsr_setup_free(&setup);
}

/* Counts how often each cluster is in the tree; false if the tree has a loop.
 */
static bool walk_tree(const struct hsr_clusters *c, uint32_t *found) {
  static uint32_t open[1 << 16];
  uint32_t n_open = 1, n_separators = 0;
  open[0] = c->root;
  while (n_open) {
    uint32_t next = open[--n_open];
    if (next & HSR_IS_CLUSTER) {
      found[next & ~HSR_IS_CLUSTER]++;
      continue;
    }
    if (++n_separators > c->n_separators || n_separators >= (1 << 15))
      return false;
    open[n_open++] = c->separator[next].front;
    open[n_open++] = c->separator[next].behind;
  }
  return n_separators == c->n_separators;
}

/* Every cluster is in the tree once; every oriented face is in one cluster, or
 * thick. */
static void check_clusters(struct tap *tap, struct fixture *x, const char *name,
                           unsigned demanded) {
  struct hsr_algorithm algorithm = *hsr_algorithm_find("null")->plain;
  algorithm.restrictions = demanded;
  struct hsr_setup setup;
  must_setup(&setup, &algorithm, NULL, &x->world);
  const struct hsr_world *world = setup.world;
  const struct hsr_clusters *c = world->clusters;
  uint32_t *times =
      calloc(2 * (size_t)world->n_faces + c->n_clusters, sizeof *times);
  uint32_t *found = times + 2 * (size_t)world->n_faces;
  bool good = walk_tree(c, found);
  for (uint32_t k = 0; k < c->n_clusters; k++)
    good &= found[k] == 1 && c->start[k] <= c->start[k + 1];
  for (uint32_t k = 0; k < c->start[c->n_clusters]; k++)
    times[c->order[k]]++;
  for (uint32_t k = 0; k < c->n_thick; k++)
    times[c->thick[k]]++;
  uint32_t n_empty = 0;
  for (uint32_t f = 0; f < world->n_faces; f++) {
    good &= times[2 * f] <= 1;
    good &= times[2 * f + 1] == (world->mesh.one_sided[f] ? 0 : times[2 * f]);
    n_empty += !times[2 * f];
  }
  /* So many oriented pieces were not certain to be on one side of the plane of
   * another, or of a separator, when a person last looked. */
  uint32_t n_thick = demanded & HSR_TP && !strcmp(name, "non-planar") ? 92 : 0;
  good &= c->n_thick == n_thick;
  ok(tap, good && n_empty == 0, "%s: %u faces in %u clusters%s, %u without",
     name, world->n_faces, c->n_clusters,
     demanded & HSR_TP ? " with priorities" : "", n_empty);
  free(times);
  hsr_setup_free(&setup);
}

/* --- Covering by parity --------------------------------------------------- */

/* For each face of a world that covers (i, j), flips its scene face in odd[].
 */
static void turn(const struct hsr_screen *screen, int i, int j, bool *odd,
                 struct hsr_tally *tally) {
  for (uint32_t r = 0; r < screen->n_relevant; r++) {
    uint32_t f = screen->relevant[r];
    const struct hsr_bounds *b = &screen->bounds[f];
    if (i >= b->x0 && i < b->x1 && j >= b->y0 && j < b->y1)
      odd[hsr_world_parent(screen->world, f)] ^=
          hsr_covers(screen, f, i, j, tally);
  }
}

/* The number of samples that a face and its pieces do not cover alike. */
static long uncovered(const struct hsr_world *world,
                      const struct hsr_world *adapted,
                      const struct hsr_view *view, long *covered) {
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_screen whole, pieces;
  struct hsr_error err = {.text = "out of memory"};
  bool *odd = HSR_NEW_ZEROED(&arena, bool, world->n_faces);
  if (!odd || hsr_screen_make(&whole, world, view, &arena, &tally) ||
      hsr_screen_make(&pieces, adapted, view, &arena, &tally))
    bail("%s", err.text);
  long n = 0;
  for (int j = 0; j < view->n; j++)
    for (int i = 0; i < view->m; i++) {
      turn(&whole, i, j, odd, &tally);
      for (uint32_t f = 0; f < world->n_faces; f++)
        *covered += odd[f];
      turn(&pieces, i, j, odd, &tally);
      for (uint32_t f = 0; f < world->n_faces; f++) {
        n += odd[f];
        odd[f] = false;
      }
    }
  hsr_arena_free(&arena);
  return n;
}

/* Of a face that is not flat what is convex depends on the eye: it stays. */
static bool warped_faces_stay(const struct hsr_world *world,
                              const struct hsr_world *adapted) {
  bool stay = true;
  for (uint32_t f = 0; f < adapted->n_faces; f++) {
    uint32_t parent = hsr_world_parent(adapted, f);
    stay &= world->mesh.deviation[parent] == 0 ||
            hsr_face_size(adapted, f) == hsr_face_size(world, parent);
  }
  return stay;
}

static void check_parity(struct tap *tap, struct fixture *x, const char *name) {
  long wrong = 0, covered = 0;
  for (int d = 0; d < DEMANDS; d++) {
    struct hsr_algorithm algorithm = *hsr_algorithm_find("null")->plain;
    algorithm.restrictions = demands[d];
    struct hsr_setup setup;
    must_setup(&setup, &algorithm, NULL, &x->world);
    if (demands[d] == HSR_CF)
      wrong += !warped_faces_stay(&x->world, setup.world);
    for (uint32_t v = 0; v < x->scene->n_views; v++) {
      struct hsr_view view;
      must_view(&view, &x->scene->views[v], M / 2, N / 2);
      wrong += uncovered(&x->world, setup.world, &view, &covered);
    }
    hsr_setup_free(&setup);
  }
  ok(tap, !wrong && covered, "%s: pieces cover what faces do (%ld off in %ld)",
     name, wrong, covered);
}

/* A star turns to one side only, but twice around: it is not convex, nor can it
 * be divided. */
static void check_star(struct tap *tap) {
  static const double at[5][2] = {{0, 10}, {6, -8}, {-9, 3}, {9, 3}, {-6, -8}};
  struct hsr_error err = {.text = ""};
  struct hsr_scene *scene = hsr_scene_new("star");
  struct hsr_object *object = hsr_scene_object(scene, "star");
  uint32_t vertex[5];
  for (int k = 0; k < 5; k++)
    hsr_object_vertex(object, at[k][0], at[k][1], 2, &vertex[k]);
  hsr_object_face(object, vertex, 5, NULL);
  struct hsr_world world;
  must_finish(scene);
  must_world(&world, scene);
  struct hsr_algorithm algorithm = *hsr_algorithm_find("null")->plain;
  struct hsr_setup setup;
  algorithm.restrictions = HSR_CF;
  ok(tap,
     hsr_setup_init(&setup, &algorithm, NULL, &world, &err) == HSR_E_REFUSED &&
         strstr(err.text, "crosses itself"),
     "a star is not convex: %s", err.text);
  hsr_setup_free(&setup);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* How many pieces triangles that pass through one another are divided into. Every
 * coordinate is 2^exponent times a small integer. */
static uint32_t n_pieces(int exponent) {
  enum { TRIANGLES = 14 };
  static const int corner[3][3] = {{-9, -5, 1}, {8, -6, -2}, {1, 9, 1}};
  struct hsr_scene *scene = hsr_scene_new("crossing");
  struct hsr_object *object = hsr_scene_object(scene, "crossing");
  for (int t = 0; t < TRIANGLES; t++) {
    uint32_t vertex[3];
    for (int k = 0; k < 3; k++) {
      double at[3];
      for (int c = 0; c < 3; c++)
        at[c] = ldexp(corner[k][(c + t) % 3] + t * (c - k) % 4, exponent);
      hsr_object_vertex(object, at[0], at[1], at[2], &vertex[k]);
    }
    hsr_object_face(object, vertex, 3, NULL);
  }
  struct hsr_world world;
  must_finish(scene);
  must_world(&world, scene);
  struct hsr_algorithm algorithm = *hsr_algorithm_find("null")->plain;
  struct hsr_setup setup;
  algorithm.restrictions = HSR_NP;
  must_setup(&setup, &algorithm, NULL, &world);
  uint32_t n = setup.world->n_faces;
  hsr_setup_free(&setup);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
  return n;
}

/* Below 2^-320, doubles cannot tell on which side of a plane a corner is. */
static void check_tiny(struct tap *tap) {
  const uint32_t n = n_pieces(0), tiny = n_pieces(-340);
  ok(tap, n > 14 && n == tiny,
     "tiny faces are divided into as many pieces: %u and %u", n, tiny);
}

int main(void) {
  static const char *const warped[] = {"non-planar", "non-convex", "behind-eye",
                                       "lattice:40:6"};
  enum { WARPED = sizeof warped / sizeof *warped };
  struct tap tap = plan(4 * SCENES + WARPED + 2);
  for (int s = 0; s < SCENES; s++) {
    struct fixture *x = calloc(1, sizeof *x);
    if (!x)
      return 99;
    open_scene(x, scenes[s]);
    check_pictures(&tap, x, scenes[s]);
    check_faces(&tap, x, scenes[s]);
    check_clusters(&tap, x, scenes[s], HSR_LS);
    check_clusters(&tap, x, scenes[s], HSR_CF | HSR_NP | HSR_LS | HSR_TP);
    close_scene(x);
  }
  for (int s = 0; s < WARPED; s++) {
    struct fixture *x = calloc(1, sizeof *x);
    if (!x)
      return 99;
    open_scene(x, warped[s]);
    check_parity(&tap, x, warped[s]);
    close_scene(x);
  }
  check_star(&tap);
  check_tiny(&tap);
  return finish(&tap);
}
