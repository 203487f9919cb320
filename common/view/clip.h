/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Homogeneous clipping, before the division: Sutherland et al. 1974, "The
 * Perspective Transformation". Approximate, for bounds and drawings. No
 * comparison of the picture depends on it. */
#ifndef HSR_COMMON_CLIP_H
#define HSR_COMMON_CLIP_H

/* Clips the polygon in[0 .. n-1] of points P = (w sx, w sy, w) to the half
 * space plane . P + margin >= 0, by Sutherland and Hodgman's method. Any other
 * three coordinates will do. Writes the result to `out`, an array of the
 * caller's with room for n + n/2 + 1 points, which must not overlap `in`.
 * Returns the number of points, 0 if nothing is left. But for rounding, the
 * hull of the result holds every convex combination of the input points that
 * lies in the half space. */
int hsr_clip(const double (*in)[3], int n, const double plane[3], double margin,
             double (*out)[3]);

#endif
