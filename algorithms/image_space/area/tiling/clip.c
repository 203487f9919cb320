/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The line on the screen where a face meets the plane x = at; x, at, E and D
 * are the coordinates along one axis, u = 2^-53.
 *
 * A ray D from the eye E meets the face where t = 1/q. There x - at has the
 * sign of q (E - at) + D. On the screen q and D are affine, and so is this sum.
 * In parallel it meets the face at t = -q, and x - at is (E - at) + (P - E) - q
 * F there, which is affine as well. E - at is rounded once; q is within
 * `outside` times the plane's error wherever a line is asked about
 * (common/exact/screen.h); the coefficients of D are within 2 u of themselves,
 * those of P - E too. So the sum is off by at most |E - at|, or |F|, times the
 * error of q, and 8 u of the sizes of all terms. */
#include "algorithms/image_space/area/tiling/clip.h"
#include "common/base/numbers.h"

#include <float.h>
#include <math.h>

static const double U = DBL_EPSILON / 2;

bool hsr_region_clip(const struct hsr_region *region, struct hsr_box *box) {
  bool some = true;
  for (int k = 0; k < 3; k++) {
    some =
        some && box->hi[k] > region->above[k] && box->lo[k] <= region->below[k];
    box->lo[k] = hsr_max(box->lo[k], region->above[k]);
    box->hi[k] = hsr_min(box->hi[k], region->below[k]);
  }
  return some;
}

/* A box that holds the current piece. */
static struct hsr_box box_of(const struct hsr_pieces_view *p) {
  const struct hsr_bsp *bsp = p->bsp;
  const double *at[3] = {bsp->x, bsp->y, bsp->z};
  struct hsr_box box = {{INFINITY, INFINITY, INFINITY},
                        {-INFINITY, -INFINITY, -INFINITY}};
  for (uint32_t c = 0; c < p->piece->n_corners; c++) {
    uint32_t point = bsp->corner[p->piece->first_corner + c].point;
    for (int k = 0; k < 3; k++) {
      box.lo[k] = hsr_min(box.lo[k], at[k][point] - bsp->error[point]);
      box.hi[k] = hsr_max(box.hi[k], at[k][point] + bsp->error[point]);
    }
  }
  return box;
}

/* The line on the screen where the piece's plane meets the plane x = at across
 * an axis; it is positive within the region. */
static struct hsr_mask_line line_of(const struct hsr_clip *clip, int axis,
                                    bool is_above, double at) {
  const struct hsr_pieces_view *p = clip->pieces;
  const double(*ray)[3] = p->view->ray;
  const struct hsr_depth_plane *q = &clip->screen->plane[p->piece->face];
  double away = p->view->E[axis] - at, side = is_above ? 1 : -1;
  double e = p->view->parallel ? -p->view->F[axis] : away;
  double rest = p->view->parallel ? away : 0;
  double size_a = fabs(q->a * e) + fabs(ray[1][axis]);
  double size_b = fabs(q->b * e) + fabs(ray[2][axis]);
  double size_c = fabs(q->c * e) + fabs(ray[0][axis]) + fabs(rest);
  double off = e != 0 ? fabs(e) * clip->screen->outside * q->error : 0;
  struct hsr_mask_line line;
  line.a = side * (q->a * e + ray[1][axis]);
  line.b = side * (q->b * e + ray[2][axis]);
  line.c = side * (q->c * e + ray[0][axis] + rest);
  line.span = fabs(line.a) + fabs(line.b);
  line.error =
      2 * (off + 8 * U * (p->reach * (size_a + size_b) + size_c)) + 0x1p-900;
  line.per_a = 1 / line.a;
  line.per_b = 1 / line.b;
  return line;
}

/* On which side of the plane across an axis the ray of (sx, sy) meets the face:
 * +1 where the coordinate is greater. The plane is given by a triangle in it
 * whose front is on that side. */
static int side_of_plane(const struct hsr_clip *clip, int axis, double at,
                         double sx, double sy) {
  static const uint32_t number[3] = {0, 1, 2};
  const struct hsr_pieces_view *p = clip->pieces;
  double corner[9] = {0};
  for (int k = 0; k < 3; k++)
    corner[3 * k + axis] = at;
  corner[3 + (axis + 1) % 3] = 1;
  corner[6 + (axis + 2) % 3] = 1;
  struct hsr_loop plane = {corner, corner + 1, corner + 2, 3, number, 3};
  return hsr_loop_cut_side(p->view,
                           hsr_plane_loop(p->bsp->world, p->piece->face), plane,
                           sx, sy, p->tally);
}

/* `inside` of the clipped polygon: a line of the piece, or of a plane. */
static bool within(void *context, uint32_t k, double sx, double sy) {
  struct hsr_clip *clip = context;
  struct hsr_pieces_view *p = clip->pieces;
  if (k < clip->n_own)
    return p->polygon.inside(p->polygon.context, k, sx, sy);
  k -= clip->n_own;
  return (side_of_plane(clip, clip->plane[k].axis, clip->plane[k].at, sx, sy) >
          0) == clip->plane[k].is_above;
}

static bool covers(void *context, double sx, double sy) {
  const struct hsr_mask_polygon *own =
      &((struct hsr_clip *)context)->pieces->polygon;
  return own->covers(own->context, sx, sy);
}

static void add_plane(struct hsr_clip *clip, int axis, bool is_above,
                      double at) {
  uint32_t k = clip->polygon.n++ - clip->n_own;
  if (!k)
    hsr_screen_plane(clip->screen, clip->pieces->piece->face);
  clip->plane[k].axis = axis;
  clip->plane[k].is_above = is_above;
  clip->plane[k].at = at;
  clip->pieces->line[clip->n_own + k] = line_of(clip, axis, is_above, at);
}

const struct hsr_mask_polygon *hsr_clip_piece(struct hsr_clip *clip,
                                              struct hsr_pieces_view *p,
                                              struct hsr_screen *screen,
                                              const struct hsr_region *region) {
  struct hsr_box box = box_of(p), clipped = box;
  if (!hsr_region_clip(region, &clipped))
    return NULL;
  *clip = (struct hsr_clip){.pieces = p,
                            .screen = screen,
                            .polygon = p->polygon,
                            .n_own = p->polygon.n};
  for (int k = 0; k < 3; k++) {
    if (box.lo[k] <= region->above[k])
      add_plane(clip, k, true, region->above[k]);
    if (box.hi[k] > region->below[k])
      add_plane(clip, k, false, region->below[k]);
  }
  if (clip->polygon.n == clip->n_own)
    return &p->polygon;
  clip->polygon.inside = within;
  clip->polygon.covers = p->polygon.covers ? covers : NULL;
  clip->polygon.context = clip;
  return &clip->polygon;
}
