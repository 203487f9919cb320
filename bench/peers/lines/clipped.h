/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The faces that exist in a view, cut at a plane before the eye, for peers that
 * do not clip. And the perspective transform, for those that have none. */
#ifndef HSR_BENCH_PEERS_LINES_CLIPPED_H
#define HSR_BENCH_PEERS_LINES_CLIPPED_H

#include "common/scene/world.h"
#include "common/view/view.h"

#include <unordered_map>
#include <vector>

/* A vertex of the world, or the point in which an edge is cut by the plane that
 * is nearest to the eye. */
struct Corner {
  double place[3], image[3]; /* in the world; as hsr_view_project */
  double depth;              /* beyond that plane */
  uint32_t a, b;   /* of a cut edge: its ends, a < b; else UINT32_MAX */
  double t;        /* of a cut edge: where it is cut */
  double weight;   /* in perspective, the depth; else 1 */
  double point[3]; /* on the screen: x and y are pixels, y upwards; z grows
                      towards the eye, and spans as much as the picture is
                      wide */
};

struct ClippedFace {
  uint32_t face; /* of the world that was cut */
  std::vector<uint32_t> corner;
};

struct Clipped {
  std::vector<Corner> corner; /* the world's vertices first */
  std::vector<ClippedFace> face;
};

/* Two numbers, in either order, as a key. */
uint64_t pair_of(uint32_t a, uint32_t b);

/* Cuts what exists of a world in this view. The nearest plane is the view's own
 * or, in perspective, one at a thousandth of the greatest depth, or before all
 * vertices that are in the picture. */
Clipped clip_world(const struct hsr_world *world, const struct hsr_view *view);

#endif
