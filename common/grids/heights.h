/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Terrain as cells: a map of heights.
 *
 * Source      J. E. Swan II, PhD thesis, Ohio State University, 1998, 5.2,
 *             where a column has samples enough to leave no hole beside a lower
 *             one.
 * Rule        the column at (x, z) has cells from its neighbours' least level,
 *             and one more, up to its own level; its own in any case. The
 *             neighbours are the four beside it.
 * Place       x along the map's rows, z from row to row, y upwards; one unit
 *             apart. */
#ifndef HSR_COMMON_GRIDS_HEIGHTS_H
#define HSR_COMMON_GRIDS_HEIGHTS_H

#include "common/grids/grid.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_heights {
  uint32_t n[2];         /* columns a row, rows */
  uint32_t levels;       /* every level is below this */
  const uint32_t *level; /* n[0] n[1], by rows; borrowed */
  const float *rgb;      /* 3 a column, linear, 0..1; NULL: by level */
};

/* As hsr_grid_init. */
enum hsr_status hsr_heights_grid(struct hsr_grid *grid,
                                 const struct hsr_heights *heights,
                                 struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
