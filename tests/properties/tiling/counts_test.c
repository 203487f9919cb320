/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Counts of visible samples in tiling (Greene's thesis, 4.6.3).
 *
 * Right       The picture is the same with counts and without.
 * Spared      Fewer cells are visited for polygons; polygons are left out in
 *             cubes of which nothing is left to be seen.
 * Paid        More cells are visited for cubes, since all of a silhouette is
 *             gone through. */
#include "tests/properties/hierarchical/claims.h"
#include "tests/tap.h"

#include <stdlib.h>

static void check(struct tap *tap, const char *name, uint32_t view, int m,
                  int n, const char *more) {
  struct claim_scene scene;
  struct claim_counts off, on;
  char without[80], with[80];
  snprintf(without, sizeof without, "tiling%s", more);
  snprintf(with, sizeof with, "tiling:counts=on%s", more);
  claim_open(&scene, name, view, m, n);
  claim_draw(&off, &scene, without, NULL, NULL);
  claim_draw(&on, &scene, with, NULL, NULL);
  long wrong = count_differences(&scene.view, on.ids, off.ids);
  uint64_t left_out = claim_value(&on, "pieces left out");
  uint64_t exhausted = claim_value(&on, "cells exhausted");
  uint64_t polygon[2] = {claim_value(&off, "polygon cells"),
                         claim_value(&on, "polygon cells")};
  uint64_t cube[2] = {claim_value(&off, "cube cells"),
                      claim_value(&on, "cube cells")};
  ok(tap,
     !wrong && left_out && exhausted && polygon[1] < polygon[0] &&
         claim_value(&on, "samples") == claim_value(&off, "samples"),
     "%s, view %u%s: %lu polygon cells instead of %lu; %lu cells exhausted, "
     "%lu pieces left out, %ld samples differ",
     name, view, more, (unsigned long)polygon[1], (unsigned long)polygon[0],
     (unsigned long)exhausted, (unsigned long)left_out, wrong);
  ok(tap, cube[1] > cube[0] && claim_value(&off, "cells exhausted") == 0,
     "%s: %lu cube cells instead of %lu", name, (unsigned long)cube[1],
     (unsigned long)cube[0]);
  free(off.ids);
  free(on.ids);
  claim_close(&scene);
}

int main(void) {
  struct tap tap = plan(8);
  check(&tap, "office:2", 0, 512, 512, "");
  check(&tap, "office:2", 40, 333, 250, ":start=root");
  check(&tap, "office:1", 20, 512, 512, ":leaf=10");
  check(&tap, "harbor", 0, 512, 512, "");
  return finish(&tap);
}
