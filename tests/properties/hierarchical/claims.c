/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/properties/hierarchical/claims.h"
#include "tests/tap.h"

#include "bench/modules/variant.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void claim_open(struct claim_scene *scene, const char *name, uint32_t number,
                int m, int n) {
  open_worlds(&scene->worlds, name);
  const struct hsr_scene *s = scene->worlds.scene;
  must_view(&scene->view, &s->views[number % s->n_views], m, n);
}

void claim_close(struct claim_scene *scene) {
  close_worlds(&scene->worlds);
}

void claim_draw(struct claim_counts *counts, const struct claim_scene *scene,
                const char *algorithm,
                void (*listen)(void *context, const struct hsr_event *event),
                void *context) {
  const struct hsr_view *view = &scene->view;
  struct hsr_error err;
  struct hsr_variant variant;
  struct hsr_setup setup;
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_trace trace = {.listen = listen, .context = context};
  size_t size = (size_t)view->m * (size_t)view->n * sizeof *counts->ids;
  *counts = (struct claim_counts){.ids = malloc(size)};
  if (!counts->ids)
    bail("%s: out of memory", algorithm);
  memset(counts->ids, 0xfe, size);
  counts->tally.trace = listen ? &trace : NULL;
  struct hsr_answer answer = hsr_answer_of_ids(counts->ids, view->m, view->n);
  struct hsr_job job = {.view = view,
                        .scratch = &scratch,
                        .tally = &counts->tally,
                        .answer = &answer};
  if (hsr_variant_parse(algorithm, &variant, &err))
    bail("%s: %s", algorithm, err.text);
  counts->algorithm = variant.listed->counting;
  const struct hsr_world *world =
      hsr_most_laid_out(counts->algorithm, &variant.choice)
          ? &scene->worlds.world
          : &scene->worlds.roster;
  must_setup(&setup, counts->algorithm, &variant.choice, world);
  if (hsr_setup_render(&setup, &job, &err))
    bail("%s: %s", algorithm, err.text);
  counts->tally.trace = NULL;
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
}

void claim_count(struct claim_counts *counts, const struct claim_scene *scene,
                 const char *algorithm) {
  claim_draw(counts, scene, algorithm, NULL, NULL);
  free(counts->ids);
  counts->ids = NULL;
}

uint64_t claim_value(const struct claim_counts *counts, const char *name) {
  return counted(counts->algorithm, &counts->tally, name);
}
