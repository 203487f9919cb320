/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/hierarchical/bounded/queue.h"

static bool push_heap(struct hsr_bounded_queue *q,
                      struct hsr_bounded_item item) {
  if (!hsr_arena_grow(q->arena, &q->heap, sizeof item))
    return false;
  struct hsr_bounded_item *heap = q->heap.items;
  size_t k = q->heap.n - 1;
  for (; k > 0 && heap[(k - 1) / 2].uncertainty < item.uncertainty;
       k = (k - 1) / 2)
    heap[k] = heap[(k - 1) / 2];
  heap[k] = item;
  return true;
}

static struct hsr_bounded_item pop_heap(struct hsr_bounded_queue *q) {
  struct hsr_bounded_item *heap = q->heap.items, top = heap[0];
  struct hsr_bounded_item last = heap[--q->heap.n];
  size_t k = 0, n = q->heap.n;
  for (size_t child; (child = 2 * k + 1) < n; k = child) {
    if (child + 1 < n && heap[child + 1].uncertainty > heap[child].uncertainty)
      child++;
    if (!(heap[child].uncertainty > last.uncertainty))
      break;
    heap[k] = heap[child];
  }
  if (n > 0)
    heap[k] = last;
  return top;
}

bool hsr_bounded_push(struct hsr_bounded_queue *q,
                      struct hsr_bounded_item item) {
  if (q->order == HSR_BOUNDED_QUEUE)
    return push_heap(q, item);
  struct hsr_growing *leaves = &q->depth[item.depth];
  if (!hsr_arena_grow(q->arena, leaves, sizeof item))
    return false;
  ((struct hsr_bounded_item *)leaves->items)[leaves->n - 1] = item;
  return true;
}

/* While leaves of one size are taken, their children are pushed. These are of the
 * next size. */
bool hsr_bounded_pop(struct hsr_bounded_queue *q,
                     struct hsr_bounded_item *item) {
  if (q->order == HSR_BOUNDED_QUEUE) {
    if (!q->heap.n)
      return false;
    *item = pop_heap(q);
    return true;
  }
  while (q->at <= HSR_BOUNDED_DEEPEST && q->next == q->depth[q->at].n) {
    q->at++;
    q->next = 0;
  }
  if (q->at > HSR_BOUNDED_DEEPEST)
    return false;
  *item = ((struct hsr_bounded_item *)q->depth[q->at].items)[q->next++];
  return true;
}
