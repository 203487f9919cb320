/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which leaf of the quadtree is refined next: the most uncertain one, as in the
 * thesis's listing, or all of one size before those of the next, as in its
 * author's program (5.5). */
#ifndef HSR_ALGORITHMS_BOUNDED_QUEUE_H
#define HSR_ALGORITHMS_BOUNDED_QUEUE_H

#include "common/base/arena.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum hsr_bounded_order { HSR_BOUNDED_QUEUE, HSR_BOUNDED_LEVELS };

/* A leaf of side 2^-depth pixels, within this pixel. */
struct hsr_bounded_item {
  double uncertainty;
  uint32_t cell, pixel;
  int depth;
};

enum { HSR_BOUNDED_DEEPEST = 20 }; /* no cell is smaller than 2^-20 pixels */

/* All zero but for the order and the arena: empty. */
struct hsr_bounded_queue {
  enum hsr_bounded_order order;
  struct hsr_arena *arena;
  struct hsr_growing heap;                           /* by uncertainty */
  struct hsr_growing depth[HSR_BOUNDED_DEEPEST + 1]; /* by size */
  int at;                                            /* the size at hand, */
  size_t next; /* and the next of that size */
};

/* False if memory ran out. */
bool hsr_bounded_push(struct hsr_bounded_queue *queue,
                      struct hsr_bounded_item item);

/* False if the queue is empty. */
bool hsr_bounded_pop(struct hsr_bounded_queue *queue,
                     struct hsr_bounded_item *item);

#ifdef __cplusplus
}
#endif
#endif
