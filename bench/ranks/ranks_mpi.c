/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ranks by MPI. This file is hsr-ranks.so.
 *
 * All types are of fixed width: in Open MPI 4.1, MPI_UNSIGNED_LONG with MPI_MIN
 * gives wrong results (open-mpi/ompi, issue 10525).
 *
 * The queue is a number in the memory of rank 0, to which the others add by
 * themselves: rank 0 draws meanwhile and answers no message. Within a machine
 * that is shared memory. A second number tells whether somebody has failed.
 *
 * What MPI calls an error ends all ranks, as is its custom; so no call here
 * returns one. */
#include "bench/ranks/ranks_library.h"

#include <limits.h>
#include <mpi.h>

static MPI_Win window;
static int64_t *kept; /* in rank 0: the next number; how many have failed */
enum { NEXT, FAILED, N_KEPT };
enum { TO = 0, MOST_AT_ONCE = 1 << 30 };

/* struct ranks_seen, and the operation that takes the nearer one of two. MPI
 * hands an operation no context: `order` says what it asks. */
static MPI_Datatype seen;
static MPI_Op nearer;
static const struct ranks_order *order;

static void take_nearer(void *with, void *of, int *n, MPI_Datatype *type) {
  (void)type;
  ranks_take_nearer(with, of, (size_t)*n, order);
}

static void make_reduction(void) {
  MPI_Type_contiguous(sizeof(struct ranks_seen) / sizeof(uint32_t),
                      MPI_UINT32_T, &seen);
  MPI_Type_commit(&seen);
  MPI_Op_create(take_nearer, 1, &nearer);
}

static enum hsr_status join(int *count, int *own, struct hsr_error *err) {
  int can;
  if (MPI_Init_thread(NULL, NULL, MPI_THREAD_SERIALIZED, &can) ||
      can < MPI_THREAD_SERIALIZED)
    return hsr_fail(err, HSR_E_INPUT,
                    "MPI cannot be called by several threads in turn");
  MPI_Comm_size(MPI_COMM_WORLD, count);
  MPI_Comm_rank(MPI_COMM_WORLD, own);
  MPI_Aint size = *own == 0 ? N_KEPT * (MPI_Aint)sizeof *kept : 0;
  MPI_Win_allocate(size, sizeof *kept, MPI_INFO_NULL, MPI_COMM_WORLD,
                   (void *)&kept, &window);
  MPI_Win_lock_all(0, window);
  if (*own == 0) {
    kept[NEXT] = kept[FAILED] = 0;
    MPI_Win_sync(window);
  }
  make_reduction();
  MPI_Barrier(MPI_COMM_WORLD);
  return HSR_OK;
}

static void leave(void) {
  MPI_Barrier(MPI_COMM_WORLD);
  MPI_Op_free(&nearer);
  MPI_Type_free(&seen);
  MPI_Win_unlock_all(window);
  MPI_Win_free(&window);
  MPI_Finalize();
}

/* Does `op` with `by` to a number, and tells what was there before. */
static int64_t change(int number, int64_t by, MPI_Op op) {
  int64_t before;
  MPI_Fetch_and_op(&by, &before, MPI_INT64_T, 0, number, op, window);
  MPI_Win_flush(0, window);
  return before;
}

static int64_t take(void) {
  return change(NEXT, 1, MPI_SUM);
}

static bool is_first_failure(void) {
  return change(FAILED, 1, MPI_SUM) == 0;
}

static void end(int status) {
  MPI_Abort(MPI_COMM_WORLD, status);
}

/* Nobody takes a number before all are here, nor until it is 0. */
static void reset(void) {
  int own;
  MPI_Comm_rank(MPI_COMM_WORLD, &own);
  MPI_Barrier(MPI_COMM_WORLD);
  if (own == 0)
    change(NEXT, 0, MPI_REPLACE);
  MPI_Barrier(MPI_COMM_WORLD);
}

static void send(int number, const void *bytes, size_t size) {
  MPI_Send(bytes, (int)size, MPI_BYTE, TO, number, MPI_COMM_WORLD);
}

static int receive(void *bytes, size_t most) {
  MPI_Status status;
  MPI_Recv(bytes, most < INT_MAX ? (int)most : INT_MAX, MPI_BYTE,
           MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &status);
  return status.MPI_TAG;
}

static void gather(const double *own, int n, double *all) {
  MPI_Gather(own, n, MPI_DOUBLE, all, n, MPI_DOUBLE, TO, MPI_COMM_WORLD);
}

static void unite(void *bytes, size_t size) {
  for (size_t at = 0; at < size; at += MOST_AT_ONCE) {
    size_t rest = size - at;
    MPI_Allreduce(MPI_IN_PLACE, (char *)bytes + at,
                  rest < MOST_AT_ONCE ? (int)rest : MOST_AT_ONCE, MPI_BYTE,
                  MPI_BOR, MPI_COMM_WORLD);
  }
}

static void wait(void) {
  MPI_Barrier(MPI_COMM_WORLD);
}

/* The bytes of n from `at` on that go at once. */
static int at_once(size_t n, size_t at) {
  size_t rest = n > at ? n - at : 0;
  return rest < MOST_AT_ONCE ? (int)rest : MOST_AT_ONCE;
}

static void exchange(int partner, const void *out, size_t n_out, void *in,
                     size_t n_in) {
  size_t n = n_out > n_in ? n_out : n_in;
  for (size_t at = 0; at < n; at += MOST_AT_ONCE) {
    int own = at_once(n_out, at), other = at_once(n_in, at);
    MPI_Sendrecv(own ? (const char *)out + at : NULL, own, MPI_BYTE, partner, 0,
                 other ? (char *)in + at : NULL, other, MPI_BYTE, partner, 0,
                 MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  }
}

static void reduce(const struct ranks_seen *with, struct ranks_seen *of,
                   size_t n, const struct ranks_order *by) {
  order = by;
  for (size_t at = 0; at < n; at += MOST_AT_ONCE)
    MPI_Reduce_local(with + at, of + at, at_once(n, at), seen, nearer);
}

extern const struct ranks_library hsr_ranks;
const struct ranks_library hsr_ranks = {.join = join,
                                        .leave = leave,
                                        .is_first_failure = is_first_failure,
                                        .end = end,
                                        .reset = reset,
                                        .take = take,
                                        .send = send,
                                        .receive = receive,
                                        .gather = gather,
                                        .unite = unite,
                                        .wait = wait,
                                        .exchange = exchange,
                                        .reduce = reduce};
