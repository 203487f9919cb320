/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of a grid, drawn in an order that compares no depths: one frame.
 *
 * Source      J. E. Swan II, "Object-Order Rendering of Discrete Objects", PhD
 *             thesis, Ohio State University, 1998, chapter 2. The orders are in
 *             common/grids/order.h, with their proof.
 * Place       list priority, priority a priori. The planes between the slices
 *             of cells separate them, as Schumacker's planes separate clusters:
 *             the eye's side of each gives the order, and no two cells are ever
 *             compared. So the modules stand beside Schumacker's and the BSP
 *             trees.
 * Notation    voxel -> cell; its splat -> the sides of a cell that face the eye
 * Input       the grid itself. No list of faces is made.
 * Invariant   from back to front: a sample shows the nearest of the cells drawn
 *             so far that cover it. From front to back: a sample that is not
 *             vacant shows its face of the picture.
 * Ties        the sides of a cell that face the eye do not hide one another.
 *             Two sides in one plane have no sample in common.
 * Near        a side is drawn where it lies beyond the near plane. What lies
 *             before it covers nothing, so the orders need not know of it.
 * Departures  A cell is drawn by its sides, not as one splat. From front to
 *             back, up to 16 cells of a row are passed over at once if the
 *             rectangle around them has no vacant sample.
 * Cost        cells with a side towards the eye, and samples of their sides
 *
 * Files: cell_frame.c walks the grid and culls; cell_box.c projects boxes;
 * cell_side.c draws a side. */
#ifndef HSR_ALGORITHMS_CELLS_H
#define HSR_ALGORITHMS_CELLS_H

#include "algorithms/algorithm.h"
#include "common/exact/screen.h"
#include "common/grids/order.h"

/* --- What the modules have in common -------------------------------------- */

/* What they count. The lines stand below that of the order itself. */
extern const struct hsr_part hsr_cells_part;
enum {
  HSR_CELLS_RUNS = HSR_FIRST_OF(HSR_PART_CELLS),
  HSR_CELLS_GROUPS,
  HSR_CELLS_CELLS,
  HSR_CELLS_SIDES,
  HSR_CELLS_SPANS,
  HSR_CELLS_OCCUPIED,
  HSR_CELLS_WRITES
};

/* The options; those without a nesting have `front` alone. */
enum { HSR_CELLS_FRONT, HSR_CELLS_NESTING };
extern const struct hsr_option hsr_cells_front[], hsr_cells_nested[];

enum hsr_status hsr_cells_render(enum hsr_grid_order order,
                                 const struct hsr_job *job,
                                 struct hsr_error *err);

/* --- The frame ------------------------------------------------------------ */

enum { HSR_CELLS_GROUP = 16 }; /* cells that are passed over at once, at most */

/* A kept cell that is about to be drawn. */
struct hsr_cell {
  uint32_t number, x; /* x: its place along the axis of the run */
  uint8_t sides;      /* those that exist and face the eye */
};

/* One side, laid out alone for the services of common/exact/screen.h. */
struct hsr_lone_side {
  struct hsr_world world;
  struct hsr_screen screen;
  double x[4], y[4], z[4], plane[9];
  uint32_t start[2], vertex[4];
  bool one_sided;
};

struct hsr_cells {
  const struct hsr_job *job;
  const struct hsr_grid *grid;
  struct hsr_tally *tally;
  struct hsr_window window;
  bool front;

  /* Bound k of axis a adds term[a][c][k] to homogeneous screen coordinate c of
   * a corner, c = 3: to its depth, and is far[a][k] from E along the axis. */
  double *term[3][4], *far[3];
  uint8_t
      *facing[3]; /* sides of axis a that face the eye, a cell of the axis */
  double kappa, error[4], slack; /* cell_box.c: error[] is of a corner 1 away */
  uint8_t corner[6][4]; /* of each side, clockwise as seen from outside */

  uint64_t *vacant; /* bit i - window.x0 of a row: the sample shows nothing */
  size_t words;     /* a row */
  uint64_t n_vacant;
  int *lo, *hi; /* columns of a side, by row */

  uint32_t *cursor; /* of each row of the grid, the cell last found there */
  struct hsr_cell group[HSR_CELLS_GROUP]; /* of the run */
  int n_group;
  uint32_t at[3]; /* the group's indices, but for those along the axis */
  int axis;

  /* Cell face_cell of row face_row has the first face `face`, if it is known.
   */
  size_t face_row;
  uint32_t face_cell, face;
  bool face_known;
  struct hsr_lone_side lone;
};

/* The largest whole number that is at most v, |v| < 2^16; or, if v is within
 * 2^-37 of a whole number, that number or the one below it. */
static inline int hsr_cells_whole(double v) {
  return (int)(v + 0x1p16) - (1 << 16);
}

/* Makes all of *cells ready that the functions below need, and the window's ids
 * the background; what only the orders need is left out: front, and from vacant
 * to face_known. HSR_E_NOMEM. */
enum hsr_status hsr_cells_begin(struct hsr_cells *cells,
                                const struct hsr_job *job);

/* --- Boxes ---------------------------------------------------------------- */

/* What a box looks like. Corner k has the high bound of axis a if bit a of k is
 * set. */
struct hsr_cell_box {
  bool is_safe; /* every corner is safely before the eye, and beyond near */
  double sx[8], sy[8];      /* if it is */
  struct hsr_bounds bounds; /* no other sample of the window shows the box */
};

/* Fills the terms of all bounds. The arrays are there. */
void hsr_cells_project(struct hsr_cells *cells);

/* The box of the cells from lo to hi, both included. False if it certainly
 * shows at no sample of the window. */
bool hsr_cells_box(const struct hsr_cells *cells, const uint32_t lo[3],
                   const uint32_t hi[3], struct hsr_cell_box *box);

/* Whether a sample within the bounds is vacant. */
static inline bool hsr_cells_any_vacant(const struct hsr_cells *cells,
                                        const struct hsr_bounds *b) {
  unsigned from = (unsigned)(b->x0 - cells->window.x0),
           to = (unsigned)(b->x1 - 1 - cells->window.x0);
  unsigned first = from / 64, last = to / 64;
  uint64_t head = ~UINT64_C(0) << from % 64,
           tail = ~UINT64_C(0) >> (63 - to % 64);
  const uint64_t *row =
      cells->vacant + (size_t)(b->y0 - cells->window.y0) * cells->words;
  for (int j = b->y0; j < b->y1; j++, row += cells->words) {
    if (first == last) {
      if (row[first] & head & tail)
        return true;
      continue;
    }
    uint64_t any = (row[first] & head) | (row[last] & tail);
    for (unsigned w = first + 1; w < last; w++)
      any |= row[w];
    if (any)
      return true;
  }
  return false;
}

/* --- Sides ---------------------------------------------------------------- */

/* Makes the lone side. HSR_E_NOMEM. */
enum hsr_status hsr_cells_begin_sides(struct hsr_cells *cells);

/* Lays out a side of the cell at these indices as the lone one, face 0 of
 * cells->lone.screen. False if it has no sample in the window. */
bool hsr_cells_lay_out(struct hsr_cells *cells, const uint32_t at[3], int side);

/* Draws a side of the cell at these indices, which faces the eye, under the id
 * `face`. `box` is that of the cell. */
void hsr_cells_draw(struct hsr_cells *cells, const uint32_t at[3], int side,
                    uint32_t face, const struct hsr_cell_box *box);

#endif
