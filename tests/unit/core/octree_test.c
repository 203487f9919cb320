/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Octrees of random triangles, against section 3.3.1 of Greene's thesis. All
 * coordinates are integers, so nothing is rounded: separating axes in integers
 * decide what a triangle meets. That has nothing in common with
 * common/trees/box.h. */
#include "algorithms/engines/cubes/cube_frame.h"
#include "common/trees/grain.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N = 3000, SIDE = 1 << 14, STEP = 1 << 6 };

/* Triangle k: corner[k][0..2]. */
static double corner[N][3][3];

static struct hsr_box bounds_of(const void *context, uint32_t k) {
  struct hsr_box box;
  (void)context;
  for (int a = 0; a < 3; a++) {
    const double *x = &corner[k][0][a];
    box.lo[a] = fmin(x[0], fmin(x[3], x[6]));
    box.hi[a] = fmax(x[0], fmax(x[3], x[6]));
  }
  return box;
}

static void normal_of(uint32_t k, double normal[3]) {
  double d[2][3];
  for (int a = 0; a < 3; a++) {
    d[0][a] = corner[k][1][a] - corner[k][0][a];
    d[1][a] = corner[k][2][a] - corner[k][0][a];
  }
  for (int a = 0, b = 1, c = 2; a < 3; a++, b = (b + 1) % 3, c = (c + 1) % 3)
    normal[a] = d[0][b] * d[1][c] - d[0][c] * d[1][b];
}

static double area_of(const void *context, uint32_t k) {
  double n[3];
  (void)context;
  normal_of(k, n);
  return 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

static unsigned meets(const void *context, uint32_t k,
                      const struct hsr_eight_boxes *boxes) {
  static const uint32_t vertex[] = {0, 1, 2};
  const double *x = corner[k][0];
  struct hsr_loop loop = {x, x + 1, x + 2, 3, vertex, 3};
  double n[3];
  (void)context;
  normal_of(k, n);
  return hsr_boxes_that_meet_polygon(boxes, loop, n, 0);
}

static const struct hsr_primitives triangles = {N, NULL, bounds_of, area_of,
                                                meets};

/* Does the axis separate the triangle from the box of that centre and half? */
static bool parts(const int64_t axis[3], const int64_t t[3][3],
                  const int64_t half[3]) {
  int64_t reach = 0, lo = INT64_MAX, hi = INT64_MIN;
  for (int a = 0; a < 3; a++)
    reach += llabs(axis[a]) * half[a];
  for (int c = 0; c < 3; c++) {
    int64_t at = axis[0] * t[c][0] + axis[1] * t[c][1] + axis[2] * t[c][2];
    lo = at < lo ? at : lo;
    hi = at > hi ? at : hi;
  }
  return lo > reach || hi < -reach;
}

static void cross(const int64_t u[3], const int64_t v[3], int64_t w[3]) {
  for (int a = 0, b = 1, c = 2; a < 3; a++, b = (b + 1) % 3, c = (c + 1) % 3)
    w[a] = u[b] * v[c] - u[c] * v[b];
}

/* Whether they meet, exactly: the thirteen axes. */
static bool truly_meets(uint32_t k, const struct hsr_octree_node *cube) {
  int64_t t[3][3], edge[3][3], axis[3], half[3];
  for (int a = 0; a < 3; a++) {
    half[a] = (int64_t)cube->half;
    for (int c = 0; c < 3; c++)
      t[c][a] = (int64_t)(corner[k][c][a] - cube->centre[a]);
  }
  for (int c = 0; c < 3; c++)
    for (int a = 0; a < 3; a++)
      edge[c][a] = t[(c + 1) % 3][a] - t[c][a];
  cross(edge[0], edge[1], axis);
  if (parts(axis, t, half))
    return false;
  for (int a = 0; a < 3; a++) {
    int64_t unit[3] = {a == 0, a == 1, a == 2};
    if (parts(unit, t, half))
      return false;
    for (int c = 0; c < 3; c++) {
      cross(unit, edge[c], axis);
      if (parts(axis, t, half))
        return false;
    }
  }
  return true;
}

/* Triangles of all sizes up to `largest`, some in planes of the grid. */
static void draw_triangles(uint64_t *seed, int64_t largest) {
  for (int k = 0; k < N; k++) {
    int64_t size = (largest >> draw_integer(seed, 0, 5)) + 1;
    int flat = (int)draw_integer(seed, 0, 8);
    for (int a = 0; a < 3; a++) {
      int64_t lo = draw_integer(seed, 0, SIDE / STEP - size);
      for (int c = 0; c < 3; c++)
        corner[k][c][a] =
            (double)(STEP *
                     (lo + (a == flat ? 0 : draw_integer(seed, 0, size))));
    }
    /* No triangle is a point: that would have no smallest cube. */
    int wide = flat == 0;
    corner[k][1][wide] =
        corner[k][0][wide] + (corner[k][0][wide] < SIDE / 2 ? STEP : -STEP);
  }
}

static struct hsr_octree build(const struct hsr_octree_rule *rule,
                               const struct hsr_primitives *primitives,
                               struct hsr_arena *arena) {
  static const double lo[3] = {0, 0, 0};
  struct hsr_octree octree;
  if (hsr_octree_init(&octree, primitives, rule, lo, SIDE, 1, arena))
    bail("out of memory");
  return octree;
}

static const uint32_t *items_of(const struct hsr_octree *octree, uint32_t k) {
  return octree->item + octree->node[k].first;
}

/* --- The smallest enclosing cube ------------------------------------------ */

/* The depth of the smallest cube that encloses a triangle; the cube's side is
 * SIDE / 2^depth. Among cubes of that side the triangle begins and ends in the
 * same one, in every coordinate. */
static int smallest_depth(uint32_t k) {
  struct hsr_box box = bounds_of(NULL, k);
  int depth = -1;
  for (bool fits = true; fits && depth < 30;) {
    double side = ldexp(SIDE, -++depth - 1);
    for (int a = 0; a < 3; a++)
      fits &= fmax(ceil(box.hi[a] / side) - 1, 0) * side <= box.lo[a];
  }
  return depth;
}

/* Is every triangle of the subtree at depth d, stored once, in its smallest
 * cube, or in the smallest that is divided? */
static bool is_enclosing(const struct hsr_octree *octree, uint32_t k, int depth,
                         uint32_t *stored) {
  const struct hsr_octree_node *node = &octree->node[k];
  struct hsr_box cube = hsr_cube_box(node);
  bool good = node->half == ldexp(SIDE, -depth - 1);
  for (uint32_t i = 0; i < node->n; i++) {
    uint32_t t = items_of(octree, k)[i];
    struct hsr_box box = bounds_of(NULL, t);
    good &= hsr_box_holds(&cube, &box) && smallest_depth(t) == depth;
    stored[t]++;
  }
  for (int o = 0; o < 8; o++)
    if (node->child[o] != HSR_NO_NODE)
      good &= is_enclosing(octree, node->child[o], depth + 1, stored);
  return good;
}

static void test_enclosing(struct tap *tap, uint64_t *seed) {
  static const struct hsr_octree_rule rule = {0, 0, 1};
  bool enclosing = true, once = true;
  uint32_t deepest = 0;
  for (int64_t largest = 4; largest <= 128; largest *= 2) {
    struct hsr_arena arena = HSR_ARENA_EMPTY;
    uint32_t stored[N] = {0};
    draw_triangles(seed, largest);
    struct hsr_octree octree = build(&rule, &triangles, &arena);
    enclosing &= is_enclosing(&octree, 0, 0, stored);
    for (int k = 0; k < N; k++)
      once &= stored[k] == 1;
    once &= octree.n_items == N;
    deepest = octree.n_nodes > deepest ? octree.n_nodes : deepest;
    hsr_arena_free(&arena);
  }
  ok(tap, enclosing && deepest > N / 2,
     "enclosing: each triangle is in the smallest cube that holds it");
  ok(tap, once, "enclosing: each is in one cube, once");
}

/* --- Pushed into the octants that it meets -------------------------------- */

struct found {
  bool meets, distinct, cut;    /* what each cube holds; how it is divided */
  uint32_t least, most, copies; /* the fewest in a cube below the root; the most
                                   in a leaf; all */
};

/* Marks in in[] the triangles in a subtree. */
static uint32_t mark_subtree(const struct hsr_octree *octree, uint32_t k,
                             bool *in) {
  const struct hsr_octree_node *node = &octree->node[k];
  uint32_t n = 0;
  for (uint32_t i = 0; i < node->n; i++) {
    uint32_t t = items_of(octree, k)[i];
    n += !in[t];
    in[t] = true;
  }
  for (int o = 0; o < 8; o++)
    if (node->child[o] != HSR_NO_NODE)
      n += mark_subtree(octree, node->child[o], in);
  return n;
}

/* Does a node's tight box hold a box, as far as the node's cube does? */
static bool is_tight(const struct hsr_octree_node *node,
                     const struct hsr_box *box) {
  struct hsr_box cube = hsr_cube_box(node);
  bool holds = true;
  for (int a = 0; a < 3; a++) {
    double lo = fmax(box->lo[a], cube.lo[a]), hi = fmin(box->hi[a], cube.hi[a]);
    double middle = node->tight.centre[a], half = node->tight.half[a];
    holds &= middle - half <= lo && hi <= middle + half &&
             cube.lo[a] <= middle - half && middle + half <= cube.hi[a];
  }
  return holds;
}

static struct found look(const struct hsr_octree *octree) {
  struct found f = {true, true, true, UINT32_MAX, 0, octree->n_items};
  for (uint32_t k = 0; k < octree->n_nodes; k++) {
    const struct hsr_octree_node *node = &octree->node[k];
    bool own[N] = {false}, all[N] = {false}, leaf = true;
    for (uint32_t i = 0; i < node->n; i++) {
      uint32_t t = items_of(octree, k)[i];
      struct hsr_box bounds = bounds_of(NULL, t);
      f.meets &= truly_meets(t, node);
      f.cut &= is_tight(node, &bounds);
      f.distinct &= !own[t];
      own[t] = true;
    }
    uint32_t n = mark_subtree(octree, k, all);
    f.least = k && n < f.least ? n : f.least;
    for (int o = 0; o < 8; o++)
      if (node->child[o] != HSR_NO_NODE) {
        const struct hsr_octree_node *child = &octree->node[node->child[o]];
        struct hsr_box tight;
        for (int a = 0; a < 3; a++) {
          tight.lo[a] = child->tight.centre[a] - child->tight.half[a];
          tight.hi[a] = child->tight.centre[a] + child->tight.half[a];
        }
        f.cut &= is_tight(node, &tight);
        leaf = false;
        f.cut &= child->half == node->half / 2 && node->child[o] > k;
        for (int a = 0; a < 3; a++)
          f.cut &= child->centre[a] ==
                   node->centre[a] + (o >> a & 1 ? child->half : -child->half);
      }
    f.most = leaf && k && n > f.most ? n : f.most;
  }
  return f;
}

/* Is the point in a cube of the subtree that holds triangle t? */
static bool is_in_its_cubes(const struct hsr_octree *octree, uint32_t k,
                            uint32_t t, const double p[3]) {
  const struct hsr_octree_node *node = &octree->node[k];
  struct hsr_box cube = hsr_cube_box(node);
  for (int a = 0; a < 3; a++)
    if (p[a] < cube.lo[a] || p[a] > cube.hi[a])
      return false;
  for (uint32_t i = 0; i < node->n; i++)
    if (items_of(octree, k)[i] == t)
      return true;
  for (int o = 0; o < 8; o++)
    if (node->child[o] != HSR_NO_NODE &&
        is_in_its_cubes(octree, node->child[o], t, p))
      return true;
  return false;
}

/* Points of each triangle, including its corners, are in its cubes. */
static bool is_covered(const struct hsr_octree *octree, uint64_t *seed) {
  for (uint32_t t = 0; t < N; t++)
    for (int point = 0; point < 12; point++) {
      int64_t u = draw_integer(seed, 0, STEP);
      int64_t v = draw_integer(seed, 0, STEP - u);
      double p[3];
      if (point < 3)
        u = point == 1 ? STEP : 0, v = point == 2 ? STEP : 0;
      for (int a = 0; a < 3; a++)
        p[a] = ((double)(STEP - u - v) * corner[t][0][a] +
                (double)u * corner[t][1][a] + (double)v * corner[t][2][a]) /
               STEP;
      if (!is_in_its_cubes(octree, 0, t, p))
        return false;
    }
  return true;
}

static void try_pushed(struct tap *tap, uint64_t *seed, int64_t largest,
                       double small, uint32_t least) {
  struct hsr_octree_rule rule = {small, least, least};
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  draw_triangles(seed, largest);
  struct hsr_octree octree = build(&rule, &triangles, &arena);
  struct found f = look(&octree);
  bool covered = is_covered(&octree, seed);
  ok(tap, covered && f.meets && f.distinct && f.cut && octree.n_nodes > 8,
     "pushed, up to %d, 1/%g: the cubes of each triangle cover it, and it "
     "meets "
     "them",
     (int)largest, 1 / small);
  ok(tap, f.least >= least && f.copies > N,
     "at least %u of %u in a cube below the root; %.2f cubes a triangle",
     (unsigned)f.least, (unsigned)least, (double)f.copies / N);
  hsr_arena_free(&arena);
}

/* --- What cannot be parted ------------------------------------------------ */

static struct hsr_box here(const void *context, uint32_t k) {
  (void)k;
  return *(const struct hsr_box *)context;
}

static double no_area(const void *context, uint32_t k) {
  (void)context;
  (void)k;
  return 0;
}

static void try_points(struct tap *tap, double x, const char *where) {
  struct hsr_box box = {{x, x, x}, {x, x, x}};
  struct hsr_primitives points = {100, &box, here, no_area, NULL};
  bool good = true;
  for (int pushed = 0; pushed < 2; pushed++) {
    struct hsr_octree_rule rule = {pushed ? 0.1 : 0, 20, 20};
    struct hsr_arena arena = HSR_ARENA_EMPTY;
    struct hsr_octree octree = build(&rule, &points, &arena);
    good &= octree.n_items == 100 && octree.n_nodes <= 64;
    hsr_arena_free(&arena);
  }
  ok(tap, good, "a hundred times the same point, %s: it ends", where);
}

/* Small triangles that share a corner: every cube with the corner holds them
 * all. */
static void test_fan(struct tap *tap, uint64_t *seed) {
  static const struct hsr_octree_rule rule = {0.1, 20, 20};
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  for (int k = 0; k < N; k++)
    for (int a = 0; a < 3; a++) {
      corner[k][0][a] = SIDE / 2;
      for (int c = 1; c < 3; c++)
        corner[k][c][a] = (double)(SIDE / 2 + STEP * draw_integer(seed, -3, 3));
    }
  struct hsr_octree octree = build(&rule, &triangles, &arena);
  ok(tap, octree.n_items < 8 * N && is_covered(&octree, seed),
     "a fan of small triangles ends, with %.2f cubes a triangle",
     (double)octree.n_items / N);
  hsr_arena_free(&arena);
}

/* --- Divided bit by bit --------------------------------------------------- */

/* Whether two subtrees have the same cubes and what is in them. */
static bool are_same(const struct hsr_octree *a, uint32_t j,
                     const struct hsr_octree *b, uint32_t k) {
  const struct hsr_octree_node *p = &a->node[j], *q = &b->node[k];
  bool same = p->half == q->half && p->n == q->n &&
              !memcmp(p->centre, q->centre, sizeof p->centre) &&
              !memcmp(items_of(a, j), items_of(b, k), p->n * sizeof *a->item);
  for (int x = 0; x < 3; x++) /* it may be larger */
    same &= q->tight.half[x] >= p->tight.half[x] &&
            fabs(q->tight.centre[x]) + q->tight.half[x] <= 2 * SIDE;
  for (int o = 0; same && o < 8; o++)
    same = (p->child[o] == HSR_NO_NODE) == (q->child[o] == HSR_NO_NODE) &&
           (p->child[o] == HSR_NO_NODE ||
            are_same(a, p->child[o], b, q->child[o]));
  return same;
}

/* In an order of its own: the newest cube, then the oldest, by turns. */
static bool divide_all(struct hsr_lazy_octree *lazy, bool *once) {
  bool good = true;
  for (uint32_t left = 1, low = 0; left && good;) {
    uint32_t k = lazy->octree.n_nodes - 1;
    while (left % 2 ? hsr_lazy_node(lazy, k)->divided : false)
      k--;
    if (left % 2 == 0)
      for (k = low; hsr_lazy_node(lazy, k)->divided;)
        low = ++k;
    uint32_t before = lazy->octree.n_nodes;
    *once &= lazy->octree.node[k].n == hsr_lazy_node(lazy, k)->n;
    good = !hsr_octree_divide(lazy, k) && hsr_lazy_node(lazy, k)->divided;
    left += lazy->octree.n_nodes - before - 1;
  }
  return good;
}

static void test_lazy(struct tap *tap, uint64_t *seed) {
  static const struct hsr_octree_rule rules[] = {
      {0.1, 20, 20}, {0, 0, 1}, {1, 8, 3}};
  static const double lo[3] = {0, 0, 0};
  bool good = true, alone = true, undivided = true;
  for (int k = 0; k < 9; k++) {
    struct hsr_arena arena = HSR_ARENA_EMPTY;
    struct hsr_lazy_octree lazy;
    draw_triangles(seed, k % 2 ? 16 : 64);
    struct hsr_octree whole = build(&rules[k % 3], &triangles, &arena);
    good &=
        !hsr_octree_begin(&lazy, &triangles, &rules[k % 3], lo, SIDE, &arena);
    alone &= lazy.octree.n_nodes == 1 && lazy.octree.node[0].n == N;
    good &= divide_all(&lazy, &undivided) &&
            are_same(&whole, 0, &lazy.octree, 0) &&
            lazy.octree.n_nodes == whole.n_nodes;
    hsr_arena_free(&arena);
  }
  ok(tap, alone, "lazily: all primitives are in the root, which is alone");
  ok(tap, undivided, "lazily: a cube keeps what was handed down to it");
  ok(tap, good, "lazily: when all cubes are divided, it is the whole octree");
}

/* A bundle of slivers, from side to side of the cube, close to a line on which
 * no median plane lies: dividing doubles them, and parts none of them. */
static void test_bundle(struct tap *tap) {
  enum { SLIVERS = 4, MOST_COPIES = 64 };
  static const struct hsr_octree_rule rule = {0.1, 2, 1};
  struct hsr_primitives bundle = triangles;
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  bundle.n = SLIVERS;
  for (int k = 0; k < SLIVERS; k++)
    for (int c = 0; c < 3; c++) {
      corner[k][c][0] = c == 2 ? SIDE : 0;
      corner[k][c][1] = SIDE / 3.0 + ldexp(c == 1, -30);
      corner[k][c][2] = SIDE / 3.0 + ldexp(k, -30);
    }
  struct hsr_octree octree = build(&rule, &bundle, &arena);
  ok(tap,
     octree.n_items > SLIVERS * MOST_COPIES / 4 &&
         octree.n_items <= SLIVERS * MOST_COPIES,
     "a bundle of slivers ends, with %.2f cubes a sliver",
     (double)octree.n_items / SLIVERS);
  hsr_arena_free(&arena);
}

/* One triangle is so large that rounding moves the root's cube off another. */
static void test_scales(struct tap *tap) {
  static const struct hsr_octree_rule rule = {0.1, 1, 1};
  static const double lo[3] = {-7, -6e20, -6};
  static const double of_two[2][3][3] = {
      {{1, -6e20, 8}, {-7, 8, 5e20}, {2, -4, -4}},
      {{-5, -5, -6}, {-7, 5, -6}, {-6, -1, -5}}};
  struct hsr_primitives two = triangles;
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_octree octree;
  two.n = 2;
  memcpy(corner, of_two, sizeof of_two);
  bool good = !hsr_octree_init(&octree, &two, &rule, lo, 1.0009765625 * 6e20, 1,
                               &arena);
  struct hsr_box root = hsr_cube_box(&octree.node[0]);
  for (uint32_t k = 0; k < 2; k++) {
    struct hsr_box box = bounds_of(NULL, k);
    good &= hsr_box_holds(&root, &box);
  }
  const struct hsr_octree_box *tight = &octree.node[0].tight;
  good &= tight->centre[0] - tight->half[0] == -7;
  ok(tap, good, "the root holds what rounding would leave out");
  hsr_arena_free(&arena);
}

/* --- From front to back --------------------------------------------------- */

/* The middle of a ray's part in an octant of the cube; NaN if there is none. */
static double middle_of(const double eye[3], const double ray[3],
                        const struct hsr_octree_node *cube, int octant) {
  double from = 0, to = INFINITY;
  for (int a = 0; a < 3; a++) {
    double lo = cube->centre[a] - (octant >> a & 1 ? 0 : cube->half);
    double t0 = (lo - eye[a]) / ray[a],
           t1 = (lo + cube->half - eye[a]) / ray[a];
    from = fmax(from, fmin(t0, t1));
    to = fmin(to, fmax(t0, t1));
  }
  return to - from > 1e-9 * to ? 0.5 * (from + to) : NAN;
}

static double unit(uint64_t *seed) {
  return (double)draw_integer(seed, -1000000, 1000000) / 1e6 + 1e-9;
}

static void test_order(struct tap *tap, uint64_t *seed) {
  long met = 0, wrong = 0;
  for (int k = 0; k < 20000; k++) {
    struct hsr_octree_node cube = {.half = 1};
    struct hsr_placing placing;
    double ray[3], last = 0;
    for (int a = 0; a < 3; a++) {
      cube.centre[a] = 3 * unit(seed);
      placing.eye[a] = (k % 3 ? 8 : 1) * unit(seed);
      /* to somewhere in the cube */
      ray[a] = cube.centre[a] + unit(seed) - placing.eye[a];
    }
    int nearest = hsr_cube_nearest(&placing, &cube), seen = 0;
    for (int o = 0; o < 8; o++) {
      int octant = nearest ^ hsr_octant_order[o];
      double at = middle_of(placing.eye, ray, &cube, octant);
      seen |= 1 << octant;
      if (isnan(at))
        continue;
      met++;
      wrong += at < last;
      last = at;
    }
    wrong += seen != 255;
  }
  ok(tap, !wrong && met > 30000,
     "no ray meets octants in another order than that of hsr_octant_order: "
     "%ld of %ld",
     wrong, met);
}

/* Coordinates as multiples of a power of two, and instances that round nothing.
 */
static void test_grain(struct tap *tap) {
  static const double some[] = {4, -1.5, 0, 0x1p20}, none[] = {0, -0.0},
                      fine[] = {0x1p-1074, 1}, one[] = {-12};
  ok(tap,
     hsr_grain(some, 4) == -1 && hsr_grain(none, 2) == HSR_GRAIN_ANY &&
         hsr_grain(fine, 2) == -1074 && hsr_grain(one, 1) == 2 &&
         hsr_grain(some, 0) == HSR_GRAIN_ANY,
     "the grain of some numbers");
  struct hsr_instance turned = {0, {0, -1, 0, 3, 0, 0, 1, 0, 1, 0, 0, -8}};
  struct hsr_instance fitting = turned, beyond = turned, sheared = turned,
                      halved = turned, shifted = turned, flat = turned;
  fitting.m[3] = 0x1p51 - 1;
  beyond.m[3] = 0x1p51;
  sheared.m[0] = 1;
  halved.m[1] = -.5;
  shifted.m[7] = .25;
  flat.m[8] = 0;
  ok(tap,
     hsr_instance_is_exact(&turned, 0, 1000) &&
         hsr_instance_is_exact(&fitting, 0, 0x1p51) &&
         !hsr_instance_is_exact(&beyond, 0, 0x1p51) &&
         hsr_instance_is_exact(&shifted, 0, 0x1p50 - 9) &&
         !hsr_instance_is_exact(&shifted, 0, 0x1p50),
     "an instance that turns and moves is exact as far as the grain reaches");
  ok(tap,
     !hsr_instance_is_exact(&sheared, 0, 1) &&
         !hsr_instance_is_exact(&halved, 0, 1) &&
         !hsr_instance_is_exact(&flat, 0, 1),
     "one that does anything else is not");
}

int main(void) {
  struct tap tap = plan(2 + 2 * 4 + 2 + 1 + 1 + 1 + 1 + 3 + 3);
  uint64_t seed = 6;
  test_enclosing(&tap, &seed);
  try_pushed(&tap, &seed, 16, 0.1, 20);
  try_pushed(&tap, &seed, 128, 0.1, 20);
  try_pushed(&tap, &seed, 64, 0.5, 8);
  try_pushed(&tap, &seed, 32, 1, 50);
  try_points(&tap, SIDE / 2, "on the median planes");
  try_points(&tap, SIDE / 3.0, "elsewhere");
  test_fan(&tap, &seed);
  test_lazy(&tap, &seed);
  test_bundle(&tap);
  test_scales(&tap);
  test_order(&tap, &seed);
  test_grain(&tap);
  return finish(&tap);
}
