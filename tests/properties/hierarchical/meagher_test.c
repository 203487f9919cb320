/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What N. Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.6, tells of Meagher's
 * algorithm: the work depends on what is visible, and not on all that is there;
 * hidden nodes are culled without comparing depths.
 *
 * Growth      A grid with 27 times the cells shows more of them. The nodes
 *             visited grow about as what is seen does, and not as the cells.
 * Once        No sample is written twice. */
#include "tests/properties/hierarchical/claims.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

enum { M = 160, N = 120 };

static uint32_t count_seen(const struct claim_scene *scene,
                           const uint32_t *ids) {
  uint32_t n_faces = scene->worlds.world.n_faces, n = 0;
  unsigned char *seen = calloc(n_faces, 1);
  if (!seen)
    abort();
  for (int k = 0; k < M * N; k++)
    if (ids[k] != HSR_BACKGROUND && !seen[ids[k]]) {
      seen[ids[k]] = 1;
      n++;
    }
  free(seen);
  return n;
}

struct work {
  double cells, seen, nodes, compared, samples, covered;
  bool no_depths;
};

static struct work work_of(const char *name, const char *algorithm) {
  struct claim_scene scene;
  struct claim_counts counts;
  struct work work = {.cells = 0};
  claim_open(&scene, name, 1, M, N);
  claim_draw(&counts, &scene, algorithm, NULL, NULL);
  work.cells = scene.worlds.scene->grid->n_cells;
  work.seen = count_seen(&scene, counts.ids);
  work.nodes = (double)claim_value(&counts, "nodes visited");
  work.compared = (double)(claim_value(&counts, "silhouette tests") +
                           claim_value(&counts, "cells"));
  work.samples = (double)claim_value(&counts, "samples");
  for (int k = 0; k < M * N; k++)
    work.covered += counts.ids[k] != HSR_BACKGROUND;
  work.no_depths =
      !counts.tally.depths_compared && !counts.tally.exact[HSR_ASK_DEPTH];
  free(counts.ids);
  claim_close(&scene);
  return work;
}

static void check_growth(struct tap *tap, const char *small,
                         const char *large) {
  struct work a = work_of(small, "meagher"), b = work_of(large, "meagher");
  double cells = b.cells / a.cells, seen = b.seen / a.seen,
         nodes = b.nodes / a.nodes, compared = b.compared / a.compared;
  ok(tap, nodes < 1.5 * seen && nodes < 0.5 * cells,
     "%s to %s: %.1f times the cells, %.1f times the faces seen, %.1f times "
     "the nodes",
     small, large, cells, seen, nodes);
  ok(tap, compared < 1.5 * seen, "and %.1f times the quadtree cells", compared);
  ok(tap, a.samples == a.covered && b.samples == b.covered && b.covered > 0,
     "every sample is written once: %.0f and %.0f", a.samples, b.samples);
  ok(tap, a.no_depths && b.no_depths, "no depths are compared");
}

int main(void) {
  struct tap tap = plan(8);
  check_growth(&tap, "grid:10", "grid:30");
  check_growth(&tap, "grid:16:5", "grid:32:5");
  return finish(&tap);
}
