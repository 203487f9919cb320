/* SPDX-License-Identifier: GPL-3.0-or-later */
/* On which side of a plane many corners lie, in doubles: for convex.cc. */
#ifndef HSR_COMMON_HEIGHTS_H
#define HSR_COMMON_HEIGHTS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_NO_CORNER_VERTEX (-1)

/* Corners by columns: a corner's coordinates are within `error` of its place.
 * `vertex` is the vertex that it is, or HSR_NO_CORNER_VERTEX. */
struct hsr_corner_columns {
  const double *x, *y, *z, *error;
  const int64_t *vertex;
  size_t n;
};

/* A plane through p, whose normal is n; both within an error in each
 * coordinate. */
struct hsr_rounded_plane {
  double n[3], p[3], n_error, p_error;
};

/* The height of a corner over a plane; *error bounds its error. */
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

/* What is known of a corner. */
enum { HSR_IS_ON = 0, HSR_IS_ABOVE = 1, HSR_IS_BELOW = 2, HSR_IS_CLOSE = 4 };

/* Sets known[k] for each corner: above or below the plane, or close to it:
 * doubles do not decide. Vertices on[0] to on[2] are known to be on it. */
void hsr_look_at_heights(const struct hsr_rounded_plane *plane,
                         const int64_t on[3],
                         const struct hsr_corner_columns *corners,
                         int64_t *known);

/* The same for the plane where a coordinate x is `at`, and front * x grows
 * upwards, given the corners' coordinates x; an exact one may be on it. */
void hsr_look_at_levels(double at, int front, const double *x,
                        const double *error, size_t n, int64_t *known);

#ifdef __cplusplus
}
#endif
#endif
