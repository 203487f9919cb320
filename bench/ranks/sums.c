/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/ranks/sums.h"
#include "bench/ranks/ranks.h"

#include <stdlib.h>

/* The sums from `begin` to `end`. */
struct stretch {
  size_t begin, end;
};

struct adding {
  uint64_t *sum;
  uint64_t *received; /* n */
  struct sums_sent *sent;
};

static size_t size_of(struct stretch s) {
  return (s.end - s.begin) * sizeof(uint64_t);
}

/* Sends `out` to the partner, and receives the partner's `in`. */
static void trade(struct adding *a, int partner, struct stretch out,
                  struct stretch in) {
  ranks_exchange(partner, a->sum + out.begin, size_of(out), a->received,
                 size_of(in));
  a->sent->bytes += (double)size_of(out);
  a->sent->messages += size_of(out) > 0;
}

static void trade_and_add(struct adding *a, int partner, struct stretch out,
                          struct stretch in) {
  trade(a, partner, out, in);
  for (size_t k = in.begin; k < in.end; k++)
    a->sum[k] += a->received[k - in.begin];
}

/* What rank `own` has after its swap with rank own ^ bit, of what both had. */
static struct stretch half(struct stretch of, int own, int bit) {
  size_t middle = of.begin + (of.end - of.begin) / 2;
  return own & bit ? (struct stretch){middle, of.end}
                   : (struct stretch){of.begin, middle};
}

/* The stretch that rank `own` has at last, where ranks 0 to power - 1 swap. */
static struct stretch last(struct stretch all, int own, int power) {
  for (int bit = power / 2; bit; bit /= 2)
    all = half(all, own, bit);
  return all;
}

static void swap_halves(struct adding *a, struct stretch all, int power) {
  int own = ranks_own();
  for (int bit = power / 2; bit; bit /= 2) {
    int partner = own ^ bit;
    struct stretch kept = half(all, own, bit);
    trade_and_add(a, partner, half(all, partner, bit), kept);
    all = kept;
  }
}

/* Rank 0 takes the stretches of the others as they are. */
static void collect(struct adding *a, struct stretch all, int power) {
  struct stretch none = {0, 0};
  if (ranks_own()) {
    trade(a, 0, last(all, ranks_own(), power), none);
    return;
  }
  for (int k = 1; k < power; k++) {
    struct stretch theirs = last(all, k, power);
    trade(a, k, none, theirs);
    for (size_t at = theirs.begin; at < theirs.end; at++)
      a->sum[at] = a->received[at - theirs.begin];
  }
}

enum hsr_status sums_gather(uint64_t *sum, size_t n, struct sums_sent *sent,
                            struct hsr_error *err) {
  int ranks = ranks_count(), own = ranks_own(), power = 1;
  struct stretch all = {0, n}, none = {0, 0};
  struct adding a = {.sum = sum, .sent = sent};
  *sent = (struct sums_sent){0, 0};
  if (ranks == 1)
    return HSR_OK;
  a.received = malloc(n * sizeof *a.received);
  if (!a.received)
    return hsr_fail_nomem(err);
  while (2 * power <= ranks)
    power *= 2;
  if (own >= power) /* has no partner to swap with */
    trade(&a, own - power, all, none);
  else {
    if (own + power < ranks)
      trade_and_add(&a, own + power, none, all);
    swap_halves(&a, all, power);
    collect(&a, all, power);
  }
  free(a.received);
  return HSR_OK;
}
