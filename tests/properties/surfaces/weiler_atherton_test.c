/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Weiler and Atherton's visible polygons, sampled exactly, show at every sample
 * the face that the oracle sees there: of built-in scenes, in perspective and in
 * parallel. And what Greene 1995, p. 11, says of the work: every polygon is
 * considered at least once, many of them many times.
 *
 * usage: weiler_atherton_test [SCENE...] */
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 64, N = 48 };

static const char *const standard[] = {"house",         "color-cube:3",
                                       "twist:3",       "soup:40",
                                       "lattice:60",    "grid:3",
                                       "sphere:200",    "cyclic-overlap",
                                       "penetration",   "coplanar",
                                       "nested-solids", "one-sided",
                                       "deep-stack",    "t-junction",
                                       "shared-edges",  "collinear-edges",
                                       "sliver",        "sub-pixel-gap",
                                       "needle-fan",    "non-convex",
                                       "non-planar",    "huge-and-tiny",
                                       "behind-eye",    "near-plane",
                                       "eye-in-plane",  NULL};

static const struct hsr_listed *find(const char *name) {
  const struct hsr_listed *found = hsr_algorithm_find(name);
  if (found)
    return found;
  printf("Bail out! no %s\n", name);
  exit(99);
}

static int counter_of(const struct hsr_algorithm *algorithm, const char *name) {
  for (int k = 0; algorithm->counters[k].name; k++)
    if (!strcmp(algorithm->counters[k].name, name))
      return k;
  printf("Bail out! %s has no counter \"%s\"\n", algorithm->name, name);
  exit(99);
}

/* How often each face was taken for a clip polygon or examined against one, and
 * which have polygons in the picture. */
struct watch {
  int sorted, clip, examined;
  bool *is_there;
  long *times;
};

static void listen(void *context, const struct hsr_event *event) {
  struct watch *watch = context;
  if (event->counter == watch->sorted)
    watch->is_there[event->a.id[0]] = true;
  if (event->counter == watch->clip || event->counter == watch->examined)
    watch->times[event->a.id[0]]++;
}

/* --- One view ------------------------------------------------------------- */

struct found {
  long differing, views, never, polygons, times, refused;
};

static void check_view(const struct hsr_world *world,
                       const struct hsr_view *view, const char *scene,
                       struct found *found) {
  const struct hsr_listed *wa = find("weiler-atherton");
  static uint32_t wanted[M * N], got[M * N];
  struct watch watch = {counter_of(wa->counting, "polygons"),
                        counter_of(wa->counting, "clip polygons"),
                        counter_of(wa->counting, "examinations"),
                        calloc(world->n_faces, sizeof(bool)),
                        calloc(world->n_faces, sizeof(long))};
  struct hsr_trace trace = {.listen = listen, .context = &watch};
  struct hsr_tally tally = {.trace = &trace};
  draw_ids(find("oracle")->plain, world, view, wanted, NULL);
  for (int build = 0; build < 2; build++) {
    struct hsr_answer answer;
    struct hsr_error err;
    if (!draw_answer(build ? wa->counting : wa->plain, world, view, &answer,
                     build ? &tally : NULL)) {
      found->refused++;
      hsr_answer_free(&answer);
      continue;
    }
    if (hsr_polygons_ids(hsr_answer_polygons_of(&answer), view, got, &err)) {
      printf("Bail out! %s: %s\n", scene, err.text);
      exit(99);
    }
    long differing = count_differences(view, got, wanted);
    if (differing && !found->differing)
      for (int k = 0; k < M * N; k++)
        if (got[k] != wanted[k]) {
          printf("# %s, view %ld: (%d, %d): face %d, not %d; %ld differ\n",
                 scene, found->views, k % M, k / M, (int)got[k], (int)wanted[k],
                 differing);
          break;
        }
    found->differing += differing;
    hsr_answer_free(&answer);
  }
  found->views++;
  for (uint32_t f = 0; f < world->n_faces; f++) {
    found->never += watch.is_there[f] && !watch.times[f];
    found->polygons += watch.is_there[f];
    found->times += watch.times[f];
  }
  free(watch.is_there);
  free(watch.times);
}

/* --- A scene -------------------------------------------------------------- */

static void check_scene(struct tap *t, const char *name) {
  struct both_worlds worlds;
  struct found found = {0};
  open_worlds(&worlds, name);
  for (uint32_t v = 0; v < worlds.scene->n_views; v++) {
    struct hsr_view view;
    struct hsr_camera camera = worlds.scene->views[v];
    struct hsr_error err;
    for (int parallel = 0; parallel < 2; parallel++) {
      if (parallel) {
        double apart = 0;
        for (int k = 0; k < 3; k++)
          apart +=
              (camera.at[k] - camera.eye[k]) * (camera.at[k] - camera.eye[k]);
        camera.parallel = 0.5 * sqrt(apart);
      }
      if (!hsr_view_init(&view, &camera, M, N, &err))
        check_view(&worlds.world, &view, name, &found);
    }
  }
  ok(t, found.views && !found.differing && !found.refused,
     "%s: the oracle's ids in %ld views", name, found.views);
  ok(t, !found.never && found.times >= found.polygons,
     "%s: %ld polygons, each considered, %.1f times in the mean", name,
     found.polygons,
     found.polygons ? (double)found.times / (double)found.polygons : 0);
  close_worlds(&worlds);
}

int main(int argc, char **argv) {
  int n = argc - 1;
  while (argc == 1 && standard[n])
    n++;
  struct tap t = plan(2 * n);
  for (int k = 0; k < n; k++)
    check_scene(&t, argc > 1 ? argv[1 + k] : standard[k]);
  return finish(&t);
}
