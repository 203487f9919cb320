/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notation    u = 2^-53. The height of a point V over the plane of g is
 *             N_g.(V - P_g), not normalised.
 *
 * The error of a height is the error of N times |V - P|_1, the anchor's times
 * |N|_1, one rounding of the difference, and three of the products and sums, as
 * in find_deviation of planes.c; all are doubled. A point of an outline is
 * itself off by a few roundings for every time that its face was cut. The point
 * lies between two others, and they may be much farther out than it is. So the
 * roundings are those of the face's largest vertex, whose size (the sum of its
 * coordinates' sizes) is S: a cut adds at most 6 u S. An outline starts with
 * 2^-44 S, and each cut adds 8 u S. The error of a point's height has 2 |N|_1
 * times that more.
 *
 * Range. Coordinates are at most 1e30 and the normals 1e62, so no product
 * overflows. 2^-960 covers what underflows in a sum of products: each term of
 * it is a double within 2^-1074 of the true one, times 1e62 at most. */
#include "common/exact/order.h"
#include "common/exact/predicates.h"

#include <float.h>
#include <string.h>

static const double U = DBL_EPSILON / 2;
static const double TINY = 0x1p-960;

/* --- Heights -------------------------------------------------------------- */

static double sum_of_sizes(const double v[3]) {
  return fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
}

/* Height of a point over the plane of g, and a bound of its error. The point's
 * coordinates are within `off` of the true ones. */
static double height(const struct hsr_world *w, uint32_t g, const double p[3],
                     double off, double *error) {
  const double n[3] = {w->mesh.nx[g], w->mesh.ny[g], w->mesh.nz[g]};
  const double r[3] = {p[0] - w->mesh.px[g], p[1] - w->mesh.py[g],
                       p[2] - w->mesh.pz[g]};
  double n1 = sum_of_sizes(n), r1 = sum_of_sizes(r);
  *error = 2 * (w->mesh.n_error[g] * r1 + w->mesh.anchor_error[g] * n1) +
           16 * U * n1 * r1 + TINY;
  if (off > 0)
    *error += 2 * (n1 + 3 * w->mesh.n_error[g]) * off;
  return n[0] * r[0] + n[1] * r[1] + n[2] * r[2];
}

int hsr_eye_side(const struct hsr_screen *screen, uint32_t g,
                 struct hsr_tally *tally) {
  if (screen->facing[g])
    return screen->facing[g];
  tally->exact[HSR_ASK_FACING]++;
  return hsr_exact_eye_side(screen->view, hsr_plane_loop(screen->world, g),
                            &tally->out_of_memory);
}

/* |h| of the plane of g, and a bound of its error. */
static double eye_height(const struct hsr_screen *screen, uint32_t g,
                         double *error) {
  const struct hsr_world *world = screen->world;
  const double *F = screen->view->F;
  if (!screen->view->parallel)
    return fabs(height(world, g, screen->view->E, 0, error));
  const double n[3] = {world->mesh.nx[g], world->mesh.ny[g], world->mesh.nz[g]};
  double f1 = sum_of_sizes(F);
  *error =
      2 * world->mesh.n_error[g] * f1 + 16 * U * sum_of_sizes(n) * f1 + TINY;
  return fabs(n[0] * F[0] + n[1] * F[1] + n[2] * F[2]);
}

/* The part by which a seen point of f, which is not flat, may be off: see
 * Thickness. +infinity if that cannot be told. */
static double part_off(const struct hsr_screen *screen, uint32_t f) {
  double deviation = screen->world->mesh.deviation[f], error;
  double clear = eye_height(screen, f, &error) - error;
  if (!screen->view->parallel)
    clear -= deviation;
  return clear > 0 ? deviation / clear : INFINITY;
}

/* The most by which the height over g of a seen point of f may differ from the
 * heights of f's polygon: see Thickness. */
static double thickness(const struct hsr_screen *screen, uint32_t f,
                        uint32_t g) {
  const struct hsr_world *world = screen->world;
  if (world->mesh.deviation[f] == 0)
    return 0;
  double part = part_off(screen, f), error;
  double h = eye_height(screen, g, &error);
  bool is_known = screen->view->parallel ? part < INFINITY : part < 1;
  return is_known ? 2 * (h + error) * part : INFINITY;
}

bool hsr_grazes(const struct hsr_screen *screen, uint32_t f, double reach) {
  const struct hsr_world *world = screen->world;
  const double *E = screen->view->E;
  double farthest = 0;
  if (world->mesh.deviation[f] == 0)
    return false;
  if (screen->view->parallel)
    return !(sum_of_sizes(screen->view->F) * part_off(screen, f) <= reach);
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
    uint32_t v = world->mesh.vertex[k];
    const double d[3] = {world->mesh.x[v] - E[0], world->mesh.y[v] - E[1],
                         world->mesh.z[v] - E[2]};
    farthest = fmax(farthest, sum_of_sizes(d));
  }
  return !(farthest * part_off(screen, f) <= reach);
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
    double off = side * height(world, g, p, polygon.off, &error);
    if (off > thick + error)
      continue;
    if (off < -(thick + error + 2 * world->mesh.deviation[g]))
      return HSR_NO;
    if (polygon.outline) /* in doubt: ask whether all of the face is there */
      return on_side(screen, (struct hsr_polygon){.face = polygon.face}, g,
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

/* S of the proof above. */
static double size_of_face(const struct hsr_world *world, uint32_t f) {
  double size = 0;
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
    uint32_t v = world->mesh.vertex[k];
    const double p[3] = {world->mesh.x[v], world->mesh.y[v], world->mesh.z[v]};
    size = fmax(size, sum_of_sizes(p));
  }
  return size;
}

struct hsr_polygon hsr_divide_outline(const struct hsr_screen *screen,
                                      struct hsr_polygon polygon,
                                      struct hsr_cut cut, double (*points)[3],
                                      double (*scratch)[3]) {
  const struct hsr_world *world = screen->world;
  uint32_t g = cut.face, n = n_points(world, polygon);
  double size = size_of_face(world, polygon.face), margin = 0;
  if (!polygon.outline)
    polygon.off = 0x1p-44 * size + TINY;
  for (uint32_t k = 0; k < n; k++) {
    double p[3], error;
    point_of(world, polygon, k, p);
    scratch[k][0] = cut.side * height(world, g, p, polygon.off, &error);
    margin = fmax(margin, error);
  }
  margin = 2 * margin + thickness(screen, polygon.face, g);
  uint32_t left = 0;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t l = k + 1 < n ? k + 1 : 0;
    double a[3], b[3], ha = scratch[k][0] + margin, hb = scratch[l][0] + margin;
    point_of(world, polygon, k, a);
    point_of(world, polygon, l, b);
    if (ha >= 0)
      memcpy(points[left++], a, sizeof a);
    if ((ha < 0) == (hb < 0))
      continue;
    double t = ha / (ha - hb);
    for (int c = 0; c < 3; c++)
      points[left][c] = a[c] + t * (b[c] - a[c]);
    left++;
  }
  return (struct hsr_polygon){polygon.face, (const double(*)[3])points, left,
                              polygon.off + 8 * U * size};
}

/* V - E of a point whose coordinates are within `own` of the true ones. Returns
 * what it adds to the error of a sum of products with V - E, for each unit of
 * its factors. */
static double from_eye(const struct hsr_view *view, const double p[3],
                       double own, double d[3]) {
  for (int k = 0; k < 3; k++)
    d[k] = p[k] - view->E[k];
  return 16 * U * sum_of_sizes(d) + fmax(0x1p-44 * sum_of_sizes(p), own) + TINY;
}

static double product(const double row[3], const double d[3]) {
  return row[0] * d[0] + row[1] * d[1] + row[2] * d[2];
}

/* w sx, w sy, w of a point, and a bound of their errors. Everything may be
 * infinite or not a number where the view is so narrow that a product
 * overflows. */
static void homogeneous(const struct hsr_view *view, const double p[3],
                        double own, double h[3], double error[3]) {
  double d[3], off = from_eye(view, p, own, d);
  for (int k = 0; k < 3; k++) {
    h[k] = product(view->screen[k], d) + view->origin[k];
    error[k] =
        off * sum_of_sizes(view->screen[k]) + 2 * U * fabs(view->origin[k]);
  }
}

/* t of a point, and a bound of its error. */
static double depth_of(const struct hsr_view *view, const double p[3],
                       double own, double *error) {
  double d[3], off = from_eye(view, p, own, d);
  *error = off * sum_of_sizes(view->depth);
  return product(view->depth, d);
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
    homogeneous(screen->view, polygon.outline[k], polygon.off, h, error);
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
  bool is_flat = world->mesh.deviation[polygon.face] == 0;
  double part = is_flat ? 0 : part_off(screen, polygon.face);
  double stretch = screen->view->parallel ? 1 : 1 + 2 * part;
  double shift = screen->view->parallel ? 2 * part : 0;
  *nearest = INFINITY;
  *farthest = 0;
  for (uint32_t k = 0; k < n_points(world, polygon); k++) {
    double p[3], error;
    point_of(world, polygon, k, p);
    double t = depth_of(screen->view, p, polygon.off, &error);
    *nearest = fmin(*nearest, t - error - shift);
    *farthest = fmax(*farthest, t + error + shift);
  }
  if (!(stretch < 3 && shift < INFINITY)) { /* the plane may be met anywhere */
    *nearest = 0;
    *farthest = INFINITY;
    return;
  }
  *nearest = *nearest > 0 ? *nearest / stretch * (1 - 8 * U) : 0;
  *farthest = *farthest * stretch * (1 + 8 * U);
}

/* q is linear on the screen, so it is least and greatest at corners. */
void hsr_narrow_depth_range(const struct hsr_screen *screen, uint32_t f,
                            const struct hsr_bounds *bounds, double *nearest,
                            double *farthest) {
  double least = INFINITY, greatest = -INFINITY;
  double error = screen->plane[f].error;
  for (int corner = 0; corner < 4; corner++) {
    double q = hsr_depth(screen, f, corner & 1 ? bounds->x1 - 1 : bounds->x0,
                         corner & 2 ? bounds->y1 - 1 : bounds->y0);
    least = fmin(least, q);
    greatest = fmax(greatest, q);
  }
  if (screen->view->parallel) {
    *nearest = fmax(*nearest, -(greatest + error));
    *farthest = fmin(*farthest, fmax(-(least - error), 0));
    return;
  }
  if (greatest > 0)
    *nearest = fmax(*nearest, 1 / (greatest + error) * (1 - 8 * U));
  if (least > error)
    *farthest = fmin(*farthest, 1 / (least - error) * (1 + 8 * U));
}
