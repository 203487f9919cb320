/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/image_space/stages/items.h"

#include <math.h>
#include <string.h>

void hsr_stage_push(struct hsr_stage_stack *stack, struct hsr_stage_item item) {
  if (!hsr_arena_grow(stack->arena, &stack->items, sizeof item)) {
    stack->failed = true;
    return;
  }
  *hsr_stage_at(stack, stack->items.n - 1) = item;
}

/* --- Comparisons ---------------------------------------------------------- */

/* One comparison: is a to stand behind b? */
static bool is_behind(struct hsr_stage_stack *stack, enum hsr_stage_axis axis,
                      const struct hsr_stage_item *a,
                      const struct hsr_stage_item *b) {
  const bool behind = axis == HSR_STAGE_Z ? a->q < b->q : a->lo > b->lo;
  HSR_STEP(stack->tally, stack->sorts + (int)axis, HSR_FACE(a->face),
           HSR_FACE(b->face), HSR_NOWHERE, behind);
  return behind;
}

/* --- Methods -------------------------------------------------------------- */

/* Each item is compared with those before it, from the last one on. */
static void sort_by_list(struct hsr_stage_stack *stack,
                         struct hsr_stage_item *item, size_t n,
                         enum hsr_stage_axis axis) {
  for (size_t k = 1; k < n; k++) {
    const struct hsr_stage_item one = item[k];
    size_t place = k;
    while (place && is_behind(stack, axis, &item[place - 1], &one)) {
      item[place] = item[place - 1];
      place--;
    }
    item[place] = one;
  }
}

static void sort_by_bubbles(struct hsr_stage_stack *stack,
                            struct hsr_stage_item *item, size_t n,
                            enum hsr_stage_axis axis) {
  for (bool moved = true; moved && n > 1; n--) {
    moved = false;
    for (size_t k = 1; k < n; k++)
      if (is_behind(stack, axis, &item[k - 1], &item[k])) {
        const struct hsr_stage_item one = item[k];
        item[k] = item[k - 1];
        item[k - 1] = one;
        moved = true;
      }
  }
}

/* The place of each item is found by halving. */
static void sort_by_halving(struct hsr_stage_stack *stack,
                            struct hsr_stage_item *item, size_t n,
                            enum hsr_stage_axis axis) {
  for (size_t k = 1; k < n; k++) {
    const struct hsr_stage_item one = item[k];
    size_t low = 0, high = k;
    while (low < high) {
      const size_t middle = (low + high) / 2;
      if (is_behind(stack, axis, &item[middle], &one))
        high = middle;
      else
        low = middle + 1;
    }
    memmove(item + low + 1, item + low, (k - low) * sizeof *item);
    item[low] = one;
  }
}

/* In which of so many buckets an item goes. */
struct buckets {
  enum hsr_stage_axis axis;
  int from;
  double nearest, per_q; /* in Z */
  size_t n;
};

static size_t bucket_of(const struct buckets *b,
                        const struct hsr_stage_item *item) {
  if (b->axis != HSR_STAGE_Z)
    return (size_t)(item->lo - b->from);
  if (!(item->q < b->nearest))
    return 0;
  const double bucket = (b->nearest - item->q) * b->per_q;
  return bucket < (double)b->n ? (size_t)bucket : b->n - 1;
}

/* As many buckets in Z as there are items; q that are not finite share one. */
static struct buckets buckets_in_z(const struct hsr_stage_item *item, size_t n,
                                   size_t most) {
  double nearest = -INFINITY, farthest = INFINITY;
  for (size_t k = 0; k < n; k++)
    if (isfinite(item[k].q)) {
      nearest = fmax(nearest, item[k].q);
      farthest = fmin(farthest, item[k].q);
    }
  struct buckets b = {HSR_STAGE_Z, 0, nearest, 0, n < most ? n : most};
  if (nearest > farthest)
    b.per_q = (double)(b.n - 1) / (nearest - farthest);
  return b;
}

/* A distribution into buckets, whose order in Z is then mended by a list. */
static void sort_by_buckets(struct hsr_stage_stack *stack,
                            struct hsr_stage_list list,
                            enum hsr_stage_axis axis, int from, int to) {
  const size_t mark = stack->items.n;
  struct buckets b = {axis, from, 0, 0, (size_t)(to - from)};
  if (axis == HSR_STAGE_Z)
    b = buckets_in_z(hsr_stage_at(stack, list.first), list.n,
                     stack->n_room - 1);
  memset(stack->room, 0, (b.n + 1) * sizeof *stack->room);
  for (size_t k = 0; k < list.n; k++) {
    hsr_stage_push(stack, *hsr_stage_at(stack, list.first + k));
    if (stack->failed)
      return;
    const struct hsr_stage_item *item = hsr_stage_at(stack, mark + k);
    stack->room[bucket_of(&b, item) + 1]++;
    HSR_STEP(stack->tally, stack->buckets + (int)axis, HSR_FACE(item->face),
             HSR_NOTHING, HSR_NOWHERE, 0);
  }
  for (size_t k = 0; k < b.n; k++)
    stack->room[k + 1] += stack->room[k];
  for (size_t k = 0; k < list.n; k++) {
    const struct hsr_stage_item *item = hsr_stage_at(stack, mark + k);
    *hsr_stage_at(stack, list.first + stack->room[bucket_of(&b, item)]++) =
        *item;
  }
  stack->items.n = mark;
  if (axis == HSR_STAGE_Z)
    sort_by_list(stack, hsr_stage_at(stack, list.first), list.n, axis);
}

void hsr_stage_sort(struct hsr_stage_stack *stack, struct hsr_stage_list list,
                    enum hsr_stage_axis axis, enum hsr_stage_method method,
                    int from, int to) {
  struct hsr_stage_item *item = hsr_stage_at(stack, list.first);
  if (list.n < 2)
    return;
  switch (method) {
  case HSR_STAGE_BUCKET:
    sort_by_buckets(stack, list, axis, from, to);
    return;
  case HSR_STAGE_LIST:
    sort_by_list(stack, item, list.n, axis);
    return;
  case HSR_STAGE_BUBBLE:
    sort_by_bubbles(stack, item, list.n, axis);
    return;
  case HSR_STAGE_BINARY:
    sort_by_halving(stack, item, list.n, axis);
    return;
  case HSR_STAGE_SEARCH:
    return;
  }
}
