/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Judging algorithms by their oracle: all of a kind on one scene and size, and
 * one view or a sequence of them, each in a process of its own. */
#ifndef HSR_BENCH_JUDGE_H
#define HSR_BENCH_JUDGE_H

#include "algorithms/setup.h"
#include "bench/modules/variant.h"
#include "bench/judge/wanted.h"

#include <semaphore.h>

/* Frames in which objects move: a scene for each, of its own. */
struct walk {
  struct hsr_scene **frame; /* n, finished */
  int n;
  struct hsr_scene *follower; /* the first frame once more, which can follow all
                                 others in turn, and then the first; NULL: the
                                 frames are scenes that are not of one walk */
};

enum verdict { PENDING, RIGHT, WRONG, REFUSED, TIMEOUT, CRASH };

/* "ok", "wrong", "refused", "timeout", "crash"; what is PENDING has crashed. */
const char *verdict_name(enum verdict verdict);

enum { HSR_ADAPTER_NAME = 32 };

/* What became of one algorithm's picture; in memory shared between the
 * processes. */
struct cell {
  enum verdict verdict;
  bool done;               /* the verdict is the last one; set after the rest */
  int builds;              /* that drew it and were compared, of two */
  enum hsr_status failure; /* why the process stopped, if not HSR_OK */
  int signal;              /* that ended the process, or 0 */
  char why[480];           /* the same in words; "": nobody says */
  uint64_t compared;   /* samples, edges, ...: places of its kind of answer */
  uint64_t mismatches; /* of those, in the build that is timed */
  uint64_t counting_mismatches; /* and in the one that counts */
  char first[200]; /* the first of them in words, as in struct hsr_difference */
  uint64_t count[HSR_MAX_COUNTERS]; /* by the counting build */
  uint64_t culled[HSR_N_CULLS];     /* likewise */
  uint64_t depths_compared, depths_exact;
  long peak_kb; /* the most memory that its process held */
  char adapted[HSR_MAX_ADAPTATIONS][HSR_ADAPTER_NAME]; /* adapters that changed
                                                          the scene */
  int n_adaptations;
  char refusal[560]; /* who refused and why */
};

struct crew_watch; /* bench/run/crew.h */

/* All algorithms of one form of answer on one scene and size. All borrowed. */
struct group {
  const struct hsr_variant *algorithm; /* also those of other forms */
  int n_algorithms;
  const long *threads; /* an algorithm, for the build that is timed; NULL: 1 */
  long timeout;        /* seconds that a picture may take */
  long memory_mb;      /* of data that a process may hold; 0: any */
  long samples;        /* places of each picture that are compared; 0: all */
  const struct hsr_world *world;
  struct hsr_form form;
  const struct walk *walk; /* view k is of its frame k, `world` of the first.
                              NULL: all views are of `world` */

  /* Algorithms for which flags & mask == flags are judged: 0, 0: all. Of these,
   * not those for which left_out is set; NULL: none. */
  unsigned mask, flags;
  const bool *left_out;

  /* An algorithm draws all views in this order from one prepared object. */
  const struct hsr_view *view;
  const int *number; /* of each view, from 0: some samples are chosen by it */
  int n_views;

  struct cell *cells; /* a view and algorithm */
  /* Each process that works holds one turn. Groups may share the turns. NULL:
   * this group runs one process at a time. A signal may end a group while it
   * holds a turn; whoever waits for the group gives that turn back. */
  sem_t *turns;
  const char *differences; /* a folder for what is wrong, beside what is right;
                              or NULL */
  const struct crew_watch *watch; /* who is told while the oracle draws whole
                                     pictures of samples; or NULL */
  uint32_t *picture; /* where the oracle leaves its ids, m * n of each view,
                        HSR_NOT_WRITTEN where it was not asked; or NULL */
};

/* To be called in a process of its own. Where the oracle of line drawings takes
 * longer than a picture may, that ends by SIGALRM, and the cells are refused.
 * Any failure is the oracle's. */
enum hsr_status judge_group(const struct group *group);

/* Zeroed memory that processes forked later share; NULL if there is none. */
void *shared_memory(size_t size);

#endif
