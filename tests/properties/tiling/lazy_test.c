/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What N. Greene, "Hierarchical Polygon Tiling with Coverage Masks", SIGGRAPH
 * 1996, 6.1, claims about lazy z-buffering:
 *
 * Order       The picture is the same for any order; here it is the oracle's,
 *             filtered or not.
 * Exact       If polygons come from front to back, no pixel is z-buffered, and
 *             hardly more cells are visited than by tiling.
 * Nearly      With less disorder fewer pixels are z-buffered.
 * Worst       From back to front it does little more than a z-buffer. */
#include "bench/modules/variant.h"
#include "common/answers/kinds/filtered.h"
#include "common/base/clock.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

enum { LARGEST = 512, M = 75, N = 50, LATTICES = 300 };

static const char *const orders[] = {"tiling-lazy",
                                     "tiling-lazy:octree=off:leaf=2",
                                     "tiling-lazy:order=front",
                                     "tiling-lazy:order=front:disorder=10",
                                     "tiling-lazy:order=back",
                                     "tiling-lazy:order=input",
                                     "tiling-lazy:order=input:disorder=100"};
enum { ORDERS = sizeof orders / sizeof *orders };

struct stage {
  struct hsr_scene *scene;
  struct hsr_world world;
};

static struct stage open_stage(const char *name) {
  struct stage stage;
  stage.scene = must_open(name);
  must_world(&stage.world, stage.scene);
  return stage;
}

static void close_stage(struct stage *stage) {
  hsr_world_free(&stage->world);
  hsr_scene_delete(stage->scene);
}

static struct hsr_view view_of(const struct stage *stage, uint32_t v, int m,
                               int n) {
  struct hsr_view view;
  must_view(&view, &stage->scene->views[v], m, n);
  return view;
}

/* --- Drawing -------------------------------------------------------------- */

struct drawn {
  const struct hsr_algorithm *algorithm;
  struct hsr_tally tally;
  double seconds;
};

/* Draws with a variant, into ids or, if it is filtered, into sums. Unless it
 * counts, it draws a second time, for the seconds. */
static struct drawn draw(const char *name, bool counting,
                         const struct stage *stage, const struct hsr_view *view,
                         uint32_t *ids, uint32_t *sums) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_variant variant;
  struct hsr_setup setup;
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  size_t n = (size_t)view->m * (size_t)view->n;
  if (hsr_variant_parse(name, &variant, &err))
    bail("%s: %s", name, err.text);
  struct drawn drawn = {.algorithm = counting ? variant.listed->counting
                                              : variant.listed->plain};
  must_setup(&setup, drawn.algorithm, &variant.choice, &stage->world);
  for (int time = 0; time < 2 - counting; time++) {
    struct hsr_answer answer = hsr_answer_of_ids(ids, view->m, view->n);
    if (sums &&
        hsr_answer_make(&answer, &variant.choice.form, view, false, &err))
      bail("%s: %s", name, err.text);
    struct hsr_job job = {.view = view,
                          .scratch = &scratch,
                          .tally = &drawn.tally,
                          .answer = &answer};
    if (ids)
      memset(ids, 0xfe, n * sizeof *ids);
    hsr_arena_reset(&scratch);
    double begin = hsr_seconds_now();
    if (hsr_setup_render(&setup, &job, &err))
      bail("%s: %s", name, err.text);
    drawn.seconds = hsr_seconds_now() - begin;
    if (sums) {
      memcpy(sums, hsr_answer_sums_of(&answer), 3 * n * sizeof *sums);
      hsr_answer_free(&answer);
    }
  }
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  return drawn;
}

static uint64_t of(const struct drawn *drawn, const char *counter) {
  return counted(drawn->algorithm, &drawn->tally, counter);
}

/* --- The same picture for any order --------------------------------------- */

/* The number of samples that differ from the oracle's, over all orders and both
 * builds. */
static long differences(const struct stage *stage,
                        const struct hsr_view *view) {
  static uint32_t right[M * N], ids[M * N];
  long wrong = 0;
  draw_plain("oracle", &stage->world, view, right);
  for (int k = 0; k < 2 * ORDERS; k++) {
    draw(orders[k / 2], k & 1, stage, view, ids, NULL);
    long n = count_differences(view, ids, right);
    if (n)
      printf("# %s: %s: %ld samples differ\n", stage->scene->name,
             orders[k / 2], n);
    wrong += n;
  }
  return wrong;
}

static void check_scene(struct tap *tap, const char *name) {
  struct stage stage = open_stage(name);
  long wrong = 0;
  uint32_t views = stage.scene->n_views < 2 ? stage.scene->n_views : 2;
  for (uint32_t v = 0; v < views; v++) {
    struct hsr_view view = view_of(&stage, v, M, N);
    wrong += differences(&stage, &view);
  }
  ok(tap, views && !wrong, "%s: %ld samples differ, in %d orders", name, wrong,
     ORDERS);
  close_stage(&stage);
}

/* Scenes full of ties; displaced samples, and windows. */
static void check_lattices(struct tap *tap) {
  uint64_t seed = 1996;
  long wrong = 0, samples = 0;
  for (int k = 0; k < LATTICES; k++) {
    char name[64];
    snprintf(name, sizeof name, "lattice:%d:%d",
             (int)draw_integer(&seed, 3, 40),
             (int)draw_integer(&seed, 1, 1000000000));
    struct stage stage = open_stage(name);
    struct hsr_view view = view_of(&stage, 0, (int)draw_integer(&seed, 16, M),
                                   (int)draw_integer(&seed, 16, N));
    if (k % 4 == 1) {
      view.offset_x = (double)draw_integer(&seed, -7, 7) / 16;
      view.offset_y = (double)draw_integer(&seed, -7, 7) / 16;
    }
    if (k % 4 == 2)
      view.window =
          (struct hsr_window){view.m / 3, view.n / 5, view.m - 2, view.n - 1};
    wrong += differences(&stage, &view);
    samples += (long)view.m * view.n;
    close_stage(&stage);
  }
  ok(tap, !wrong, "%d lattices of %ld samples: %ld samples differ", LATTICES,
     samples, wrong);
}

/* --- Filtered ------------------------------------------------------------- */

enum { PIXELS_M = 24, PIXELS_N = 17 };

/* Filters the z-buffer's samples, by the definition. */
static void filter(const struct stage *stage, const struct hsr_view *view,
                   const struct hsr_filtering *filtering, uint32_t *sums) {
  static uint32_t ids[PIXELS_M * PIXELS_N];
  struct hsr_kernel kernel;
  hsr_kernel_init(&kernel, filtering->filter);
  memset(sums, 0, 3 * sizeof ids);
  int first = filtering->patterns ? 0 : -1;
  for (int pattern = first; pattern < filtering->patterns; pattern++)
    for (int bit = 0; bit < 64; bit++) {
      struct hsr_view part =
          hsr_subsample_view(view, HSR_FILTER_BOX, pattern, bit);
      draw_plain("zbuffer-fast", &stage->world, &part, ids);
      hsr_filter_add_subsample(&kernel, filtering, &stage->world, view, pattern,
                               bit, ids, sums);
    }
}

static void check_filtered(struct tap *tap, const char *name,
                           const char *filter_name,
                           struct hsr_filtering filtering) {
  static uint32_t right[3 * PIXELS_M * PIXELS_N], sums[3 * PIXELS_M * PIXELS_N];
  struct stage stage = open_stage(name);
  struct hsr_view view = view_of(&stage, 0, PIXELS_M, PIXELS_N);
  int same = 0;
  filter(&stage, &view, &filtering, right);
  for (int k = 0; k < ORDERS; k++) {
    char variant[200];
    snprintf(variant, sizeof variant, "%s:%s", orders[k], filter_name);
    draw(variant, k & 1, &stage, &view, NULL, sums);
    same += !memcmp(sums, right, sizeof sums);
  }
  ok(tap, same == ORDERS, "%s, %s: the sums of %d orders are those defined",
     name, filter_name, same);
  close_stage(&stage);
}

/* --- Exact order ---------------------------------------------------------- */

static uint32_t large[LARGEST * LARGEST];

static void check_exact(struct tap *tap, const char *name) {
  struct stage stage = open_stage(name);
  struct hsr_view view = view_of(&stage, 0, LARGEST, LARGEST);
  struct drawn lazy =
      draw("tiling-lazy:order=front", true, &stage, &view, large, NULL);
  struct drawn tiling =
      draw("tiling:octree=off", true, &stage, &view, large, NULL);
  uint64_t cells = of(&lazy, "polygon cells");
  uint64_t least = of(&tiling, "polygon cells");
  ok(tap, of(&lazy, "fragments") > 0 && of(&lazy, "pixels demoted") == 0,
     "%s, from front to back: no pixel of %llu is demoted", name,
     (unsigned long long)of(&lazy, "pixels entered"));
  ok(tap, cells < least + least / 2, "%s: %llu cells, tiling's are %llu", name,
     (unsigned long long)cells, (unsigned long long)least);
  close_stage(&stage);
}

/* --- Hidden faces --------------------------------------------------------- */

/* A face that is behind what is drawn already is hidden as a whole, and none
 * that is seen is counted as such. */
static void check_hidden(struct tap *tap, const char *name) {
  struct stage stage = open_stage(name);
  struct hsr_view view = view_of(&stage, 0, LARGEST, LARGEST);
  struct drawn lazy =
      draw("tiling-lazy:order=front", true, &stage, &view, large, NULL);
  bool *seen = calloc(stage.world.n_faces, sizeof *seen);
  if (!seen)
    bail("%s: out of memory", name);
  uint64_t n_seen = 0;
  for (int k = 0; k < LARGEST * LARGEST; k++)
    if (large[k] != HSR_BACKGROUND && !seen[large[k]]) {
      seen[large[k]] = true;
      n_seen++;
    }
  free(seen);
  uint64_t polygons = of(&lazy, "polygons");
  uint64_t hidden = of(&lazy, "polygons hidden");
  ok(tap, hidden > 0 && n_seen <= polygons - hidden,
     "%s: of %llu polygons %llu are hidden and %llu are seen", name,
     (unsigned long long)polygons, (unsigned long long)hidden,
     (unsigned long long)n_seen);
  close_stage(&stage);
}

/* --- Disorder ------------------------------------------------------------- */

static void check_disorder(struct tap *tap, const char *name) {
  static const int per_cent[] = {0, 1, 10, 50, 100};
  struct stage stage = open_stage(name);
  struct hsr_view view = view_of(&stage, 0, LARGEST, LARGEST);
  double before = 0, pixels = LARGEST / 8 * (LARGEST / 8);
  bool none = true, grows = true;
  for (int k = 0; k < 5; k++) {
    char variant[80];
    snprintf(variant, sizeof variant, "tiling-lazy:order=front:disorder=%d",
             per_cent[k]);
    struct drawn counted = draw(variant, true, &stage, &view, large, NULL);
    struct drawn timed = draw(variant, false, &stage, &view, large, NULL);
    double share = (double)of(&counted, "pixels z-buffered") / pixels;
    printf("# %s, %3d %% disorder: %.2f %% of the pixels z-buffered, %llu "
           "cells, %llu samples compared, %.1f ms\n",
           name, per_cent[k], 100 * share,
           (unsigned long long)of(&counted, "polygon cells"),
           (unsigned long long)of(&counted, "samples compared"),
           1000 * timed.seconds);
    none = none && (k || share == 0);
    grows = grows && share >= before;
    before = share;
  }
  ok(tap, none && grows && before > 0,
     "%s: the share of z-buffered pixels grows with disorder, from 0", name);
  close_stage(&stage);
}

static void check_worst(struct tap *tap, const char *name) {
  struct stage stage = open_stage(name);
  struct hsr_view view = view_of(&stage, 0, LARGEST, LARGEST);
  struct drawn lazy =
      draw("tiling-lazy:order=back", true, &stage, &view, large, NULL);
  struct drawn zbuffer = draw("zbuffer-fast", true, &stage, &view, large, NULL);
  struct drawn hzbuffer = draw("hzbuffer", true, &stage, &view, large, NULL);
  uint64_t compared = of(&lazy, "samples compared");
  uint64_t cells = of(&lazy, "polygon cells");
  uint64_t depths = of(&zbuffer, "depth tests");
  uint64_t reads = of(&hzbuffer, "cube reads") + of(&hzbuffer, "face reads");
  uint64_t greene = of(&hzbuffer, "depth tests") + reads;
  printf("# %s, from back to front: %llu cells and %llu samples compared; "
         "hierarchical z-buffer, in its own order: %llu entries and samples\n",
         name, (unsigned long long)cells, (unsigned long long)compared,
         (unsigned long long)greene);
  ok(tap, compared + cells < depths,
     "%s: less than the z-buffer's %llu comparisons", name,
     (unsigned long long)depths);
  close_stage(&stage);
}

int main(void) {
  static const char *const scenes[] = {
      "house",        "mesh:triceratops", "near-plane",  "eye-in-plane",
      "non-planar",   "huge-and-tiny",    "one-sided",   "deep-stack",
      "shared-edges", "needle-fan",       "harbor",      "color-cube:4",
      "soup:150:3",   "terrain",          "penetration", "cyclic-overlap",
      "coplanar",     "t-junction",       "sliver",      "behind-eye",
      "non-convex",   "nested-solids"};
  static const char *const deep[] = {"office:1", "color-cube:8", "terrain"};
  static const struct {
    const char *scene, *name;
    struct hsr_filtering filtering;
  } filtered[] = {
      {"house", "filter=box", {HSR_FILTER_BOX, 0}},
      {"soup:150:3", "filter=box:jitter=3", {HSR_FILTER_BOX, 3}},
      {"penetration", "filter=cosine", {HSR_FILTER_COSINE, 0}},
      {"non-convex", "filter=cosine:jitter=2", {HSR_FILTER_COSINE, 2}}};
  enum {
    SCENES = sizeof scenes / sizeof *scenes,
    DEEP = sizeof deep / sizeof *deep,
    FILTERED = sizeof filtered / sizeof *filtered
  };
  struct tap tap = plan(SCENES + 1 + FILTERED + 2 * DEEP + 1 + 2 + 2);
  for (int s = 0; s < SCENES; s++)
    check_scene(&tap, scenes[s]);
  check_lattices(&tap);
  for (int k = 0; k < FILTERED; k++)
    check_filtered(&tap, filtered[k].scene, filtered[k].name,
                   filtered[k].filtering);
  for (int s = 0; s < DEEP; s++)
    check_exact(&tap, deep[s]);
  check_hidden(&tap, "color-cube:8");
  for (int s = 0; s < 2; s++)
    check_disorder(&tap, deep[s]);
  for (int s = 0; s < 2; s++)
    check_worst(&tap, deep[s]);
  return finish(&tap);
}
