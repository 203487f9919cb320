/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hsr-ranks.so offers; only for ranks.c and ranks_mpi.c. */
#ifndef HSR_BENCH_RANKS_LIBRARY_H
#define HSR_BENCH_RANKS_LIBRARY_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

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
};

#endif
