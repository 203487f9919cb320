/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exact predicates of the correct picture, over CGAL's number types.
 *
 * Each is the sign of a polynomial in the input doubles. It is evaluated in
 * CGAL's interval arithmetic and, if the interval holds zero, in exact
 * arithmetic. The filters of common/exact/screen.h fall back to these
 * predicates; an algorithm calls the filters, not these.
 * docs/correct-picture.md has the definitions, and the words used here.
 *
 * All return -1, 0 or +1. They fail only if memory runs out: then
 * *out_of_memory is set and the answer is meaningless. They must run with the
 * rounding mode to nearest, and leave it so. Screen coordinates sx, sy are in
 * pixels. */
#ifndef HSR_COMMON_PREDICATES_H
#define HSR_COMMON_PREDICATES_H

#include "common/scene/pieces.h"
#include "common/view/view.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The side of the face's plane that the eye is on: +1 in front, -1 behind, 0 if
 * the plane holds the eye. In parallel it does so if rays run along it. */
int hsr_exact_eye_side(const struct hsr_view *view, struct hsr_loop face,
                       bool *out_of_memory);

/* row(v) of a vertex against the scan plane through screen height sy,
 * perturbed: for a vertex before the eye, +1 if it lies below the line. Never
 * 0. */
int hsr_exact_row_side(const struct hsr_view *view, const double vertex[3],
                       double sy, bool *out_of_memory);

/* edge(a, b) at screen point (sx, sy), perturbed. For an edge before the eye
 * that goes from a, above, to b, below: +1 if the point lies to the left of the
 * edge on the screen. 0 only if a, b and the eye are on a line. */
int hsr_exact_edge_side(const struct hsr_view *view, const double a[3],
                        const double b[3], double sx, double sy,
                        bool *out_of_memory);

/* The two halves of t > near on the face's plane at (sx, sy), perturbed. Along
 * a scan line each of them changes at most once.
 * ahead:     +1 if 1/t > 0: the ray meets the plane in front of the eye. In
 *            parallel that means nothing, and it is +1;
 * past near: +1 if near / t < 1; in parallel, if t > near.
 * Else -1; both are -1 if the plane holds the eye. */
int hsr_exact_ahead(const struct hsr_view *view, struct hsr_loop face,
                    double sx, double sy, bool *out_of_memory);
int hsr_exact_past_near(const struct hsr_view *view, struct hsr_loop face,
                        double sx, double sy, bool *out_of_memory);

/* Compares q of the planes of f and g at (sx, sy), perturbed: +1 if f is
 * nearer, -1 if g is, 0 only if the planes are the same. Neither plane may hold
 * the eye. */
int hsr_exact_nearer(const struct hsr_view *view, struct hsr_loop f,
                     struct hsr_loop g, double sx, double sy,
                     bool *out_of_memory);

/* The same on the ray through a point, and not perturbed: 0 if the planes meet
 * on that ray. */
int hsr_exact_nearer_towards(const struct hsr_view *view, struct hsr_loop f,
                             struct hsr_loop g, const double point[3],
                             bool *out_of_memory);

/* The side of g's plane on which the ray of (sx, sy), perturbed, meets the
 * plane of f: +1 in front, -1 behind, 0 only if the planes are the same. The
 * plane of f does not hold the eye and is ahead of it there; that of g may hold
 * it. */
int hsr_exact_cut_side(const struct hsr_view *view, struct hsr_loop f,
                       struct hsr_loop g, double sx, double sy,
                       bool *out_of_memory);

#ifdef __cplusplus
}
#endif
#endif
