/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sort-last of what is summed: arrays of whole numbers that ranks add.
 *
 * Source      as in bench/ranks/composite.h: binary swap.
 * Exact       numbers of 64 bits are added, modulo 2^64. So the sum does not
 *             depend on how many ranks there are, nor on which drew what.
 * Cost        R ranks, of which H, a power of 2, have a partner: R - H whole
 *             arrays are sent, then halves, quarters, ..., and what is gathered.
 *             That is R - 1/H arrays at most. */
#ifndef HSR_BENCH_RANKS_SUMS_H
#define HSR_BENCH_RANKS_SUMS_H

#include "common/base/status.h"

#include <stddef.h>
#include <stdint.h>

/* What a rank has sent. */
struct sums_sent {
  double bytes, messages;
};

/* sum[k] of rank 0, of n, becomes that of all ranks; what others have is
 * meaningless then. All ranks call it. HSR_E_NOMEM. */
enum hsr_status sums_gather(uint64_t *sum, size_t n, struct sums_sent *sent,
                            struct hsr_error *err);

#endif
