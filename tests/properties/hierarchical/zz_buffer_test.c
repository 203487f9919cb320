/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What N. Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.4, says of the
 * ZZ-buffer.
 *
 * All         The tiling pass considers every face of the picture, visible or
 *             not. Rays through an octree, and hierarchical z-buffering, meet a
 *             small part of those of a solid block of cubes.
 * Rays        A ray takes much less work than one through an octree, if cells
 *             are small beside faces. Where they are as large as faces, lists
 *             are long, and a ray may take more.
 * Lists       Those of smaller cells are shorter, and have fewer faces than the
 *             picture has behind one another. */
#include "common/exact/screen.h"
#include "tests/properties/hierarchical/claims.h"
#include "tests/tap.h"

#include <stdlib.h>

enum { M = 96, N = 72 };

static uint32_t count_relevant(const struct claim_scene *scene) {
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.trace = NULL};
  struct hsr_screen screen;
  if (hsr_screen_make(&screen, &scene->worlds.world, &scene->view, &arena,
                      &tally))
    abort();
  uint32_t n = screen.n_relevant;
  hsr_arena_free(&arena);
  return n;
}

static void check_all(struct tap *tap, const char *name) {
  struct claim_scene scene;
  struct claim_counts zz, hz;
  claim_open(&scene, name, 1, M, N);
  uint32_t n = count_relevant(&scene);
  claim_count(&zz, &scene, "zz-buffer");
  claim_count(&hz, &scene, "hzbuffer");
  ok(tap, claim_value(&zz, "faces") == n && n > 0,
     "%s: all %u faces of the picture go through the pyramid", name, n);
  ok(tap,
     claim_value(&zz, "Warnock special") + claim_value(&zz, "depth search") >=
         n,
     "%s: each is compared", name);
  ok(tap, 4 * claim_value(&hz, "faces met") < 3 * (uint64_t)n,
     "%s: hzbuffer meets %llu of them", name,
     (unsigned long long)claim_value(&hz, "faces met"));
  claim_close(&scene);
}

/* `less`: how many times less work a ray takes in cells of that size. */
static void check_rays(struct tap *tap, const char *name, const char *algorithm,
                       double less) {
  struct claim_scene scene;
  struct claim_counts zz, octree;
  claim_open(&scene, name, 1, M, N);
  claim_count(&zz, &scene, algorithm);
  claim_count(&octree, &scene, "octree-raycast");
  double in_cells =
      (double)(claim_value(&zz, "ray tests") + claim_value(&zz, "depth tests"));
  double in_octree = (double)(claim_value(&octree, "cubes visited") +
                              claim_value(&octree, "ray tests") +
                              claim_value(&octree, "depth tests"));
  ok(tap, less * in_cells < in_octree,
     "%s, %s: a ray takes %.1f comparisons, through an octree %.1f", name,
     algorithm, in_cells / (M * N), in_octree / (M * N));
  claim_close(&scene);
}

static double mean_list(const struct claim_scene *scene,
                        const char *algorithm) {
  struct claim_counts counts;
  claim_count(&counts, scene, algorithm);
  return (double)claim_value(&counts, "list length") /
         (double)claim_value(&counts, "cells");
}

static double depth_complexity(const struct claim_scene *scene) {
  struct claim_counts counts;
  claim_count(&counts, scene, "bsp-front");
  return (double)(claim_value(&counts, "samples") +
                  claim_value(&counts, "samples taken")) /
         (M * N);
}

static void check_lists(struct tap *tap, const char *name) {
  struct claim_scene scene;
  claim_open(&scene, name, 1, M, N);
  double small = mean_list(&scene, "zz-buffer:cell=2");
  double standard = mean_list(&scene, "zz-buffer");
  double large = mean_list(&scene, "zz-buffer:cell=32");
  double depth = depth_complexity(&scene);
  ok(tap, small < standard && standard < large,
     "%s: a list has %.2f faces in cells of 2, %.2f of 8, %.2f of 32", name,
     small, standard, large);
  ok(tap, small < depth, "%s: faces behind one another: %.2f", name, depth);
  claim_close(&scene);
}

int main(void) {
  struct tap tap = plan(11);
  check_all(&tap, "color-cube:10");
  check_all(&tap, "color-cube:15");
  check_rays(&tap, "harbor", "zz-buffer", 2);
  check_rays(&tap, "color-cube:8", "zz-buffer:cell=2", 2);
  check_rays(&tap, "color-cube:8", "zz-buffer", 0.5);
  check_lists(&tap, "deep-stack");
  return finish(&tap);
}
