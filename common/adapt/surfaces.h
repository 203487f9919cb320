/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Surfaces: faces that hang together by the edges they share; and which of them
 * do not meet.
 *
 * Source      Sutherland et al. 1974, chapter IV, "Edge Coherence": what edges
 *             tell that are no contour edges, where penetration is accounted
 *             for; and "Frame and Object Coherence", that this can be done once
 *             for all views.
 * Shared      an edge is shared if two faces have it, and no third.
 * Apart       two surfaces are apart if no face of one meets a face of the
 *             other; a surface is apart from itself if its faces meet in what
 *             they share and nowhere else. Touching is meeting.
 * Certain     surfaces that are said to be apart are. Two faces are told apart
 *             by their boxes, by the plane of one of them, or, in one plane, by
 *             the line of an edge; where these do not tell, they are taken to
 *             meet, as two squares of a grid that share a corner. So is a face
 *             that is not flat, with everything: what is seen of it is on its
 *             plane, and its neighbours' on theirs. */
#ifndef HSR_COMMON_SURFACES_H
#define HSR_COMMON_SURFACES_H

#include "common/base/status.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_NOT_SHARED UINT32_MAX

struct hsr_surfaces {
  uint32_t n;        /* surfaces */
  uint32_t *surface; /* by face */
  bool *meets_all;   /* by surface: it has a face that is not flat */

  /* By corner k of a face: the number of the edge from that corner to the next
   * one of the face, or HSR_NOT_SHARED. */
  uint32_t *shared, n_shared;

  uint64_t
      *meeting; /* pairs, ascending: the lesser surface in the upper half */
  size_t n_meeting;
};

/* Of a world that is laid out. *surfaces is written in full, and freed with
 * hsr_surfaces_free also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_surfaces_init(struct hsr_surfaces *surfaces,
                                  const struct hsr_world *world,
                                  struct hsr_error *err);
void hsr_surfaces_free(struct hsr_surfaces *surfaces);

/* Whether the surfaces of two faces are apart. */
bool hsr_surfaces_apart(const struct hsr_surfaces *surfaces, uint32_t f,
                        uint32_t g);

#ifdef __cplusplus
}
#endif
#endif
