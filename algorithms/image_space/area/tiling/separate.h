/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whole faces as pieces, each for itself, so that they can be tiled as the
 * pieces of a tree are (polygon.h): a tree without nodes. */
#ifndef HSR_ALGORITHMS_TILING_SEPARATE_H
#define HSR_ALGORITHMS_TILING_SEPARATE_H

#include "algorithms/algorithm.h"
#include "common/trees/bsp.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Compiled twice, as the algorithms are. */
#define hsr_separate_init HSR_OF_BUILD(hsr_separate_init)
#define hsr_all_points HSR_OF_BUILD(hsr_all_points)

/* Piece f is face f of the world, which is borrowed. Freed with hsr_bsp_free,
 * also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_separate_init(struct hsr_bsp *bsp,
                                  const struct hsr_world *world);

/* All points of a tree as if they were those of one leaf. */
struct hsr_bsp_cube hsr_all_points(const struct hsr_bsp *bsp);

#ifdef __cplusplus
}
#endif
#endif
