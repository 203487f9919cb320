/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes on the screen. The bounds of errors are those of polygon.c, taken three
 * times. A corner is found from the lowest one, by adding sides of the box. That
 * is six more roundings than polygon.c has for a leaf's points. Each is of a term
 * that is at most twice its sum. */
#include "algorithms/engines/masks/outline.h"
#include "common/base/vector.h"

/* --- Which corners -------------------------------------------------------- */

/* The corners of each side of a box, counterclockwise as seen from outside. Bit
 * k of a corner's number says that it is the upper one in coordinate k. Side 2
 * k is the lower one in coordinate k. */
static const unsigned char SIDE[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5},
                                         {0, 1, 5, 4}, {2, 6, 7, 3},
                                         {0, 2, 3, 1}, {4, 5, 7, 6}};

struct hsr_silhouette hsr_silhouette_find(const int place[3]) {
  struct hsr_silhouette silhouette = {0, {0}};
  unsigned to[8] = {0}; /* a corner: where edges go from it */
  for (int s = 0; s < 6; s++)
    for (int e = 0; place[s / 2] == s % 2 * 2 && e < 4; e++) {
      int a = SIDE[s][e], b = SIDE[s][(e + 1) & 3];
      if (to[b] >> a & 1) /* between two such sides */
        to[b] &= ~(1u << a);
      else
        to[a] |= 1u << b;
    }
  int first = 0;
  while (first < 8 && !to[first])
    first++;
  if (first == 8)
    return silhouette;
  int corner = first;
  do {
    silhouette.corner[silhouette.n++] = (unsigned char)corner;
    for (int next = 0; next < 8; next++)
      if (to[corner] == 1u << next) {
        corner = next;
        break;
      }
  } while (corner != first);
  return silhouette;
}

/* --- Corners -------------------------------------------------------------- */

/* A corner has the upper end in coordinate c where bit c of its number is 1. */
static const double UPPER[3][8] = {{0, 1, 0, 1, 0, 1, 0, 1},
                                   {0, 0, 1, 1, 0, 0, 1, 1},
                                   {0, 0, 0, 0, 1, 1, 1, 1}};

/* A moved box, and a little more: the sums are rounded. */
static inline __attribute__((always_inline)) struct hsr_box
moved_box(const struct hsr_box *box, const double shift[3]) {
  struct hsr_box moved;
  for (int c = 0; c < 3; c++) {
    double lo = box->lo[c] + shift[c], hi = box->hi[c] + shift[c];
    moved.lo[c] = lo - 2 * HSR_U * fabs(lo);
    moved.hi[c] = hi + 2 * HSR_U * fabs(hi);
  }
  return moved;
}

/* A homogeneous coordinate of all corners, from that of the first, and what a
 * side of the box adds to it. */
static inline __attribute__((always_inline)) void
add_sides(double first, const double add[3], double *restrict at) {
  for (int k = 0; k < 8; k++)
    at[k] = first + add[0] * UPPER[0][k] + add[1] * UPPER[1][k] +
            add[2] * UPPER[2][k];
}

static inline __attribute__((always_inline)) double
least_of(const double at[8]) {
  double four[4], two[2];
  for (int k = 0; k < 4; k++)
    four[k] = hsr_min(at[k], at[k + 4]);
  for (int k = 0; k < 2; k++)
    two[k] = hsr_min(four[k], four[k + 2]);
  return hsr_min(two[0], two[1]);
}

static inline __attribute__((always_inline)) double
most_of(const double at[8]) {
  double four[4], two[2];
  for (int k = 0; k < 4; k++)
    four[k] = hsr_max(at[k], at[k + 4]);
  for (int k = 0; k < 2; k++)
    two[k] = hsr_max(four[k], four[k + 2]);
  return hsr_max(two[0], two[1]);
}

/* Where the corners are, with their errors; and what they span if all of them
 * are before the eye. */
static inline __attribute__((always_inline)) void
find_corners(const struct hsr_view *view, const struct hsr_box *box,
             struct hsr_box_corners *restrict corner) {
  const double(*r)[3] = view->screen;
  double lo[3], far[3], first[3], add[3][3], sx[8], sy[8];
  for (int c = 0; c < 3; c++) {
    lo[c] = box->lo[c] - view->E[c];
    far[c] = hsr_max(fabs(lo[c]), fabs(box->hi[c] - view->E[c]));
  }
  for (int row = 0; row < 3; row++) {
    corner->error[row] = 3 * (hsr_outline_error(r[row], far) +
                              4 * HSR_U * fabs(view->origin[row]));
    first[row] = r[row][0] * lo[0] + r[row][1] * lo[1] + r[row][2] * lo[2] +
                 view->origin[row];
    for (int c = 0; c < 3; c++)
      add[row][c] = r[row][c] * (box->hi[c] - box->lo[c]);
  }
  add_sides(first[0], add[0], corner->x);
  add_sides(first[1], add[1], corner->y);
  add_sides(first[2], add[2], corner->w);
  for (int k = 0; k < 8; k++) {
    double per_w = 1 / corner->w[k];
    sx[k] = corner->x[k] * per_w;
    sy[k] = corner->y[k] * per_w;
  }
  corner->nearest = least_of(corner->w);
  corner->x0 = least_of(sx);
  corner->x1 = most_of(sx);
  corner->y0 = least_of(sy);
  corner->y1 = most_of(sy);
}

/* The hull of the corners of a box. */
static inline struct hsr_hull hull_of(const struct hsr_box_corners *corner,
                                      const struct hsr_window *window) {
  struct hsr_hull hull = hsr_hull_none();
  const double *error = corner->error;
  double e = hsr_max(error[0], hsr_max(error[1], error[2]));
  if (!(corner->nearest > 4 * e)) {
    for (int k = 0; k < 8; k++) {
      const struct hsr_outline_point point = {
          corner->x[k], corner->y[k], corner->w[k], error[0],
          error[1],     error[2],     NAN,          NAN};
      hsr_hull_add(&hull, &point, window);
    }
    return hull;
  }
  hull.beyond = 0;
  double far = hsr_max(hsr_max(fabs(corner->x0), fabs(corner->x1)),
                       hsr_max(fabs(corner->y0), fabs(corner->y1)));
  double margin = 2 * e * (1 + far) / corner->nearest + 8 * HSR_U * far;
  hull.x0 = corner->x0 - margin;
  hull.x1 = corner->x1 + margin;
  hull.y0 = corner->y0 - margin;
  hull.y1 = corner->y1 + margin;
  return hull;
}

/* --- Silhouettes ---------------------------------------------------------- */

HSR_VECTOR static enum hsr_box_place place_box(struct hsr_pieces_view *p,
                                               const struct hsr_box *box,
                                               const double shift[3]) {
  const double *eye = p->view->eye;
  const struct hsr_box moved = moved_box(box, shift);
  find_corners(p->view, &moved, &p->corners);
  if (hsr_outline_is_wild(p->corners.error))
    return HSR_BOX_UNKNOWN;
  struct hsr_hull hull = hull_of(&p->corners, &p->view->window);
  if (!hsr_hull_box(&hull, &p->view->window, p->anywhere, &p->box))
    return HSR_BOX_OUTSIDE;
  int place = 0;
  for (int c = 2; c >= 0; c--)
    place = 3 * place + 1 - (eye[c] < moved.lo[c]) + (eye[c] > moved.hi[c]);
  p->of_box = &p->silhouette[place];
  return hull.ahead && p->of_box->n ? HSR_BOX_INSIDE : HSR_BOX_UNKNOWN;
}

enum hsr_box_place hsr_pieces_box(struct hsr_pieces_view *p,
                                  const struct hsr_box *box,
                                  const double shift[3]) {
  return place_box(p, box, shift);
}

const struct hsr_mask_polygon *
hsr_pieces_silhouette(struct hsr_pieces_view *p) {
  const struct hsr_silhouette *s = p->of_box;
  const struct hsr_box_corners *from = &p->corners;
  struct hsr_ring ring;
  for (int k = 0; k <= HSR_RING; k++) {
    int corner = s->corner[k < s->n ? k : 0];
    ring.x[k] = from->x[corner];
    ring.y[k] = from->y[corner];
    ring.w[k] = from->w[corner];
    ring.ex[k] = from->error[0];
    ring.ey[k] = from->error[1];
    ring.ew[k] = from->error[2];
  }
  hsr_outline_lines(p->reach, -1, &ring, (uint32_t)s->n, p->line);
  p->polygon =
      (struct hsr_mask_polygon){p->line, (uint32_t)s->n, NULL, NULL, p};
  return &p->polygon;
}
