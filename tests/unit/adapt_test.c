/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The adapters: of a scene adapted in every way, algorithms that demand nothing
 * make the same picture as the oracle makes of the scene itself. */
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

enum { M = 97, N = 61, VIEWS = 3 };

static const unsigned demands[] = {HSR_TR, HSR_CF, HSR_NP, HSR_TR | HSR_NP,
                                   HSR_CF | HSR_NP};
enum { DEMANDS = sizeof demands / sizeof *demands };

static const char *const scenes[] = {
    "house",    "penetration", "cyclic-overlap", "non-convex", "behind-eye",
    "coplanar", "t-junction",  "color-cube",     "soup:200:3", "lattice:40:5"};
enum { SCENES = sizeof scenes / sizeof *scenes };

struct fixture {
  struct hsr_scene *scene;
  struct hsr_world world;
  uint32_t wanted[M * N], got[M * N];
};

static void fail(const struct hsr_error *err) {
  printf("Bail out! %s\n", err->text);
  exit(99);
}

static void open_scene(struct fixture *x, const char *name) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_import import = {.drop_degenerate = false};
  if (hsr_scene_open(name, &import, &x->scene, &err) ||
      hsr_scene_add_orbit(x->scene, VIEWS) ||
      hsr_world_init(&x->world, x->scene, &err))
    fail(&err);
}

/* Samples that differ from `wanted`, by an algorithm that is told to demand
 * what the adapters give. */
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
  for (uint32_t v = 0; v < VIEWS; v++) {
    struct hsr_view view;
    struct hsr_error err = {.text = ""};
    if (hsr_view_init(&view, &x->scene->views[v], M, N, &err))
      fail(&err);
    draw_ids(hsr_algorithm_find("oracle")->plain, &x->world, &view, x->wanted,
             NULL);
    for (int d = 0; d < DEMANDS; d++)
      for (int a = 0; a < 2; a++) {
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
  struct hsr_error err = {.text = ""};
  struct hsr_algorithm algorithm = *hsr_algorithm_find("null")->plain;
  algorithm.restrictions = HSR_TR | HSR_NP;
  struct hsr_setup setup;
  if (hsr_setup_init(&setup, &algorithm, &x->world, &err))
    fail(&err);
  bool good = setup.world->all_triangles;
  for (uint32_t f = 0; f + 1 < setup.world->n_faces; f++)
    good &= hsr_world_parent(setup.world, f) <=
            hsr_world_parent(setup.world, f + 1);
  ok(tap, good, "%s: triangles, in the order of their parents (%u of %u)", name,
     setup.world->n_faces, x->world.n_faces);
  hsr_setup_free(&setup);
}

int main(void) {
  struct tap tap = plan(2 * SCENES);
  for (int s = 0; s < SCENES; s++) {
    struct fixture *x = calloc(1, sizeof *x);
    if (!x)
      return 99;
    open_scene(x, scenes[s]);
    check_pictures(&tap, x, scenes[s]);
    check_faces(&tap, x, scenes[s]);
    hsr_world_free(&x->world);
    hsr_scene_delete(x->scene);
    free(x);
  }
  return finish(&tap);
}
