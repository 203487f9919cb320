/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The leaves of the quadtree that wait to be refined, in one of two orders: the
 * most uncertain one first, as in the listing of the thesis (5.4.3); or all of
 * one size before those of the next smaller one, as in its author's program
 * (5.5). */
#ifndef HSR_ALGORITHMS_BOUNDED_QUEUE_H
#define HSR_ALGORITHMS_BOUNDED_QUEUE_H

#include "common/base/arena.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum hsr_bounded_order { HSR_BOUNDED_QUEUE, HSR_BOUNDED_LEVELS };

/* A leaf, of side 2^-depth pixels, and the pixel that it lies in: numbers of
 * cells. */
struct hsr_bounded_item {
  double uncertainty;
  uint32_t cell, pixel;
  int depth;
};

enum { HSR_BOUNDED_DEEPEST = 20 }; /* no cell is smaller than 2^-20 pixels */

/* An empty queue is all zero, but for `order` and `arena`, which the caller
 * sets. */
struct hsr_bounded_queue {
  enum hsr_bounded_order order;
  struct hsr_arena *arena;
  struct hsr_growing heap; /* HSR_BOUNDED_QUEUE: by uncertainty */

  /* HSR_BOUNDED_LEVELS: the leaves of each depth; the depth that is being
   * taken; and the index of the next leaf of that. */
  struct hsr_growing depth[HSR_BOUNDED_DEEPEST + 1];
  int at;
  size_t next;
};

/* Adds a leaf. False: out of memory. */
bool hsr_bounded_push(struct hsr_bounded_queue *queue,
                      struct hsr_bounded_item item);

/* Takes the next leaf out. False: the queue is empty. */
bool hsr_bounded_pop(struct hsr_bounded_queue *queue,
                     struct hsr_bounded_item *item);

#ifdef __cplusplus
}
#endif
#endif
