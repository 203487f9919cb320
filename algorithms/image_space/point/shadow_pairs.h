/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shadow pairs: which faces may cast a shadow on which, found by projecting
 * faces about the light.
 *
 * Source      J. Bouknight and K. Kelley, "An algorithm for producing half-tone
 *             computer graphics presentations with shadows and movable light
 *             sources", AFIPS SJCC 1970, 1-10: faces are projected about the
 *             light, and a scan line of the picture is searched only for the
 *             shadows of faces whose projection overlaps that of the visible
 *             one.
 * Method      Faces are projected on the sides of a cube about the light, or if
 *             the light is a sun, on one plane; of each
 *             projection a box is kept. Two faces whose boxes are apart on all
 *             sides are no pair. Nor are two if the plane of one has the other
 *             on the side away from the light. For a visible segment of a face,
 *             those of its pairs are tested whose boxes overlap that of the
 *             segment.
 * Invariant   a face that blocks the light from a visible point of f is in the
 *             list of f
 * Departures  The list of a face is made when the face is first seen, not
 *             beforehand: most faces are not seen. Of a segment's faces, the
 *             one that blocked the light last is tested first.
 * Cost        a comparison with each blocker, for each face that is seen and
 *             faces the light */
#ifndef HSR_ALGORITHMS_SHADOW_PAIRS_H
#define HSR_ALGORITHMS_SHADOW_PAIRS_H

#include "algorithms/engines/light/shadow.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The n faces that may cast a shadow on a face, as indices of shadow.blocker[].
 * n is HSR_NO_ID until they have been found. */
struct hsr_casters {
  uint32_t *blocker, n;
};

struct hsr_shadow_pairs {
  struct hsr_shadow shadow;
  struct hsr_light_box *box;   /* by blocker, and by side of the cube */
  bool *seen;                  /* likewise: the light sees it on that side */
  struct hsr_casters *casters; /* by face */
  uint32_t *found; /* room for a list that is being made; then the faces of a
                      segment */
};

/* Begins a frame of a job that asks for HSR_SHADOWED; otherwise as
 * hsr_shadow_begin. HSR_E_NOMEM. */
enum hsr_status hsr_shadow_pairs_begin(struct hsr_shadow_pairs *pairs,
                                       const struct hsr_job *job,
                                       const struct hsr_screen *screen);

/* Writes which samples of the segment [x0, x1) of row j are lit. f is visible
 * there; it may be HSR_BACKGROUND. HSR_E_NOMEM. */
enum hsr_status hsr_shadow_pairs_show(struct hsr_shadow_pairs *pairs,
                                      uint32_t f, int x0, int x1, int j);

/* The part, besides hsr_shadow_part, whose lines stand within its own; and its
 * counters. */
extern const struct hsr_part hsr_shadow_pairs_part;
enum {
  HSR_PAIR_TESTS = HSR_FIRST_OF(HSR_PART_SHADOW_PAIRS),
  HSR_SEGMENT_TESTS
};

#ifdef __cplusplus
}
#endif
#endif
