/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coordinates as multiples of a power of two, and instances that round nothing.
 *
 * If the coordinates of an object are multiples of g, every row of an
 * instance's matrix is a signed unit vector, what it adds a multiple of g too
 * and all less than 2^52 g, then every sum is exact and a plane stays one. */
#ifndef HSR_COMMON_GRAIN_H
#define HSR_COMMON_GRAIN_H

#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_GRAIN_ANY = 1024 }; /* of nothing but zeros */

/* The largest k such that all n numbers are multiples of 2^k. */
int hsr_grain(const double *x, size_t n);

/* No coordinate of the object is larger in size. */
double hsr_reach(const struct hsr_object *object);

/* Whether the instance rounds nothing, of an object of this grain and reach. */
bool hsr_instance_is_exact(const struct hsr_instance *instance, int grain,
                           double reach);

#ifdef __cplusplus
}
#endif
#endif
