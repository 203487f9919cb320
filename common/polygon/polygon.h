/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One polygon, and exact predicates of its plane.
 *
 * Plane       The plane of a polygon has Newell's normal (Sutherland et al.
 *             1974, eq. 6) and passes through the mean of the corners.
 * Method      A predicate is the sign of a polynomial in the polygon's doubles.
 *             It is evaluated in CGAL's interval arithmetic. If the interval
 *             holds zero, it is evaluated in exact arithmetic.
 * Result      -1, 0 or +1, unless the comment says otherwise.
 * Errors      A predicate fails only if memory runs out. Then *out_of_memory is
 *             set and the result is meaningless. Otherwise *out_of_memory is
 *             left alone.
 * Rounding    The caller's rounding mode must be to nearest. The predicates
 *             leave it so. */
#ifndef HSR_COMMON_POLYGON_H
#define HSR_COMMON_POLYGON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(protected) /* for modules: hsr-module.h */

/* A polygon in arrays of coordinates: corner k has the coordinates
 * x[stride * vertex[k]], likewise y and z. All borrowed. */
struct hsr_loop {
  const double *x, *y, *z;
  size_t stride;
  const uint32_t *vertex;
  uint32_t n;
};

/* Returns 1 if Newell's normal is not zero, else 0. */
int hsr_exact_has_normal(struct hsr_loop face, bool *out_of_memory);

/* Returns 1 if all corners lie on one line, else 0. */
int hsr_exact_is_on_line(struct hsr_loop face, bool *out_of_memory);

/* Returns the sign of a component of Newell's normal: axis 0, 1, 2 for x, y,
 * z. */
int hsr_exact_normal_sign(struct hsr_loop face, int axis, bool *out_of_memory);

/* Whether all corners are exactly on the plane of the face. */
bool hsr_is_flat(struct hsr_loop face, bool *out_of_memory);

/* Returns 1 if two faces have exactly the same plane, in either orientation,
 * else 0. */
int hsr_exact_same_plane(struct hsr_loop f, struct hsr_loop g,
                         bool *out_of_memory);

/* Returns a hash of the face's plane: the same number for all faces on exactly
 * one plane, in either orientation. Faces on different planes almost never have
 * the same number. 0: there is no hash, and the plane may be equal to any
 * other.
 */
uint64_t hsr_plane_residue(struct hsr_loop face);

/* Returns +1 if `point` is strictly in front of the face's plane, on the side
 * that the normal points to; -1 if it is strictly behind; 0 if it is on the
 * plane. */
int hsr_exact_plane_side(struct hsr_loop face, const double point[3],
                         bool *out_of_memory);

/* The same for the face after a translation by `shift`. */
int hsr_exact_moved_plane_side(struct hsr_loop face, const double shift[3],
                               const double point[3], bool *out_of_memory);

/* As hsr_exact_plane_side, for the point displaced by (e, e^2, e^3), with e
 * infinitesimal and positive. Never 0 for a face whose normal is not zero. */
int hsr_exact_displaced_plane_side(struct hsr_loop face, const double point[3],
                                   bool *out_of_memory);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
