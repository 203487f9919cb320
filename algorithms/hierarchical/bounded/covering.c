/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Covering structures of the thesis, 5.4.2: one polygon that covers a cell, two
 * that share an edge, and a fan of polygons about a vertex; and
 * RemoveHiddenPolys, what lies behind them. */
#include "algorithms/hierarchical/bounded/bounded.h"

#include <math.h>

/* --- Which is in front ---------------------------------------------------- */

static bool on_one_plane(const struct hsr_bounded_tree *t, uint32_t p,
                         uint32_t r) {
  struct hsr_bounded_planes *known =
      &t->planes[(p * 2654435761u ^ r * 2246822519u) >> 16 &
                 (HSR_BOUNDED_PLANES - 1)];
  if (known->p != p || known->r != r)
    *known = (struct hsr_bounded_planes){
        p, r,
        hsr_pair_same_plane(t->pair, hsr_bounded_shape(t, p)->id,
                            hsr_bounded_shape(t, r)->id, t->tally)};
  return known->same;
}

/* At the four corners, exactly: what is nearer there is so in between. */
static bool is_before_exactly(const struct hsr_bounded_tree *t, uint32_t p,
                              uint32_t r, const struct hsr_square *square) {
  if (on_one_plane(t, p, r))
    return hsr_bounded_shape(t, p)->id < hsr_bounded_shape(t, r)->id;
  for (int k = 0; k < 4; k++)
    if (!hsr_pair_nearer_at(
            t->pair, hsr_bounded_shape(t, p)->id, hsr_bounded_shape(t, r)->id,
            square->x + (k & 1 ? square->half : -square->half),
            square->y + (k & 2 ? square->half : -square->half), t->tally))
      return false;
  return true;
}

bool hsr_bounded_before(const struct hsr_bounded_tree *t, uint32_t p,
                        uint32_t r, const struct hsr_square *square) {
  if (hsr_bounded_in_order(t, p) && hsr_bounded_in_order(t, r))
    return p < r;
  const struct hsr_screen_line *a = &hsr_bounded_shape(t, p)->q,
                               *b = &hsr_bounded_shape(t, r)->q;
  struct hsr_screen_line by = {a->a - b->a, a->b - b->b, a->c - b->c,
                               a->error + b->error};
  double lo, hi;
  hsr_line_range(&by, square, &lo, &hi);
  HSR_COUNT_DEPTHS(t->tally, 1);
  /* lo + 2 error: the least by how much p may be nearer. */
  bool before =
      lo > 0 || (lo + 2 * by.error >= 0 && is_before_exactly(t, p, r, square));
  HSR_STEP(t->tally, HSR_BOUNDED_ORDERED, hsr_bounded_face(t, p),
           hsr_bounded_face(t, r), HSR_NOWHERE, before);
  return before;
}

/* --- Finding them --------------------------------------------------------- */

/* Polygons that cover a cell together. */
struct structure {
  uint32_t shape[HSR_BOUNDED_CAPACITY + 1], n;
  double far;
};

static bool same_point(const double a[3], const double b[3]) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* The edge of r between the same two points as edge k of p, with r on the other
 * side of it; HSR_BOUNDED_NONE: there is none. */
static uint32_t edge_across(const struct hsr_shape *p, uint32_t k,
                            const struct hsr_shape *r) {
  const double *a = p->corner[k], *b = p->corner[(k + 1) % p->n_corners];
  for (uint32_t l = 0; l < r->n_corners; l++) {
    if (p->edge[k] != r->edge[l])
      continue;
    const double *c = r->corner[l], *d = r->corner[(l + 1) % r->n_corners];
    bool same = same_point(a, c) && same_point(b, d);
    bool turned = same_point(a, d) && same_point(b, c);
    if ((turned && p->inner == r->inner) || (same && p->inner != r->inner))
      return l;
  }
  return HSR_BOUNDED_NONE;
}

/* Do two polygons cover the square together, on both sides of an edge that they
 * share? */
static bool share_edge(const struct hsr_bounded_tree *t, uint32_t p, uint32_t r,
                       const struct hsr_square *square) {
  const struct hsr_shape *a = hsr_bounded_shape(t, p),
                         *b = hsr_bounded_shape(t, r);
  for (uint32_t k = 0; a->is_convex && b->is_convex && k < a->n_corners; k++) {
    uint32_t l = edge_across(a, k, b);
    if (l != HSR_BOUNDED_NONE && hsr_shape_covers_but(a, square, k, k) &&
        hsr_shape_covers_but(b, square, l, l))
      return true;
  }
  return false;
}

/* Do two pieces of one polygon cover the square together, on both sides of a
 * plane that cuts it? */
static bool share_cut(const struct hsr_bounded_tree *t, uint32_t p, uint32_t r,
                      const struct hsr_square *square) {
  const struct hsr_shape *a = hsr_bounded_shape(t, p),
                         *b = hsr_bounded_shape(t, r);
  if (a->id != b->id || !a->is_convex)
    return false;
  for (uint32_t k = 0; k < a->n_cuts; k++)
    for (uint32_t l = 0; l < b->n_cuts; l++) {
      uint32_t i = a->n_lines - a->n_cuts + k, j = b->n_lines - b->n_cuts + l;
      if (a->cut[k].plane == b->cut[l].plane &&
          a->cut[k].side != b->cut[l].side &&
          hsr_shape_covers_but(a, square, i, i) &&
          hsr_shape_covers_but(b, square, j, j))
        return true;
    }
  return false;
}

/* The polygon of the cell's list across edge k of p, that has all of the cell
 * between edge *l, which is edge k, and the other one at their vertex. */
static uint32_t next_in_fan(const struct hsr_bounded_tree *t,
                            const struct hsr_bounded_cell *cell,
                            const struct hsr_square *square, uint32_t p,
                            uint32_t k, const double *vertex, uint32_t *other) {
  for (uint32_t e = cell->first; e != HSR_BOUNDED_NONE;
       e = hsr_bounded_entry(t, e)->next) {
    uint32_t r = hsr_bounded_entry(t, e)->shape;
    const struct hsr_shape *shape = hsr_bounded_shape(t, r);
    uint32_t l = r == p || !shape->is_convex
                     ? HSR_BOUNDED_NONE
                     : edge_across(hsr_bounded_shape(t, p), k, shape);
    if (l == HSR_BOUNDED_NONE)
      continue;
    uint32_t n = shape->n_corners;
    *other =
        same_point(shape->corner[l], vertex) ? (l + n - 1) % n : (l + 1) % n;
    if (hsr_shape_covers_but(shape, square, l, *other))
      return r;
  }
  return HSR_BOUNDED_NONE;
}

/* Around a vertex of polygon s, from edge to edge: do all of these polygons
 * come back to s? */
static bool find_fan(const struct hsr_bounded_tree *t,
                     const struct hsr_bounded_cell *cell,
                     const struct hsr_square *square, uint32_t s,
                     uint32_t corner, struct structure *fan) {
  const struct hsr_shape *shape = hsr_bounded_shape(t, s);
  uint32_t before = (corner + shape->n_corners - 1) % shape->n_corners;
  uint32_t p = s, edge = corner;
  fan->n = 0;
  if (!hsr_shape_covers_but(shape, square, before, corner))
    return false;
  do {
    fan->shape[fan->n++] = p;
    p = next_in_fan(t, cell, square, p, edge, shape->corner[corner], &edge);
  } while (p != HSR_BOUNDED_NONE && p != s && fan->n <= HSR_BOUNDED_CAPACITY);
  return p == s && fan->n > 2;
}

/* The structure that polygon s, which is on the leaf's list, completes: one
 * polygon, two that share an edge, or a fan. In a list that is too long only
 * one is looked for. */
static bool find_structure(const struct hsr_bounded_tree *t,
                           const struct hsr_bounded_cell *cell,
                           const struct hsr_square *square, uint32_t s,
                           bool covers, struct structure *found) {
  const struct hsr_shape *shape = hsr_bounded_shape(t, s);
  found->shape[0] = s;
  found->n = 1;
  if (covers)
    return true;
  if (!shape->is_convex || cell->n > HSR_BOUNDED_CAPACITY)
    return false;
  found->n = 2;
  for (uint32_t e = cell->first; e != HSR_BOUNDED_NONE;
       e = hsr_bounded_entry(t, e)->next) {
    found->shape[1] = hsr_bounded_entry(t, e)->shape;
    if (found->shape[1] != s && (share_edge(t, s, found->shape[1], square) ||
                                 share_cut(t, s, found->shape[1], square)))
      return true;
  }
  for (uint32_t k = 0; cell->n > 2 && k < shape->n_corners; k++)
    if (find_fan(t, cell, square, s, k, found))
      return true;
  return false;
}

static bool is_in(const struct structure *structure, uint32_t s) {
  for (uint32_t k = 0; k < structure->n; k++)
    if (structure->shape[k] == s)
      return true;
  return false;
}

static bool is_behind(const struct hsr_bounded_tree *t, uint32_t s,
                      const struct structure *structure,
                      const struct hsr_square *square) {
  for (uint32_t k = 0; k < structure->n; k++)
    if (!hsr_bounded_before(t, structure->shape[k], s, square))
      return false;
  return true;
}

/* RemoveHiddenPolys. In strict order `far` says only that the cell is covered,
 * and nothing of what came before. */
static void remove_hidden(struct hsr_bounded_tree *t,
                          struct hsr_bounded_cell *cell,
                          const struct hsr_square *square,
                          const struct structure *structure) {
  for (uint32_t *at = &cell->first; *at != HSR_BOUNDED_NONE;) {
    uint32_t e = *at;
    struct hsr_bounded_entry *entry = hsr_bounded_entry(t, e);
    if (is_in(structure, entry->shape) ||
        !((t->in_order == HSR_BOUNDED_NONE &&
           hsr_bounded_nearest(t, entry->shape, square) < cell->far) ||
          is_behind(t, entry->shape, structure, square))) {
      at = &entry->next;
      continue;
    }
    HSR_STEP(t->tally, HSR_BOUNDED_REMOVED, hsr_bounded_face(t, entry->shape),
             hsr_bounded_subject(cell), hsr_bounded_window(t, cell), 0);
    *at = entry->next;
    entry->next = t->free_entries;
    t->free_entries = e;
    cell->n--;
  }
}

/* What covers the cell with s, if anything does, and what follows of it. */
void hsr_bounded_cover(struct hsr_bounded_tree *t,
                       struct hsr_bounded_cell *cell,
                       const struct hsr_square *square, uint32_t s,
                       bool covers) {
  struct structure found;
  if (!find_structure(t, cell, square, s, covers, &found))
    return;
  HSR_STEP(t->tally, HSR_BOUNDED_STRUCTURES, hsr_bounded_face(t, s),
           hsr_bounded_subject(cell), hsr_bounded_window(t, cell),
           found.n > 2 ? 2 : found.n - 1);
  found.far = INFINITY;
  for (uint32_t k = 0; k < found.n; k++)
    if (!hsr_bounded_in_order(t, found.shape[k]))
      found.far =
          fmin(found.far, hsr_bounded_farthest(t, found.shape[k], square));
  cell->far = fmax(cell->far, found.far);
  remove_hidden(t, cell, square, &found);
}
