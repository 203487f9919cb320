/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/pyramid/maps.h"

enum { BITS = HSR_MAPS_BITS };

static int side_of(const struct hsr_maps *m, int level) {
  return 1 << (m->n_levels - 1 - level);
}

static uint32_t *entry(const struct hsr_maps *m, int level, int x, int y) {
  return &m->covered[level]
                    [((size_t)y << (m->n_levels - 1 - level)) + (size_t)x];
}

enum hsr_status hsr_maps_init(struct hsr_maps *m,
                              const struct hsr_window *window,
                              struct hsr_arena *arena) {
  int width = window->x1 - window->x0, height = window->y1 - window->y0;
  int side = width > height ? width : height;
  *m = (struct hsr_maps){.window = *window, .n_levels = 1};
  while (side_of(m, 0) < side)
    m->n_levels++;
  for (int level = 0; level < m->n_levels; level++) {
    size_t n = (size_t)side_of(m, level);
    m->covered[level] = HSR_NEW(arena, uint32_t, n * n);
    if (!m->covered[level])
      return HSR_E_NOMEM;
  }
  m->columns = ((width - 1) >> BITS) + 1;
  size_t n = (size_t)m->columns * (size_t)(((height - 1) >> BITS) + 1);
  m->farthest = HSR_NEW(arena, float, n);
  for (size_t k = 0; m->farthest && k < n; k++)
    m->farthest[k] = HUGE_VALF;
  return m->farthest ? HSR_OK : HSR_E_NOMEM;
}

/* --- Occluders ------------------------------------------------------------ */

static float *estimate(const struct hsr_maps *m, int x, int y) {
  return &m->farthest[(size_t)y * (size_t)m->columns + (size_t)x];
}

void hsr_maps_note(struct hsr_maps *m, struct hsr_bounds box, float farthest) {
  if (box.x0 >= box.x1 || box.y0 >= box.y1)
    return;
  struct hsr_entries e = hsr_entries_of(&m->window, box, BITS);
  for (int y = e.y0; y <= e.y1; y++)
    for (int x = e.x0; x <= e.x1; x++) {
      float *q = estimate(m, x, y);
      *q = farthest < *q ? farthest : *q;
    }
}

/* Level 0: what the occluders cover. */
static void make_first(struct hsr_maps *m, const struct hsr_tiler *t) {
  const struct hsr_window *w = &m->window;
  int side = side_of(m, 0), width = w->x1 - w->x0, height = w->y1 - w->y0;
  for (int y = 0; y < side; y++) {
    const uint32_t *ids = t->ids + (size_t)y * t->ids_stride;
    for (int x = 0; x < side; x++)
      *entry(m, 0, x, y) =
          x >= width || y >= height || ids[x] != HSR_BACKGROUND;
  }
}

void hsr_maps_make(struct hsr_maps *m, const struct hsr_tiler *t) {
  make_first(m, t);
  for (int level = 1; level < m->n_levels; level++)
    for (int y = 0; y < side_of(m, level); y++)
      for (int x = 0; x < side_of(m, level); x++)
        *entry(m, level, x, y) = *entry(m, level - 1, 2 * x, 2 * y) +
                                 *entry(m, level - 1, 2 * x + 1, 2 * y) +
                                 *entry(m, level - 1, 2 * x, 2 * y + 1) +
                                 *entry(m, level - 1, 2 * x + 1, 2 * y + 1);
  m->made = true;
}

/* --- The test ------------------------------------------------------------- */

static inline void count_read(const struct hsr_maps *m, int level, int x, int y,
                              bool hides) {
  if (HSR_COUNTING)
    hsr_entry_step(m->count->tally, m->count->reads, &m->window, level, x, y,
                   m->count->whom, hides);
}

/* The opacity test: do the occluders cover what entry (x, y) and the rectangle
 * have in common? The entry decides if it is opaque, or empty, or wholly in the
 * rectangle. Else the entries below it are asked, those that meet the
 * rectangle. */
static bool is_covered(struct hsr_maps *m, const struct hsr_entries *r,
                       int level, int x, int y) {
  uint32_t covered = *entry(m, level, x, y), all = 1u << 2 * level;
  bool within = x << level >= r->x0 && ((x + 1) << level) - 1 <= r->x1 &&
                y << level >= r->y0 && ((y + 1) << level) - 1 <= r->y1;
  count_read(m, level, x, y, covered == all);
  if (covered == all || !covered || within)
    return covered == all;
  level--;
  for (int k = 0; k < 4; k++) {
    int cx = 2 * x + k % 2, cy = 2 * y + k / 2;
    if (cx >= r->x0 >> level && cx <= r->x1 >> level && cy >= r->y0 >> level &&
        cy <= r->y1 >> level && !is_covered(m, r, level, cx, cy))
      return false;
  }
  return true;
}

/* It begins at the level where the rectangle meets at most two by two entries. */
static bool is_opaque(struct hsr_maps *m, const struct hsr_entries *r) {
  int level = 0;
  while (r->x1 >> level > (r->x0 >> level) + 1 ||
         r->y1 >> level > (r->y0 >> level) + 1)
    level++;
  for (int y = r->y0 >> level; y <= r->y1 >> level; y++)
    for (int x = r->x0 >> level; x <= r->x1 >> level; x++)
      if (!is_covered(m, r, level, x, y))
        return false;
  return true;
}

/* The depth test. */
static bool is_behind(struct hsr_maps *m, const struct hsr_entries *r,
                      float q) {
  for (int y = r->y0 >> BITS; y <= r->y1 >> BITS; y++)
    for (int x = r->x0 >> BITS; x <= r->x1 >> BITS; x++) {
      bool behind = q * HSR_CLEAR < *estimate(m, x, y);
      count_read(m, BITS, x, y, behind);
      if (!behind)
        return false;
    }
  return true;
}

bool hsr_maps_hides(struct hsr_maps *m, struct hsr_bounds box, float q) {
  struct hsr_entries r = hsr_entries_of(&m->window, box, 0);
  return m->made && is_opaque(m, &r) && is_behind(m, &r, q);
}
