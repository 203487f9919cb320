/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shadows by a second view, from the light.
 *
 * Source      L. Williams, "Casting curved shadows on curved surfaces",
 *             SIGGRAPH 1978, Computer Graphics 12(3), 270-274: a visible point
 *             is lit if it is visible in a picture drawn from the light, too.
 *             That picture has samples of its own, so the answer is
 *             approximate. An exact form keeps, in each cell of the light's
 *             picture, all that may be seen there: T.
 *             Aila and S. Laine, "Alias-free shadow maps", Eurographics
 *             Symposium on Rendering 2004; G. S. Johnson et al., "The irregular
 *             z-buffer", ACM Transactions on Graphics 24(4), 2005.
 * Method      The light's picture has one side or six (common/exact/shadow.h).
 *             Each is divided into square cells. A face is put into the cells
 *             that its box meets; a face that meets too many is kept apart, for
 *             the whole side. For each visible sample, the faces of its cell
 *             are tested for blocking the light, and then those of its side,
 *             until one blocks it.
 * Invariant   a face that blocks the light from P is in each cell that may hold
 *             the image of P, or is kept apart for the side of P
 * Departures  Williams keeps the nearest depth in a cell; Aila and Laine put
 *             samples into the cells; here faces are put into them. In a list,
 *             the face that blocked last is tried first.
 * Cost        a step for each face and cell; a test for each face in a sample's
 *             cell */
#ifndef HSR_ALGORITHMS_LIGHT_VIEW_H
#define HSR_ALGORITHMS_LIGHT_VIEW_H

#include "algorithms/engines/light/shadow.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Faces, in the order in which they are tested. */
struct hsr_light_list {
  uint32_t *face, n;
};

/* A side of the light's picture. */
struct hsr_light_side {
  double low[2], scale[2];     /* where it begins; cells to a unit of length */
  struct hsr_light_list *cell; /* its cells, row by row */
  struct hsr_light_list wide;  /* the faces that are kept apart */
};

struct hsr_light_view {
  struct hsr_shadow shadow;
  int cells; /* along each direction of a side */
  struct hsr_light_side side[HSR_LIGHT_SIDES];
};

/* Begins a frame of a job that asks for HSR_SHADOWED, as hsr_shadow_begin, and
 * puts the faces into the cells of the light's picture. HSR_E_NOMEM. */
enum hsr_status hsr_light_view_begin(struct hsr_light_view *view,
                                     const struct hsr_job *job,
                                     const struct hsr_screen *screen);

/* Writes for each sample of the job's window whether it is lit. The ids of the
 * window have been written. */
void hsr_light_view_show(struct hsr_light_view *view);

/* The part, besides hsr_shadow_part, whose lines stand within its own; and its
 * counters. */
extern const struct hsr_part hsr_light_view_part;
enum { HSR_LIGHT_CELLS = HSR_FIRST_OF(HSR_PART_LIGHT_VIEW), HSR_LIGHT_WIDE };

#ifdef __cplusplus
}
#endif
#endif
