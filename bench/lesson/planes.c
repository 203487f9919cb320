/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Planes, as far as the scene goes: for slides, and for what the page is given. */
#include "bench/lesson/lesson.h"

#include <math.h>
#include <string.h>

struct lesson_plane lesson_plane_of_face(const struct hsr_mesh *mesh,
                                         uint32_t face) {
  struct lesson_plane p = {{mesh->nx[face], mesh->ny[face], mesh->nz[face]}, 0};
  p.offset = p.normal[0] * mesh->px[face] + p.normal[1] * mesh->py[face] +
             p.normal[2] * mesh->pz[face];
  return p;
}

/* Around all points of the scene, a little wider. */
static void scene_box(const struct hsr_mesh *mesh, double lo[3], double hi[3]) {
  const double *at[3] = {mesh->x, mesh->y, mesh->z};
  for (int k = 0; k < 3; k++) {
    lo[k] = INFINITY;
    hi[k] = -INFINITY;
    for (uint32_t p = 0; p < mesh->n_vertices; p++) {
      lo[k] = fmin(lo[k], at[k][p]);
      hi[k] = fmax(hi[k], at[k][p]);
    }
    double more = .04 * (hi[k] - lo[k]) + 1e-6;
    lo[k] -= more;
    hi[k] += more;
  }
}

/* Puts the points in their order around the middle. */
static void put_around(double (*at)[3], int n, const double normal[3]) {
  double middle[3] = {0}, angle[LESSON_MOST_CORNERS];
  int axis = 0;
  for (int c = 0; c < n; c++)
    for (int k = 0; k < 3; k++)
      middle[k] += at[c][k] / n;
  for (int k = 1; k < 3; k++)
    if (fabs(normal[k]) > fabs(normal[axis]))
      axis = k;
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (int c = 0; c < n; c++)
    angle[c] = atan2(at[c][v] - middle[v], at[c][u] - middle[u]);
  for (int c = 1; c < n; c++)
    for (int d = c; d > 0 && angle[d] < angle[d - 1]; d--) {
      double swap[4] = {angle[d], at[d][0], at[d][1], at[d][2]};
      angle[d] = angle[d - 1];
      memcpy(at[d], at[d - 1], sizeof at[d]);
      angle[d - 1] = swap[0];
      memcpy(at[d - 1], swap + 1, sizeof at[d]);
    }
}

int lesson_plane_in_box(const struct hsr_mesh *mesh,
                        const struct lesson_plane *plane, double (*at)[3]) {
  double lo[3], hi[3];
  int n = 0;
  scene_box(mesh, lo, hi);
  for (int c = 0; c < 8; c++)
    for (int axis = 0; axis < 3; axis++) {
      if (c >> axis & 1)
        continue;
      double p[3], s = -plane->offset;
      for (int k = 0; k < 3; k++) {
        p[k] = c >> k & 1 ? hi[k] : lo[k];
        s += plane->normal[k] * p[k];
      }
      double t = s + plane->normal[axis] * (hi[axis] - lo[axis]);
      if ((s < 0) == (t < 0) || n == LESSON_MOST_CORNERS)
        continue;
      memcpy(at[n], p, sizeof p);
      at[n++][axis] += (hi[axis] - lo[axis]) * s / (s - t);
    }
  put_around(at, n, plane->normal);
  return n;
}

json_t *lesson_image_json(const struct hsr_view *view, const double (*at)[3],
                          int n) {
  double in[LESSON_MOST_POINTS][3],
      out[LESSON_MOST_POINTS + LESSON_MOST_POINTS / 2 + 1][3];
  for (int k = 0; k < n; k++)
    hsr_view_project(view, at[k], in[k]);
  return trace_polygon_json(view, (const double(*)[3])in, n, out);
}
