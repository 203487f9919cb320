/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bounds on what is seen in a leaf of the quadtree. The thesis, 5.4.4 and 5.5.
 *
 * Integrals   a leaf whose list is short is integrated in closed form: the
 *             share of the cell where polygon p is visible is that of p, less
 *             what lies in another polygon and behind its plane, plus what lies
 *             in two such, and so on: inclusion and exclusion. Each of these is
 *             a convex polygon; in a fan, the parity of up to three triangles
 *             that meet the cell is such a sum, too. No order of the polygons
 *             is needed, and they may penetrate. What is left is the
 *             background. The thesis has the cases of one polygon, and of two
 *             that cover the cell; exact=2 comes closest to it.
 * Shaders     where a polygon's colour varies, its share is mixed with bounds
 *             on its colours in the cell. That is not exact, but narrows with
 *             the cell.
 * Slivers     a polygon of less than 2^-30 of the cell is left out, and that
 *             share added to the uncertainty; likewise what a polygon leaves of
 *             a cell that it covers but for such a share. Without this, an edge
 *             that runs along the border of cells would be subdivided without
 *             end.
 * Rounding    a colour is within u = 2^-53 of itself, a product or a sum of
 *             numbers that are not negative as well. Every bound is moved
 *             outward by 2^-50 of itself, and by 2^-48 of the greatest colour
 *             where shares were mixed. */
#include "algorithms/hierarchical/bounded/bounded.h"

#include <math.h>
#include <stdlib.h>

#define SLIVER 0x1p-30

/* --- Colours -------------------------------------------------------------- */

void hsr_bounded_shade(const struct hsr_bounded_tree *t,
                       const struct hsr_bounded_cell *cell, uint32_t s,
                       double low[3], double high[3]) {
  const struct hsr_shape *shape = hsr_bounded_shape(t, s);
  struct hsr_square square = hsr_bounded_square(cell);
  if (!t->shades.parts) {
    for (int c = 0; c < 3; c++)
      low[c] = high[c] = shape->rgb[c];
    return;
  }
  HSR_STEP(t->tally, HSR_BOUNDED_SHADED, hsr_bounded_face(t, s),
           hsr_bounded_subject(cell), hsr_bounded_window(t, cell), 0);
  hsr_surface_colours(&t->shades,
                      (const struct hsr_surface *)t->surfaces.items + s, shape,
                      &square, low, high);
}

/* --- The polygons of a leaf ----------------------------------------------- */

enum { MOST = HSR_BOUNDED_CAPACITY + 2 };

/* The polygons of a leaf that matter. */
struct few {
  uint32_t shape[MOST], n;
  bool covers[MOST];
  double least[MOST][3], most[MOST][3]; /* their colours in the cell */
  struct hsr_fan fan[MOST]; /* of those that are fans and do not cover */
  double slack; /* the share of the cell that is not accounted for */
};

static bool is_fan(const struct hsr_bounded_tree *t, const struct few *few,
                   uint32_t k) {
  return !few->covers[k] && !hsr_bounded_shape(t, few->shape[k])->is_convex;
}

/* False if there are too many, or too many triangles of a fan. */
static bool find_few(const struct hsr_bounded_tree *t,
                     const struct hsr_bounded_cell *cell,
                     const struct hsr_square *square, struct few *few) {
  few->n = 0;
  few->slack = 0;
  for (uint32_t e = cell->first; e != HSR_BOUNDED_NONE;
       e = hsr_bounded_entry(t, e)->next) {
    const struct hsr_bounded_entry *entry = hsr_bounded_entry(t, e);
    const struct hsr_shape *shape = hsr_bounded_shape(t, entry->shape);
    bool covers = entry->covers;
    double lo = 1, hi = 1;
    if (!covers && cell->n > 1)
      hsr_shape_share(shape, square, &lo, &hi);
    if (hi < SLIVER) {
      few->slack += hi;
      continue;
    }
    if (!covers && cell->n > 1 && lo > 1 - SLIVER) {
      covers = true;
      few->slack += 1 - lo;
    }
    if (few->n == MOST || (!covers && !shape->is_convex &&
                           !hsr_shape_fan(shape, square, &few->fan[few->n])))
      return false;
    few->shape[few->n] = entry->shape;
    hsr_bounded_shade(t, cell, entry->shape, few->least[few->n],
                      few->most[few->n]);
    few->covers[few->n++] = covers;
  }
  return true;
}

/* What is left of a square after some polygons: by inclusion and exclusion. */
struct shares {
  const struct hsr_bounded_tree *t;
  const struct few *few;
  const struct hsr_square *square;
  uint32_t p; /* whose share is looked for: few->shape[p] */
  double lo, hi;
};

static void add_parts(struct shares *s, const struct hsr_clip *clip,
                      uint32_t from, int sign);

/* Adds the parts of a fan. A point of the fan lies in an odd number of its
 * triangles. Let a point lie in i triangles. Add up (-2)^(m - 1) over all sets
 * of m of these triangles, m = 1 ... i: the sum is 1 if i is odd, and 0 if i is
 * even. So the part in each set of triangles is added with this weight. With
 * fan->odd, an odd number of further triangles covers the square, and the whole
 * of it less this sum is added. */
static void add_fan(struct shares *s, const struct hsr_clip *clip, uint32_t k,
                    uint32_t from, int sign) {
  const struct hsr_shape *shape = hsr_bounded_shape(s->t, s->few->shape[k]);
  const struct hsr_fan *fan = &s->few->fan[k];
  for (uint32_t set = fan->odd ? 0 : 1; set < 1u << fan->n; set++) {
    struct hsr_clip part = *clip;
    int weight = fan->odd && set ? -1 : 1;
    bool any = false;
    hsr_clip_by_near(&part, shape, s->square);
    for (uint32_t i = 0; i < fan->n; i++)
      if (set >> i & 1) {
        hsr_clip_by_triangle(&part, shape, fan, i, s->square);
        weight *= any ? -2 : 1;
        any = true;
      }
    add_parts(s, &part, from, sign * weight);
  }
}

/* Adds the parts that lie in polygon k. */
static void add_polygon(struct shares *s, const struct hsr_clip *clip,
                        uint32_t k, uint32_t from, int sign) {
  const struct hsr_shape *shape = hsr_bounded_shape(s->t, s->few->shape[k]);
  if (is_fan(s->t, s->few, k)) {
    add_fan(s, clip, k, from, sign);
    return;
  }
  struct hsr_clip part = *clip;
  for (uint32_t l = 0; !s->few->covers[k] && l < shape->n_lines; l++)
    hsr_clip_by(&part, &shape->line[l], s->square);
  add_parts(s, &part, from, sign);
}

/* Clips by where polygon r is in front of p, if both are there. False: it is so
 * nowhere. */
static bool clip_by_front(struct hsr_clip *clip,
                          const struct hsr_bounded_tree *t, uint32_t r,
                          uint32_t p, const struct hsr_square *square) {
  if (hsr_bounded_before(t, p, r, square))
    return false;
  if (hsr_bounded_before(t, r, p, square))
    return true;
  const struct hsr_screen_line *a = &hsr_bounded_shape(t, r)->q,
                               *b = &hsr_bounded_shape(t, p)->q;
  struct hsr_screen_line by = {a->a - b->a, a->b - b->b, a->c - b->c,
                               a->error + b->error};
  hsr_clip_by(clip, &by, square);
  return true;
}

/* How often the parts of a part are counted at most, all in all: once itself,
 * and in each polygon that follows once or, in a fan, as often as the weights
 * of its sets add up to: 1 + 13, for three triangles. */
static double most_parts(const struct shares *s, uint32_t from) {
  double most = 1;
  for (uint32_t k = from; k < s->few->n; k++)
    most *= is_fan(s->t, s->few, k) ? 15 : 2;
  return most;
}

/* `clip` is what of polygon p lies in some polygons before it, with the sign or
 * weight that this has. Adds its share, and those of its parts that lie in one
 * more of the polygons, from number `from` on. What is behind a sliver is of no
 * more than that. */
static void add_parts(struct shares *s, const struct hsr_clip *clip,
                      uint32_t from, int sign) {
  double lo, hi;
  hsr_clip_share(clip, &lo, &hi);
  if (hi < SLIVER) {
    double most = hi * abs(sign) * most_parts(s, from);
    s->lo -= most;
    s->hi += most;
    return;
  }
  s->lo += sign > 0 ? sign * lo : sign * hi;
  s->hi += sign > 0 ? sign * hi : sign * lo;
  for (uint32_t k = from; k < s->few->n; k++) {
    if (k == s->p)
      continue;
    struct hsr_clip part = *clip;
    if (clip_by_front(&part, s->t, s->few->shape[k], s->few->shape[s->p],
                      s->square))
      add_polygon(s, &part, k, k + 1, -sign);
  }
}

/* Is a polygon behind one that covers the square? */
static bool is_hidden(const struct hsr_bounded_tree *t, const struct few *few,
                      uint32_t k, const struct hsr_square *square) {
  for (uint32_t l = 0; l < few->n; l++)
    if (l != k && few->covers[l] &&
        hsr_bounded_before(t, few->shape[l], few->shape[k], square))
      return true;
  return false;
}

/* The integral over a leaf of few polygons, in closed form: its share is known
 * of each of them. */
static void integrate(const struct hsr_bounded_tree *t, const struct few *few,
                      const struct hsr_square *square, double low[3],
                      double high[3]) {
  const double *behind = t->background;
  for (int c = 0; c < 3; c++)
    low[c] = high[c] = behind[c];
  for (uint32_t k = 0; k < few->n; k++) {
    if (is_hidden(t, few, k, square))
      continue;
    struct shares s = {t, few, square, k, 0, 0};
    struct hsr_clip clip;
    hsr_clip_whole(&clip);
    add_polygon(&s, &clip, k, 0, 1);
    s.lo = fmax(0, s.lo);
    s.hi = fmin(1, s.hi);
    for (int c = 0; c < 3; c++) {
      double least = few->least[k][c] - behind[c];
      double most = few->most[k][c] - behind[c];
      low[c] += least > 0 ? least * s.lo : least * s.hi;
      high[c] += most > 0 ? most * s.hi : most * s.lo;
    }
  }
}

/* --- Bounds --------------------------------------------------------------- */

void hsr_bounded_hull(const struct hsr_bounded_tree *t,
                      const struct hsr_bounded_cell *cell, double low[3],
                      double high[3]) {
  bool covered = cell->far > -INFINITY;
  for (int c = 0; c < 3; c++) {
    low[c] = 0;
    high[c] = 1;
  }
  if (cell->untiled)
    return;
  for (int c = 0; c < 3; c++) {
    low[c] = covered ? INFINITY : t->background[c];
    high[c] = covered ? -INFINITY : t->background[c];
  }
  for (uint32_t e = cell->first; e != HSR_BOUNDED_NONE;
       e = hsr_bounded_entry(t, e)->next) {
    double least[3], most[3];
    hsr_bounded_shade(t, cell, hsr_bounded_entry(t, e)->shape, least, most);
    for (int c = 0; c < 3; c++) {
      low[c] = fmin(low[c], least[c]);
      high[c] = fmax(high[c], most[c]);
    }
  }
}

/* The counter of a closed form. */
static int exact_of(uint32_t n) {
  return n < 2    ? HSR_BOUNDED_EXACT_ONE
         : n == 2 ? HSR_BOUNDED_EXACT_TWO
                  : HSR_BOUNDED_EXACT_MORE;
}

void hsr_bounded_mean(const struct hsr_bounded_tree *t,
                      const struct hsr_bounded_cell *cell, uint32_t most,
                      double lo[3], double hi[3]) {
  struct hsr_square square = hsr_bounded_square(cell);
  double low[3], high[3];
  struct few few;
  hsr_bounded_hull(t, cell, lo, hi);
  /* What is known of a larger cell as a whole says nothing of its pixels. */
  bool alone = cell->n == 1 && hsr_bounded_entry(t, cell->first)->covers;
  bool mixed = cell->level <= 0 && !(alone && t->shades.parts) && !t->late &&
               find_few(t, cell, &square, &few) && few.n <= most;
  if (mixed)
    integrate(t, &few, &square, low, high);
  bool exact = mixed && !(t->shades.parts && few.n);
  HSR_STEP(t->tally, HSR_BOUNDED_BOUNDED, hsr_bounded_subject(cell),
           HSR_NOTHING, hsr_bounded_window(t, cell), exact);
  if (exact)
    HSR_STEP(t->tally, exact_of(few.n), hsr_bounded_subject(cell), HSR_NOTHING,
             hsr_bounded_window(t, cell), 0);
  for (int k = 0; k < 3; k++) {
    if (mixed) {
      lo[k] = fmax(lo[k], low[k] - few.slack - 0x1p-48);
      hi[k] = fmin(hi[k], high[k] + few.slack + 0x1p-48);
    }
    lo[k] = fmax(0, lo[k] * (1 - 0x1p-50));
    hi[k] = fmin(1, hi[k] * (1 + 0x1p-50));
  }
}
