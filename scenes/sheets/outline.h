/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which squares of a lattice a sheet has: as many as asked, with as many free
 * sides as asked. A side is free if no other square of the sheet has it. */
#ifndef HSR_SCENES_OUTLINE_H
#define HSR_SCENES_OUTLINE_H

#include <stdint.h>

/* The least number of free sides of n squares, 2 ceil(2 sqrt(n)), n >= 1. The
 * largest is 4 n. */
uint32_t hsr_outline_least(uint32_t n);

/* Writes the n >= 1 squares of a sheet with `sides` free sides: an even number,
 * from hsr_outline_least(n) to 4 n. Square k is at column ij[k][0] and row
 * ij[k][1], both 0 or above. The array is the caller's. */
void hsr_outline(uint32_t n, uint32_t sides, uint32_t (*ij)[2]);

#endif
