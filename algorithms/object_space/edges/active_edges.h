/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnock's active edge list, its numbers in rows side by side in memory: each
 * step that goes through the list takes many edges at once. */
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
  uint32_t e;
  double x0, y0, slope, half;
  double left, right;         /* its cover at the current Y */
  double was_left, was_right; /* at the Y before; nothing if it was not there */
  double end_y;
};

/* The list: row[k] is of entry k. */
struct hsr_active_edges {
  double *x0, *y0, *slope, *half;
  double *left, *right, *was_left, *was_right;
  double *end_y;
  uint32_t *e;
  uint32_t n;
};

/* An empty list with room for `most` edges, in the arena. HSR_E_NOMEM. */
enum hsr_status hsr_active_edges_make(struct hsr_active_edges *list,
                                      uint32_t most, struct hsr_arena *arena);

/* Reads entry k, and writes it. */
struct hsr_active hsr_active_edges_take(const struct hsr_active_edges *list,
                                        uint32_t k);
void hsr_active_edges_put(struct hsr_active_edges *list, uint32_t k,
                          const struct hsr_active *edge);

/* Finds all covers at another Y; the ones before become was_left and was_right.
 */
void hsr_active_edges_move(struct hsr_active_edges *list, double y);

/* Copies n entries, from `from` on, to where they begin at `to`. */
void hsr_active_edges_shift(struct hsr_active_edges *list, uint32_t to,
                            uint32_t from, uint32_t n);

/* Takes out those that end at y or above. */
void hsr_active_edges_retire(struct hsr_active_edges *list, double y);

/* How many of n pairs of numbers, from the first on, can be passed over, because
 * a[i] < b[i]; of the next HSR_ACTIVE_BLOCK pairs some may not be so. */
enum { HSR_ACTIVE_BLOCK = 32 };
uint32_t hsr_active_edges_pass(const double *a, const double *b, uint32_t n);

static inline void hsr_active_cover(struct hsr_active *edge, double y) {
  double x = edge->x0 + edge->slope * (y - edge->y0);
  edge->left = x - edge->half;
  edge->right = x + edge->half;
}

#ifdef __cplusplus
}
#endif
#endif
