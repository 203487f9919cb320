/* SPDX-License-Identifier: GPL-3.0-or-later */
/* For tests of claims: a picture's counts by their names, and its events. */
#ifndef HSR_TESTS_CLAIMS_H
#define HSR_TESTS_CLAIMS_H

#include "tests/draw.h"

/* A named scene, and a view of it. */
struct claim_scene {
  struct both_worlds worlds;
  struct hsr_view view; /* m x n samples, whole */
};

/* View `number` of a scene. Opening ends the test program on failure. */
void claim_open(struct claim_scene *scene, const char *name, uint32_t number,
                int m, int n);
void claim_close(struct claim_scene *scene);

/* What a counting algorithm counted. */
struct claim_counts {
  const struct hsr_algorithm *algorithm;
  struct hsr_tally tally;
  uint32_t *ids; /* m * n, to be freed */
};

/* Draws scene->view with an algorithm and its options, "meagher:x=1". `listen`
 * gets its events, with `context`; NULL: nobody listens. Ends the test program
 * on failure. */
void claim_draw(struct claim_counts *counts, const struct claim_scene *scene,
                const char *algorithm,
                void (*listen)(void *context, const struct hsr_event *event),
                void *context);

/* The same, and only counts: counts->ids is NULL. */
void claim_count(struct claim_counts *counts, const struct claim_scene *scene,
                 const char *algorithm);

/* The value of a counter. Ends the test program if there is none of this name.
 */
uint64_t claim_value(const struct claim_counts *counts, const char *name);

#endif
