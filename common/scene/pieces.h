/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Divided faces.
 *
 * Source      Sutherland et al. 1974: faces are divided where they penetrate or
 *             overlap cyclically ("List-Priority Algorithms"), and where an
 *             algorithm wants triangles.
 * Cut         a piece of a face is that face and a list of cuts. A cut is one
 *             side of some face's plane. Two planes are compared at a sample of
 *             the face to tell whether it lies in the piece. So a cut moves no
 *             edge and opens no crack: every sample is in exactly one of the
 *             two halves.
 * Loop        a piece may also have a loop of its own through vertices of its
 *             parent, as the triangles of a polygon have. Its plane is still
 *             the parent's. Samples belong to a loop by parity, as they belong
 *             to a face.
 * Outline     approximate vertices whose hull holds all of the piece; for
 *             bounds.
 *
 * A world of pieces is a world like any other. Its faces are the pieces, in the
 * order of their parents, so that ties fall to the same face. A renderer calls
 * hsr_world_parent for the ids of the scene. */
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
  const struct hsr_world *whole; /* the world that was divided, not itself of
                                    pieces; borrowed */
  uint32_t *parent;              /* a piece: its face in `whole` */

  /* The first piece of each face of `whole`; n_faces + 1 entries. */
  uint32_t *first;

  /* The cuts of piece f are cut[cut_start[f]], ..., cut[cut_start[f+1] - 1].
   * They name pieces of the cutting faces. */
  uint32_t *cut_start;
  struct hsr_cut *cut;

  /* The outline of piece f: vertices outline[outline_start[f]], ...,
   * outline[outline_start[f+1] - 1] of the world of pieces, each within
   * outline_error (world units) in every component. Empty if only the loop is
   * known. */
  uint32_t *outline_start, *outline;
  double outline_error;
};

/* Pieces to make a world of: parents ascend, and every face of `whole` has at
 * least one piece. The arrays are as in hsr_pieces and hsr_world, except that
 * an outline is a list of coordinates, three a point. Owned by the caller. */
struct hsr_piece_list {
  uint32_t n;
  const uint32_t *parent;
  const uint32_t *start, *vertex; /* loops; vertices of `whole` */
  const uint32_t *cut_start;
  const struct hsr_cut *cut; /* these name faces of `whole` */
  const uint32_t *outline_start;
  const double *outline;
};

/* Makes *world of these pieces of the faces of `whole`, which is borrowed and
 * must outlive it; *list is copied. Freed with hsr_world_free, also after a
 * failure. HSR_E_NOMEM. */
enum hsr_status hsr_world_of_pieces(struct hsr_world *world,
                                    const struct hsr_world *whole,
                                    const struct hsr_piece_list *list,
                                    struct hsr_error *err);

/* The parent of piece f in a world of pieces; in any other world, f itself. */
static inline uint32_t hsr_world_parent(const struct hsr_world *world,
                                        uint32_t f) {
  return world->pieces ? world->pieces->parent[f] : f;
}

/* The polygon that defines the plane of face f: the face's own corners or, for
 * a piece, its parent's. */
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
