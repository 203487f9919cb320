/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The perspective transform, and the proofs of the filters.
 *
 * Notation    u = 2^-53; a hat marks a computed value; |.|_1 a sum of absolute
 *             components, |.|inf the largest; v = V - E; delta = HSR_DELTA =
 *             2^-26; G = HSR_GUARD = 2^15. Everything is in doubles, rounded to
 *             nearest, nothing contracted. Coordinates are at most 1e30 in size
 *             (common/scene/scene.c), so that normals and heights do not
 *             overflow. Where underflow can matter, adding 2^-960 covers it: a
 *             product is off by 2^-1074 more, at most, or by that times a
 *             factor below 2^102. The screen matrix is large in a narrow view.
 *             What overflows there is infinite or not a number: no comparison
 *             with it decides anything.
 *
 * Vertices. Each component of v^ carries one rounding, and an entry M of the
 * screen matrix a relative error of 2u. A product of the two adds one rounding,
 * and the sum of three products at most two. So a homogeneous coordinate is
 * within 7u |M_row|_1 |v|inf of the true one, to first order. With r = |v^|inf,
 * 8u |M_row|_1 r holds all orders.
 * Then sx = (w sx)/w is within (8u |M_x|_1 r + |sx| 8u |M_w|_1 r)/w of the true
 * one, plus two roundings of the division (a reciprocal and a product), at most
 * 3u G = 2^-36. A vertex is called safe if |sx|, |sy| <= G and
 *     w >= kappa r,  kappa = 8u (max(|M_x|_1, |M_y|_1) + G |M_w|_1) * 4/delta,
 * so that the first part is at most delta/4 (1 + small) and the whole below
 * delta. It also gives w > 0 for the true w. (r >= 2^-500 excludes underflow.)
 *
 * Depth planes. On the plane N.(X - P) = 0, 1/t = N.D / c with c = N.(P - E).
 * With r = P^ - E, c^ is within e_c = 2 (n_error |r|_1 + anchor_error |N|_1) +
 * 16u sum|N_k r_k| + 2^-960. N.D = N.ray0 + sx N.ray1 + sy N.ray2. With D_k =
 * |ray0_k| + m |ray1_k| + n |ray2_k|, which bounds every |D_k| in the picture,
 * and S = sum |N_k| D_k, each evaluation of it is within e_n = n_error |D|_1 +
 * 16u S + 2^-960. So |q^ - q| <= (e_n + Q e_c)/(|c^| - e_c) + 16u Q,  Q =
 * S/|c^|, where the last term covers the divisions by c^ and the sums of a sx +
 * b sy + c, each term of which is at most Q (1 + small).
 *
 * Depth at a vertex. A safe vertex has |sx|, |sy| <= G, and there |D| is at
 * most max(1, G/m, G/n) times what it is in the picture. All terms of the error
 * |q^ - q| grow with |D| by that factor at most, those of rounding included.
 * The vertex's own error adds delta times the slopes of q, which differ from a^
 * and b^ by less than that error over G. `outside` = 2 + G/m + G/n and 2 delta
 * hold it all. The same is true of the difference of two planes' q. Now let
 * q_f >= q_g at all vertices of a whole face f. The difference is affine, so
 * q_f >= q_g in the convex hull of the vertices on the screen. Inside the hull
 * q_f > q_g, unless the two functions are the same and so are the planes. A
 * displaced sample that the face covers is inside.
 *
 * Facing. c < 0 means that the eye is in front. If |c^| > e_c + deviation, the
 * sign is certain. Every point X of the face's convex hull then has N.(X - E)
 * of the sign of c too, since |N.(X - P)| <= deviation. Let a ray from the eye
 * pass the hull at E + s D and the plane at E + t D: then s and t have one
 * sign. So what the ray covers by parity lies ahead of the eye on the plane if
 * and only if it does in the hull. That is why faces may be culled, and called
 * whole, by their vertices, although a face may be a little out of plane.
 *
 * Parallel. Row 2 of the screen matrix is 0, and the origin is added: w = 1,
 * and sx and sy. The sum rounds once more. If 8u |M_x|_1 r <= delta/4, as kappa
 * says with |M_w|_1 = 0, then |w sx| before the sum is within delta/4, and the
 * sum is within 2u G = 2^-37 more. w, its reciprocal and the products with it
 * are exact. Underflow is off by 2^-1074, which the sum with the origin
 * swallows. The homogeneous coordinates below have errors of u (m + n) more,
 * for the sum; |A_k| <= (1 + 8u) e_k / 8u holds too, since e_k takes 8u times
 * the origin.
 *     The depth plane is q = N.(P' - P) / N.F with P' = E + ray0 + sx ray1 + sy
 * ray2. So c is N.F, and with the r of above e_c = 2 n_error |F|_1 + 16u
 * sum|N_k F_k| + 2^-960. The numerator is N.(ray) - N.r: each of the two sums
 * carries its own error, e_n for the first as before and e_r for the second as
 * e_c was before. The size of the numerator is S + sum|N_k r_k|, and it takes
 * the place of S. The eye is infinitely far from every plane that it is not in,
 * so a face's deviation does not matter for its facing.
 *     Nothing is ahead or behind by the vertices. Whole faces are those
 * with t > near at all their vertices, on their plane. There t is linear on the
 * screen, and its error at a vertex is hsr_vertex_error.
 *
 * Row sides. sy of a safe vertex is within delta; the sample's is exact.
 *
 * Edge sides. With d = b - a and h = s - a on the screen, e = dx hy - dy hx. d^
 * is within 2 delta + 2^-37 of d in each component, and h^ within delta +
 * 2^-37. The products and their difference round by at most
 * 2u (|dx hy| + |dy hx|) <= 2^-36 (|hx| + |hy|), since |d| <= 2^16. In all,
 * e^ is within 2.1 delta (|dx| + |dy| + |hx| + |hy|) + 4.2 delta^2; the filter
 * takes 4 and 8. sign e is sign edge(a, b), since that is e times
 * w_a w_b det(F, R, U) times a negative constant; both w are positive, and
 * det(F, R, U) < 0 in a right-handed world.
 *
 * Behind the eye, or beside it, a vertex still has homogeneous coordinates
 * A = S v, where S is the screen matrix. As computed they are within
 * e_k = 8u |S_k|_1 |v|inf, and |A_k| <= (1 + 8u) e_k / 8u. row(v) has the sign
 * of A_1 - sy A_2, and edge(a, b) that of det(A, B, (sx, sy, 1)), as before the
 * division. The first is within e_1 + |sy| e_2, plus the rounding of the
 * product and of the difference, at most a quarter of that each; the filter
 * takes three times it. A product A_k B_l carries e_k |B_l| + f_l |A_k| <= 2.1
 * e_k f_l / 8u and a rounding of e_k f_l / 64u. The further roundings of the
 * sums are four times that, and the sum of all is within 0.4 e f / u; the
 * filter takes e f / u. That holds unless a product overflows; none does if
 * every e_k and f_k is at most 2^400, for then every |A_k| is below 2^460.
 *
 * Edge columns. For |dy| >= 16 delta the parameter of the crossing,
 * (y - ay)/dy in [0, 1], is within 3.5 delta/|dy|, and the crossing ax + dx t
 * is within delta + 2.1 delta + 3.5 delta |dx/dy|. Rounding of x + slope sy
 * adds at most 4u (G + 2 G |slope|) <= 2^-35 (1 + |slope|). The filter takes 4
 * delta (1 + |slope|). */
#include "common/exact/screen.h"
#include "common/view/clip.h"
#include "common/exact/predicates.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

static const double U = DBL_EPSILON / 2;
static const double TINY = 0x1p-960;

/* --- Making the screen coordinates ---------------------------------------- */

enum hsr_status hsr_screen_init(struct hsr_screen *screen,
                                const struct hsr_world *world,
                                const struct hsr_view *view,
                                struct hsr_arena *arena) {
  size_t nv = world->mesh.n_vertices, nf = world->n_faces;
  *screen = (struct hsr_screen){.world = world, .view = view};
  for (int k = 0; k < 3; k++)
    screen->reach[k] = fabs(view->ray[0][k]) + view->m * fabs(view->ray[1][k]) +
                       view->n * fabs(view->ray[2][k]);
  screen->outside = 2 + HSR_GUARD / view->m + HSR_GUARD / view->n;
  screen->sx = HSR_NEW(arena, double, nv);
  screen->sy = HSR_NEW(arena, double, nv);
  screen->q = HSR_NEW(arena, double, nv);
  screen->plane = HSR_NEW(arena, struct hsr_depth_plane, nf);
  screen->facing = HSR_NEW(arena, signed char, nf);
  screen->relevant = HSR_NEW(arena, uint32_t, nf);
  screen->bounds = HSR_NEW(arena, struct hsr_bounds, nf);
  screen->whole = HSR_NEW(arena, bool, nf);
  return screen->sx && screen->sy && screen->q && screen->plane &&
                 screen->facing && screen->relevant && screen->bounds &&
                 screen->whole
             ? HSR_OK
             : HSR_E_NOMEM;
}

static double sum_of_sizes(const double v[3]) {
  return fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
}

/* kappa of the proof above. */
static double safe_cosine(const struct hsr_view *view) {
  double x = sum_of_sizes(view->screen[0]), y = sum_of_sizes(view->screen[1]);
  double w = sum_of_sizes(view->screen[2]);
  return 8 * U * (hsr_max(x, y) + HSR_GUARD * w) * (4 / HSR_DELTA);
}

HSR_VECTOR static void
transform_points(size_t n, const double *restrict x, const double *restrict y,
                 const double *restrict z, const double E[3],
                 const double M[3][3], const double O[3], double kappa,
                 double least, double *restrict sx, double *restrict sy,
                 double *restrict q) {
  const double e0 = E[0], e1 = E[1], e2 = E[2];
  const double o0 = O[0], o1 = O[1], o2 = O[2];
  const double m00 = M[0][0], m01 = M[0][1], m02 = M[0][2];
  const double m10 = M[1][0], m11 = M[1][1], m12 = M[1][2];
  const double m20 = M[2][0], m21 = M[2][1], m22 = M[2][2];
  for (size_t v = 0; v < n; v++) {
    double vx = x[v] - e0, vy = y[v] - e1, vz = z[v] - e2;
    double ax = fabs(vx), ay = fabs(vy), az = fabs(vz);
    double r = ax > ay ? ax : ay;
    r = r > az ? r : az;
    double w = m20 * vx + m21 * vy + m22 * vz + o2;
    double reciprocal = 1 / w;
    double px = (m00 * vx + m01 * vy + m02 * vz + o0) * reciprocal;
    double py = (m10 * vx + m11 * vy + m12 * vz + o1) * reciprocal;
    int safe = (w >= kappa * r) & (r >= least) & (fabs(px) <= HSR_GUARD) &
               (fabs(py) <= HSR_GUARD);
    sx[v] = safe ? px : NAN;
    sy[v] = safe ? py : NAN;
    q[v] = reciprocal;
  }
}

void hsr_screen_points(const struct hsr_screen *screen, size_t n,
                       const double *x, const double *y, const double *z,
                       double *sx, double *sy, double *q) {
  const struct hsr_view *view = screen->view;
  transform_points(n, x, y, z, view->E, view->screen, view->origin,
                   safe_cosine(view), view->parallel ? 0 : 0x1p-500, sx, sy, q);
}

void hsr_screen_vertices(struct hsr_screen *screen) {
  const struct hsr_mesh *mesh = &screen->world->mesh;
  hsr_screen_points(screen, mesh->n_vertices, mesh->x, mesh->y, mesh->z,
                    screen->sx, screen->sy, screen->q);
}

void hsr_screen_corners(struct hsr_screen *screen, uint32_t f) {
  const struct hsr_mesh *mesh = &screen->world->mesh;
  for (uint32_t c = mesh->start[f]; c < mesh->start[f + 1]; c++) {
    uint32_t v = mesh->vertex[c];
    hsr_screen_points(screen, 1, mesh->x + v, mesh->y + v, mesh->z + v,
                      screen->sx + v, screen->sy + v, screen->q + v);
  }
}

/* Constants of a view, the same for all faces: see hsr_screen and the proof
 * above. */
struct plane_frame {
  double e0, e1, e2;    /* E */
  double f0, f1, f2, F; /* F, and the sum of its sizes */
  double r[3][3];       /* the rays */
  double D0, D1, D2, D; /* reach, and the sum of it */
};

static struct plane_frame plane_frame(const struct hsr_screen *screen) {
  const struct hsr_view *view = screen->view;
  struct plane_frame frame = {.e0 = view->E[0],
                              .e1 = view->E[1],
                              .e2 = view->E[2],
                              .f0 = view->F[0],
                              .f1 = view->F[1],
                              .f2 = view->F[2],
                              .F = sum_of_sizes(view->F),
                              .D0 = screen->reach[0],
                              .D1 = screen->reach[1],
                              .D2 = screen->reach[2]};
  frame.D = frame.D0 + frame.D1 + frame.D2;
  memcpy(frame.r, view->ray, sizeof frame.r);
  return frame;
}

/* Inlined once for each projection. */
static inline __attribute__((always_inline)) void
depth_plane(const struct hsr_world *world, const struct plane_frame *v,
            bool parallel, size_t f, struct hsr_depth_plane *plane,
            signed char *facing) {
  double n0 = world->mesh.nx[f], n1 = world->mesh.ny[f], n2 = world->mesh.nz[f];
  double r0 = world->mesh.px[f] - v->e0, r1 = world->mesh.py[f] - v->e1,
         r2 = world->mesh.pz[f] - v->e2;
  double c0 = n0 * r0, c1 = n1 * r1, c2 = n2 * r2;
  double distance = c0 + c1 + c2;
  double n_size = fabs(n0) + fabs(n1) + fabs(n2);
  double e_r = 2 * (world->mesh.n_error[f] * (fabs(r0) + fabs(r1) + fabs(r2)) +
                    world->mesh.anchor_error[f] * n_size) +
               16 * U * (fabs(c0) + fabs(c1) + fabs(c2)) + TINY;
  double S = fabs(n0) * v->D0 + fabs(n1) * v->D1 + fabs(n2) * v->D2;
  double e_n = world->mesh.n_error[f] * v->D + 16 * U * S + TINY;
  double c = distance, e_c = e_r, rest = 0,
         deviation = world->mesh.deviation[f];
  if (parallel) {
    double g0 = n0 * v->f0, g1 = n1 * v->f1, g2 = n2 * v->f2;
    c = g0 + g1 + g2;
    e_c = 2 * world->mesh.n_error[f] * v->F +
          16 * U * (fabs(g0) + fabs(g1) + fabs(g2)) + TINY;
    S += fabs(c0) + fabs(c1) + fabs(c2);
    e_n += e_r;
    rest = distance;
    deviation = 0;
  }
  double c_size = fabs(c);
  double inverse = 1 / c, Q = S * fabs(inverse);
  double error = (e_n + Q * e_c) / (c_size - e_c) + 16 * U * Q;
  int known = c_size > 2 * e_c;
  double a = (n0 * v->r[1][0] + n1 * v->r[1][1] + n2 * v->r[1][2]) * inverse;
  double b = (n0 * v->r[2][0] + n1 * v->r[2][1] + n2 * v->r[2][2]) * inverse;
  double d =
      (n0 * v->r[0][0] + n1 * v->r[0][1] + n2 * v->r[0][2] - rest) * inverse;
  plane->a = known ? a : 0;
  plane->b = known ? b : 0;
  plane->c = known ? d : 0;
  plane->error = known ? error : INFINITY;
  int certain = c_size > e_c + deviation;
  *facing = (signed char)(certain ? (c < 0 ? 1 : -1) : 0);
}

HSR_VECTOR static void depth_planes(size_t n, const struct hsr_world *world,
                                    struct plane_frame frame,
                                    struct hsr_depth_plane *restrict plane,
                                    signed char *restrict facing) {
  const struct hsr_world w = *world; /* its pointers do not change */
  for (size_t f = 0; f < n; f++)
    depth_plane(&w, &frame, false, f, &plane[f], &facing[f]);
}

HSR_VECTOR static void parallel_depth_planes(
    size_t n, const struct hsr_world *world, struct plane_frame frame,
    struct hsr_depth_plane *restrict plane, signed char *restrict facing) {
  const struct hsr_world w = *world;
  for (size_t f = 0; f < n; f++)
    depth_plane(&w, &frame, true, f, &plane[f], &facing[f]);
}

void hsr_screen_planes(struct hsr_screen *screen) {
  (screen->view->parallel ? parallel_depth_planes : depth_planes)(
      screen->world->n_faces, screen->world, plane_frame(screen), screen->plane,
      screen->facing);
}

void hsr_screen_plane(struct hsr_screen *screen, uint32_t f) {
  struct plane_frame frame = plane_frame(screen);
  depth_plane(screen->world, &frame, screen->view->parallel, f,
              &screen->plane[f], &screen->facing[f]);
}

/* --- Pieces --------------------------------------------------------------- */

struct cuts {
  const struct hsr_cut *cut;
  size_t n;
};

/* The cuts that make face f a piece; none in a world that is not of pieces. */
static struct cuts own_cuts(const struct hsr_world *world, uint32_t f) {
  const struct hsr_pieces *p = world->pieces;
  if (!p)
    return (struct cuts){NULL, 0};
  return (struct cuts){p->cut + p->cut_start[f],
                       p->cut_start[f + 1] - p->cut_start[f]};
}

/* --- The culls ------------------------------------------------------------ */

bool hsr_face_exists(const struct hsr_screen *screen, uint32_t f,
                     struct hsr_tally *tally) {
  int facing = screen->facing[f];
  if (!facing) {
    tally->exact[HSR_ASK_FACING]++;
    facing = hsr_exact_eye_side(screen->view, hsr_plane_loop(screen->world, f),
                                &tally->out_of_memory);
  }
  return facing > 0 || (facing < 0 && !screen->world->mesh.one_sided[f]);
}

/* The window's samples within screen coordinates [lo, hi], as [*begin, *end).
 */
static void sample_range(double lo, double hi, double first, int from, int to,
                         int *begin, int *end) {
  double a = ceil(lo - first), b = floor(hi - first) + 1;
  *begin = a <= from ? from : a >= to ? to : (int)a;
  *end = b >= to ? to : b <= from ? from : (int)b;
}

static struct hsr_bounds sample_bounds(const struct hsr_view *view, double x0,
                                       double y0, double x1, double y1) {
  struct hsr_bounds b;
  const struct hsr_window *w = &view->window;
  sample_range(x0, x1, hsr_sample_x(view, 0), w->x0, w->x1, &b.x0, &b.x1);
  sample_range(y0, y1, hsr_sample_y(view, 0), w->y0, w->y1, &b.y0, &b.y1);
  return b;
}

/* The bounds of a face's vertices. False if one of them is not safe. */
static bool vertex_bounds(const struct hsr_screen *screen, uint32_t f,
                          struct hsr_bounds *bounds) {
  const struct hsr_world *world = screen->world;
  double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
  bool safe = true;
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
    double x = screen->sx[world->mesh.vertex[k]],
           y = screen->sy[world->mesh.vertex[k]];
    safe &= x == x;
    x0 = x < x0 ? x : x0;
    x1 = x > x1 ? x : x1;
    y0 = y < y0 ? y : y0;
    y1 = y > y1 ? y : y1;
  }
  if (safe)
    *bounds = sample_bounds(screen->view, x0 - HSR_DELTA, y0 - HSR_DELTA,
                            x1 + HSR_DELTA, y1 + HSR_DELTA);
  return safe;
}

/* Homogeneous screen coordinates of vertex v, and a bound of their errors. */
static void homogeneous_of(const struct hsr_view *view, const double at[3],
                           double p[3], double error[3]) {
  double d[3] = {at[0] - view->E[0], at[1] - view->E[1], at[2] - view->E[2]};
  double r = hsr_max(fabs(d[0]), hsr_max(fabs(d[1]), fabs(d[2])));
  for (int k = 0; k < 3; k++) {
    const double *row = view->screen[k];
    p[k] = row[0] * d[0] + row[1] * d[1] + row[2] * d[2] + view->origin[k];
    error[k] =
        hsr_max(error[k],
                8 * U * (sum_of_sizes(row) * r + fabs(view->origin[k])) + TINY);
  }
}

static void homogeneous(const struct hsr_screen *screen, uint32_t v,
                        double p[3], double error[3]) {
  const struct hsr_mesh *mesh = &screen->world->mesh;
  const double at[3] = {mesh->x[v], mesh->y[v], mesh->z[v]};
  homogeneous_of(screen->view, at, p, error);
}

/* Whether no product of two coordinates of such errors overflows. */
static bool within_range(const double error[3]) {
  return error[0] <= 0x1p400 && error[1] <= 0x1p400 && error[2] <= 0x1p400;
}

/* Bounds of a triangle or quadrilateral that reaches behind the eye. It is
 * clipped, before the division, to what lies ahead and within a pixel of the
 * window. The clipping planes are moved out by the error of the coordinates, so
 * that no true point of the face in the window is lost. If any of the rest is
 * so near the eye that the division would magnify the errors to half a pixel,
 * the bounds are the whole window. */
static struct hsr_bounds clipped_bounds(const struct hsr_screen *screen,
                                        uint32_t f) {
  const struct hsr_world *world = screen->world;
  const struct hsr_view *view = screen->view;
  const struct hsr_window *window = &view->window;
  const struct hsr_bounds all = {window->x0, window->y0, window->x1,
                                 window->y1};
  const struct hsr_bounds none = {window->x0, window->y0, window->x0,
                                  window->y0};
  uint32_t size = hsr_face_size(world, f);
  if (size > 4)
    return all;
  double a[32][3], b[32][3], error[3] = {0}; /* 4 grows to 31 at the most */
  int n = (int)size;
  for (uint32_t k = 0; k < size; k++)
    homogeneous(screen, world->mesh.vertex[world->mesh.start[f] + k], a[k],
                error);

  if (!within_range(error))
    return all;

  double x0 = window->x0 - 1, x1 = window->x1 + 1, y0 = window->y0 - 1,
         y1 = window->y1 + 1;
  const double planes[5][3] = {
      {0, 0, 1}, {1, 0, -x0}, {-1, 0, x1}, {0, 1, -y0}, {0, -1, y1}};
  for (int side = 0; side < 5 && n; side++) {
    const double *plane = planes[side];
    double margin = 2 * (fabs(plane[0]) * error[0] + fabs(plane[1]) * error[1] +
                         fabs(plane[2]) * error[2]);
    n = hsr_clip((const double(*)[3])a, n, plane, margin, b);
    memcpy(a, b, sizeof a);
  }
  if (!n)
    return none;

  double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
  double least = 4 * (hsr_max(error[0], error[1]) + HSR_GUARD * error[2]);
  for (int k = 0; k < n; k++) {
    if (!(a[k][2] > least))
      return all;
    for (int c = 0; c < 2; c++) {
      double s = a[k][c] / a[k][2];
      lo[c] = s < lo[c] ? s : lo[c];
      hi[c] = s > hi[c] ? s : hi[c];
    }
  }
  return sample_bounds(view, lo[0] - 1, lo[1] - 1, hi[0] + 1, hi[1] + 1);
}

/* Whether all of the face's vertices are certainly behind the eye. */
static bool wholly_behind(const struct hsr_screen *screen, uint32_t f) {
  const struct hsr_world *world = screen->world;
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
    double p[3], error[3] = {0};
    if (screen->sx[world->mesh.vertex[k]] == screen->sx[world->mesh.vertex[k]])
      return false;
    homogeneous(screen, world->mesh.vertex[k], p, error);
    if (!(p[2] < -error[2]))
      return false;
  }
  return true;
}

/* The two halves of t > near, by a q that is within `error`: +1 if both
 * certainly hold, -1 if one certainly does not, else 0. */
static int beyond_near_by(const struct hsr_view *view, double q, double error) {
  if (view->parallel)
    return q + error < -view->near ? 1 : q - error > -view->near ? -1 : 0;
  if (q < -error || view->near * (q - error) > 1 + 8 * U)
    return -1;
  return q > error && view->near * (q + error) < 1 - 8 * U;
}

/* What beyond_near_by says of the face's plane at all its vertices, which are
 * safe; 0 if that differs. In parallel projection, where t is linear on the
 * screen, it holds all over the face then. */
static int vertices_beyond_near(const struct hsr_screen *screen, uint32_t f) {
  const struct hsr_world *world = screen->world;
  double error = hsr_vertex_error(screen, f);
  int all = 0;
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
    double q = hsr_vertex_depth(screen, f, world->mesh.vertex[k]);
    int side = beyond_near_by(screen->view, q, error);
    if (!side || (all && side != all))
      return 0;
    all = side;
  }
  return all;
}

/* Whether q > 0 and near q < 1 certainly hold on the face's plane within its
 * bounds. */
static bool clear_of_near(const struct hsr_screen *screen, uint32_t f) {
  const struct hsr_bounds *b = &screen->bounds[f];
  for (int corner = 0; corner < 4; corner++) {
    double q = hsr_depth(screen, f, corner & 1 ? b->x1 - 1 : b->x0,
                         corner & 2 ? b->y1 - 1 : b->y0);
    if (beyond_near_by(screen->view, q, screen->plane[f].error) <= 0)
      return false;
  }
  return true;
}

/* Narrows the bounds of a divided face to those of its outline, if that is
 * safely before the eye. The outline's points are off by outline_error, which
 * the matrix magnifies as in the proof above. */
static void narrow_to_outline(const struct hsr_screen *screen, uint32_t f,
                              struct hsr_bounds *b) {
  const struct hsr_pieces *p = screen->world->pieces;
  const double(*M)[3] = screen->view->screen;
  double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY, q = 0;
  bool safe = p->outline_start[f] < p->outline_start[f + 1];
  for (uint32_t k = p->outline_start[f]; k < p->outline_start[f + 1]; k++) {
    uint32_t v = p->outline[k];
    safe &= screen->sx[v] == screen->sx[v];
    x0 = fmin(x0, screen->sx[v]);
    x1 = fmax(x1, screen->sx[v]);
    y0 = fmin(y0, screen->sy[v]);
    y1 = fmax(y1, screen->sy[v]);
    q = fmax(q, screen->q[v]);
  }
  if (!safe)
    return;
  double off = 1 + 2 * p->outline_error * q *
                       (hsr_max(sum_of_sizes(M[0]), sum_of_sizes(M[1])) +
                        HSR_GUARD * sum_of_sizes(M[2]));
  struct hsr_bounds o =
      sample_bounds(screen->view, x0 - off, y0 - off, x1 + off, y1 + off);
  b->x0 = o.x0 > b->x0 ? o.x0 : b->x0;
  b->y0 = o.y0 > b->y0 ? o.y0 : b->y0;
  b->x1 = o.x1 < b->x1 ? o.x1 : b->x1;
  b->y1 = o.y1 < b->y1 ? o.y1 : b->y1;
}

/* Whether the bounds of a face's vertices, which are safe, reach into the
 * window. */
static bool reaches_window(const struct hsr_screen *screen, uint32_t f) {
  const struct hsr_world *world = screen->world;
  const struct hsr_window *w = &screen->view->window;
  const double left = hsr_sample_x(screen->view, w->x0) - 0.5,
               top = hsr_sample_y(screen->view, w->y0) - 0.5;
  double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
    const uint32_t v = world->mesh.vertex[k];
    x0 = fmin(x0, screen->sx[v]);
    x1 = fmax(x1, screen->sx[v]);
    y0 = fmin(y0, screen->sy[v]);
    y1 = fmax(y1, screen->sy[v]);
  }
  return x1 >= left && x0 <= left + (w->x1 - w->x0) && y1 >= top &&
         y0 <= top + (w->y1 - w->y0);
}

static bool leave_out(enum hsr_cull why, struct hsr_tally *tally) {
  tally->culled[why]++;
  return false;
}

bool hsr_screen_place(struct hsr_screen *screen, uint32_t f,
                      struct hsr_tally *tally) {
  if (!hsr_face_exists(screen, f, tally))
    return leave_out(HSR_CULL_UNSEEN, tally);
  struct hsr_bounds *b = &screen->bounds[f];
  const struct hsr_view *view = screen->view;
  bool certain = screen->facing[f] != 0 || view->parallel;
  bool safe = vertex_bounds(screen, f, b);
  int beyond = safe && view->parallel ? vertices_beyond_near(screen, f) : 0;
  if (beyond < 0)
    return leave_out(HSR_CULL_OUTSIDE, tally);
  if (!safe) {
    const struct hsr_window *w = &view->window;
    *b = (struct hsr_bounds){w->x0, w->y0, w->x1, w->y1};
    if (certain && wholly_behind(screen, f))
      return leave_out(HSR_CULL_OUTSIDE, tally);
    if (certain)
      *b = clipped_bounds(screen, f);
  }
  if (screen->world->pieces)
    narrow_to_outline(screen, f, b);
  if (b->x0 >= b->x1 || b->y0 >= b->y1)
    return leave_out(safe && reaches_window(screen, f) ? HSR_CULL_BETWEEN
                                                       : HSR_CULL_OUTSIDE,
                     tally);
  /* A face whose facing is uncertain may still be whole: if it is flat and
   * before the eye, rays meet it before the eye. */
  bool ahead = certain || screen->world->mesh.deviation[f] == 0;
  bool clear = view->parallel
                   ? beyond > 0
                   : (ahead && view->near == 0) || clear_of_near(screen, f);
  screen->whole[f] = safe && !own_cuts(screen->world, f).n && clear;
  return true;
}

void hsr_screen_cull(struct hsr_screen *screen, struct hsr_tally *tally) {
  uint32_t n = 0;
  for (uint32_t f = 0; f < screen->world->n_faces; f++)
    if (hsr_screen_place(screen, f, tally))
      screen->relevant[n++] = f;
  screen->n_relevant = n;
}

enum hsr_status hsr_screen_make(struct hsr_screen *screen,
                                const struct hsr_world *world,
                                const struct hsr_view *view,
                                struct hsr_arena *arena,
                                struct hsr_tally *tally) {
  enum hsr_status status = hsr_screen_init(screen, world, view, arena);
  if (status)
    return status;
  hsr_screen_vertices(screen);
  hsr_screen_planes(screen);
  hsr_screen_cull(screen, tally);
  return HSR_OK;
}

/* --- The exact ends of the filters ---------------------------------------- */

static void vertex_point(const struct hsr_world *world, uint32_t v,
                         double p[3]) {
  p[0] = world->mesh.x[v];
  p[1] = world->mesh.y[v];
  p[2] = world->mesh.z[v];
}

bool hsr_nearer_exact(const struct hsr_screen *screen, uint32_t f, uint32_t g,
                      double sx, double sy, struct hsr_tally *tally) {
  tally->exact[HSR_ASK_DEPTH]++;
  return hsr_exact_nearer(screen->view, hsr_plane_loop(screen->world, f),
                          hsr_plane_loop(screen->world, g), sx, sy,
                          &tally->out_of_memory) > 0;
}

int hsr_vertex_nearer_exact(const struct hsr_screen *screen, uint32_t f,
                            uint32_t g, uint32_t v, struct hsr_tally *tally) {
  /* Faces that share a vertex meet there. */
  if (hsr_on_plane(screen->world, f, v) && hsr_on_plane(screen->world, g, v))
    return 0;
  double p[3];
  vertex_point(screen->world, v, p);
  struct hsr_loop loop_f = hsr_plane_loop(screen->world, f);
  struct hsr_loop loop_g = hsr_plane_loop(screen->world, g);
  bool *out_of_memory = &tally->out_of_memory;
  tally->exact[HSR_ASK_VERTEX]++;
  /* Mostly the faces touch and the vertex lies in both planes: a quick test. */
  if (!hsr_exact_plane_side(loop_g, p, out_of_memory) &&
      !hsr_exact_plane_side(loop_f, p, out_of_memory))
    return 0;
  return hsr_exact_nearer_towards(screen->view, loop_f, loop_g, p,
                                  out_of_memory);
}

/* The sign of a number whose value is within `error` of the true one; 0 if that
 * leaves it open. */
static int certain_sign(double value, double error) {
  return (value > error) - (value < -error);
}

static int homogeneous_row(const struct hsr_view *view, const double p[3],
                           double sy) {
  double a[3], error[3] = {0, 0, 0};
  homogeneous_of(view, p, a, error);
  return certain_sign(a[1] - sy * a[2], 3 * (error[1] + fabs(sy) * error[2]));
}

/* det(A, B, (sx, sy, 1)) along a row, as sx across + rest, and the errors of
 * both. */
struct row_edge {
  double across, rest, across_error, rest_error;
};

static struct row_edge row_edge_between(const struct hsr_view *view,
                                        const double p[3], const double q[3],
                                        double sy) {
  double a[3], b[3], e[3] = {0, 0, 0}, f[3] = {0, 0, 0};
  homogeneous_of(view, p, a, e);
  homogeneous_of(view, q, b, f);
  if (!within_range(e) || !within_range(f))
    return (struct row_edge){0, 0, INFINITY, INFINITY};
  return (struct row_edge){
      a[1] * b[2] - a[2] * b[1],
      sy * (a[2] * b[0] - a[0] * b[2]) + (a[0] * b[1] - a[1] * b[0]),
      (e[1] * f[2] + e[2] * f[1]) / U,
      (fabs(sy) * (e[2] * f[0] + e[0] * f[2]) + (e[0] * f[1] + e[1] * f[0])) /
          U};
}

static struct row_edge row_edge(const struct hsr_screen *screen, uint32_t a,
                                uint32_t b, double sy) {
  double p[3], q[3];
  vertex_point(screen->world, a, p);
  vertex_point(screen->world, b, q);
  return row_edge_between(screen->view, p, q, sy);
}

static inline int row_edge_side(const struct row_edge *edge, double sx) {
  return certain_sign(sx * edge->across + edge->rest,
                      fabs(sx) * edge->across_error + edge->rest_error + TINY);
}

int hsr_edge_side_exact(const struct hsr_screen *screen, uint32_t a, uint32_t b,
                        int i, int j, struct hsr_tally *tally) {
  double p[3], q[3];
  vertex_point(screen->world, a, p);
  vertex_point(screen->world, b, q);
  double sx = hsr_sample_x(screen->view, i), sy = hsr_sample_y(screen->view, j);
  struct row_edge edge = row_edge(screen, a, b, sy);
  int sign = row_edge_side(&edge, sx);
  if (sign)
    return sign;
  tally->exact[HSR_ASK_EDGE]++;
  return hsr_exact_edge_side(screen->view, p, q, sx, sy, &tally->out_of_memory);
}

int hsr_row_side_exact(const struct hsr_screen *screen, uint32_t v, int j,
                       struct hsr_tally *tally) {
  double p[3];
  vertex_point(screen->world, v, p);
  double sy = hsr_sample_y(screen->view, j);
  int sign = homogeneous_row(screen->view, p, sy);
  if (sign)
    return sign;
  tally->exact[HSR_ASK_ROW]++;
  return hsr_exact_row_side(screen->view, p, sy, &tally->out_of_memory);
}

/* Whether t > near on the plane of face f at sample (i, j). */
static bool beyond_near(const struct hsr_screen *screen, uint32_t f, int i,
                        int j, struct hsr_tally *tally) {
  const struct hsr_view *view = screen->view;
  int side =
      beyond_near_by(view, hsr_depth(screen, f, i, j), screen->plane[f].error);
  if (side)
    return side > 0;
  tally->exact[HSR_ASK_NEAR]++;
  struct hsr_loop loop = hsr_plane_loop(screen->world, f);
  double sx = hsr_sample_x(view, i), sy = hsr_sample_y(view, j);
  return hsr_exact_ahead(view, loop, sx, sy, &tally->out_of_memory) > 0 &&
         hsr_exact_past_near(view, loop, sx, sy, &tally->out_of_memory) > 0;
}

/* --- Cuts ----------------------------------------------------------------- */

int hsr_cut_side(const struct hsr_screen *screen, uint32_t f, uint32_t g, int i,
                 int j, struct hsr_tally *tally) {
  double bound = screen->plane[f].error + screen->plane[g].error;
  double by = hsr_depth(screen, f, i, j) - hsr_depth(screen, g, i, j);
  if (fabs(by) > bound && screen->facing[g])
    return by > 0 ? screen->facing[g] : -screen->facing[g];
  const struct hsr_view *view = screen->view;
  tally->exact[HSR_ASK_CUT]++;
  return hsr_exact_cut_side(
      view, hsr_plane_loop(screen->world, f), hsr_plane_loop(screen->world, g),
      hsr_sample_x(view, i), hsr_sample_y(view, j), &tally->out_of_memory);
}

static bool within_cuts(const struct hsr_screen *screen, uint32_t f,
                        struct cuts cuts, int i, int j,
                        struct hsr_tally *tally) {
  for (size_t k = 0; k < cuts.n; k++)
    if (hsr_cut_side(screen, f, cuts.cut[k].face, i, j, tally) !=
        cuts.cut[k].side)
      return false;
  return true;
}

/* --- Surround test and sample spans --------------------------------------- */

/* The edge from a to b crosses row j; a is on side `row` of it. Whether it
 * crosses to the right of sample (i, j). An edge in line with the eye crosses
 * nothing. */
static bool crosses_right(const struct hsr_screen *screen, uint32_t a,
                          uint32_t b, int row, int i, int j,
                          struct hsr_tally *tally) {
  return hsr_edge_side(screen, a, b, i, j, tally) == -row;
}

/* The paper's surround test: it counts crossings of a half line. */
bool hsr_covers(const struct hsr_screen *screen, uint32_t f, int i, int j,
                struct hsr_tally *tally) {
  const struct hsr_world *world = screen->world;
  const uint32_t *vertex = world->mesh.vertex + world->mesh.start[f];
  uint32_t n = hsr_face_size(world, f), a = vertex[n - 1];
  int row_a = hsr_row_side(screen, a, j, tally);
  bool inside = false;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t b = vertex[k];
    int row_b = hsr_row_side(screen, b, j, tally);
    if (row_a != row_b)
      inside ^= crosses_right(screen, a, b, row_a, i, j, tally);
    a = b;
    row_a = row_b;
  }
  if (!inside || screen->whole[f])
    return inside;
  return beyond_near(screen, f, i, j, tally) &&
         within_cuts(screen, f, own_cuts(screen->world, f), i, j, tally);
}

bool hsr_piece_covers(const struct hsr_screen *screen, uint32_t f,
                      const struct hsr_cut *cut, size_t n, int i, int j,
                      struct hsr_tally *tally) {
  return hsr_covers(screen, f, i, j, tally) &&
         within_cuts(screen, f, (struct cuts){cut, n}, i, j, tally);
}

/* --- Polygons that are in no screen --------------------------------------- */

int hsr_loop_edge_side(const struct hsr_view *view, const double a[3],
                       const double b[3], double sx, double sy,
                       struct hsr_tally *tally) {
  struct row_edge edge = row_edge_between(view, a, b, sy);
  int sign = row_edge_side(&edge, sx);
  if (sign)
    return sign;
  tally->exact[HSR_ASK_EDGE]++;
  return hsr_exact_edge_side(view, a, b, sx, sy, &tally->out_of_memory);
}

int hsr_loop_cut_side(const struct hsr_view *view, struct hsr_loop f,
                      struct hsr_loop g, double sx, double sy,
                      struct hsr_tally *tally) {
  tally->exact[HSR_ASK_CUT]++;
  return hsr_exact_cut_side(view, f, g, sx, sy, &tally->out_of_memory);
}

bool hsr_loop_past_near(const struct hsr_view *view, struct hsr_loop plane,
                        double sx, double sy, struct hsr_tally *tally) {
  tally->exact[HSR_ASK_NEAR]++;
  return hsr_exact_past_near(view, plane, sx, sy, &tally->out_of_memory) > 0;
}

bool hsr_loop_beyond_near(const struct hsr_view *view, struct hsr_loop plane,
                          double sx, double sy, struct hsr_tally *tally) {
  return hsr_loop_past_near(view, plane, sx, sy, tally) &&
         hsr_exact_ahead(view, plane, sx, sy, &tally->out_of_memory) > 0;
}

static void corner_of(struct hsr_loop polygon, uint32_t k, double p[3]) {
  size_t at = polygon.stride * polygon.vertex[k];
  p[0] = polygon.x[at];
  p[1] = polygon.y[at];
  p[2] = polygon.z[at];
}

static int row_side(const struct hsr_view *view, const double p[3], double sy,
                    struct hsr_tally *tally) {
  int sign = homogeneous_row(view, p, sy);
  if (sign)
    return sign;
  tally->exact[HSR_ASK_ROW]++;
  return hsr_exact_row_side(view, p, sy, &tally->out_of_memory);
}

bool hsr_loop_surrounds(const struct hsr_view *view, struct hsr_loop polygon,
                        double sx, double sy, struct hsr_tally *tally) {
  double a[3], b[3];
  bool inside = false;
  corner_of(polygon, polygon.n - 1, a);
  int row_a = row_side(view, a, sy, tally);
  for (uint32_t k = 0; k < polygon.n; k++) {
    corner_of(polygon, k, b);
    int row_b = row_side(view, b, sy, tally);
    if (row_a != row_b)
      inside ^= hsr_loop_edge_side(view, a, b, sx, sy, tally) == -row_a;
    memcpy(a, b, sizeof a);
    row_a = row_b;
  }
  return inside;
}

/* --- Rows and columns ----------------------------------------------------- */

/* The first row at or below sy, where the error of sy leaves no doubt; else
 * HSR_ROW_UNKNOWN. */
static inline int first_row(double sy, double first, int n) {
  double row = hsr_within(sy - first, n);
  int next = hsr_round_up(row);
  int certain = (next - row > HSR_DELTA) & (row - next + 1 > HSR_DELTA);
  return certain ? next : HSR_ROW_UNKNOWN;
}

int hsr_vertex_row(const struct hsr_screen *screen, uint32_t v,
                   struct hsr_tally *tally) {
  double first = hsr_sample_y(screen->view, 0);
  int row = first_row(screen->sy[v], first, screen->view->n);
  if (row != HSR_ROW_UNKNOWN)
    return row;
  /* Only the line of the nearest row may pass through the vertex. */
  int j = (int)nearbyint(hsr_within(screen->sy[v] - first, screen->view->n));
  return hsr_row_side_exact(screen, v, j, tally) < 0 ? j : j + 1;
}

HSR_VECTOR static void first_rows(size_t count, const double *restrict sy,
                                  double first, int n, int *restrict row) {
  for (size_t v = 0; v < count; v++)
    row[v] = first_row(sy[v], first, n);
}

void hsr_vertex_rows(const struct hsr_screen *screen, int *row) {
  first_rows(screen->world->mesh.n_vertices, screen->sy,
             hsr_sample_y(screen->view, 0), screen->view->n, row);
}

void hsr_edge_init(struct hsr_edge *edge, const struct hsr_screen *screen,
                   uint32_t a, uint32_t b) {
  double dx = screen->sx[b] - screen->sx[a];
  double dy = screen->sy[b] - screen->sy[a];
  edge->a = a;
  edge->b = b;
  edge->slope = 0;
  edge->x = screen->sx[a];
  edge->tolerance = INFINITY;
  if (dy >= 16 * HSR_DELTA) {
    edge->slope = dx / dy;
    edge->x = screen->sx[a] - edge->slope * screen->sy[a];
    edge->tolerance = 4 * HSR_DELTA * (1 + fabs(edge->slope));
  }
}

int hsr_edge_column_exact(const struct hsr_screen *screen,
                          const struct hsr_edge *edge, int j,
                          struct hsr_tally *tally) {
  /* Samples left of lo are left of the edge, those from hi on are not. */
  int lo = 0, hi = screen->view->m;
  if (edge->tolerance < 0.25) {
    double x = edge->x + edge->slope * hsr_sample_y(screen->view, j);
    lo = (int)nearbyint(x - hsr_sample_x(screen->view, 0));
    hi = lo + 1;
  }
  while (lo < hi) {
    int middle = lo + (hi - lo) / 2;
    if (hsr_edge_side(screen, edge->a, edge->b, middle, j, tally) > 0)
      lo = middle + 1;
    else
      hi = middle;
  }
  return lo;
}

/* As hsr_edge_column, but -1 if the tolerance leaves a doubt. */
HSR_VECTOR static void columns_of(const struct hsr_edge *edge, uint32_t n,
                                  double sx, double sy, int m, int *column) {
  for (uint32_t k = 0; k < n; k++) {
    double at = hsr_within(edge[k].x + edge[k].slope * sy - sx, m);
    int next = hsr_round_up(at);
    double low = at - next + 1, high = next - at;
    double nearest = low < high ? low : high;
    column[k] = nearest > edge[k].tolerance ? next : -1;
  }
}

void hsr_edge_columns(const struct hsr_screen *screen,
                      const struct hsr_edge *edge, uint32_t n, int j,
                      int *column, struct hsr_tally *tally) {
  columns_of(edge, n, hsr_sample_x(screen->view, 0),
             hsr_sample_y(screen->view, j), screen->view->m, column);
  for (uint32_t k = 0; k < n; k++)
    if (column[k] < 0)
      column[k] = hsr_edge_column_exact(screen, &edge[k], j, tally);
}

static int compare_columns(const void *a, const void *b) {
  int p = *(const int *)a, q = *(const int *)b;
  return (p > q) - (p < q);
}

/* Sorts columns. Usually there are two. */
static void sort_columns(int *columns, int n) {
  if (n > 32) {
    qsort(columns, (size_t)n, sizeof *columns, compare_columns);
    return;
  }
  for (int k = 1; k < n; k++) {
    int column = columns[k], at = k;
    for (; at && columns[at - 1] > column; at--)
      columns[at] = columns[at - 1];
    columns[at] = column;
  }
}

/* The columns where a whole face's edges cross row j, ascending. */
static int whole_spans(const struct hsr_screen *screen, uint32_t f, int j,
                       int *columns, struct hsr_tally *tally) {
  const struct hsr_world *world = screen->world;
  const uint32_t *vertex = world->mesh.vertex + world->mesh.start[f];
  uint32_t n = hsr_face_size(world, f), a = vertex[n - 1];
  int row_a = hsr_row_side(screen, a, j, tally), n_columns = 0;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t b = vertex[k];
    int row_b = hsr_row_side(screen, b, j, tally);
    if (row_a != row_b) {
      struct hsr_edge edge;
      hsr_edge_init(&edge, screen, row_a < 0 ? a : b, row_a < 0 ? b : a);
      columns[n_columns++] = hsr_edge_column(screen, &edge, j, tally);
    }
    a = b;
    row_a = row_b;
  }
  sort_columns(columns, n_columns);
  return n_columns;
}

/* A question whose answer holds(column) changes at most once along row j. `row`
 * is the side of row j that a is on, or the side of a cut. */
struct question {
  const struct hsr_screen *screen;
  struct hsr_tally *tally;
  uint32_t a, b, face; /* an edge and a face; or a cutting face a */
  int row, j;
  bool (*holds)(const struct question *question, int i);
};

static bool ask_crosses(const struct question *q, int i) {
  return crosses_right(q->screen, q->a, q->b, q->row, i, q->j, q->tally);
}

static bool ask_ahead(const struct question *q, int i) {
  const struct hsr_screen *screen = q->screen;
  double depth = hsr_depth(screen, q->face, i, q->j);
  if (fabs(depth) > screen->plane[q->face].error)
    return depth > 0;
  q->tally->exact[HSR_ASK_NEAR]++;
  return hsr_exact_ahead(screen->view, hsr_plane_loop(screen->world, q->face),
                         hsr_sample_x(screen->view, i),
                         hsr_sample_y(screen->view, q->j),
                         &q->tally->out_of_memory) > 0;
}

static bool ask_past_near(const struct question *q, int i) {
  const struct hsr_screen *screen = q->screen;
  double depth = hsr_depth(screen, q->face, i, q->j);
  double near = screen->view->near, error = screen->plane[q->face].error;
  double by = 1 - near * depth;
  double bound = 2 * near * error + 8 * U * (1 + near * fabs(depth));
  if (screen->view->parallel) {
    by = -near - depth;
    bound = 2 * error + 8 * U * (near + fabs(depth));
  }
  if (fabs(by) > bound)
    return by > 0;
  q->tally->exact[HSR_ASK_NEAR]++;
  return hsr_exact_past_near(
             screen->view, hsr_plane_loop(screen->world, q->face),
             hsr_sample_x(screen->view, i), hsr_sample_y(screen->view, q->j),
             &q->tally->out_of_memory) > 0;
}

/* The first column in (lo, hi] where the answer differs from at_lo, the answer
 * at lo. It differs at hi. */
static int change(const struct question *q, bool at_lo, int lo, int hi) {
  while (hi - lo > 1) { /* the answer is at_lo at lo, but not at hi */
    int middle = lo + (hi - lo) / 2;
    if (q->holds(q, middle) == at_lo)
      lo = middle;
    else
      hi = middle;
  }
  return hi;
}

/* Narrows the columns [*lo, *hi) to those where the answer is yes. */
static void narrow(const struct question *q, int *lo, int *hi) {
  if (*lo >= *hi)
    return;
  bool first = q->holds(q, *lo), last = q->holds(q, *hi - 1);
  if (!first && !last)
    *hi = *lo;
  else if (!first)
    *lo = change(q, false, *lo, *hi - 1);
  else if (!last)
    *hi = change(q, true, *lo, *hi - 1);
}

/* For some columns: whether an edge crosses to the right of the first one and
 * of the last one, and the column where that changes, if it does. */
struct crossing {
  bool first, last;
  int column;
};

/* A guess of the column near which an edge crosses the row, wherever its ends
 * are. If rounding leaves it open, it is any number. */
static int guess_column(const struct question *q, const struct row_edge *edge) {
  double column =
      ceil(-edge->rest / edge->across - hsr_sample_x(q->screen->view, 0));
  return fabs(column) < HSR_GUARD ? (int)column : 0;
}

/* ask_crosses, with a filter before it. */
static bool crosses_at(const struct question *q, const struct row_edge *edge,
                       int i) {
  int side = row_edge_side(edge, hsr_sample_x(q->screen->view, i));
  return side ? side == -q->row : q->holds(q, i);
}

static struct crossing find_crossing(const struct question *q, int lo, int hi) {
  const struct hsr_screen *screen = q->screen;
  if (screen->sx[q->a] == screen->sx[q->a] &&
      screen->sx[q->b] == screen->sx[q->b]) {
    struct hsr_edge edge;
    hsr_edge_init(&edge, screen, q->row < 0 ? q->a : q->b,
                  q->row < 0 ? q->b : q->a);
    int column = hsr_edge_column(screen, &edge, q->j, q->tally);
    return (struct crossing){column > lo, column >= hi, column};
  }
  struct row_edge edge =
      row_edge(screen, q->a, q->b, hsr_sample_y(screen->view, q->j));
  bool first = crosses_at(q, &edge, lo), last = crosses_at(q, &edge, hi - 1);
  if (first == last)
    return (struct crossing){first, last, hi};
  int guess = guess_column(q, &edge);
  if (guess > lo && guess < hi - 1) { /* mostly it is right */
    if (crosses_at(q, &edge, guess) == first)
      lo = guess;
    else
      hi = guess + 1;
    if (lo < guess && crosses_at(q, &edge, guess - 1) == first)
      lo = guess - 1;
    else if (lo == guess && guess + 2 < hi &&
             crosses_at(q, &edge, guess + 1) != first)
      hi = guess + 2;
  }
  return (struct crossing){first, last, change(q, first, lo, hi - 1)};
}

/* The columns of a cut face. First the row is narrowed to where the plane is
 * ahead of the eye and past near. There the parity of the edges that cross to
 * the right tells what is covered; whether one edge does changes at most once
 * along the row. */
static int cut_spans(const struct hsr_screen *screen, uint32_t f, int j,
                     int *columns, struct hsr_tally *tally) {
  const struct hsr_world *world = screen->world;
  struct question q = {.screen = screen, .tally = tally, .face = f, .j = j};
  int lo = 0, hi = screen->view->m;
  if (!screen->view->parallel) {
    q.holds = ask_ahead;
    narrow(&q, &lo, &hi);
  }
  if (screen->view->near > 0 || screen->view->parallel) {
    q.holds = ask_past_near;
    narrow(&q, &lo, &hi);
  }
  if (lo == hi)
    return 0;

  const uint32_t *vertex = world->mesh.vertex + world->mesh.start[f];
  uint32_t n = hsr_face_size(world, f);
  int n_columns = 0;
  bool inside = false;
  q.holds = ask_crosses;
  q.a = vertex[n - 1];
  q.row = hsr_row_side(screen, q.a, j, tally);
  for (uint32_t k = 0; k < n; k++) {
    q.b = vertex[k];
    int row_b = hsr_row_side(screen, q.b, j, tally);
    if (q.row != row_b) {
      struct crossing crossing = find_crossing(&q, lo, hi);
      inside ^= crossing.first;
      if (crossing.first != crossing.last)
        columns[n_columns++] = crossing.column;
    }
    q.a = q.b;
    q.row = row_b;
  }
  if (inside)
    columns[n_columns++] = lo;
  if (n_columns & 1)
    columns[n_columns++] = hi;
  sort_columns(columns, n_columns);
  return n_columns;
}

static bool ask_side(const struct question *q, int i) {
  return hsr_cut_side(q->screen, q->face, q->a, i, q->j, q->tally) == q->row;
}

/* Narrows each span to the part that the cuts leave. Returns how many columns
 * are left. */
static int narrow_by_cuts(const struct hsr_screen *screen, uint32_t f,
                          struct cuts cuts, int j, int *columns, int n,
                          struct hsr_tally *tally) {
  struct question q = {
      .screen = screen, .tally = tally, .face = f, .j = j, .holds = ask_side};
  int kept = 0;
  for (int k = 0; k < n; k += 2) {
    int lo = columns[k], hi = columns[k + 1];
    for (size_t c = 0; c < cuts.n && lo < hi; c++) {
      q.a = cuts.cut[c].face;
      q.row = cuts.cut[c].side;
      narrow(&q, &lo, &hi);
    }
    if (lo < hi) {
      columns[kept++] = lo;
      columns[kept++] = hi;
    }
  }
  return kept;
}

int hsr_face_spans(const struct hsr_screen *screen, uint32_t f, int j,
                   int *columns, struct hsr_tally *tally) {
  if (screen->whole[f])
    return whole_spans(screen, f, j, columns, tally);
  int n = cut_spans(screen, f, j, columns, tally);
  return narrow_by_cuts(screen, f, own_cuts(screen->world, f), j, columns, n,
                        tally);
}

/* An edge of a whole face crosses the rows between those of its vertices. */
void hsr_face_rows_begin(struct hsr_face_rows *rows,
                         const struct hsr_screen *screen, uint32_t f,
                         struct hsr_tally *tally) {
  const struct hsr_world *world = screen->world;
  const uint32_t *vertex = world->mesh.vertex + world->mesh.start[f];
  uint32_t n = hsr_face_size(world, f), a = vertex[n - 1];
  rows->screen = screen;
  rows->face = f;
  rows->n = 0;
  if (!screen->whole[f] || n > HSR_MOST_ROW_EDGES)
    return;
  int row_a = hsr_vertex_row(screen, a, tally);
  for (uint32_t k = 0; k < n; k++) {
    uint32_t b = vertex[k];
    int row_b = hsr_vertex_row(screen, b, tally);
    if (row_a != row_b) {
      struct hsr_row_edge *e = &rows->edge[rows->n++];
      bool down = row_a < row_b;
      e->begin = down ? row_a : row_b;
      e->end = down ? row_b : row_a;
      hsr_edge_init(&e->line, screen, down ? a : b, down ? b : a);
    }
    a = b;
    row_a = row_b;
  }
}

int hsr_face_rows_spans(const struct hsr_face_rows *rows, int j, int *columns,
                        struct hsr_tally *tally) {
  if (!rows->n)
    return hsr_face_spans(rows->screen, rows->face, j, columns, tally);
  const struct hsr_row row = hsr_row_of(rows->screen->view, j);
  int n_columns = 0;
  for (int k = 0; k < rows->n; k++) {
    const struct hsr_row_edge *e = &rows->edge[k];
    if (e->begin <= j && j < e->end)
      columns[n_columns++] =
          hsr_edge_column_on(rows->screen, &e->line, j, &row, tally);
  }
  sort_columns(columns, n_columns);
  return n_columns;
}

int hsr_piece_spans(const struct hsr_screen *screen, uint32_t f,
                    const struct hsr_cut *cut, size_t n, int j, int *columns,
                    struct hsr_tally *tally) {
  int n_columns = hsr_face_spans(screen, f, j, columns, tally);
  return narrow_by_cuts(screen, f, (struct cuts){cut, n}, j, columns, n_columns,
                        tally);
}

int hsr_piece_rows_spans(const struct hsr_face_rows *rows,
                         const struct hsr_cut *cut, size_t n, int j,
                         int *columns, struct hsr_tally *tally) {
  int n_columns = hsr_face_rows_spans(rows, j, columns, tally);
  return narrow_by_cuts(rows->screen, rows->face, (struct cuts){cut, n}, j,
                        columns, n_columns, tally);
}
