/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A number that tells answers apart. It is made of what hsr.h gives of an answer,
 * bit by bit: ids, lights, sums, bounds, channels, solids. Of line drawings and
 * polygons it has which edges and faces there are, how they are divided, and
 * what hides them; but no coordinates, since these are rounded, and on every
 * machine a little differently. */
#ifndef HSR_BENCH_WEB_HASH_H
#define HSR_BENCH_WEB_HASH_H

#include "bench/library/within.h"

enum { HASH_TEXT = 17 };

/* Writes 16 hexadecimal digits: FNV-1a, of 64 bits. */
void hash_answer(const struct lib_answer *answer, char text[HASH_TEXT]);

#endif
