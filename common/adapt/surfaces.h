/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Surfaces, which are faces connected by shared edges, and which surfaces do
 * not meet.
 *
 * Source      Sutherland et al. 1974, chapter IV: "Edge Coherence", on edges
 *             that are not contour edges, if penetration is accounted for; and
 *             "Frame and Object Coherence", on doing this once for all views.
 * Shared      an edge is shared if exactly two faces have it.
 * Apart       two surfaces are apart if no face of one meets a face of the
 *             other. A surface is apart from itself if its faces meet only in
 *             vertices and edges that they share. Faces that touch meet.
 * Certain     if surfaces are said to be apart, they are. The tests are the
 *             boxes of two faces, the plane of one of them and, if they are in
 *             one plane, the line of an edge. Faces that no test separates are
 *             taken to meet, as two squares of a grid that share only a corner.
 *             A face that is not flat is taken to meet everything, since it is
 *             drawn on its plane and its neighbours are drawn on theirs. */
#ifndef HSR_COMMON_SURFACES_H
#define HSR_COMMON_SURFACES_H

#include "common/base/status.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_NOT_SHARED UINT32_MAX

/* The surfaces of a world. They own their arrays. */
struct hsr_surfaces {
  uint32_t n;        /* surfaces */
  uint32_t *surface; /* by face: the number of its surface */
  bool *meets_all;   /* by surface: it has a face that is not flat */

  /* By corner of the mesh, start[f] + k: the number, below n_shared, of the
   * shared edge from corner k of face f to the next one; HSR_NOT_SHARED if that
   * edge is not shared. */
  uint32_t *shared, n_shared;

  /* The pairs of surfaces that meet, ascending: the lesser number in the upper
   * 32 bits, the greater in the lower ones. */
  uint64_t *meeting;
  size_t n_meeting;
};

/* Finds the surfaces of a world that is laid out. *surfaces is written in full,
 * and is freed with hsr_surfaces_free also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_surfaces_init(struct hsr_surfaces *surfaces,
                                  const struct hsr_world *world,
                                  struct hsr_error *err);

/* Frees what the surfaces own. */
void hsr_surfaces_free(struct hsr_surfaces *surfaces);

/* Whether the surfaces of faces f and g, which may be one surface, are
 * apart. */
bool hsr_surfaces_apart(const struct hsr_surfaces *surfaces, uint32_t f,
                        uint32_t g);

#ifdef __cplusplus
}
#endif
#endif
