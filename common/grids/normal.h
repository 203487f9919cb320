/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Directions in twelve bits. A direction is a point of an octahedron, which is
 * unfolded into a square of 64 x 64 codes (docs/composited-picture.md). */
#ifndef HSR_COMMON_GRIDS_NORMAL_H
#define HSR_COMMON_GRIDS_NORMAL_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_NORMALS = 4096, HSR_NO_NORMAL = HSR_NORMALS };

/* Returns the code of a direction of any length, rounded in the square.
 * HSR_NO_NORMAL if its length is 0 or not finite. */
uint16_t hsr_normal_code(const double direction[3]);

/* Writes the direction of a code, which must be below HSR_NORMALS. |x| + |y| +
 * |z| is 63. */
void hsr_normal_of(uint16_t code, int direction[3]);

#ifdef __cplusplus
}
#endif
#endif
