/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which faces may shade which: pairs, found by projecting faces about the
 * light.
 *
 * Source      J. Bouknight and K. Kelley, "An algorithm for producing half-tone
 *             computer graphics presentations with shadows and movable light
 *             sources", AFIPS SJCC 1970, 1-10: faces are projected about the
 *             light, and a scan line of the picture is searched only for the
 *             shadows of faces whose projection overlaps that of the visible
 *             one.
 * Method      The projections are boxes on the sides of a cube about the light,
 *             or across the rays of a sun. Faces whose boxes are apart on all
 *             sides are no pair; nor are two of which the plane of one has the
 *             other on its wrong side. Of the pairs of a face, those matter to
 *             a visible segment of it whose boxes overlap the segment's.
 * Invariant   a face that blocks the light from what is seen of f is in the
 *             list of f
 * Departures  The list of a face is made when the face is first seen, not
 *             beforehand: most faces are not seen. Within a list, the face that
 *             blocked last is tried first.
 * Cost        F tests of boxes for each face that is seen and faces the light
 */
#ifndef HSR_ALGORITHMS_SHADOW_PAIRS_H
#define HSR_ALGORITHMS_SHADOW_PAIRS_H

#include "algorithms/engines/light/shadow.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The faces that may shade one, by their numbers among the blockers; not yet
 * known: n is HSR_NO_ID. */
struct hsr_casters {
  uint32_t *blocker, n;
};

struct hsr_shadow_pairs {
  struct hsr_shadow shadow;
  struct hsr_light_box *box;   /* a blocker and side, by their numbers */
  bool *seen;                  /* the same: the light sees it on that side */
  struct hsr_casters *casters; /* a face */
  uint32_t *found; /* room for a list; then, the faces of a segment */
};

/* For a job of HSR_SHADOWED; as hsr_shadow_begin. */
enum hsr_status hsr_shadow_pairs_begin(struct hsr_shadow_pairs *pairs,
                                       const struct hsr_job *job,
                                       const struct hsr_screen *screen);

/* The segment [x0, x1) of row j, where f is visible, in light and shadow.
 * HSR_E_NOMEM. */
enum hsr_status hsr_shadow_pairs_show(struct hsr_shadow_pairs *pairs,
                                      uint32_t f, int x0, int x1, int j);

/* What it counts, besides what shadow.h does. Its lines hold those. */
extern const struct hsr_part hsr_shadow_pairs_part;
enum {
  HSR_PAIR_TESTS = HSR_FIRST_OF(HSR_PART_SHADOW_PAIRS),
  HSR_SEGMENT_TESTS
};

#ifdef __cplusplus
}
#endif
#endif
