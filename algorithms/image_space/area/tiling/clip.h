/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Polygons clipped to a region between planes across the axes. A polygon is not
 * divided: lines on the screen are added to its own.
 *
 * Notation    a region is the points of the world with above < x <= below in
 *             each coordinate. The two regions at a plane share no point and
 *             leave none out: the plane belongs to the lower one.
 * Ties        a sample that is closer to such a line than its error is decided
 *             by the planes themselves, as where a tree has cut a piece
 *             (polygon.h). All faces that meet in a point of a ray are on one
 *             side there. */
#ifndef HSR_ALGORITHMS_TILING_CLIP_H
#define HSR_ALGORITHMS_TILING_CLIP_H

#include "algorithms/engines/masks/polygon.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_region {
  double above[3], below[3]; /* infinite: no plane */
};

/* Reduces a box to its part that is in a region or touches it; false if there
 * is none. */
bool hsr_region_clip(const struct hsr_region *region, struct hsr_box *box);

enum { HSR_MOST_CLIPS = 6 };

/* The piece at hand, clipped. */
struct hsr_clip {
  struct hsr_pieces_view *pieces;
  struct hsr_screen *screen; /* of the tree's world */
  struct hsr_mask_polygon polygon;
  uint32_t n_own; /* its own lines */
  struct {
    int axis;
    bool is_above; /* the region is where the coordinate is greater */
    double at;
  } plane[HSR_MOST_CLIPS];
};

/* The polygon of the piece at hand, clipped to the region; NULL if nothing of
 * it is in the region. It is valid until the next call. */
const struct hsr_mask_polygon *hsr_clip_piece(struct hsr_clip *clip,
                                              struct hsr_pieces_view *pieces,
                                              struct hsr_screen *screen,
                                              const struct hsr_region *region);

#ifdef __cplusplus
}
#endif
#endif
