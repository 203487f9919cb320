/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bounds of errors; u = 2^-53.
 *
 * Points. V - E is rounded once, the rows are within 2 u, the product and two
 * sums add 3 u: X is off by at most 6 u S_x, S_x = sum |row_k| |V - E|_k, and
 * by sum |row_k| e more if V is off by e in its coordinates. What is used is 8
 * u of S_x at the farthest corner of the leaf. A vertex that is moved rounds
 * nothing, the points where faces are cut u |V| in each coordinate.
 *
 * Lines. a = Y_a W_b - W_a Y_b is off by at most e_y (|W_a| + |W_b|) +
 * e_w (|Y_a| + |Y_b|) + 2 e_y e_w, and its rounding 2 u (|Y_a W_b| + |W_a
 * Y_b|); b and c likewise. f at coordinates of size r is off by r (e_a + e_b) +
 * e_c, and its rounding 5 u (r |a| + r |b| + |c|). Twice all this holds the
 * terms of second order, and what masks.c adds and subtracts.
 *
 * Range. 2^-960 more covers what underflows in a point: an entry of a row may
 * be off by 2^-1074 if it is that small, and |V - E| is at most 2^102. 2^-1000
 * more covers it in a line: there only products underflow. Nothing overflows in
 * a leaf whose error is at most 2^400, for then X, Y and W are below 2^460.
 * Only views of less than 1e-80 degrees have any other. Of such a leaf nothing
 * is known: each piece has the window as its box and lines without bound, so
 * every sample is decided exactly.
 *
 * Parallel. W is 1, and X and Y have an origin added, whose rounding is in
 * their errors. What is asked about near is asked of t, which has an error of
 * its own of the same form.
 *
 * Not flat. A ray meets the plane of such a face elsewhere than the hull of its
 * corners. Which samples the corners surround is told by their places on the
 * screen if all of them are before the eye. Else it is told by their
 * homogeneous coordinates, but only if the eye is farther from the plane than
 * the corners are (common/exact/screen.c, Facing): otherwise the plane may be
 * met before the eye although the corners are behind it. Their depths tell
 * nothing about near, unless the points of the tree have the face's `reach` as
 * their error. */
#include "algorithms/engines/masks/outline.h"
#include "common/base/vector.h"
#include "common/exact/order.h"

#include <float.h>
#include <math.h>

static double sum_of_sizes(const double v[3]) {
  return fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
}

enum hsr_status
hsr_pieces_begin(struct hsr_pieces_view *p, struct hsr_pieces_room room,
                 const struct hsr_view *view, const struct hsr_masks *masks,
                 struct hsr_tally *tally, struct hsr_arena *arena) {
  *p = (struct hsr_pieces_view){.view = view,
                                .tally = tally,
                                .anywhere = masks->anywhere,
                                .most_face = room.face};
  int x0 = view->window.x0, y0 = view->window.y0;
  p->reach = hsr_masks_extent(masks) + (x0 > y0 ? x0 : y0);
  p->x = HSR_NEW(arena, double, room.points);
  p->y = HSR_NEW(arena, double, room.points);
  p->w = HSR_NEW(arena, double, room.points);
  p->t = view->parallel ? HSR_NEW(arena, double, room.points) : p->w;
  p->sx = HSR_NEW(arena, double, room.points);
  p->sy = HSR_NEW(arena, double, room.points);
  p->line = HSR_NEW(arena, struct hsr_mask_line, room.corners + HSR_RING);
  p->corner[0] = HSR_NEW(arena, double, 3 * (size_t)room.face);
  p->corner[1] = HSR_NEW(arena, double, 3 * (size_t)room.face);
  p->number = HSR_NEW(arena, uint32_t, room.face);
  if (!p->x || !p->y || !p->w || !p->t || !p->sx || !p->sy || !p->line ||
      !p->corner[0] || !p->corner[1] || !p->number)
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < room.face; k++)
    p->number[k] = k;
  for (int c = 0; c < 3; c++)
    p->spread[c] = sum_of_sizes(view->screen[c]);
  for (int k = 0; k < 27; k++) {
    const int place[3] = {k % 3, k / 3 % 3, k / 9};
    p->silhouette[k] = hsr_silhouette_find(place);
  }
  return HSR_OK;
}

void hsr_pieces_tree(struct hsr_pieces_view *p, const struct hsr_bsp *bsp,
                     const double shift[3]) {
  p->bsp = bsp;
  for (int k = 0; k < 3; k++)
    p->shift[k] = shift[k];
}

/* --- The transform -------------------------------------------------------- */

/* The largest coordinates of V - E for points within a box that is moved. */
static void find_far(const struct hsr_pieces_view *p, const struct hsr_box *box,
                     const double shift[3], double far[3]) {
  const double *E = p->view->E;
  for (int k = 0; k < 3; k++)
    far[k] = hsr_max(fabs(box->lo[k] + shift[k] - E[k]),
                     fabs(box->hi[k] + shift[k] - E[k]));
}

/* In parallel: no point of the leaf has a smaller t. */
static double nearest_depth(const struct hsr_pieces_view *p,
                            const struct hsr_bsp_cube *leaf) {
  const double *own = p->bsp->error + leaf->first_point;
  double nearest = INFINITY, spread = sum_of_sizes(p->view->depth);
  for (uint32_t k = 0; k < leaf->n_points; k++) {
    double off = own[k] > 0 ? spread * (own[k] + p->rounding) : 0;
    nearest = hsr_min(nearest, p->t[k] - 2 * (p->t_error + off));
  }
  return nearest;
}

enum { LANES = 8 };

/* What bounds the places of a leaf's points, in lanes. */
struct extent {
  double margin[LANES];  /* the largest */
  double nearest[LANES]; /* the least W less its error */
};

/* Point k, of which bounds go to a lane. `spread` is what an error of 1 in a
 * point's coordinates amounts to in X, Y and W. The bounds are those of
 * hsr_hull_add. */
static inline __attribute__((always_inline)) void
place_point(const double *restrict x, const double *restrict y,
            const double *restrict w, const double *restrict own,
            double rounding, double most, double spread, double *restrict sx,
            double *restrict sy, size_t k, size_t lane,
            struct extent *restrict extent) {
  double off_k = own[k] > 0 ? own[k] + rounding : 0;
  double e = most + spread * off_k, per_w = 1 / w[k];
  double at_x = x[k] * per_w, at_y = y[k] * per_w;
  double far = hsr_max(fabs(at_x), fabs(at_y));
  double off = (2 * e * (1 + far)) * per_w + 8 * HSR_U * far;
  sx[k] = at_x;
  sy[k] = at_y;
  extent->margin[lane] = hsr_max(off, extent->margin[lane]);
  extent->nearest[lane] = hsr_min(extent->nearest[lane], w[k] - 4 * e);
}

HSR_VECTOR static void
place_points(size_t n, const double *restrict x, const double *restrict y,
             const double *restrict w, const double *restrict own,
             double rounding, double most, double spread, double *restrict sx,
             double *restrict sy, struct extent *restrict extent) {
  size_t k = 0;
  for (size_t lane = 0; lane < LANES; lane++) {
    extent->margin[lane] = 0;
    extent->nearest[lane] = INFINITY;
  }
  for (; k + LANES <= n; k += LANES)
    for (size_t lane = 0; lane < LANES; lane++)
      place_point(x, y, w, own, rounding, most, spread, sx, sy, k + lane, lane,
                  extent);
  for (size_t lane = 0; k + lane < n; lane++)
    place_point(x, y, w, own, rounding, most, spread, sx, sy, k + lane, lane,
                extent);
}

/* Finds where the leaf's points are on the screen. */
static void find_places(struct hsr_pieces_view *p,
                        const struct hsr_bsp_cube *leaf) {
  const double *own = p->bsp->error + leaf->first_point;
  double most = hsr_max(hsr_max(p->error[0], p->error[1]), p->error[2]);
  double spread = hsr_max(hsr_max(p->spread[0], p->spread[1]), p->spread[2]);
  double nearest = INFINITY;
  struct extent extent;
  place_points(leaf->n_points, p->x, p->y, p->w, own, p->rounding, most, spread,
               p->sx, p->sy, &extent);
  p->margin = 0;
  for (int lane = 0; lane < LANES; lane++) {
    p->margin = hsr_max(p->margin, extent.margin[lane]);
    nearest = hsr_min(nearest, extent.nearest[lane]);
  }
  p->ahead = !p->is_wild && nearest > 0 && p->margin < INFINITY;
  if (p->view->parallel)
    nearest = nearest_depth(p, leaf);
  p->past_near = nearest > p->view->near;
}

/* (X, Y, W) of n points that are moved. */
HSR_VECTOR static void
transform(size_t n, const double *restrict x, const double *restrict y,
          const double *restrict z, const double shift[3],
          const struct hsr_view *view, double *restrict to_x,
          double *restrict to_y, double *restrict to_w) {
  const double(*r)[3] = view->screen;
  double r00 = r[0][0], r01 = r[0][1], r02 = r[0][2];
  double r10 = r[1][0], r11 = r[1][1], r12 = r[1][2];
  double r20 = r[2][0], r21 = r[2][1], r22 = r[2][2];
  double o0 = view->origin[0], o1 = view->origin[1], o2 = view->origin[2];
  double ex = view->E[0], ey = view->E[1], ez = view->E[2];
  double mx = shift[0], my = shift[1], mz = shift[2];
  for (size_t k = 0; k < n; k++) {
    double dx = x[k] + mx - ex, dy = y[k] + my - ey, dz = z[k] + mz - ez;
    to_x[k] = r00 * dx + r01 * dy + r02 * dz + o0;
    to_y[k] = r10 * dx + r11 * dy + r12 * dz + o1;
    to_w[k] = r20 * dx + r21 * dy + r22 * dz + o2;
  }
}

/* In parallel: t of n points that are moved. */
HSR_VECTOR static void
find_depths(size_t n, const double *restrict x, const double *restrict y,
            const double *restrict z, const double shift[3],
            const struct hsr_view *view, double *restrict t) {
  double d0 = view->depth[0], d1 = view->depth[1], d2 = view->depth[2];
  double ex = view->E[0], ey = view->E[1], ez = view->E[2];
  double mx = shift[0], my = shift[1], mz = shift[2];
  for (size_t k = 0; k < n; k++)
    t[k] =
        d0 * (x[k] + mx - ex) + d1 * (y[k] + my - ey) + d2 * (z[k] + mz - ez);
}

void hsr_pieces_leaf(struct hsr_pieces_view *p,
                     const struct hsr_bsp_cube *leaf) {
  size_t first = leaf->first_point;
  p->first_point = leaf->first_point;
  double far[3];
  find_far(p, &leaf->tight, p->shift, far);
  for (int c = 0; c < 3; c++)
    p->error[c] = hsr_outline_error(p->view->screen[c], far) +
                  4 * HSR_U * fabs(p->view->origin[c]);
  p->is_wild = hsr_outline_is_wild(p->error);
  p->rounding = 0;
  for (int k = 0; k < 3; k++)
    if (p->shift[k] != 0)
      p->rounding = hsr_max(p->rounding,
                            2 * HSR_U *
                                hsr_max(fabs(leaf->tight.lo[k] + p->shift[k]),
                                        fabs(leaf->tight.hi[k] + p->shift[k])));
  transform(leaf->n_points, p->bsp->x + first, p->bsp->y + first,
            p->bsp->z + first, p->shift, p->view, p->x, p->y, p->w);
  p->t_error = p->error[2];
  if (p->view->parallel) {
    p->t_error = hsr_outline_error(p->view->depth, far);
    find_depths(leaf->n_points, p->bsp->x + first, p->bsp->y + first,
                p->bsp->z + first, p->shift, p->view, p->t);
  }
  find_places(p, leaf);
}

/* --- Corners -------------------------------------------------------------- */

static struct hsr_outline_point
corner_point(const struct hsr_pieces_view *p,
             const struct hsr_bsp_corner *corner) {
  uint32_t k = corner->point - p->first_point;
  double own = p->bsp->error[corner->point];
  struct hsr_outline_point point = {p->x[k],     p->y[k],     p->w[k],
                                    p->error[0], p->error[1], p->error[2],
                                    p->t[k],     p->t_error};
  if (own > 0) {
    own += p->rounding;
    point.ex += own * p->spread[0];
    point.ey += own * p->spread[1];
    point.ew += own * p->spread[2];
    point.et += own * sum_of_sizes(p->view->depth);
  }
  return point;
}

static void put_corner(struct hsr_ring *ring, uint32_t k,
                       const struct hsr_outline_point *point) {
  ring->x[k] = point->x;
  ring->y[k] = point->y;
  ring->w[k] = point->w;
  ring->ex[k] = point->ex;
  ring->ey[k] = point->ey;
  ring->ew[k] = point->ew;
}

/* --- Exact questions ------------------------------------------------------ */

/* Vertex v of the world, moved. */
static void moved_vertex(const struct hsr_pieces_view *p,
                         const struct hsr_world *world, uint32_t v,
                         double at[3]) {
  at[0] = world->mesh.x[v] + p->shift[0];
  at[1] = world->mesh.y[v] + p->shift[1];
  at[2] = world->mesh.z[v] + p->shift[2];
}

/* The corners of a loop, moved, in place `k` of two. */
static struct hsr_loop moved_loop(const struct hsr_pieces_view *p,
                                  struct hsr_loop loop, int k) {
  double *at = p->corner[k];
  for (uint32_t c = 0; c < loop.n; c++) {
    size_t v = loop.stride * loop.vertex[c];
    at[3 * c] = loop.x[v] + p->shift[0];
    at[3 * c + 1] = loop.y[v] + p->shift[1];
    at[3 * c + 2] = loop.z[v] + p->shift[2];
  }
  return (struct hsr_loop){at, at + 1, at + 2, 3, p->number, loop.n};
}

static struct hsr_loop moved_plane(const struct hsr_pieces_view *p, uint32_t f,
                                   int k) {
  return moved_loop(p, hsr_plane_loop(p->bsp->world, f), k);
}

/* A triangle in a median plane, its front where the coordinate is greater. */
static struct hsr_loop median_loop(const struct hsr_pieces_view *p,
                                   const struct hsr_bsp_median *median) {
  double *at = p->corner[1];
  int a = median->axis, b = (a + 1) % 3, c = (a + 2) % 3;
  for (int k = 0; k < 3; k++)
    at[3 * k + a] = median->at + p->shift[a];
  at[b] = 0, at[c] = 0;
  at[3 + b] = 1, at[3 + c] = 0;
  at[6 + b] = 0, at[6 + c] = 1;
  return (struct hsr_loop){at, at + 1, at + 2, 3, p->number, 3};
}

static bool within_cut(struct hsr_pieces_view *p,
                       const struct hsr_bsp_corner *cut, double sx, double sy) {
  const struct hsr_bsp *bsp = p->bsp;
  struct hsr_loop face = moved_plane(p, p->piece->face, 0);
  struct hsr_loop plane =
      cut->a < bsp->world->mesh.n_planes
          ? moved_plane(p, bsp->face_of[cut->a], 1)
          : median_loop(p, &bsp->median[cut->a - bsp->world->mesh.n_planes]);
  int side = hsr_loop_cut_side(p->view, face, plane, sx, sy, p->tally);
  return side == (cut->b == HSR_BSP_FRONT ? 1 : -1);
}

/* Is the sample inside an edge of the face? An edge in line with the eye bounds
 * nothing. */
static bool within_edge(struct hsr_pieces_view *p,
                        const struct hsr_bsp_corner *edge, double sx,
                        double sy) {
  double a[3], b[3];
  moved_vertex(p, p->bsp->world, edge->a, a);
  moved_vertex(p, p->bsp->world, edge->b, b);
  return hsr_loop_edge_side(p->view, a, b, sx, sy, p->tally) != p->facing;
}

static bool past_near(void *context, double sx, double sy) {
  struct hsr_pieces_view *p = context;
  struct hsr_loop face = moved_plane(p, p->piece->face, 0);
  return hsr_loop_past_near(p->view, face, sx, sy, p->tally);
}

/* Is the sample inside line k? The lines of the sides come first; near may have
 * added one more (cut_at_near). */
static bool within_side(void *context, uint32_t k, double sx, double sy) {
  struct hsr_pieces_view *p = context;
  if (k == p->piece->n_corners)
    return past_near(context, sx, sy);
  const struct hsr_bsp_corner *side =
      &p->bsp->corner[p->piece->first_corner + k];
  return side->b < HSR_BSP_BEHIND ? within_edge(p, side, sx, sy)
                                  : within_cut(p, side, sx, sy);
}

/* Does a piece of a face that is not flat cover the sample? */
static bool covers(void *context, double sx, double sy) {
  struct hsr_pieces_view *p = context;
  const struct hsr_bsp_piece *piece = p->piece;
  struct hsr_loop face =
      moved_loop(p, hsr_face_loop(p->bsp->world, piece->face), 0);
  if (!hsr_loop_surrounds(p->view, face, sx, sy, p->tally) ||
      !hsr_loop_beyond_near(p->view, moved_plane(p, piece->face, 0), sx, sy,
                            p->tally))
    return false;
  for (uint32_t k = 0; k < piece->n_cuts; k++)
    if (!within_cut(p, &p->bsp->cut[piece->first_cut + k], sx, sy))
      return false;
  return true;
}

static bool within_box(void *context, uint32_t k, double sx, double sy) {
  const struct hsr_bounds *box =
      &((const struct hsr_pieces_view *)context)->box;
  return k == 0   ? sx > box->x0
         : k == 1 ? sx < box->x1
         : k == 2 ? sy > box->y0
                  : sy < box->y1;
}

/* --- Pieces --------------------------------------------------------------- */

/* Makes the polygon the whole box; `covers` says what of it is the face. */
static void take_box(struct hsr_pieces_view *p) {
  const struct hsr_bounds *b = &p->box;
  const double side[4][3] = {
      {1, 0, -b->x0}, {-1, 0, b->x1}, {0, 1, -b->y0}, {0, -1, b->y1}};
  for (int k = 0; k < 4; k++)
    p->line[k] = (struct hsr_mask_line){
        side[k][0], side[k][1],     side[k][2],    0x1p-30,
        1,          1 / side[k][0], 1 / side[k][1]};
  p->polygon = (struct hsr_mask_polygon){p->line, 4, within_box, covers, p};
}

/* The point between a and b whose depth is near. Its errors follow from those
 * of a and b and from that of the parameter s, which is bounded by the errors
 * of the depths: those of a and b differ by more than four times these. W is
 * that depth, or it is 1. */
static struct hsr_outline_point at_near(const struct hsr_outline_point *a,
                                        const struct hsr_outline_point *b,
                                        bool parallel, double near) {
  double step = b->t - a->t, s = (near - a->t) / step;
  double off = 2 * (hsr_max(a->et, b->et) + 2 * HSR_U * (fabs(a->t) + near)) /
                   (fabs(step) - a->et - b->et) +
               4 * HSR_U;
  double dx = b->x - a->x, dy = b->y - a->y;
  struct hsr_outline_point point = {
      a->x + s * dx, a->y + s * dy, parallel ? 1 : near, 0, 0, 0, near, 0};
  point.ex = 2 * (hsr_max(a->ex, b->ex) + off * fabs(dx)) +
             4 * HSR_U * (fabs(a->x) + fabs(b->x));
  point.ey = 2 * (hsr_max(a->ey, b->ey) + off * fabs(dy)) +
             4 * HSR_U * (fabs(a->y) + fabs(b->y));
  return point;
}

static void line_between(const struct hsr_pieces_view *p,
                         const struct hsr_outline_point *from,
                         const struct hsr_outline_point *to,
                         struct hsr_mask_line *line) {
  struct hsr_ring ring;
  for (uint32_t k = 0; k <= HSR_RING; k++)
    put_corner(&ring, k, k ? to : from);
  hsr_outline_lines(p->reach, -p->facing, &ring, 1, line);
}

/* The line where near cuts a polygon that has corners on both sides of it.
 * False if a side is not certain. The polygon's own lines stay as they are. */
static bool line_at_near(struct hsr_pieces_view *p,
                         const struct hsr_bsp_corner *corner, uint32_t n,
                         struct hsr_mask_line *line) {
  double near = p->view->near;
  struct hsr_outline_point from = {0}, to = {0};
  int found = 0;
  for (uint32_t k = 0; k < n; k++) {
    struct hsr_outline_point a = corner_point(p, &corner[k]);
    struct hsr_outline_point b =
        corner_point(p, &corner[k + 1 < n ? k + 1 : 0]);
    if (!(fabs(a.t - near) > 4 * a.et && fabs(b.t - near) > 4 * b.et))
      return false;
    if ((a.t > near) == (b.t > near))
      continue;
    *(a.t > near ? &from : &to) = at_near(&a, &b, p->view->parallel, near);
    found++;
  }
  if (found == 2)
    line_between(p, &from, &to, line);
  return found == 2;
}

/* The box of the current piece, of a leaf that is before the eye. */
static bool find_box(struct hsr_pieces_view *p) {
  const struct hsr_bsp_corner *corner = p->bsp->corner + p->piece->first_corner;
  struct hsr_hull hull = hsr_hull_none();
  hull.beyond = 0;
  for (uint32_t k = 0; k < p->piece->n_corners; k++) {
    double sx = p->sx[corner[k].point - p->first_point];
    double sy = p->sy[corner[k].point - p->first_point];
    hull.x0 = hsr_min(hull.x0, sx);
    hull.x1 = hsr_max(hull.x1, sx);
    hull.y0 = hsr_min(hull.y0, sy);
    hull.y1 = hsr_max(hull.y1, sy);
  }
  hull.x0 -= p->margin;
  hull.x1 += p->margin;
  hull.y0 -= p->margin;
  hull.y1 += p->margin;
  return hsr_hull_box(&hull, &p->view->window, p->anywhere, &p->box);
}

static bool take_window(struct hsr_pieces_view *p) {
  const struct hsr_window *w = &p->view->window;
  p->box = (struct hsr_bounds){w->x0, w->y0, w->x1, w->y1};
  return w->x0 < w->x1 && w->y0 < w->y1;
}

/* Is the eye no farther from the plane of the current piece's face than the
 * face's corners are? */
static bool is_grazed(const struct hsr_pieces_view *p) {
  /* All that hsr_grazes reads. Pieces that are moved are flat. */
  const struct hsr_screen screen = {.world = p->bsp->world, .view = p->view};
  return hsr_grazes(&screen, p->piece->face, DBL_MAX);
}

/* Whether what is before the eye may be cut at near. */
static bool may_be_near(const struct hsr_view *view) {
  return view->near > 0 || view->parallel;
}

/* The same, of a leaf that is not wholly before the eye and past near. */
static bool find_box_around(struct hsr_pieces_view *p) {
  const struct hsr_bsp_corner *corner = p->bsp->corner + p->piece->first_corner;
  struct hsr_hull hull = hsr_hull_none();
  bool is_flat = p->bsp->world->mesh.deviation[p->piece->face] == 0;
  bool has_reach = p->bsp->error[corner->point] > 0;
  bool before_near = may_be_near(p->view) && (is_flat || has_reach);
  if (p->is_wild)
    return take_window(p);
  for (uint32_t k = 0; k < p->piece->n_corners; k++) {
    struct hsr_outline_point point = corner_point(p, &corner[k]);
    hsr_hull_add(&hull, &point, &p->view->window);
    before_near &= point.t + point.et < p->view->near;
  }
  if (!is_flat && !hull.ahead && is_grazed(p))
    return take_window(p);
  return !before_near &&
         hsr_hull_box(&hull, &p->view->window, p->anywhere, &p->box);
}

bool hsr_pieces_take(struct hsr_pieces_view *p,
                     const struct hsr_bsp_piece *piece, int facing) {
  p->piece = piece;
  p->facing = facing;
  return p->ahead && p->past_near ? find_box(p) : find_box_around(p);
}

/* If the near plane may cut the current piece: adds the line at which the piece
 * ends there; or if that is not known, has its samples asked about. */
static void cut_at_near(struct hsr_pieces_view *p) {
  uint32_t n = p->piece->n_corners;
  const struct hsr_bsp_corner *corner = p->bsp->corner + p->piece->first_corner;
  bool cut = false;
  for (uint32_t k = 0; k < n; k++) {
    struct hsr_outline_point point = corner_point(p, &corner[k]);
    cut |= !(point.t - point.et > p->view->near);
  }
  if (cut && line_at_near(p, corner, n, &p->line[n]))
    p->polygon.n++;
  else if (cut)
    p->polygon.covers = past_near;
}

/* The lines of the current piece from its corner `first` on, as many as a ring
 * has. */
static void find_lines(const struct hsr_pieces_view *p, uint32_t first) {
  uint32_t n = p->piece->n_corners, left = n - first;
  const struct hsr_bsp_corner *corner = p->bsp->corner + p->piece->first_corner;
  struct hsr_ring ring;
  for (uint32_t k = 0; k <= HSR_RING; k++) {
    const struct hsr_outline_point point =
        corner_point(p, &corner[k < left ? first + k : 0]);
    put_corner(&ring, k, &point);
  }
  hsr_outline_lines(p->reach, -p->facing, &ring,
                    left < HSR_RING ? left : HSR_RING, p->line + first);
}

void hsr_pieces_outline(struct hsr_pieces_view *p) {
  const struct hsr_bsp_piece *piece = p->piece;
  uint32_t n = piece->n_corners;
  if (p->bsp->world->mesh.deviation[piece->face] > 0) {
    take_box(p);
    return;
  }
  for (uint32_t k = 0; k < n && p->is_wild; k++)
    p->line[k] = (struct hsr_mask_line){.error = INFINITY};
  for (uint32_t k = 0; k < n && !p->is_wild; k += HSR_RING)
    find_lines(p, k);
  p->polygon = (struct hsr_mask_polygon){p->line, n, within_side, NULL, p};
  if (may_be_near(p->view) && p->is_wild)
    p->polygon.covers = past_near;
  else if (may_be_near(p->view) && !p->past_near)
    cut_at_near(p);
}
