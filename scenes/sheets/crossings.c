/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scenes/sheets/crossings.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { MOST_BINS = 1024 }; /* along a side */

/* --- Bounds and bins ------------------------------------------------------ */

struct bounds {
  double low[3], high[3];
};

static struct bounds bounds_of(const struct hsr_room *room, uint32_t f) {
  const struct hsr_sheet_face *face = &room->face[f];
  const double *origin = room->origin[face->sheet];
  struct bounds bounds;
  for (int k = 0; k < 3; k++) {
    const double p = origin[k] + face->p[k];
    bounds.low[k] = p + fmin(face->u[k], 0) + fmin(face->v[k], 0);
    bounds.high[k] = p + fmax(face->u[k], 0) + fmax(face->v[k], 0);
  }
  return bounds;
}

/* The bin of a coordinate along x or y. */
static int bin_at(const struct hsr_room *room, int axis, double x) {
  const double part =
      (x - room->low[axis]) / (room->high[axis] - room->low[axis]);
  const int at = (int)(part * room->n_bins[axis]);
  return at < 0 ? 0 : at < room->n_bins[axis] ? at : room->n_bins[axis] - 1;
}

/* The bins [x0, x1] x [y0, y1] that bounds reach into. */
struct bins {
  int x0, x1, y0, y1;
};

static struct bins bins_of(const struct hsr_room *room,
                           const struct bounds *b) {
  return (struct bins){bin_at(room, 0, b->low[0]), bin_at(room, 0, b->high[0]),
                       bin_at(room, 1, b->low[1]), bin_at(room, 1, b->high[1])};
}

enum hsr_status hsr_room_divide(struct hsr_room *room, uint32_t n_faces) {
  double extent[2] = {0, 0};
  for (uint32_t f = 0; f < n_faces; f++)
    for (int k = 0; k < 2; k++)
      extent[k] += fabs(room->face[f].u[k]) + fabs(room->face[f].v[k]);
  for (int k = 0; k < 2; k++) {
    const double bins =
        (room->high[k] - room->low[k]) * n_faces / fmax(extent[k], 1e-300);
    room->n_bins[k] = bins < 1 ? 1 : bins < MOST_BINS ? (int)bins : MOST_BINS;
  }
  room->bin = HSR_NEW_ZEROED(room->arena, struct hsr_bin,
                             (size_t)room->n_bins[0] * (size_t)room->n_bins[1]);
  return room->bin ? HSR_OK : HSR_E_NOMEM;
}

static enum hsr_status bin_put(struct hsr_room *room, struct hsr_bin *bin,
                               uint32_t f) {
  if (bin->n == bin->cap) {
    const uint32_t cap = bin->cap ? 2 * bin->cap : 8;
    uint32_t *face = HSR_NEW(room->arena, uint32_t, cap);
    if (!face)
      return HSR_E_NOMEM;
    if (bin->n)
      memcpy(face, bin->face, bin->n * sizeof *face);
    bin->face = face;
    bin->cap = cap;
  }
  bin->face[bin->n++] = f;
  return HSR_OK;
}

static void bin_take(struct hsr_bin *bin, uint32_t f) {
  for (uint32_t k = 0; k < bin->n; k++)
    if (bin->face[k] == f) {
      bin->face[k] = bin->face[--bin->n];
      return;
    }
}

static struct hsr_bin *bin_of(const struct hsr_room *room, int x, int y) {
  return &room->bin[(size_t)y * (size_t)room->n_bins[0] + (size_t)x];
}

enum hsr_status hsr_room_put(struct hsr_room *room, uint32_t sheet) {
  for (uint32_t f = room->first[sheet]; f < room->first[sheet + 1]; f++) {
    const struct bounds bounds = bounds_of(room, f);
    const struct bins bins = bins_of(room, &bounds);
    for (int y = bins.y0; y <= bins.y1; y++)
      for (int x = bins.x0; x <= bins.x1; x++)
        if (bin_put(room, bin_of(room, x, y), f))
          return HSR_E_NOMEM;
  }
  return HSR_OK;
}

void hsr_room_take(struct hsr_room *room, uint32_t sheet) {
  for (uint32_t f = room->first[sheet]; f < room->first[sheet + 1]; f++) {
    const struct bounds bounds = bounds_of(room, f);
    const struct bins bins = bins_of(room, &bounds);
    for (int y = bins.y0; y <= bins.y1; y++)
      for (int x = bins.x0; x <= bins.x1; x++)
        bin_take(bin_of(room, x, y), f);
  }
}

/* --- Two faces ------------------------------------------------------------ */

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3]) {
  for (int k = 0; k < 3; k++)
    out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static bool overlap(const struct bounds *a, const struct bounds *b) {
  for (int k = 0; k < 3; k++)
    if (a->low[k] > b->high[k] || b->low[k] > a->high[k])
      return false;
  return true;
}

/* Whether an edge of parallelogram f, whose sheet is at `origin`, passes through
 * parallelogram g, whose sheet is at `other`. */
static bool edge_passes(const struct hsr_sheet_face *f, const double *origin,
                        const struct hsr_sheet_face *g, const double *other) {
  double normal[3], corner[4][3], height[4];
  cross(g->u, g->v, normal);
  for (int i = 0; i < 4; i++) {
    for (int k = 0; k < 3; k++)
      corner[i][k] = (origin[k] + f->p[k]) - (other[k] + g->p[k]) +
                     (i == 1 || i == 2 ? f->u[k] : 0) + (i > 1 ? f->v[k] : 0);
    height[i] = dot(normal, corner[i]);
  }
  for (int i = 0; i < 4; i++) {
    const int j = (i + 1) % 4;
    if ((height[i] > 0) == (height[j] > 0))
      continue;
    /* The point a u + b v of g's plane through which the edge passes. */
    double at[3], side[3];
    const double t = height[i] / (height[i] - height[j]);
    for (int k = 0; k < 3; k++)
      at[k] = corner[i][k] + t * (corner[j][k] - corner[i][k]);
    cross(at, g->v, side);
    const double a = dot(side, normal) / dot(normal, normal);
    cross(g->u, at, side);
    const double b = dot(side, normal) / dot(normal, normal);
    if (a > 0 && a < 1 && b > 0 && b < 1)
      return true;
  }
  return false;
}

/* Two convex faces penetrate if and only if an edge of one passes through the
 * other. */
static bool do_cross(const struct hsr_room *room, uint32_t f, uint32_t g) {
  const struct hsr_sheet_face *a = &room->face[f], *b = &room->face[g];
  const double *at = room->origin[a->sheet], *bt = room->origin[b->sheet];
  return edge_passes(a, at, b, bt) || edge_passes(b, bt, a, at);
}

/* Faces of a bin that cross face f. A pair is looked at in one bin only: that of
 * the lower left corner of what their bounds share. */
static uint64_t crossings_in_bin(const struct hsr_room *room, uint32_t f,
                                 const struct bounds *bounds, int x, int y) {
  const struct hsr_bin *bin = bin_of(room, x, y);
  uint64_t n = 0;
  for (uint32_t k = 0; k < bin->n; k++) {
    const uint32_t g = bin->face[k];
    if (room->face[g].sheet == room->face[f].sheet)
      continue;
    const struct bounds other = bounds_of(room, g);
    n += overlap(bounds, &other) &&
         bin_at(room, 0, fmax(bounds->low[0], other.low[0])) == x &&
         bin_at(room, 1, fmax(bounds->low[1], other.low[1])) == y &&
         do_cross(room, f, g);
  }
  return n;
}

uint64_t hsr_room_crossings(const struct hsr_room *room, uint32_t sheet) {
  uint64_t n = 0;
  for (uint32_t f = room->first[sheet]; f < room->first[sheet + 1]; f++) {
    const struct bounds bounds = bounds_of(room, f);
    const struct bins bins = bins_of(room, &bounds);
    for (int y = bins.y0; y <= bins.y1; y++)
      for (int x = bins.x0; x <= bins.x1; x++)
        n += crossings_in_bin(room, f, &bounds, x, y);
  }
  return n;
}
