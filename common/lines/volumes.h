/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The convex volumes of a world: what does not depend on the view.
 *
 * Source      L. G. Roberts, "Machine Perception of Three-Dimensional Solids",
 *             MIT Lincoln Laboratory TR 315, 1963; Sutherland et al. 1974,
 *             "Object-Space Algorithms", eq. 8: a point is in a volume if it is
 *             inside all of its planes.
 * Body        a closed solid, or what faces of an instance belong to none.
 * Solid       a connected set of flat faces, of which every edge has two, run
 *             through in both directions; it touches itself nowhere else. If it
 *             is one-sided its front is outside. Seen from outside, whatever
 *             hides a point by the faces of a solid hides it by the solid's
 *             volume, and the other way round.
 * Parts       a solid that is not convex is divided, by planes of its own
 *             faces, into convex ones. The walls in between are no faces and
 *             have no edges; whoever passes through one is inside the solid
 *             already.
 * Flat        any face, flat and simple, is a volume of no thickness, or
 *             several if it is not convex: for bodies that are no solid, or
 *             that a view cuts. Its planes are its own, from both sides.
 * Rims        where two planes of a volume meet. Those which can be its contour
 *             must be there, others may be: rims of planes that bound it
 *             nowhere say nothing that is not true. */
#ifndef HSR_COMMON_VOLUMES_H
#define HSR_COMMON_VOLUMES_H

#include "common/lines/edges.h"
#include "common/lines/sight/sight.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What is on one side of the plane of a face: +1 in front of it, -1 behind. */
struct hsr_half_space {
  uint32_t face;
  int side;
};

/* Planes of one volume, by their numbers among all. From outside of `plane`,
 * the volume is on side -1 of the rim's line (hsr_sight_narrow); from outside
 * of `other`, on side +1. */
struct hsr_rim {
  uint32_t plane, other;
};

struct hsr_space {
  double lo[3], hi[3];
};

struct hsr_volumes {
  const struct hsr_edges *edges; /* borrowed */

  /* Volume v: planes plane_start[v], ... up to the next one's; likewise rims.
   */
  uint32_t n;
  uint32_t *plane_start, *rim_start; /* n + 1 */
  struct hsr_half_space *plane;
  struct hsr_rim *rim;
  struct hsr_sight_line *line; /* of a rim */

  /* Face f as volumes flat[f], ... up to the next one's; none if it is not
   * simple. They come before all others. */
  uint32_t *flat; /* n_faces + 1 */

  struct hsr_space *space; /* what each of the others lies within, from volume
                              flat[n_faces] on */

  /* Body b: its faces, corners, and its volumes as a solid, of which there are
   * none if it is none. */
  uint32_t n_bodies;
  uint32_t *face_start, *corner_start, *solid_start; /* n_bodies + 1 */
  uint32_t *face, *corner;

  uint32_t n_solids, n_convex; /* bodies; those that are one convex volume */
  uint32_t n_parts;            /* volumes of the other solids */
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
