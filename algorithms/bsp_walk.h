/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Going through an octree of BSP trees from front to back. */
#ifndef HSR_ALGORITHMS_BSP_WALK_H
#define HSR_ALGORITHMS_BSP_WALK_H

#include "algorithms/algorithm.h"
#include "common/bsp.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_bsp_walk {
  const struct hsr_bsp *bsp;
  const double *eye, *shift; /* of the view; by what all is moved, exactly */
  struct hsr_tally *tally;
  void *context;
  bool (*enter)(void *context, const struct hsr_bsp_cube *cube);
  void (*piece)(void *context, const struct hsr_bsp_piece *piece, int facing);
};

void HSR_OF_BUILD(hsr_bsp_walk)(const struct hsr_bsp_walk *walk);

#ifdef __cplusplus
}
#endif
#endif
