/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eight boxes against a polygon, each box in a lane. The proofs of the bounds
 * are in box.c. */
#include "common/trees/box.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"

#include <float.h>
#include <math.h>

static const double U = DBL_EPSILON / 2;
static const double TINY = 0x1p-960;

/* The lines of edges are tried only if a polygon has no more corners: it takes
 * the square of their number. */
enum { MANY = 64 };

void hsr_put_box(struct hsr_eight_boxes *boxes, int o,
                 const struct hsr_box *box) {
  boxes->size[o] = 0;
  for (int k = 0; k < 3; k++) {
    boxes->lo[k][o] = box->lo[k];
    boxes->hi[k][o] = box->hi[k];
    boxes->size[o] = hsr_max(boxes->size[o], hsr_max(-box->lo[k], box->hi[k]));
  }
}

/* What is asked of all boxes. */
struct question {
  const struct hsr_eight_boxes *boxes;
  struct hsr_loop polygon;
  double margin[8]; /* for a normal whose components sum up to 1 */
  double gap[8];    /* above 0: a plane is between box and polygon */
};

static inline const double *corner(const struct hsr_loop *polygon, uint32_t k,
                                   int axis) {
  const double *const at[3] = {polygon->x, polygon->y, polygon->z};
  return at[axis] + polygon->stride * polygon->vertex[k];
}

/* Along an axis: the bounds of the polygon, and the gaps. Returns the largest
 * coordinate. */
static inline double look_along(struct question *q, int axis, double slack) {
  double lo = *corner(&q->polygon, 0, axis), hi = lo;
  for (uint32_t k = 1; k < q->polygon.n; k++) {
    double x = *corner(&q->polygon, k, axis);
    lo = x < lo ? x : lo;
    hi = x > hi ? x : hi;
  }
  if (slack > 0) {
    lo = nextafter(lo - slack, -INFINITY);
    hi = nextafter(hi + slack, INFINITY);
  }
  const double *low = q->boxes->lo[axis], *high = q->boxes->hi[axis];
  for (int o = 0; o < 8; o++) {
    q->gap[o] = hsr_max(q->gap[o], low[o] - hi);
    q->gap[o] = hsr_max(q->gap[o], lo - high[o]);
  }
  return hsr_max(-lo, hi);
}

static inline unsigned without_gap(const struct question *q) {
  unsigned boxes = 0;
  for (int o = 0; o < 8; o++)
    boxes |= (unsigned)!(q->gap[o] > 0) << o;
  return boxes;
}

/* Which boxes hold a corner. */
static inline unsigned with_corner(const struct question *q) {
  double off[8]; /* 0: a corner is in the box */
  for (int o = 0; o < 8; o++)
    off[o] = INFINITY;
  for (uint32_t k = 0; k < q->polygon.n; k++) {
    double off_one[8] = {0};
    for (int axis = 0; axis < 3; axis++) {
      const double x = *corner(&q->polygon, k, axis);
      const double *lo = q->boxes->lo[axis], *hi = q->boxes->hi[axis];
      for (int o = 0; o < 8; o++)
        off_one[o] = hsr_max(off_one[o], hsr_max(lo[o] - x, x - hi[o]));
    }
    for (int o = 0; o < 8; o++)
      off[o] = hsr_min(off[o], off_one[o]);
  }
  unsigned boxes = 0;
  for (int o = 0; o < 8; o++)
    boxes |= (unsigned)(off[o] == 0) << o;
  return boxes;
}

/* Which boxes are certainly farther along the normal than all corners? Its
 * components along axes k, l and m are nk, nl and nm. */
static inline void look_beyond(struct question *q, int k, double nk, int l,
                               double nl, int m, double nm) {
  double most = -INFINITY;
  for (uint32_t c = 0; c < q->polygon.n; c++) {
    double at = nk * *corner(&q->polygon, c, k) +
                nl * *corner(&q->polygon, c, l) +
                (nm == 0 ? 0 : nm * *corner(&q->polygon, c, m));
    most = at > most ? at : most;
  }
  const double sum = fabs(nk) + fabs(nl) + fabs(nm);
  const struct hsr_eight_boxes *b = q->boxes; /* of which: the n-vertex */
  const double *x = nk < 0 ? b->hi[k] : b->lo[k];
  const double *y = nl < 0 ? b->hi[l] : b->lo[l];
  const double *z = nm < 0 ? b->hi[m] : b->lo[m];
  for (int o = 0; o < 8; o++) {
    double least = nk * x[o] + nl * y[o] + nm * z[o];
    double gap = least - (most + (sum * q->margin[o] + TINY));
    q->gap[o] = hsr_max(q->gap[o], gap);
  }
}

/* In the view along axis u: which are certainly outside an edge-line? In an
 * edge-on view these are on the plane, which was tried. */
static inline void look_outside(struct question *q, int u,
                                const double plane_normal[3]) {
  if (plane_normal[u] == 0)
    return;
  const struct hsr_loop *polygon = &q->polygon;
  double turn = plane_normal[u] > 0 ? 1 : -1;
  int k = (u + 1) % 3, l = (u + 2) % 3;
  uint32_t a = polygon->n - 1;
  for (uint32_t b = 0; b < polygon->n; a = b++) {
    double nk = turn * (*corner(polygon, b, l) - *corner(polygon, a, l));
    double nl = turn * (*corner(polygon, a, k) - *corner(polygon, b, k));
    look_beyond(q, k, nk, l, nl, u, 0);
  }
}

HSR_VECTOR unsigned
hsr_boxes_that_meet_polygon(const struct hsr_eight_boxes *boxes,
                            struct hsr_loop polygon, const double normal[3],
                            double slack) {
  struct question q = {.boxes = boxes, .polygon = polygon, .gap = {0}};
  double size = 0;
  for (int axis = 0; axis < 3; axis++)
    size = hsr_max(size, look_along(&q, axis, slack));
  if (without_gap(&q) == with_corner(&q))
    return without_gap(&q);
  for (int o = 0; o < 8; o++)
    q.margin[o] = slack + 16 * U * hsr_max(boxes->size[o], size);
  look_beyond(&q, 0, normal[0], 1, normal[1], 2, normal[2]);
  look_beyond(&q, 0, -normal[0], 1, -normal[1], 2, -normal[2]);
  for (int u = 0; u < 3 && polygon.n <= MANY && without_gap(&q); u++)
    look_outside(&q, u, normal);
  return without_gap(&q);
}
