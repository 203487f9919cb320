/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pieces of a BSP tree as polygons to be tiled with masks.
 *
 * Notation    a point V of the world is (X, Y, W) = rows (V - E) in homogeneous
 *             coordinates of the screen; the line through two points a and b is
 *             f = det(sample, a, b), and inside is where f is positive
 * Ties        samples that are closer to a line than its error are decided
 *             exactly; on a side that a cut has made, planes are compared
 * Departures  nothing is clipped: a convex polygon in space is seen exactly
 *             within the lines of its sides in homogeneous coordinates, even if
 *             it has corners behind the eye. As in the paper, no depths are
 *             kept; only where near cuts a polygon are its samples asked about.
 *             A face whose corners are not on its plane is asked about sample
 *             by sample. */
#ifndef HSR_ALGORITHMS_TILING_POLYGON_H
#define HSR_ALGORITHMS_TILING_POLYGON_H

#include "algorithms/engines/masks/masks.h"
#include "common/trees/bsp.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The corners of a box that are on its silhouette, in order; none if the eye is
 * within the box. */
struct hsr_silhouette {
  int n;
  unsigned char corner[6];
};

/* The silhouette of a box for an eye that is below it, within it or above it in
 * each coordinate: place 0, 1 or 2. It goes along the edges that have one side
 * that faces the eye and one that does not. */
struct hsr_silhouette hsr_silhouette_find(const int place[3]);

/* The corners of a box, coordinate by coordinate, all with the same errors; the
 * rectangle that they span on the screen, which counts only if they are before
 * the eye, and the least W. */
struct hsr_box_corners {
  double x[8], y[8], w[8];
  double error[3]; /* of X, Y, W */
  double x0, y0, x1, y1, nearest;
};

/* One view of the pieces. */
struct hsr_pieces_view {
  const struct hsr_view *view; /* of the samples */
  double reach;                /* lines are asked nowhere farther out */
  bool anywhere;               /* as in struct hsr_masks */
  struct hsr_tally *tally;

  /* The tree at hand, and the shift by which it is moved. */
  const struct hsr_bsp *bsp;
  double shift[3];

  /* The leaf at hand and its points on the screen. error[] bounds the rounding
   * of X, Y and W; the error that a point has in the world comes on top. */
  uint32_t first_point;
  double *x, *y, *w;
  double *t; /* their depths: w, or in parallel, where all w are 1, others */
  double error[3], t_error;
  bool is_wild;     /* nothing is known of them: polygon.c, Range */
  bool ahead;       /* all points are surely before the eye */
  double *sx, *sy;  /* then: where they are on the screen, */
  double margin;    /* within this */
  bool past_near;   /* all points are past near */
  double rounding;  /* of moving a point that is no vertex */
  double spread[3]; /* what an error of 1 in its coordinates amounts to in X, Y
                       and W */

  /* The piece at hand. */
  const struct hsr_bsp_piece *piece;
  int facing; /* +1 the eye is in front of the face, -1 behind */
  struct hsr_bounds box;
  struct hsr_mask_line *line;
  struct hsr_mask_polygon polygon;

  /* The box at hand. */
  struct hsr_box_corners corners;
  const struct hsr_silhouette *of_box;

  struct hsr_silhouette silhouette[27]; /* by where the eye is: view->eye */
  double *corner[2];  /* moved corners of faces, by coordinates */
  uint32_t *number;   /* 0, 1, ... */
  uint32_t most_face; /* corners that there is room for */
};

/* The most that the trees to come have: points and corners of a leaf, corners
 * of a face. */
struct hsr_pieces_room {
  uint32_t points, corners, face;
};

/* `masks` is where the pieces will go. HSR_E_NOMEM. */
enum hsr_status
hsr_pieces_begin(struct hsr_pieces_view *pieces, struct hsr_pieces_room room,
                 const struct hsr_view *view, const struct hsr_masks *masks,
                 struct hsr_tally *tally, struct hsr_arena *arena);

/* Makes a tree the one at hand; and a leaf of it, whose points are transformed.
 */
void hsr_pieces_tree(struct hsr_pieces_view *pieces, const struct hsr_bsp *bsp,
                     const double shift[3]);
void hsr_pieces_leaf(struct hsr_pieces_view *pieces,
                     const struct hsr_bsp_cube *leaf);

/* Makes a piece of that leaf the one at hand, and finds the box of the samples
 * that it may cover; false if there are none in the window. The eye is on the
 * side `facing` of the piece's face. */
bool hsr_pieces_take(struct hsr_pieces_view *pieces,
                     const struct hsr_bsp_piece *piece, int facing);

/* Makes the polygon of the piece. */
void hsr_pieces_outline(struct hsr_pieces_view *pieces);

/* Makes a moved box the one at hand, and finds its box of samples, `box`. It is
 * outside if no sample of the window is within it. It is unknown, and may be
 * seen, if it is not wholly before the eye. */
enum hsr_box_place { HSR_BOX_OUTSIDE, HSR_BOX_INSIDE, HSR_BOX_UNKNOWN };
enum hsr_box_place hsr_pieces_box(struct hsr_pieces_view *pieces,
                                  const struct hsr_box *box,
                                  const double shift[3]);

/* The silhouette of that box, which is inside: a polygon whose lines leave
 * nothing of the box outside. */
const struct hsr_mask_polygon *
hsr_pieces_silhouette(struct hsr_pieces_view *pieces);

#ifdef __cplusplus
}
#endif
#endif
