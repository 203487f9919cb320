/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes of cells on the screen.
 *
 * The homogeneous screen coordinates of a corner are S v + o, v = corner - E,
 * where S is the view's screen matrix and o its origin (common/view/view.h);
 * its depth t is a linear form of v. In perspective o = 0, and t is w. A
 * coordinate is the sum of one product an axis, and a product depends on one
 * bound only: so the products are made once a frame, and a corner takes two
 * additions a coordinate. The operations on a corner are those of
 * common/exact/screen.c, whose proofs ("Vertices", "Parallel") hold here: a
 * coordinate is within 8u |S_c|_1 r of the true one, r = |v|inf, u = 2^-53, and
 * 2^-960 covers underflow; a corner with w >= kappa r and |sx|, |sy| <=
 * HSR_GUARD is safe, and then sx and sy are within HSR_DELTA. In parallel o is
 * added to the last product and not to the sum, which rounds once more by u (m
 * + n) at most: that is the slack, and is far below HSR_DELTA / 4.
 *
 * Out of sight. Let h be a row of numbers and h . A, A = S v, its value at a
 * corner. h . A is linear in v, so if it is negative at all corners it is so in
 * the whole box. (-1, 0, x0) is negative at a point before the eye only if the
 * point lies right of x0; and so for the other three sides of the window. The
 * samples of the window are strictly within [x0, x1] x [y0, y1], since an
 * offset is less than 1/2. Each product and sum rounds by at most 2u of the
 * terms, which the margin below covers four times. A box with t <= near
 * everywhere is hit at no t > near. */
#include "algorithms/engines/cells/cells.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"

#include <float.h>

static const double U = DBL_EPSILON / 2;
static const double TINY = 0x1p-960;

static double sum_of_sizes(const double v[3]) {
  return fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
}

void hsr_cells_project(struct hsr_cells *cells) {
  const struct hsr_view *view = cells->job->view;
  for (int a = 0; a < 3; a++)
    for (uint32_t k = 0; k <= cells->grid->n[a]; k++) {
      double v = cells->grid->bound[a][k] - view->E[a];
      cells->far[a][k] = fabs(v);
      for (int c = 0; c < 3; c++)
        cells->term[a][c][k] =
            view->screen[c][a] * v + (a == 2 ? view->origin[c] : 0);
      cells->term[a][3][k] = view->depth[a] * v;
    }
  for (int c = 0; c < 3; c++)
    cells->error[c] = 8 * U * sum_of_sizes(view->screen[c]);
  cells->error[3] = 8 * U * sum_of_sizes(view->depth);
  cells->slack = TINY + 8 * U * (fabs(view->origin[0]) + fabs(view->origin[1]));
  cells->kappa = (hsr_max(cells->error[0], cells->error[1]) +
                  HSR_GUARD * cells->error[2]) *
                 (4 / HSR_DELTA);
}

/* Homogeneous coordinates of the eight corners. */
struct corners {
  double A[4][8]; /* [3]: depths */
  double r;       /* no corner is farther from the eye along any axis */
};

static inline void find_corners(const struct hsr_cells *cells,
                                const uint32_t lo[3], const uint32_t hi[3],
                                struct corners *p) {
  double *const(*term)[4] = cells->term;
  for (int c = 0; c < 4; c++) {
    double x[2] = {term[0][c][lo[0]], term[0][c][hi[0] + 1]};
    double y[2] = {term[1][c][lo[1]], term[1][c][hi[1] + 1]};
    double z[2] = {term[2][c][lo[2]], term[2][c][hi[2] + 1]};
    double xy[4] = {x[0] + y[0], x[1] + y[0], x[0] + y[1], x[1] + y[1]};
    for (int k = 0; k < 4; k++) {
      p->A[c][k] = xy[k] + z[0];
      p->A[c][k + 4] = xy[k] + z[1];
    }
  }
  p->r = 0;
  for (int a = 0; a < 3; a++)
    p->r =
        hsr_max(p->r, hsr_max(cells->far[a][lo[a]], cells->far[a][hi[a] + 1]));
}

/* The least and greatest of eight. */
static inline void range(const double v[8], double *lo, double *hi) {
  double least[4], most[4];
  for (int k = 0; k < 4; k++) {
    least[k] = v[k] < v[k + 4] ? v[k] : v[k + 4];
    most[k] = v[k] > v[k + 4] ? v[k] : v[k + 4];
  }
  for (int k = 0; k < 2; k++) {
    least[k] = least[k] < least[k + 2] ? least[k] : least[k + 2];
    most[k] = most[k] > most[k + 2] ? most[k] : most[k + 2];
  }
  *lo = least[0] < least[1] ? least[0] : least[1];
  *hi = most[0] > most[1] ? most[0] : most[1];
}

/* --- On the screen -------------------------------------------------------- */

/* The samples of the window, from `from` to `to`, that may lie within [lo, hi]
 * on the screen; `first` is where sample 0 is. A corner is off by little more
 * than HSR_DELTA / 4, and hsr_cells_whole by less than that. */
static inline void sample_range(double lo, double hi, double first, int from,
                                int to, int *begin, int *end) {
  int a = hsr_cells_whole(lo - HSR_DELTA - first) + 1;
  int b = hsr_cells_whole(hi + HSR_DELTA - first) + 1;
  *begin = a > from ? a : from;
  *end = b < to ? b : to;
}

/* Whether all corners are safe, as far as w tells, and beyond near. In
 * perspective S_2 is F but for rounding, so r is above 2^-500 where w is 2^-490
 * at least; and what is before the eye needs no test against near = 0. */
static inline bool is_clear(const struct hsr_cells *cells,
                            const struct corners *p) {
  const struct hsr_view *view = cells->job->view;
  double w, t, most;
  range(p->A[2], &w, &most);
  if (!(w >= cells->kappa * p->r && w >= 0x1p-490))
    return false;
  if (!view->parallel && view->near == 0)
    return true;
  range(p->A[3], &t, &most);
  return t - cells->error[3] * p->r - TINY > view->near;
}

/* Fills sx, sy and the bounds of a box whose corners are safe and beyond near;
 * false if they are not. */
static inline bool place(const struct hsr_cells *cells, const struct corners *p,
                         struct hsr_cell_box *box) {
  const struct hsr_view *view = cells->job->view;
  const struct hsr_window *w = &cells->window;
  double x0, x1, y0, y1;
  if (!is_clear(cells, p))
    return false;
  for (int k = 0; k < 8; k++) {
    double q = 1 / p->A[2][k];
    box->sx[k] = p->A[0][k] * q;
    box->sy[k] = p->A[1][k] * q;
  }
  range(box->sx, &x0, &x1);
  range(box->sy, &y0, &y1);
  if (!(x0 >= -HSR_GUARD && x1 <= HSR_GUARD && y0 >= -HSR_GUARD &&
        y1 <= HSR_GUARD))
    return false;
  sample_range(x0, x1, hsr_sample_x(view, 0), w->x0, w->x1, &box->bounds.x0,
               &box->bounds.x1);
  sample_range(y0, y1, hsr_sample_y(view, 0), w->y0, w->y1, &box->bounds.y0,
               &box->bounds.y1);
  return true;
}

/* --- Out of sight --------------------------------------------------------- */

/* Whether h . A, h = (h0, h1, h2), is certainly negative at all corners. */
static bool is_beside(const struct corners *p, double h0, double h1, double h2,
                      double margin) {
  double value[8], least, most;
  for (int k = 0; k < 8; k++)
    value[k] = h0 * p->A[0][k] + h1 * p->A[1][k] + h2 * p->A[2][k];
  range(value, &least, &most);
  return most < -margin;
}

static bool is_out_of_sight(const struct hsr_cells *cells,
                            const struct corners *p) {
  const struct hsr_window *w = &cells->window;
  double e[3], least, most;
  for (int c = 0; c < 3; c++)
    e[c] = cells->error[c] * p->r + cells->slack;
  double x = 4 * (e[0] + w->x1 * e[2]), y = 4 * (e[1] + w->y1 * e[2]);
  range(p->A[3], &least, &most);
  return most + cells->error[3] * p->r + TINY <= cells->job->view->near ||
         is_beside(p, 1, 0, -w->x0, x) || is_beside(p, -1, 0, w->x1, x) ||
         is_beside(p, 0, 1, -w->y0, y) || is_beside(p, 0, -1, w->y1, y);
}

bool hsr_cells_box(const struct hsr_cells *cells, const uint32_t lo[3],
                   const uint32_t hi[3], struct hsr_cell_box *box) {
  const struct hsr_window *w = &cells->window;
  struct corners corners;
  find_corners(cells, lo, hi, &corners);
  box->is_safe = place(cells, &corners, box);
  if (box->is_safe)
    return box->bounds.x0 < box->bounds.x1 && box->bounds.y0 < box->bounds.y1;
  box->bounds = (struct hsr_bounds){w->x0, w->y0, w->x1, w->y1};
  return !is_out_of_sight(cells, &corners);
}
