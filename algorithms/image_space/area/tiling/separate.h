/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A tree without nodes, whose pieces are the whole faces of a world: so these
 * can be tiled as the pieces of a tree are (polygon.h). */
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

/* A leaf that has all points of a tree. */
struct hsr_bsp_cube hsr_all_points(const struct hsr_bsp *bsp);

#ifdef __cplusplus
}
#endif
#endif
