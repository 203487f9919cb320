/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The hierarchical z-buffer on a machine with z-queries instead of a pyramid
 * (Greene's thesis, 3.5.6).
 *
 * Right       The picture is the oracle's, by any threshold.
 * Threshold   If cubes of fewer faces are asked of, there are more queries and
 *             fewer faces are tiled: what a quick answer would make worthwhile.
 * Pyramid     None is read.
 * Latency     A query takes as long as the option says. */
#include "bench/modules/variant.h"
#include "common/base/clock.h"
#include "tests/properties/hierarchical/claims.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

enum { M = 128, N = 128 };

static const char *const thresholds[] = {"0",    "50",    "200",    "800",
                                         "3000", "12000", "1000000"};

static const char *with(const char *threshold) {
  static char text[80];
  snprintf(text, sizeof text, "hzbuffer:pyramid=queries:threshold=%s",
           threshold);
  return text;
}

static void check_thresholds(struct tap *tap, const char *name) {
  struct claim_scene scene;
  struct claim_counts right, got;
  uint64_t asked = UINT64_MAX, tiled = 0;
  bool fewer = true, more = true;
  long wrong = 0;
  claim_open(&scene, name, 0, M, N);
  claim_draw(&right, &scene, "hzbuffer", NULL, NULL);
  for (int k = 0; k < 7; k++) {
    claim_draw(&got, &scene, with(thresholds[k]), NULL, NULL);
    uint64_t queries = claim_value(&got, "z-queries");
    uint64_t faces = claim_value(&got, "faces tiled");
    wrong += count_differences(&scene.view, got.ids, right.ids);
    wrong += claim_value(&got, "cube reads") > 0;
    wrong += claim_value(&got, "face reads") > 0;
    wrong += claim_value(&got, "cubes tested") != queries;
    printf("# %s: cubes of %s faces: %lu queries, %lu faces tiled, %lu samples "
           "looked at\n",
           name, thresholds[k], (unsigned long)queries, (unsigned long)faces,
           (unsigned long)claim_value(&got, "side samples"));
    fewer &= queries <= asked && (k < 6 || !queries);
    more &= faces >= tiled;
    asked = queries;
    tiled = faces;
    free(got.ids);
  }
  ok(tap, !wrong, "%s: no sample is wrong, and no pyramid is read", name);
  ok(tap, fewer && more,
     "%s: the higher the threshold, the fewer queries and the more faces",
     name);
  free(right.ids);
  claim_close(&scene);
}

static void check_latency(struct tap *tap) {
  struct claim_scene scene;
  struct claim_counts counts;
  struct hsr_variant variant;
  struct hsr_setup setup;
  struct hsr_error err = {.text = "out of memory"};
  uint32_t *ids = malloc((size_t)M * N * sizeof *ids);
  claim_open(&scene, "office:1", 0, M, N);
  claim_count(&counts, &scene, with("200"));
  double asked = (double)claim_value(&counts, "z-queries");
  if (!ids ||
      hsr_variant_parse("hzbuffer:pyramid=queries:threshold=200:latency=2000",
                        &variant, &err) ||
      hsr_setup_init(&setup, variant.listed->plain, &variant.choice,
                     &scene.worlds.roster, &err))
    abort();
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.work = NULL};
  struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
  struct hsr_job job = {.view = &scene.view,
                        .scratch = &arena,
                        .tally = &tally,
                        .answer = &answer};
  double begin = hsr_seconds_now();
  if (hsr_setup_render(&setup, &job, &err))
    abort();
  double took = hsr_seconds_now() - begin;
  ok(tap, asked > 0 && took >= 0.002 * asked,
     "%.0f queries of 2 ms each take %.3f s with all else", asked, took);
  hsr_arena_free(&arena);
  hsr_setup_free(&setup);
  claim_close(&scene);
  free(ids);
}

int main(void) {
  struct tap tap = plan(5);
  check_thresholds(&tap, "office:3");
  check_thresholds(&tap, "terrain:32:100");
  check_latency(&tap);
  return finish(&tap);
}
