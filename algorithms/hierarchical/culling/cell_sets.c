/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/hierarchical/culling/cell_sets.h"

#include <math.h>

/* Lines that come into a cell. slope[a][b] is what they gain along b while they
 * gain 1 along a. Coordinates are mirrored so that lines go upwards. */
struct bundle {
  bool any;
  struct hsr_box in;
  double least[3][3], most[3][3];
};

struct finder {
  const struct hsr_portals *portals;
  struct hsr_cell_sets *sets;
  uint32_t *order[8];    /* an octant: the cells from front to back */
  struct bundle *bundle; /* a cell */
};

/* --- Bounds --------------------------------------------------------------- */

/* Coordinates are at most 1e30, and a bound is made of one sum, product or
 * quotient of others: these four widen it by more than its rounding. What is
 * infinite stays so, and what is not a number bounds nothing where fmin and
 * fmax take it. A slope's lower bound is cut to 1e200, so a product with it is
 * finite. */
static double below(double x) {
  return isinf(x) ? x : x - (fabs(x) * 0x1p-50 + 0x1p-960);
}

static double above(double x) {
  return isinf(x) ? x : x + (fabs(x) * 0x1p-50 + 0x1p-960);
}

/* A slope times a distance, none less than 0: nothing gained on no way, or by
 * no slope, however long the way. */
static double gain(double slope, double way) {
  return slope > 0 && way > 0 ? slope * way : 0;
}

static struct hsr_box mirrored(const struct hsr_box *box, int octant) {
  struct hsr_box made = *box;
  for (int k = 0; k < 3; k++)
    if (!(octant >> k & 1)) {
      made.lo[k] = -box->hi[k];
      made.hi[k] = -box->lo[k];
    }
  return made;
}

/* --- Bundles -------------------------------------------------------------- */

static void bound_slope(struct bundle *lines, int a, int b, double least,
                        double most) {
  lines->least[a][b] = fmax(lines->least[a][b], fmin(1e200, least));
  lines->most[a][b] = fmin(lines->most[a][b], most);
}

/* Bounds the slopes of lines that go from one box to a place across axis a,
 * where they are within `to`. */
static void bound_slopes(struct bundle *lines, const struct hsr_box *from,
                         const struct hsr_box *to, int a) {
  double shortest = fmax(0, below(to->lo[a] - from->hi[a]));
  double longest = above(to->lo[a] - from->lo[a]);
  for (int b = 0; b < 3; b++) {
    if (b == a)
      continue;
    double rise = below(to->lo[b] - from->hi[b]);
    double most = above(to->hi[b] - from->lo[b]);
    bound_slope(lines, a, b,
                rise > 0 && longest > 0 ? below(rise / longest) : 0,
                shortest > 0 ? above(most / shortest) : INFINITY);
    double least = lines->least[a][b];
    most = lines->most[a][b];
    bound_slope(lines, b, a, most > 0 ? below(1 / most) : 0,
                least > 0 ? above(1 / least) : INFINITY);
  }
}

/* The lines of a bundle that go through a portal, of which the first portal was
 * `first`. False if there are none. */
static bool go_through(const struct bundle *lines, const struct hsr_box *first,
                       const struct hsr_box *portal, int a,
                       struct bundle *left) {
  double shortest = fmax(0, below(portal->lo[a] - lines->in.hi[a]));
  double longest = fmax(0, above(portal->lo[a] - lines->in.lo[a]));
  *left = *lines;
  left->in = *portal;
  for (int b = 0; b < 3; b++) {
    if (b == a)
      continue;
    double least = gain(lines->least[a][b], shortest);
    double most = gain(lines->most[a][b], longest);
    left->in.lo[b] = fmax(portal->lo[b], below(lines->in.lo[b] + below(least)));
    left->in.hi[b] = fmin(portal->hi[b], above(lines->in.hi[b] + above(most)));
    if (left->in.lo[b] > left->in.hi[b])
      return false;
  }
  bound_slopes(left, &lines->in, &left->in, a);
  bound_slopes(left, first, &left->in, a);
  for (int b = 0; b < 3; b++)
    if (b != a && left->least[a][b] > left->most[a][b])
      return false;
  return true;
}

static void join(struct bundle *all, const struct bundle *more) {
  if (!all->any) {
    *all = *more;
    all->any = true;
    return;
  }
  for (int a = 0; a < 3; a++) {
    all->in.lo[a] = fmin(all->in.lo[a], more->in.lo[a]);
    all->in.hi[a] = fmax(all->in.hi[a], more->in.hi[a]);
    for (int b = 0; b < 3; b++) {
      all->least[a][b] = fmin(all->least[a][b], more->least[a][b]);
      all->most[a][b] = fmax(all->most[a][b], more->most[a][b]);
    }
  }
}

/* --- Cells ---------------------------------------------------------------- */

/* The cells that lines of an octant get into by portals that are across an axis
 * of theirs, and ahead. */
static void follow(struct finder *f, const struct hsr_box *first, int octant,
                   uint32_t cell) {
  const struct hsr_portals *p = f->portals;
  for (uint32_t k = p->first_portal[cell]; k < p->first_portal[cell + 1]; k++) {
    const struct hsr_portal *portal = &p->portal[p->of_cell[k]];
    bool upwards = portal->cell[0] == cell;
    struct bundle left;
    if (upwards != (octant >> portal->axis & 1))
      continue;
    struct hsr_box box = mirrored(&portal->box, octant);
    if (go_through(&f->bundle[cell], first, &box, portal->axis, &left))
      join(&f->bundle[portal->cell[upwards]], &left);
  }
}

/* What is seen from a cell by one of its portals, along an octant. */
static void see_through(struct finder *f, uint32_t from,
                        const struct hsr_portal *portal, int octant) {
  struct hsr_cell_sets *sets = f->sets;
  bool upwards = portal->cell[0] == from;
  struct hsr_box first = mirrored(&portal->box, octant);
  struct bundle start = {.any = true, .in = first};
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++)
      start.most[a][b] = INFINITY;
  for (uint32_t c = 0; c < sets->n_cells; c++)
    f->bundle[c].any = false;
  f->bundle[portal->cell[upwards]] = start;
  for (uint32_t k = 0; k < sets->n_cells; k++) {
    uint32_t c = f->order[octant][k];
    if (!f->bundle[c].any)
      continue;
    sets->sees[(size_t)from * sets->n_cells + c] = 1;
    follow(f, &first, octant, c);
  }
}

static void find_set(struct finder *f, uint32_t from) {
  const struct hsr_portals *p = f->portals;
  f->sets->sees[(size_t)from * p->n_cells + from] = 1;
  for (uint32_t k = p->first_portal[from]; k < p->first_portal[from + 1]; k++) {
    const struct hsr_portal *portal = &p->portal[p->of_cell[k]];
    for (int octant = 0; octant < 8; octant++)
      if ((portal->cell[0] == from) == (octant >> portal->axis & 1))
        see_through(f, from, portal, octant);
  }
}

/* Lists the cells of a node from front to back, as of an octant. */
static uint32_t list_order(const struct hsr_portals *p, uint32_t node,
                           int octant, uint32_t *order, uint32_t n) {
  const struct hsr_portal_node *here = &p->node[node];
  if (here->axis < 0) {
    order[n] = here->cell;
    return n + 1;
  }
  bool upwards = octant >> here->axis & 1;
  n = list_order(p, here->child[!upwards], octant, order, n);
  return list_order(p, here->child[upwards], octant, order, n);
}

enum hsr_status hsr_cell_sets_init(struct hsr_cell_sets *sets,
                                   const struct hsr_portals *portals,
                                   struct hsr_arena *arena) {
  struct finder f = {.portals = portals, .sets = sets};
  size_t n = portals->n_cells;
  sets->n_cells = portals->n_cells;
  sets->sees = HSR_NEW_ZEROED(arena, unsigned char, n *n);
  f.bundle = HSR_NEW(arena, struct bundle, n);
  if (!sets->sees || !f.bundle)
    return HSR_E_NOMEM;
  for (int octant = 0; octant < 8; octant++) {
    f.order[octant] = HSR_NEW(arena, uint32_t, n);
    if (!f.order[octant])
      return HSR_E_NOMEM;
    list_order(portals, 0, octant, f.order[octant], 0);
  }
  for (uint32_t c = 0; c < n; c++)
    find_set(&f, c);
  return HSR_OK;
}
