/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Work that threads share out: every part is done once, by a thread that there
 * is. Octrees that several threads make are those of one recursion. */
#include "common/base/share.h"
#include "common/trees/octree_build.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

static const int crews[] = {1, 2, 3, 7, 16};
enum { CREWS = sizeof crews / sizeof *crews };

/* --- Parts ---------------------------------------------------------------- */

enum { PARTS = 5000 };

struct done {
  atomic_int times[PARTS];
  atomic_int at[HSR_MOST_THREADS]; /* parts that a thread is at */
  atomic_bool strange;
  int threads;
};

static void do_part(void *context, uint32_t k, int thread) {
  struct done *done = context;
  if (thread < 0 || thread >= done->threads ||
      atomic_fetch_add(&done->at[thread], 1))
    atomic_store(&done->strange, true);
  atomic_fetch_add(&done->times[k], 1);
  atomic_fetch_sub(&done->at[thread], 1);
}

static void test_parts(struct tap *tap) {
  static const uint32_t sizes[] = {0, 1, 2, 5, 63, PARTS};
  bool once = true, strange = false;
  for (int c = 0; c < CREWS; c++)
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
      static struct done done;
      memset(&done, 0, sizeof done);
      done.threads = crews[c];
      hsr_share(crews[c], sizes[s], do_part, &done);
      for (uint32_t k = 0; k < PARTS; k++)
        once &= atomic_load(&done.times[k]) == (k < sizes[s]);
      strange |= atomic_load(&done.strange);
    }
  ok(tap, once, "every part is done once");
  ok(tap, !strange, "by a thread that does one at a time");
}

static void test_ranges(struct tap *tap) {
  bool good = hsr_n_ranges(0, 7) == 0;
  for (uint32_t n = 1; n < 50; n++) {
    uint32_t next = 0;
    for (uint32_t k = 0; k < hsr_n_ranges(n, 7); k++) {
      struct hsr_range range = hsr_range_of(n, 7, k);
      good &= range.from == next && range.to > range.from &&
              range.to <= range.from + 7;
      next = range.to;
    }
    good &= next == n;
  }
  struct hsr_range last = hsr_range_of(UINT32_MAX, 4096, UINT32_MAX / 4096);
  ok(tap, good && last.to == UINT32_MAX,
     "ranges follow one another to the end");
}

/* Things of which some are bad: from a number on, every third. */
static uint32_t look(void *context, uint32_t from, uint32_t to) {
  const uint32_t *first = context;
  for (uint32_t k = from; k < to; k++)
    if (k >= *first && (k - *first) % 3 == 0)
      return k;
  return to;
}

static void test_search(struct tap *tap) {
  bool good = true;
  for (int c = 0; c < CREWS; c++)
    for (uint32_t first = 0; first < PARTS + 100; first += 37) {
      uint32_t found = hsr_share_search(crews[c], PARTS, 64, look, &first);
      good &= found == (first < PARTS ? first : PARTS);
    }
  ok(tap, good, "a search finds the first, or none");
}

static void test_bounds(struct tap *tap) {
  ok(tap,
     hsr_threads(0) == 1 && hsr_threads(-5) == 1 && hsr_threads(7) == 7 &&
         hsr_threads(1000) == HSR_MOST_THREADS,
     "at least one thread, and at most 64");
}

/* --- Octrees -------------------------------------------------------------- */

enum { N = 40000, SIDE = 1 << 14 };
static struct hsr_box box[N];

/* Boxes of many sizes, most of them in a small part of the cube. */
static void draw_boxes(uint64_t *seed, int64_t largest) {
  for (int k = 0; k < N; k++) {
    int64_t size = 1 + (largest >> draw_integer(seed, 0, 9));
    int64_t room = k % 4 ? SIDE / 16 : SIDE - 2 * largest;
    for (int a = 0; a < 3; a++) {
      box[k].lo[a] = (double)draw_integer(seed, 0, room);
      box[k].hi[a] = box[k].lo[a] + (double)draw_integer(seed, 0, size);
    }
  }
}

/* Slivers through the whole cube, side by side: each division doubles them, so
 * that as many copies are made as may be. */
static void draw_bundle(uint64_t *seed) {
  for (int k = 0; k < N; k++) {
    box[k] = (struct hsr_box){{0, 0, 0}, {SIDE, 0, 0}};
    for (int a = 1; a < 3; a++) {
      box[k].lo[a] = (double)draw_integer(seed, 0, SIDE / HSR_OCTREE_COPIES);
      box[k].hi[a] = box[k].lo[a] + 1;
    }
  }
}

static struct hsr_box bounds_of(const void *context, uint32_t k) {
  (void)context;
  return box[k];
}

static double area_of(const void *context, uint32_t k) {
  (void)context;
  double a = box[k].hi[0] - box[k].lo[0], b = box[k].hi[1] - box[k].lo[1];
  return a * b;
}

static const struct hsr_primitives boxes = {N, NULL, bounds_of, area_of, NULL};
static const double lo[3] = {0, 0, 0};

/* The octree of one recursion. */
static struct hsr_octree recurse(const struct hsr_octree_rule *rule,
                                 struct hsr_arena *arena) {
  static uint32_t all[N], mark[N];
  static struct hsr_box bounds[N];
  static double area[N];
  struct hsr_octree_builder b = {.primitives = &boxes,
                                 .rule = rule,
                                 .bounds = bounds,
                                 .area = area,
                                 .mark = mark,
                                 .arena = arena};
  struct hsr_octree_list list = {all, N, N};
  struct hsr_octree_node root = hsr_octree_root(lo, SIDE);
  uint32_t made;
  for (uint32_t k = 0; k < N; k++)
    all[k] = k;
  memset(mark, 0, sizeof mark);
  hsr_octree_look(&b, 0, N);
  if (!hsr_octree_build(&b, &root, &list, HSR_OCTREE_COPIES, 0, &made))
    abort();
  struct hsr_octree octree = {b.node.items, b.item.items, (uint32_t)b.node.n,
                              (uint32_t)b.item.n};
  struct hsr_box *tight = calloc(octree.n_nodes, sizeof *tight);
  for (uint32_t k = octree.n_nodes; k-- && tight;)
    hsr_octree_tighten(&octree, k, bounds, tight);
  free(tight);
  return octree;
}

static bool are_same(const struct hsr_octree *a, const struct hsr_octree *b) {
  if (a->n_nodes != b->n_nodes || a->n_items != b->n_items ||
      memcmp(a->item, b->item, a->n_items * sizeof *a->item))
    return false;
  for (uint32_t k = 0; k < a->n_nodes; k++) {
    const struct hsr_octree_node *x = &a->node[k], *y = &b->node[k];
    if (memcmp(x->centre, y->centre, sizeof x->centre) || x->half != y->half ||
        memcmp(&x->tight, &y->tight, sizeof x->tight) ||
        memcmp(x->child, y->child, sizeof x->child) || x->first != y->first ||
        x->n != y->n)
      return false;
  }
  return true;
}

static void test_octrees(struct tap *tap, uint64_t *seed) {
  static const struct hsr_octree_rule rules[] = {
      {0.1, 20, 20}, {1, 8, 1},       {0, 3, 1},
      {1e9, 5, 30},  {1, 3000, 1500}, {1e9, 3000, 1}};
  for (size_t r = 0; r < sizeof rules / sizeof *rules; r++) {
    struct hsr_arena arena = HSR_ARENA_EMPTY;
    bool same = true;
    if (r == 5)
      draw_bundle(seed);
    else
      draw_boxes(seed, r == 3 ? SIDE / 2 : 256);
    struct hsr_octree wanted = recurse(&rules[r], &arena);
    for (int c = 0; c < CREWS; c++) {
      struct hsr_arena own = HSR_ARENA_EMPTY;
      struct hsr_octree got;
      if (hsr_octree_init(&got, &boxes, &rules[r], lo, SIDE, crews[c], &own))
        abort();
      same &= are_same(&wanted, &got);
      hsr_arena_free(&own);
    }
    ok(tap, same,
       "octree %zu of %u cubes is the same by 1, 2, 3, 7, 16 threads", r,
       wanted.n_nodes);
    hsr_arena_free(&arena);
  }
}

int main(void) {
  struct tap tap = plan(5 + 6);
  uint64_t seed = 11;
  test_parts(&tap);
  test_ranges(&tap);
  test_search(&tap);
  test_bounds(&tap);
  test_octrees(&tap, &seed);
  return finish(&tap);
}
