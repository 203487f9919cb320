/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/peers/shared/projection.h"

#include <math.h>

struct box box_of_world(const struct hsr_world *world) {
  const double *const axis[3] = {world->mesh.x, world->mesh.y, world->mesh.z};
  struct box box;
  for (int k = 0; k < 3; k++) {
    box.low[k] = INFINITY;
    box.high[k] = -INFINITY;
    for (uint32_t v = 0; v < world->mesh.n_vertices; v++) {
      box.low[k] = fmin(box.low[k], axis[k][v]);
      box.high[k] = fmax(box.high[k], axis[k][v]);
    }
  }
  return box;
}

double box_nearest(const struct box *box, const struct hsr_view *view) {
  double nearest = 0;
  for (int k = 0; k < 3; k++)
    nearest += fmin(view->depth[k] * (box->low[k] - view->E[k]),
                    view->depth[k] * (box->high[k] - view->E[k]));
  return nearest;
}

void box_depths(const struct box *box, const struct hsr_view *view,
                double *nearest, double *farthest) {
  *nearest = INFINITY;
  *farthest = view->parallel ? -INFINITY : 0;
  for (int corner = 0; corner < 8; corner++) {
    double t = 0;
    for (int k = 0; k < 3; k++) {
      double at = corner >> k & 1 ? box->high[k] : box->low[k];
      t += view->depth[k] * (at - view->E[k]);
    }
    *nearest = fmin(*nearest, t);
    *farthest = fmax(*farthest, t);
  }
  if (view->parallel) {
    double margin = fmax(0.001 * (*farthest - *nearest), 0x1p-100);
    *farthest += margin;
    *nearest = fmin(fmax(*nearest - margin, view->near), *farthest - margin);
    return;
  }
  *farthest = fmax(1.001 * *farthest, 0x1p-100);
  *nearest = fmax(0.999 * *nearest, 0x1p-10 * *farthest);
  *nearest = fmin(fmax(*nearest, view->near), 0.999 * *farthest);
}

void clip_matrix(const struct hsr_view *view, double nearest, double farthest,
                 double matrix[16]) {
  double row[4][4] = {{0}}, range = farthest - nearest;
  double t = view->parallel ? 2 / range : (farthest + nearest) / range;
  for (int k = 0; k < 3; k++) {
    double w = view->screen[2][k];
    row[0][k] = 2 * view->screen[0][k] / view->m - w;
    row[1][k] = 2 * view->screen[1][k] / view->n - w;
    row[2][k] = t * view->depth[k];
    row[3][k] = w;
  }
  row[2][3] = view->parallel ? -(farthest + nearest) / range
                             : -2 * farthest * nearest / range;
  row[3][3] = view->parallel ? 1 : 0;
  for (int r = 0; r < 4; r++) {
    for (int k = 0; k < 3; k++)
      row[r][3] -= row[r][k] * view->E[k];
    for (int k = 0; k < 4; k++)
      matrix[4 * k + r] = row[r][k];
  }
}
