/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of a grid, drawn in an order that is found without comparing
 * depths: one frame.
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
 * Input       the grid itself; no list of faces is made
 * Invariant   from back to front: a sample shows the nearest of the cells drawn
 *             so far that cover it. From front to back: a sample that is not
 *             vacant shows its face of the picture.
 * Ties        The sides of a cell that face the eye do not hide one another.
 *             Two sides in one plane have no sample in common.
 * Near        A side is drawn where it lies beyond the near plane. What lies
 *             nearer covers nothing, so the orders need not know of it.
 * Departures  A cell is drawn by its sides, not as one splat. From front to
 *             back, up to 16 cells of a row are passed over at once if the
 *             rectangle around them has no vacant sample.
 * Cost        cells with a side towards the eye, and samples of their sides
 *
 * Files: cell_frame.c visits the cells in order and culls; cell_box.c projects
 * boxes; cell_side.c draws a side. */
#ifndef HSR_ALGORITHMS_CELLS_H
#define HSR_ALGORITHMS_CELLS_H

#include "algorithms/algorithm.h"
#include "common/exact/screen.h"
#include "common/grids/order.h"

/* --- What the modules have in common -------------------------------------- */

/* The part, and its counters; cell_frame.c has their meanings. The lines of its
 * outline stand below the module's line of the order. */
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

/* The modules' options. A module whose order has no nesting has `front` alone:
 * hsr_cells_front[]. */
enum { HSR_CELLS_FRONT, HSR_CELLS_NESTING };
extern const struct hsr_option hsr_cells_front[], hsr_cells_nested[];

/* `render` of a module that draws in this order. HSR_E_NOMEM. */
enum hsr_status hsr_cells_render(enum hsr_grid_order order,
                                 const struct hsr_job *job,
                                 struct hsr_error *err);

/* --- The frame ------------------------------------------------------------ */

enum { HSR_CELLS_GROUP = 16 }; /* cells that are passed over at once, at most */

/* A kept cell that is about to be drawn. */
struct hsr_cell {
  uint32_t number; /* in the grid */
  uint32_t x;      /* its index along the axis of the row that it is in */
  uint8_t sides;   /* a bit for each side that exists and faces the eye */
};

/* One side, laid out as the only face of a world, for the services of
 * common/exact/screen.h. */
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
  bool front; /* from front to back; else from back to front */

  /* Bound k of axis a is the plane between cells k - 1 and k. It adds
   * term[a][c][k] to homogeneous screen coordinate c of a corner, or for c = 3
   * to its depth. It is far[a][k] from E along the axis. */
  double *term[3][4], *far[3];
  /* By axis, and by cell along it: which of the two sides across the axis
   * face the eye. */
  uint8_t *facing[3];
  double kappa, error[4], slack; /* cell_box.c: error[] is of a corner 1 away */
  uint8_t corner[6][4]; /* of each side, clockwise as seen from outside */

  /* Rows of bits: bit i - window.x0 is set while sample i of the row shows
   * nothing. */
  uint64_t *vacant;
  size_t words; /* in a row of vacant[] */
  uint64_t n_vacant;
  int *lo, *hi; /* columns of a side, by row */

  uint32_t *cursor; /* by row of the grid: the cell last found there */

  /* The cells of a row that are tested together, and then drawn. */
  struct hsr_cell group[HSR_CELLS_GROUP];
  int n_group;
  uint32_t at[3]; /* indices of the row; that along the axis is not used */
  int axis;       /* along which the row runs */

  /* If face_known: the first face of cell face_cell, of row face_row, has the
   * number `face`. The next search for a face begins there. */
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

/* Makes *cells ready for the functions below, and clears the window's ids to
 * the background. Members that only the orders need are left alone: front, and
 * those from vacant to face_known. Memory from job->scratch; the job is
 * borrowed. HSR_E_NOMEM. */
enum hsr_status hsr_cells_begin(struct hsr_cells *cells,
                                const struct hsr_job *job);

/* --- Boxes ---------------------------------------------------------------- */

/* The image of a box. Corner k has the high bound of axis a if bit a of k is
 * set. */
struct hsr_cell_box {
  bool is_safe; /* every corner is safely before the eye, and beyond near */
  double sx[8], sy[8];      /* if it is */
  struct hsr_bounds bounds; /* no other sample of the window shows the box */
};

/* Fills term[] and far[] for all bounds. The arrays have been allocated. */
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

/* Makes cells->lone ready for hsr_cells_lay_out. HSR_E_NOMEM. */
enum hsr_status hsr_cells_begin_sides(struct hsr_cells *cells);

/* Lays out a side of the cell at these indices as the lone one, face 0 of
 * cells->lone.screen. False if it has no sample in the window. */
bool hsr_cells_lay_out(struct hsr_cells *cells, const uint32_t at[3], int side);

/* Draws a side of the cell at these indices, which faces the eye, under the id
 * `face`. `box` is that of the cell. */
void hsr_cells_draw(struct hsr_cells *cells, const uint32_t at[3], int side,
                    uint32_t face, const struct hsr_cell_box *box);

#endif
