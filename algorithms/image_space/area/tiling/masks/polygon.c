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
#include "algorithms/image_space/area/tiling/masks/polygon.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"
#include "common/exact/order.h"

#include <float.h>
#include <math.h>

static const double U = DBL_EPSILON / 2;

enum { SILHOUETTE = 8 }; /* room for its lines */

/* The corners of each side of a box, counterclockwise as seen from outside. Bit
 * k of a corner's number says that it is the upper one in coordinate k. Side 2
 * k is the lower one in coordinate k. */
static const unsigned char SIDE[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5},
                                         {0, 1, 5, 4}, {2, 6, 7, 3},
                                         {0, 2, 3, 1}, {4, 5, 7, 6}};

/* The silhouette of a box for an eye that is below it, within it or above it in
 * each coordinate: place 0, 1 or 2. It goes along the edges that have one side
 * that faces the eye and one that does not. */
static struct hsr_silhouette find_silhouette(const int place[3]) {
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
  p->line = HSR_NEW(arena, struct hsr_mask_line, room.corners + SILHOUETTE);
  p->corner[0] = HSR_NEW(arena, double, 3 * (size_t)room.face);
  p->corner[1] = HSR_NEW(arena, double, 3 * (size_t)room.face);
  p->number = HSR_NEW(arena, uint32_t, room.face);
  if (!p->x || !p->y || !p->w || !p->t || !p->sx || !p->sy || !p->line ||
      !p->corner[0] || !p->corner[1] || !p->number)
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < room.face; k++)
    p->number[k] = k;
  for (int k = 0; k < 27; k++) {
    const int place[3] = {k % 3, k / 3 % 3, k / 9};
    p->silhouette[k] = find_silhouette(place);
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

/* The error of row . (V - E) for points within a box that is moved. */
static double error_of(const struct hsr_pieces_view *p, const double row[3],
                       const struct hsr_box *box, const double shift[3]) {
  double sum = 0;
  for (int k = 0; k < 3; k++)
    sum += fabs(row[k]) * hsr_max(fabs(box->lo[k] + shift[k] - p->view->E[k]),
                                  fabs(box->hi[k] + shift[k] - p->view->E[k]));
  return 8 * U * sum + 0x1p-960;
}

/* Errors of points within a box that is moved. */
static void find_errors(const struct hsr_pieces_view *p,
                        const struct hsr_box *box, const double shift[3],
                        double error[3]) {
  for (int c = 0; c < 3; c++)
    error[c] = error_of(p, p->view->screen[c], box, shift) +
               4 * U * fabs(p->view->origin[c]);
}

/* Whether a product of points of such errors may overflow: see Range. */
static bool is_wild(const double error[3]) {
  return !(error[0] <= 0x1p400 && error[1] <= 0x1p400 && error[2] <= 0x1p400);
}

static double sum_of_sizes(const double v[3]) {
  return fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
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

/* Finds where the leaf's points are on the screen; the bounds are those of
 * add_point. */
static void find_places(struct hsr_pieces_view *p,
                        const struct hsr_bsp_cube *leaf) {
  const double *own = p->bsp->error + leaf->first_point;
  double margin = 0, nearest = INFINITY;
  double spread =
      0; /* what an error of 1 in a point's coordinates amounts to in
                        X, Y and W */
  for (int c = 0; c < 3; c++) {
    double sum = 0;
    for (int k = 0; k < 3; k++)
      sum += fabs(p->view->screen[c][k]);
    spread = hsr_max(spread, sum);
  }
  double most = hsr_max(hsr_max(p->error[0], p->error[1]), p->error[2]);
  for (uint32_t k = 0; k < leaf->n_points; k++) {
    double off_k = own[k] > 0 ? own[k] + p->rounding : 0;
    double e = most + spread * off_k, per_w = 1 / p->w[k];
    p->sx[k] = p->x[k] * per_w;
    p->sy[k] = p->y[k] * per_w;
    double far = hsr_max(fabs(p->sx[k]), fabs(p->sy[k]));
    double off = (2 * e * (1 + far)) * per_w + 8 * U * far;
    margin = off > margin ? off : margin;
    nearest = hsr_min(nearest, p->w[k] - 4 * e);
  }
  p->margin = margin;
  p->ahead = !p->is_wild && nearest > 0 && margin < INFINITY;
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
  find_errors(p, &leaf->tight, p->shift, p->error);
  p->is_wild = is_wild(p->error);
  p->rounding = 0;
  for (int k = 0; k < 3; k++)
    if (p->shift[k] != 0)
      p->rounding = hsr_max(p->rounding,
                            2 * U *
                                hsr_max(fabs(leaf->tight.lo[k] + p->shift[k]),
                                        fabs(leaf->tight.hi[k] + p->shift[k])));
  transform(leaf->n_points, p->bsp->x + first, p->bsp->y + first,
            p->bsp->z + first, p->shift, p->view, p->x, p->y, p->w);
  p->t_error = p->error[2];
  if (p->view->parallel) {
    p->t_error = error_of(p, p->view->depth, &leaf->tight, p->shift);
    find_depths(leaf->n_points, p->bsp->x + first, p->bsp->y + first,
                p->bsp->z + first, p->shift, p->view, p->t);
  }
  find_places(p, leaf);
}

/* --- Lines ---------------------------------------------------------------- */

struct point {
  double x, y, w;
  double ex, ey, ew; /* what it may be off by */
  double t, et;      /* its depth, and what that may be off by */
};

/* The line from a to b, inside being where `side` times the determinant is
 * positive. */
static struct hsr_mask_line line_through(double reach, const struct point *a,
                                         const struct point *b, double side) {
  double ax = fabs(a->x), ay = fabs(a->y), aw = fabs(a->w);
  double bx = fabs(b->x), by = fabs(b->y), bw = fabs(b->w);
  double ex = hsr_max(a->ex, b->ex), ey = hsr_max(a->ey, b->ey),
         ew = hsr_max(a->ew, b->ew);
  double error_a =
      ey * (aw + bw) + ew * (ay + by) + 2 * U * (ay * bw + aw * by);
  double error_b =
      ex * (aw + bw) + ew * (ax + bx) + 2 * U * (ax * bw + aw * bx);
  double error_c =
      ex * (ay + by) + ey * (ax + bx) + 2 * U * (ax * by + ay * bx);
  struct hsr_mask_line line;
  line.a = side * (a->y * b->w - a->w * b->y);
  line.b = side * (a->w * b->x - a->x * b->w);
  line.c = side * (a->x * b->y - a->y * b->x);
  line.span = fabs(line.a) + fabs(line.b);
  line.error = 2 * (reach * (error_a + error_b) + error_c +
                    5 * U * (reach * line.span + fabs(line.c))) +
               0x1p-1000;
  line.per_a = 1 / line.a;
  line.per_b = 1 / line.b;
  return line;
}

static struct point corner_point(const struct hsr_pieces_view *p,
                                 const struct hsr_bsp_corner *corner) {
  uint32_t k = corner->point - p->first_point;
  double own = p->bsp->error[corner->point];
  const double(*r)[3] = p->view->screen;
  struct point point = {p->x[k],     p->y[k],     p->w[k], p->error[0],
                        p->error[1], p->error[2], p->t[k], p->t_error};
  if (own > 0) {
    own += p->rounding;
    point.ex += own * sum_of_sizes(r[0]);
    point.ey += own * sum_of_sizes(r[1]);
    point.ew += own * sum_of_sizes(r[2]);
    point.et += own * sum_of_sizes(p->view->depth);
  }
  return point;
}

/* --- The box of samples --------------------------------------------------- */

/* A rectangle that holds points of the screen; and the borders of the window
 * that all of them are beyond, by their homogeneous coordinates, wherever they
 * are. */
struct hull {
  double x0, y0, x1, y1;
  bool ahead; /* all points are surely before the eye */
  unsigned beyond;
};

static struct hull no_hull(void) {
  struct hull hull = {INFINITY, INFINITY, -INFINITY, -INFINITY, true, 31};
  return hull;
}

static void add_point(struct hull *hull, const struct point *a,
                      const struct hsr_window *window) {
  double x0 = window->x0, y0 = window->y0, x1 = window->x1, y1 = window->y1;
  double wide = a->ex + hsr_max(fabs(x0), fabs(x1)) * a->ew;
  double high = a->ey + hsr_max(fabs(y0), fabs(y1)) * a->ew;
  hull->beyond &= (unsigned)(a->x - x0 * a->w < -2 * wide) |
                  (unsigned)(a->x - x1 * a->w > 2 * wide) << 1 |
                  (unsigned)(a->y - y0 * a->w < -2 * high) << 2 |
                  (unsigned)(a->y - y1 * a->w > 2 * high) << 3 |
                  (unsigned)(a->w < -2 * a->ew) << 4;
  if (!(a->w > 4 * a->ew)) {
    hull->ahead = false;
    return;
  }
  double sx = a->x / a->w, sy = a->y / a->w;
  double mx = 2 * (a->ex + fabs(sx) * a->ew) / a->w + 4 * U * fabs(sx);
  double my = 2 * (a->ey + fabs(sy) * a->ew) / a->w + 4 * U * fabs(sy);
  hull->x0 = hsr_min(hull->x0, sx - mx);
  hull->x1 = hsr_max(hull->x1, sx + mx);
  hull->y0 = hsr_min(hull->y0, sy - my);
  hull->y1 = hsr_max(hull->y1, sy + my);
}

/* The first whole number from x on, within [least, most]. */
static int whole(double x, int least, int most) {
  double within = hsr_min(hsr_max(x, least), most);
  int down = (int)within;
  return down + (down < within);
}

/* The samples of the window within the hull. */
static bool box_of(const struct hull *hull, const struct hsr_window *w,
                   bool anywhere, struct hsr_bounds *box) {
  *box = (struct hsr_bounds){w->x0, w->y0, w->x1, w->y1};
  if (hull->beyond)
    return false;
  if (!hull->ahead)
    return true;
  double before = anywhere ? 1 : 0.5, after = anywhere ? 0 : 0.5;
  box->x0 = whole(hull->x0 - before, w->x0, w->x1);
  box->y0 = whole(hull->y0 - before, w->y0, w->y1);
  box->x1 = whole(hull->x1 - after, w->x0, w->x1);
  box->y1 = whole(hull->y1 - after, w->y0, w->y1);
  return box->x0 < box->x1 && box->y0 < box->y1;
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
static struct point at_near(const struct point *a, const struct point *b,
                            bool parallel, double near) {
  double step = b->t - a->t, s = (near - a->t) / step;
  double off = 2 * (hsr_max(a->et, b->et) + 2 * U * (fabs(a->t) + near)) /
                   (fabs(step) - a->et - b->et) +
               4 * U;
  double dx = b->x - a->x, dy = b->y - a->y;
  struct point point = {
      a->x + s * dx, a->y + s * dy, parallel ? 1 : near, 0, 0, 0, near, 0};
  point.ex = 2 * (hsr_max(a->ex, b->ex) + off * fabs(dx)) +
             4 * U * (fabs(a->x) + fabs(b->x));
  point.ey = 2 * (hsr_max(a->ey, b->ey) + off * fabs(dy)) +
             4 * U * (fabs(a->y) + fabs(b->y));
  return point;
}

/* The line where near cuts a polygon that has corners on both sides of it.
 * False if a side is not certain. The polygon's own lines stay as they are. */
static bool line_at_near(struct hsr_pieces_view *p,
                         const struct hsr_bsp_corner *corner, uint32_t n,
                         struct hsr_mask_line *line) {
  double near = p->view->near;
  struct point from = {0}, to = {0};
  int found = 0;
  for (uint32_t k = 0; k < n; k++) {
    struct point a = corner_point(p, &corner[k]);
    struct point b = corner_point(p, &corner[k + 1 < n ? k + 1 : 0]);
    if (!(fabs(a.t - near) > 4 * a.et && fabs(b.t - near) > 4 * b.et))
      return false;
    if ((a.t > near) == (b.t > near))
      continue;
    *(a.t > near ? &from : &to) = at_near(&a, &b, p->view->parallel, near);
    found++;
  }
  if (found == 2)
    *line = line_through(p->reach, &from, &to, -p->facing);
  return found == 2;
}

/* The box of the piece at hand, of a leaf that is before the eye. */
static bool find_box(struct hsr_pieces_view *p) {
  const struct hsr_bsp_corner *corner = p->bsp->corner + p->piece->first_corner;
  struct hull hull = no_hull();
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
  return box_of(&hull, &p->view->window, p->anywhere, &p->box);
}

static bool take_window(struct hsr_pieces_view *p) {
  const struct hsr_window *w = &p->view->window;
  p->box = (struct hsr_bounds){w->x0, w->y0, w->x1, w->y1};
  return w->x0 < w->x1 && w->y0 < w->y1;
}

/* Whether the eye is no farther from the plane of the face at hand than its
 * corners are. */
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
  struct hull hull = no_hull();
  bool is_flat = p->bsp->world->mesh.deviation[p->piece->face] == 0;
  bool has_reach = p->bsp->error[corner->point] > 0;
  bool before_near = may_be_near(p->view) && (is_flat || has_reach);
  if (p->is_wild)
    return take_window(p);
  for (uint32_t k = 0; k < p->piece->n_corners; k++) {
    struct point point = corner_point(p, &corner[k]);
    add_point(&hull, &point, &p->view->window);
    before_near &= point.t + point.et < p->view->near;
  }
  if (!is_flat && !hull.ahead && is_grazed(p))
    return take_window(p);
  return !before_near && box_of(&hull, &p->view->window, p->anywhere, &p->box);
}

bool hsr_pieces_take(struct hsr_pieces_view *p,
                     const struct hsr_bsp_piece *piece, int facing) {
  p->piece = piece;
  p->facing = facing;
  return p->ahead && p->past_near ? find_box(p) : find_box_around(p);
}

/* Has the piece at hand end at near, if near may cut it. */
static void cut_at_near(struct hsr_pieces_view *p) {
  uint32_t n = p->piece->n_corners;
  const struct hsr_bsp_corner *corner = p->bsp->corner + p->piece->first_corner;
  bool cut = false;
  for (uint32_t k = 0; k < n; k++) {
    struct point point = corner_point(p, &corner[k]);
    cut |= !(point.t - point.et > p->view->near);
  }
  if (cut && line_at_near(p, corner, n, &p->line[n]))
    p->polygon.n++;
  else if (cut)
    p->polygon.covers = past_near;
}

void hsr_pieces_outline(struct hsr_pieces_view *p) {
  const struct hsr_bsp_piece *piece = p->piece;
  const struct hsr_bsp_corner *corner = p->bsp->corner + piece->first_corner;
  uint32_t n = piece->n_corners;
  if (p->bsp->world->mesh.deviation[piece->face] > 0) {
    take_box(p);
    return;
  }
  struct point from = corner_point(p, &corner[0]), first = from;
  for (uint32_t k = 0; k < n && p->is_wild; k++)
    p->line[k] = (struct hsr_mask_line){.error = INFINITY};
  for (uint32_t k = 0; k < n && !p->is_wild; k++) {
    struct point to = k + 1 < n ? corner_point(p, &corner[k + 1]) : first;
    p->line[k] = line_through(p->reach, &from, &to, -p->facing);
    from = to;
  }
  p->polygon = (struct hsr_mask_polygon){p->line, n, within_side, NULL, p};
  if (may_be_near(p->view) && p->is_wild)
    p->polygon.covers = past_near;
  else if (may_be_near(p->view) && !p->past_near)
    cut_at_near(p);
}

/* --- Boxes ---------------------------------------------------------------- */

/* A moved box, and a little more: the sums are rounded. */
static struct hsr_box moved_box(const struct hsr_box *box,
                                const double shift[3]) {
  struct hsr_box moved;
  for (int c = 0; c < 3; c++) {
    double lo = box->lo[c] + shift[c], hi = box->hi[c] + shift[c];
    moved.lo[c] = lo - 2 * U * fabs(lo);
    moved.hi[c] = hi + 2 * U * fabs(hi);
  }
  return moved;
}

/* The corners of a box, coordinate by coordinate, all with the same errors; and
 * their places on the screen. */
struct corners {
  double x[8], y[8], w[8], sx[8], sy[8];
  double error[3]; /* of X, Y, W */
};

/* A corner has the upper end in coordinate c where bit c of its number is 1. */
static const double UPPER[3][8] = {{0, 1, 0, 1, 0, 1, 0, 1},
                                   {0, 0, 1, 1, 0, 0, 1, 1},
                                   {0, 0, 0, 0, 1, 1, 1, 1}};

/* A homogeneous coordinate of all corners, from that of the first, and what a
 * side of the box adds to it. */
static inline __attribute__((always_inline)) void
add_sides(double first, const double add[3], double *restrict at) {
  for (int k = 0; k < 8; k++)
    at[k] = first + add[0] * UPPER[0][k] + add[1] * UPPER[1][k] +
            add[2] * UPPER[2][k];
}

/* The corner of the lower ends, to which the sides are added. That takes six
 * more roundings than the bound for a leaf's points allows, of terms no larger
 * than twice the sum; so the bound is taken three times. */
HSR_VECTOR static void find_corners(const struct hsr_view *view,
                                    const struct hsr_box *box,
                                    struct corners *restrict corner) {
  const double(*r)[3] = view->screen;
  double lo[3], first[3], add[3][3];
  for (int c = 0; c < 3; c++)
    lo[c] = box->lo[c] - view->E[c];
  for (int row = 0; row < 3; row++) {
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
    corner->sx[k] = corner->x[k] * per_w;
    corner->sy[k] = corner->y[k] * per_w;
  }
}

static struct point corner_of_box(const struct corners *corner, int k) {
  return (struct point){.x = corner->x[k],
                        .y = corner->y[k],
                        .w = corner->w[k],
                        .ex = corner->error[0],
                        .ey = corner->error[1],
                        .ew = corner->error[2],
                        .t = NAN, /* nobody asks */
                        .et = NAN};
}

static double least_of(const double at[8]) {
  double least[4];
  for (int k = 0; k < 4; k++)
    least[k] = hsr_min(at[k], at[k + 4]);
  return hsr_min(hsr_min(least[0], least[1]), hsr_min(least[2], least[3]));
}

static double most_of(const double at[8]) {
  double most[4];
  for (int k = 0; k < 4; k++)
    most[k] = hsr_max(at[k], at[k + 4]);
  return hsr_max(hsr_max(most[0], most[1]), hsr_max(most[2], most[3]));
}

/* The hull of the corners of a box. */
static struct hull hull_of(const struct hsr_pieces_view *p,
                           const struct corners *corner) {
  struct hull hull = no_hull();
  const double *error = corner->error;
  double e = hsr_max(error[0], hsr_max(error[1], error[2]));
  double nearest = least_of(corner->w);
  if (!(nearest > 4 * e)) {
    for (int k = 0; k < 8; k++) {
      struct point point = corner_of_box(corner, k);
      add_point(&hull, &point, &p->view->window);
    }
    return hull;
  }
  hull.beyond = 0;
  hull.x0 = least_of(corner->sx);
  hull.x1 = most_of(corner->sx);
  hull.y0 = least_of(corner->sy);
  hull.y1 = most_of(corner->sy);
  double far = hsr_max(hsr_max(fabs(hull.x0), fabs(hull.x1)),
                       hsr_max(fabs(hull.y0), fabs(hull.y1)));
  double margin = 2 * e * (1 + far) / nearest + 8 * U * far;
  hull.x0 -= margin;
  hull.x1 += margin;
  hull.y0 -= margin;
  hull.y1 += margin;
  return hull;
}

const struct hsr_mask_polygon *hsr_pieces_silhouette(struct hsr_pieces_view *p,
                                                     const struct hsr_box *box,
                                                     const double shift[3],
                                                     bool *known) {
  static const double still[3] = {0, 0, 0};
  struct hsr_box moved = moved_box(box, shift);
  struct corners corner;
  int place = 0;
  find_errors(p, &moved, still, corner.error);
  for (int c = 0; c < 3; c++)
    corner.error[c] *= 3;
  *known = !is_wild(corner.error);
  if (!*known)
    return NULL;
  find_corners(p->view, &moved, &corner);
  struct hull hull = hull_of(p, &corner);
  if (!box_of(&hull, &p->view->window, p->anywhere, &p->box))
    return NULL;
  for (int c = 2; c >= 0; c--)
    place = 3 * place + (p->view->eye[c] < moved.lo[c]   ? 0
                         : p->view->eye[c] > moved.hi[c] ? 2
                                                         : 1);
  const struct hsr_silhouette *s = &p->silhouette[place];
  *known = hull.ahead && s->n;
  for (int k = 0; *known && k < s->n; k++) {
    struct point from = corner_of_box(&corner, s->corner[k]);
    struct point to =
        corner_of_box(&corner, s->corner[k + 1 < s->n ? k + 1 : 0]);
    p->line[k] = line_through(p->reach, &from, &to, -1);
  }
  p->polygon =
      (struct hsr_mask_polygon){p->line, (uint32_t)s->n, NULL, NULL, p};
  return *known ? &p->polygon : NULL;
}
