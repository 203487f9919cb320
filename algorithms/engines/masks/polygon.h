/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pieces of a BSP tree as polygons to be tiled with masks (masks.h).
 *
 * Notation    A point V of the world is (X, Y, W) = rows (V - E) in homogeneous
 *             coordinates of the screen. The line through two points a and b is
 *             f = det(sample, a, b); inside is where f is positive.
 * Ties        A sample that is closer to a line than its error is decided
 *             exactly. For a side that a cut has made, planes are compared.
 * Departures  - Nothing is clipped. A convex polygon in space covers on the
 *             screen exactly what is inside the lines of its sides in
 *             homogeneous coordinates, even if it has corners behind the eye.
 *             - As in the paper, no depths are kept. But if the near plane cuts
 *             a polygon, its samples are asked about one by one; so are those
 *             of a face whose corners are not on one plane. */
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

/* The silhouette of a box. place[k] says where the eye is in coordinate k: 0
 * below the box, 1 within its range, 2 above it. The silhouette runs along the
 * edges between a side that faces the eye and one that does not. */
struct hsr_silhouette hsr_silhouette_find(const int place[3]);

/* The corners of a box in homogeneous coordinates, all with the same errors.
 * Also the rectangle that they span on the screen, and their least W; these
 * count only if all corners are before the eye. */
struct hsr_box_corners {
  double x[8], y[8], w[8];
  double error[3]; /* of X, Y, W */
  double x0, y0, x1, y1, nearest;
};

/* One view of pieces. At a time there is one current tree, one current leaf of
 * it, one current piece of that, and one current box. */
struct hsr_pieces_view {
  const struct hsr_view *view; /* of the samples */
  double reach;  /* no line is evaluated farther out, in samples */
  bool anywhere; /* as in struct hsr_masks */
  struct hsr_tally *tally;

  /* The current tree, and by how much it is moved. */
  const struct hsr_bsp *bsp;
  double shift[3];

  /* The points of the current leaf in homogeneous coordinates; point p of the
   * tree is number p - first_point. error[] bounds the rounding of X, Y and W;
   * the error that a point has in the world comes on top. */
  uint32_t first_point;
  double *x, *y, *w;
  double *t; /* their depths: w, or in parallel projection, where w is 1, t */
  double error[3], t_error;
  bool is_wild;     /* nothing is known of them: polygon.c, Range */
  bool ahead;       /* all points are surely before the eye */
  double *sx, *sy;  /* if ahead: where they are on the screen, */
  double margin;    /* within this */
  bool past_near;   /* all points are past the near plane */
  double rounding;  /* of moving a point that is no vertex */
  double spread[3]; /* what an error of 1 in a point's coordinates makes in X, Y
                       and W */

  /* The current piece: the side of its face on which the eye is, +1 in front,
   * -1 behind; the samples that it may cover; and its polygon, whose lines are
   * line[]. */
  const struct hsr_bsp_piece *piece;
  int facing;
  /* Of the current piece or box, whichever was made current last. */
  struct hsr_bounds box;
  struct hsr_mask_line *line;
  struct hsr_mask_polygon polygon;

  /* The current box. */
  struct hsr_box_corners corners;
  const struct hsr_silhouette *of_box;

  struct hsr_silhouette silhouette[27]; /* for each place of the eye */
  double *corner[2];  /* room for the moved corners of two faces */
  uint32_t *number;   /* 0, 1, ... */
  uint32_t most_face; /* corners that there is room for */
};

/* The most that trees may have: points of a leaf, corners of a piece, corners
 * of a face. */
struct hsr_pieces_room {
  uint32_t points, corners, face;
};

/* Begins a view. `masks` is where the pieces will be tiled. All but `room` and
 * `masks` is borrowed as long as *pieces; the arrays are the arena's.
 * HSR_E_NOMEM. */
enum hsr_status
hsr_pieces_begin(struct hsr_pieces_view *pieces, struct hsr_pieces_room room,
                 const struct hsr_view *view, const struct hsr_masks *masks,
                 struct hsr_tally *tally, struct hsr_arena *arena);

/* hsr_pieces_tree: makes a tree the current one, borrowed with its shift.
 * hsr_pieces_leaf: makes a leaf of it the current one, and transforms its
 * points. */
void hsr_pieces_tree(struct hsr_pieces_view *pieces, const struct hsr_bsp *bsp,
                     const double shift[3]);
void hsr_pieces_leaf(struct hsr_pieces_view *pieces,
                     const struct hsr_bsp_cube *leaf);

/* Makes a piece of the current leaf the current one, and finds `box`: the
 * samples that it may cover. False if there are none in the window. */
bool hsr_pieces_take(struct hsr_pieces_view *pieces,
                     const struct hsr_bsp_piece *piece, int facing);

/* Makes pieces->polygon, that of the current piece. */
void hsr_pieces_outline(struct hsr_pieces_view *pieces);

/* Makes a box in the world, moved by `shift`, the current one, and finds `box`:
 * the samples that it may cover. HSR_BOX_OUTSIDE: there are none in the window.
 * HSR_BOX_UNKNOWN: the box is not surely before the eye; it may be seen, and
 * has no silhouette. */
enum hsr_box_place { HSR_BOX_OUTSIDE, HSR_BOX_INSIDE, HSR_BOX_UNKNOWN };
enum hsr_box_place hsr_pieces_box(struct hsr_pieces_view *pieces,
                                  const struct hsr_box *box,
                                  const double shift[3]);

/* The silhouette of the current box, which is HSR_BOX_INSIDE, as a polygon. Its
 * lines have nothing of the box outside. It is valid until the next call. */
const struct hsr_mask_polygon *
hsr_pieces_silhouette(struct hsr_pieces_view *pieces);

#ifdef __cplusplus
}
#endif
#endif
