/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One polygon, and exact answers about its plane.
 *
 * Each is the sign of a polynomial in the polygon's doubles. It is evaluated in
 * CGAL's interval arithmetic and, if the interval holds zero, in its exact
 * arithmetic. The plane has Newell's normal (Sutherland et al. 1974, eq. 6) and
 * passes through the mean of the corners.
 *
 * All return -1, 0 or +1 unless they say otherwise. Those that have out_of_memory
 * fail only if memory runs out: then *out_of_memory is set and the answer is meaningless. They must
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

/* 1 if a component of Newell's normal is not zero, else 0. */
int hsr_exact_has_normal(struct hsr_loop face, bool *out_of_memory);

/* The sign of a component of Newell's normal; axis 0, 1 or 2. */
int hsr_exact_normal_sign(struct hsr_loop face, int axis, bool *out_of_memory);

/* Whether all corners are on the plane of the face (common/scene/world.h). */
bool hsr_is_flat(struct hsr_loop face, bool *out_of_memory);

/* 1 if two faces lie on one plane, in either orientation, else 0. */
int hsr_exact_same_plane(struct hsr_loop f, struct hsr_loop g,
                         bool *out_of_memory);

/* A number that is the same for all faces on one plane, in either orientation. Faces
 * on different planes almost never have the same number. 0: nothing is known, and
 * the plane may be equal to any other. */
uint64_t hsr_plane_residue(struct hsr_loop face);

/* +1 if `point` is strictly in front of the face's plane (on the side that its
 * normal points to), -1 if behind, 0 if on it. */
int hsr_exact_plane_side(struct hsr_loop face, const double point[3],
                         bool *out_of_memory);

/* The same for the face moved by `shift`. */
int hsr_exact_moved_plane_side(struct hsr_loop face, const double shift[3],
                               const double point[3], bool *out_of_memory);

/* The same for the face where it is and a point displaced by (e, e^2, e^3),
 * with e infinitesimal and positive. Never 0. */
int hsr_exact_displaced_plane_side(struct hsr_loop face, const double point[3],
                                   bool *out_of_memory);

#ifdef __cplusplus
}
#endif
#endif
