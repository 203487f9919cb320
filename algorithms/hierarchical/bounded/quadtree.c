/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Putting polygons into the quadtree: InsertPolyIntoQuadtree, InsertPoly,
 * SubdivideQCell and PropagateZBounds of the thesis, 5.4.2.
 *
 * What differs from the printed listing, which does not work as it stands:
 * - A cell's `far` never falls. As printed, propagation from the first of four
 *   new leaves would take back what a polygon that covers all four had set.
 * - A subtree that is hidden is not deleted but becomes a leaf, since polygons
 *   that come later go through all four children.
 * - A cell of 2^-HSR_BOUNDED_TILING pixels is not divided by this pass: its list has
 *   no limit. Else a bundle of polygons along a line would be divided along all
 *   of the line, to the smallest size, whether or not anyone asks for it. */
#include "algorithms/hierarchical/bounded/bounded.h"
#include "common/answers/filter.h"
#include "common/answers/kinds/area.h"

#include <math.h>
#include <string.h>

struct hsr_subject hsr_bounded_subject(const struct hsr_bounded_cell *cell) {
  double side = ldexp(1, cell->level);
  return HSR_CELL((uint32_t)(cell->level + HSR_BOUNDED_DEEPEST),
                  floor(cell->x / side), floor(cell->y / side));
}

struct hsr_window hsr_bounded_window(const struct hsr_bounded_tree *t,
                                     const struct hsr_bounded_cell *cell) {
  const struct hsr_window *w = &t->job->view->window;
  struct hsr_square s = hsr_bounded_square(cell);
  int x0 = (int)floor(s.x - s.half), y0 = (int)floor(s.y - s.half);
  int x1 = (int)ceil(s.x + s.half), y1 = (int)ceil(s.y + s.half);
  return hsr_window_make(x0 > w->x0 ? x0 : w->x0, y0 > w->y0 ? y0 : w->y0,
                         x1 < w->x1 ? x1 : w->x1, y1 < w->y1 ? y1 : w->y1);
}

/* --- Memory --------------------------------------------------------------- */

static bool grow_blocks(struct hsr_bounded_tree *t, struct hsr_growing *blocks,
                        size_t size) {
  void *block = hsr_arena_array(t->job->scratch, HSR_BOUNDED_BLOCK, size);
  if (!block || !hsr_arena_grow(t->job->scratch, blocks, sizeof block))
    return false;
  ((void **)blocks->items)[blocks->n - 1] = block;
  return true;
}

/* The first of four cells that follow one another; 0: no memory. */
static uint32_t new_cells(struct hsr_bounded_tree *t) {
  uint32_t c = t->free_cells;
  if (c) {
    t->free_cells = hsr_bounded_cell(t, c)->child;
    return c;
  }
  if (t->n_cells % HSR_BOUNDED_BLOCK == 0 &&
      !grow_blocks(t, &t->cells, sizeof(struct hsr_bounded_cell)))
    return 0;
  t->n_cells += 4;
  return t->n_cells - 4;
}

static uint32_t new_entry(struct hsr_bounded_tree *t) {
  uint32_t e = t->free_entries;
  if (e != HSR_BOUNDED_NONE) {
    t->free_entries = hsr_bounded_entry(t, e)->next;
    return e;
  }
  if (t->n_entries % HSR_BOUNDED_BLOCK == 0 &&
      !grow_blocks(t, &t->entries, sizeof(struct hsr_bounded_entry)))
    return HSR_BOUNDED_NONE;
  return t->n_entries++;
}

static void free_list(struct hsr_bounded_tree *t,
                      struct hsr_bounded_cell *cell) {
  for (uint32_t e = cell->first, next; e != HSR_BOUNDED_NONE; e = next) {
    next = hsr_bounded_entry(t, e)->next;
    hsr_bounded_entry(t, e)->next = t->free_entries;
    t->free_entries = e;
  }
  cell->first = HSR_BOUNDED_NONE;
  cell->n = 0;
}

void hsr_bounded_free_below(struct hsr_bounded_tree *t, uint32_t c) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(t, c);
  uint32_t child = cell->child;
  free_list(t, cell);
  if (!child)
    return;
  for (uint32_t k = 0; k < 4; k++)
    hsr_bounded_free_below(t, child + k);
  hsr_bounded_cell(t, child)->child = t->free_cells;
  t->free_cells = child;
  cell->child = 0;
}

/* PropagateZBounds. */
static void propagate(struct hsr_bounded_tree *t, uint32_t c) {
  for (; c; c = hsr_bounded_cell(t, c)->parent) {
    struct hsr_bounded_cell *parent =
        hsr_bounded_cell(t, hsr_bounded_cell(t, c)->parent);
    double near = -INFINITY, far = INFINITY;
    for (uint32_t k = 0; k < 4; k++) {
      const struct hsr_bounded_cell *child =
          hsr_bounded_cell(t, parent->child + k);
      near = fmax(near, child->near);
      far = fmin(far, child->far);
    }
    far = fmax(far, parent->far);
    if (near == parent->near && far == parent->far)
      return;
    parent->near = near;
    parent->far = far;
  }
}

/* --- Leaves --------------------------------------------------------------- */

static bool append(struct hsr_bounded_tree *t, struct hsr_bounded_cell *cell,
                   uint32_t s, bool covers) {
  uint32_t e = new_entry(t);
  if (e == HSR_BOUNDED_NONE)
    return false;
  *hsr_bounded_entry(t, e) = (struct hsr_bounded_entry){s, cell->first, covers};
  cell->first = e;
  cell->n++;
  return true;
}

static void make_leaf(struct hsr_bounded_tree *t, uint32_t parent, uint32_t k) {
  const struct hsr_bounded_cell *from = hsr_bounded_cell(t, parent);
  double half = ldexp(.25, from->level);
  *hsr_bounded_cell(t, from->child + k) =
      (struct hsr_bounded_cell){.parent = parent,
                                .first = HSR_BOUNDED_NONE,
                                .level = from->level - 1,
                                .place = HSR_BOUNDED_INSIDE,
                                .untiled = from->untiled,
                                .x = from->x + (k & 1 ? half : -half),
                                .y = from->y + (k & 2 ? half : -half),
                                .near = -INFINITY,
                                .far = from->far};
}

/* The polygons of the parent's list that meet a new leaf. */
static bool inherit(struct hsr_bounded_tree *t, uint32_t parent, uint32_t c) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(t, c);
  struct hsr_square square = hsr_bounded_square(cell);
  for (uint32_t e = hsr_bounded_cell(t, parent)->first, next;
       e != HSR_BOUNDED_NONE; e = next) {
    const struct hsr_bounded_entry *entry = hsr_bounded_entry(t, e);
    next = entry->next;
    uint32_t s = entry->shape;
    enum hsr_meeting meeting =
        entry->covers ? HSR_COVERS
                      : hsr_shape_meets(hsr_bounded_shape(t, s), &square);
    HSR_STEP(t->tally, HSR_BOUNDED_PLACED, hsr_bounded_face(t, s),
             hsr_bounded_subject(cell), hsr_bounded_window(t, cell), meeting);
    if (meeting != HSR_MISSES && !append(t, cell, s, meeting == HSR_COVERS))
      return false;
  }
  for (uint32_t e = cell->first; e != HSR_BOUNDED_NONE;
       e = hsr_bounded_entry(t, e)->next)
    cell->near =
        fmax(cell->near,
             hsr_bounded_nearest(t, hsr_bounded_entry(t, e)->shape, &square));
  return true;
}

/* What is hidden goes, so the list is gone through from its beginning for each.
 */
void hsr_bounded_settle(struct hsr_bounded_tree *t, uint32_t c) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(t, c);
  struct hsr_square square = hsr_bounded_square(cell);
  for (uint32_t k = 0; k < cell->n; k++) {
    uint32_t e = cell->first;
    for (uint32_t l = 0; l < k; l++)
      e = hsr_bounded_entry(t, e)->next;
    const struct hsr_bounded_entry *entry = hsr_bounded_entry(t, e);
    hsr_bounded_cover(t, cell, &square, entry->shape, entry->covers);
  }
}

/* The work picture has the cells that are made at each pixel (the thesis, p.
 * 88). */
static void touch(const struct hsr_bounded_tree *t,
                  const struct hsr_bounded_cell *cell) {
  struct hsr_window w = hsr_bounded_window(t, cell);
  for (int j = w.y0; j < w.y1; j++)
    for (int i = w.x0; i < w.x1; i++)
      HSR_TOUCH(t->tally, i, j);
}

bool hsr_bounded_split(struct hsr_bounded_tree *t, uint32_t c) {
  uint32_t child = new_cells(t);
  if (!child)
    return false;
  struct hsr_bounded_cell *cell = hsr_bounded_cell(t, c);
  cell->child = child;
  HSR_STEP(t->tally, HSR_BOUNDED_SPLITS, hsr_bounded_subject(cell), HSR_NOTHING,
           hsr_bounded_window(t, cell), 0);
  for (uint32_t k = 0; k < 4; k++) {
    make_leaf(t, c, k);
    touch(t, hsr_bounded_cell(t, child + k));
    if (!inherit(t, c, child + k))
      return false;
    hsr_bounded_settle(t, child + k);
  }
  free_list(t, cell);
  propagate(t, child);
  return true;
}

/* --- Inserting ------------------------------------------------------------ */

static bool insert(struct hsr_bounded_tree *t, uint32_t s, uint32_t c,
                   bool covers);

/* Cells behind what covers their parent. */
static void prune(struct hsr_bounded_tree *t, struct hsr_bounded_cell *cell) {
  for (uint32_t k = 0; cell->child && k < 4; k++) {
    struct hsr_bounded_cell *child = hsr_bounded_cell(t, cell->child + k);
    if (child->near < cell->far && (child->child || child->n)) {
      HSR_STEP(t->tally, HSR_BOUNDED_PRUNED, hsr_bounded_subject(child),
               HSR_NOTHING, hsr_bounded_window(t, child), 0);
      hsr_bounded_free_below(t, cell->child + k);
      child->near = -INFINITY;
      child->far = fmax(child->far, cell->far);
    }
  }
}

/* InsertPoly. */
static bool store(struct hsr_bounded_tree *t, uint32_t s, uint32_t c,
                  bool covers, double nearest) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(t, c);
  if (!cell->child) {
    bool fits =
        cell->n < HSR_BOUNDED_CAPACITY || cell->level <= -HSR_BOUNDED_TILING;
    if (fits) {
      HSR_STEP(t->tally, HSR_BOUNDED_STORED, hsr_bounded_face(t, s),
               hsr_bounded_subject(cell), hsr_bounded_window(t, cell), 0);
      struct hsr_square square = hsr_bounded_square(cell);
      if (!append(t, cell, s, covers))
        return false;
      cell->near = fmax(cell->near, nearest);
      hsr_bounded_cover(t, cell, &square, s, covers);
      propagate(t, c);
      return true;
    }
    if (!hsr_bounded_split(t, c))
      return false;
  }
  for (uint32_t k = 0; k < 4; k++)
    if (!insert(t, s, cell->child + k, covers))
      return false;
  return true;
}

/* InsertPolyIntoQuadtree. In strict order a polygon that covers a cell hides
 * nothing of what is below: it is put into all children that are not covered. */
static bool insert(struct hsr_bounded_tree *t, uint32_t s, uint32_t c,
                   bool covers) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(t, c);
  struct hsr_square square = hsr_bounded_square(cell);
  if (cell->place == HSR_BOUNDED_OUTSIDE)
    return true;
  if (cell->place == HSR_BOUNDED_STRADDLES)
    return store(t, s, c, false, -INFINITY);
  enum hsr_meeting meeting =
      covers ? HSR_COVERS : hsr_shape_meets(hsr_bounded_shape(t, s), &square);
  HSR_STEP(t->tally, HSR_BOUNDED_PLACED, hsr_bounded_face(t, s),
           hsr_bounded_subject(cell), hsr_bounded_window(t, cell), meeting);
  if (meeting == HSR_MISSES) {
    HSR_STEP(t->tally, HSR_BOUNDED_MISSED, hsr_bounded_face(t, s),
             hsr_bounded_subject(cell), hsr_bounded_window(t, cell), 0);
    return true;
  }
  double nearest = hsr_bounded_nearest(t, s, &square);
  if (nearest < cell->far) {
    HSR_STEP(t->tally, HSR_BOUNDED_FARTHER, hsr_bounded_face(t, s),
             hsr_bounded_subject(cell), hsr_bounded_window(t, cell), 0);
    return true;
  }
  covers = meeting == HSR_COVERS;
  if (covers && cell->child && !hsr_bounded_in_order(t, s)) {
    double far = hsr_bounded_farthest(t, s, &square);
    if (far > cell->far) {
      cell->far = far;
      propagate(t, c);
      prune(t, cell);
    }
  }
  return store(t, s, c, covers, nearest);
}

/* The smallest cell that encloses a shape. */
static uint32_t enclosing(const struct hsr_bounded_tree *t,
                          const struct hsr_shape *shape) {
  uint32_t c = 0;
  for (;;) {
    const struct hsr_bounded_cell *cell = hsr_bounded_cell(t, c);
    bool left = shape->x1<cell->x, right = shape->x0> cell->x;
    bool above = shape->y1<cell->y, below = shape->y0> cell->y;
    if (!cell->child || !(left || right) || !(above || below))
      return c;
    c = cell->child + (uint32_t)(right + 2 * below);
  }
}

bool hsr_bounded_add(struct hsr_bounded_tree *t,
                     const struct hsr_screen *screen, uint32_t f, uint32_t id) {
  return hsr_bounded_add_piece(t, screen, f, id, NULL, NULL, 0);
}

bool hsr_bounded_add_piece(struct hsr_bounded_tree *t,
                           const struct hsr_screen *screen, uint32_t f,
                           uint32_t id, const struct hsr_shape_cut *own,
                           const struct hsr_shape_cut *cut, uint32_t n_cuts) {
  struct hsr_arena *arena = t->job->scratch;
  if (!hsr_arena_grow(arena, &t->shapes, sizeof(struct hsr_shape)))
    return false;
  uint32_t s = (uint32_t)t->shapes.n - 1;
  struct hsr_shape *shape = (struct hsr_shape *)t->shapes.items + s;
  if (!hsr_shape_make(shape, screen, f, id, arena, t->tally) ||
      (n_cuts && !hsr_shape_divide(shape, screen, own, cut, n_cuts, arena)))
    return false;
  uint16_t rgb[3];
  hsr_filter_colour(t->job->world, t->job->view, id, rgb);
  for (int c = 0; c < 3; c++)
    shape->rgb[c] = rgb[c] / 65535.0;
  if (t->shades.parts) {
    bool is_flat = !(screen->world->mesh.deviation[f] > 0);
    if (!hsr_arena_grow(arena, &t->surfaces, sizeof(struct hsr_surface)) ||
        !hsr_surface_make((struct hsr_surface *)t->surfaces.items + s,
                          &t->shades, shape, is_flat))
      return false;
  }
  return insert(t, s, enclosing(t, shape), false);
}

/* --- Beginning ------------------------------------------------------------ */

static enum hsr_bounded_place place_of(const struct hsr_square *square,
                                       const struct hsr_window *w) {
  double x0 = square->x - square->half, x1 = square->x + square->half;
  double y0 = square->y - square->half, y1 = square->y + square->half;
  if (x1 <= w->x0 || x0 >= w->x1 || y1 <= w->y0 || y0 >= w->y1)
    return HSR_BOUNDED_OUTSIDE;
  return x0 >= w->x0 && x1 <= w->x1 && y0 >= w->y0 && y1 <= w->y1
             ? HSR_BOUNDED_INSIDE
             : HSR_BOUNDED_STRADDLES;
}

/* Divides what straddles the border of the window. */
static bool begin_cell(struct hsr_bounded_tree *t, uint32_t c) {
  struct hsr_bounded_cell *cell = hsr_bounded_cell(t, c);
  struct hsr_square square = hsr_bounded_square(cell);
  cell->place = place_of(&square, &t->job->view->window);
  if (cell->place == HSR_BOUNDED_OUTSIDE)
    cell->far = INFINITY;
  if (cell->place != HSR_BOUNDED_STRADDLES)
    return true;
  cell->child = new_cells(t);
  if (!cell->child)
    return false;
  for (uint32_t k = 0; k < 4; k++) {
    make_leaf(t, c, k);
    if (!begin_cell(t, cell->child + k))
      return false;
  }
  return true;
}

enum hsr_status hsr_bounded_begin(struct hsr_bounded_tree *t,
                                  const struct hsr_job *job,
                                  const struct hsr_area_form *form,
                                  double until, struct hsr_pair *pair) {
  const struct hsr_window *w = &job->view->window;
  int side = w->x1 - w->x0 > w->y1 - w->y0 ? w->x1 - w->x0 : w->y1 - w->y0;
  int level = 0;
  while (1 << level < side)
    level++;
  uint16_t rgb[3];
  *t = (struct hsr_bounded_tree){.job = job,
                                 .tally = job->tally,
                                 .pair = pair,
                                 .in_order = HSR_BOUNDED_NONE,
                                 .until = until,
                                 .free_entries = HSR_BOUNDED_NONE};
  hsr_filter_colour(job->world, job->view, HSR_BACKGROUND, rgb);
  for (int c = 0; c < 3; c++)
    t->background[c] = rgb[c] / 65535.0;
  if (hsr_shades_init(&t->shades, form->shader, form->side, job->world,
                      job->view, job->scratch))
    return HSR_E_NOMEM;
  t->planes =
      HSR_NEW(job->scratch, struct hsr_bounded_planes, HSR_BOUNDED_PLANES);
  if (!t->planes || !grow_blocks(t, &t->cells, sizeof(struct hsr_bounded_cell)))
    return HSR_E_NOMEM;
  memset(t->planes, 0xff, HSR_BOUNDED_PLANES * sizeof *t->planes);
  t->n_cells = 4; /* the root, and three that are never used */
  *hsr_bounded_cell(t, 0) =
      (struct hsr_bounded_cell){.first = HSR_BOUNDED_NONE,
                                .level = level,
                                .x = w->x0 + ldexp(.5, level),
                                .y = w->y0 + ldexp(.5, level),
                                .near = -INFINITY,
                                .far = -INFINITY};
  return begin_cell(t, 0) ? HSR_OK : HSR_E_NOMEM;
}
