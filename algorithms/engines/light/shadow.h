/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What algorithms need to draw shadows: rays to the light, and their steps.
 *
 * Source      A. Appel, "Some techniques for shading machine renderings of
 *             solids", AFIPS SJCC 1968; docs/shadow-picture.md.
 * Method      An algorithm finds what is visible, and shows it; so far it is
 *             dark. Then it asks whether the face is turned to the light, and
 *             tests the faces that may block the light from a sample, one after
 *             another, until one does. Which faces these are is what algorithms
 *             differ in. A sample that none blocks is shown lit. */
#ifndef HSR_ALGORITHMS_SHADOW_H
#define HSR_ALGORITHMS_SHADOW_H

#include "algorithms/algorithm.h"
#include "common/exact/shadow.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_shadow {
  const struct hsr_job *job;
  bool *lit; /* of the answer */
  struct hsr_lighting lighting;
  uint32_t *blocker; /* the faces that may block, by ascending number */
  uint32_t n_blockers;
};

/* For a job of HSR_SHADOWED: no sample is lit so far. Memory is taken from
 * job->scratch. The planes of `screen` are filled in; it is borrowed.
 * HSR_E_NOMEM. */
enum hsr_status hsr_shadow_begin(struct hsr_shadow *shadow,
                                 const struct hsr_job *job,
                                 const struct hsr_screen *screen);

/* Whether face f, which is visible in the window, is turned to the light. */
bool hsr_shadow_faces(struct hsr_shadow *shadow, uint32_t f,
                      struct hsr_window window);

/* The index of the first of n faces that blocks the light from the point, or n.
 */
uint32_t hsr_shadow_test(struct hsr_shadow *shadow,
                         const struct hsr_lit_point *point, int i, int j,
                         const uint32_t *face, uint32_t n);

/* Whether any of the faces that may block does. Of these `balls` are. */
bool hsr_shadow_blocked(struct hsr_shadow *shadow,
                        const struct hsr_light_balls *balls,
                        const struct hsr_lit_point *point, int i, int j);

/* Shows that the samples [x0, x1) of row j, where f is visible, are lit. */
void hsr_shadow_lit(struct hsr_shadow *shadow, uint32_t f, int x0, int x1,
                    int j);

/* What these count; and the groups of lines: of a visible face, and of a sample of
 * it. */
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
