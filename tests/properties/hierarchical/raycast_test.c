/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What N. Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.4 and 3.6, says of ray
 * casting through an octree.
 *
 * Root        It is visited once a sample. Hierarchical z-buffering visits it
 *             once a frame, and once a sample only where it draws windows of
 *             one sample each.
 * Hidden      Most hidden faces are never met by a ray.
 * Scratch     Every ray starts from scratch: four times as many samples take
 *             about four times as many visits. Hierarchical z-buffering does
 *             not need so many. */
#include "bench/modules/modules.h"
#include "tests/properties/hierarchical/claims.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

enum { M = 48, N = 36 };

/* How often a root was visited, of the counter of that number. */
struct visits {
  int counter;
  uint32_t instance; /* of the root's octree: the subject's second number */
  uint64_t n;
};

static void note_root(void *context, const struct hsr_event *event) {
  struct visits *visits = context;
  visits->n += event->counter == visits->counter &&
               event->a.kind == HSR_OF_CELL && event->a.id[0] == 0 &&
               event->a.id[1] == visits->instance;
}

static uint64_t root_visits(const struct claim_scene *scene,
                            const char *algorithm, const char *counter) {
  struct claim_counts counts;
  struct visits visits = {
      .counter = counter_of(hsr_algorithm_find(algorithm)->counting, counter),
      .instance = HSR_NO_ID};
  claim_draw(&counts, scene, algorithm, note_root, &visits);
  free(counts.ids);
  return visits.n;
}

static uint64_t root_visits_by_sample(const struct claim_scene *whole) {
  struct claim_scene one = *whole;
  uint64_t n = 0;
  for (int j = 0; j < one.view.n; j++)
    for (int i = 0; i < one.view.m; i++) {
      one.view.window = (struct hsr_window){i, j, i + 1, j + 1};
      n += root_visits(&one, "hzbuffer", "nodes visited");
    }
  return n;
}

static void check_root(struct tap *tap, const char *name) {
  struct claim_scene scene;
  claim_open(&scene, name, 1, M, N);
  uint64_t rays = root_visits(&scene, "octree-raycast", "cubes visited");
  uint64_t frame = root_visits(&scene, "hzbuffer", "nodes visited");
  ok(tap, rays == M * N, "%s: a ray visits the root, %llu times", name,
     (unsigned long long)rays);
  ok(tap, frame == 1, "%s: hzbuffer visits it once a frame (%llu)", name,
     (unsigned long long)frame);
  claim_close(&scene);
}

static void check_windows(struct tap *tap, const char *name) {
  struct claim_scene scene;
  claim_open(&scene, name, 1, 12, 9);
  uint64_t n = root_visits_by_sample(&scene);
  ok(tap, n == 12 * 9, "%s: hzbuffer, a window a sample: once a sample (%llu)",
     name, (unsigned long long)n);
  claim_close(&scene);
}

static double count_of(const char *scene_name, int m, int n,
                       const char *algorithm, const char *counter) {
  struct claim_scene scene;
  struct claim_counts counts;
  claim_open(&scene, scene_name, 1, m, n);
  claim_count(&counts, &scene, algorithm);
  claim_close(&scene);
  return (double)claim_value(&counts, counter);
}

static void note_faces(void *context, const struct hsr_event *event) {
  unsigned char *met = context;
  if (event->a.kind == HSR_OF_FACE && event->a.id[0] != HSR_BACKGROUND)
    met[event->a.id[0]] = 1;
}

/* A solid block of cubes: those at the surface are seen. */
static void check_hidden(struct tap *tap) {
  double tests[2];
  static const char *const name[2] = {"color-cube:5", "color-cube:15"};
  double met = 0, all = 1;
  for (int k = 0; k < 2; k++) {
    struct claim_scene scene;
    struct claim_counts counts;
    claim_open(&scene, name[k], 1, M, N);
    uint32_t n = scene.worlds.world.n_faces;
    unsigned char *seen = calloc(n, 1);
    if (!seen)
      abort();
    claim_draw(&counts, &scene, "octree-raycast", note_faces, seen);
    tests[k] = (double)claim_value(&counts, "ray tests");
    met = 0;
    all = n;
    for (uint32_t f = 0; f < n; f++)
      met += seen[f];
    free(seen);
    free(counts.ids);
    claim_close(&scene);
  }
  ok(tap, tests[1] < 4 * tests[0],
     "27 times the faces take %.2f times the tests", tests[1] / tests[0]);
  ok(tap, met < 0.35 * all, "rays meet %.0f of %.0f faces", met, all);
}

static void check_scratch(struct tap *tap) {
  static const char *const scene = "color-cube:10";
  double rays =
      count_of(scene, 2 * M, 2 * N, "octree-raycast", "cubes visited") /
      count_of(scene, M, N, "octree-raycast", "cubes visited");
  double frame = count_of(scene, 2 * M, 2 * N, "hzbuffer", "nodes visited") /
                 count_of(scene, M, N, "hzbuffer", "nodes visited");
  ok(tap, rays > 3.8 && rays < 4.2,
     "four times the samples: %.2f times the cubes visited", rays);
  ok(tap, frame < 0.5 * rays, "hzbuffer: %.2f times the nodes", frame);
}

/* Faces that are not flat are in no cube. */
static void check_loose(struct tap *tap) {
  struct claim_scene scene;
  struct claim_counts right, got;
  claim_open(&scene, "non-planar", 0, M, N);
  claim_draw(&right, &scene, "oracle", NULL, NULL);
  claim_draw(&got, &scene, "octree-raycast", NULL, NULL);
  ok(tap, count_differences(&scene.view, got.ids, right.ids) == 0,
     "non-planar: the oracle's picture");
  free(right.ids);
  free(got.ids);
  claim_close(&scene);
}

int main(void) {
  struct tap tap = plan(12);
  check_root(&tap, "house");
  check_root(&tap, "color-cube:8");
  check_root(&tap, "twist:5");
  check_windows(&tap, "house");
  check_hidden(&tap);
  check_scratch(&tap);
  check_loose(&tap);
  return finish(&tap);
}
