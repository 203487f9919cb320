/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Coordinates as multiples of a power of two, and instances that round nothing.
 *
 * Let the coordinates of an object be multiples of g, every row of an
 * instance's matrix a signed unit vector, its translation a multiple of g too,
 * and all of these less than 2^52 g. Then every sum is exact, and a plane stays
 * a plane. */
#ifndef HSR_COMMON_GRAIN_H
#define HSR_COMMON_GRAIN_H

#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_GRAIN_ANY = 1024 }; /* the grain of zeros alone */

/* The largest k such that all n numbers are multiples of 2^k. */
int hsr_grain(const double *x, size_t n);

/* The largest size of a coordinate of the object. */
double hsr_reach(const struct hsr_object *object);

/* Whether the instance rounds nothing. Its object has this grain and reach. */
bool hsr_instance_is_exact(const struct hsr_instance *instance, int grain,
                           double reach);

#ifdef __cplusplus
}
#endif
#endif
