/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A number that tells answers apart. It is made of all that hsr.h gives of an answer,
 * bit by bit: ids, lights, sums, bounds, channels, solids; and of line drawings and
 * polygons which edges and faces there are, how they are divided, what hides them,
 * and their coordinates. */
#ifndef HSR_BENCH_WEB_HASH_H
#define HSR_BENCH_WEB_HASH_H

#include "bench/library/within.h"

enum { HASH_TEXT = 17 };

/* Writes 16 hexadecimal digits: FNV-1a, of 64 bits. */
void hash_answer(const struct lib_answer *answer, char text[HASH_TEXT]);

#endif
