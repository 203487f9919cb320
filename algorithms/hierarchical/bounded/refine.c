/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The refinement pass: bounds on the integral over each cell, and subdivision of
 * what is most uncertain. The thesis, 5.4.3 and 5.5.
 *
 * Interval    a cell of at most a pixel holds bounds of its own part of the pixel's
 *             integral; the bounds of a cell that has children are the sums of
 *             theirs. A cell of more than a pixel holds bounds for each of its
 *             pixels.
 * Closed form a leaf whose list is short is integrated: the share of the cell
 *             where polygon p is visible is that of p, less what lies in another
 *             polygon and behind its plane, plus what lies in two such, and so
 *             on: inclusion and exclusion. Each of these is a convex polygon. No
 *             order of the polygons is needed, and they may penetrate. What is
 *             left is the background. The thesis has the cases of one polygon,
 *             and of two that cover the cell; exact=2 comes closest to it.
 * Slivers     a polygon of less than 2^-30 of the cell is left out, and that
 *             share added to the uncertainty; likewise what a polygon leaves of a
 *             cell that it covers but for such a share. Without this, an edge
 *             that runs along the border of cells would be subdivided without end.
 * Rounding    a colour is within u = 2^-53 of itself, a product or a sum of
 *             numbers that are not negative as well. Every bound is moved outward
 *             by 2^-50 of itself where it is made, and by 2^-51 in every sum of
 *             four: down() and up(). */
#include "algorithms/hierarchical/bounded/bounded.h"

#include <math.h>
#include <time.h>

#define SLIVER 0x1p-30

struct refining {
  struct hsr_eb_tree *tree;
  const struct hsr_eb_limits *limits;
  struct hsr_area_bounds *answer;
  struct hsr_growing level[HSR_EB_DEEPEST + 1]; /* leaves, by level */
  struct hsr_growing heap;                      /* leaves, by uncertainty */
  uint64_t unfinished;                          /* pixels */
  double begun;
  int passes; /* so far */
};

/* A leaf in a queue. If the pixel is done, the leaf is no more. */
struct uncertain {
  double by;
  uint32_t cell, pixel;
};

static double down(double x, double by) {
  return x - by * fabs(x);
}
static double up(double x, double by) {
  return x + by * fabs(x);
}

/* --- Bounds of a leaf ----------------------------------------------------- */

enum { MOST = HSR_EB_CAPACITY + 2 };

/* The polygons of a leaf that matter. */
struct few {
  uint32_t shape[MOST], n;
  bool covers[MOST];
  double slack; /* the share of the cell that is not accounted for */
};

/* False if there are too many. */
static bool find_few(const struct hsr_eb_tree *t,
                     const struct hsr_eb_cell *cell,
                     const struct hsr_square *square, struct few *few) {
  few->n = 0;
  few->slack = 0;
  for (uint32_t e = cell->first; e != HSR_EB_NONE;
       e = hsr_eb_entry(t, e)->next) {
    const struct hsr_eb_entry *entry = hsr_eb_entry(t, e);
    bool covers = entry->covers;
    double lo = 1, hi = 1;
    if (!covers && cell->n > 1)
      hsr_shape_share(hsr_eb_shape(t, entry->shape), square, &lo, &hi);
    if (hi < SLIVER) {
      few->slack += hi;
      continue;
    }
    if (!covers && cell->n > 1 && lo > 1 - SLIVER) {
      covers = true;
      few->slack += 1 - lo;
    }
    if (few->n == MOST)
      return false;
    few->shape[few->n] = entry->shape;
    few->covers[few->n++] = covers;
  }
  return true;
}

/* What is left of a square after some polygons: by inclusion and exclusion. */
struct shares {
  const struct hsr_eb_tree *t;
  const struct few *few;
  const struct hsr_square *square;
  uint32_t p; /* whose share is looked for: few->shape[p] */
  double lo, hi;
};

/* Clips by all lines of a polygon, unless it covers the square. */
static void clip_by_polygon(struct hsr_clip *clip, const struct few *few,
                            const struct hsr_shape *shape, uint32_t k,
                            const struct hsr_square *square) {
  for (uint32_t l = 0; !few->covers[k] && l < shape->n_lines; l++)
    hsr_clip_by(clip, &shape->line[l], square);
}

/* Clips by where polygon r is in front of p, if both are there. False: it is
 * so nowhere. */
static bool clip_by_front(struct hsr_clip *clip, const struct hsr_eb_tree *t,
                          uint32_t r, uint32_t p,
                          const struct hsr_square *square) {
  if (hsr_bounded_before(t, p, r, square))
    return false;
  if (hsr_bounded_before(t, r, p, square))
    return true;
  const struct hsr_screen_line *a = &hsr_eb_shape(t, r)->q,
                               *b = &hsr_eb_shape(t, p)->q;
  struct hsr_screen_line by = {a->a - b->a, a->b - b->b, a->c - b->c,
                               a->error + b->error};
  hsr_clip_by(clip, &by, square);
  return true;
}

/* `clip` is what of polygon p lies in an even or odd number of polygons before
 * it, with the sign +1 or -1. Adds its share, and those of its parts that lie in
 * one more of the polygons, from number `from` on. What is behind a sliver is
 * of no more than that. */
static void add_parts(struct shares *s, const struct hsr_clip *clip,
                      uint32_t from, int sign) {
  double lo, hi;
  hsr_clip_share(clip, &lo, &hi);
  if (hi < SLIVER) {
    double most = ldexp(hi, (int)(s->few->n - from));
    s->lo -= most;
    s->hi += most;
    return;
  }
  s->lo += sign > 0 ? lo : -hi;
  s->hi += sign > 0 ? hi : -lo;
  for (uint32_t k = from; k < s->few->n; k++) {
    if (k == s->p)
      continue;
    struct hsr_clip part = *clip;
    if (clip_by_front(&part, s->t, s->few->shape[k], s->few->shape[s->p],
                      s->square)) {
      clip_by_polygon(&part, s->few, hsr_eb_shape(s->t, s->few->shape[k]), k,
                      s->square);
      add_parts(s, &part, k + 1, -sign);
    }
  }
}

/* Is a polygon behind one that covers the square? */
static bool is_hidden(const struct hsr_eb_tree *t, const struct few *few,
                      uint32_t k, const struct hsr_square *square) {
  for (uint32_t l = 0; l < few->n; l++)
    if (l != k && few->covers[l] &&
        hsr_bounded_before(t, few->shape[l], few->shape[k], square))
      return true;
  return false;
}

/* The integral over a leaf of few polygons, in closed form: its share is known of
 * each of them. False if there are too many. */
static bool integrate(const struct refining *r, const struct few *few,
                      const struct hsr_square *square, double low[3],
                      double high[3]) {
  const struct hsr_eb_tree *t = r->tree;
  const double *behind = t->background;
  for (uint32_t k = 0; k < few->n; k++)
    if (!hsr_eb_shape(t, few->shape[k])->is_convex && few->n > 1)
      return false;
  if (few->n > r->limits->exact)
    return false;
  for (int c = 0; c < 3; c++)
    low[c] = high[c] = behind[c];
  for (uint32_t k = 0; k < few->n; k++) {
    const struct hsr_shape *shape = hsr_eb_shape(t, few->shape[k]);
    if (is_hidden(t, few, k, square))
      continue;
    struct shares s = {t, few, square, k, 0, 0};
    struct hsr_clip clip;
    hsr_clip_whole(&clip);
    if (!shape->is_convex && !few->covers[k])
      clip.off = 1;
    else
      clip_by_polygon(&clip, few, shape, k, square);
    add_parts(&s, &clip, 0, 1);
    s.lo = fmax(0, s.lo);
    s.hi = fmin(1, s.hi);
    for (int c = 0; c < 3; c++) {
      double by = shape->rgb[c] - behind[c];
      low[c] += by > 0 ? by * s.lo : by * s.hi;
      high[c] += by > 0 ? by * s.hi : by * s.lo;
    }
  }
  return true;
}

/* All that may be seen in the cell. */
static void hull(const struct hsr_eb_tree *t, const struct hsr_eb_cell *cell,
                 double low[3], double high[3]) {
  bool covered = cell->far > -INFINITY;
  for (int c = 0; c < 3; c++) {
    low[c] = covered ? INFINITY : t->background[c];
    high[c] = covered ? -INFINITY : t->background[c];
  }
  for (uint32_t e = cell->first; e != HSR_EB_NONE;
       e = hsr_eb_entry(t, e)->next) {
    const struct hsr_shape *s = hsr_eb_shape(t, hsr_eb_entry(t, e)->shape);
    for (int c = 0; c < 3; c++) {
      low[c] = fmin(low[c], s->rgb[c]);
      high[c] = fmax(high[c], s->rgb[c]);
    }
  }
}

/* Bounds of a leaf's part of the pixel. */
static void bound(const struct refining *r, uint32_t c) {
  struct hsr_eb_tree *t = r->tree;
  struct hsr_eb_cell *cell = hsr_eb_cell(t, c);
  struct hsr_square square = hsr_eb_square(cell);
  double low[3], high[3],
      area = cell->level < 0 ? ldexp(1, 2 * cell->level) : 1;
  struct few few;
  hull(t, cell, cell->lo, cell->hi);
  /* What is known of a larger cell as a whole says nothing of its pixels. */
  bool exact = cell->level <= 0 && find_few(t, cell, &square, &few) &&
               integrate(r, &few, &square, low, high);
  HSR_STEP(t->tally, HSR_EB_BOUNDED, hsr_eb_subject(cell), HSR_NOTHING,
           hsr_eb_window(t, cell), exact);
  if (exact)
    HSR_STEP(t->tally,
             few.n < 2    ? HSR_EB_EXACT_ONE
             : few.n == 2 ? HSR_EB_EXACT_TWO
                          : HSR_EB_EXACT_MORE,
             hsr_eb_subject(cell), HSR_NOTHING, hsr_eb_window(t, cell), 0);
  for (int k = 0; k < 3; k++) {
    if (exact) {
      cell->lo[k] = fmax(cell->lo[k], low[k] - few.slack - 0x1p-48);
      cell->hi[k] = fmin(cell->hi[k], high[k] + few.slack + 0x1p-48);
    }
    cell->lo[k] = fmax(0, down(cell->lo[k], 0x1p-50)) * area;
    cell->hi[k] = fmin(1, up(cell->hi[k], 0x1p-50)) * area;
  }
}

/* --- Pixels --------------------------------------------------------------- */

static double width_of(const struct hsr_eb_cell *cell) {
  double width = 0;
  for (int c = 0; c < 3; c++)
    width = fmax(width, cell->hi[c] - cell->lo[c]);
  return width;
}

/* The bounds of a cell by those of its children; they never become wider. */
static void sum_children(struct hsr_eb_tree *t, struct hsr_eb_cell *cell,
                         bool first) {
  for (int c = 0; c < 3; c++) {
    double lo = 0, hi = 0;
    for (uint32_t k = 0; k < 4; k++) {
      const struct hsr_eb_cell *child = hsr_eb_cell(t, cell->child + k);
      lo = down(lo + child->lo[c], 0x1p-51);
      hi = up(hi + child->hi[c], 0x1p-51);
    }
    cell->lo[c] = first ? lo : fmax(cell->lo[c], lo);
    cell->hi[c] = first ? hi : fmin(cell->hi[c], hi);
  }
}

static void write_pixel(struct refining *r, const struct hsr_eb_cell *cell,
                        int i, int j) {
  struct hsr_area_bounds *to =
      r->answer + 3 * ((size_t)j * (size_t)r->tree->job->answer->m + (size_t)i);
  for (int c = 0; c < 3; c++)
    to[c] = (struct hsr_area_bounds){cell->lo[c], fmin(1, cell->hi[c])};
}

/* A pixel, or all pixels of a larger cell: no more is done there. */
static void accept(struct refining *r, uint32_t c) {
  struct hsr_eb_tree *t = r->tree;
  struct hsr_eb_cell *cell = hsr_eb_cell(t, c);
  struct hsr_window w = hsr_eb_window(t, cell);
  cell->done = true;
  for (int j = w.y0; j < w.y1; j++)
    for (int i = w.x0; i < w.x1; i++) {
      write_pixel(r, cell, i, j);
      HSR_ACCEPTED(t->tally, HSR_EB_PIXELS, hsr_eb_subject(cell), HSR_NOTHING,
                   HSR_AT(i, j),
                   r->answer +
                       3 * ((size_t)j * (size_t)t->job->answer->m + (size_t)i));
    }
  hsr_bounded_free_below(t, c);
}

/* --- The queue ------------------------------------------------------------ */

static bool push_heap(struct refining *r, struct uncertain item) {
  if (!hsr_arena_grow(r->tree->job->scratch, &r->heap, sizeof item))
    return false;
  struct uncertain *heap = r->heap.items;
  size_t k = r->heap.n - 1;
  for (; k > 0 && heap[(k - 1) / 2].by < item.by; k = (k - 1) / 2)
    heap[k] = heap[(k - 1) / 2];
  heap[k] = item;
  return true;
}

static struct uncertain pop_heap(struct refining *r) {
  struct uncertain *heap = r->heap.items, top = heap[0];
  struct uncertain last = heap[--r->heap.n];
  size_t k = 0, n = r->heap.n;
  for (size_t child; (child = 2 * k + 1) < n; k = child) {
    if (child + 1 < n && heap[child + 1].by > heap[child].by)
      child++;
    if (!(heap[child].by > last.by))
      break;
    heap[k] = heap[child];
  }
  if (n > 0)
    heap[k] = last;
  return top;
}

static bool push(struct refining *r, uint32_t c, uint32_t pixel) {
  const struct hsr_eb_cell *cell = hsr_eb_cell(r->tree, c);
  struct uncertain item = {width_of(cell), c, pixel};
  if (cell->level <= -r->limits->deepest || !(item.by > 0))
    return true;
  if (r->limits->order == HSR_EB_QUEUE)
    return push_heap(r, item);
  struct hsr_growing *level = &r->level[-cell->level];
  if (!hsr_arena_grow(r->tree->job->scratch, level, sizeof item))
    return false;
  ((struct uncertain *)level->items)[level->n - 1] = item;
  return true;
}

static bool push_leaves(struct refining *r, uint32_t c, uint32_t pixel) {
  uint32_t child = hsr_eb_cell(r->tree, c)->child;
  if (!child)
    return push(r, c, pixel);
  for (uint32_t k = 0; k < 4; k++)
    if (!push_leaves(r, child + k, pixel))
      return false;
  return true;
}

/* --- What the tiling pass left -------------------------------------------- */

/* Bounds of all leaves, and of the cells above them that are within a pixel. */
static void bound_all(const struct refining *r, uint32_t c) {
  struct hsr_eb_tree *t = r->tree;
  struct hsr_eb_cell *cell = hsr_eb_cell(t, c);
  if (!cell->child) {
    hsr_bounded_settle(t, c);
    bound(r, c);
    return;
  }
  for (uint32_t k = 0; k < 4; k++)
    bound_all(r, cell->child + k);
  sum_children(t, cell, true);
}

/* Every cell of at least a pixel: accepted, or divided down to its pixels. */
static bool begin_refining(struct refining *r, uint32_t c) {
  struct hsr_eb_tree *t = r->tree;
  struct hsr_eb_cell *cell = hsr_eb_cell(t, c);
  if (cell->place == HSR_EB_OUTSIDE)
    return true;
  bool whole =
      cell->place == HSR_EB_INSIDE && (cell->level == 0 || !cell->child);
  if (whole) {
    bound_all(r, c);
    if (width_of(cell) <= r->limits->eps) {
      accept(r, c);
      return true;
    }
    if (cell->level == 0) {
      r->unfinished++;
      return push_leaves(r, c, c);
    }
    if (!hsr_bounded_split(t, c))
      return false;
  }
  for (uint32_t k = 0; k < 4; k++)
    if (!begin_refining(r, cell->child + k))
      return false;
  return true;
}

/* --- Refining ------------------------------------------------------------- */

/* PropagateUncertainty: up to the pixel. */
static void propagate(struct refining *r, uint32_t c) {
  struct hsr_eb_tree *t = r->tree;
  struct hsr_eb_cell *cell = hsr_eb_cell(t, c);
  sum_children(t, cell, false);
  while (cell->level < 0) {
    c = cell->parent;
    cell = hsr_eb_cell(t, c);
    sum_children(t, cell, false);
  }
  if (width_of(cell) <= r->limits->eps) {
    accept(r, c);
    r->unfinished--;
  }
}

static bool refine_cell(struct refining *r, struct uncertain item) {
  struct hsr_eb_tree *t = r->tree;
  struct hsr_eb_cell *cell = hsr_eb_cell(t, item.cell);
  HSR_STEP(t->tally, HSR_EB_REFINED, hsr_eb_subject(cell), HSR_NOTHING,
           hsr_eb_window(t, cell), 0);
  if (!hsr_bounded_split(t, item.cell))
    return false;
  uint32_t child = cell->child;
  for (uint32_t k = 0; k < 4; k++)
    bound(r, child + k);
  propagate(r, item.cell);
  for (uint32_t k = 0; k < 4 && !hsr_eb_cell(t, item.pixel)->done; k++)
    if (!push(r, child + k, item.pixel))
      return false;
  return true;
}

double hsr_bounded_now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Has a limit been reached? The clock is looked at now and then. */
static bool is_over(const struct refining *r, uint64_t steps) {
  const struct hsr_eb_tree *t = r->tree;
  return t->n_cells > r->limits->cells ||
         (r->limits->seconds > 0 && steps % 64 == 0 &&
          hsr_bounded_now() - r->begun > r->limits->seconds);
}

/* The intervals of the pixels as they are, for who looks at them. */
static void write_all(struct refining *r, uint32_t c) {
  const struct hsr_eb_cell *cell = hsr_eb_cell(r->tree, c);
  if (cell->place == HSR_EB_OUTSIDE || cell->done)
    return;
  if (cell->level == 0) {
    write_pixel(r, cell, (int)floor(cell->x), (int)floor(cell->y));
    return;
  }
  for (uint32_t k = 0; k < 4; k++)
    write_all(r, cell->child + k);
}

static void end_pass(struct refining *r) {
  const struct hsr_job *job = r->tree->job;
  if (!job->passes)
    return;
  write_all(r, 0);
  job->passes->show(job->passes->whom, job->answer, r->passes++);
}

/* All cells of one size, then those of the next: a pass is one size. */
static bool refine_levels(struct refining *r) {
  uint64_t steps = 0;
  for (int level = 0; level < r->limits->deepest && r->unfinished; level++) {
    const struct hsr_growing *leaves = &r->level[level];
    for (size_t k = 0; k < leaves->n; k++) {
      struct uncertain item = ((struct uncertain *)leaves->items)[k];
      if (is_over(r, steps++))
        return true;
      if (!hsr_eb_cell(r->tree, item.pixel)->done && !refine_cell(r, item))
        return false;
    }
    end_pass(r);
  }
  return true;
}

/* The most uncertain cell first. A pass is as many cells as there were pixels
 * to be refined. */
static bool refine_queue(struct refining *r) {
  uint64_t steps = 0, pass = r->unfinished;
  while (r->heap.n > 0 && r->unfinished) {
    struct uncertain item = pop_heap(r);
    if (is_over(r, steps))
      return true;
    if (hsr_eb_cell(r->tree, item.pixel)->done)
      continue;
    if (!refine_cell(r, item))
      return false;
    if (++steps % pass == 0)
      end_pass(r);
  }
  return true;
}

/* What could not be brought within the tolerance. */
static void accept_rest(struct refining *r, uint32_t c) {
  const struct hsr_eb_cell *cell = hsr_eb_cell(r->tree, c);
  if (cell->place == HSR_EB_OUTSIDE || cell->done)
    return;
  if (cell->level == 0) {
    accept(r, c);
    return;
  }
  for (uint32_t k = 0; k < 4; k++)
    accept_rest(r, cell->child + k);
}

/* Refine. */
enum hsr_status hsr_bounded_refine(struct hsr_eb_tree *t,
                                   const struct hsr_eb_limits *limits,
                                   double begun, struct hsr_error *err) {
  struct refining r = {.tree = t,
                       .limits = limits,
                       .answer = hsr_answer_areas_of(t->job->answer),
                       .begun = begun};
  if (!begin_refining(&r, 0))
    return hsr_fail_nomem(err);
  end_pass(&r);
  bool good =
      limits->order == HSR_EB_QUEUE ? refine_queue(&r) : refine_levels(&r);
  if (!good)
    return hsr_fail_nomem(err);
  accept_rest(&r, 0);
  return HSR_OK;
}
