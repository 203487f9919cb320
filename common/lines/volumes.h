/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The convex volumes of a world. Nothing here depends on the view.
 *
 * Source      L. G. Roberts, "Machine Perception of Three-Dimensional Solids",
 *             MIT Lincoln Laboratory TR 315, 1963; Sutherland et al. 1974,
 *             "Object-Space Algorithms", eq. 8: a point is in a volume if it is
 *             inside all of its planes.
 * Body        a solid, or all faces of an instance that belong to no solid.
 * Solid       a connected, closed set of flat faces. Every edge has exactly two
 *             of them, which run along it in opposite directions. The set
 *             touches itself nowhere else. If the faces are one-sided, their
 *             fronts are outside. As seen from outside, the faces of a solid
 *             hide a point if and only if its volume hides it.
 * Parts       a solid that is not convex is divided into convex parts by planes
 *             of its own faces. The walls between parts are not faces and have
 *             no edges: a ray that passes through a wall is already inside the
 *             solid.
 * Flat        a face that is flat and simple is also a volume of no thickness,
 *             or several volumes if it is not convex. These serve bodies that
 *             are not solids, and bodies that a view cuts. Two of the planes of
 *             such a volume are the face's own, one for each side.
 * Rims        a rim is a line in which two planes of a volume meet. Every rim
 *             that can be in the contour must be listed. Other rims may be
 *             listed too. A rim of planes that do not bound the volume there
 *             does no harm. */
#ifndef HSR_COMMON_VOLUMES_H
#define HSR_COMMON_VOLUMES_H

#include "common/lines/edges.h"
#include "common/lines/sight/sight.h"
#include "common/scene/pieces.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Two planes of one volume, as indices into hsr_volumes.plane. For an eye
 * outside `plane`, the volume is on side -1 of the rim's line, as
 * hsr_sight_find_half has sides. For an eye outside `other`, it is on side
 * +1. */
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
   * plane[plane_start[v+1] - 1], each given as the side of a face's plane on
   * which the volume is. It has rims likewise. */
  uint32_t n;
  uint32_t *plane_start, *rim_start; /* n + 1 */
  struct hsr_cut *plane;
  struct hsr_rim *rim;
  struct hsr_sight_line *line; /* by rim: its line */

  /* As a flat volume, face f is the volumes flat[f], ..., flat[f+1] - 1. There
   * are none if it is not simple. Flat volumes come before all others. */
  uint32_t *flat; /* n_faces + 1 */

  struct hsr_space *space; /* boxes that hold the volumes that are not flat.
                              space[0] is of volume flat[n_faces] */

  /* Body b has the faces face[face_start[b]], ..., face[face_start[b+1] - 1],
   * and its vertices are in `corner`, likewise. As a solid, it is the volumes
   * solid_start[b], ..., solid_start[b+1] - 1. There are none if it is not a
   * solid. */
  uint32_t n_bodies;
  uint32_t *face_start, *corner_start, *solid_start; /* n_bodies + 1 */
  uint32_t *face, *corner;

  uint32_t n_solids, n_convex; /* solids; those that are one convex volume */
  uint32_t n_parts;            /* volumes of the solids that are not convex */
  uint32_t n_too_large; /* solids that are treated as single faces, because
                           dividing them costs too much (volumes_cgal.cc) */

  struct hsr_arena arena; /* holds the arrays */
};

/* Finds the volumes of a world. `edges` is borrowed and must outlive *volumes.
 * *volumes is written in full, and is freed with hsr_volumes_free also after a
 * failure. HSR_E_NOMEM. */
enum hsr_status hsr_volumes_init(struct hsr_volumes *volumes,
                                 const struct hsr_edges *edges,
                                 struct hsr_error *err);

/* Frees what the volumes own. */
void hsr_volumes_free(struct hsr_volumes *volumes);

#ifdef __cplusplus
}
#endif
#endif
