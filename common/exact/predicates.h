/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exact predicates of the correct picture, over CGAL's number types.
 *
 * A predicate is the sign of a polynomial in the input doubles. It is evaluated
 * in CGAL's interval arithmetic. If the interval holds zero, it is evaluated in
 * exact arithmetic. The filters of common/exact/screen.h fall back to these
 * predicates. An algorithm calls the filters, not the predicates.
 * docs/correct-picture.md has the definitions, and explains the words used
 * here.
 *
 * All return -1, 0 or +1. A predicate fails only if memory runs out. Then
 * *out_of_memory is set and the result is meaningless. The caller's rounding
 * mode must be to nearest; the predicates leave it so. Screen coordinates sx,
 * sy are in pixels. */
#ifndef HSR_COMMON_PREDICATES_H
#define HSR_COMMON_PREDICATES_H

#include "common/scene/pieces.h"
#include "common/view/view.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the side of the face's plane that the eye is on: +1 in front, -1
 * behind, 0 if the plane holds the eye. In parallel projection a plane holds
 * the eye if it is parallel to the rays. */
int hsr_exact_eye_side(const struct hsr_view *view, struct hsr_loop face,
                       bool *out_of_memory);

/* Returns the sign of row(v) for the scan plane through screen height sy,
 * perturbed. For a vertex before the eye that is +1 if it lies below the scan
 * line. Never 0. */
int hsr_exact_row_side(const struct hsr_view *view, const double vertex[3],
                       double sy, bool *out_of_memory);

/* Returns the sign of edge(a, b) at screen point (sx, sy), perturbed. For an
 * edge before the eye that goes from a, above, to b, below, that is +1 if the
 * point lies to the left of the edge on the screen. 0 only if a, b and the eye
 * are on one line. */
int hsr_exact_edge_side(const struct hsr_view *view, const double a[3],
                        const double b[3], double sx, double sy,
                        bool *out_of_memory);

/* Decide whether t > near on the face's plane at (sx, sy), perturbed. That
 * holds if both of these return +1. Along a scan line, each of them changes at
 * most once.
 * hsr_exact_ahead      returns +1 if 1/t > 0, which means that the ray meets
 *                      the plane in front of the eye. In parallel projection
 *                      there is no such condition, and it returns +1.
 * hsr_exact_past_near  returns +1 if near / t < 1 or, in parallel projection,
 *                      if t > near.
 * Otherwise they return -1. Both return -1 if the plane holds the eye. */
int hsr_exact_ahead(const struct hsr_view *view, struct hsr_loop face,
                    double sx, double sy, bool *out_of_memory);
int hsr_exact_past_near(const struct hsr_view *view, struct hsr_loop face,
                        double sx, double sy, bool *out_of_memory);

/* Compares the depths of the planes of f and g, as q of common/view/view.h, at
 * (sx, sy), perturbed. Returns +1 if f is nearer, -1 if g is nearer, 0 only if
 * the planes are the same. Neither plane may hold the eye. */
int hsr_exact_nearer(const struct hsr_view *view, struct hsr_loop f,
                     struct hsr_loop g, double sx, double sy,
                     bool *out_of_memory);

/* The same on the ray through a point of the world, not perturbed. So it is 0
 * also if the planes meet on that ray. */
int hsr_exact_nearer_towards(const struct hsr_view *view, struct hsr_loop f,
                             struct hsr_loop g, const double point[3],
                             bool *out_of_memory);

/* Takes the point at which the ray of (sx, sy), perturbed, meets the plane of
 * f, and returns the side of g's plane that it is on: +1 in front, -1 behind, 0
 * only if the planes are the same. The plane of f must not hold the eye, and
 * hsr_exact_ahead must be +1 for it. The plane of g may hold the eye. */
int hsr_exact_cut_side(const struct hsr_view *view, struct hsr_loop f,
                       struct hsr_loop g, double sx, double sy,
                       bool *out_of_memory);

#ifdef __cplusplus
}
#endif
#endif
