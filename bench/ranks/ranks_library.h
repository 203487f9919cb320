/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hsr-ranks.so offers; only for ranks.c and ranks_mpi.c. */
#ifndef HSR_BENCH_RANKS_LIBRARY_H
#define HSR_BENCH_RANKS_LIBRARY_H

#include "bench/ranks/ranks.h"

/* As the functions of ranks.h. */
struct ranks_library {
  enum hsr_status (*join)(int *count, int *own, struct hsr_error *err);
  void (*leave)(void);
  bool (*is_first_failure)(void);
  void (*end)(int status);
  void (*reset)(void); /* the queue; all ranks together */
  int64_t (*take)(void);
  void (*send)(int number, const void *bytes, size_t size);
  int (*receive)(void *bytes, size_t most);
  void (*gather)(const double *own, int n, double *all);
  void (*unite)(void *bytes, size_t size);
  void (*wait)(void);
  void (*exchange)(int partner, const void *out, size_t n_out, void *in,
                   size_t n_in);
  void (*reduce)(const struct ranks_seen *with, struct ranks_seen *of, size_t n,
                 const struct ranks_order *order);
};

/* What the reduction does, in one process. */
static inline void ranks_take_nearer(const struct ranks_seen *with,
                                     struct ranks_seen *of, size_t n,
                                     const struct ranks_order *order) {
  for (size_t k = 0; k < n; k++)
    if (with[k].id != of[k].id &&
        (of[k].id == UINT32_MAX ||
         (with[k].id != UINT32_MAX &&
          order->is_nearer(order->whom, with[k].id, of[k].id, of[k].sample))))
      of[k].id = with[k].id;
}

#endif
