/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Judging algorithms by their oracle: all of a kind on one scene, view and
 * size, each in a process of its own. */
#ifndef HSR_BENCH_JUDGE_H
#define HSR_BENCH_JUDGE_H

#include "bench/command.h"

enum { N_KINDS = HSR_FILTERED + 1 };

/* The oracle of a kind; NULL if there is none. */
const struct hsr_algorithm *oracle_of(enum hsr_kind kind);

enum verdict { PENDING, RIGHT, WRONG, REFUSED, TIMEOUT, CRASH };

/* "ok", "wrong", "refused", "timeout", "crash"; what is PENDING has crashed. */
const char *verdict_name(enum verdict verdict);

/* What became of one algorithm; in memory shared between the processes. */
struct cell {
  enum verdict verdict;
  enum hsr_status failure; /* why the process stopped, if not HSR_OK */
  uint64_t compared;       /* samples, or edges, in the build that is timed */
  uint64_t mismatches;     /* of those in both builds */
  struct {                 /* the first of them */
    int i, j;
    uint32_t got, wanted;
    struct hsr_edge_name edge; /* of a line drawing */
  } first;
  uint64_t count[HSR_MAX_COUNTERS]; /* by the counting build */
  uint64_t depths_compared, depths_exact;
  long peak_kb; /* the most memory that its process held */
  const char
      *adapted[HSR_MAX_ADAPTATIONS]; /* adapters that changed the scene */
  int n_adaptations;
  char refusal[560]; /* who refused and why */
};

/* All algorithms of a kind on one scene, view and size. All borrowed. */
struct group {
  const struct hsr_variant *algorithm; /* also those of other kinds */
  int n_algorithms;
  const long *threads; /* an algorithm, for the build that is timed; NULL: 1 */
  long timeout;        /* seconds that a picture may take */
  long memory_mb;      /* of data that a process may hold; 0: any */
  const struct hsr_world *world;
  enum hsr_kind kind;
  struct hsr_view view;
  struct cell *cells; /* an algorithm */
  uint32_t *picture;  /* where the oracle leaves its ids, m * n; or NULL */
};

/* To be called in a process of its own. Where the oracle of line drawings takes
 * longer than a picture may, that ends by SIGALRM, and the cells are refused.
 * Any failure is the oracle's. */
enum hsr_status judge_group(const struct group *group);

/* Zeroed memory that processes forked later share; NULL if there is none. */
void *shared_memory(size_t size);

#endif
