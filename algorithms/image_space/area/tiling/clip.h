/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Polygons clipped to a region between planes across the axes, by lines of the
 * screen: none is divided.
 *
 * Region      the points of the world with above < x <= below in each
 *             coordinate: two regions on both sides of a plane share no point,
 *             and leave none out; what lies in the plane is in the lower one.
 * Exact       what is closer to such a line than its error is asked of the
 *             planes themselves, as where a tree has cut a piece (polygon.h).
 *             All faces that meet in a point of a ray are on one side there. */
#ifndef HSR_ALGORITHMS_TILING_CLIP_H
#define HSR_ALGORITHMS_TILING_CLIP_H

#include "algorithms/image_space/area/tiling/masks/polygon.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Compiled twice, as the algorithms are. */
#define hsr_region_clip HSR_OF_BUILD(hsr_region_clip)
#define hsr_clip_piece HSR_OF_BUILD(hsr_clip_piece)

struct hsr_region {
  double above[3], below[3]; /* infinite: no plane */
};

/* What of a box is in a region, or touches it; false if that is nothing. */
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
    bool is_above; /* within is where the coordinate is greater */
    double at;
  } plane[HSR_MOST_CLIPS];
};

/* The polygon of the piece that `pieces` has at hand, in the region: NULL if
 * none of it is. It is good until the next one. */
const struct hsr_mask_polygon *hsr_clip_piece(struct hsr_clip *clip,
                                              struct hsr_pieces_view *pieces,
                                              struct hsr_screen *screen,
                                              const struct hsr_region *region);

#ifdef __cplusplus
}
#endif
#endif
