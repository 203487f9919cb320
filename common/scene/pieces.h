/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Divided faces.
 *
 * Source      Sutherland et al. 1974: faces are divided where they penetrate or
 *             overlap cyclically ("List-Priority Algorithms"), and where an
 *             algorithm wants triangles.
 * Cut         a piece of a face is that face, and a list of cuts, each of them
 *             a side of some face's plane. Whether a sample of the face lies in
 *             the piece is the comparison of two planes there, so a cut moves
 *             no edge and opens no crack: on every sample exactly one of two
 *             halves holds.
 * Loop        a piece may also have a loop of its own through vertices of its
 *             parent, as the triangles of a polygon have. Its plane is the
 *             parent's still, and samples belong to the loops of a face as they
 *             belong to the face itself: by parity.
 * Outline     approximate vertices, that hold all of the piece; for bounds.
 *
 * A world of pieces is a world like any other: its faces are the pieces, in the
 * order of their parents, so that ties fall to the same face. Whoever renders
 * it asks hsr_world_parent for the ids of the scene. */
#ifndef HSR_COMMON_PIECES_H
#define HSR_COMMON_PIECES_H

#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One side of the plane of face `face`: +1 in front of it, -1 behind. */
struct hsr_cut {
  uint32_t face;
  int side;
};

struct hsr_pieces {
  const struct hsr_world *whole; /* whose faces they are pieces of; no pieces */
  uint32_t *parent;              /* a piece: its face in `whole` */
  uint32_t *first;               /* a face of `whole`: its first piece; + 1 */

  uint32_t *cut_start; /* a piece: its cuts are cut[cut_start[f]] up to the */
  struct hsr_cut *cut; /* next one's; they name pieces of the cutting faces */

  /* The outline of piece f: vertices outline[outline_start[f]], ... of the
   * world of pieces, each within outline_error in every component; empty if
   * its loop is all that is known of it. */
  uint32_t *outline_start, *outline;
  double outline_error;
};

/* Pieces to make a world of; ascending parents, at least one of each face. All
 * arrays as in hsr_pieces and hsr_world, but for the outlines' points, which
 * come as coordinates, three a point. Owned by the caller. */
struct hsr_piece_list {
  uint32_t n;
  const uint32_t *parent;
  const uint32_t *start, *vertex; /* loops; vertices of `whole` */
  const uint32_t *cut_start;
  const struct hsr_cut *cut; /* these name faces of `whole` */
  const uint32_t *outline_start;
  const double *outline;
};

/* The world of these pieces of the faces of `whole`, which is borrowed and
 * outlives it. Freed with hsr_world_free, also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_world_of_pieces(struct hsr_world *world,
                                    const struct hsr_world *whole,
                                    const struct hsr_piece_list *list,
                                    struct hsr_error *err);

/* The face of the scene that face f of any world is, or is a piece of. */
static inline uint32_t hsr_world_parent(const struct hsr_world *world,
                                        uint32_t f) {
  return world->pieces ? world->pieces->parent[f] : f;
}

/* A polygon on the same plane as face f, by which the plane is defined: its own
 * corners, or of a piece its parent's. */
static inline struct hsr_loop hsr_plane_loop(const struct hsr_world *world,
                                             uint32_t f) {
  const struct hsr_pieces *pieces = world->pieces;
  return pieces ? hsr_face_loop(pieces->whole, pieces->parent[f])
                : hsr_face_loop(world, f);
}

#ifdef __cplusplus
}
#endif
#endif
