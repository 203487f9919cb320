/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Threads that share out work.
 *
 * Parts       The work is cut into numbered parts. The cut does not depend on
 *             the number of threads. A free thread takes the next part, which
 *             balances parts of uneven size.
 * Result      A part writes to places of its own. So the result does not depend
 *             on which thread did which part, or when.
 * Memory      A thread is known by its number, which may index memory of its
 *             own. If the thread is the first to touch that memory, the system
 *             puts it near the thread's processor. */
#ifndef HSR_COMMON_BASE_SHARE_H
#define HSR_COMMON_BASE_SHARE_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_MOST_THREADS = 64 };

/* Returns `wanted`, brought into 1 .. HSR_MOST_THREADS. */
int hsr_threads(long wanted);

/* Calls work(context, k) for k = 0 .. threads - 1 and waits until all return.
 * Each call is on a thread of its own; call 0 is on the caller's. `threads` is
 * brought into range by hsr_threads. If a thread cannot be started, its call is
 * left out and nothing reports that. So `work` must not expect one share of the
 * work for each k: the threads that run have to do all of it. */
void hsr_threads_run(int threads, void (*work)(void *context, int thread),
                     void *context);

/* Calls part(context, k, thread) once for every k below n, on at most `threads`
 * threads and at most n. Calls run at the same time and in no fixed order;
 * `thread` is the number of the thread that makes the call. */
void hsr_share(int threads, uint32_t n,
               void (*part)(void *context, uint32_t k, int thread),
               void *context);

/* n things in a row, cut into ranges of `size` things, the last of which may be
 * shorter. A range holds the things from `from` to `to` - 1. hsr_n_ranges
 * returns how many ranges there are, and hsr_range_of returns range k. `size`
 * must not be 0. */
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

/* Returns the number of the first of n things that `look` finds, or n if it
 * finds none. look(context, from, to) is called for each range of `size`
 * things. It returns the first thing that it finds of from .. to - 1, or `to`
 * if it finds none. Calls run at the same time, on at most `threads`
 * threads. */
uint32_t hsr_share_search(int threads, uint32_t n, uint32_t size,
                          uint32_t (*look)(void *context, uint32_t from,
                                           uint32_t to),
                          void *context);

#ifdef __cplusplus
}
#endif
#endif
