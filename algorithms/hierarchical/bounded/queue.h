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

enum hsr_eb_order { HSR_EB_QUEUE, HSR_EB_LEVELS };

/* A leaf of side 2^-depth pixels, within this pixel. */
struct hsr_eb_item {
  double uncertainty;
  uint32_t cell, pixel;
  int depth;
};

enum { HSR_EB_DEEPEST = 20 }; /* no cell is smaller than 2^-20 pixels */

/* All zero but for the order and the arena: empty. */
struct hsr_eb_queue {
  enum hsr_eb_order order;
  struct hsr_arena *arena;
  struct hsr_growing heap;                      /* by uncertainty */
  struct hsr_growing depth[HSR_EB_DEEPEST + 1]; /* by size */
  int at;                                       /* the size at hand, */
  size_t next;                                  /* and the next of that size */
};

/* False if memory ran out. */
bool hsr_eb_push(struct hsr_eb_queue *queue, struct hsr_eb_item item);

/* False if the queue is empty. */
bool hsr_eb_pop(struct hsr_eb_queue *queue, struct hsr_eb_item *item);

#ifdef __cplusplus
}
#endif
#endif
