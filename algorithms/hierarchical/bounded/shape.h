/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A shape: a polygon on the continuous screen, not on samples. What of it lies
 * in a square of the screen, how near it is there, and how much of the square
 * it covers.
 *
 * Source      N. Greene, "Hierarchical Rendering of Complex Environments", PhD
 *             thesis, UC Santa Cruz, 1995, 5.4.
 * Line        A function e(sx, sy) = a sx + b sy + c, linear on the screen.
 *             That of an edge from A to B is e = det(A - E, B - E, D), or in
 *             parallel projection det(A - P, B - P, F). It is defined behind
 *             the eye as well, so nothing need be clipped. Another is q of the
 *             polygon's plane; it gives the line where t is `near`, too.
 * Convex      the polygon is where all its lines are positive.
 * Fan         Any other polygon is a fan of triangles from its first corner. A
 *             point is in it if it is in an odd number of them: the parity of
 *             the polygon (docs/correct-picture.md). A ray meets a triangle,
 *             before the eye or behind it, where the triangle's three lines
 *             have one sign. The lines of `near` hold for the whole fan.
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

/* A line: |a sx + b sy + c - e| <= error anywhere in the picture, if computed
 * in doubles. sx and sy are in pixels. */
struct hsr_screen_line {
  double a, b, c, error;
};

/* A square of the screen, in pixels; its numbers are exact. */
struct hsr_square {
  double x, y, half; /* its middle */
};

/* A plane that cuts polygons: N . (X - P) = 0, that of `face` of the screen's
 * world or, if that is HSR_NO_ID, one across an axis, with N = 1 along it. Each
 * component of N and of P is within its error. What is kept lies where N . (X -
 * P) has the sign of `side`.
 */
struct hsr_shape_cut {
  uint32_t plane; /* a number that is equal for equal planes */
  uint32_t face;
  int side;
  double N[3], P[3], N_error, P_error;
};

/* The line that is positive where t > near on the plane of face f of the
 * screen's world; or if `at_eye`, in perspective only, where t > 0. normal[]
 * and *rest are as of hsr_cut_exactly. */
void hsr_near_exactly(const struct hsr_screen *screen, uint32_t f, bool at_eye,
                      double normal[3], double *rest);

struct hsr_shape {
  uint32_t id;   /* of the face, in the scene */
  double rgb[3]; /* within 2^-53 of themselves */
  struct hsr_screen_line q;
  bool is_convex;
  /* +1 or -1. If convex, the line of an edge is e of Line times this: so it is
   * positive inside. */
  int inner;
  uint32_t n_corners, n_lines;
  const double (*corner)[3]; /* in the world: edge k is from corner k to the
                                next one */
  /* By edge: a number that is equal for all edges between the same two
   * points. Other edges may have it by chance. */
  const uint64_t *edge;
  const struct hsr_screen_line *line;  /* convex: those of the edges, then those
                                         of `near`; a fan: three a triangle,
                                         from its first corner, then those of
                                         `near` */
  const struct hsr_screen_line *wedge; /* a fan's: two a block of triangles,
                                          through its first corner. A ray
                                          that meets the block has one sign
                                          of both */
  uint32_t n_cuts;                     /* of a piece: the last so many lines, */
  const struct hsr_shape_cut *cut;     /* which are of these planes */
  double x0, y0, x1, y1;               /* a box that holds it, in pixels */
};

/* Makes the shape of face f of the screen's world, whose id in the scene is
 * `id`. The face exists in the view, and its plane has been filled in. rgb is
 * not set. The arrays are the arena's; `screen` is not kept. False: out of
 * memory. */
bool hsr_shape_make(struct hsr_shape *shape, const struct hsr_screen *screen,
                    uint32_t f, uint32_t id, struct hsr_arena *arena,
                    struct hsr_tally *tally);

/* Makes a shape a piece of itself: adds n_cuts cuts to a shape that has none
 * and lies on the plane `own`. `cut` is borrowed as long as *shape; the lines
 * are the arena's. False: out of memory. */
bool hsr_shape_divide(struct hsr_shape *shape, const struct hsr_screen *screen,
                      const struct hsr_shape_cut *own,
                      const struct hsr_shape_cut *cut, uint32_t n_cuts,
                      struct hsr_arena *arena);

/* The line on the screen where plane `cut` cuts the plane `own` of a polygon: e
 * = normal . D + *rest. It is positive where N . (X - P) of `cut` has the sign
 * of (X - E) . M, M being the normal of `own`; in parallel projection that of F
 * . M. It is computed exactly, and each number is then rounded to within 2^-50
 * of itself. A number that is not finite says that nothing is known. */
void hsr_cut_exactly(const struct hsr_screen *screen,
                     const struct hsr_shape_cut *own,
                     const struct hsr_shape_cut *cut, double normal[3],
                     double *rest);

/* Bounds of a line's e over a square. */
static inline void hsr_line_range(const struct hsr_screen_line *line,
                                  const struct hsr_square *square, double *lo,
                                  double *hi) {
  double e = line->a * square->x + line->b * square->y + line->c;
  double by = (fabs(line->a) + fabs(line->b)) * square->half + line->error;
  *lo = e - by;
  *hi = e + by;
}

enum hsr_meeting { HSR_MISSES, HSR_MEETS, HSR_COVERS };

/* A polygon of more corners is taken as a fan, even if it is convex. */
enum { HSR_MOST_CORNERS = 16 };

/* How a shape lies to a square. HSR_MISSES and HSR_COVERS are certain. */
enum hsr_meeting hsr_shape_meets(const struct hsr_shape *shape,
                                 const struct hsr_square *square);

/* Does a convex shape cover all of the square that is inside its lines `but`
 * and `nor`? These two may be one line. */
bool hsr_shape_covers_but(const struct hsr_shape *shape,
                          const struct hsr_square *square, uint32_t but,
                          uint32_t nor);

/* A convex part of a square, by its n corners, in coordinates from -1 to 1. Its
 * area may be wrong by the share `off` of the square's; 1: nothing is known. */
enum { HSR_CLIP_ROOM = 40 };
struct hsr_clip {
  double x[HSR_CLIP_ROOM], y[HSR_CLIP_ROOM], off;
  uint32_t n;
};

/* hsr_clip_whole: makes *clip all of the square. hsr_clip_by: clips it to the
 * positive side of a line. hsr_clip_share: bounds of the share of the square
 * that it is. */
void hsr_clip_whole(struct hsr_clip *clip);
void hsr_clip_by(struct hsr_clip *clip, const struct hsr_screen_line *line,
                 const struct hsr_square *square);
void hsr_clip_share(const struct hsr_clip *clip, double *lo, double *hi);

/* A fan in a square: the parity of the number of triangles that cover the
 * square, and the triangles that meet it otherwise. negative[]: such a triangle
 * is where its three lines are negative. */
enum { HSR_FAN_MEETS = 3 };
struct hsr_fan {
  bool odd;
  uint32_t n, triangle[HSR_FAN_MEETS];
  bool negative[HSR_FAN_MEETS];
};

/* Fills *fan for a shape that is not convex. False if more than HSR_FAN_MEETS
 * triangles meet the square, or one of them may do so with either sign. */
bool hsr_shape_fan(const struct hsr_shape *shape,
                   const struct hsr_square *square, struct hsr_fan *fan);

/* hsr_clip_by_triangle: clips to the k-th triangle that meets the square.
 * hsr_clip_by_near: clips to the positive sides of the lines of `near`. */
void hsr_clip_by_triangle(struct hsr_clip *clip, const struct hsr_shape *shape,
                          const struct hsr_fan *fan, uint32_t k,
                          const struct hsr_square *square);
void hsr_clip_by_near(struct hsr_clip *clip, const struct hsr_shape *shape,
                      const struct hsr_square *square);

/* Bounds of the share of a square that a shape covers. */
void hsr_shape_share(const struct hsr_shape *shape,
                     const struct hsr_square *square, double *lo, double *hi);

#ifdef __cplusplus
}
#endif
#endif
