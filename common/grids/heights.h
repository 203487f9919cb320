/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Terrain as a grid: a map of heights.
 *
 * Source      J. E. Swan II, PhD thesis, Ohio State University, 1998, 5.2: a
 *             column has enough samples to leave no hole beside a lower column.
 * Rule        the column at (x, z) has a cell at its own level. It also has
 *             cells below that, down to one level above its lowest neighbour.
 *             The neighbours are the four columns beside it.
 * Light       normals are those of the surface of heights, by central
 *             differences, or one-sided ones at the ends.
 * Place       x runs along the map's rows, z from row to row, y upwards.
 *             Samples are one unit apart. */
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
  const float *height;   /* n[0] n[1] heights that the light sees, in levels;
                            borrowed; NULL: the levels */
  const float *rgb;      /* 3 a column, linear, 0..1, borrowed; NULL: colours
                            depend on the level */
};

/* Makes the grid of a map of heights. Ownership and errors are as of
 * hsr_grid_init. */
enum hsr_status hsr_heights_grid(struct hsr_grid *grid,
                                 const struct hsr_heights *heights,
                                 struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
