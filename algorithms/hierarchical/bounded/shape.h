/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A polygon on the continuous screen: what of it lies in a square of the
 * screen, how near it is there, and how much of the square it covers.
 *
 * Source      N. Greene, "Hierarchical Rendering of Complex Environments", PhD
 *             thesis, UC Santa Cruz, 1995, 5.4.
 * Line        e(sx, sy) = a sx + b sy + c, linear on the screen. An edge from A
 *             to B has e = det(A - E, B - E, D), or in parallel det(A - P, B -
 *             P, F); it is defined behind the eye as well, so nothing need be
 *             clipped. The plane's q is another, and makes the line where t is
 *             `near`.
 * Convex      the polygon is where all its lines are positive.
 * Fan         any other polygon, as triangles from its first corner. A point is
 *             in it if it is in an odd number of them: the parity of the
 *             polygon (docs/correct-picture.md). A triangle is met, before the
 *             eye or behind, where its three lines have one sign. The lines of
 *             `near` hold for the whole.
 * Cut         a piece of a polygon is bounded by the lines where planes cut it,
 *             too. They hold for the whole, as those of `near` do.
 * Certainty   every line has a proved error, and so has all that is said of a
 *             polygon: MISSES and COVERS are certain, an area lies between two
 *             bounds. The proof is in shape.c. */
#ifndef HSR_ALGORITHMS_BOUNDED_SHAPE_H
#define HSR_ALGORITHMS_BOUNDED_SHAPE_H

#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

/* |a sx + b sy + c - e| <= error anywhere in the picture, if computed in
 * doubles. */
struct hsr_screen_line {
  double a, b, c, error;
};

/* A square of the screen, in pixels; all are exact. */
struct hsr_square {
  double x, y, half; /* its middle */
};

/* A plane that cuts polygons: N . (X - P) = 0, that of `face` of the screen's
 * world or, if that is HSR_NO_ID, one across an axis, with N = 1 along it. Each
 * component of N and of P is within its error. What is kept lies where N . (X - P) has the sign of `side`.
 */
struct hsr_shape_cut {
  uint32_t plane; /* its number: equal for equal planes */
  uint32_t face;
  int side;
  double N[3], P[3], N_error, P_error;
};

/* Where t > near on the plane of face f of the screen's world: positive there.
 * `at_eye`, in perspective only: where t > 0. Rounded and told as by
 * hsr_cut_exactly. */
void hsr_near_exactly(const struct hsr_screen *screen, uint32_t f, bool at_eye,
                      double normal[3], double *rest);

struct hsr_shape {
  uint32_t id;   /* of the face, in the scene */
  double rgb[3]; /* within 2^-53 of themselves */
  struct hsr_screen_line q;
  bool is_convex;
  int inner; /* convex: the lines of edges are inner times those of Line */
  uint32_t n_corners, n_lines;
  const double (*corner)[3]; /* in the world: edge k is from corner k to the
                                next one */
  /* Of each edge a number that is the same for all edges between the same two
   * points; others may have it, too. */
  const uint64_t *edge;
  const struct hsr_screen_line *line; /* convex: those of the edges, then those
                                         of `near`; a fan: three a triangle,
                                         from its first corner, then those of
                                         `near` */
  uint32_t n_cuts;                    /* of a piece: the last so many lines, */
  const struct hsr_shape_cut *cut;    /* which are of these planes */
  double x0, y0, x1, y1;              /* nothing of it is outside of this */
};

/* Makes the shape of face f of the screen's world, whose plane is filled in and
 * which exists; f's colour is left out. Its arrays are the arena's. `screen` is
 * not kept. False if memory ran out. */
bool hsr_shape_make(struct hsr_shape *shape, const struct hsr_screen *screen,
                    uint32_t f, uint32_t id, struct hsr_arena *arena,
                    struct hsr_tally *tally);

/* Makes a piece of a shape, which has no cuts yet and is on the plane `own`.
 * `cut` is borrowed; the lines are the arena's. False if memory ran out. */
bool hsr_shape_divide(struct hsr_shape *shape, const struct hsr_screen *screen,
                      const struct hsr_shape_cut *own,
                      const struct hsr_shape_cut *cut, uint32_t n_cuts,
                      struct hsr_arena *arena);

/* Where plane `cut` cuts a polygon on plane `own`, on the screen: positive where
 * the sign of N . (X - P), of `cut`, is that of (X - E) . M, of `own`, or in
 * parallel of F . M. Exact, but for rounding in the end to within 2^-50 of each
 * of normal[] and of *rest: e = normal . D + *rest. Not finite: nothing is known.
 */
void hsr_cut_exactly(const struct hsr_screen *screen,
                     const struct hsr_shape_cut *own,
                     const struct hsr_shape_cut *cut, double normal[3],
                     double *rest);

/* All of e on a square lies within *lo and *hi. */
static inline void hsr_line_range(const struct hsr_screen_line *line,
                                  const struct hsr_square *square, double *lo,
                                  double *hi) {
  double e = line->a * square->x + line->b * square->y + line->c;
  double by = (fabs(line->a) + fabs(line->b)) * square->half + line->error;
  *lo = e - by;
  *hi = e + by;
}

enum hsr_meeting { HSR_MISSES, HSR_MEETS, HSR_COVERS };

/* A polygon of more corners is taken as a fan. */
enum { HSR_MOST_CORNERS = 16 };

/* How a shape lies on a square: MEETS is said in doubt. */
enum hsr_meeting hsr_shape_meets(const struct hsr_shape *shape,
                                 const struct hsr_square *square);

/* Does the shape cover the square but for what is beyond line `but` and, if it
 * is another one, line `nor`? The shape is convex. */
bool hsr_shape_covers_but(const struct hsr_shape *shape,
                          const struct hsr_square *square, uint32_t but,
                          uint32_t nor);

/* A convex part of a square, in coordinates from -1 to 1. Of its area, `off`
 * may be wrong, as a share of the square's; 1: nothing is known. */
enum { HSR_CLIP_ROOM = 40 };
struct hsr_clip {
  double x[HSR_CLIP_ROOM], y[HSR_CLIP_ROOM], off;
  uint32_t n;
};

/* All of the square; what of the part lies on the positive side of a line; its
 * share of the square, between *lo and *hi. */
void hsr_clip_whole(struct hsr_clip *clip);
void hsr_clip_by(struct hsr_clip *clip, const struct hsr_screen_line *line,
                 const struct hsr_square *square);
void hsr_clip_share(const struct hsr_clip *clip, double *lo, double *hi);

/* A fan in a square: the parity of all triangles that cover it, and those that
 * meet it, each of which is where its three lines are positive, or negative. */
enum { HSR_FAN_MEETS = 3 };
struct hsr_fan {
  bool odd;
  uint32_t n, triangle[HSR_FAN_MEETS];
  bool negative[HSR_FAN_MEETS];
};

/* False if more triangles meet the square, or one of them may be there with
 * either sign. The shape is not convex. */
bool hsr_shape_fan(const struct hsr_shape *shape,
                   const struct hsr_square *square, struct hsr_fan *fan);

/* What of the part lies in triangle k of a fan; and on the positive sides of
 * the lines of `near`. */
void hsr_clip_by_triangle(struct hsr_clip *clip, const struct hsr_shape *shape,
                          const struct hsr_fan *fan, uint32_t k,
                          const struct hsr_square *square);
void hsr_clip_by_near(struct hsr_clip *clip, const struct hsr_shape *shape,
                      const struct hsr_square *square);

/* The share of a square that a shape covers. */
void hsr_shape_share(const struct hsr_shape *shape,
                     const struct hsr_square *square, double *lo, double *hi);

#ifdef __cplusplus
}
#endif
#endif
