/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One polygon, and exact answers about its plane.
 *
 * Each is the sign of a polynomial in the polygon's doubles: first in CGAL's
 * interval arithmetic, then, where the interval holds zero, in its exact
 * arithmetic. The plane has Newell's normal (Sutherland et al. 1974, eq. 6) and
 * passes through the mean of the corners.
 *
 * All return -1, 0 or +1 unless they say otherwise, and none fails but for lack
 * of memory: then *out_of_memory is set and the answer is meaningless. They must
 * run with the rounding mode to nearest, and leave it so. */
#ifndef HSR_COMMON_POLYGON_H
#define HSR_COMMON_POLYGON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A polygon in arrays of coordinates: corner k has the coordinates
 * x[stride * vertex[k]], likewise y and z. All borrowed. */
struct hsr_loop {
  const double *x, *y, *z;
  size_t stride;
  const uint32_t *vertex;
  uint32_t n;
};

/* Whether all three components of Newell's normal are zero: 0 if so, else 1. */
int hsr_exact_has_normal(struct hsr_loop face, bool *out_of_memory);

/* Whether all corners are on the plane of the face (common/scene/world.h). */
bool hsr_is_flat(struct hsr_loop face, bool *out_of_memory);

/* Whether two faces lie on one plane, in either orientation: 1 if so. */
int hsr_exact_same_plane(struct hsr_loop f, struct hsr_loop g,
                         bool *out_of_memory);

/* +1 if `point` is strictly in front of the face's plane (on the side that its
 * normal points to), -1 if behind, 0 if on it. */
int hsr_exact_plane_side(struct hsr_loop face, const double point[3],
                         bool *out_of_memory);

/* The same, of the face moved by `shift`. */
int hsr_exact_moved_plane_side(struct hsr_loop face, const double shift[3],
                               const double point[3], bool *out_of_memory);

/* The same of the face as it stands and a point displaced by (e, e^2, e^3), e
 * infinitesimal: never 0. */
int hsr_exact_displaced_plane_side(struct hsr_loop face, const double point[3],
                                   bool *out_of_memory);

#ifdef __cplusplus
}
#endif
#endif
