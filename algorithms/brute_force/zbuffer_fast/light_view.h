/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shadows by a second view, from the light.
 *
 * Source      L. Williams, "Casting curved shadows on curved surfaces",
 *             SIGGRAPH 1978, Computer Graphics 12(3), 270-274: what is visible
 *             is looked up in a picture that the light sees. That picture has samples of
 *             its own, so its answers are approximate. Its exact form keeps in
 *             each cell of the light's picture all that may be seen there: T.
 *             Aila and S. Laine, "Alias-free shadow maps", Eurographics
 *             Symposium on Rendering 2004; G. S. Johnson et al., "The irregular
 *             z-buffer", ACM Transactions on Graphics 24(4), 2005.
 * Method      The light's picture (common/exact/shadow.h) is cut into square
 *             cells. Each face is put into the cells that its box meets; a face
 *             that meets too many is kept apart, for the whole side. For each
 *             visible sample the faces of its cell are tested, and then those
 *             of its side, until one blocks.
 * Invariant   a face that blocks the light from P is in each cell that may hold
 *             the image of P, or is one of its side's
 * Departures  Williams keeps the nearest depth; Aila and Laine put the samples
 *             into the cells, and not the faces. In a list the face that
 *             blocked last is tried first.
 * Cost        a step for each face and cell; a test for each face in a sample's
 *             cell */
#ifndef HSR_ALGORITHMS_LIGHT_VIEW_H
#define HSR_ALGORITHMS_LIGHT_VIEW_H

#include "algorithms/engines/light/shadow.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Some faces, which are tried in this order. */
struct hsr_light_list {
  uint32_t *face, n;
};

/* A side of the light's picture. */
struct hsr_light_side {
  double low[2], scale[2];     /* where it begins, and cells a unit */
  struct hsr_light_list *cell; /* cells x cells, by rows */
  struct hsr_light_list wide;  /* the faces that are kept apart */
};

struct hsr_light_view {
  struct hsr_shadow shadow;
  int cells; /* in a row and column of a side */
  struct hsr_light_side side[HSR_LIGHT_SIDES];
};

/* For a job of HSR_SHADOWED: sees the scene from the light. As
 * hsr_shadow_begin. */
enum hsr_status hsr_light_view_begin(struct hsr_light_view *view,
                                     const struct hsr_job *job,
                                     const struct hsr_screen *screen);

/* Shows the samples of the job's window lit or not; its ids are written. */
void hsr_light_view_show(struct hsr_light_view *view);

/* What it counts, besides what shadow.h does. Its lines hold those. */
extern const struct hsr_part hsr_light_view_part;
enum { HSR_LIGHT_CELLS = HSR_FIRST_OF(HSR_PART_LIGHT_VIEW), HSR_LIGHT_WIDE };

#ifdef __cplusplus
}
#endif
#endif
