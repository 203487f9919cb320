/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ranks: processes that work together, started by mpirun. Without mpirun there
 * is one. Rank 0 writes files and prints; the standard output of the others
 * leads nowhere.
 *
 * Work is shared out by a queue of numbers. Whoever is free takes the next one,
 * so work of uneven size is balanced. */
#ifndef HSR_BENCH_RANKS_H
#define HSR_BENCH_RANKS_H

#include "common/base/status.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Whether mpirun, or srun, started this process. */
bool ranks_are_started(void);

/* Whether it is the first of those that were started, or the only one. */
bool ranks_is_spokesman(void);

/* Joins the other ranks, if there are any. To be called once, by one thread,
 * before what follows. HSR_E_INPUT: this hsr is built without MPI, or MPI
 * fails. */
enum hsr_status ranks_join(struct hsr_error *err);

/* How many there are, and which one this is; 1 and 0 before ranks_join. */
int ranks_count(void);
int ranks_own(void);

/* Waits for the others and leaves them. After a failure the program calls
 * ranks_end instead. */
void ranks_leave(void);

/* Says whether this rank is the first that fails, and so the one that tells of
 * it. If not, does not return: the first ends all. */
void ranks_claim_failure(void);
/* Ends all ranks with this status. Does nothing if there is only one. */
void ranks_end(int status);

/* --- The queue ------------------------------------------------------------ */

/* The numbers from 0 to all - 1. */
struct queue {
  long all;
  bool shared; /* by all ranks */
  atomic_long next;
};

/* All ranks open and use a shared queue together, one at a time. */
void queue_open(struct queue *queue, long all, bool shared);

/* The next number, which nobody else gets; -1 if none is left. May be called by
 * several threads. */
long queue_take(struct queue *queue);

/* --- Messages ------------------------------------------------------------- */

/* Sends bytes with a number to rank 0, which receives them from whoever is
 * ready. ranks_receive returns the number; there is room for `most` bytes. */
void ranks_send(int number, const void *bytes, size_t size);
int ranks_receive(void *bytes, size_t most);

/* All ranks call these together. n numbers of each rank in turn, which only
 * rank 0 gets; the bits that are set in any rank, which all get; and nothing, when
 * all have called. */
void ranks_gather(const double *own, int n, double *all);
void ranks_unite(void *bytes, size_t size);
void ranks_wait(void);

/* Sends n_out bytes to another rank, and receives n_in bytes from it, which
 * calls this at the same time. */
void ranks_exchange(int partner, const void *out, size_t n_out, void *in,
                    size_t n_in);

/* --- The reduction -------------------------------------------------------- */

/* A sample, and the face that is seen there; UINT32_MAX: none. */
struct ranks_seen {
  uint32_t sample, id;
};

/* Whether face f is nearer than face g, which is another, at a sample. */
struct ranks_order {
  bool (*is_nearer)(void *whom, uint32_t f, uint32_t g, uint32_t sample);
  void *whom;
};

/* of[k] becomes the nearer of of[k] and with[k], which have the same sample. */
void ranks_reduce(const struct ranks_seen *with, struct ranks_seen *of,
                  size_t n, const struct ranks_order *order);

#endif
