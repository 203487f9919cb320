/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/windows/quadtree.h"

enum hsr_status hsr_quadtree_init(struct hsr_quadtree *q,
                                  const struct hsr_window *window,
                                  struct hsr_arena *arena) {
  int columns = window->x1 - window->x0, rows = window->y1 - window->y0;
  int size = 1;
  q->window = *window;
  for (q->n_levels = 1; size < columns || size < rows; q->n_levels++)
    size *= 2;
  for (int level = 0; level < q->n_levels; level++) {
    size_t row = (size_t)(size >> level);
    q->state[level] = HSR_NEW(arena, unsigned char, row *row);
    if (!q->state[level])
      return HSR_E_NOMEM;
    for (int y = 0; y < size >> level; y++)
      for (int x = 0; x < size >> level; x++)
        *hsr_quad_state(q, level, x, y) =
            (unsigned char)(level ? hsr_quad_gather(q, level, x, y)
                            : x < columns && y < rows ? HSR_QUAD_VACANT
                                                      : HSR_QUAD_COVERED);
  }
  return HSR_OK;
}
