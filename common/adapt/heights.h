/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The side of a plane on which many corners lie, in doubles. For convex.cc. */
#ifndef HSR_COMMON_HEIGHTS_H
#define HSR_COMMON_HEIGHTS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_NO_CORNER_VERTEX (-1)

/* n corners, in columns. Corner k is at (x[k], y[k], z[k]), each coordinate
 * with an error of at most error[k], in world units. vertex[k] is the number of
 * the vertex at the corner, or HSR_NO_CORNER_VERTEX. Borrowed. */
struct hsr_corner_columns {
  const double *x, *y, *z, *error;
  const int64_t *vertex;
  size_t n;
};

/* A plane through p with the normal n. n_error and p_error bound the error of
 * each of their coordinates. */
struct hsr_rounded_plane {
  double n[3], p[3], n_error, p_error;
};

/* Returns the height of the corner (x, y, z) over a plane, times |n|. The
 * coordinates of the corner are off by at most corner_error. *error becomes a
 * bound of the result's error. */
static inline double hsr_height_over(const struct hsr_rounded_plane *plane,
                                     double x, double y, double z,
                                     double corner_error, double *error) {
  const double u = 0x1p-53, tiny = 0x1p-960;
  double a = plane->n[0], b = plane->n[1], c = plane->n[2];
  double r = x - plane->p[0], s = y - plane->p[1], t = z - plane->p[2];
  double n1 = __builtin_fabs(a) + __builtin_fabs(b) + __builtin_fabs(c);
  double r1 = __builtin_fabs(r) + __builtin_fabs(s) + __builtin_fabs(t);
  *error = 2 * (plane->n_error * r1 + plane->p_error * n1) + 16 * u * n1 * r1 +
           tiny + 2 * (n1 + 3 * plane->n_error) * corner_error;
  return a * r + b * s + c * t;
}

/* What is known of a corner. HSR_IS_CLOSE: doubles do not decide. The values of
 * several corners can be combined by |. */
enum { HSR_IS_ON = 0, HSR_IS_ABOVE = 1, HSR_IS_BELOW = 2, HSR_IS_CLOSE = 4 };

/* Sets known[k] for each corner and a plane. The vertices on[0], on[1] and
 * on[2] are exactly on the plane, and HSR_IS_ON is for these only. */
void hsr_look_at_heights(const struct hsr_rounded_plane *plane,
                         const int64_t on[3],
                         const struct hsr_corner_columns *corners,
                         int64_t *known);

/* The same for a plane across an axis, where the coordinate is `at`. It is
 * above the plane where front times the coordinate is greater; front is +1 or
 * -1. x[k] is the coordinate of corner k and error[k] its error. HSR_IS_ON if
 * both coordinates are equal and error[k] is 0. */
void hsr_look_at_levels(double at, int front, const double *x,
                        const double *error, size_t n, int64_t *known);

#ifdef __cplusplus
}
#endif
#endif
