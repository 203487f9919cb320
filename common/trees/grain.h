/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Instances whose vertices are computed without rounding.
 *
 * Grain       the grain of some numbers is the largest power of two, 2^k, of
 *             which all of them are multiples.
 * Exact       let the coordinates of an object and the translation of an
 *             instance be multiples of g = 2^k, and let their sums be below
 *             2^52 g. Let every row of the instance's matrix be a signed unit
 *             vector. Then hsr_instance_vertex rounds nothing. So vertices on a
 *             plane stay on a plane. */
#ifndef HSR_COMMON_GRAIN_H
#define HSR_COMMON_GRAIN_H

#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_GRAIN_ANY = 1024 }; /* k of numbers that are all 0 */

/* Returns the largest k such that x[0 .. n-1] are all multiples of 2^k. */
int hsr_grain(const double *x, size_t n);

/* Returns the largest absolute value of a coordinate of the object. */
double hsr_reach(const struct hsr_object *object);

/* Whether the vertices of the instance are computed without rounding. `grain`
 * is hsr_grain of the object's coordinates and `reach` is hsr_reach of the
 * object. */
bool hsr_instance_is_exact(const struct hsr_instance *instance, int grain,
                           double reach);

#ifdef __cplusplus
}
#endif
#endif
