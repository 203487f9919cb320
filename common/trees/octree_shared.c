/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Octrees made by several threads.
 *
 * Method      cubes of many primitives are divided first, a level at a time.
 *             The lists of a level are cut into ranges, which threads divide at
 *             the same time. The rest are subtrees, each of which one thread
 *             makes in memory of its own. After that, the place of each subtree
 *             in the octree is known, and they are copied there.
 * Same        how a cube is divided depends on its list alone, and what the
 *             ranges of a list give is joined in their order. So the octree is
 *             that of hsr_octree_build, node by node, however many threads make
 *             it.
 * Notation    a top is a cube near the root, divided or a subtree. */
#include "common/trees/octree_build.h"

#include "common/base/share.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* The most primitives of a subtree, unless its root cannot be divided; and of a
 * range. */
enum { FEW = 2048, RANGE = 2048 };

struct top {
  struct hsr_octree_node cube;
  struct hsr_octree_list list; /* handed down to it; its own once it is
                                  divided */
  double copies;
  int depth;
  bool divided;
  uint32_t child[8]; /* if divided: tops, or HSR_NO_NODE */

  /* A subtree is in the memory of a thread. */
  int thread;
  uint32_t first_node, n_nodes, first_item, n_items;

  uint32_t node, item; /* where it begins in the octree */
};

/* A range of a top's list, and what it gives. */
struct piece {
  uint32_t top;
  struct hsr_range range;
  struct hsr_octree_list own, octants[8];
};

/* The memory of a thread. */
struct hand {
  struct hsr_octree_builder b;
  struct hsr_arena arena;
};

struct maker {
  struct hsr_octree_builder all; /* its nodes and items are unused */
  int threads;
  struct hsr_arena arena;
  struct hsr_growing top, piece;
  struct hand *hand;
  atomic_bool failed;
  struct hsr_octree *octree;
  struct hsr_box *tight; /* a node */
};

static struct top *top_at(const struct maker *m, uint32_t k) {
  return (struct top *)m->top.items + k;
}

static struct piece *piece_at(const struct maker *m, uint32_t k) {
  return (struct piece *)m->piece.items + k;
}

static void fail(struct maker *m) {
  atomic_store(&m->failed, true);
}

static bool add_top(struct maker *m, const struct hsr_octree_node *cube,
                    struct hsr_octree_list *list, double copies, int depth) {
  if (!hsr_arena_grow(&m->arena, &m->top, sizeof(struct top)))
    return false;
  struct top *top = top_at(m, (uint32_t)m->top.n - 1);
  *top = (struct top){
      .cube = *cube, .list = *list, .copies = copies, .depth = depth};
  *list = (struct hsr_octree_list){NULL, 0, 0}; /* it is the top's now */
  memset(top->child, 0xff, sizeof top->child);
  return true;
}

/* --- Cubes of many primitives --------------------------------------------- */

static bool is_large(const struct maker *m, const struct top *top) {
  return top->list.n > FEW && top->list.n > m->all.rule->most &&
         top->depth < HSR_OCTREE_DEEPEST;
}

/* Cuts the lists of tops from .. to - 1. */
static bool cut_lists(struct maker *m, uint32_t from, uint32_t to) {
  m->piece.n = 0;
  for (uint32_t t = from; t < to; t++) {
    uint32_t n = is_large(m, top_at(m, t)) ? top_at(m, t)->list.n : 0;
    for (uint32_t k = 0; k < hsr_n_ranges(n, RANGE); k++) {
      if (!hsr_arena_grow(&m->arena, &m->piece, sizeof(struct piece)))
        return false;
      *piece_at(m, (uint32_t)m->piece.n - 1) =
          (struct piece){.top = t, .range = hsr_range_of(n, RANGE, k)};
    }
  }
  return true;
}

static void part_piece(void *context, uint32_t k, int thread) {
  struct maker *m = context;
  struct piece *piece = piece_at(m, k);
  const struct top *top = top_at(m, piece->top);
  uint32_t n = piece->range.to - piece->range.from;
  struct hsr_octree_list list = {top->list.k + piece->range.from, n, n};
  (void)thread;
  if (!hsr_octree_part(&m->all, &top->cube, &list, &piece->own, piece->octants))
    fail(m);
}

static void free_lists(struct hsr_octree_list *list, int n) {
  for (int k = 0; k < n; k++)
    free(list[k].k);
}

static void free_pieces(struct maker *m) {
  for (uint32_t k = 0; k < m->piece.n; k++) {
    free_lists(&piece_at(m, k)->own, 1);
    free_lists(piece_at(m, k)->octants, 8);
  }
  m->piece.n = 0;
}

/* Joins the lists that pieces from .. to - 1 made for an octant; octant -1: for
 * the cube itself. */
static bool join(const struct maker *m, uint32_t from, uint32_t to, int octant,
                 struct hsr_octree_list *list) {
  uint32_t n = 0;
  for (uint32_t k = from; k < to; k++) {
    const struct piece *piece = piece_at(m, k);
    n += octant < 0 ? piece->own.n : piece->octants[octant].n;
  }
  *list = (struct hsr_octree_list){malloc((n + 1) * sizeof *list->k), 0, n + 1};
  for (uint32_t k = from; list->k && k < to; k++) {
    const struct piece *piece = piece_at(m, k);
    const struct hsr_octree_list *more =
        octant < 0 ? &piece->own : &piece->octants[octant];
    if (more->n)
      memcpy(list->k + list->n, more->k, more->n * sizeof *more->k);
    list->n += more->n;
  }
  return list->k;
}

/* Divides top t, whose list is cut into pieces from .. to - 1. */
static bool divide(struct maker *m, uint32_t t, uint32_t from, uint32_t to) {
  struct hsr_octree_list own, octants[8] = {{NULL, 0, 0}};
  const struct top given = *top_at(m, t);
  bool good = join(m, from, to, -1, &own);
  for (int o = 0; o < 8 && good; o++)
    good = join(m, from, to, o, &octants[o]);
  good = good && hsr_octree_give_back(&m->all, t + 1, given.list.n,
                                      given.copies, &own, octants);
  double left =
      given.copies * given.list.n / (double)hsr_octree_count(&own, octants);
  free(given.list.k);
  top_at(m, t)->list = own;
  top_at(m, t)->divided = true;
  for (int o = 0; o < 8 && good; o++) {
    struct hsr_octree_node cube = hsr_octree_octant(&given.cube, o);
    if (!octants[o].n)
      continue;
    top_at(m, t)->child[o] = (uint32_t)m->top.n;
    good = add_top(m, &cube, &octants[o], left, given.depth + 1);
  }
  free_lists(octants, 8);
  return good;
}

/* Divides the large ones among tops from .. to - 1. */
static bool divide_level(struct maker *m, uint32_t from, uint32_t to) {
  bool good = cut_lists(m, from, to);
  if (good)
    hsr_share(m->threads, (uint32_t)m->piece.n, part_piece, m);
  good = good && !atomic_load(&m->failed);
  for (uint32_t k = 0, last; k < m->piece.n && good; k = last) {
    uint32_t t = piece_at(m, k)->top;
    for (last = k + 1; last < m->piece.n && piece_at(m, last)->top == t;)
      last++;
    good = divide(m, t, k, last);
  }
  free_pieces(m);
  return good;
}

static bool divide_large(struct maker *m) {
  bool good = true;
  for (uint32_t from = 0, to; good && from < m->top.n; from = to) {
    to = (uint32_t)m->top.n;
    good = divide_level(m, from, to);
  }
  return good;
}

/* --- Subtrees ------------------------------------------------------------- */

/* A thread's memory, which it is the first to touch. */
static struct hsr_octree_builder *builder_of(struct maker *m, int thread) {
  struct hand *hand = &m->hand[thread];
  if (!hand->b.mark) {
    hand->b = m->all;
    hand->b.mark = calloc(m->all.primitives->n + (size_t)1, sizeof(uint32_t));
    hand->b.arena = &hand->arena;
  }
  return hand->b.mark ? &hand->b : NULL;
}

static void make_subtree(void *context, uint32_t k, int thread) {
  struct maker *m = context;
  struct top *top = top_at(m, k);
  uint32_t made;
  if (top->divided || atomic_load(&m->failed))
    return;
  struct hsr_octree_builder *b = builder_of(m, thread);
  if (!b) {
    fail(m);
    return;
  }
  top->thread = thread;
  top->first_node = (uint32_t)b->node.n;
  top->first_item = (uint32_t)b->item.n;
  if (!hsr_octree_build(b, &top->cube, &top->list, top->copies, top->depth,
                        &made))
    fail(m);
  top->n_nodes = (uint32_t)b->node.n - top->first_node;
  top->n_items = (uint32_t)b->item.n - top->first_item;
}

/* --- In order ------------------------------------------------------------- */

/* Finds where top k, and those below it, begin. */
static void place(struct maker *m, uint32_t k, uint64_t *n_nodes,
                  uint64_t *n_items) {
  struct top *top = top_at(m, k);
  top->node = (uint32_t)*n_nodes;
  top->item = (uint32_t)*n_items;
  *n_nodes += top->divided ? 1 : top->n_nodes;
  *n_items += top->divided ? top->list.n : top->n_items;
  for (int o = 0; o < 8; o++)
    if (top->child[o] != HSR_NO_NODE)
      place(m, top->child[o], n_nodes, n_items);
}

static void deliver_cube(struct maker *m, const struct top *top) {
  struct hsr_octree_node *node = &m->octree->node[top->node];
  *node = top->cube;
  node->first = top->item;
  node->n = top->list.n;
  for (int o = 0; o < 8; o++)
    if (top->child[o] != HSR_NO_NODE)
      node->child[o] = top_at(m, top->child[o])->node;
  if (node->n)
    memcpy(m->octree->item + top->item, top->list.k,
           node->n * sizeof *top->list.k);
}

static void deliver_subtree(struct maker *m, const struct top *top) {
  const struct hsr_octree_builder *b = &m->hand[top->thread].b;
  const struct hsr_octree_node *from =
      (const struct hsr_octree_node *)b->node.items + top->first_node;
  if (top->n_items)
    memcpy(m->octree->item + top->item,
           (const uint32_t *)b->item.items + top->first_item,
           top->n_items * sizeof(uint32_t));
  for (uint32_t k = top->n_nodes; k--;) {
    struct hsr_octree_node *node = &m->octree->node[top->node + k];
    *node = from[k];
    node->first += top->item - top->first_item;
    for (int o = 0; o < 8; o++)
      if (node->child[o] != HSR_NO_NODE)
        node->child[o] += top->node - top->first_node;
    hsr_octree_tighten(m->octree, top->node + k, m->all.bounds, m->tight);
  }
}

static void deliver(void *context, uint32_t k, int thread) {
  struct maker *m = context;
  const struct top *top = top_at(m, k);
  (void)thread;
  if (top->divided)
    deliver_cube(m, top);
  else
    deliver_subtree(m, top);
}

static bool put_in_order(struct maker *m, struct hsr_arena *arena) {
  uint64_t n_nodes = 0, n_items = 0;
  place(m, 0, &n_nodes, &n_items);
  if (n_nodes >= HSR_NO_NODE || n_items > UINT32_MAX)
    return false;
  *m->octree = (struct hsr_octree){
      HSR_NEW(arena, struct hsr_octree_node, n_nodes),
      HSR_NEW(arena, uint32_t, n_items), (uint32_t)n_nodes, (uint32_t)n_items};
  m->tight = malloc(n_nodes * sizeof *m->tight);
  if (!m->octree->node || !m->octree->item || !m->tight)
    return false;
  hsr_share(m->threads, (uint32_t)m->top.n, deliver, m);
  for (uint32_t k = (uint32_t)m->top.n; k--;) /* children before parents */
    if (top_at(m, k)->divided)
      hsr_octree_tighten(m->octree, top_at(m, k)->node, m->all.bounds,
                         m->tight);
  return true;
}

/* --- All of it ------------------------------------------------------------ */

static void look_at_range(void *context, uint32_t k, int thread) {
  struct maker *m = context;
  struct hsr_range range = hsr_range_of(m->all.primitives->n, RANGE, k);
  (void)thread;
  hsr_octree_look(&m->all, range.from, range.to);
}

static bool begin(struct maker *m, const double lo[3], double side) {
  uint32_t n = m->all.primitives->n;
  struct hsr_octree_node root = hsr_octree_root(lo, side);
  struct hsr_octree_list list = {malloc(((size_t)n + 1) * sizeof *list.k), n,
                                 n + 1};
  for (uint32_t k = 0; list.k && k < n; k++)
    list.k[k] = k;
  if (list.k) {
    hsr_share(m->threads, hsr_n_ranges(n, RANGE), look_at_range, m);
    hsr_octree_enclose(&root, m->all.bounds, n);
  }
  bool good = list.k && add_top(m, &root, &list, HSR_OCTREE_COPIES, 0);
  free(list.k);
  return good;
}

static void end(struct maker *m) {
  for (uint32_t k = 0; k < m->top.n; k++)
    free(top_at(m, k)->list.k);
  for (int k = 0; m->hand && k < m->threads; k++) {
    free(m->hand[k].b.mark);
    hsr_arena_free(&m->hand[k].arena);
  }
  free(m->hand);
  free(m->tight);
  free(m->all.bounds);
  free(m->all.area);
  free(m->all.mark);
  hsr_arena_free(&m->arena);
}

enum hsr_status hsr_octree_init(struct hsr_octree *octree,
                                const struct hsr_primitives *primitives,
                                const struct hsr_octree_rule *rule,
                                const double lo[3], double side, int threads,
                                struct hsr_arena *arena) {
  size_t n = primitives->n;
  struct maker m = {.all = {.primitives = primitives,
                            .rule = rule,
                            .bounds = malloc((n + 1) * sizeof *m.all.bounds),
                            .area = malloc((n + 1) * sizeof *m.all.area),
                            .mark = calloc(n + 1, sizeof *m.all.mark)},
                    .threads = hsr_threads(threads),
                    .octree = octree};
  *octree = (struct hsr_octree){.n_nodes = 0};
  m.hand = calloc((size_t)m.threads, sizeof *m.hand);
  bool good = m.all.bounds && m.all.area && m.all.mark && m.hand &&
              begin(&m, lo, side) && divide_large(&m);
  if (good)
    hsr_share(m.threads, (uint32_t)m.top.n, make_subtree, &m);
  good = good && !atomic_load(&m.failed) && put_in_order(&m, arena);
  end(&m);
  return good ? HSR_OK : HSR_E_NOMEM;
}
