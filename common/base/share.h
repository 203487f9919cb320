/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Threads that share out work.
 *
 * Work is cut into numbered parts by a rule that does not know how many threads
 * there are. Whoever is free takes the next part, so parts of uneven size are
 * balanced. A part writes to places of its own, so what comes out does not
 * depend on who made which part, or when.
 * A thread is known by its number, by which it may have memory of its own; it is
 * the first to touch that, so that the system puts it near. */
#ifndef HSR_COMMON_BASE_SHARE_H
#define HSR_COMMON_BASE_SHARE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_MOST_THREADS = 64 };

/* Between 1 and HSR_MOST_THREADS. */
int hsr_threads(long wanted);

/* Calls work(context, k) for k = 0 .. threads - 1, each on a thread of its own,
 * 0 on the caller's, and waits for all. One that cannot be started is left out,
 * so whoever is there has to take all that there is to do. */
void hsr_threads_run(int threads, void (*work)(void *context, int thread),
                     void *context);

/* Calls part(context, k, thread) once for every k below n, on so many threads,
 * or fewer if there are fewer parts. */
void hsr_share(int threads, uint32_t n,
               void (*part)(void *context, uint32_t k, int thread),
               void *context);

/* Parts of n things in a row: k is the part of those from `from` to `to` - 1,
 * which are `size`, or fewer in the last part. */
struct hsr_range {
  uint32_t from, to;
};
static inline uint32_t hsr_n_ranges(uint32_t n, uint32_t size) {
  return n / size + (n % size != 0);
}
static inline struct hsr_range hsr_range_of(uint32_t n, uint32_t size,
                                            uint32_t k) {
  uint32_t from = k * size;
  struct hsr_range range = {from, n - from < size ? n : from + size};
  return range;
}

/* Calls look(context, from, to) for parts of n things, `size` at most, and
 * returns the least number that it returns, or n. It returns one of from .. to -
 * 1, or `to` for none: the first thing of a part that is not as it should be. */
uint32_t hsr_share_search(int threads, uint32_t n, uint32_t size,
                          uint32_t (*look)(void *context, uint32_t from,
                                           uint32_t to),
                          void *context);

#ifdef __cplusplus
}
#endif
#endif
