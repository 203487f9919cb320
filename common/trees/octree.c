/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/trees/octree_build.h"
#include "common/base/numbers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const unsigned char hsr_octant_order[8] = {0, 1, 2, 4, 3, 5, 6, 7};

/* Limits of division, besides those of octree_build.h. Primitives that share a
 * point are never separated, and dividing does not help where most primitives
 * meet most octants. */
enum { DEEPEST = HSR_OCTREE_DEEPEST, MOST_COPIES = 3 };

static bool append(struct hsr_octree_list *list, uint32_t k) {
  if (list->n == list->room) {
    uint32_t room = list->room ? 2 * list->room : 32;
    uint32_t *grown = realloc(list->k, room * sizeof *grown);
    if (!grown)
      return false;
    list->k = grown;
    list->room = room;
  }
  list->k[list->n++] = k;
  return true;
}

struct hsr_octree_node hsr_octree_octant(const struct hsr_octree_node *cube,
                                         int octant) {
  struct hsr_octree_node node = {.half = cube->half / 2};
  for (int k = 0; k < 3; k++)
    node.centre[k] =
        cube->centre[k] + (octant >> k & 1 ? node.half : -node.half);
  memset(node.child, 0xff, sizeof node.child);
  node.tight = hsr_octree_cube(&node);
  return node;
}

int hsr_octant_that_holds(const struct hsr_octree_node *cube,
                          const struct hsr_box *box) {
  int octant = 0;
  for (int k = 0; k < 3; k++)
    if (box->lo[k] >= cube->centre[k] && box->hi[k] > cube->centre[k])
      octant |= 1 << k;
    else if (box->hi[k] > cube->centre[k])
      return -1;
  return octant;
}

/* The octants of a cube. Those below a median plane, and those above it, are in
 * one and the same range along its axis. */
static void find_octants(const struct hsr_octree_node *cube,
                         struct hsr_eight_boxes *boxes) {
  const struct hsr_octree_node first = hsr_octree_octant(cube, 0),
                               last = hsr_octree_octant(cube, 7);
  const struct hsr_box range[2] = {hsr_cube_box(&first), hsr_cube_box(&last)};
  for (int o = 0; o < 8; o++) {
    struct hsr_box box;
    for (int k = 0; k < 3; k++) {
      box.lo[k] = range[o >> k & 1].lo[k];
      box.hi[k] = range[o >> k & 1].hi[k];
    }
    hsr_put_box(boxes, o, &box);
  }
}

/* Which octants a box meets. *certain: each of them is met by every connected
 * set whose bounds the box is. That is so of a box within the cube that crosses
 * one median plane. */
static unsigned octants_of_box(const struct hsr_eight_boxes *boxes,
                               const struct hsr_box *box, bool *certain) {
  static const unsigned below[3] = {0x55, 0x33, 0x0f};
  unsigned octants = 0xff;
  int crossed = 0;
  bool within = true;
  for (int k = 0; k < 3; k++) {
    const double *lo = boxes->lo[k], *hi = boxes->hi[k];
    bool low = box->lo[k] <= hi[0] && lo[0] <= box->hi[k];
    bool high = box->lo[k] <= hi[7] && lo[7] <= box->hi[k];
    octants &= (low ? below[k] : 0) | (high ? 0xff & ~below[k] : 0);
    crossed += low && high;
    within &= lo[0] <= box->lo[k] && box->hi[k] <= hi[7];
  }
  *certain = within && crossed <= 1;
  return octants;
}

/* Puts a primitive into every octant that it meets. */
static bool push(const struct hsr_octree_builder *b,
                 const struct hsr_eight_boxes *boxes, uint32_t k,
                 struct hsr_octree_list *octants) {
  const struct hsr_primitives *p = b->primitives;
  bool certain;
  unsigned met = octants_of_box(boxes, &b->bounds[k], &certain);
  if (p->meets && !certain)
    met &= p->meets(p->context, k, boxes);
  for (; met; met &= met - 1)
    if (!append(&octants[__builtin_ctz(met)], k))
      return false;
  return true;
}

bool hsr_octree_part(const struct hsr_octree_builder *b,
                     const struct hsr_octree_node *cube,
                     const struct hsr_octree_list *list,
                     struct hsr_octree_list *own,
                     struct hsr_octree_list octants[8]) {
  double small = b->rule->small * 4 * cube->half * cube->half;
  struct hsr_eight_boxes boxes;
  find_octants(cube, &boxes);
  for (uint32_t i = 0; i < list->n; i++) {
    uint32_t k = list->k[i];
    int octant = hsr_octant_that_holds(cube, &b->bounds[k]);
    bool good = octant >= 0          ? append(&octants[octant], k)
                : b->area[k] < small ? push(b, &boxes, k, octants)
                                     : append(own, k);
    if (!good)
      return false;
  }
  return true;
}

uint64_t hsr_octree_count(const struct hsr_octree_list *own,
                          const struct hsr_octree_list octants[8]) {
  uint64_t n = own->n;
  for (int o = 0; o < 8; o++)
    n += octants[o].n;
  return n;
}

/* A primitive that is a cube's own before the call is in no octant. */
bool hsr_octree_give_back(const struct hsr_octree_builder *b, uint32_t stamp,
                          uint32_t n, double copies,
                          struct hsr_octree_list *own,
                          struct hsr_octree_list octants[8]) {
  double most = copies < MOST_COPIES ? copies : MOST_COPIES;
  bool helps = (double)hsr_octree_count(own, octants) <= most * n;
  for (int o = 0; o < 8; o++) {
    if (helps && octants[o].n >= b->rule->least)
      continue;
    for (uint32_t i = 0; i < octants[o].n; i++) {
      uint32_t k = octants[o].k[i];
      if (b->mark[k] != stamp && !append(own, k))
        return false;
      b->mark[k] = stamp;
    }
    octants[o].n = 0;
  }
  return true;
}

static struct hsr_octree_node *node_at(const struct hsr_octree_builder *b,
                                       uint32_t node) {
  return (struct hsr_octree_node *)b->node.items + node;
}

static bool keep_own(struct hsr_octree_builder *b, uint32_t node,
                     const struct hsr_octree_list *own) {
  node_at(b, node)->first = (uint32_t)b->item.n;
  node_at(b, node)->n = own->n;
  for (uint32_t i = 0; i < own->n; i++) {
    if (!hsr_arena_grow(b->arena, &b->item, sizeof(uint32_t)))
      return false;
    ((uint32_t *)b->item.items)[b->item.n - 1] = own->k[i];
  }
  return true;
}

static bool divide(struct hsr_octree_builder *b, uint32_t node,
                   const struct hsr_octree_node *cube,
                   const struct hsr_octree_list *list, double copies,
                   int depth) {
  struct hsr_octree_list own = {NULL, 0, 0}, octants[8] = {{NULL, 0, 0}};
  bool good =
      hsr_octree_part(b, cube, list, &own, octants) &&
      hsr_octree_give_back(b, node + 1, list->n, copies, &own, octants) &&
      keep_own(b, node, &own);
  double left = copies * list->n / (double)hsr_octree_count(&own, octants);
  free(own.k);
  for (int o = 0; o < 8; o++) {
    if (good && octants[o].n) {
      struct hsr_octree_node child = hsr_octree_octant(cube, o);
      uint32_t made;
      good = hsr_octree_build(b, &child, &octants[o], left, depth + 1, &made);
      if (good)
        node_at(b, node)->child[o] = made;
    }
    free(octants[o].k);
  }
  return good;
}

bool hsr_octree_build(struct hsr_octree_builder *b,
                      const struct hsr_octree_node *cube,
                      const struct hsr_octree_list *list, double copies,
                      int depth, uint32_t *made) {
  if (!hsr_arena_grow(b->arena, &b->node, sizeof *cube))
    return false;
  *made = (uint32_t)b->node.n - 1;
  *node_at(b, *made) = *cube;
  return list->n <= b->rule->most || depth == DEEPEST
             ? keep_own(b, *made, list)
             : divide(b, *made, cube, list, copies, depth);
}

void hsr_octree_look(struct hsr_octree_builder *b, uint32_t from, uint32_t to) {
  const struct hsr_primitives *p = b->primitives;
  for (uint32_t k = from; k < to; k++) {
    b->bounds[k] = p->bounds(p->context, k);
    b->area[k] = p->area(p->context, k);
  }
}

static bool list_primitives(const struct hsr_octree_builder *b,
                            struct hsr_octree_list *all) {
  bool good = true;
  for (uint32_t k = 0; k < b->primitives->n && good; k++)
    good = append(all, k);
  return good;
}

/* Because of rounding, a part of the primitives may be outside of the root's
 * cube. In that case the root becomes a cube around the centre of all, twice as
 * large as necessary. */
void hsr_octree_enclose(struct hsr_octree_node *root,
                        const struct hsr_box *bounds, uint32_t n) {
  struct hsr_box cube = hsr_cube_box(root), all = cube;
  for (uint32_t k = 0; k < n; k++)
    for (int a = 0; a < 3; a++) {
      all.lo[a] = hsr_min(all.lo[a], bounds[k].lo[a]);
      all.hi[a] = hsr_max(all.hi[a], bounds[k].hi[a]);
    }
  if (hsr_box_holds(&cube, &all))
    return;
  root->half = 0;
  for (int a = 0; a < 3; a++) {
    root->centre[a] = all.lo[a] / 2 + all.hi[a] / 2;
    root->half = hsr_max(root->half, all.hi[a] - all.lo[a]);
  }
}

/* Widens *all to hold the part of a box that is in the cube. */
static void add_box(struct hsr_box *all, const struct hsr_box *cube,
                    const struct hsr_box *box) {
  for (int k = 0; k < 3; k++) {
    double lo = box->lo[k] > cube->lo[k] ? box->lo[k] : cube->lo[k];
    double hi = box->hi[k] < cube->hi[k] ? box->hi[k] : cube->hi[k];
    all->lo[k] = lo < all->lo[k] ? lo : all->lo[k];
    all->hi[k] = hi > all->hi[k] ? hi : all->hi[k];
  }
}

static const struct hsr_box nothing = {{INFINITY, INFINITY, INFINITY},
                                       {-INFINITY, -INFINITY, -INFINITY}};

/* Rounding moves the middle and the halves by less than 2^-50 of the
 * coordinates. */
static void set_tight(struct hsr_octree_node *node, struct hsr_box *tight) {
  if (!(tight->lo[0] <= tight->hi[0]))
    *tight = hsr_cube_box(node);
  for (int a = 0; a < 3; a++) {
    node->tight.centre[a] = 0.5 * (tight->lo[a] + tight->hi[a]);
    node->tight.half[a] = 0.5 * (tight->hi[a] - tight->lo[a]);
  }
}

static void add_own(const uint32_t *item, const struct hsr_octree_node *node,
                    const struct hsr_box *bounds, struct hsr_box *tight) {
  struct hsr_box cube = hsr_cube_box(node);
  *tight = nothing;
  for (uint32_t i = 0; i < node->n; i++)
    add_box(tight, &cube, &bounds[item[node->first + i]]);
}

void hsr_octree_tighten(const struct hsr_octree *octree, uint32_t k,
                        const struct hsr_box *bounds, struct hsr_box *tight) {
  struct hsr_octree_node *node = &octree->node[k];
  struct hsr_box cube = hsr_cube_box(node);
  add_own(octree->item, node, bounds, &tight[k]);
  for (int o = 0; o < 8; o++)
    if (node->child[o] != HSR_NO_NODE)
      add_box(&tight[k], &cube, &tight[node->child[o]]);
  set_tight(node, &tight[k]);
}

struct hsr_octree_node hsr_octree_root(const double lo[3], double side) {
  struct hsr_octree_node root = {.half = side / 2};
  for (int k = 0; k < 3; k++)
    root.centre[k] = lo[k] + side / 2;
  memset(root.child, 0xff, sizeof root.child);
  return root;
}

static struct hsr_octree octree_of(const struct hsr_octree_builder *b) {
  return (struct hsr_octree){b->node.items, b->item.items, (uint32_t)b->node.n,
                             (uint32_t)b->item.n};
}

/* --- A lazy octree -------------------------------------------------------- */

static struct hsr_octree_builder
builder_of(const struct hsr_lazy_octree *lazy) {
  return (struct hsr_octree_builder){.primitives = &lazy->primitives,
                                     .rule = &lazy->rule,
                                     .bounds = lazy->bounds,
                                     .area = lazy->area,
                                     .mark = lazy->mark,
                                     .node = lazy->node,
                                     .item = lazy->item,
                                     .arena = lazy->arena};
}

static void take_back(struct hsr_lazy_octree *lazy,
                      const struct hsr_octree_builder *b) {
  lazy->node = b->node;
  lazy->item = b->item;
  lazy->octree = octree_of(b);
}

/* Appends a cube that is not divided, with the primitives of a list. Its
 * subtree may hold `copies` times as many. */
static bool hand_down(struct hsr_lazy_octree *lazy,
                      struct hsr_octree_builder *b,
                      const struct hsr_octree_node *cube,
                      const struct hsr_octree_list *list, double copies,
                      int depth) {
  struct hsr_box tight;
  if (!hsr_arena_grow(b->arena, &b->node, sizeof *cube) ||
      !hsr_arena_grow(b->arena, &lazy->state, sizeof(struct hsr_lazy_node)))
    return false;
  uint32_t k = (uint32_t)b->node.n - 1;
  struct hsr_octree_node *node = node_at(b, k);
  *node = *cube;
  if (!keep_own(b, k, list))
    return false;
  add_own(b->item.items, node, b->bounds, &tight);
  set_tight(node, &tight);
  ((struct hsr_lazy_node *)lazy->state.items)[k] = (struct hsr_lazy_node){
      .first = node->first, .n = node->n, .copies = copies, .depth = depth};
  return true;
}

enum hsr_status hsr_octree_begin(struct hsr_lazy_octree *lazy,
                                 const struct hsr_primitives *primitives,
                                 const struct hsr_octree_rule *rule,
                                 const double lo[3], double side,
                                 struct hsr_arena *arena) {
  uint32_t n = primitives->n;
  *lazy = (struct hsr_lazy_octree){.primitives = *primitives,
                                   .rule = *rule,
                                   .bounds = HSR_NEW(arena, struct hsr_box, n),
                                   .area = HSR_NEW(arena, double, n),
                                   .mark = HSR_NEW_ZEROED(arena, uint32_t, n),
                                   .arena = arena};
  struct hsr_octree_builder b = builder_of(lazy);
  struct hsr_octree_node root = hsr_octree_root(lo, side);
  struct hsr_octree_list all = {NULL, 0, 0};
  bool good = b.bounds && b.area && b.mark && list_primitives(&b, &all);
  if (good) {
    hsr_octree_look(&b, 0, n);
    hsr_octree_enclose(&root, b.bounds, n);
  }
  good = good && hand_down(lazy, &b, &root, &all, HSR_OCTREE_COPIES, 0);
  free(all.k);
  take_back(lazy, &b);
  return good ? HSR_OK : HSR_E_NOMEM;
}

enum hsr_status hsr_octree_divide(struct hsr_lazy_octree *lazy, uint32_t k) {
  struct hsr_octree_builder b = builder_of(lazy);
  struct hsr_lazy_node *state = (struct hsr_lazy_node *)lazy->state.items + k;
  struct hsr_octree_node cube = *node_at(&b, k);
  double copies = state->copies;
  int depth = state->depth;
  state->divided = true;
  if (cube.n <= b.rule->most || depth == DEEPEST)
    return HSR_OK;
  struct hsr_octree_list own = {NULL, 0, 0}, octants[8] = {{NULL, 0, 0}};
  struct hsr_octree_list list = {(uint32_t *)b.item.items + cube.first, cube.n,
                                 cube.n};
  bool good = hsr_octree_part(&b, &cube, &list, &own, octants) &&
              hsr_octree_give_back(&b, k + 1, list.n, copies, &own, octants) &&
              keep_own(&b, k, &own);
  double left = copies * list.n / (double)hsr_octree_count(&own, octants);
  free(own.k);
  for (int o = 0; o < 8; o++) {
    if (good && octants[o].n) {
      struct hsr_octree_node child = hsr_octree_octant(&cube, o);
      node_at(&b, k)->child[o] = (uint32_t)b.node.n;
      good = hand_down(lazy, &b, &child, &octants[o], left, depth + 1);
    }
    free(octants[o].k);
  }
  take_back(lazy, &b);
  return good ? HSR_OK : HSR_E_NOMEM;
}
