/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pieces clipped to a region of space that is bounded by planes across the axes
 * (x, y or z = const). No new corners are computed. A plane meets the piece's
 * own plane in a line, whose image is added to the lines of the piece on the
 * screen.
 *
 * Notation    A region is the points of the world with above < x <= below in
 *             each coordinate. So the two regions at a plane share no point and
 *             leave none out: the plane itself belongs to the lower one.
 * Ties        A sample that is closer to such a line than its error is decided
 *             by the planes themselves, as where a tree has cut a piece
 *             (polygon.h). Faces that meet a ray in one point get the same
 *             answer there: they are on one side of the plane. */
#ifndef HSR_ALGORITHMS_TILING_CLIP_H
#define HSR_ALGORITHMS_TILING_CLIP_H

#include "algorithms/engines/masks/polygon.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_region {
  double above[3], below[3]; /* infinite: no plane on that side */
};

/* Reduces a box to its part that is in a region or touches it; false if there
 * is none. */
bool hsr_region_clip(const struct hsr_region *region, struct hsr_box *box);

enum { HSR_MOST_CLIPS = 6 };

/* The current piece of `pieces`, clipped. */
struct hsr_clip {
  struct hsr_pieces_view *pieces;
  struct hsr_screen *screen; /* of the tree's world */
  struct hsr_mask_polygon polygon;
  uint32_t n_own; /* lines of the piece; those of the planes follow */
  struct {
    int axis;
    bool is_above; /* the region is where the coordinate is greater */
    double at;     /* the coordinate of the plane */
  } plane[HSR_MOST_CLIPS];
};

/* The polygon of the current piece of `pieces` (hsr_pieces_outline), clipped to
 * the region. NULL: nothing of it is in the region. What is returned lies in
 * *clip or *pieces, and is valid until the next call. `screen` is one of the
 * piece's world; the plane of the piece's face is filled in. */
const struct hsr_mask_polygon *hsr_clip_piece(struct hsr_clip *clip,
                                              struct hsr_pieces_view *pieces,
                                              struct hsr_screen *screen,
                                              const struct hsr_region *region);

#ifdef __cplusplus
}
#endif
#endif
