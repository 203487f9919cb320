/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Counts of visible samples in tiling (Greene's thesis, 4.6.3).
 *
 * Right       The picture is the same with counts and without.
 * Spared      Fewer cells are visited for polygons; polygons are left out in
 *             cubes of which nothing is left to be seen.
 * Paid        More cells are visited for cubes, since all of a silhouette is
 *             gone through.
 * Work        The work picture shows the cells that are visited, for cubes and
 *             for polygons (1996, figure 3). */
#include "bench/modules/variant.h"
#include "tests/properties/hierarchical/claims.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>

/* `right`: how many cells were exhausted when a person last looked. */
static void check(struct tap *tap, const char *name, uint32_t view, int m,
                  int n, const char *more, uint64_t right) {
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
     !wrong && left_out && exhausted == right && polygon[1] < polygon[0] &&
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

/* --- The work picture ----------------------------------------------------- */

enum { SIDE = 512 }; /* a cell of the pyramid */

/* What the cells that are visited add up to, each shared out over its samples:
 * those for cubes, and those for polygons. */
struct visits {
  int cube_cells, polygon_cells;
  double cubes, polygons;
  float at[SIDE * SIDE];
};

static void note_visit(void *context, const struct hsr_event *event) {
  struct visits *v = context;
  const struct hsr_window *w = &event->window;
  bool cube = event->counter == v->cube_cells;
  if (!cube && event->counter != v->polygon_cells)
    return;
  float share = 1.0f / (float)((w->x1 - w->x0) * (w->y1 - w->y0));
  *(cube ? &v->cubes : &v->polygons) += 1;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      v->at[j * SIDE + i] += share;
}

static void draw_work(const struct claim_scene *scene, float *work,
                      struct visits *visits) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_variant variant;
  struct hsr_setup setup;
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_trace trace = {.listen = note_visit, .context = visits};
  struct hsr_tally tally = {.work = work, .work_stride = SIDE, .trace = &trace};
  uint32_t *ids = malloc(SIDE * SIDE * sizeof *ids);
  struct hsr_answer answer = hsr_answer_of_ids(ids, SIDE, SIDE);
  struct hsr_job job = {.view = &scene->view,
                        .scratch = &arena,
                        .tally = &tally,
                        .answer = &answer};
  if (!ids || hsr_variant_parse("tiling", &variant, &err))
    abort();
  must_setup(&setup, variant.listed->counting, &variant.choice,
             &scene->worlds.roster);
  visits->cube_cells = counter_of(setup.algorithm, "cube cells");
  visits->polygon_cells = counter_of(setup.algorithm, "polygon cells");
  if (hsr_setup_render(&setup, &job, &err))
    abort();
  hsr_setup_free(&setup);
  hsr_arena_free(&arena);
  free(ids);
}

static void check_work(struct tap *tap) {
  static float all[SIDE * SIDE];
  static struct visits visits;
  struct claim_scene scene;
  double most = 0;
  claim_open(&scene, "office:1", 0, SIDE, SIDE);
  draw_work(&scene, all, &visits);
  for (int k = 0; k < SIDE * SIDE; k++)
    most = fmax(most, fabs((double)all[k] - visits.at[k]));
  ok(tap, most < 1e-3 && visits.cubes > 0 && visits.polygons > 0,
     "the work picture shows %.0f cells for cubes and %.0f for polygons",
     visits.cubes, visits.polygons);
  claim_close(&scene);
}

int main(void) {
  struct tap tap = plan(9);
  check_work(&tap);
  check(&tap, "office:2", 0, 512, 512, "", 1419);
  check(&tap, "office:2", 40, 333, 250, ":start=root", 854);
  check(&tap, "office:1", 20, 512, 512, ":leaf=10", 1473);
  check(&tap, "harbor", 0, 512, 512, "", 629);
  return finish(&tap);
}
