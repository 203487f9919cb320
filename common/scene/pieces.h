/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Divided faces.
 *
 * Source      Sutherland et al. 1974: faces are divided where they penetrate or
 *             overlap cyclically ("List-Priority Algorithms"), and where an
 *             algorithm needs triangles.
 * Cut         a piece is a face, its parent, and a list of cuts. A cut is one
 *             side of the plane of some face. A sample of the parent lies in
 *             the piece if it is on the right side of every cut. To decide
 *             that, the depths of two planes are compared at the sample. So a
 *             cut moves no edge and opens no crack: every sample is in exactly
 *             one of the two halves.
 * Loop        a piece may also have a loop of its own through vertices of its
 *             parent, as the triangles of a polygon do. Its plane is still the
 *             parent's. As with a face, parity decides which samples are in the
 *             loop.
 * Outline     approximate vertices whose hull holds all of the piece. It serves
 *             for bounds.
 *
 * A world of pieces is a world like any other. Its faces are the pieces, in the
 * order of their parents, so that ties are decided for the same face as in the
 * whole world. A renderer calls hsr_world_parent to get the ids of the
 * scene. */
#ifndef HSR_COMMON_PIECES_H
#define HSR_COMMON_PIECES_H

#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(protected) /* for modules: hsr-module.h */

/* One side of the plane of face `face`: +1 in front of it, -1 behind. */
struct hsr_cut {
  uint32_t face;
  int side;
};

/* What the faces of a world of pieces are. The arrays are in that world's
 * arena; n below is its n_faces. */
struct hsr_pieces {
  const struct hsr_world *whole; /* the world that was divided, which is not
                                    itself of pieces; borrowed */
  uint32_t *parent;              /* n: the face in `whole` of each piece */

  /* The first piece of each face of `whole`; whole->n_faces + 1 entries, the
   * last of which is n. */
  uint32_t *first;

  /* The cuts of piece f are cut[cut_start[f]], ..., cut[cut_start[f+1] - 1].
   * The face of a cut is a number in the world of pieces: the first piece of
   * the face that cuts. */
  uint32_t *cut_start;
  struct hsr_cut *cut;

  /* The outline of piece f has the vertices outline[outline_start[f]], ...,
   * outline[outline_start[f+1] - 1] of the world of pieces. Each coordinate is
   * off by at most outline_error, in world units. The outline is empty if only
   * the loop is known. */
  uint32_t *outline_start, *outline;
  double outline_error;
};

/* Pieces to make a world of, in ascending order of their parents. Every face of
 * `whole` has at least one. The arrays are as in hsr_pieces and hsr_mesh, but
 * the outlines are coordinates, x, y, z of each point. Owned by the caller. */
struct hsr_piece_list {
  uint32_t n;
  const uint32_t *parent;
  const uint32_t *start, *vertex; /* loops, by vertices of `whole` */
  const uint32_t *cut_start;
  const struct hsr_cut *cut; /* by faces of `whole` */
  const uint32_t *outline_start;
  const double *outline;
};

/* Makes a world of pieces of the faces of `whole`. `whole` is borrowed and must
 * outlive *world. *list is copied. *world is written in full, and is freed with
 * hsr_world_free also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_world_of_pieces(struct hsr_world *world,
                                    const struct hsr_world *whole,
                                    const struct hsr_piece_list *list,
                                    struct hsr_error *err);

/* Returns the parent of piece f in a world of pieces, and f itself in any other
 * world. */
static inline uint32_t hsr_world_parent(const struct hsr_world *world,
                                        uint32_t f) {
  return world->pieces ? world->pieces->parent[f] : f;
}

/* Returns a polygon that defines the plane of face f: that of the face itself
 * or, in a world of pieces, of its parent. The world must be laid out. */
static inline struct hsr_loop hsr_plane_loop(const struct hsr_world *world,
                                             uint32_t f) {
  const struct hsr_pieces *pieces = world->pieces;
  return pieces ? hsr_spanning_loop(pieces->whole, pieces->parent[f])
                : hsr_spanning_loop(world, f);
}

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
