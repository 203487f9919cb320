/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The convex volumes of a world. Nothing here depends on the view.
 *
 * Source      L. G. Roberts, "Machine Perception of Three-Dimensional Solids",
 *             MIT Lincoln Laboratory TR 315, 1963; Sutherland et al. 1974,
 *             "Object-Space Algorithms", eq. 8: a point is in a volume if it is
 *             inside all of its planes.
 * Body        a closed solid, or all faces of an instance that belong to none.
 * Solid       a connected set of flat faces. Every edge has two of them, which
 *             run along it in opposite directions, and the set touches itself
 *             nowhere else. If it is one-sided its front is outside. Seen from
 *             outside, the faces of a solid hide a point if and only if its
 *             volume hides it.
 * Parts       a solid that is not convex is divided into convex parts, by
 *             planes of its own faces. The walls between parts are no faces and
 *             have no edges: a ray that passes through one is already inside
 *             the solid.
 * Flat        a face that is flat and simple is also a volume of no thickness,
 *             or several if it is not convex. These serve bodies that are no
 *             solid, and bodies that a view cuts. Their two planes are the
 *             face's own, from both sides.
 * Rims        where two planes of a volume meet. Every rim that can be in the
 *             contour must be listed. Others may be: a rim of planes that do
 *             not bound the volume there does no harm. */
#ifndef HSR_COMMON_VOLUMES_H
#define HSR_COMMON_VOLUMES_H

#include "common/lines/edges.h"
#include "common/lines/sight/sight.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One side of the plane of a face: +1 in front of it, -1 behind. */
struct hsr_half_space {
  uint32_t face;
  int side;
};

/* Two planes of one volume, as indices into hsr_volumes.plane. Seen from
 * outside `plane`, the volume is on side -1 of the rim's line
 * (hsr_sight_narrow); from outside `other`, on side +1. */
struct hsr_rim {
  uint32_t plane, other;
};

/* A box, in world units. */
struct hsr_space {
  double lo[3], hi[3];
};

struct hsr_volumes {
  const struct hsr_edges *edges; /* borrowed */

  /* Volume v has the planes plane[plane_start[v]], ...,
   * plane[plane_start[v+1] - 1]; likewise rims. */
  uint32_t n;
  uint32_t *plane_start, *rim_start; /* n + 1 */
  struct hsr_half_space *plane;
  struct hsr_rim *rim;
  struct hsr_sight_line *line; /* of a rim */

  /* Face f is the volumes flat[f], ..., flat[f+1] - 1: none if it is not
   * simple. These come before all others. */
  uint32_t *flat; /* n_faces + 1 */

  struct hsr_space *space; /* boxes that hold the other volumes, the first for
                              volume flat[n_faces] */

  /* Body b: its faces, its corners, and its volumes as a solid. The last are
   * the volumes solid_start[b], ..., solid_start[b+1] - 1: none if it is no
   * solid. */
  uint32_t n_bodies;
  uint32_t *face_start, *corner_start, *solid_start; /* n_bodies + 1 */
  uint32_t *face, *corner;

  uint32_t n_solids, n_convex; /* solids; those that are one convex volume */
  uint32_t n_parts;            /* the volumes of the other solids */
  uint32_t n_too_large; /* solids taken face by face: see volumes_cgal.cc */

  struct hsr_arena arena; /* holds the arrays */
};

/* Finds the volumes; `edges` is borrowed and outlives them. Freed with
 * hsr_volumes_free, also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_volumes_init(struct hsr_volumes *volumes,
                                 const struct hsr_edges *edges,
                                 struct hsr_error *err);
void hsr_volumes_free(struct hsr_volumes *volumes);

#ifdef __cplusplus
}
#endif
#endif
