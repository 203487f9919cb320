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
  struct hsr_lighting lighting;
  int first;         /* the number of the first counter below */
  uint32_t *blocker; /* the faces that may block, by ascending number */
  uint32_t n_blockers;
};

/* For a job of HSR_SHADOWED: no sample is lit so far. Memory is taken from
 * job->scratch. The planes of `screen` are filled in; it is borrowed.
 * HSR_E_NOMEM. */
enum hsr_status hsr_shadow_begin(struct hsr_shadow *shadow,
                                 const struct hsr_job *job,
                                 const struct hsr_screen *screen, int first);

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

/* The counters that these keep, in their order, and their lines of an outline,
 * `in` blanks deep. */
enum { HSR_LIGHT_FACINGS, HSR_SHADOW_TESTS, HSR_LIT, HSR_N_SHADOW_COUNTERS };
#define HSR_SHADOW_COUNTERS                                                    \
  {"light facings", "visible faces tested for being turned to the light",      \
   HSR_COMPARE,     HSR_OF_FACE,                                               \
   HSR_OF_WINDOW,   "turned away|turned to it"},                               \
      {"shadow tests",                                                         \
       "faces tested for blocking the light from what is seen of a face",      \
       HSR_COMPARE,                                                            \
       HSR_OF_FACE,                                                            \
       HSR_OF_FACE,                                                            \
       "does not block|blocks"},                                               \
  {                                                                            \
    "lit", "stretches of samples shown lit", HSR_ACCEPT, HSR_OF_FACE,          \
        HSR_OF_WINDOW                                                          \
  }
#define HSR_SHADOW_FACING_LINE(first, in)                                      \
  {                                                                            \
    in "with shadows: is the face turned to the light?",                       \
        HSR_RAISES((first) + HSR_LIGHT_FACINGS)                                \
  }
#define HSR_SHADOW_LINES(first, in)                                            \
  {in "does another face block the light from the sample?",                    \
   HSR_RAISES((first) + HSR_SHADOW_TESTS)},                                    \
  {                                                                            \
    in "if none does, show the sample lit", HSR_RAISES((first) + HSR_LIT)      \
  }

#ifdef __cplusplus
}
#endif
#endif
