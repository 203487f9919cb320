/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A rectilinear grid: samples of a density, at any ascending positions along
 * each axis. Some samples are kept. A kept sample is an opaque box, its cell,
 * which reaches half-way to the neighbouring samples.
 *
 * Source      J. E. Swan II, "Object-Order Rendering of Discrete Objects", PhD
 *             thesis, Ohio State University, 1998, 1.2.5: a volume subset is kept
 *             as a two-dimensional array of rows, each compact.
 * Cells       cell (i, j, k) is the box bound[0][i] .. bound[0][i + 1] along x,
 *             and likewise along y and z. Kept cells are numbered from 0, by k,
 *             then j, then i.
 * Sides       a cell has six sides, towards lower x (0), higher x (1), lower y
 *             (2), higher y (3), lower z (4), higher z (5). A side exists if
 *             the cell beyond it is not kept, or if there is none.
 * Faces       the sides that exist are the faces. They are numbered from 0, by
 *             cell, then by side. These numbers are the ids of the scene's
 *             faces.
 * Colours     a byte c stands for the linear value (c / 255)^2. So dark colours
 *             have finer steps, as the eye needs.
 * Samples     a kept sample also has what splatting needs: the levels of its
 *             density and gradient, and the direction of the gradient.
 * Memory      9 bytes for each kept cell, 3 more if cells have colours, and 8
 *             for each row. Densities are read slice by slice, and three slices
 *             are held at a time. */
#ifndef HSR_COMMON_GRIDS_GRID_H
#define HSR_COMMON_GRIDS_GRID_H

#include "common/grids/palette.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A grid owns its arrays, which hsr_grid_free frees. World units. */
struct hsr_grid {
  uint32_t n[3];    /* cells along each axis */
  double *bound[3]; /* the bounds of cells along each axis; n + 1, ascending */
  double *at[3];    /* the places of samples along each axis; n */
  uint32_t n_cells, n_faces; /* kept cells, and faces */
  uint32_t *row;     /* by row j + n[1] k: its first kept cell; n[1] n[2] + 1 */
  uint32_t *first;   /* by row: its first face; n[1] n[2] + 1 */
  uint32_t *x;       /* by kept cell: i, ascending within a row */
  uint8_t *sides;    /* by kept cell: bit s is set if side s exists */
  uint8_t (*rgb)[3]; /* by kept cell: its colour; NULL: all are grey */
  uint8_t *level;    /* by kept cell: the level of its density, 0 to 255 */
  uint8_t *steep;    /* by kept cell: the size of its gradient, 0 to 255 */
  uint16_t *normal;  /* by kept cell: the direction against its gradient, a code
                        of common/grids/normal.h */
  struct hsr_palette palette;      /* how samples look as splats */
  struct hsr_densities *densities; /* of all samples, kept or not
                                      (common/grids/densities.h); NULL: they are
                                      not known */
};

/* Writes the colour of the kept sample at[], linear, 0..1. */
typedef void hsr_grid_colour(void *data, const uint32_t at[3], float density,
                             float rgb[3]);

/* The samples that a grid is made of. `slice` fills density[] with the n[0]
 * n[1] samples of index k, by j and then i. It is called once for each k, in
 * ascending order. If it fails, hsr_grid_init fails with its status. `colour`
 * is called for each kept sample of index k, after `slice` was called for k +
 * 1. If it is NULL, no sample has a colour. */
struct hsr_grid_samples {
  uint32_t n[3];             /* at least 1, at most 2^20 */
  const double *position[3]; /* n along each axis, ascending, finite */
  enum hsr_status (*slice)(void *data, uint32_t k, float *density,
                           struct hsr_error *err);
  hsr_grid_colour *colour;
  void *data;
  double low, high; /* the densities of level 0 and level 255. If low is not
                       below high, all levels of density are 255 */
  /* Writes the normal of sample at[], of any length. NULL: it is against the
   * gradient. */
  void (*normal)(void *data, const uint32_t at[3], double normal[3]);
};

/* Which samples are kept: those with a density of `least` to `most` and a
 * gradient of at least this size. The gradient is found by central differences,
 * or by one-sided differences at the ends, divided by distances in world
 * units. */
struct hsr_grid_keep {
  double least, most;
  double gradient;
  bool all_sides; /* sides between two kept cells exist, too */
};

/* Makes a grid. The caller frees *grid with hsr_grid_free, also after a
 * failure. HSR_E_INPUT if positions do not ascend or no sample is kept;
 * HSR_E_REFUSED for more than 2^32 - 2 faces; HSR_E_NOMEM; or the status of
 * `slice`. */
enum hsr_status hsr_grid_init(struct hsr_grid *grid,
                              const struct hsr_grid_samples *samples,
                              const struct hsr_grid_keep *keep,
                              struct hsr_error *err);

/* Frees the arrays. The grid is empty afterwards. */
void hsr_grid_free(struct hsr_grid *grid);

/* Keeps only the kept cells with the numbers [from, to), perhaps none, and
 * frees the memory of the others. Cells keep their places and sides, and get
 * new numbers, as their faces do. */
void hsr_grid_cut(struct hsr_grid *grid, uint32_t from, uint32_t to);

/* Returns the number of the kept cell with the indices at[]; UINT32_MAX if that
 * cell is not kept. */
uint32_t hsr_grid_cell(const struct hsr_grid *grid, const uint32_t at[3]);

/* Returns the first of the kept cells [cell, end), all of one row, whose index
 * along x is x or more; `end` if there is none. */
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

/* Writes the indices of a kept cell. */
void hsr_grid_place(const struct hsr_grid *grid, uint32_t cell, uint32_t at[3]);

/* Returns the first face of a kept cell, that of its lowest side that
 * exists. */
uint32_t hsr_grid_first_face(const struct hsr_grid *grid, uint32_t cell);

/* Writes the number of the kept cell that has a face, and the side of it that
 * the face is. */
void hsr_grid_face(const struct hsr_grid *grid, uint32_t face, uint32_t *cell,
                   int *side);

/* Writes the colour of a kept cell, linear, 0..1. */
void hsr_grid_rgb(const struct hsr_grid *grid, uint32_t cell, float rgb[3]);

/* Writes the corners of a side of cell at[], counter-clockwise as seen from
 * outside the cell. A corner is three indices into bound[0], [1], [2]. */
void hsr_grid_corner_places(const uint32_t at[3], int side,
                            uint32_t corner[4][3]);

/* The same in world units. */
void hsr_grid_corners(const struct hsr_grid *grid, const uint32_t at[3],
                      int side, double corner[4][3]);

#ifdef __cplusplus
}
#endif
#endif
