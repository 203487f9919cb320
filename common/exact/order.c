/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notation    u = 2^-53. The height of a point V over the plane of g is
 *             N_g.(V - P_g), not normalised.
 *
 * The error of a height is the error of N times |V - P|_1, the anchor's times
 * |N|_1, one rounding of the difference, and three of the products and sums, as
 * in find_deviation of planes.c; all are doubled. A point of an outline is
 * itself off by a few roundings for every time that it was clipped. 2^-44 of
 * the largest coordinate covers them for pieces of fewer than two hundred cuts,
 * so the error of its height has 2^-43 |N|_1 |V|inf more. */
#include "common/exact/order.h"
#include "common/view/clip.h"
#include "common/exact/predicates.h"

#include <float.h>

static const double U = DBL_EPSILON / 2;
static const double TINY = 0x1p-960;

/* --- Heights -------------------------------------------------------------- */

static double sum_of_sizes(const double v[3]) {
  return fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
}

/* Height of a point over the plane of g, and a bound of its error. */
static double height(const struct hsr_world *w, uint32_t g, const double p[3],
                     bool exact, double *error) {
  const double n[3] = {w->mesh.nx[g], w->mesh.ny[g], w->mesh.nz[g]};
  const double r[3] = {p[0] - w->mesh.px[g], p[1] - w->mesh.py[g],
                       p[2] - w->mesh.pz[g]};
  double n1 = sum_of_sizes(n), r1 = sum_of_sizes(r);
  *error = 2 * (w->mesh.n_error[g] * r1 + w->mesh.anchor_error[g] * n1) +
           16 * U * n1 * r1 + TINY;
  if (!exact)
    *error += 0x1p-43 * n1 * sum_of_sizes(p);
  return n[0] * r[0] + n[1] * r[1] + n[2] * r[2];
}

int hsr_eye_side(const struct hsr_screen *screen, uint32_t g,
                 struct hsr_tally *tally) {
  if (screen->facing[g])
    return screen->facing[g];
  tally->exact[HSR_ASK_FACING]++;
  return hsr_exact_plane_side(hsr_plane_loop(screen->world, g), screen->view->E,
                              &tally->out_of_memory);
}

/* The most by which the height over g of a seen point of f may differ from the
 * heights of f's polygon: see Thickness. */
static double thickness(const struct hsr_screen *screen, uint32_t f,
                        uint32_t g) {
  const struct hsr_world *world = screen->world;
  double deviation = world->mesh.deviation[f], error_f, error_g;
  if (deviation == 0)
    return 0;
  double h_f = fabs(height(world, f, screen->view->E, true, &error_f));
  double h_g = fabs(height(world, g, screen->view->E, true, &error_g));
  double clear = h_f - error_f - deviation;
  return clear > deviation ? 2 * (h_g + error_g) * deviation / clear : INFINITY;
}

bool hsr_grazes(const struct hsr_screen *screen, uint32_t f, double reach) {
  const struct hsr_world *world = screen->world;
  const double *E = screen->view->E;
  double deviation = world->mesh.deviation[f], farthest = 0, error;
  if (deviation == 0)
    return false;
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
    uint32_t v = world->mesh.vertex[k];
    const double d[3] = {world->mesh.x[v] - E[0], world->mesh.y[v] - E[1],
                         world->mesh.z[v] - E[2]};
    farthest = fmax(farthest, sum_of_sizes(d));
  }
  double clear = fabs(height(world, f, E, true, &error)) - error - deviation;
  return !(clear > 0 && farthest * deviation <= reach * clear);
}

/* --- Before and beyond ---------------------------------------------------- */

static uint32_t n_points(const struct hsr_world *world, struct hsr_polygon p) {
  return p.outline ? p.n : hsr_face_size(world, p.face);
}

/* Point k of a polygon; returns its vertex, or HSR_NO_ID. */
static uint32_t point_of(const struct hsr_world *world,
                         struct hsr_polygon polygon, uint32_t k, double p[3]) {
  if (polygon.outline) {
    for (int c = 0; c < 3; c++)
      p[c] = polygon.outline[k][c];
    return HSR_NO_ID;
  }
  uint32_t v = world->mesh.vertex[world->mesh.start[polygon.face] + k];
  p[0] = world->mesh.x[v];
  p[1] = world->mesh.y[v];
  p[2] = world->mesh.z[v];
  return v;
}

/* Whether all points are on this side of the plane of g, or on it. */
static enum hsr_certainty on_side(const struct hsr_screen *screen,
                                  struct hsr_polygon polygon, uint32_t g,
                                  int side, struct hsr_tally *tally) {
  const struct hsr_world *world = screen->world;
  double thick = thickness(screen, polygon.face, g);
  enum hsr_certainty certainty = HSR_YES;
  for (uint32_t k = 0; k < n_points(world, polygon); k++) {
    double p[3], error;
    uint32_t v = point_of(world, polygon, k, p);
    if (thick == 0 && v != HSR_NO_ID && hsr_on_plane(world, g, v))
      continue; /* a vertex of both */
    double off = side * height(world, g, p, !polygon.outline, &error);
    if (off > thick + error)
      continue;
    if (off < -(thick + error + 2 * world->mesh.deviation[g]))
      return HSR_NO;
    if (polygon.outline) /* in doubt: ask whether all of the face is there */
      return on_side(screen, (struct hsr_polygon){polygon.face, NULL, 0}, g,
                     side, tally);
    if (thick > 0) {
      certainty = HSR_NEARLY;
      continue;
    }
    tally->exact[HSR_ASK_VERTEX]++;
    if (hsr_exact_plane_side(hsr_plane_loop(world, g), p,
                             &tally->out_of_memory) *
            side >=
        0)
      continue;
    if (world->mesh.deviation[g] == 0)
      return HSR_NO;
    certainty = HSR_NEARLY;
  }
  return certainty;
}

enum hsr_certainty hsr_beyond(const struct hsr_screen *screen,
                              struct hsr_polygon polygon, uint32_t g,
                              struct hsr_tally *tally) {
  return on_side(screen, polygon, g, -hsr_eye_side(screen, g, tally), tally);
}

enum hsr_certainty hsr_before(const struct hsr_screen *screen,
                              struct hsr_polygon polygon, uint32_t g,
                              struct hsr_tally *tally) {
  return on_side(screen, polygon, g, hsr_eye_side(screen, g, tally), tally);
}

/* --- Outlines ------------------------------------------------------------- */

uint32_t hsr_divide_outline(const struct hsr_screen *screen,
                            struct hsr_polygon polygon, struct hsr_cut cut,
                            double (*points)[3], double (*scratch)[3]) {
  const struct hsr_world *world = screen->world;
  uint32_t g = cut.face, n = n_points(world, polygon);
  const double anchor[3] = {world->mesh.px[g], world->mesh.py[g],
                            world->mesh.pz[g]};
  const double plane[3] = {cut.side * world->mesh.nx[g],
                           cut.side * world->mesh.ny[g],
                           cut.side * world->mesh.nz[g]};
  double margin = 0;
  for (uint32_t k = 0; k < n; k++) {
    double p[3], error;
    point_of(world, polygon, k, p);
    height(world, g, p, false, &error);
    margin = fmax(margin, error);
    for (int c = 0; c < 3; c++)
      scratch[k][c] = p[c] - anchor[c];
  }
  margin = 2 * margin + thickness(screen, polygon.face, g);
  int left =
      hsr_clip((const double(*)[3])scratch, (int)n, plane, margin, points);
  for (int k = 0; k < left; k++)
    for (int c = 0; c < 3; c++)
      points[k][c] += anchor[c];
  return (uint32_t)left;
}

/* w sx, w sy, w of a point, and a bound of their errors. */
static void homogeneous(const struct hsr_view *view, const double p[3],
                        double h[3], double error[3]) {
  const double d[3] = {p[0] - view->E[0], p[1] - view->E[1], p[2] - view->E[2]};
  double off = 16 * U * sum_of_sizes(d) + 0x1p-44 * sum_of_sizes(p) + TINY;
  for (int k = 0; k < 3; k++) {
    const double *row = view->screen[k];
    h[k] = row[0] * d[0] + row[1] * d[1] + row[2] * d[2];
    error[k] = off * sum_of_sizes(row);
  }
}

/* Narrows [*begin, *end) to the samples within [lo, hi] pixels, with a pixel to
 * spare. */
static void narrow_samples(double lo, double hi, int *begin, int *end) {
  if (lo - 1 > *begin)
    *begin = lo - 1 < *end ? (int)(lo - 1) : *end;
  if (hi + 1 < *end)
    *end = hi + 1 > *begin ? (int)(hi + 1) : *begin;
}

struct hsr_bounds hsr_outline_bounds(const struct hsr_screen *screen,
                                     struct hsr_polygon polygon) {
  struct hsr_bounds bounds = screen->bounds[polygon.face];
  double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
  for (uint32_t k = 0; k < polygon.n; k++) {
    double h[3], error[3];
    homogeneous(screen->view, polygon.outline[k], h, error);
    /* The division by w leaves errors of less than a quarter of a pixel. */
    if (!(h[2] > 8 * (error[0] + error[1] + HSR_GUARD * error[2])))
      return bounds;
    x0 = fmin(x0, h[0] / h[2]);
    x1 = fmax(x1, h[0] / h[2]);
    y0 = fmin(y0, h[1] / h[2]);
    y1 = fmax(y1, h[1] / h[2]);
  }
  /* Thickness moves points along their rays, so it does not matter here. */
  narrow_samples(x0, x1, &bounds.x0, &bounds.x1);
  narrow_samples(y0, y1, &bounds.y0, &bounds.y1);
  return bounds;
}

void hsr_depth_range(const struct hsr_screen *screen,
                     struct hsr_polygon polygon, double *nearest,
                     double *farthest) {
  const struct hsr_world *world = screen->world;
  double deviation = world->mesh.deviation[polygon.face], stretch = 1;
  *nearest = INFINITY;
  *farthest = 0;
  for (uint32_t k = 0; k < n_points(world, polygon); k++) {
    double p[3], h[3], error[3];
    point_of(world, polygon, k, p);
    homogeneous(screen->view, p, h, error);
    *nearest = fmin(*nearest, h[2] - error[2]);
    *farthest = fmax(*farthest, h[2] + error[2]);
  }
  if (deviation > 0) {
    double error;
    double h = fabs(height(world, polygon.face, screen->view->E, true, &error));
    double clear = h - error - deviation;
    stretch = clear > deviation ? 1 + 2 * deviation / clear : INFINITY;
  }
  *nearest = *nearest > 0 ? *nearest / stretch * (1 - 8 * U) : 0;
  *farthest = *farthest * stretch * (1 + 8 * U);
}

/* 1/w is linear on the screen, so it is least and greatest at corners. */
void hsr_narrow_depth_range(const struct hsr_screen *screen, uint32_t f,
                            const struct hsr_bounds *bounds, double *nearest,
                            double *farthest) {
  double least = INFINITY, greatest = 0, error = screen->plane[f].error;
  for (int corner = 0; corner < 4; corner++) {
    double q = hsr_depth(screen, f, corner & 1 ? bounds->x1 - 1 : bounds->x0,
                         corner & 2 ? bounds->y1 - 1 : bounds->y0);
    least = fmin(least, q);
    greatest = fmax(greatest, q);
  }
  if (greatest > 0)
    *nearest = fmax(*nearest, 1 / (greatest + error) * (1 - 8 * U));
  if (least > error)
    *farthest = fmin(*farthest, 1 / (least - error) * (1 + 8 * U));
}
