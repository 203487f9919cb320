/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/hierarchical/culling/portals.h"
#include "common/base/numbers.h"

#include <math.h>
#include <stdlib.h>

/* A plane divides a node if walls cover this part of the node's section, at
 * least; and nodes are divided so often at most. */
static const double COVERED = 0.25;
enum { DEEPEST = 40, MOST_CELLS = 1500, MOST_PIECES = 64 };

struct wall {
  struct hsr_box box;
  int axis;
};

struct maker {
  struct hsr_portals *p;
  const struct hsr_world *world;
  struct wall *wall; /* sorted by axis and place */
  uint32_t n_walls;
  struct hsr_growing node, cell, portal;
  bool out_of_memory;
};

static struct hsr_box box_of_face(const struct hsr_world *world, uint32_t f) {
  struct hsr_loop loop = hsr_face_loop(world, f);
  struct hsr_box box = {{INFINITY, INFINITY, INFINITY},
                        {-INFINITY, -INFINITY, -INFINITY}};
  for (uint32_t c = 0; c < loop.n; c++) {
    uint32_t v = loop.vertex[c];
    const double at[3] = {loop.x[v], loop.y[v], loop.z[v]};
    for (int k = 0; k < 3; k++) {
      box.lo[k] = hsr_min(box.lo[k], at[k]);
      box.hi[k] = hsr_max(box.hi[k], at[k]);
    }
  }
  return box;
}

/* --- Walls ---------------------------------------------------------------- */

/* The corners of the rectangle around a face that the face has, in its own
 * order, as sums of bits: bit k, if it is at the upper bound of axis k. False if
 * the face is seen from one side only, or not flat, or not across an axis, or
 * has another vertex. */
static bool find_corners(const struct hsr_world *world, uint32_t f,
                         struct wall *wall, int corner[4]) {
  struct hsr_loop loop = hsr_face_loop(world, f);
  if (loop.n > 4 || world->mesh.one_sided[f] || world->mesh.deviation[f] > 0)
    return false;
  wall->box = box_of_face(world, f);
  wall->axis = -1;
  for (int k = 0; k < 3; k++)
    if (wall->box.lo[k] == wall->box.hi[k])
      wall->axis = wall->axis < 0 ? k : 3;
  if (wall->axis < 0 || wall->axis > 2)
    return false;
  for (uint32_t c = 0; c < loop.n; c++) {
    uint32_t v = loop.vertex[c];
    const double at[3] = {loop.x[v], loop.y[v], loop.z[v]};
    corner[c] = 0;
    for (int k = 0; k < 3; k++) {
      if (at[k] != wall->box.lo[k] && at[k] != wall->box.hi[k])
        return false;
      corner[c] |= (k != wall->axis && at[k] == wall->box.hi[k]) << k;
    }
  }
  return true;
}

/* Opposite corners follow each other at every other place. */
static bool is_rectangle(const struct wall *wall, const int corner[4]) {
  int all = 7 & ~(1 << wall->axis);
  return (corner[0] ^ corner[2]) == all && (corner[1] ^ corner[3]) == all &&
         corner[0] != corner[1] && corner[0] != corner[3];
}

/* Two triangles that are halves of one rectangle lack opposite corners. The sum
 * of all four corners is 0 by bits, so the one that is lacking is that of the
 * others. */
static bool are_halves(const struct wall *a, const int corner_a[4],
                       const struct wall *b, const int corner_b[4]) {
  int all = 7 & ~(1 << a->axis);
  bool same = a->axis == b->axis;
  for (int k = 0; k < 3; k++)
    same &= a->box.lo[k] == b->box.lo[k] && a->box.hi[k] == b->box.hi[k];
  for (int c = 0; c < 3; c++)
    same &= corner_a[c] != corner_a[(c + 1) % 3] &&
            corner_b[c] != corner_b[(c + 1) % 3];
  return same && ((corner_a[0] ^ corner_a[1] ^ corner_a[2]) ^
                  (corner_b[0] ^ corner_b[1] ^ corner_b[2])) == all;
}

/* Whether face f is a wall, or it and the next face are. */
static bool is_wall(const struct hsr_world *world, uint32_t f,
                    struct wall *wall) {
  struct wall other;
  int a[4], b[4];
  if (!find_corners(world, f, wall, a))
    return false;
  if (hsr_face_size(world, f) == 4)
    return is_rectangle(wall, a);
  return f + 1 < world->n_faces && hsr_face_size(world, f + 1) == 3 &&
         find_corners(world, f + 1, &other, b) &&
         are_halves(wall, a, &other, b);
}

static int by_place(const void *p, const void *q) {
  const struct wall *a = p, *b = q;
  if (a->axis != b->axis)
    return a->axis - b->axis;
  double x = a->box.lo[a->axis], y = b->box.lo[b->axis];
  return (x > y) - (x < y);
}

/* --- The k-d tree --------------------------------------------------------- */

/* The area that a wall has within a box, both cut to the scene's bounds. */
static double area_within(const struct wall *wall, const struct hsr_box *box) {
  double area = 1;
  for (int k = 0; k < 3; k++)
    if (k != wall->axis)
      area *= hsr_max(0, hsr_min(wall->box.hi[k], box->hi[k]) -
                             hsr_max(wall->box.lo[k], box->lo[k]));
  return area;
}

static double section(const struct hsr_box *box, int axis) {
  double area = 1;
  for (int k = 0; k < 3; k++)
    if (k != axis)
      area *= box->hi[k] - box->lo[k];
  return area;
}

/* The plane within the box that walls cover most; the part that they cover. */
static double best_plane(const struct maker *m, const struct hsr_box *box,
                         int *axis, double *at) {
  double best = 0, covered = 0;
  for (uint32_t k = 0; k < m->n_walls; k++) {
    const struct wall *wall = &m->wall[k];
    double place = wall->box.lo[wall->axis];
    bool same = k && m->wall[k - 1].axis == wall->axis &&
                m->wall[k - 1].box.lo[wall->axis] == place;
    covered = same ? covered : 0;
    if (!(place > box->lo[wall->axis] && place < box->hi[wall->axis]))
      continue;
    covered += area_within(wall, box);
    double part = covered / section(box, wall->axis);
    if (part > best) {
      best = part;
      *axis = wall->axis;
      *at = place;
    }
  }
  return best;
}

/* Divides the part `box` of the scene; `whole` is the same, but infinite at the
 * outside. Returns the node. */
static uint32_t divide(struct maker *m, struct hsr_box box,
                       struct hsr_box whole, int depth) {
  struct hsr_portal_node node = {.axis = -1};
  if (!hsr_arena_grow(&m->p->arena, &m->node, sizeof node)) {
    m->out_of_memory = true;
    return 0;
  }
  uint32_t k = (uint32_t)m->node.n - 1;
  if (depth < DEEPEST && m->cell.n + (size_t)depth < MOST_CELLS &&
      best_plane(m, &box, &node.axis, &node.at) >= COVERED) {
    for (int s = 0; s < 2; s++) {
      struct hsr_box part = box, whole_part = whole;
      *(s ? &part.lo[node.axis] : &part.hi[node.axis]) = node.at;
      *(s ? &whole_part.lo[node.axis] : &whole_part.hi[node.axis]) = node.at;
      node.child[s] = divide(m, part, whole_part, depth + 1);
    }
  } else {
    node.axis = -1;
    node.cell = (uint32_t)m->cell.n;
    if (!hsr_arena_grow(&m->p->arena, &m->cell, sizeof whole)) {
      m->out_of_memory = true;
      return 0;
    }
    ((struct hsr_box *)m->cell.items)[node.cell] = whole;
  }
  ((struct hsr_portal_node *)m->node.items)[k] = node;
  return k;
}

static enum hsr_status build_tree(struct maker *m) {
  struct hsr_box all = {{INFINITY, INFINITY, INFINITY},
                        {-INFINITY, -INFINITY, -INFINITY}};
  const struct hsr_box everywhere = {{-INFINITY, -INFINITY, -INFINITY},
                                     {INFINITY, INFINITY, INFINITY}};
  for (uint32_t f = 0; f < m->world->n_faces; f++) {
    struct hsr_box box = box_of_face(m->world, f);
    for (int k = 0; k < 3; k++) {
      all.lo[k] = hsr_min(all.lo[k], box.lo[k]);
      all.hi[k] = hsr_max(all.hi[k], box.hi[k]);
    }
  }
  /* Also outer walls divide: those at the bounds of the scene. */
  for (int k = 0; k < 3; k++) {
    double more = 0.01 * (all.hi[k] - all.lo[k]);
    all.lo[k] -= more;
    all.hi[k] += more;
  }
  divide(m, all, everywhere, 0);
  m->p->node = m->node.items;
  m->p->n_nodes = (uint32_t)m->node.n;
  m->p->cell = m->cell.items;
  m->p->n_cells = (uint32_t)m->cell.n;
  return m->out_of_memory ? HSR_E_NOMEM : HSR_OK;
}

void hsr_portals_find(const struct hsr_portals *portals,
                      const struct hsr_box *box,
                      void (*visit)(void *context, uint32_t cell),
                      void *context) {
  uint32_t waiting[DEEPEST + 2], n = 0;
  waiting[n++] = 0;
  while (n) {
    const struct hsr_portal_node *node = &portals->node[waiting[--n]];
    if (node->axis < 0) {
      visit(context, node->cell);
      continue;
    }
    if (box->lo[node->axis] <= node->at)
      waiting[n++] = node->child[0];
    if (box->hi[node->axis] >= node->at)
      waiting[n++] = node->child[1];
  }
}

/* --- Portals -------------------------------------------------------------- */

/* Cuts a wall out of a rectangle: what is left of it, 0 to 4 rectangles. */
static int cut_out(const struct hsr_box *from, const struct wall *wall,
                   struct hsr_box *left) {
  struct hsr_box rest = *from;
  int n = 0;
  for (int k = 0; k < 3; k++)
    if (k != wall->axis &&
        !(wall->box.lo[k] < from->hi[k] && wall->box.hi[k] > from->lo[k])) {
      left[0] = *from;
      return 1;
    }
  for (int k = 0; k < 3; k++) {
    if (k == wall->axis)
      continue;
    if (wall->box.lo[k] > rest.lo[k]) {
      left[n] = rest;
      left[n++].hi[k] = wall->box.lo[k];
      rest.lo[k] = wall->box.lo[k];
    }
    if (wall->box.hi[k] < rest.hi[k]) {
      left[n] = rest;
      left[n++].lo[k] = wall->box.hi[k];
      rest.hi[k] = wall->box.hi[k];
    }
  }
  return n;
}

static void add_portal(struct maker *m, const struct hsr_box *box, int axis,
                       uint32_t below, uint32_t above) {
  if (!hsr_arena_grow(&m->p->arena, &m->portal, sizeof(struct hsr_portal))) {
    m->out_of_memory = true;
    return;
  }
  ((struct hsr_portal *)m->portal.items)[m->portal.n - 1] =
      (struct hsr_portal){*box, axis, {below, above}};
}

/* The first wall on that plane, or after it. */
static uint32_t first_wall(const struct maker *m, int axis, double at) {
  uint32_t low = 0, high = m->n_walls;
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    const struct wall *wall = &m->wall[middle];
    if (wall->axis < axis || (wall->axis == axis && wall->box.lo[axis] < at))
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

/* What no wall covers of the rectangle that two cells share. */
static void add_openings(struct maker *m, const struct hsr_box *shared,
                         int axis, uint32_t below, uint32_t above) {
  struct hsr_box piece[2][4 * MOST_PIECES];
  int n = 1, now = 0;
  piece[0][0] = *shared;
  for (uint32_t k = first_wall(m, axis, shared->lo[axis]);
       k < m->n_walls && n && n < MOST_PIECES; k++) {
    const struct wall *wall = &m->wall[k];
    if (wall->axis != axis || wall->box.lo[axis] != shared->lo[axis])
      break;
    int left = 0;
    for (int c = 0; c < n; c++)
      left += cut_out(&piece[now][c], wall, &piece[!now][left]);
    now = !now;
    n = left;
  }
  for (int c = 0; c < n; c++)
    add_portal(m, &piece[now][c], axis, below, above);
}

static void find_portals(struct maker *m) {
  const struct hsr_portals *p = m->p;
  for (uint32_t a = 0; a < p->n_cells; a++)
    for (uint32_t b = 0; b < p->n_cells; b++)
      for (int axis = 0; axis < 3; axis++) {
        if (p->cell[a].hi[axis] != p->cell[b].lo[axis] ||
            isinf(p->cell[a].hi[axis]))
          continue;
        struct hsr_box shared;
        bool meet = true;
        for (int k = 0; k < 3; k++) {
          shared.lo[k] = hsr_max(p->cell[a].lo[k], p->cell[b].lo[k]);
          shared.hi[k] = hsr_min(p->cell[a].hi[k], p->cell[b].hi[k]);
          meet &= k == axis || shared.lo[k] < shared.hi[k];
        }
        if (meet)
          add_openings(m, &shared, axis, a, b);
      }
  m->p->portal = m->portal.items;
  m->p->n_portals = (uint32_t)m->portal.n;
}

/* --- What belongs to a cell ----------------------------------------------- */

static enum hsr_status list_portals(struct hsr_portals *p) {
  p->first_portal = HSR_NEW_ZEROED(&p->arena, uint32_t, (size_t)p->n_cells + 2);
  p->of_cell = HSR_NEW(&p->arena, uint32_t, 2 * (size_t)p->n_portals);
  if (!p->first_portal || !p->of_cell)
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < p->n_portals; k++)
    for (int s = 0; s < 2; s++)
      p->first_portal[p->portal[k].cell[s] + 2]++;
  for (uint32_t c = 0; c < p->n_cells; c++)
    p->first_portal[c + 2] += p->first_portal[c + 1];
  for (uint32_t k = 0; k < p->n_portals; k++)
    for (int s = 0; s < 2; s++)
      p->of_cell[p->first_portal[p->portal[k].cell[s] + 1]++] = k;
  return HSR_OK;
}

/* Counts the faces of cells, or lists them. */
struct lister {
  struct hsr_portals *p;
  uint32_t f;
};

static void count_face(void *context, uint32_t cell) {
  struct lister *l = context;
  l->p->first_face[cell + 2]++;
}

static void list_face(void *context, uint32_t cell) {
  struct lister *l = context;
  l->p->face[l->p->first_face[cell + 1]++] = l->f;
}

static void for_each_flat(struct maker *m, void (*visit)(void *, uint32_t)) {
  struct lister lister = {m->p, 0};
  for (uint32_t f = 0; f < m->world->n_faces; f++) {
    struct hsr_box box = box_of_face(m->world, f);
    lister.f = f;
    if (!(m->world->mesh.deviation[f] > 0))
      hsr_portals_find(m->p, &box, visit, &lister);
  }
}

static enum hsr_status list_faces(struct maker *m) {
  struct hsr_portals *p = m->p;
  p->first_face = HSR_NEW_ZEROED(&p->arena, uint32_t, (size_t)p->n_cells + 2);
  p->loose = HSR_NEW(&p->arena, uint32_t, m->world->n_faces);
  if (!p->first_face || !p->loose)
    return HSR_E_NOMEM;
  for_each_flat(m, count_face);
  for (uint32_t c = 0; c < p->n_cells; c++)
    p->first_face[c + 2] += p->first_face[c + 1];
  p->face = HSR_NEW(&p->arena, uint32_t, p->first_face[p->n_cells + 1]);
  if (!p->face)
    return HSR_E_NOMEM;
  for_each_flat(m, list_face);
  for (uint32_t f = 0; f < m->world->n_faces; f++)
    if (m->world->mesh.deviation[f] > 0)
      p->loose[p->n_loose++] = f;
  return HSR_OK;
}

enum hsr_status hsr_portals_init(struct hsr_portals *portals,
                                 const struct hsr_world *world) {
  struct maker m = {.p = portals, .world = world};
  *portals = (struct hsr_portals){.n_cells = 0};
  m.wall = malloc(((size_t)world->n_faces + 1) * sizeof *m.wall);
  if (!m.wall)
    return HSR_E_NOMEM;
  for (uint32_t f = 0; f < world->n_faces; f++)
    m.n_walls += is_wall(world, f, &m.wall[m.n_walls]);
  qsort(m.wall, m.n_walls, sizeof *m.wall, by_place);
  enum hsr_status status = build_tree(&m);
  if (!status)
    find_portals(&m);
  free(m.wall);
  if (status || m.out_of_memory || list_portals(portals) || list_faces(&m))
    return HSR_E_NOMEM;
  return HSR_OK;
}

void hsr_portals_free(struct hsr_portals *portals) {
  hsr_arena_free(&portals->arena);
}
