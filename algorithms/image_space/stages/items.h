/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the stages of sort-stages sort: faces, or parts of them, and the methods.
 * For local.mk's stages.c. */
#ifndef HSR_ALGORITHMS_STAGES_ITEMS_H
#define HSR_ALGORITHMS_STAGES_ITEMS_H

#include "algorithms/algorithm.h"

/* A face; or, on a line, one run of samples that it covers. */
struct hsr_stage_item {
  uint32_t face;
  uint32_t slot;  /* of the face: where its lines are kept */
  uint32_t rank;  /* its place in Z, once that is sorted */
  int lo, hi;     /* [lo, hi) along the axis that is sorted next */
  double q;       /* no part of it is nearer than this q */
  bool surrounds; /* the window, of an area */
};

/* n items on the stack, from number `first` on. */
struct hsr_stage_list {
  size_t first, n;
};

enum hsr_stage_axis { HSR_STAGE_X, HSR_STAGE_Y, HSR_STAGE_Z };

/* The methods. `search` keeps no order: all are looked at each time. */
enum hsr_stage_method {
  HSR_STAGE_BUCKET,
  HSR_STAGE_LIST,
  HSR_STAGE_BUBBLE,
  HSR_STAGE_BINARY,
  HSR_STAGE_SEARCH
};

/* Items, the last ones on top; and where sorts are counted. */
struct hsr_stage_stack {
  struct hsr_growing items; /* of struct hsr_stage_item */
  struct hsr_arena *arena;
  struct hsr_tally *tally;
  uint32_t *room; /* n_room numbers, for buckets */
  size_t n_room;
  int sorts, buckets; /* counters of X; those of Y and Z follow */
  bool failed;        /* no memory */
};

static inline struct hsr_stage_item *
hsr_stage_at(const struct hsr_stage_stack *stack, size_t k) {
  return (struct hsr_stage_item *)stack->items.items + k;
}

/* Puts a copy on top. */
void hsr_stage_push(struct hsr_stage_stack *stack, struct hsr_stage_item item);

/* Sorts a list in place, and keeps the order of equal items: along X or Y by lo,
 * which is at least `from` and less than `to`; in Z by q, the nearest first. */
void hsr_stage_sort(struct hsr_stage_stack *stack, struct hsr_stage_list list,
                    enum hsr_stage_axis axis, enum hsr_stage_method method,
                    int from, int to);

#endif
