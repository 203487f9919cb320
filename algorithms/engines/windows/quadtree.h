/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A quadtree of three states over the samples of a window: which regions are
 * vacant, which are covered, and which are neither.
 *
 * Source      D. Meagher, "The Octree Encoding Method for Efficient Solid
 *             Modeling", PhD thesis, Rensselaer Polytechnic Institute, 1982; N.
 *             Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.6, 4.3.1 and 4.5.1.
 * Notation    covered, occupied -> HSR_QUAD_COVERED; active -> HSR_QUAD_ACTIVE.
 *             Cell (x, y) of a level has 2^level samples a side; level 0 has
 *             one sample. The root is cell (0, 0) of level n_levels - 1.
 * Invariant   A cell is covered if and only if each of its samples is covered
 *             or outside the window. Whoever changes a cell then updates its
 *             parents by hsr_quad_gather. A cell may be made covered or vacant
 *             alone; then the cells below it are out of date. */
#ifndef HSR_ALGORITHMS_QUADTREE_H
#define HSR_ALGORITHMS_QUADTREE_H

#include "common/base/arena.h"
#include "common/base/status.h"
#include "common/base/window.h"
#include "common/exact/screen.h"

enum { HSR_QUAD_LEVELS = 16 };

enum hsr_quad_state { HSR_QUAD_VACANT, HSR_QUAD_ACTIVE, HSR_QUAD_COVERED };

struct hsr_quadtree {
  struct hsr_window window;
  int n_levels;
  unsigned char *state[HSR_QUAD_LEVELS]; /* rows of 2^(n_levels - 1 - level) */
};

/* The index of a cell in state[level]. */
static inline size_t hsr_quad_place(const struct hsr_quadtree *q, int level,
                                    int x, int y) {
  return ((size_t)y << (q->n_levels - 1 - level)) + (size_t)x;
}

static inline unsigned char *hsr_quad_state(const struct hsr_quadtree *q,
                                            int level, int x, int y) {
  return &q->state[level][hsr_quad_place(q, level, x, y)];
}

/* The state that a cell, above level 0, has by those of its four quadrants. */
static inline enum hsr_quad_state hsr_quad_gather(const struct hsr_quadtree *q,
                                                  int level, int x, int y) {
  int n_covered = 0, n_vacant = 0;
  for (int k = 0; k < 4; k++) {
    int state = *hsr_quad_state(q, level - 1, 2 * x + k % 2, 2 * y + k / 2);
    n_covered += state == HSR_QUAD_COVERED;
    n_vacant += state == HSR_QUAD_VACANT;
  }
  return n_covered == 4  ? HSR_QUAD_COVERED
         : n_vacant == 4 ? HSR_QUAD_VACANT
                         : HSR_QUAD_ACTIVE;
}

/* The samples of a cell that are in the window. */
static inline struct hsr_bounds hsr_quad_samples(const struct hsr_quadtree *q,
                                                 int level, int x, int y) {
  const struct hsr_window *w = &q->window;
  int size = 1 << level;
  struct hsr_bounds b = {w->x0 + x * size, w->y0 + y * size, 0, 0};
  b.x1 = b.x0 + size < w->x1 ? b.x0 + size : w->x1;
  b.y1 = b.y0 + size < w->y1 ? b.y0 + size : w->y1;
  return b;
}

/* Makes a quadtree whose root holds the window. All samples of the window are
 * vacant; samples outside of it are covered. The arrays are the arena's.
 * HSR_E_NOMEM. */
enum hsr_status hsr_quadtree_init(struct hsr_quadtree *q,
                                  const struct hsr_window *window,
                                  struct hsr_arena *arena);

#endif
