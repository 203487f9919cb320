/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A rectilinear grid: samples of a density at any positions along each axis, of
 * which some are kept. Every kept sample is an opaque box, its cell, that
 * reaches half way to its neighbours.
 *
 * Source      J. E. Swan II, "Object-Order Rendering of Discrete Objects", PhD
 *             thesis, Ohio State University, 1998, 2.2: a volume subset is kept
 *             as a two-dimensional array of rows, each compact.
 * Cells       cell (i, j, k) is the box bound[0][i]..bound[0][i + 1] and so on.
 *             Kept cells are numbered from 0: by k, then j, then i.
 * Sides       0: towards lower x, 1: higher x, 2, 3: y, 4, 5: z. A side exists
 *             if the cell beyond it is not kept, or there is none.
 * Faces       sides that exist, numbered from 0: by cell, then by side. These
 *             are the ids of the scene's faces.
 * Colours     c in a byte for the linear value (c / 255)^2, so that dark ones
 *             are as far apart as the eye tells.
 * Samples     a kept sample also has what splatting needs: the levels of its
 *             density and gradient, and the direction of the gradient.
 * Memory      9 bytes a kept cell, and 3 if it has a colour; 8 a row. The
 *             densities are read a slice at a time, of which three are held. */
#ifndef HSR_COMMON_GRIDS_GRID_H
#define HSR_COMMON_GRIDS_GRID_H

#include "common/grids/palette.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_grid {
  uint32_t n[3];    /* cells along each axis */
  double *bound[3]; /* n + 1 of each axis, ascending */
  double *at[3];    /* n of each axis: where its samples are */
  uint32_t n_cells, n_faces;
  uint32_t *row;     /* row j + n[1] k: its first kept cell; n[1] n[2] + 1 */
  uint32_t *first;   /* of each row, its first face; n[1] n[2] + 1 */
  uint32_t *x;       /* i of each kept cell, ascending within a row */
  uint8_t *sides;    /* of each kept cell: bit s is set if side s exists */
  uint8_t (*rgb)[3]; /* of each kept cell, its colour; NULL: all are grey */
  uint8_t *level;    /* of each kept sample: its density, from 0 to 255 */
  uint8_t *steep;    /* of each: the size of its gradient, from 0 to 255 */
  uint16_t *normal;  /* of each: where its gradient points away from, a code of
                        common/grids/normal.h */
  struct hsr_palette palette; /* how samples look as splats */
};

/* Gives the colour of a kept sample, linear, 0..1. */
typedef void hsr_grid_colour(void *data, const uint32_t at[3], float density,
                             float rgb[3]);

/* Where samples are, and their densities. `slice` fills density[] with the n[0]
 * n[1] samples of a k, by j and then i; it is called for each k once, in order,
 * and its failure is that of hsr_grid_init. `colour` is called for the samples
 * of a k that are kept, after `slice` for k + 1; NULL: no sample has one. */
struct hsr_grid_samples {
  uint32_t n[3];             /* at least 1, at most 2^20 */
  const double *position[3]; /* n of each axis, ascending, finite */
  enum hsr_status (*slice)(void *data, uint32_t k, float *density,
                           struct hsr_error *err);
  hsr_grid_colour *colour;
  void *data;
  double low, high; /* the densities of level 0 and level 255. If low is not
                       below high, all levels of density are 255 */
};

/* Which samples are kept: those with a density of `least` to `most` and a
 * gradient of this size at least. The gradient is that of central differences,
 * or of one-sided ones at the ends, by position. */
struct hsr_grid_keep {
  double least, most;
  double gradient;
  bool all_sides; /* also those between two kept cells exist */
};

/* The caller frees *grid, also after a failure. HSR_E_INPUT if positions do not
 * ascend, or no sample is kept; HSR_E_REFUSED for more than 2^32 - 2 faces;
 * HSR_E_NOMEM; what `slice` returns. */
enum hsr_status hsr_grid_init(struct hsr_grid *grid,
                              const struct hsr_grid_samples *samples,
                              const struct hsr_grid_keep *keep,
                              struct hsr_error *err);
void hsr_grid_free(struct hsr_grid *grid);

/* Leaves of the kept cells those from `from` to `to` - 1, and frees the memory of
 * the rest. They keep their places and sides; cells and faces are numbered anew.
 * None may be left. */
void hsr_grid_cut(struct hsr_grid *grid, uint32_t from, uint32_t to);

/* The kept cell at these indices; UINT32_MAX if it is not kept. */
uint32_t hsr_grid_cell(const struct hsr_grid *grid, const uint32_t at[3]);

/* The first of the cells [cell, end) of a row whose index along x is x or more;
 * `end` if there is none. */
static inline uint32_t hsr_grid_first_from(const struct hsr_grid *grid,
                                           uint32_t cell, uint32_t end,
                                           uint32_t x) {
  while (cell < end) {
    uint32_t middle = cell + (end - cell) / 2;
    if (grid->x[middle] < x)
      cell = middle + 1;
    else
      end = middle;
  }
  return cell;
}

/* The indices of a kept cell. */
void hsr_grid_place(const struct hsr_grid *grid, uint32_t cell, uint32_t at[3]);

/* The first face of a kept cell, which is its lowest side that exists. */
uint32_t hsr_grid_first_face(const struct hsr_grid *grid, uint32_t cell);

/* The kept cell and the side of a face. */
void hsr_grid_face(const struct hsr_grid *grid, uint32_t face, uint32_t *cell,
                   int *side);

/* The colour of a kept cell, linear, 0..1. */
void hsr_grid_rgb(const struct hsr_grid *grid, uint32_t cell, float rgb[3]);

/* The corners of a side as indices of bounds, counter-clockwise as seen from
 * outside the cell. */
void hsr_grid_corner_places(const uint32_t at[3], int side,
                            uint32_t corner[4][3]);

/* The corners of a side, counter-clockwise as seen from outside the cell. */
void hsr_grid_corners(const struct hsr_grid *grid, const uint32_t at[3],
                      int side, double corner[4][3]);

#ifdef __cplusplus
}
#endif
#endif
