/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/object_space/edges/active_edges.h"
#include "common/base/vector.h"

#include <string.h>

enum hsr_status hsr_active_edges_make(struct hsr_active_edges *list,
                                      uint32_t most, struct hsr_arena *arena) {
  double **const row[] = {&list->x0,       &list->y0,        &list->slope,
                          &list->half,     &list->left,      &list->right,
                          &list->was_left, &list->was_right, &list->end_y};
  list->n = 0;
  for (size_t r = 0; r < sizeof row / sizeof *row; r++)
    if (!(*row[r] = HSR_NEW(arena, double, most)))
      return HSR_E_NOMEM;
  list->e = HSR_NEW(arena, uint32_t, most);
  return list->e ? HSR_OK : HSR_E_NOMEM;
}

struct hsr_active hsr_active_edges_take(const struct hsr_active_edges *list,
                                        uint32_t k) {
  return (struct hsr_active){
      list->e[k],         list->x0[k],   list->y0[k],    list->slope[k],
      list->half[k],      list->left[k], list->right[k], list->was_left[k],
      list->was_right[k], list->end_y[k]};
}

void hsr_active_edges_put(struct hsr_active_edges *list, uint32_t k,
                          const struct hsr_active *edge) {
  list->e[k] = edge->e;
  list->x0[k] = edge->x0;
  list->y0[k] = edge->y0;
  list->slope[k] = edge->slope;
  list->half[k] = edge->half;
  list->left[k] = edge->left;
  list->right[k] = edge->right;
  list->was_left[k] = edge->was_left;
  list->was_right[k] = edge->was_right;
  list->end_y[k] = edge->end_y;
}

/* --- Through the whole list ----------------------------------------------- */

/* As hsr_active_cover. */
HSR_VECTOR static void cover_all(const struct hsr_active_edges *list, double y,
                                 double *restrict left,
                                 double *restrict right) {
  const double *x0 = list->x0, *y0 = list->y0;
  const double *slope = list->slope, *half = list->half;
  for (size_t k = 0, n = list->n; k < n; k++) {
    double x = x0[k] + slope[k] * (y - y0[k]);
    left[k] = x - half[k];
    right[k] = x + half[k];
  }
}

void hsr_active_edges_move(struct hsr_active_edges *list, double y) {
  double *left = list->was_left, *right = list->was_right;
  cover_all(list, y, left, right);
  list->was_left = list->left;
  list->was_right = list->right;
  list->left = left;
  list->right = right;
}

HSR_VECTOR static uint32_t pass(const double *a, const double *b, uint32_t n) {
  uint32_t k = 0;
  for (; n - k >= HSR_ACTIVE_BLOCK; k += HSR_ACTIVE_BLOCK) {
    uint64_t stays = 0;
    for (size_t i = k; i < (size_t)k + HSR_ACTIVE_BLOCK; i++)
      stays |= a[i] < b[i] ? 0 : 1;
    if (stays)
      break;
  }
  return k;
}

uint32_t hsr_active_edges_pass(const double *a, const double *b, uint32_t n) {
  return pass(a, b, n);
}

/* How many of n numbers, from the first on, are greater than y for certain. */
HSR_VECTOR static uint32_t pass_greater(const double *a, double y, uint32_t n) {
  uint32_t k = 0;
  for (; n - k >= HSR_ACTIVE_BLOCK; k += HSR_ACTIVE_BLOCK) {
    uint64_t stays = 0;
    for (size_t i = k; i < (size_t)k + HSR_ACTIVE_BLOCK; i++)
      stays |= a[i] > y ? 0 : 1;
    if (stays)
      break;
  }
  return k;
}

/* The first from k on that ends at y or above; n if none does. */
static uint32_t next_to_end(const struct hsr_active_edges *list, uint32_t k,
                            double y) {
  k += pass_greater(list->end_y + k, y, list->n - k);
  while (k < list->n && list->end_y[k] > y)
    k++;
  return k;
}

void hsr_active_edges_shift(struct hsr_active_edges *list, uint32_t to,
                            uint32_t from, uint32_t n) {
  double *const row[] = {list->x0,       list->y0,        list->slope,
                         list->half,     list->left,      list->right,
                         list->was_left, list->was_right, list->end_y};
  for (size_t r = 0; r < sizeof row / sizeof *row; r++)
    memmove(row[r] + to, row[r] + from, n * sizeof *row[r]);
  memmove(list->e + to, list->e + from, n * sizeof *list->e);
}

void hsr_active_edges_retire(struct hsr_active_edges *list, double y) {
  uint32_t k = next_to_end(list, 0, y), to = k;
  while (k < list->n) {
    uint32_t first = k + 1;
    k = next_to_end(list, first, y);
    hsr_active_edges_shift(list, to, first, k - first);
    to += k - first;
  }
  list->n = to;
}
