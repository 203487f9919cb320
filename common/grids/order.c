/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/grids/order.h"

#include <math.h>
#include <stdlib.h>

const char *const hsr_grid_order_name[HSR_GRID_ORDERS] = {
    "btf", "wbtf", "vbuffer", "pbtf", "ippbtf", "octree-order"};

const int hsr_grid_nesting[6][3] = {{2, 1, 0}, {2, 0, 1}, {1, 2, 0},
                                    {1, 0, 2}, {0, 2, 1}, {0, 1, 2}};

int32_t hsr_grid_split(const double *position, uint32_t n, double eye) {
  uint32_t low = 0, high = n; /* positions below `low` are not above the eye */
  while (low < high) {
    uint32_t middle = low + (high - low) / 2;
    if (position[middle] <= eye)
      low = middle + 1;
    else
      high = middle;
  }
  return (int32_t)low - 1;
}

struct visitor {
  const struct hsr_grid_seen *seen;
  hsr_visit_run *visit;
  void *data;
  bool front;
};

/* --- Loops ---------------------------------------------------------------- */

/* The cells first, first + step, ... of an axis, n of them. */
struct loop {
  uint32_t first, n;
  int step;
};

static struct loop upwards(uint32_t from, uint32_t to) {
  return (struct loop){from, to - from, 1};
}

static struct loop reversed(struct loop loop) {
  uint32_t last =
      (uint32_t)((int64_t)loop.first + ((int64_t)loop.n - 1) * loop.step);
  return (struct loop){last, loop.n, -loop.step};
}

static uint32_t cell_of(struct loop loop, uint32_t k) {
  return (uint32_t)((int64_t)loop.first + (int64_t)k * loop.step);
}

/* Three nested loops; those of an empty octant visit nothing. */
static void nest(const struct visitor *v, const int axis[3],
                 const struct loop loop[3]) {
  struct loop outer = loop[axis[0]], middle = loop[axis[1]],
              inner = loop[axis[2]];
  struct hsr_grid_run run = {.axis = axis[2], .step = inner.step, .n = inner.n};
  for (uint32_t i = 0; i < outer.n && inner.n; i++) {
    run.at[axis[0]] = cell_of(outer, i);
    for (uint32_t j = 0; j < middle.n; j++) {
      run.at[axis[1]] = cell_of(middle, j);
      run.at[axis[2]] = inner.first;
      v->visit(v->data, &run);
    }
  }
}

/* --- btf and wbtf --------------------------------------------------------- */

/* From the end that is nearest to the view plane, or else from the other. */
static struct loop along_view(const struct visitor *v, int axis) {
  struct loop loop = upwards(0, v->seen->n[axis]);
  return (v->seen->toward[axis] >= 0) == v->front ? loop : reversed(loop);
}

static void visit_along_view(const struct visitor *v, const int axis[3]) {
  struct loop loop[3];
  for (int a = 0; a < 3; a++)
    loop[a] = along_view(v, a);
  nest(v, axis, loop);
}

/* The axes, the one closest to the view direction first. */
static void sort_axes(const double toward[3], int axis[3]) {
  axis[0] = 0;
  for (int k = 1; k < 3; k++) {
    int i = k;
    for (; i > 0 && fabs(toward[k]) > fabs(toward[axis[i - 1]]); i--)
      axis[i] = axis[i - 1];
    axis[i] = k;
  }
}

/* --- vbuffer -------------------------------------------------------------- */

struct place {
  double depth;
  uint32_t a, b;
};

static int by_depth(const void *p, const void *q) {
  const struct place *a = p, *b = q;
  if (a->depth != b->depth)
    return a->depth < b->depth ? -1 : 1;
  if (a->a != b->a)
    return a->a < b->a ? -1 : 1;
  return a->b < b->b ? -1 : a->b > b->b;
}

/* Where cell k is along an axis. */
static double middle_of(const struct hsr_grid_seen *s, int axis, uint32_t k) {
  return s->at[axis] ? s->at[axis][k] : k;
}

static enum hsr_status visit_vbuffer(const struct visitor *v,
                                     struct hsr_error *err) {
  const struct hsr_grid_seen *s = v->seen;
  int axis[3];
  sort_axes(s->toward, axis);
  size_t n_a = s->n[axis[1]], n_b = s->n[axis[2]], n = n_a * n_b;
  struct place *slice = malloc(n * sizeof *slice);
  if (!slice)
    return hsr_fail_nomem(err);
  for (size_t k = 0; k < n; k++) {
    slice[k].a = (uint32_t)(k / n_b);
    slice[k].b = (uint32_t)(k % n_b);
    slice[k].depth = s->toward[axis[1]] * middle_of(s, axis[1], slice[k].a) +
                     s->toward[axis[2]] * middle_of(s, axis[2], slice[k].b);
  }
  qsort(slice, n, sizeof *slice, by_depth);
  struct loop outer = along_view(v, axis[0]);
  struct hsr_grid_run run = {.axis = axis[2], .step = 1, .n = 1};
  for (uint32_t i = 0; i < outer.n; i++) {
    run.at[axis[0]] = cell_of(outer, i);
    for (size_t k = 0; k < n; k++) {
      const struct place *place = &slice[v->front ? k : n - 1 - k];
      run.at[axis[1]] = place->a;
      run.at[axis[2]] = place->b;
      v->visit(v->data, &run);
    }
  }
  free(slice);
  return HSR_OK;
}

/* --- pbtf ----------------------------------------------------------------- */

/* A side of an axis, from near to far or, from back to front, from far to near.
 */
static struct loop side_of(const struct visitor *v, int axis, bool high) {
  uint32_t first = (uint32_t)(v->seen->q[axis] + 1);
  struct loop near =
      high ? upwards(first, v->seen->n[axis]) : reversed(upwards(0, first));
  return v->front ? near : reversed(near);
}

/* Octant k has the high side of axis a if bit a is set. */
static void visit_pbtf(const struct visitor *v, const int axis[3]) {
  bool from_zero = v->front != v->seen->high_first;
  for (int k = 0; k < 8; k++) {
    int octant = from_zero ? k : 7 - k;
    struct loop loop[3];
    bool is_empty = false;
    for (int a = 0; a < 3; a++) {
      loop[a] = side_of(v, a, octant >> a & 1);
      is_empty |= !loop[a].n;
    }
    if (!is_empty)
      nest(v, axis, loop);
  }
}

/* --- ippbtf --------------------------------------------------------------- */

/* The cells of an axis by their distance from cell q; of two, the lower one
 * first. */
static void interleave(uint32_t n, int32_t q, uint32_t *cell) {
  int64_t low = q, high = (int64_t)q + 1;
  if (low >= 0)
    *cell++ = (uint32_t)low--;
  while (low >= 0 || high < n) {
    if (low >= 0 && (high >= n || q - low <= high - q))
      *cell++ = (uint32_t)low--;
    else
      *cell++ = (uint32_t)high++;
  }
}

static enum hsr_status visit_interleaved(const struct visitor *v,
                                         const int axis[3],
                                         struct hsr_error *err) {
  const uint32_t *n = v->seen->n;
  uint32_t *cell = malloc(((size_t)n[0] + n[1] + n[2]) * sizeof *cell);
  if (!cell)
    return hsr_fail_nomem(err);
  uint32_t *list[3] = {cell, cell + n[0], cell + n[0] + n[1]};
  for (int a = 0; a < 3; a++)
    interleave(n[a], v->seen->q[a], list[a]);
  struct hsr_grid_run run = {.axis = axis[2], .step = 1, .n = 1};
  uint32_t last[3] = {n[0] - 1, n[1] - 1, n[2] - 1}, k[3];
  for (k[0] = 0; k[0] < n[axis[0]]; k[0]++)
    for (k[1] = 0; k[1] < n[axis[1]]; k[1]++)
      for (k[2] = 0; k[2] < n[axis[2]]; k[2]++) {
        for (int level = 0; level < 3; level++) {
          int a = axis[level];
          run.at[a] = list[a][v->front ? k[level] : last[a] - k[level]];
        }
        v->visit(v->data, &run);
      }
  free(cell);
  return HSR_OK;
}

/* --- octree-order --------------------------------------------------------- */

/* A node is a cube of cells. Its lowest cell is `lo`, and it has `size` cells,
 * a power of two, along each axis. */
static void visit_node(const struct visitor *v, const uint32_t lo[3],
                       uint32_t size) {
  if (lo[0] >= v->seen->n[0] || lo[1] >= v->seen->n[1] ||
      lo[2] >= v->seen->n[2])
    return;
  if (size == 1) {
    struct hsr_grid_run run = {{lo[0], lo[1], lo[2]}, 0, 1, 1};
    v->visit(v->data, &run);
    return;
  }
  /* The child nearest to the eye: on each axis the half that the eye is in, or
   * is nearer to. */
  unsigned nearest = 0;
  for (int a = 0; a < 3; a++)
    if ((int64_t)v->seen->q[a] >= (int64_t)lo[a] + size / 2)
      nearest |= 1u << a;
  for (unsigned k = 0; k < 8; k++) {
    unsigned child = nearest ^ (v->front ? k : 7 - k);
    uint32_t corner[3];
    for (int a = 0; a < 3; a++)
      corner[a] = lo[a] + (child >> a & 1 ? size / 2 : 0);
    visit_node(v, corner, size / 2);
  }
}

static void visit_octree(const struct visitor *v) {
  uint32_t size = 1;
  for (int a = 0; a < 3; a++)
    while (size < v->seen->n[a])
      size *= 2;
  visit_node(v, (const uint32_t[3]){0, 0, 0}, size);
}

/* --- All ------------------------------------------------------------------ */

enum hsr_status hsr_grid_visit(enum hsr_grid_order order, int nesting,
                               bool front, const struct hsr_grid_seen *seen,
                               hsr_visit_run *visit, void *data,
                               struct hsr_error *err) {
  struct visitor v = {seen, visit, data, front};
  const int *axis = hsr_grid_nesting[nesting];
  int sorted[3];
  switch (order) {
  case HSR_BTF:
    visit_along_view(&v, axis);
    return HSR_OK;
  case HSR_WBTF:
    sort_axes(seen->toward, sorted);
    visit_along_view(&v, sorted);
    return HSR_OK;
  case HSR_VBUFFER:
    return visit_vbuffer(&v, err);
  case HSR_PBTF:
    visit_pbtf(&v, axis);
    return HSR_OK;
  case HSR_IPPBTF:
    return visit_interleaved(&v, axis, err);
  case HSR_OCTREE:
    visit_octree(&v);
    return HSR_OK;
  case HSR_GRID_ORDERS:
    break;
  }
  return hsr_fail(err, HSR_E_INTERNAL, "no such order of a grid");
}
