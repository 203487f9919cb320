/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes against convex polyhedra, and the proofs of the bounds, also those of
 * box_polygon.c.
 *
 * Notation    u = 2^-53; a hat marks a computed value; |.|_1 a sum of absolute
 *             components; s the largest coordinate, in size, of the box and of
 *             the bounds of P or of the polygon, which hold its vertices with
 *             their radii. Everything is in doubles, rounded to nearest,
 *             nothing contracted. Coordinates are at most 1e30, so that
 *             nothing overflows; 2^-960 covers underflow.
 *
 * Apart. Two convex sets are disjoint if some vector N has max N.V < min N.X
 * over the one's vertices V and the other's corners X. N may be any vector.
 * Ours are rounded normals of faces and edge-lines: the rounding affects how
 * often the test succeeds, not whether it is right. So only the products count.
 * N.X^ is within 3.1 u |N|_1 s of N.X, and so is N.V^. A vertex within radius r
 * of V adds at most |N|_1 r, computed within 4 u |N|_1 s, and each sum u |N|_1
 * s: in all below 12 u |N|_1 s. The filters take 16, which covers the rounding
 * of the comparison, too.
 *
 * Bounds. With radii they are rounded outward by one unit in the last place.
 *
 * Normals. Newell's, with V_0 as origin, as in planes.c: each component is off
 * by at most 4(k + 1) u S for a face of k vertices, where S is the largest
 * component of the sum of absolute products. Radii move each of the two factors
 * d of a product, |d| <= w, by at most p = twice the largest radius, and so
 * each of 2(k - 2) products by p (2 w + p). `error` takes k times twice that,
 * which covers its own rounding.
 *
 * Inner side. Let m be the least N^.V over the vertices V of a face, less |N|_1
 * times their radii. A box with N^.X < m - (16 u |N|_1 + 6 error) s at its
 * p-vertex, computed, has N^.(X - V) < -6 error s <= -error |X - V|_1 all over,
 * and so N.(X - V) < 0 for the exact normal N of the face. It is on the inner
 * side of the exact plane, or, if the face is not quite planar, of that plane
 * through each of its vertices.
 *
 * In. Let C be the set of points where N^.X < m for all faces: it is convex. A
 * face, spanned in any way within the hull of its vertices, has N^.X >= m. So
 * the closed surface of all faces does not meet C, and has one winding number
 * about all points of C. If the mean of the vertices is in C, which is checked,
 * all faces turn outward as seen from there, and that number is not 0. About
 * points outside the hull it is 0. So all of C is in the hull, and inside. A
 * polyhedron that is too flat for the check has no inside: `inner` is then
 * -infinity.
 *
 * Frusta. A ray's components are within 8 u of the sum of its terms' sizes, by
 * common/view/view.h. t D adds one rounding, and so does E + t D. The radius
 * takes t times 10 u, and 2 u |V|. */
#include "common/trees/box.h"
#include "common/base/numbers.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <string.h>

static const double U = DBL_EPSILON / 2;
static const double TINY = 0x1p-960;

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double sum_of_sizes(const double v[3]) {
  return fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
}

/* The largest coordinate, in size. */
static double box_size(const struct hsr_box *box) {
  double size = 0;
  for (int k = 0; k < 3; k++)
    size = hsr_max(size, hsr_max(-box->lo[k], box->hi[k]));
  return size;
}

static const struct hsr_box nothing = {{INFINITY, INFINITY, INFINITY},
                                       {-INFINITY, -INFINITY, -INFINITY}};

/* Widens the box to hold all points within the radius of p. */
static void hold(struct hsr_box *box, const double p[3], double radius) {
  for (int k = 0; k < 3; k++) {
    double lo = p[k], hi = p[k];
    if (radius > 0) {
      lo = nextafter(lo - radius, -INFINITY);
      hi = nextafter(hi + radius, INFINITY);
    }
    box->lo[k] = lo < box->lo[k] ? lo : box->lo[k];
    box->hi[k] = hsr_max(box->hi[k], hi);
  }
}

/* --- Preparing a polyhedron ----------------------------------------------- */

/* The arguments of hsr_polyhedron_init. */
struct solid {
  int n_vertices, n_faces;
  const double *xyz, *radius;
  const int *start, *vertex;
};

static const double *vertex(const struct solid *solid, int v) {
  return solid->xyz + 3 * v;
}

static double radius(const struct solid *solid, int v) {
  return solid->radius ? solid->radius[v] : 0;
}

/* Newell's normal of face f, and the error of each component. */
static double find_normal(const struct solid *solid, int f, double normal[3]) {
  const int *loop = solid->vertex + solid->start[f];
  int size = solid->start[f + 1] - solid->start[f];
  const double *first = vertex(solid, loop[0]);
  double a[3] = {0}, b[3], sum[3] = {0}; /* from the first to two in turn */
  double wide = 0, off = radius(solid, loop[0]);
  normal[0] = normal[1] = normal[2] = 0;
  for (int i = 1; i < size; i++) {
    for (int k = 0; k < 3; k++) {
      b[k] = vertex(solid, loop[i])[k] - first[k];
      wide = hsr_max(wide, fabs(b[k]));
    }
    off = hsr_max(off, radius(solid, loop[i]));
    for (int k = 0; k < 3; k++) {
      int l = (k + 1) % 3, m = (k + 2) % 3;
      normal[k] += a[l] * b[m] - a[m] * b[l];
      sum[k] += fabs(a[l] * b[m]) + fabs(a[m] * b[l]);
    }
    memcpy(a, b, sizeof a);
  }
  return 4 * (size + 1) * U * hsr_max(sum[0], hsr_max(sum[1], sum[2])) +
         2 * size * (2 * off) * (2 * wide + 2 * off) + TINY;
}

/* The half space with the given normal that just holds the solid. */
static struct hsr_half_space half_space(const struct solid *solid,
                                        const double normal[3]) {
  double length = sum_of_sizes(normal);
  struct hsr_half_space h = {.outer = -INFINITY, .doubt = 16 * U * length};
  for (int v = 0; v < solid->n_vertices; v++)
    h.outer = hsr_max(h.outer, dot(normal, vertex(solid, v)) +
                                   length * radius(solid, v));
  for (int k = 0; k < 3; k++) {
    h.normal[k] = normal[k];
    h.n[k] = normal[k] < 0;
  }
  return h;
}

/* The plane of face f; `middle` is inside the solid. */
static void find_plane(struct hsr_polyhedron *poly, const struct solid *solid,
                       int f, const double middle[3]) {
  double normal[3], error = find_normal(solid, f, normal);
  const double *first = vertex(solid, solid->vertex[solid->start[f]]);
  if (dot(normal, middle) > dot(normal, first))
    for (int k = 0; k < 3; k++)
      normal[k] = -normal[k];
  poly->plane[f] = half_space(solid, normal);
  poly->inner[f] = INFINITY;
  poly->inner_doubt[f] = poly->plane[f].doubt + 6 * error;
  for (int i = solid->start[f]; i < solid->start[f + 1]; i++) {
    int v = solid->vertex[i];
    double least =
        dot(normal, vertex(solid, v)) - sum_of_sizes(normal) * radius(solid, v);
    poly->inner[f] = least < poly->inner[f] ? least : poly->inner[f];
  }
}

/* Is p certainly on the inner side of all planes? */
static bool has_inside(const struct hsr_polyhedron *poly, const double p[3]) {
  bool inner = true;
  for (int f = 0; f < poly->n_planes; f++)
    inner &= dot(poly->plane[f].normal, p) <
             poly->inner[f] - (poly->inner_doubt[f] * poly->size + TINY);
  return inner;
}

/* The face other than f that has the edge from a to b, in either direction. */
static int other_face(const struct solid *solid, int f, int a, int b) {
  for (int g = 0; g < solid->n_faces; g++) {
    int size = solid->start[g + 1] - solid->start[g];
    const int *loop = solid->vertex + solid->start[g];
    for (int i = 0; i < size && g != f; i++) {
      int c = loop[i], d = loop[(i + 1) % size];
      if ((c == a && d == b) || (c == b && d == a))
        return g;
    }
  }
  return -1;
}

/* The edge-line of the edge from a to b in the view along axis u, turned
 * away from the middle. */
static struct hsr_half_space edge_line(const struct solid *solid, int a, int b,
                                       int u, const double middle[3]) {
  const double *p = vertex(solid, a), *q = vertex(solid, b);
  int k = (u + 1) % 3, l = (u + 2) % 3;
  double normal[3];
  normal[u] = 0;
  normal[k] = q[l] - p[l];
  normal[l] = p[k] - q[k];
  if (dot(normal, middle) > dot(normal, p)) {
    normal[k] = -normal[k];
    normal[l] = -normal[l];
  }
  return half_space(solid, normal);
}

/* The silhouette in the view along axis u: the edges between a face that faces
 * that way and one that does not. */
static void find_lines(struct hsr_polyhedron *poly, const struct solid *solid,
                       int u, const double middle[3]) {
  for (int f = 0; f < solid->n_faces; f++) {
    if (!(poly->plane[f].normal[u] > 0))
      continue;
    int size = solid->start[f + 1] - solid->start[f];
    const int *loop = solid->vertex + solid->start[f];
    for (int i = 0; i < size; i++) {
      int a = loop[i], b = loop[(i + 1) % size];
      int g = other_face(solid, f, a, b);
      assert(g >= 0);
      if (!(poly->plane[g].normal[u] > 0) &&
          poly->n_lines < HSR_POLYHEDRON_LINES)
        poly->line[poly->n_lines++] = edge_line(solid, a, b, u, middle);
    }
  }
}

void hsr_polyhedron_init(struct hsr_polyhedron *poly, int n_vertices,
                         const double *xyz, const double *vertex_radius,
                         int n_faces, const int *start, const int *loops) {
  const struct solid solid = {n_vertices,    n_faces, xyz,
                              vertex_radius, start,   loops};
  double middle[3] = {0};
  assert(n_faces <= HSR_POLYHEDRON_FACES &&
         n_vertices <= HSR_POLYHEDRON_VERTICES);
  *poly = (struct hsr_polyhedron){.bounds = nothing, .n_planes = n_faces};
  for (int v = 0; v < n_vertices; v++) {
    hold(&poly->bounds, vertex(&solid, v), radius(&solid, v));
    for (int k = 0; k < 3; k++)
      middle[k] += vertex(&solid, v)[k] / n_vertices;
  }
  poly->size = box_size(&poly->bounds);
  for (int f = 0; f < n_faces; f++)
    find_plane(poly, &solid, f, middle);
  if (!has_inside(poly, middle))
    for (int f = 0; f < n_faces; f++)
      poly->inner[f] = -INFINITY;
  for (int u = 0; u < 3; u++)
    find_lines(poly, &solid, u, middle);
}

/* --- The frustum of a window ---------------------------------------------- */

/* The point at depth t on the ray of screen point (sx, sy), and its radius. In
 * parallel the ray's start, P - E, is a sum as D is, and F is exact. */
static double ray_point(const struct hsr_view *view, double sx, double sy,
                        double t, double point[3]) {
  double off = 0;
  for (int k = 0; k < 3; k++) {
    double a = view->ray[0][k], b = sx * view->ray[1][k],
           c = sy * view->ray[2][k];
    double s = view->parallel ? 1 : t;
    double along = view->parallel ? t * view->F[k] : 0;
    point[k] = view->E[k] + (s * (a + b + c) + along);
    off = hsr_max(off,
                  10 * U * (s * (fabs(a) + fabs(b) + fabs(c)) + fabs(along)) +
                      2 * U * fabs(point[k]));
  }
  return t > 0 || view->parallel ? off + TINY : 0;
}

/* Vertices 0 to 3 are those of the far face, from the top left one to the
 * right, 4 to 7 those of the near one; the apex is 4. */
void hsr_frustum_init(struct hsr_polyhedron *poly, const struct hsr_view *view,
                      double far) {
  const struct hsr_window *w = &view->window;
  double x0 = hsr_sample_x(view, w->x0) - 0.5;
  double x1 = hsr_sample_x(view, w->x1 - 1) + 0.5;
  double y0 = hsr_sample_y(view, w->y0) - 0.5;
  double y1 = hsr_sample_y(view, w->y1 - 1) + 0.5;
  const double sx[4] = {x0, x1, x1, x0}, sy[4] = {y0, y0, y1, y1};
  bool apex = !(view->near > 0 || view->parallel);
  double xyz[8][3], off[8];
  int start[7] = {0}, loops[24], n_faces = 0, n = 0;
  for (int k = 0; k < 4; k++) { /* of the apex, four times the same */
    off[k] = ray_point(view, sx[k], sy[k], far, xyz[k]);
    off[4 + k] = ray_point(view, sx[k], sy[k], view->near, xyz[4 + k]);
  }
  for (int k = 0; k < 4; k++) { /* the sides */
    loops[n++] = k;
    loops[n++] = (k + 1) % 4;
    if (!apex)
      loops[n++] = 4 + (k + 1) % 4;
    loops[n++] = apex ? 4 : 4 + k;
    start[++n_faces] = n;
  }
  for (int face = 0; face < (apex ? 1 : 2); face++) { /* far and near */
    for (int k = 0; k < 4; k++)
      loops[n++] = 4 * face + k;
    start[++n_faces] = n;
  }
  hsr_polyhedron_init(poly, apex ? 5 : 8, xyz[0], off, n_faces, start, loops);
}

/* --- The test of a box ---------------------------------------------------- */

/* The values of normal . X at the n-vertex and at the p-vertex, of a box given
 * by its lo and hi. */
static inline double at_n_vertex(const struct hsr_half_space *h,
                                 const double *const side[2]) {
  return h->normal[0] * side[h->n[0]][0] + h->normal[1] * side[h->n[1]][1] +
         h->normal[2] * side[h->n[2]][2];
}
static inline double at_p_vertex(const struct hsr_half_space *h,
                                 const double *const side[2]) {
  return h->normal[0] * side[!h->n[0]][0] + h->normal[1] * side[!h->n[1]][1] +
         h->normal[2] * side[!h->n[2]][2];
}

/* Is the box with those sides certainly outside? */
static inline bool outside(const struct hsr_half_space *h,
                           const double *const side[2], double size) {
  return at_n_vertex(h, side) > h->outer + (h->doubt * size + TINY);
}

/* Is it certainly on the inner side of plane f? */
static inline bool inside(const struct hsr_polyhedron *poly, int f,
                          const double *const side[2], double size) {
  return at_p_vertex(&poly->plane[f], side) <
         poly->inner[f] - (poly->inner_doubt[f] * size + TINY);
}

/* How many comparisons hsr_boxes_meet makes for these boxes. */
static unsigned comparisons_to_meet(const struct hsr_box *a,
                                    const struct hsr_box *b) {
  unsigned n = 0;
  for (int k = 0; k < 3; k++) {
    n++;
    if (a->lo[k] > b->hi[k])
      break;
    n++;
    if (b->lo[k] > a->hi[k])
      break;
  }
  return n;
}

/* How many comparisons hsr_box_holds makes. */
static unsigned comparisons_to_hold(const struct hsr_box *a,
                                    const struct hsr_box *b) {
  unsigned n = 0;
  for (int k = 0; k < 3; k++) {
    n++;
    if (a->lo[k] > b->lo[k])
      break;
    n++;
    if (b->hi[k] > a->hi[k])
      break;
  }
  return n;
}

enum hsr_box_verdict hsr_box_classify(const struct hsr_polyhedron *poly,
                                      const struct hsr_box *box, unsigned *cut,
                                      struct hsr_box_work *work) {
  const double *const side[2] = {box->lo, box->hi};
  enum hsr_box_verdict verdict = HSR_BOX_PARTIAL;
  struct hsr_box_work done = {0, 0};
  unsigned cuts = 0;

  /* Bounding box tests */
  bool meet = hsr_boxes_meet(box, &poly->bounds);
  if (!meet) {
    verdict = HSR_BOX_OUT;
  } else if (hsr_box_holds(box, &poly->bounds)) {
    cuts = (1u << poly->n_planes) - 1;
  } else {
    double size = hsr_max(poly->size, box_size(box));

    /* Face-plane tests */
    for (int f = 0; f < poly->n_planes && verdict != HSR_BOX_OUT; f++) {
      done.deciding++;
      if (outside(&poly->plane[f], side, size)) {
        verdict = HSR_BOX_OUT;
      } else {
        done.refining++;
        cuts |= (unsigned)!inside(poly, f, side, size) << f;
      }
    }
    if (verdict != HSR_BOX_OUT && !cuts)
      verdict = HSR_BOX_IN;

    /* Edge-line tests */
    for (int e = 0; e < poly->n_lines && verdict == HSR_BOX_PARTIAL; e++) {
      done.deciding++;
      if (outside(&poly->line[e], side, size))
        verdict = HSR_BOX_OUT;
    }
  }
  if (cut)
    *cut = cuts;
  if (work) {
    work->deciding += comparisons_to_meet(box, &poly->bounds) + done.deciding;
    work->refining +=
        (meet ? comparisons_to_hold(box, &poly->bounds) : 0) + done.refining;
  }
  return verdict;
}
