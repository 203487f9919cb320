/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Error of a plane. Let the world have N and P for a face
 * (common/scene/world.h), u = 2^-53, lo and h be the grid's; for t in [0, T], T
 * the root's size in voxels,
 *   f(t) = N . (lo + h t - P),  h N and N . (lo - P) being computed once.
 * With n1 = |N|_1 and R the largest of |lo_k - P_k| + h T, no partial sum is
 * greater than n1 R but for its rounding; making f in the middle of a cell
 * takes at most 4 roundings for each of 3 terms and 20 further ones, `margin`
 * another 6: together less than 2^-47 n1 R. The centre of a voxel is off by two
 * roundings, of less than 2^-51 S in each coordinate, S the largest of |lo_k| +
 * h T. The plane itself is within 2 (3 n_error R + anchor_error n1) there, as
 * in order.c, the doubling covering the products of errors; or f is nowhere
 * beyond that. 2^-960 covers underflow. */
#include "algorithms/volume/solid_pyramid.h"
#include "common/base/bits.h"
#include "common/scene/pieces.h"

#include <math.h>

static const uint64_t ALL = UINT64_MAX;

/* A cell on the way. */
struct cell {
  int level;
  int corner[3], size; /* its first voxel, and voxels a side */
};

static void corner_of(const int corner[3], int size, int bit, int of_bit[3]) {
  of_bit[0] = corner[0] + bit % 4 * size;
  of_bit[1] = corner[1] + bit / 4 % 4 * size;
  of_bit[2] = corner[2] + bit / 16 * size;
}

static bool is_finest(const struct hsr_solid_pyramid *p,
                      const struct cell *cell) {
  return cell->level == p->n_levels - 1;
}

static struct cell subcell(const struct cell *cell, int bit) {
  struct cell sub = {.level = cell->level + 1, .size = cell->size / 4};
  corner_of(cell->corner, sub.size, bit, sub.corner);
  return sub;
}

static struct cell root_of(const struct hsr_solid_pyramid *p) {
  struct cell root = {.size = 1 << 2 * p->n_levels};
  return root;
}

static size_t number_of(const struct hsr_solid_pyramid *p,
                        const struct cell *cell) {
  const int *n = p->level[cell->level].n, *at = cell->corner;
  int size = cell->size;
  return ((size_t)(at[2] / size) * (size_t)n[1] + (size_t)(at[1] / size)) *
             (size_t)n[0] +
         (size_t)(at[0] / size);
}

/* The cell in an event. */
static struct hsr_subject subject(const struct hsr_solid_pyramid *p,
                                  const struct cell *cell) {
  return HSR_CELL(cell->level, number_of(p, cell), 0);
}

static struct hsr_triage *coarse_of(const struct hsr_solid_pyramid *p,
                                    const struct cell *cell) {
  return &p->level[cell->level].coarse[number_of(p, cell)];
}

static uint64_t *finest_of(const struct hsr_solid_pyramid *p,
                           const struct cell *cell) {
  return &p->level[cell->level].finest[number_of(p, cell)];
}

/* --- Clearing ------------------------------------------------------------- */

/* The first n subcells of four along an axis that begin before the end. */
static int subcells(int extent, int size) {
  int n = (extent + size - 1) / size;
  return n < 0 ? 0 : n > 4 ? 4 : n;
}

/* The subcells that have voxels of the grid. */
static uint64_t in_grid(const struct hsr_solid_pyramid *p,
                        const struct cell *cell) {
  int n[3];
  for (int k = 0; k < 3; k++)
    n[k] = subcells(p->grid.n[k] - cell->corner[k], cell->size / 4);
  uint64_t row = (uint64_t)((1 << n[0]) - 1);
  uint64_t layer = row * (0x1111u & ((1u << 4 * n[1]) - 1));
  uint64_t layers = n[2] ? 0x0001000100010001u >> (64 - 16 * n[2]) : 0;
  return layer * layers;
}

static void clear(const struct hsr_solid_pyramid *p, const struct cell *cell) {
  uint64_t vacant = in_grid(p, cell);
  if (is_finest(p, cell))
    *finest_of(p, cell) = ~vacant;
  else
    *coarse_of(p, cell) = (struct hsr_triage){~vacant, vacant};
}

/* --- Beginning ------------------------------------------------------------ */

static uint32_t most_planes(const struct hsr_volumes *volumes) {
  uint32_t most = 0;
  for (uint32_t v = 0; v < volumes->n; v++) {
    uint32_t n = volumes->plane_start[v + 1] - volumes->plane_start[v];
    most = n > most ? n : most;
  }
  return most;
}

static bool allocate_level(struct hsr_solid_pyramid *p, int k, uint32_t most,
                           struct hsr_arena *arena) {
  struct hsr_solid_level *level = &p->level[k];
  int size = 1 << 2 * (p->n_levels - k);
  size_t cells = 1;
  for (int axis = 0; axis < 3; axis++) {
    level->n[axis] = (p->grid.n[axis] + size - 1) / size;
    cells *= (size_t)level->n[axis];
  }
  if (k == p->n_levels - 1)
    level->finest = HSR_NEW(arena, uint64_t, cells);
  else
    level->coarse = HSR_NEW(arena, struct hsr_triage, cells);
  p->bytes +=
      cells * (level->finest ? sizeof *level->finest : sizeof *level->coarse);
  level->active = HSR_NEW(arena, uint32_t, most);
  level->list = HSR_NEW(arena, uint32_t, most);
  level->inside = HSR_NEW(arena, uint64_t, most);
  return (level->finest || level->coarse) && level->active && level->list &&
         level->inside;
}

enum hsr_status hsr_solid_pyramid_init(struct hsr_solid_pyramid *p,
                                       const struct hsr_voxel_grid *grid,
                                       const struct hsr_volumes *volumes,
                                       struct hsr_arena *arena) {
  uint32_t most = most_planes(volumes);
  *p = (struct hsr_solid_pyramid){
      .grid = *grid, .volumes = volumes, .n_levels = 1};
  for (int k = 0; k < 3; k++)
    while (1 << 2 * p->n_levels < grid->n[k])
      p->n_levels++;
  bool allocated = true;
  for (int k = 0; k < p->n_levels; k++)
    allocated = allocated && allocate_level(p, k, most, arena);
  p->plane = HSR_NEW(arena, struct hsr_triage_plane, most);
  p->all = HSR_NEW(arena, uint32_t, most);
  if (!allocated || !p->plane || !p->all)
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < most; k++)
    p->all[k] = k;
  struct cell root = root_of(p);
  clear(p, &root);
  return HSR_OK;
}

/* --- Planes before voxels ------------------------------------------------- */

static const struct hsr_world *world_of(const struct hsr_solid_pyramid *p) {
  return p->volumes->edges->world;
}

/* A half space in the grid's own terms: see above. */
static struct hsr_triage_plane plane_of(const struct hsr_solid_pyramid *p,
                                        struct hsr_cut half) {
  const struct hsr_world *world = world_of(p);
  uint32_t f = half.face;
  double side = half.side, h = p->grid.size;
  double N[3] = {side * world->mesh.nx[f], side * world->mesh.ny[f],
                 side * world->mesh.nz[f]};
  double P[3] = {world->mesh.px[f], world->mesh.py[f], world->mesh.pz[f]};
  double across = h * root_of(p).size, n1 = 0, r = 0, s = 0, d = 0;
  for (int k = 0; k < 3; k++) {
    double from = p->grid.lo[k] - P[k];
    d += N[k] * from;
    n1 += fabs(N[k]);
    r = fmax(r, fabs(from) + across);
    s = fmax(s, fabs(p->grid.lo[k]) + across);
  }
  double error =
      2 * (3 * world->mesh.n_error[f] * r + world->mesh.anchor_error[f] * n1) +
      0x1p-47 * n1 * r + 0x1p-50 * n1 * s + 0x1p-960;
  return (struct hsr_triage_plane){h * N[0], h * N[1], h * N[2], d, error};
}

static bool is_inside_plane(const struct hsr_solid_pyramid *p, uint32_t k,
                            const int voxel[3]) {
  struct hsr_cut half = p->half_space[k];
  double centre[3];
  for (int axis = 0; axis < 3; axis++)
    centre[axis] = hsr_voxel_centre(&p->grid, axis, voxel[axis]);
  bool inside = hsr_exact_displaced_plane_side(
                    hsr_plane_loop(world_of(p), half.face), centre,
                    &p->tally->out_of_memory) == half.side;
  HSR_STEP(p->tally, HSR_SOLID_EXACT, HSR_FACE(half.face),
           HSR_CELL(p->n_levels,
                    hsr_voxel_number(&p->grid, voxel[0], voxel[1], voxel[2]),
                    0),
           HSR_NOWHERE, inside);
  return inside;
}

/* --- Planes before cells -------------------------------------------------- */

/* The planes that cross a cell, of those in list[]: into the level's active[],
 * each with the subcells that it leaves surely inside. The polyhedron's masks;
 * false if the cell is outside. */
static bool compose(struct hsr_solid_pyramid *p, const struct cell *cell,
                    const uint32_t *list, uint32_t n, struct hsr_triage *mask) {
  struct hsr_solid_level *level = &p->level[cell->level];
  *mask = (struct hsr_triage){ALL, 0};
  level->n_active = 0;
  for (uint32_t k = 0; k < n; k++) {
    struct hsr_triage plane =
        hsr_solid_triage(&p->plane[list[k]], cell->corner, cell->size);
    HSR_STEP(p->tally, HSR_SOLID_MASK, HSR_FACE(p->half_space[list[k]].face),
             subject(p, cell), HSR_NOWHERE,
             plane.v == ALL   ? 0
             : plane.c == ALL ? 1
                              : 2);
    if (plane.v == ALL)
      return false;
    if (plane.c == ALL)
      continue;
    level->active[level->n_active] = list[k];
    level->inside[level->n_active++] = plane.c;
    mask->c &= plane.c;
    mask->v |= plane.v;
  }
  return true;
}

/* Of the active planes of a cell, those that are not surely inside in a
 * subcell. */
static uint32_t choose(const struct hsr_solid_level *level, int bit) {
  uint32_t n = 0;
  for (uint32_t k = 0; k < level->n_active; k++)
    if (!(level->inside[k] >> bit & 1))
      level->list[n++] = level->active[k];
  return n;
}

/* --- Tiling --------------------------------------------------------------- */

/* Tells that subcells are covered. */
static void cover(const struct hsr_solid_pyramid *p, const struct cell *cell,
                  uint64_t mask) {
  struct hsr_voxel_cubes cubes = {
      .grid = &p->grid,
      .solid = p->solid,
      .corner = {cell->corner[0], cell->corner[1], cell->corner[2]},
      .size = cell->size / 4,
      .mask = mask};
  HSR_ACCEPTED(p->tally, HSR_SOLID_COVERED, HSR_VOLUME(p->solid),
               subject(p, cell), HSR_NOWHERE, &cubes);
  p->cover(p->context, &cubes);
}

/* Of a finest cell the subcells are voxels, and those that are active are
 * decided exactly. */
static void decide(struct hsr_solid_pyramid *p, const struct cell *cell,
                   uint64_t active, struct hsr_triage *mask) {
  for (; active; active &= active - 1) {
    int bit = hsr_first_bit(active), voxel[3];
    uint32_t n = choose(&p->level[cell->level], bit);
    bool inside = true;
    corner_of(cell->corner, 1, bit, voxel);
    for (uint32_t k = 0; k < n && inside; k++)
      inside = is_inside_plane(p, p->level[cell->level].list[k], voxel);
    if (inside)
      mask->c |= (uint64_t)1 << bit;
  }
}

static void tile_finest(struct hsr_solid_pyramid *p, const struct cell *cell,
                        struct hsr_triage *mask) {
  uint64_t *covered = finest_of(p, cell);
  decide(p, cell, ~(mask->c | mask->v | *covered), mask);
  uint64_t w = mask->c & ~*covered;
  *covered |= w;
  if (w)
    cover(p, cell, w);
}

/* What was tiled in a subcell goes up to its cell. */
static void propagate(const struct hsr_solid_pyramid *p, const struct cell *sub,
                      uint64_t bit, struct hsr_triage *mask) {
  bool finest = is_finest(p, sub);
  uint64_t c = finest ? *finest_of(p, sub) : coarse_of(p, sub)->c;
  uint64_t v = finest ? ~c : coarse_of(p, sub)->v;
  if (c == ALL)
    mask->c |= bit;
  if (v != in_grid(p, sub))
    mask->v &= ~bit;
}

/* Listing 1. */
static void tile(struct hsr_solid_pyramid *p, const struct cell *cell,
                 const uint32_t *list, uint32_t n) {
  struct hsr_triage solid;
  HSR_STEP(p->tally, is_finest(p, cell) ? HSR_SOLID_FINEST : HSR_SOLID_CELL,
           subject(p, cell), HSR_VOLUME(p->solid), HSR_NOWHERE, 0);
  if (!compose(p, cell, list, n, &solid))
    return;
  if (is_finest(p, cell)) {
    tile_finest(p, cell, &solid);
    return;
  }
  struct hsr_triage *mask = coarse_of(p, cell);
  uint64_t w = mask->v & solid.c;
  mask->c |= w;
  mask->v &= ~w;
  if (w)
    cover(p, cell, w);
  for (uint64_t a = ~(w | solid.v | mask->c); a; a &= a - 1) {
    int bit = hsr_first_bit(a);
    struct cell sub = subcell(cell, bit);
    if (mask->v >> bit & 1)
      clear(p, &sub);
    uint32_t n_sub = choose(&p->level[cell->level], bit);
    tile(p, &sub, p->level[cell->level].list, n_sub);
    propagate(p, &sub, (uint64_t)1 << bit, mask);
  }
}

void hsr_solid_pyramid_tile(struct hsr_solid_pyramid *p, uint32_t v,
                            uint32_t solid, struct hsr_tally *tally) {
  uint32_t first = p->volumes->plane_start[v];
  uint32_t n = p->volumes->plane_start[v + 1] - first;
  struct cell root = root_of(p);
  p->solid = solid;
  p->tally = tally;
  p->half_space = p->volumes->plane + first;
  for (uint32_t k = 0; k < n; k++)
    p->plane[k] = plane_of(p, p->half_space[k]);
  tile(p, &root, p->all, n);
}
