/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sums are those of cube_frame.c, in the same order, so that they round
 * alike. Samples are found corner by corner. That comes to the same as finding
 * those of the outermost corner, since rounding never turns an order around. */
#include "algorithms/engines/cubes/cube_octants.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"

#include <math.h>

/* Eight boxes; number o is octant o. */
struct boxes {
  double centre[3][8], half[3][8];
};

static void gather(const struct hsr_octree *octree,
                   const struct hsr_octree_node *node, bool tight,
                   struct boxes *b) {
  for (int o = 0; o < 8; o++) {
    const struct hsr_octree_node *child =
        node->child[o] == HSR_NO_NODE ? node : &octree->node[node->child[o]];
    for (int k = 0; k < 3; k++) {
      b->centre[k][o] = tight ? child->tight.centre[k] : child->centre[k];
      b->half[k][o] = tight ? child->tight.half[k] : child->half;
    }
  }
}

/* A sample, or the end, within the window. */
static inline int within(double v, double first, double end) {
  v = v > first ? v : first;
  return (int)(v < end ? v : end);
}

/* What some corners span: the samples from x0 on and before x1, from y0 on and
 * before y1, and the nearest q. */
struct span {
  int x0, y0, x1, y1;
  float q;
};

/* What one function of (x, y, w) is: at a middle, and along three halves. */
struct sum {
  double base, i, j, k;
};

/* At a corner, whose signs are 1 or -1. */
static inline double at_corner(const struct sum *s, double i, double j,
                               double k) {
  return s->base + i * s->i + j * s->j + k * s->k;
}

/* Sample (0, 0) and the window. */
struct samples {
  double x, y, x0, y0, x1, y1;
};

static inline struct span corner(const struct sum *x, const struct sum *y,
                                 const struct sum *w, double i, double j,
                                 double k, const struct samples *s) {
  double r = 1 / at_corner(w, i, j, k);
  double sx = at_corner(x, i, j, k) * r, sy = at_corner(y, i, j, k) * r;
  return (struct span){
      within(ceil(sx - HSR_CUBE_MARGIN - s->x), s->x0, s->x1),
      within(ceil(sy - HSR_CUBE_MARGIN - s->y), s->y0, s->y1),
      within(floor(sx + HSR_CUBE_MARGIN - s->x) + 1, s->x0, s->x1),
      within(floor(sy + HSR_CUBE_MARGIN - s->y) + 1, s->y0, s->y1),
      (float)(r * (1 + 0x1p-18))};
}

static inline struct span join(struct span a, struct span b) {
  return (struct span){hsr_min_int(a.x0, b.x0), hsr_min_int(a.y0, b.y0),
                       hsr_max_int(a.x1, b.x1), hsr_max_int(a.y1, b.y1),
                       a.q > b.q ? a.q : b.q};
}

static inline void put(struct hsr_octants *restrict octants, int k, int o,
                       struct span a) {
  octants->x0[k][o] = a.x0;
  octants->y0[k][o] = a.y0;
  octants->x1[k][o] = a.x1;
  octants->y1[k][o] = a.y1;
  octants->q[k][o] = a.q;
}

/* r0 X + r1 Y + r2 Z + origin of a box. */
static inline struct sum sum_of(const double *row, double origin,
                                const struct boxes *restrict b, int o) {
  return (struct sum){row[0] * b->centre[0][o] + row[1] * b->centre[1][o] +
                          row[2] * b->centre[2][o] + origin,
                      row[0] * b->half[0][o], row[1] * b->half[1][o],
                      row[2] * b->half[2][o]};
}

/* In lanes: all of the loop is for each of the eight. */
HSR_VECTOR static void project(const struct hsr_placing *p, double near,
                               const struct samples *samples,
                               const struct boxes *restrict b,
                               struct hsr_octants *restrict octants) {
  const struct hsr_placing q = *p;
  const struct samples s = *samples;
  const double(*const row)[3] = q.way.rows;
  for (int o = 0; o < 8; o++) {
    struct sum x = sum_of(row[0], q.way.origin[0], b, o),
               y = sum_of(row[1], q.way.origin[1], b, o),
               w = sum_of(row[2], q.way.origin[2], b, o);
    octants->has_image[o] = w.base - fabs(w.i) - fabs(w.j) - fabs(w.k) > near;
    struct span c0 = corner(&x, &y, &w, -1, -1, -1, &s),
                c1 = corner(&x, &y, &w, 1, -1, -1, &s),
                c2 = corner(&x, &y, &w, -1, 1, -1, &s),
                c3 = corner(&x, &y, &w, 1, 1, -1, &s),
                c4 = corner(&x, &y, &w, -1, -1, 1, &s),
                c5 = corner(&x, &y, &w, 1, -1, 1, &s),
                c6 = corner(&x, &y, &w, -1, 1, 1, &s),
                c7 = corner(&x, &y, &w, 1, 1, 1, &s);
    struct span c01 = join(c0, c1), c23 = join(c2, c3), c45 = join(c4, c5),
                c67 = join(c6, c7);
    put(octants, 0, o, join(join(c0, c2), join(c4, c6)));
    put(octants, 1, o, join(c01, c45));
    put(octants, 2, o, join(c01, c23));
    put(octants, 3, o, join(join(c1, c3), join(c5, c7)));
    put(octants, 4, o, join(c23, c67));
    put(octants, 5, o, join(c45, c67));
    put(octants, HSR_WHOLE_CUBE, o, join(join(c01, c23), join(c45, c67)));
  }
}

/* The sides that may face the eye, as in cube_frame.c. */
HSR_VECTOR static void find_fronts(const struct hsr_placing *p,
                                   const struct boxes *restrict b,
                                   int *restrict front) {
  const double e0 = p->eye[0], e1 = p->eye[1], e2 = p->eye[2], slack = p->slack;
  for (int o = 0; o < 8; o++) {
    double x = e0 - b->centre[0][o], y = e1 - b->centre[1][o],
           z = e2 - b->centre[2][o];
    double a = b->half[0][o] - slack, c = b->half[1][o] - slack,
           d = b->half[2][o] - slack;
    front[o] = (x > -a ? 0 : 1) | (y > -c ? 0 : 2) | (z > -d ? 0 : 4) |
               (x < a ? 0 : 8) | (y < c ? 0 : 16) | (z < d ? 0 : 32);
  }
}

void hsr_octants_project(const struct hsr_cube_frame *frame,
                         const struct hsr_placing *placing,
                         const struct hsr_octree *octree,
                         const struct hsr_octree_node *node, bool tight,
                         struct hsr_octants *octants) {
  struct boxes boxes;
  const struct hsr_view *view = frame->job->view;
  const struct samples samples = {hsr_sample_x(view, 0), hsr_sample_y(view, 0),
                                  view->window.x0,       view->window.y0,
                                  view->window.x1,       view->window.y1};
  gather(octree, node, tight, &boxes);
  project(placing, fmax(placing->least, view->near * (1 + 0x1p-16)), &samples,
          &boxes, octants);
  find_fronts(placing, &boxes, octants->front);
}
