/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The faces of a world, undivided, in the form of a BSP tree's pieces: so they
 * can be tiled as pieces are (polygon.h). The tree has no nodes and no
 * order. */
#ifndef HSR_ALGORITHMS_TILING_SEPARATE_H
#define HSR_ALGORITHMS_TILING_SEPARATE_H

#include "algorithms/algorithm.h"
#include "common/trees/bsp.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Piece f is face f of the world, which is borrowed. Freed with hsr_bsp_free,
 * also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_separate_init(struct hsr_bsp *bsp,
                                  const struct hsr_world *world);

/* An octree leaf that has all points of *bsp, and the box around them. */
struct hsr_bsp_cube hsr_all_points(const struct hsr_bsp *bsp);

#ifdef __cplusplus
}
#endif
#endif
