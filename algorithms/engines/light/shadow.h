/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What algorithms need to draw shadows: rays to the light, and their steps.
 *
 * Source      A. Appel, "Some techniques for shading machine renderings of
 *             solids", AFIPS SJCC 1968; docs/shadow-picture.md.
 * Method      An algorithm finds what is visible, and writes it: all samples
 *             are dark so far. Then it asks whether the visible face is turned
 *             to the light. If so, it tests the faces that may block the light
 *             from a sample, one after another, until one does. Algorithms
 *             differ in which faces they test. If none blocks, the sample is
 *             lit. */
#ifndef HSR_ALGORITHMS_SHADOW_H
#define HSR_ALGORITHMS_SHADOW_H

#include "algorithms/algorithm.h"
#include "common/exact/shadow.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_shadow {
  const struct hsr_job *job;
  bool *lit; /* of the answer: by sample of the picture */
  struct hsr_lighting lighting;
  uint32_t *blocker; /* the faces that may block, by ascending number */
  uint32_t n_blockers;
};

/* Begins a frame of a job that asks for HSR_SHADOWED: makes all samples dark.
 * The job and `screen`, whose planes have been filled in, are borrowed as long
 * as *shadow; memory is taken from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_shadow_begin(struct hsr_shadow *shadow,
                                 const struct hsr_job *job,
                                 const struct hsr_screen *screen);

/* Is face f turned to the light? It is visible in the window, which is that of
 * the step. */
bool hsr_shadow_faces(struct hsr_shadow *shadow, uint32_t f,
                      struct hsr_window window);

/* Tests n faces, one after another, for blocking the light from the point,
 * which is seen at sample (i, j). Returns the index of the first that blocks
 * it, or n. */
uint32_t hsr_shadow_test(struct hsr_shadow *shadow,
                         const struct hsr_lit_point *point, int i, int j,
                         const uint32_t *face, uint32_t n);

/* Does any of the blockers block the light from the point, which is seen at
 * sample (i, j)? `balls` are bounding spheres of the blockers. */
bool hsr_shadow_blocked(struct hsr_shadow *shadow,
                        const struct hsr_light_balls *balls,
                        const struct hsr_lit_point *point, int i, int j);

/* Writes that the samples [x0, x1) of row j, where f is visible, are lit. */
void hsr_shadow_lit(struct hsr_shadow *shadow, uint32_t f, int x0, int x1,
                    int j);

/* The part and its counters; shadow.c has their meanings. Groups of lines of
 * its outline: what is done for a visible face, and for a sample of it. */
extern const struct hsr_part hsr_shadow_part;
enum {
  HSR_LIGHT_FACINGS = HSR_FIRST_OF(HSR_PART_SHADOW),
  HSR_SHADOW_TESTS,
  HSR_LIT
};
enum { HSR_SHADOW_FACING_LINES, HSR_SHADOW_LINES };

#ifdef __cplusplus
}
#endif
#endif
