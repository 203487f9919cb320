/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/ranks/ranks.h"

#include "config.h"

#include "bench/ranks/ranks_library.h"
#include "common/files/library.h"

#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const struct ranks_library *mpi; /* NULL: there is one rank */
static int count = 1, own;
/* MPI is called by one thread at a time. */
static pthread_mutex_t turn = PTHREAD_MUTEX_INITIALIZER;

/* --- Joining and leaving -------------------------------------------------- */

/* Open MPI's mpirun sets the first; srun, and any launcher that speaks PMIx,
 * the second. */
bool ranks_are_started(void) {
  const char *size = getenv("OMPI_COMM_WORLD_SIZE");
  return size ? atoi(size) > 1 : getenv("PMIX_RANK") != NULL;
}

bool ranks_is_spokesman(void) {
  const char *rank = getenv("OMPI_COMM_WORLD_RANK");
  if (!rank)
    rank = getenv("PMIX_RANK");
  return !rank || !strcmp(rank, "0");
}

static void close_output(void) {
  int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere < 0)
    return;
  dup2(nowhere, STDOUT_FILENO);
  close(nowhere);
}

enum hsr_status ranks_join(struct hsr_error *err) {
  if (!ranks_are_started())
    return HSR_OK;
  if (!HSR_HAVE_MPI)
    return hsr_fail(err, HSR_E_INPUT,
                    "this hsr is built without MPI (configure --with-mpi), so "
                    "mpirun cannot share its work out");
  const void *table;
  enum hsr_status status =
      hsr_library_table("hsr-ranks.so", "hsr_ranks", &table, err);
  const struct ranks_library *library = table;
  if (!status)
    status = library->join(&count, &own, err);
  if (status)
    return status;
  mpi = library;
  if (own)
    close_output();
  return HSR_OK;
}

int ranks_count(void) {
  return count;
}

int ranks_own(void) {
  return own;
}

void ranks_leave(void) {
  if (mpi)
    mpi->leave();
  mpi = NULL;
}

void ranks_claim_failure(void) {
  if (!mpi || mpi->is_first_failure())
    return;
  for (;;) /* until the first one ends all */
    pause();
}

void ranks_end(int status) {
  if (mpi)
    mpi->end(status);
}

/* --- The queue ------------------------------------------------------------ */

void queue_open(struct queue *queue, long all, bool shared) {
  queue->all = all;
  queue->shared = shared && mpi;
  atomic_init(&queue->next, 0);
  if (queue->shared)
    mpi->reset();
}

static long take_shared(void) {
  pthread_mutex_lock(&turn);
  long number = (long)mpi->take();
  pthread_mutex_unlock(&turn);
  return number;
}

long queue_take(struct queue *queue) {
  long number =
      queue->shared ? take_shared() : atomic_fetch_add(&queue->next, 1);
  return number < queue->all ? number : -1;
}

/* --- Messages ------------------------------------------------------------- */

void ranks_send(int number, const void *bytes, size_t size) {
  mpi->send(number, bytes, size);
}

int ranks_receive(void *bytes, size_t most) {
  return mpi->receive(bytes, most);
}

void ranks_gather(const double *numbers, int n, double *all) {
  if (mpi)
    mpi->gather(numbers, n, all);
  else
    memcpy(all, numbers, (size_t)n * sizeof *all);
}

void ranks_unite(void *bytes, size_t size) {
  if (mpi)
    mpi->unite(bytes, size);
}

void ranks_wait(void) {
  if (mpi)
    mpi->wait();
}

void ranks_exchange(int partner, const void *out, size_t n_out, void *in,
                    size_t n_in) {
  mpi->exchange(partner, out, n_out, in, n_in);
}

void ranks_reduce(const struct ranks_seen *with, struct ranks_seen *of,
                  size_t n, const struct ranks_order *order) {
  if (mpi)
    mpi->reduce(with, of, n, order);
  else
    ranks_take_nearer(with, of, n, order);
}
