/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The hierarchical z-buffer on a machine with z-queries instead of a pyramid
 * (Greene's thesis, 3.5.6). A query tells whether a sample of a cube's sides is
 * visible: pyramid=off:cubes=sides. least= is the number of polygons from which
 * on it is worth asking about a cube.
 *
 * Right       The picture is the oracle's, by any such number.
 * Threshold   If cubes of fewer polygons are asked about, there are more
 *             queries, and fewer polygons are tiled: what a quick answer would
 *             make worthwhile.
 * Pyramid     None is read. */
#include "bench/modules/variant.h"
#include "tests/properties/hierarchical/claims.h"
#include "tests/tap.h"

#include <stdlib.h>

enum { M = 128, N = 128, THRESHOLDS = 5 };

static const int thresholds[THRESHOLDS] = {20, 50, 200, 800, 3200};

static const char *with(int threshold) {
  static char text[80];
  snprintf(text, sizeof text, "hzbuffer:pyramid=off:cubes=sides:least=%d",
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
  for (int k = 0; k < THRESHOLDS; k++) {
    claim_draw(&got, &scene, with(thresholds[k]), NULL, NULL);
    uint64_t queries = claim_value(&got, "cubes tested");
    uint64_t faces = claim_value(&got, "faces tiled");
    wrong += count_differences(&scene.view, got.ids, right.ids);
    wrong += claim_value(&got, "cube reads") > 0;
    wrong += claim_value(&got, "face reads") > 0;
    printf("# %s: cubes of %d faces: %lu queries, %lu faces tiled, %lu samples "
           "looked at\n",
           name, thresholds[k], (unsigned long)queries, (unsigned long)faces,
           (unsigned long)claim_value(&got, "side samples"));
    fewer &= queries > 0 && queries <= asked;
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

int main(void) {
  struct tap tap = plan(4);
  check_thresholds(&tap, "office:3");
  check_thresholds(&tap, "terrain:32:100");
  return finish(&tap);
}
