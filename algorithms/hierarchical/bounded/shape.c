/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notation    u = 2^-53; |v| the sum of the sizes of the components of v; A the
 *             end of an edge that is nearer to the eye, B the other one; A' = A
 *             - E and G = B - A, rounded: each component is within u of itself
 *
 * Lines. det(A - E, B - E, D) is (A - E) x (B - A) . D, and the same with A and
 * B exchanged. N = A' x G has components of two products each: with the errors
 * of A' and G they are within 4u |A'| |G|. A coefficient N . ray has three
 * products with rays that are within 2u of themselves: it is within 8u |A'| |G|
 * |ray|, since |N| <= |A'| |G|. The three products and two sums of a sx + b sy
 * + c add as much, so that all of it is within 32u |A'| |G| reach, where
 * `reach`, the sum of screen->reach, bounds |D|. LINE_ERROR is 128u. In
 * parallel M = G x F and e = (A'
 * - r) . M with r = P - E: the same holds with |A'| + reach for |A'|, and with
 *   |F| <= 2 for |D|. TINY covers what underflows.
 *
 * Cuts. Let plane N, P cut a polygon on plane M, A, and h = N . (E - P), g = M .
 * (A - E). The polygon's point on the ray is E + t D with t = g / M . D, and N . (E
 * + t D - P) has the sign of (h M + g N) . D, turned if g < 0, for t > 0. No
 * division is made: the line is good even where the eye is almost in a plane. The
 * rounded h is within H = 2 (n |E - P| + p |N|) + 2^-49 |N| |E - P| of itself, with
 * the errors n of N and p of P (common/exact/order.c); and g within G likewise,
 * with m for M. With the errors of products of these, e is within (H |M| + |h| m +
 * G |N| + |g| n) reach, and of rounding 32u (|h| |M| + |g| |N|) reach, of itself.
 * The bound is twice the first, where |M| and |N| are those of the true normals,
 * and 256u. In parallel, with f = N . F and k = M . F, the sign is that of k h + f g
 * + (k N - f M) . D, turned if k < 0. f is within 2 n + 2^-48 |N| of itself.
 *
 * Near. q's rounding is bounded for all of the picture. Where the eye is almost in
 * a plane q is huge in most of it, and that bound says nothing where q is 0 or
 * 1/near. Without a division, t > near is that -(h + near N . D), with h = N . (E
 * - P), has the sign of -h; t > 0 that -h N . D is positive; and in parallel t >
 * near that -(h + N . ray) - near k has the sign of k = N . F. N, h and k are
 * exact (cut.cc), and only what is left of them is rounded.
 *
 * On a square of the picture |e - e(middle)| <= (|a| + |b|) half. The rounding
 * of that, and of the sums with it, is below 8u (|a| m + |b| n + |c|). Each of
 * these three is at most |A'| |G| reach, so they are in the 128u too.
 *
 * Shares. In coordinates where the square is [-1, 1]^2, a line is displaced by
 * at most d = error / |gradient|, and what is on its positive side changes by
 * at most d times the length of its part in the square, which is at most 2 sqrt
 * 2. Of the area of 4 that is less than d. A corner that a cut makes is within
 * 2^-49 of the line through its neighbours, as the quotient that places it lies
 * between 0 and 1; 2^-48 a cut, and 2^-46 for the sum of the area, cover that.
 */
#include "algorithms/hierarchical/bounded/shape.h"
#include "common/exact/order.h"

#include <string.h>

#define LINE_ERROR 0x1p-46
#define TINY 0x1p-960

/* Triangles of a fan that are left out of a square together. */
enum { BLOCK = 32 };

static double size_of(const double v[3]) {
  return fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
}

static void cross(const double a[3], const double b[3], double c[3]) {
  for (int k = 0; k < 3; k++) {
    int l = (k + 1) % 3, m = (k + 2) % 3;
    c[k] = a[l] * b[m] - a[m] * b[l];
  }
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* --- Lines ---------------------------------------------------------------- */

/* What an edge and the eye have to do with one another: from the eye to its
 * nearer end, and along it. */
static void see_edge(const struct hsr_view *view, const double a[3],
                     const double b[3], double from[3], double along[3]) {
  double to[3];
  for (int k = 0; k < 3; k++) {
    from[k] = a[k] - view->E[k];
    to[k] = b[k] - view->E[k];
    along[k] = b[k] - a[k];
  }
  if (size_of(to) < size_of(from))
    memcpy(from, to, sizeof to);
}

static struct hsr_screen_line edge_line(const struct hsr_screen *screen,
                                        const double a[3], const double b[3]) {
  const struct hsr_view *view = screen->view;
  const double *reach = screen->reach;
  double from[3], along[3], normal[3], far = reach[0] + reach[1] + reach[2];
  see_edge(view, a, b, from, along);
  if (view->parallel) {
    cross(along, view->F, normal);
    return (struct hsr_screen_line){
        -dot(view->ray[1], normal), -dot(view->ray[2], normal),
        dot(from, normal) - dot(view->ray[0], normal),
        2 * LINE_ERROR * size_of(along) * (size_of(from) + far) + TINY};
  }
  cross(from, along, normal);
  return (struct hsr_screen_line){
      dot(view->ray[1], normal), dot(view->ray[2], normal),
      dot(view->ray[0], normal),
      LINE_ERROR * size_of(along) * size_of(from) * far + TINY};
}

static struct hsr_screen_line opposite(struct hsr_screen_line line) {
  return (struct hsr_screen_line){-line.a, -line.b, -line.c, line.error};
}

/* det(A - E, B - E, C - E), or with F in parallel: positive, 1, if it is
 * certain that C lies on the positive side of the edge from A to B. */
static int side_of_edge(const struct hsr_screen *screen, const double a[3],
                        const double b[3], const double c[3]) {
  const struct hsr_view *view = screen->view;
  double from[3], along[3], to[3], normal[3];
  see_edge(view, a, b, from, along);
  for (int k = 0; k < 3; k++)
    to[k] = c[k] - a[k];
  double e, size;
  if (view->parallel) {
    cross(along, view->F, normal);
    e = -dot(to, normal);
    size = 2 * size_of(along) * size_of(to);
  } else {
    cross(from, along, normal);
    e = dot(to, normal);
    size = size_of(from) * size_of(along) * size_of(to);
  }
  double error = LINE_ERROR * size + TINY;
  return e > error ? 1 : e < -error ? -1 : 0;
}

/* --- Making a shape ------------------------------------------------------- */

/* Is the polygon certainly convex, as it is seen: each corner on the inner side
 * of each edge? Triangles are, and one of more corners turns once around. */
static bool is_convex(const struct hsr_screen *screen,
                      const struct hsr_shape *shape, int inner) {
  uint32_t n = shape->n_corners;
  for (uint32_t l = 2; n > 3 && n <= HSR_MOST_CORNERS && l < n; l++)
    for (uint32_t k = 0; k < n; k++)
      if (side_of_edge(screen, shape->corner[k], shape->corner[(k + 1) % n],
                       shape->corner[(k + l) % n]) != inner)
        return false;
  return n <= HSR_MOST_CORNERS;
}

/* Are all its corners beyond `near`, and so before the eye? */
static bool is_beyond_near(const struct hsr_screen *screen,
                           const struct hsr_shape *shape) {
  const struct hsr_view *view = screen->view;
  for (uint32_t k = 0; k < shape->n_corners; k++) {
    double from[3], size = 0;
    for (int c = 0; c < 3; c++) {
      from[c] = shape->corner[k][c] - view->E[c];
      size += fabs(from[c] * view->depth[c]);
    }
    if (!(dot(from, view->depth) > view->near * (1 + 0x1p-40) + 0x1p-46 * size))
      return false;
  }
  return true;
}

static struct hsr_screen_line line_of(const struct hsr_screen *screen,
                                      const double normal[3], double rest,
                                      double error) {
  const struct hsr_view *view = screen->view;
  return (struct hsr_screen_line){dot(view->ray[1], normal),
                                  dot(view->ray[2], normal),
                                  dot(view->ray[0], normal) + rest, error};
}

/* The same of a normal and a rest that are within 2^-50 of themselves. */
static struct hsr_screen_line exact_line(const struct hsr_screen *screen,
                                         const double normal[3], double rest) {
  const double *reach = screen->reach;
  double size = size_of(normal) * (reach[0] + reach[1] + reach[2]);
  return line_of(screen, normal, rest, 0x1p-45 * (size + fabs(rest)) + TINY);
}

/* May the line be in the picture, and is its place less certain than 2^-20
 * pixels? */
static bool is_vague(const struct hsr_view *view,
                     const struct hsr_screen_line *line) {
  double steep = fabs(line->a) + fabs(line->b);
  return !(line->error < 0x1p-20 * steep) &&
         !(fabs(line->c) >
           line->error + fabs(line->a) * view->m + fabs(line->b) * view->n);
}

/* One of the two below. */
static struct hsr_screen_line near_line(const struct hsr_screen *screen,
                                        uint32_t f, struct hsr_screen_line line,
                                        bool at_eye) {
  double normal[3], rest;
  if (!is_vague(screen->view, &line))
    return line;
  hsr_near_exactly(screen, f, at_eye, normal, &rest);
  struct hsr_screen_line exact = exact_line(screen, normal, rest);
  return exact.error < INFINITY ? exact : line;
}

/* Where t > near: 0 < q < 1/near or, in parallel, q < -near. */
static uint32_t near_lines(const struct hsr_screen *screen, uint32_t f,
                           const struct hsr_screen_line *q,
                           struct hsr_screen_line *line) {
  const struct hsr_view *view = screen->view;
  uint32_t n = 0;
  if (!view->parallel)
    line[n++] = near_line(screen, f, *q, true);
  if (view->parallel || view->near > 0) {
    double most = view->parallel ? -view->near : 1 / view->near;
    struct hsr_screen_line end = opposite(*q);
    end.c += most;
    end.error += 0x1p-50 * (fabs(most) + fabs(q->c));
    line[n++] = near_line(screen, f, end, false);
  }
  return n;
}

/* A plane that is as far as `near` all over the picture is beyond it or is not:
 * the line, which could not tell, becomes one that is positive or negative
 * everywhere. */
static void decide_near(struct hsr_screen_line *line,
                        const struct hsr_screen *screen, uint32_t f,
                        struct hsr_tally *tally) {
  const struct hsr_view *view = screen->view;
  double reach = fabs(line->a) * view->m + fabs(line->b) * view->n;
  if (!(reach <= line->error && fabs(line->c) <= 2 * line->error))
    return;
  struct hsr_loop plane = hsr_plane_loop(screen->world, f);
  int past = 0;
  for (int k = 0; k < 4; k++)
    past += hsr_loop_past_near(view, plane, k & 1 ? view->m : 0,
                               k & 2 ? view->n : 0, tally);
  if (past % 4 == 0)
    *line = (struct hsr_screen_line){0, 0, past ? 1 : -1, 0};
}

/* Where the corners are on the screen, if all are safely before the eye. */
static void find_box(struct hsr_shape *shape, const struct hsr_screen *screen,
                     uint32_t f) {
  const struct hsr_mesh *mesh = &screen->world->mesh;
  double x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
  bool known = true;
  for (uint32_t k = mesh->start[f]; known && k < mesh->start[f + 1]; k++) {
    double x = screen->sx[mesh->vertex[k]], y = screen->sy[mesh->vertex[k]];
    known = x == x && y == y;
    x0 = fmin(x0, x), x1 = fmax(x1, x), y0 = fmin(y0, y), y1 = fmax(y1, y);
  }
  double margin = known ? 2 * HSR_DELTA : INFINITY;
  shape->x0 = known ? x0 - margin : -INFINITY;
  shape->y0 = known ? y0 - margin : -INFINITY;
  shape->x1 = known ? x1 + margin : INFINITY;
  shape->y1 = known ? y1 + margin : INFINITY;
}

static bool copy_corners(struct hsr_shape *shape,
                         const struct hsr_screen *screen, uint32_t f,
                         struct hsr_arena *arena) {
  const struct hsr_mesh *mesh = &screen->world->mesh;
  uint32_t n = hsr_face_size(screen->world, f);
  double(*corner)[3] = hsr_arena_array(arena, n, sizeof *corner);
  for (uint32_t k = 0; corner && k < n; k++) {
    uint32_t v = mesh->vertex[mesh->start[f] + k];
    corner[k][0] = mesh->x[v];
    corner[k][1] = mesh->y[v];
    corner[k][2] = mesh->z[v];
  }
  shape->n_corners = n;
  shape->corner = (const double(*)[3])corner;
  return corner != NULL;
}

static uint64_t hash_of(const double point[3]) {
  uint64_t hash = 0, bits;
  for (int k = 0; k < 3; k++) {
    double x = point[k] + 0; /* of -0 and 0 the same */
    memcpy(&bits, &x, sizeof bits);
    hash = (hash ^ bits) * UINT64_C(0x9e3779b97f4a7c15);
    hash ^= hash >> 29;
  }
  return hash;
}

static bool number_edges(struct hsr_shape *shape, struct hsr_arena *arena) {
  uint32_t n = shape->n_corners;
  uint64_t *edge = HSR_NEW(arena, uint64_t, n);
  for (uint32_t k = 0; edge && k < n; k++)
    edge[k] = hash_of(shape->corner[k]) + hash_of(shape->corner[(k + 1) % n]);
  shape->edge = edge;
  return edge != NULL;
}

/* Those of the edges, positive within. */
static void convex_lines(struct hsr_shape *shape,
                         const struct hsr_screen *screen, int inner,
                         struct hsr_screen_line *line) {
  uint32_t n = shape->n_corners;
  for (uint32_t k = 0; k < n; k++) {
    line[k] = edge_line(screen, shape->corner[k], shape->corner[(k + 1) % n]);
    if (inner < 0)
      line[k] = opposite(line[k]);
  }
  shape->n_lines = n;
}

static void fan_lines(struct hsr_shape *shape, const struct hsr_screen *screen,
                      struct hsr_screen_line *line) {
  const double(*corner)[3] = shape->corner;
  uint32_t n = 0;
  for (uint32_t k = 1; k + 1 < shape->n_corners; k++) {
    line[n++] = edge_line(screen, corner[0], corner[k]);
    line[n++] = edge_line(screen, corner[k], corner[k + 1]);
    line[n++] = edge_line(screen, corner[k + 1], corner[0]);
  }
  shape->n_lines = n;
}

/* A side of the wedge of corners [from, to) of a fan: a line through the fan's
 * first corner and one of these, with all of these on its positive side. There
 * are two, which `side`, 1 or -1, tells apart. If no corner certainly gives one,
 * the line's error is infinite. A ray that meets a triangle of these corners is
 * on the positive side, since each point of a triangle is a mean of its corners.
 * If it meets the triangle behind the eye, it is on the negative side. */
static struct hsr_screen_line wedge_line(const struct hsr_screen *screen,
                                         const double (*corner)[3],
                                         uint32_t from, uint32_t to, int side) {
  uint32_t last = from;
  for (uint32_t k = from + 1; k < to; k++)
    if (side_of_edge(screen, corner[0], corner[last], corner[k]) == -side)
      last = k;
  for (uint32_t k = from; k < to; k++)
    if (k != last &&
        side_of_edge(screen, corner[0], corner[last], corner[k]) != side)
      return (struct hsr_screen_line){0, 0, 0, INFINITY};
  struct hsr_screen_line line = edge_line(screen, corner[0], corner[last]);
  return side > 0 ? line : opposite(line);
}

/* The wedges of a fan's blocks of triangles. */
static bool find_wedges(struct hsr_shape *shape,
                        const struct hsr_screen *screen,
                        struct hsr_arena *arena) {
  uint32_t n = shape->n_corners - 2, n_blocks = (n + BLOCK - 1) / BLOCK;
  struct hsr_screen_line *wedge =
      HSR_NEW(arena, struct hsr_screen_line, 2 * (size_t)n_blocks);
  for (uint32_t b = 0; wedge && b < n_blocks; b++) {
    uint32_t from = 1 + b * BLOCK, left = n - b * BLOCK;
    uint32_t to = from + 1 + (left < BLOCK ? left : BLOCK);
    wedge[2 * b] = wedge_line(screen, shape->corner, from, to, 1);
    wedge[2 * b + 1] = wedge_line(screen, shape->corner, from, to, -1);
  }
  shape->wedge = wedge;
  return wedge != NULL;
}

bool hsr_shape_make(struct hsr_shape *shape, const struct hsr_screen *screen,
                    uint32_t f, uint32_t id, struct hsr_arena *arena,
                    struct hsr_tally *tally) {
  const struct hsr_depth_plane *plane = &screen->plane[f];
  *shape = (struct hsr_shape){
      .id = id, .q = {plane->a, plane->b, plane->c, 2 * plane->error}};
  if (!(plane->error < INFINITY)) /* the coefficients say nothing */
    shape->q = (struct hsr_screen_line){0, 0, 0, INFINITY};
  if (!copy_corners(shape, screen, f, arena) || !number_edges(shape, arena))
    return false;
  /* Before an eye in front of it, a polygon turns to the left around the ray.
   */
  int inner = -hsr_eye_side(screen, f, tally);
  shape->inner = inner;
  bool beyond = is_beyond_near(screen, shape);
  bool flat = !(screen->world->mesh.deviation[f] > 0);
  shape->is_convex = (beyond || flat) && is_convex(screen, shape, inner);
  /* n + 2 of a convex polygon, 3 (n - 2) + 2 of a fan. */
  struct hsr_screen_line *line =
      HSR_NEW(arena, struct hsr_screen_line, 3 * (size_t)shape->n_corners);
  if (!line)
    return false;
  if (shape->is_convex)
    convex_lines(shape, screen, inner, line);
  else
    fan_lines(shape, screen, line);
  if (!shape->is_convex && !find_wedges(shape, screen, arena))
    return false;
  if (!beyond || !flat) {
    shape->n_lines += near_lines(screen, f, &shape->q, line + shape->n_lines);
    if (screen->view->parallel || screen->view->near > 0)
      decide_near(&line[shape->n_lines - 1], screen, f, tally);
  }
  shape->line = line;
  find_box(shape, screen, f);
  return true;
}

/* --- Pieces --------------------------------------------------------------- */

/* A plane from the eye: its height, the size of its normal, and in parallel the
 * normal along F, with their errors. */
struct seen_plane {
  const double *N;
  double n_error, size, height, h_error, along, a_error;
};

static struct seen_plane see_plane(const struct hsr_view *view,
                                   const struct hsr_shape_cut *plane) {
  double from[3];
  for (int k = 0; k < 3; k++)
    from[k] = view->E[k] - plane->P[k];
  double n = size_of(plane->N), r = size_of(from);
  return (struct seen_plane){.N = plane->N,
                             .n_error = plane->N_error,
                             .size = n + 3 * plane->N_error,
                             .height = dot(plane->N, from),
                             .h_error =
                                 2 * (plane->N_error * r + plane->P_error * n) +
                                 0x1p-48 * n * r,
                             .along = dot(plane->N, view->F),
                             .a_error = 2 * plane->N_error + 0x1p-48 * n};
}

/* x a + y b, of vectors. The factors have errors, too: what the components are
 * off by is returned. */
static double mix(double x, double x_error, const struct seen_plane *a,
                  double y, double y_error, const struct seen_plane *b,
                  double out[3]) {
  for (int k = 0; k < 3; k++)
    out[k] = x * a->N[k] + y * b->N[k];
  return 2 * (x_error * a->size + fabs(x) * a->n_error + y_error * b->size +
              fabs(y) * b->n_error) +
         0x1p-45 * (fabs(x) * a->size + fabs(y) * b->size);
}

static struct hsr_screen_line cut_line(const struct hsr_screen *screen,
                                       const struct hsr_shape_cut *own,
                                       int inner,
                                       const struct hsr_shape_cut *cut) {
  const struct hsr_view *view = screen->view;
  const struct seen_plane M = see_plane(view, own), N = see_plane(view, cut);
  double far = screen->reach[0] + screen->reach[1] + screen->reach[2];
  double normal[3], error, rest = 0;
  if (view->parallel) {
    double k = M.along, f = N.along, h = N.height, g = -M.height;
    error = far * mix(k, M.a_error, &N, -f, N.a_error, &M, normal);
    rest = k * h + f * g;
    error += 2 * (M.a_error * (fabs(h) + N.h_error) + fabs(k) * N.h_error +
                  N.a_error * (fabs(g) + M.h_error) + fabs(f) * M.h_error) +
             0x1p-45 * (fabs(k * h) + fabs(f * g));
  } else {
    error =
        far * mix(N.height, N.h_error, &M, -M.height, M.h_error, &N, normal);
  }
  struct hsr_screen_line line = line_of(screen, normal, rest, error + TINY);
  if (is_vague(view, &line)) {
    hsr_cut_exactly(screen, own, cut, normal, &rest);
    struct hsr_screen_line exact = exact_line(screen, normal, rest);
    if (exact.error < line.error)
      line = exact;
  }
  /* M is turned as the polygon is: `inner` is the sign of g, or of k. */
  return cut->side * inner > 0 ? line : opposite(line);
}

bool hsr_shape_divide(struct hsr_shape *shape, const struct hsr_screen *screen,
                      const struct hsr_shape_cut *own,
                      const struct hsr_shape_cut *cut, uint32_t n_cuts,
                      struct hsr_arena *arena) {
  uint32_t n = shape->n_lines;
  struct hsr_screen_line *line =
      HSR_NEW(arena, struct hsr_screen_line, n + (size_t)n_cuts);
  if (!line)
    return false;
  memcpy(line, shape->line, n * sizeof *line);
  for (uint32_t k = 0; k < n_cuts; k++)
    line[n + k] = cut_line(screen, own, shape->inner, &cut[k]);
  shape->line = line;
  shape->n_lines = n + n_cuts;
  shape->cut = cut;
  shape->n_cuts = n_cuts;
  return true;
}

/* --- Squares -------------------------------------------------------------- */

static enum hsr_meeting meets_all(const struct hsr_screen_line *line,
                                  uint32_t n, const struct hsr_square *square) {
  enum hsr_meeting meeting = HSR_COVERS;
  for (uint32_t k = 0; k < n; k++) {
    double lo, hi;
    hsr_line_range(&line[k], square, &lo, &hi);
    if (hi < 0)
      return HSR_MISSES;
    if (!(lo > 0))
      meeting = HSR_MEETS;
  }
  return meeting;
}

/* The three lines have one sign on all of the square, or two signs. */
static enum hsr_meeting meets_triangle(const struct hsr_screen_line *line,
                                       const struct hsr_square *square) {
  int above = 0, below = 0;
  for (int k = 0; k < 3; k++) {
    double lo, hi;
    hsr_line_range(&line[k], square, &lo, &hi);
    above += lo > 0;
    below += hi < 0;
  }
  return above && below             ? HSR_MISSES
         : above == 3 || below == 3 ? HSR_COVERS
                                    : HSR_MEETS;
}

/* Certainly, no ray of the square meets the block's triangles, before the eye or
 * behind it. */
static bool misses_block(const struct hsr_screen_line *wedge,
                         const struct hsr_square *square) {
  double lo[2], hi[2];
  for (int k = 0; k < 2; k++)
    hsr_line_range(&wedge[k], square, &lo[k], &hi[k]);
  return (lo[0] > 0 && hi[1] < 0) || (hi[0] < 0 && lo[1] > 0);
}

/* The first triangle from k on whose block may meet the square; n_corners - 2:
 * there is none. */
static uint32_t next_triangle(const struct hsr_shape *shape,
                              const struct hsr_square *square, uint32_t k) {
  uint32_t n = shape->n_corners - 2;
  while (k < n && k % BLOCK == 0 &&
         misses_block(shape->wedge + 2 * (k / BLOCK), square))
    k += BLOCK;
  return k < n ? k : n;
}

static enum hsr_meeting meets_fan(const struct hsr_shape *shape,
                                  const struct hsr_square *square) {
  uint32_t n = shape->n_corners - 2;
  enum hsr_meeting near =
      meets_all(shape->line + 3 * (size_t)n, shape->n_lines - 3 * n, square);
  bool odd = false;
  if (near == HSR_MISSES)
    return HSR_MISSES;
  for (uint32_t k = next_triangle(shape, square, 0); k < n;
       k = next_triangle(shape, square, k + 1)) {
    enum hsr_meeting meeting =
        meets_triangle(shape->line + 3 * (size_t)k, square);
    if (meeting == HSR_MEETS)
      return HSR_MEETS;
    odd ^= meeting == HSR_COVERS;
  }
  return odd ? near : HSR_MISSES;
}

enum hsr_meeting hsr_shape_meets(const struct hsr_shape *shape,
                                 const struct hsr_square *square) {
  if (square->x + square->half < shape->x0 ||
      square->x - square->half > shape->x1 ||
      square->y + square->half < shape->y0 ||
      square->y - square->half > shape->y1)
    return HSR_MISSES;
  return shape->is_convex ? meets_all(shape->line, shape->n_lines, square)
                          : meets_fan(shape, square);
}

/* Can the three lines be positive together, or negative? */
static bool can_be(const struct hsr_screen_line *line, bool negative,
                   const struct hsr_square *square) {
  for (int k = 0; k < 3; k++) {
    double lo, hi;
    hsr_line_range(&line[k], square, &lo, &hi);
    if (negative ? lo > 0 : hi < 0)
      return false;
  }
  return true;
}

bool hsr_shape_fan(const struct hsr_shape *shape,
                   const struct hsr_square *square, struct hsr_fan *fan) {
  *fan = (struct hsr_fan){.odd = false};
  for (uint32_t k = next_triangle(shape, square, 0); k + 2 < shape->n_corners;
       k = next_triangle(shape, square, k + 1)) {
    const struct hsr_screen_line *line = shape->line + 3 * (size_t)k;
    enum hsr_meeting meeting = meets_triangle(line, square);
    fan->odd ^= meeting == HSR_COVERS;
    if (meeting != HSR_MEETS)
      continue;
    bool negative = can_be(line, true, square);
    if (fan->n == HSR_FAN_MEETS || (negative && can_be(line, false, square)))
      return false;
    fan->triangle[fan->n] = k;
    fan->negative[fan->n++] = negative;
  }
  return true;
}

bool hsr_shape_covers_but(const struct hsr_shape *shape,
                          const struct hsr_square *square, uint32_t but,
                          uint32_t nor) {
  for (uint32_t k = 0; k < shape->n_lines; k++) {
    double lo, hi;
    hsr_line_range(&shape->line[k], square, &lo, &hi);
    if (k != but && k != nor && !(lo > 0))
      return false;
  }
  return true;
}

/* --- Shares --------------------------------------------------------------- */

void hsr_clip_whole(struct hsr_clip *clip) {
  *clip = (struct hsr_clip){
      .x = {-1, 1, 1, -1}, .y = {-1, -1, 1, 1}, .off = 0x1p-46, .n = 4};
}

/* What is on the positive side of e = a x + b y + c. By rounding, a corner more
 * may come of it; if there is no room, nothing is known. */
static void cut(struct hsr_clip *clip, double a, double b, double c) {
  struct hsr_clip from = *clip;
  uint32_t n = 0;
  for (uint32_t k = 0; k < from.n && n + 2 <= HSR_CLIP_ROOM; k++) {
    uint32_t l = k + 1 < from.n ? k + 1 : 0;
    double e = a * from.x[k] + b * from.y[k] + c;
    double next = a * from.x[l] + b * from.y[l] + c;
    if (e >= 0) {
      clip->x[n] = from.x[k];
      clip->y[n++] = from.y[k];
    }
    if ((e >= 0) != (next >= 0)) {
      double t = e / (e - next);
      clip->x[n] = from.x[k] + t * (from.x[l] - from.x[k]);
      clip->y[n++] = from.y[k] + t * (from.y[l] - from.y[k]);
    }
  }
  clip->n = n;
  if (n + 2 > HSR_CLIP_ROOM)
    clip->off = 1;
}

void hsr_clip_by(struct hsr_clip *clip, const struct hsr_screen_line *line,
                 const struct hsr_square *square) {
  double a = line->a * square->half, b = line->b * square->half;
  double c = line->a * square->x + line->b * square->y + line->c;
  double by = fabs(a) + fabs(b);
  if (c - by > line->error)
    return;
  if (c + by < -line->error) {
    clip->n = 0;
    clip->off = 0;
    return;
  }
  double off = clip->off + line->error / hypot(a, b) + 0x1p-48;
  clip->off = off < 1 ? off : 1;
  if (clip->off < 1)
    cut(clip, a, b, c);
}

void hsr_clip_by_triangle(struct hsr_clip *clip, const struct hsr_shape *shape,
                          const struct hsr_fan *fan, uint32_t k,
                          const struct hsr_square *square) {
  const struct hsr_screen_line *line =
      shape->line + 3 * (size_t)fan->triangle[k];
  for (int l = 0; l < 3; l++) {
    struct hsr_screen_line side =
        fan->negative[k] ? opposite(line[l]) : line[l];
    hsr_clip_by(clip, &side, square);
  }
}

void hsr_clip_by_near(struct hsr_clip *clip, const struct hsr_shape *shape,
                      const struct hsr_square *square) {
  for (uint32_t l = 3 * (shape->n_corners - 2); l < shape->n_lines; l++)
    hsr_clip_by(clip, &shape->line[l], square);
}

static double area_of(const struct hsr_clip *clip) {
  double area = 0;
  for (uint32_t k = 0; k < clip->n; k++) {
    uint32_t l = k + 1 < clip->n ? k + 1 : 0;
    area += clip->x[k] * clip->y[l] - clip->x[l] * clip->y[k];
  }
  return fabs(area) / 2;
}

void hsr_clip_share(const struct hsr_clip *clip, double *lo, double *hi) {
  double share = clip->off < 1 ? area_of(clip) / 4 : 0;
  *lo = share > clip->off ? share - clip->off : 0;
  *hi = share + clip->off < 1 ? share + clip->off : 1;
}

void hsr_shape_share(const struct hsr_shape *shape,
                     const struct hsr_square *square, double *lo, double *hi) {
  struct hsr_clip clip;
  hsr_clip_whole(&clip);
  if (!shape->is_convex)
    clip.off = 1;
  for (uint32_t k = 0; shape->is_convex && k < shape->n_lines; k++)
    hsr_clip_by(&clip, &shape->line[k], square);
  hsr_clip_share(&clip, lo, hi);
}
