/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What J. E. Swan II, "Object-Order Rendering of Discrete Objects", 1998,
 * chapter 2, claims about the orders of common/grids/order.h. All geometry here
 * is in whole numbers, and shares no code with the orders.
 *
 * Once        Every cell is visited once, and back to front is front to back in
 *             reverse.
 * Points      If a sample hides another, it is visited before it: by pbtf with
 *             the floor split, in any nesting and any order of the sides. With
 *             the nearest split, as Theorem 3 is worded, it is not.
 * Cells       The same for boxes, with low sides first.
 * Classes     Tables 2.1 to 2.3: 3, 9 and 27 classes of views.
 * Figures     The orders that know no eye are wrong in perspective, as in
 *             figures 2.25 and 2.26, and pbtf is right, as in figure 2.27. */
#include "common/grids/order.h"
#include "tests/tap.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 10, MOST_CELLS = MOST * MOST * MOST };

static uint64_t state = 1;

static int whole(int lo, int hi) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return lo + (int)((state >> 33) % (uint64_t)(hi - lo + 1));
}

/* --- Visits --------------------------------------------------------------- */

/* When each cell was visited, from 0; -1: never. */
struct visits {
  const struct hsr_grid_seen *seen;
  int *when;
  int n, repeated;
};

static int number_of(const struct hsr_grid_seen *seen, const uint32_t at[3]) {
  return (int)((at[2] * seen->n[1] + at[1]) * seen->n[0] + at[0]);
}

static void note(void *data, const struct hsr_grid_run *run) {
  struct visits *v = data;
  for (uint32_t k = 0; k < run->n; k++) {
    uint32_t at[3] = {run->at[0], run->at[1], run->at[2]};
    at[run->axis] += (uint32_t)((int)k * run->step);
    for (int a = 0; a < 3; a++)
      if (at[a] >= v->seen->n[a]) {
        v->repeated++;
        return;
      }
    int cell = number_of(v->seen, at);
    v->repeated += v->when[cell] >= 0;
    v->when[cell] = v->n++;
  }
}

static struct visits visit(enum hsr_grid_order order, int nesting, bool front,
                           const struct hsr_grid_seen *seen, int *when) {
  struct visits v = {seen, when, 0, 0};
  struct hsr_error err;
  memset(when, 0xff,
         (size_t)seen->n[0] * seen->n[1] * seen->n[2] * sizeof *when);
  if (hsr_grid_visit(order, nesting, front, seen, note, &v, &err))
    bail("%s", err.text);
  return v;
}

static void check_once(struct tap *tap, enum hsr_grid_order order) {
  static int front[MOST_CELLS], back[MOST_CELLS];
  bool once = true, reversed = true;
  for (int k = 0; k < 200; k++) {
    struct hsr_grid_seen seen;
    for (int a = 0; a < 3; a++) {
      seen.n[a] = (uint32_t)whole(1, MOST);
      seen.q[a] = whole(-1, (int)seen.n[a] - 1);
      seen.toward[a] = whole(-3, 3);
    }
    seen.high_first = whole(0, 1);
    int cells = (int)(seen.n[0] * seen.n[1] * seen.n[2]);
    struct visits f = visit(order, k % 6, true, &seen, front);
    struct visits b = visit(order, k % 6, false, &seen, back);
    once &= f.n == cells && b.n == cells && !f.repeated && !b.repeated;
    for (int c = 0; c < cells; c++)
      reversed &= front[c] == cells - 1 - back[c];
  }
  ok(tap, once, "%s visits every cell once", hsr_grid_order_name[order]);
  ok(tap, reversed, "%s: back to front is front to back in reverse",
     hsr_grid_order_name[order]);
}

/* By ippbtf the cells of an axis come by their distance from the eye's,
 * whichever side they are on. */
static void check_interleaved(struct tap *tap) {
  static int when[MOST_CELLS];
  bool by_distance = true;
  for (int q = -1; q < MOST; q++) {
    struct hsr_grid_seen seen = {.n = {1, MOST, 1}, .q = {0, q, 0}};
    int at[MOST];
    visit(HSR_IPPBTF, 0, true, &seen, when);
    for (int k = 0; k < MOST; k++)
      at[when[k]] = k;
    for (int k = 1; k < MOST; k++)
      by_distance &= abs(at[k - 1] - q) <= abs(at[k] - q);
  }
  ok(tap, by_distance, "ippbtf takes the cells of both sides by distance");
}

/* --- Points --------------------------------------------------------------- */

/* Samples at whole numbers, and an eye at one: all else is a scale. */
struct points {
  uint32_t n[3];
  double at[3][MOST];
  int eye[3];
};

static struct points random_points(void) {
  struct points p;
  for (int a = 0; a < 3; a++) {
    p.n[a] = (uint32_t)whole(2, 6);
    int x = 0, step = whole(1, 2);
    bool uniform = whole(0, 1);
    for (uint32_t k = 0; k < p.n[a]; k++) {
      p.at[a][k] = x;
      x += uniform ? step : whole(1, 4);
    }
    p.eye[a] = whole(-6, x + 5);
    if (whole(0, 2) == 0) /* on a sample */
      p.eye[a] = (int)p.at[a][whole(0, (int)p.n[a] - 1)];
  }
  return p;
}

static void offset(const struct points *p, int cell, int v[3]) {
  int n0 = (int)p->n[0], n1 = (int)p->n[1];
  int at[3] = {cell % n0, cell / n0 % n1, cell / (n0 * n1)};
  for (int a = 0; a < 3; a++)
    v[a] = (int)p->at[a][at[a]] - p->eye[a];
}

/* Whether the first is on the way from the eye to the second. A sample at the
 * eye is on no way. */
static bool hides(const int a[3], const int b[3]) {
  int dot = 0, size = 0;
  for (int k = 0; k < 3; k++) {
    int l = (k + 1) % 3, m = (k + 2) % 3;
    if (a[l] * b[m] != a[m] * b[l])
      return false;
    dot += a[k] * b[k];
    size += a[k] * a[k];
  }
  return size > 0 && dot > size;
}

static int32_t nearest_split(const double *at, uint32_t n, int eye) {
  int32_t best = 0;
  for (uint32_t k = 1; k < n; k++)
    if (fabs(at[k] - eye) < fabs(at[best] - eye))
      best = (int32_t)k;
  return eye < at[0] ? -1 : best;
}

struct violations {
  long pairs, wrong;
};

static void count_violations(const struct points *p, const int *when,
                             struct violations *v) {
  int cells = (int)(p->n[0] * p->n[1] * p->n[2]);
  for (int a = 0; a < cells; a++)
    for (int b = 0; b < cells; b++) {
      int from_a[3], from_b[3];
      offset(p, a, from_a);
      offset(p, b, from_b);
      if (a == b || !hides(from_a, from_b))
        continue;
      v->pairs++;
      v->wrong += when[a] > when[b];
    }
}

enum split { FLOOR, NEAREST };

static struct violations violations_of(enum hsr_grid_order order,
                                       enum split split, bool high_first) {
  static int when[MOST_CELLS];
  struct violations v = {0, 0};
  state = 77;
  for (int k = 0; k < 2200; k++) {
    struct points p = random_points();
    struct hsr_grid_seen seen = {.high_first = high_first};
    for (int a = 0; a < 3; a++) {
      seen.n[a] = p.n[a];
      seen.q[a] = split == FLOOR ? hsr_grid_split(p.at[a], p.n[a], p.eye[a])
                                 : nearest_split(p.at[a], p.n[a], p.eye[a]);
      seen.toward[a] = whole(-9, 9);
    }
    visit(order, k % 6, true, &seen, when);
    count_violations(&p, when, &v);
  }
  return v;
}

static void check_points(struct tap *tap) {
  for (int high_first = 0; high_first < 2; high_first++) {
    struct violations v = violations_of(HSR_PBTF, FLOOR, high_first);
    ok(tap, v.pairs > 10000 && !v.wrong,
       "pbtf, floor split, %s sides first: %ld of %ld pairs are wrong",
       high_first ? "high" : "low", v.wrong, v.pairs);
  }
  struct violations v = violations_of(HSR_PBTF, NEAREST, false);
  ok(tap, !v.wrong, "nearest split, low sides first: %ld", v.wrong);
  v = violations_of(HSR_PBTF, NEAREST, true);
  ok(tap, v.wrong > 0, "nearest split, high sides first: %ld are wrong",
     v.wrong);
  v = violations_of(HSR_IPPBTF, FLOOR, false);
  ok(tap, !v.wrong, "ippbtf: %ld", v.wrong);
  v = violations_of(HSR_OCTREE, FLOOR, false);
  ok(tap, !v.wrong, "octree-order: %ld", v.wrong);
  v = violations_of(HSR_BTF, FLOOR, false);
  ok(tap, v.wrong > 0, "btf knows no eye: %ld are wrong", v.wrong);
}

/* --- Cells ---------------------------------------------------------------- */

/* A number of the ray's parameter: by / of, of > 0. */
struct ratio {
  int64_t by, of;
};

static bool is_less(struct ratio a, struct ratio b) {
  return a.by * b.of < b.by * a.of;
}

/* Where the ray is in a cell. False: in no more than a point. */
static bool stretch_of(const struct points *bounds, const int at[3],
                       const int ray[3], struct ratio *from) {
  struct ratio to = {1000000, 1};
  *from = (struct ratio){0, 1};
  for (int a = 0; a < 3; a++) {
    int64_t lo = (int64_t)bounds->at[a][at[a]] - bounds->eye[a];
    int64_t hi = (int64_t)bounds->at[a][at[a] + 1] - bounds->eye[a];
    if (!ray[a] && !(lo < 0 && 0 < hi))
      return false;
    if (!ray[a])
      continue;
    int64_t size = ray[a] > 0 ? ray[a] : -ray[a];
    struct ratio enter = {ray[a] > 0 ? lo : -hi, size};
    struct ratio leave = {ray[a] > 0 ? hi : -lo, size};
    if (is_less(*from, enter))
      *from = enter;
    if (is_less(leave, to))
      to = leave;
  }
  return is_less(*from, to);
}

/* How many pairs of cells on a random ray are visited in the wrong order. */
static void try_ray(const struct points *bounds,
                    const struct hsr_grid_seen *seen, const int *when,
                    struct violations *v) {
  struct {
    struct ratio from;
    int when;
  } met[3 * MOST];
  int n = 0, ray[3];
  for (int a = 0; a < 3; a++)
    ray[a] = whole(-7, 7);
  for (int k = 0; k < (int)seen->n[2]; k++)
    for (int j = 0; j < (int)seen->n[1]; j++)
      for (int i = 0; i < (int)seen->n[0]; i++) {
        int at[3] = {i, j, k};
        uint32_t cell[3] = {(uint32_t)i, (uint32_t)j, (uint32_t)k};
        if (n < 3 * MOST && stretch_of(bounds, at, ray, &met[n].from))
          met[n++].when = when[number_of(seen, cell)];
      }
  for (int a = 0; a < n; a++)
    for (int b = 0; b < n; b++)
      if (is_less(met[a].from, met[b].from)) {
        v->pairs++;
        v->wrong += met[a].when > met[b].when;
      }
}

/* The axis's part of a view class: below, inside or above. */
static void place_eye(struct points *bounds, int a, int place) {
  int last = (int)bounds->at[a][bounds->n[a] - 1];
  if (place == 1 && whole(0, 1)) /* on a bound */
    bounds->eye[a] = (int)bounds->at[a][whole(0, (int)bounds->n[a] - 1)];
  else
    bounds->eye[a] = place == 0   ? whole(-9, -1)
                     : place == 1 ? whole(0, last)
                                  : whole(last + 1, last + 9);
}

static struct violations cells_of(enum hsr_grid_order order, bool high_first) {
  static int when[MOST_CELLS];
  struct violations v = {0, 0};
  state = 99;
  for (int k = 0; k < 27 * 40; k++) {
    struct points bounds = random_points();
    struct hsr_grid_seen seen = {.high_first = high_first};
    for (int a = 0, part = k; a < 3; a++, part /= 3) {
      place_eye(&bounds, a, part % 3);
      seen.n[a] = bounds.n[a] - 1;
      seen.q[a] = hsr_grid_split(bounds.at[a], seen.n[a], bounds.eye[a]);
      seen.toward[a] = whole(-9, 9);
    }
    visit(order, k % 6, true, &seen, when);
    for (int r = 0; r < 100; r++)
      try_ray(&bounds, &seen, when, &v);
  }
  return v;
}

static void check_cells(struct tap *tap) {
  static const enum hsr_grid_order right[] = {HSR_PBTF, HSR_IPPBTF, HSR_OCTREE};
  for (int k = 0; k < 3; k++) {
    struct violations v = cells_of(right[k], false);
    ok(tap, v.pairs > 10000 && !v.wrong,
       "%s, cells, 27 classes of views: %ld of %ld pairs are wrong",
       hsr_grid_order_name[right[k]], v.wrong, v.pairs);
  }
  struct violations v = cells_of(HSR_PBTF, true);
  ok(tap, v.wrong > 0, "pbtf, high sides first: %ld are wrong", v.wrong);
  for (enum hsr_grid_order order = HSR_BTF; order <= HSR_VBUFFER; order++) {
    v = cells_of(order, false);
    ok(tap, v.wrong > 0, "%s knows no eye: %ld are wrong",
       hsr_grid_order_name[order], v.wrong);
  }
}

/* Parallel rays: all are seen from one direction, and all orders are right. */
static void check_parallel(struct tap *tap, enum hsr_grid_order order) {
  static int when[MOST_CELLS];
  struct violations v = {0, 0};
  for (int k = 0; k < 600; k++) {
    struct points bounds = random_points();
    struct hsr_grid_seen seen = {.high_first = false};
    int ray[3];
    for (int a = 0; a < 3; a++) {
      ray[a] = whole(-2, 2);
      seen.n[a] = bounds.n[a] - 1;
      double eye = ray[a] < 0 ? INFINITY : ray[a] > 0 ? -INFINITY : NAN;
      seen.q[a] = hsr_grid_split(bounds.at[a], seen.n[a], eye);
      seen.toward[a] = ray[a];
    }
    visit(order, k % 6, true, &seen, when);
    for (int a = 0; a < (int)(seen.n[0] * seen.n[1] * seen.n[2]); a++) {
      /* A cell and the neighbour that the ray enters through one side. */
      int n0 = (int)seen.n[0], n1 = (int)seen.n[1];
      int at[3] = {a % n0, a / n0 % n1, a / (n0 * n1)};
      for (int axis = 0; axis < 3; axis++) {
        int next = at[axis] + (ray[axis] > 0) - (ray[axis] < 0);
        if (next == at[axis] || next < 0 || next >= (int)seen.n[axis])
          continue;
        uint32_t cell[3] = {(uint32_t)at[0], (uint32_t)at[1], (uint32_t)at[2]};
        cell[axis] = (uint32_t)next;
        v.pairs++;
        v.wrong += when[a] > when[number_of(&seen, cell)];
      }
    }
  }
  ok(tap, v.pairs > 10000 && !v.wrong,
     "%s in parallel projection: %ld of %ld pairs are wrong",
     hsr_grid_order_name[order], v.wrong, v.pairs);
}

/* --- The sweep of the V-buffer -------------------------------------------- */

/* Within a slice, cells come by the distance of their middles from the view plane,
 * which is not the order of their indices where cells are of uneven sizes. */
static void check_sweep(struct tap *tap) {
  static const double x[3] = {0, 1, 10}, y[3] = {0, 3, 4}, z[2] = {0, 1};
  static int when[MOST_CELLS];
  struct hsr_grid_seen seen = {
      .n = {3, 3, 2}, .q = {-1, -1, -1}, .toward = {1, 2, 5}, .at = {x, y, z}};
  long wrong = 0, pairs = 0, unlike = 0;
  visit(HSR_VBUFFER, 0, true, &seen, when);
  for (int a = 0; a < 9; a++)
    for (int b = 0; b < 9; b++) {
      double near = x[a % 3] + 2 * y[a / 3], far = x[b % 3] + 2 * y[b / 3];
      if (!(near < far))
        continue;
      pairs++;
      wrong += when[a] > when[b];
      unlike += a % 3 + 2 * (a / 3) > b % 3 + 2 * (b / 3);
    }
  ok(tap, pairs > 30 && unlike > 0 && !wrong,
     "vbuffer: %ld of %ld pairs of a slice are not in order of their distance; "
     "by "
     "indices %ld would not be",
     wrong, pairs, unlike);
}

/* --- Classes of views ----------------------------------------------------- */

/* Notes the sets that are visited: bit k for the octant on the high side of
 * axis a where bit a of k is set. */
struct sets {
  const struct hsr_grid_seen *seen;
  unsigned met;
};

static void note_set(void *data, const struct hsr_grid_run *run) {
  struct sets *sets = data;
  for (uint32_t i = 0; i < run->n; i++) {
    unsigned octant = 0;
    for (int a = 0; a < 3; a++) {
      int at = (int)run->at[a] + (a == run->axis ? (int)i * run->step : 0);
      octant |= (unsigned)(at > sets->seen->q[a]) << a;
    }
    sets->met |= 1u << octant;
  }
}

/* Tables 2.1 to 2.3 of Swan: the classes of a grid of so many dimensions, and
 * how many sets are visited in each. classes[w] is the number of those whose
 * eye is within w axes; false if one of them has other than 2^w sets. */
static bool count_classes(int dimensions, int classes[4]) {
  static const double at[4] = {0, 1, 2, 3};
  static const double eyes[3] = {-1, 1.5, 4};
  bool right = true;
  int all = dimensions == 1 ? 3 : dimensions == 2 ? 9 : 27;
  for (int k = 0; k < all; k++) {
    struct hsr_grid_seen seen = {.n = {1, 1, 1}, .q = {0, 0, 0}};
    int within = 0;
    for (int a = 0, part = k; a < dimensions; a++, part /= 3) {
      seen.n[a] = 4;
      seen.q[a] = hsr_grid_split(at, 4, eyes[part % 3]);
      within += part % 3 == 1;
    }
    struct sets sets = {&seen, 0};
    right &= !hsr_grid_visit(HSR_PBTF, 0, false, &seen, note_set, &sets, NULL);
    right &= __builtin_popcount(sets.met) == 1 << within;
    classes[within]++;
  }
  return right;
}

static void check_classes(struct tap *tap) {
  static const double at[4] = {0, 1, 2, 3};
  int classes[4][4] = {{0}};
  bool line = count_classes(1, classes[1]),
       plane = count_classes(2, classes[2]),
       volume = count_classes(3, classes[3]);
  ok(tap, line && classes[1][1] == 1 && classes[1][0] == 2,
     "3 classes of views of a line: %d line-on of 2 sets, %d end-on of 1",
     classes[1][1], classes[1][0]);
  ok(tap,
     plane && classes[2][2] == 1 && classes[2][1] == 4 && classes[2][0] == 4,
     "9 of a plane: %d plane-on of 4 sets, %d edge-on of 2, %d corner-on of 1",
     classes[2][2], classes[2][1], classes[2][0]);
  ok(tap,
     volume && classes[3][3] == 1 && classes[3][2] == 6 &&
         classes[3][1] == 12 && classes[3][0] == 8,
     "27 of a volume: %d volume-on of 8 sets, %d face-on of 4, %d edge-on of "
     "2, "
     "%d corner-on of 1",
     classes[3][3], classes[3][2], classes[3][1], classes[3][0]);
  ok(tap,
     hsr_grid_split(at, 4, 0) == 0 && hsr_grid_split(at, 4, -0.1) == -1 &&
         hsr_grid_split(at, 4, 3) == 3 && hsr_grid_split(at, 4, 2.9) == 2,
     "a position at the eye is on the low side");
}

/* --- Figures -------------------------------------------------------------- */

enum { SIDE = 60, PICTURE = 300, FAR = 2 };

struct camera {
  const char *name;
  double eye[3], forward[3], half; /* degrees */
  /* Pixels that show a cell more than FAR indices away from the right one, by
   * btf with z, y, x and with y, z, x as nesting, wbtf and vbuffer; and pixels
   * that show any cell. */
  int hit, far[4];
};

static bool is_kept(const int at[3]) {
  for (int a = 0; a < 3; a++)
    if (at[a] == 0 || at[a] == SIDE - 1)
      return true;
  return false;
}

/* The kept cells that a ray meets, in its order. Cells are centred on whole
 * numbers. */
static int walk(const double eye[3], const double ray[3], int cell[][3]) {
  double from = 0, to = INFINITY, next[3], step[3];
  int at[3], n = 0;
  for (int a = 0; a < 3; a++) {
    double lo = (-0.5 - eye[a]) / ray[a], hi = (SIDE - 0.5 - eye[a]) / ray[a];
    if (ray[a] == 0) {
      if (eye[a] <= -0.5 || eye[a] >= SIDE - 0.5)
        return 0;
      continue;
    }
    from = fmax(from, fmin(lo, hi));
    to = fmin(to, fmax(lo, hi));
  }
  if (!(from < to))
    return 0;
  for (int a = 0; a < 3; a++) {
    double x = eye[a] + from * ray[a];
    at[a] = (int)floor(x + 0.5);
    at[a] = at[a] < 0 ? 0 : at[a] > SIDE - 1 ? SIDE - 1 : at[a];
    double bound = at[a] + (ray[a] > 0 ? 0.5 : -0.5);
    next[a] = ray[a] == 0 ? INFINITY : (bound - eye[a]) / ray[a];
    step[a] = fabs(1 / ray[a]);
  }
  for (;;) {
    if (is_kept(at))
      memcpy(cell[n++], at, sizeof at);
    int a = next[0] <= next[1] ? (next[0] <= next[2] ? 0 : 2)
                               : (next[1] <= next[2] ? 1 : 2);
    next[a] += step[a];
    at[a] += ray[a] > 0 ? 1 : -1;
    if (at[a] < 0 || at[a] >= SIDE)
      return n;
  }
}

/* The ray through the middle of a pixel. */
static void ray_of(const struct camera *c, int x, int y, double ray[3]) {
  const double *f = c->forward;
  double length = sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
  double right[3] = {-f[2], 0, f[0]}, up[3]; /* f x (0, 1, 0) */
  double across = hypot(right[0], right[2]), t = tan(c->half * M_PI / 180);
  for (int a = 0; a < 3; a++)
    right[a] /= across;
  up[0] = (right[1] * f[2] - right[2] * f[1]) / length;
  up[1] = (right[2] * f[0] - right[0] * f[2]) / length;
  up[2] = (right[0] * f[1] - right[1] * f[0]) / length;
  double u = (2 * x + 1 - PICTURE) * t / PICTURE;
  double v = (PICTURE - 2 * y - 1) * t / PICTURE;
  for (int a = 0; a < 3; a++)
    ray[a] = f[a] / length + u * right[a] + v * up[a];
}

/* Counts the pixels whose cell, the one that is visited last from back to
 * front, is far from the first that the ray meets; *any: those with another. */
static int far_errors(const struct camera *c, const struct hsr_grid_seen *seen,
                      const int *when, int *hit, int *any) {
  int far = 0;
  *hit = *any = 0;
  for (int y = 0; y < PICTURE; y++)
    for (int x = 0; x < PICTURE; x++) {
      static int cell[4 * SIDE][3];
      double ray[3];
      ray_of(c, x, y, ray);
      int n = walk(c->eye, ray, cell), shown = 0, off = 0, last = -1;
      for (int k = 0; k < n; k++) {
        uint32_t at[3] = {(uint32_t)cell[k][0], (uint32_t)cell[k][1],
                          (uint32_t)cell[k][2]};
        int time = when[number_of(seen, at)];
        if (time > last) {
          last = time;
          shown = k;
        }
      }
      for (int a = 0; a < 3 && n; a++) {
        int d = abs(cell[shown][a] - cell[0][a]);
        off = d > off ? d : off;
      }
      *hit += n > 0;
      *any += shown > 0;
      far += off > FAR;
    }
  return far;
}

static void check_figure(struct tap *tap, const struct camera *c) {
  static int when[SIDE * SIDE * SIDE];
  struct hsr_grid_seen seen = {.high_first = false};
  double bound[SIDE];
  for (int k = 0; k < SIDE; k++)
    bound[k] = k - 0.5;
  for (int a = 0; a < 3; a++) {
    seen.n[a] = SIDE;
    seen.q[a] = hsr_grid_split(bound, SIDE, c->eye[a]);
    seen.toward[a] = c->forward[a];
  }
  static const struct {
    enum hsr_grid_order order;
    int nesting;
  } naive[4] = {{HSR_BTF, 0}, {HSR_BTF, 2}, {HSR_WBTF, 0}, {HSR_VBUFFER, 0}};
  int far[4], hit = 0, any;
  bool same = true;
  for (int k = 0; k < 4; k++) {
    visit(naive[k].order, naive[k].nesting, false, &seen, when);
    far[k] = far_errors(c, &seen, when, &hit, &any);
    same &= far[k] == c->far[k];
  }
  same &= hit == c->hit;
  ok(tap, same,
     "%s: %d pixels; far errors of btf %d and %d, wbtf %d, vbuffer %d", c->name,
     hit, far[0], far[1], far[2], far[3]);
  int wrong = 0;
  for (int nesting = 0; nesting < 6; nesting++) {
    visit(HSR_PBTF, nesting, false, &seen, when);
    far_errors(c, &seen, when, &hit, &any);
    wrong += any;
  }
  visit(HSR_IPPBTF, 0, false, &seen, when);
  far_errors(c, &seen, when, &hit, &any);
  wrong += any;
  visit(HSR_OCTREE, 0, false, &seen, when);
  far_errors(c, &seen, when, &hit, &any);
  wrong += any;
  ok(tap, !wrong, "%s: pbtf, ippbtf and octree-order show %d wrong cells",
     c->name, wrong);
}

int main(void) {
  static const struct camera cameras[] = {
      {"A", {29.5, 29.5, -60}, {.02, .03, 1}, 40, 32588, {0, 13558, 0, 0}},
      {"C", {-60, 25, 22}, {1, .1, .1}, 40, 31834, {11045, 12326, 0, 0}},
      {"D", {-40, 25, -45}, {1, .1, 1.05}, 40, 21179, {0, 7886, 0, 0}},
      {"E", {-50, 100, -60}, {80, -70, 90}, 40, 10461, {0, 0, 0, 0}},
      {"F", {45, -25, -25}, {1.05, 1, 1}, 45, 20740, {0, 0, 9359, 9359}},
      {"G", {15, 30, -15}, {1.05, .1, 1}, 60, 52101, {48, 24973, 16857, 16857}},
      {"H", {20.3, 30.2, 40.1}, {.1, .2, 1}, 45, 90000, {0, 0, 0, 0}}};
  enum { CAMERAS = sizeof cameras / sizeof *cameras };
  struct tap tap = plan(2 * HSR_GRID_ORDERS + 1 + 7 + 7 + HSR_GRID_ORDERS + 1 +
                        4 + 2 * CAMERAS);
  for (enum hsr_grid_order order = 0; order < HSR_GRID_ORDERS; order++)
    check_once(&tap, order);
  check_interleaved(&tap);
  check_points(&tap);
  check_cells(&tap);
  check_sweep(&tap);
  for (enum hsr_grid_order order = 0; order < HSR_GRID_ORDERS; order++)
    check_parallel(&tap, order);
  check_classes(&tap);
  for (int k = 0; k < CAMERAS; k++)
    check_figure(&tap, &cameras[k]);
  return finish(&tap);
}
