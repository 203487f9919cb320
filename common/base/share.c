/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/base/share.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>

int hsr_threads(long wanted) {
  return wanted < 1                  ? 1
         : wanted > HSR_MOST_THREADS ? HSR_MOST_THREADS
                                     : (int)wanted;
}

struct hand {
  void (*work)(void *context, int thread);
  void *context;
  int number;
  pthread_t thread;
  bool started;
};

static void *run(void *argument) {
  struct hand *hand = argument;
  hand->work(hand->context, hand->number);
  return NULL;
}

void hsr_threads_run(int threads, void (*work)(void *context, int thread),
                     void *context) {
  struct hand hand[HSR_MOST_THREADS];
  threads = hsr_threads(threads);
  for (int k = 1; k < threads; k++) {
    hand[k] = (struct hand){.work = work, .context = context, .number = k};
    hand[k].started = !pthread_create(&hand[k].thread, NULL, run, &hand[k]);
  }
  work(context, 0);
  for (int k = 1; k < threads; k++)
    if (hand[k].started)
      pthread_join(hand[k].thread, NULL);
}

/* The parts that are shared out. `next` is wider than n, since every thread
 * adds 1 once more after the last part. */
struct shared {
  void (*part)(void *context, uint32_t k, int thread);
  void *context;
  uint32_t n;
  atomic_uint_fast64_t next;
};

static void take_parts(void *context, int thread) {
  struct shared *shared = context;
  for (uint64_t k; (k = atomic_fetch_add(&shared->next, 1)) < shared->n;)
    shared->part(shared->context, (uint32_t)k, thread);
}

void hsr_share(int threads, uint32_t n,
               void (*part)(void *context, uint32_t k, int thread),
               void *context) {
  struct shared shared = {.part = part, .context = context, .n = n};
  threads = hsr_threads(threads);
  hsr_threads_run(n < (uint32_t)threads ? (int)n : threads, take_parts,
                  &shared);
}

struct search {
  uint32_t (*look)(void *context, uint32_t from, uint32_t to);
  void *context;
  uint32_t n, size;
  atomic_uint_fast32_t first; /* found so far; n: none */
};

static void search_part(void *context, uint32_t k, int thread) {
  struct search *search = context;
  struct hsr_range range = hsr_range_of(search->n, search->size, k);
  uint_fast32_t found = search->look(search->context, range.from, range.to);
  uint_fast32_t first = atomic_load(&search->first);
  (void)thread;
  while (found < range.to && found < first &&
         !atomic_compare_exchange_weak(&search->first, &first, found))
    ; /* `first` is what it has become */
}

uint32_t hsr_share_search(int threads, uint32_t n, uint32_t size,
                          uint32_t (*look)(void *context, uint32_t from,
                                           uint32_t to),
                          void *context) {
  struct search search = {
      .look = look, .context = context, .n = n, .size = size, .first = n};
  hsr_share(threads, hsr_n_ranges(n, size), search_part, &search);
  return (uint32_t)atomic_load(&search.first);
}
