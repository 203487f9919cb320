/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnock's active edge list, as one array for each number of an edge: the
 * steps that go through the list take many edges at once.
 *
 * Notation    An edge's cover is the range of X that its image may cover at a
 *             Y: [left, right]. See warnock_edges.c for the source. */
#ifndef HSR_ALGORITHMS_ACTIVE_EDGES_H
#define HSR_ALGORITHMS_ACTIVE_EDGES_H

#include "algorithms/algorithm.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An edge in the list. */
struct hsr_active {
  uint32_t e; /* its number */
  /* At y the cover is x0 + slope (y - y0), and `half` to either side. */
  double x0, y0, slope, half;
  double left, right; /* its cover at the current Y */
  /* Its cover at the Y before, if it was in the list. */
  double was_left, was_right;
  double end_y; /* where it ends */
};

/* The list: number k of each array belongs to entry k. */
struct hsr_active_edges {
  double *x0, *y0, *slope, *half;
  double *left, *right, *was_left, *was_right;
  double *end_y;
  uint32_t *e;
  uint32_t n;
};

/* Makes an empty list with room for `most` edges. The arrays are the arena's.
 * HSR_E_NOMEM. */
enum hsr_status hsr_active_edges_make(struct hsr_active_edges *list,
                                      uint32_t most, struct hsr_arena *arena);

/* hsr_active_edges_take: entry k. hsr_active_edges_put: overwrites entry k. */
struct hsr_active hsr_active_edges_take(const struct hsr_active_edges *list,
                                        uint32_t k);
void hsr_active_edges_put(struct hsr_active_edges *list, uint32_t k,
                          const struct hsr_active *edge);

/* Moves the list to another Y: finds all covers there. Those at the Y before
 * become was_left and was_right. */
void hsr_active_edges_move(struct hsr_active_edges *list, double y);

/* Moves n entries, from number `from` on, to the places from `to` on. */
void hsr_active_edges_shift(struct hsr_active_edges *list, uint32_t to,
                            uint32_t from, uint32_t n);

/* Removes the edges that end at y or above. */
void hsr_active_edges_retire(struct hsr_active_edges *list, double y);

/* Of n pairs of numbers, how many from the first on certainly have a[i] < b[i].
 * Pairs are compared in blocks of HSR_ACTIVE_BLOCK. So more of them, but less
 * than a block, may have it, too. */
enum { HSR_ACTIVE_BLOCK = 32 };
uint32_t hsr_active_edges_pass(const double *a, const double *b, uint32_t n);

/* Finds the cover of an edge at y. */
static inline void hsr_active_cover(struct hsr_active *edge, double y) {
  double x = edge->x0 + edge->slope * (y - edge->y0);
  edge->left = x - edge->half;
  edge->right = x + edge->half;
}

#ifdef __cplusplus
}
#endif
#endif
