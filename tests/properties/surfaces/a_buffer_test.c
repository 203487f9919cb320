/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Carpenter's A-buffer: where no faces penetrate, its sums are those of the
 * oracle's 4 x 8 samples a pixel, to the last bit. Where faces penetrate it is
 * known to be wrong; how often is measured, and a pixel is right if no
 * comparison of two fragments in it depends on the sample.
 *
 * usage: a_buffer_test [SCENE...] */
#include "bench/modules/variant.h"
#include "common/answers/kinds/filtered.h"
#include "common/exact/screen.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 24, N = 18, COLUMNS = HSR_SUB_ABUFFER, ROWS = HSR_SUB };

/* Without penetration in the views that are looked at. */
static const char *const apart[] = {
    "house",          "color-cube:3",    "sphere:200", "grid:3",
    "cyclic-overlap", "nested-solids",   "deep-stack", "t-junction",
    "shared-edges",   "collinear-edges", "needle-fan", "non-convex",
    "sub-pixel-gap"};
/* With penetration. */
static const char *const through[] = {"penetration", "soup:40",   "twist:3",
                                      "coplanar",    "one-sided", "near-plane",
                                      "behind-eye"};
enum {
  N_APART = sizeof apart / sizeof *apart,
  N_THROUGH = sizeof through / sizeof *through
};

static const struct hsr_listed *find(const char *name) {
  const struct hsr_listed *found = hsr_algorithm_find(name);
  if (found)
    return found;
  bail("no %s", name);
}

static uint64_t count_of(const struct hsr_tally *tally, const char *name) {
  return counted(find("a-buffer")->counting, tally, name);
}

/* The faces of one pixel's samples whose depth order is not the same at all
 * samples that both cover. */
static bool is_penetrated(const struct hsr_screen *screen, int i, int j) {
  struct hsr_tally tally = {.out_of_memory = false};
  uint32_t face[512], n = 0;
  uint32_t mask[512];
  for (uint32_t r = 0; r < screen->n_relevant && n < 512; r++) {
    uint32_t f = screen->relevant[r], bits = 0;
    for (int k = 0; k < COLUMNS * ROWS; k++)
      if (hsr_covers(screen, f, COLUMNS * i + k % COLUMNS,
                     ROWS * j + k / COLUMNS, &tally))
        bits |= UINT32_C(1) << k;
    if (bits) {
      face[n] = f;
      mask[n++] = bits;
    }
  }
  for (uint32_t f = 0; f < n; f++)
    for (uint32_t g = f + 1; g < n; g++) {
      uint32_t both = mask[f] & mask[g];
      int nearer = 0, farther = 0;
      for (int k = 0; k < COLUMNS * ROWS; k++)
        if (both >> k & 1) {
          if (hsr_nearer(screen, face[f], face[g], COLUMNS * i + k % COLUMNS,
                         ROWS * j + k / COLUMNS, &tally))
            nearer++;
          else
            farther++;
        }
      if (nearer && farther)
        return true;
    }
  return false;
}

struct found {
  long pixels, differing, unexplained, views;
  uint64_t fragments, masks, simple, complex, merges;
};

static void check_view(const struct hsr_world *world,
                       const struct hsr_view *view, struct found *found) {
  static uint32_t ids[M * COLUMNS * N * ROWS], wanted[3 * M * N];
  struct hsr_kernel kernel;
  struct hsr_view finer = hsr_view_finer(view, COLUMNS, ROWS);
  struct hsr_tally tally = {.out_of_memory = false};
  hsr_kernel_init(&kernel, HSR_FILTER_BOX_4X8);
  draw_ids(find("oracle")->plain, world, &finer, ids, NULL);
  memset(wanted, 0, sizeof wanted);
  hsr_filter_add_picture(&kernel, world, view, ids, wanted);
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_screen screen;
  struct hsr_tally other = {.out_of_memory = false};
  if (hsr_screen_make(&screen, world, &finer, &scratch, &other))
    exit(99);
  for (int build = 0; build < 2; build++) {
    struct hsr_answer answer;
    if (!draw_answer(build ? find("a-buffer")->counting
                           : find("a-buffer")->plain,
                     world, view, &answer, build ? &tally : NULL))
      bail("a-buffer refuses the scene");
    const uint32_t *got = hsr_answer_sums_of(&answer);
    for (int k = 0; k < M * N; k++) {
      if (!memcmp(got + 3 * k, wanted + 3 * k, 3 * sizeof *got))
        continue;
      found->differing++;
      found->unexplained += !is_penetrated(&screen, k % M, k / M);
    }
    found->pixels += M * N;
    hsr_answer_free(&answer);
  }
  hsr_arena_free(&scratch);
  found->views++;
  found->fragments += count_of(&tally, "fragments");
  found->masks += count_of(&tally, "masks");
  found->simple += count_of(&tally, "simple pixels");
  found->complex += count_of(&tally, "complex pixels");
  found->merges += count_of(&tally, "merges");
}

static struct found check_scene(const char *name) {
  struct both_worlds worlds;
  struct found found = {0};
  open_worlds(&worlds, name);
  for (uint32_t v = 0; v < worlds.scene->n_views && v < 6; v++) {
    struct hsr_view view;
    struct hsr_camera camera = worlds.scene->views[v];
    struct hsr_error err;
    if (v % 2) {
      double apart_by = 0;
      for (int k = 0; k < 3; k++)
        apart_by += pow(camera.at[k] - camera.eye[k], 2);
      camera.parallel = 0.5 * sqrt(apart_by);
    }
    if (!hsr_view_init(&view, &camera, M, N, &err))
      check_view(&worlds.world, &view, &found);
  }
  close_worlds(&worlds);
  return found;
}

static void check_apart(struct tap *t, const char *name) {
  struct found f = check_scene(name);
  ok(t, f.views && !f.differing,
     "%s: %ld of %ld pixels differ; %ld fragments, %ld masks, %ld simple and "
     "%ld complex pixels, %ld merges",
     name, f.differing, f.pixels, (long)f.fragments, (long)f.masks,
     (long)f.simple, (long)f.complex, (long)f.merges);
  ok(t,
     f.masks <= f.fragments && (!f.complex || f.masks >= f.complex) &&
         f.simple + f.complex == (uint64_t)(f.views * M * N),
     "%s: each pixel is simple or complex, and complex ones have masks", name);
}

static void check_through(struct tap *t, const char *name) {
  struct found f = check_scene(name);
  ok(t, !f.unexplained,
     "%s: %ld of %ld pixels differ, and in all of them two faces penetrate",
     name, f.differing, f.pixels);
}

int main(int argc, char **argv) {
  struct tap t = plan(argc > 1 ? argc - 1 : 2 * N_APART + N_THROUGH + 1);
  for (int k = 1; k < argc; k++)
    check_through(&t, argv[k]);
  for (int k = 0; argc == 1 && k < N_APART; k++)
    check_apart(&t, apart[k]);
  for (int k = 0; argc == 1 && k < N_THROUGH; k++)
    check_through(&t, through[k]);
  struct hsr_variant variant;
  struct hsr_error err;
  if (argc == 1)
    ok(&t,
       !hsr_variant_parse("a-buffer", &variant, &err) &&
           hsr_form_filtering(&variant.choice.form).filter ==
               HSR_FILTER_BOX_4X8 &&
           hsr_variant_parse("a-buffer:filter=box", &variant, &err),
       "it makes the box of 4 x 8 samples, without being asked to, and no "
       "other");
  return finish(&t);
}
