/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The weights of a splat in pixels: in floats, else in doubles, else exactly. */
#include "algorithms/engines/splats/splats.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"

#include <math.h>

/* --- In doubles, and exactly ---------------------------------------------- */

static double length_of(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3]) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

/* A component of V' or D' is a sum of up to four terms, each off by at most 4
 * u, u = 2^-53, times 1 / size, off by u. It errs by less than 8 u times the sum
 * of the terms' sizes. */
struct hsr_splat_ray hsr_splats_ray(const struct hsr_splats *s,
                                    const struct hsr_placed *p, int i, int j) {
  const struct hsr_view *view = s->view;
  double sx = hsr_sample_x(view, i), sy = hsr_sample_y(view, j);
  struct hsr_splat_ray r;
  for (int a = 0; a < 3; a++) {
    double per_size = s->per_size[a][p->at[a]], far = s->far[a][p->at[a]];
    double ray = view->ray[0][a] + sx * view->ray[1][a] + sy * view->ray[2][a],
           most = fabs(view->ray[0][a]) + fabs(sx * view->ray[1][a]) +
                  fabs(sy * view->ray[2][a]);
    r.V[a] = (view->parallel ? far - ray : far) * per_size;
    r.v[a] = (view->parallel ? fabs(far) + most : fabs(far)) * per_size;
    r.D[a] = (view->parallel ? view->F[a] : ray) * per_size;
    r.d[a] = (view->parallel ? fabs(view->F[a]) : most) * per_size;
  }
  return r;
}

/* kappa, and how far it may be off; infinitely, if it cannot be told. A
 * component of V' x D', and V'.D', err by less than 64 u |v| |d|. */
static double roughly(const struct hsr_splats *s, const struct hsr_placed *p,
                      int i, int j, double *error) {
  const struct hsr_splat_ray r = hsr_splats_ray(s, p, i, j);
  double C[3];
  cross(r.V, r.D, C);
  double CC = dot(C, C), VD = dot(r.V, r.D);
  double off = 0x1p-46 * length_of(r.v) * length_of(r.d);
  double CC_off = 2 * sqrt(CC) * off + off * off;
  double factor = s->view->parallel ? p->scale / dot(r.D, r.D)
                                    : p->scale * dot(r.V, r.V) / (VD * VD);
  *error = factor * (CC_off + CC * (8 * p->rough + 0x1p-40)) * 2;
  if (s->view->parallel)
    return factor * CC;
  if (VD < -off)
    return *error = 0, INFINITY;
  if (!(VD > 0x1p10 * off) || !(VD * VD > 0x1p-900))
    *error = INFINITY;
  return factor * CC;
}

int hsr_splats_index(const struct hsr_splats *s, const struct hsr_placed *p,
                     int i, int j) {
  if (p->is_blurred) {
    int32_t index[HSR_SPLAT_LANES];
    hsr_splats_find_blurred(s, p, i, j, index);
    return index[0];
  }
  double error, kappa = roughly(s, p, i, j, &error);
  if (kappa - error >= HSR_FOOTPRINT)
    return HSR_FOOTPRINT;
  double lo = floor(fmax(0, kappa - error)), hi = floor(kappa + error);
  if (lo == hi)
    return lo < HSR_FOOTPRINT ? (int)lo : HSR_FOOTPRINT;
  s->tally->exact[HSR_ASK_FOOTPRINT]++;
  struct hsr_splat splat = hsr_splats_exact(s, p->at);
  return hsr_exact_footprint(&splat, i, j, &s->tally->out_of_memory);
}

/* --- In floats ------------------------------------------------------------ */

/* kappa of pixels beside one another, as indices of the table. Returns whether
 * one of them has a whole number within the error. */
HSR_VECTOR
static int find_indices(const struct hsr_placed *p, float dx, float dy, int n,
                        int32_t index[HSR_SPLAT_LANES],
                        float kappas[HSR_SPLAT_LANES]) {
  const float xx = p->xx, xy = 2 * p->xy * dy, yy = p->yy * dy * dy, px = p->p,
              qy = 1 + p->q * dy, error = p->error;
  int doubt = 0;
  for (int l = 0; l < HSR_SPLAT_LANES; l++) {
    float x = dx + (float)l, denominator = qy + px * x;
    float kappa = ((xx * x + xy) * x + yy) / (denominator * denominator);
    bool covered = (kappa < HSR_FOOTPRINT + 1) & (l < n);
    float inside = covered ? kappa : HSR_FOOTPRINT;
    int whole = (int)inside;
    float part = inside - (float)whole;
    doubt |= covered & (((part < error) & (whole > 0)) | (part > 1 - error));
    index[l] = whole < HSR_FOOTPRINT ? whole : HSR_FOOTPRINT;
    kappas[l] = inside;
  }
  return doubt;
}

/* Where a whole number is within the error of the floats. */
static void settle(const struct hsr_splats *s, const struct hsr_placed *p,
                   int x, int j, int n, const float kappa[HSR_SPLAT_LANES],
                   int32_t index[HSR_SPLAT_LANES]) {
  for (int l = 0; l < n; l++) {
    float part = kappa[l] - floorf(kappa[l]);
    if (kappa[l] < HSR_FOOTPRINT + 1 &&
        (part < p->error || part > 1 - p->error))
      index[l] = hsr_splats_index(s, p, x + l, j);
  }
}

void hsr_splats_find(const struct hsr_splats *s, const struct hsr_placed *p,
                     int x, int j, int32_t index[HSR_SPLAT_LANES]) {
  if (p->is_blurred) {
    hsr_splats_find_blurred(s, p, x, j, index);
    return;
  }
  float kappa[HSR_SPLAT_LANES];
  int n = p->box.x1 - x < HSR_SPLAT_LANES ? p->box.x1 - x : HSR_SPLAT_LANES;
  if (p->is_small) {
    float dx = (float)(hsr_sample_x(s->view, x) - p->x),
          dy = (float)(hsr_sample_y(s->view, j) - p->y);
    if (find_indices(p, dx, dy, n, index, kappa))
      settle(s, p, x, j, n, kappa, index);
  } else
    for (int l = 0; l < HSR_SPLAT_LANES; l++)
      index[l] = l < n ? hsr_splats_index(s, p, x + l, j) : HSR_FOOTPRINT;
}
