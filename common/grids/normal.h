/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Directions in twelve bits: points of an octahedron, which is unfolded into a
 * square of 64 x 64. */
#ifndef HSR_COMMON_GRIDS_NORMAL_H
#define HSR_COMMON_GRIDS_NORMAL_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_NORMALS = 4096, HSR_NO_NORMAL = HSR_NORMALS };

/* The code nearest to a direction; HSR_NO_NORMAL if it has no length, or one
 * that is not finite. */
uint16_t hsr_normal_code(const double direction[3]);

/* The direction of a code below HSR_NORMALS; |x| + |y| + |z| is 63. */
void hsr_normal_of(uint16_t code, int direction[3]);

#ifdef __cplusplus
}
#endif
#endif
