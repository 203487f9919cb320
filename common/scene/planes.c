/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The planes of a world's faces, and which of them are equal.
 *
 * Source      Newell's plane equation: Sutherland et al. 1974, eq. 6.
 * Notation    u = 2^-53; a hat marks a computed value; d_i = V_i - V_0.
 *
 * Error of N. With V_0 as origin Newell's normal is the sum of
 * d_i x d_{i+1}, i = 1 .. k-2. A product of two differences carries three
 * roundings (1 + u)^3; a component sums 2(k - 2) of them, in at most 2(k - 2)
 * additions. Let P be the largest component of the sum of |d_iy d_{i+1}z| +
 * |d_iz d_{i+1}y|, as computed; it is itself within (1 + u)^{2k} of its value.
 * Then the error of every component is at most (2k + 3) u P to first order.
 * What is stored is 4(k + 1) u P, which covers the higher orders for every
 * k < 2^48, plus 2^-960, which covers underflow.
 *
 * Error of the anchor. The plane passes through the mean of the vertices, V_0 +
 * (sum of d_i) / k. Each d_i carries one rounding, the sum k - 2, and the
 * division and the last addition one each. Together that is at most (k + 2) u
 * times the largest component of |V_0| + sum |d_i|; twice that is stored. A
 * triangle's plane passes through V_0 itself, with no error.
 *
 * Deviation. N.(V - P) as computed carries the error of N times |V - P|_1, the
 * anchor's times |N|_1, one rounding of the difference, and three of the
 * products and sums. All are added and doubled. If that leaves open whether
 * every vertex is on the plane, the exact predicate decides; for a
 * quadrilateral, it decides whether the four vertices are coplanar. */
#include "common/scene/planes.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double U = DBL_EPSILON / 2;
static const double TINY = 0x1p-960;

void hsr_newell_add(struct hsr_newell *plane, const double v[3]) {
  double next[3];
  for (int a = 0; a < 3; a++) {
    if (!plane->n)
      plane->first[a] = v[a];
    next[a] = v[a] - plane->first[a];
    plane->sum[a] += next[a];
    plane->reach[a] += plane->n ? fabs(next[a]) : fabs(v[a]);
  }
  const double *previous = plane->previous;
  for (int a = 0, b = 1, c = 2; plane->n > 1 && a < 3;
       a++, b = (b + 1) % 3, c = (c + 1) % 3) {
    double plus = previous[b] * next[c], minus = previous[c] * next[b];
    plane->normal[a] += plus - minus;
    plane->size[a] += fabs(plus) + fabs(minus);
  }
  memcpy(plane->previous, next, sizeof next);
  plane->n++;
}

void hsr_newell_anchor(const struct hsr_newell *plane, double anchor[3]) {
  for (int a = 0; a < 3; a++)
    anchor[a] = plane->n == 3 ? plane->first[a]
                              : plane->first[a] + plane->sum[a] / plane->n;
}

/* The error of every component of a normal: `size` is P. */
static double normal_error(double n, const double size[3]) {
  return 4 * (n + 1) * U * hsr_max(size[0], hsr_max(size[1], size[2])) + TINY;
}

bool hsr_has_normal_for_certain(const struct hsr_loop *face) {
  struct hsr_newell plane = {.n = 0};
  for (uint32_t k = 0; k < face->n; k++) {
    size_t at = (size_t)face->stride * face->vertex[k];
    hsr_newell_add(&plane, (double[]){face->x[at], face->y[at], face->z[at]});
  }
  double most = hsr_max(fabs(plane.normal[0]),
                        hsr_max(fabs(plane.normal[1]), fabs(plane.normal[2])));
  return most > normal_error(plane.n, plane.size);
}

/* What find_plane finds for a triangle, rounded alike: its sums have one term,
 * and the anchor is V_0. */
static void find_triangle(struct hsr_world *world, uint32_t f) {
  struct hsr_mesh *mesh = &world->mesh;
  const uint32_t *v = mesh->vertex + mesh->start[f];
  const double *const at[3] = {mesh->x, mesh->y, mesh->z};
  double first[3], p[3], q[3], normal[3], size[3];
  for (int a = 0; a < 3; a++) {
    first[a] = at[a][v[0]];
    p[a] = at[a][v[1]] - first[a];
    q[a] = at[a][v[2]] - first[a];
  }
  for (int a = 0, b = 1, c = 2; a < 3; a++, b = (b + 1) % 3, c = (c + 1) % 3) {
    double plus = p[b] * q[c], minus = p[c] * q[b];
    normal[a] = plus - minus;
    size[a] = fabs(plus) + fabs(minus);
  }
  mesh->nx[f] = normal[0];
  mesh->ny[f] = normal[1];
  mesh->nz[f] = normal[2];
  mesh->n_error[f] = normal_error(3, size);
  mesh->px[f] = first[0];
  mesh->py[f] = first[1];
  mesh->pz[f] = first[2];
  mesh->anchor_error[f] = 0;
}

/* Newell's normal and the anchor of face f, with their errors. */
static void find_plane(struct hsr_world *world, uint32_t f) {
  if (hsr_face_size(world, f) == 3) {
    find_triangle(world, f);
    return;
  }
  struct hsr_newell plane = {.n = 0};
  for (uint32_t c = world->mesh.start[f]; c < world->mesh.start[f + 1]; c++) {
    uint32_t v = world->mesh.vertex[c];
    hsr_newell_add(&plane, (double[]){world->mesh.x[v], world->mesh.y[v],
                                      world->mesh.z[v]});
  }
  double anchor[3];
  hsr_newell_anchor(&plane, anchor);
  double r = fmax(plane.reach[0], fmax(plane.reach[1], plane.reach[2]));
  world->mesh.nx[f] = plane.normal[0];
  world->mesh.ny[f] = plane.normal[1];
  world->mesh.nz[f] = plane.normal[2];
  world->mesh.n_error[f] = normal_error(plane.n, plane.size);
  world->mesh.px[f] = anchor[0];
  world->mesh.py[f] = anchor[1];
  world->mesh.pz[f] = anchor[2];
  world->mesh.anchor_error[f] = 2 * (plane.n + 2.0) * U * r + TINY;
}

/* An upper bound of |N . (V - P)| over the vertices of face f. */
static double find_deviation(const struct hsr_world *world, uint32_t f,
                             bool *out_of_memory) {
  if (hsr_face_size(world, f) == 3)
    return 0;
  bool may_be_flat = true;
  const double n[3] = {world->mesh.nx[f], world->mesh.ny[f], world->mesh.nz[f]};
  double n1 = fabs(n[0]) + fabs(n[1]) + fabs(n[2]), largest = 0;
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
    uint32_t v = world->mesh.vertex[k];
    double r[3] = {world->mesh.x[v] - world->mesh.px[f],
                   world->mesh.y[v] - world->mesh.py[f],
                   world->mesh.z[v] - world->mesh.pz[f]};
    double r1 = fabs(r[0]) + fabs(r[1]) + fabs(r[2]);
    double error =
        2 * (world->mesh.n_error[f] * r1 + world->mesh.anchor_error[f] * n1) +
        16 * U * n1 * r1 + TINY;
    double off = fabs(n[0] * r[0] + n[1] * r[1] + n[2] * r[2]);
    may_be_flat &= off <= error;
    largest = fmax(largest, off + error);
  }
  return may_be_flat && hsr_is_flat(hsr_face_loop(world, f), out_of_memory)
             ? 0
             : largest;
}

static double largest_normal(const struct hsr_world *world, uint32_t f) {
  return hsr_max(fabs(world->mesh.nx[f]),
                 hsr_max(fabs(world->mesh.ny[f]), fabs(world->mesh.nz[f])));
}

/* Checks that the faces of every instance are still valid. */
static enum hsr_status check(const struct hsr_world *world,
                             struct hsr_error *err) {
  for (uint32_t v = 0; v < world->mesh.n_vertices; v++)
    if (!(fabs(world->mesh.x[v]) <= 1e30 && fabs(world->mesh.y[v]) <= 1e30 &&
          fabs(world->mesh.z[v]) <= 1e30))
      return hsr_fail(err, HSR_E_INPUT,
                      "an instance takes a vertex out of range (above 1e30)");
  bool out_of_memory = false;
  for (uint32_t f = 0; f < world->n_faces; f++)
    if (largest_normal(world, f) <= world->mesh.n_error[f] &&
        !hsr_exact_has_normal(hsr_face_loop(world, f), &out_of_memory))
      return hsr_fail(
          err, HSR_E_INPUT,
          "object %s: an instance takes the area of face id %u to zero",
          world->outline.scene->objects[world->mesh.object[f]].name, f);
  return out_of_memory ? hsr_fail_nomem(err) : HSR_OK;
}

/* --- Equal planes --------------------------------------------------------- */

/* A number that equal planes share: the absolute value of a fixed linear form
 * in the unit normal and the distance. That of face f lies in [lo[f], hi[f]].
 *
 * Each component of the unit normal is off by at most 2 sqrt(3) n_error/|N| +
 * 4u. The distance is off by that times the anchor's size, plus the anchor's
 * error and three roundings. The form's coefficients are below 1. All is
 * doubled. If the normal is unknown the error is not finite, and the face is
 * compared with all. */
HSR_VECTOR static void find_keys(const struct hsr_mesh *mesh, uint32_t n_faces,
                                 double *restrict lo, double *restrict hi) {
  const double *restrict x = mesh->nx, *restrict y = mesh->ny,
                         *restrict z = mesh->nz, *restrict px = mesh->px,
                         *restrict py = mesh->py, *restrict pz = mesh->pz,
                         *restrict n_error = mesh->n_error,
                         *restrict anchor_error = mesh->anchor_error;
  for (uint32_t f = 0; f < n_faces; f++) {
    double scale = hsr_max(fabs(x[f]), hsr_max(fabs(y[f]), fabs(z[f])));
    double nx = x[f] / scale, ny = y[f] / scale, nz = z[f] / scale;
    double length = sqrt(nx * nx + ny * ny + nz * nz);
    double reach = fabs(px[f]) + fabs(py[f]) + fabs(pz[f]);
    double d = (nx * px[f] + ny * py[f] + nz * pz[f]) / length;
    double key =
        fabs((0.5432 * nx + 0.8107 * ny + 0.3219 * nz) / length + 0.6173 * d);
    double turn = 4 * (n_error[f] / (scale * length)) + 8 * U;
    double error =
        8 * (turn * (1 + reach) + anchor_error[f]) + 16 * U * (1 + key);
    bool known = error < INFINITY;
    lo[f] = known ? key - error : -INFINITY;
    hi[f] = known ? key + error : INFINITY;
  }
}

/* A face, to be sorted by the lower end of its key. */
struct sorted_face {
  uint64_t lo; /* as a whole number, in the same order */
  uint32_t face;
};

/* The order of whole numbers is that of the doubles: a negative one has all its
 * bits turned, any other one the highest. */
static uint64_t whole_in_order(double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits >> 63 ? ~bits : bits | UINT64_C(1) << 63;
}

/* One pass of a radix sort, by the eight bits from `shift` on. Whoever is equal
 * keeps its order. False: all have the same bits there, and nothing is
 * moved. */
static bool sort_pass(const struct sorted_face *from, struct sorted_face *to,
                      uint32_t n, int shift) {
  uint32_t start[257] = {0};
  for (uint32_t k = 0; k < n; k++)
    start[(from[k].lo >> shift & 255) + 1]++;
  for (int digit = 1; digit <= 256; digit++)
    if (start[digit] == n)
      return false;
  for (int digit = 1; digit <= 256; digit++)
    start[digit] += start[digit - 1];
  for (uint32_t k = 0; k < n; k++)
    to[start[from[k].lo >> shift & 255]++] = from[k];
  return true;
}

/* Sorts n faces by the lower ends of their keys, then by number. The caller
 * frees the list; NULL: no memory. */
static struct sorted_face *sort_faces(const double *lo, uint32_t n) {
  struct sorted_face *from = malloc(((size_t)n + 1) * sizeof *from);
  struct sorted_face *to = malloc(((size_t)n + 1) * sizeof *to);
  for (uint32_t f = 0; from && to && f < n; f++)
    from[f] = (struct sorted_face){whole_in_order(lo[f]), f};
  for (int shift = 0; from && to && shift < 64; shift += 8)
    if (sort_pass(from, to, n, shift)) {
      struct sorted_face *moved = to;
      to = from;
      from = moved;
    }
  bool all = from && to;
  free(to);
  if (!all) {
    free(from);
    return NULL;
  }
  return from;
}

/* Whether the normals may be parallel: a cheap test. No is certain. */
static bool maybe_parallel(const struct hsr_world *world, uint32_t f,
                           uint32_t g) {
  double a[3] = {world->mesh.nx[f], world->mesh.ny[f], world->mesh.nz[f]};
  double b[3] = {world->mesh.nx[g], world->mesh.ny[g], world->mesh.nz[g]};
  double fa = largest_normal(world, f), fb = largest_normal(world, g);
  double error =
      4 * (fa * world->mesh.n_error[g] + fb * world->mesh.n_error[f] +
           world->mesh.n_error[f] * world->mesh.n_error[g]) +
      8 * U * fa * fb;
  for (int i = 0, j = 1; i < 3; i++, j = (j + 1) % 3)
    if (fabs(a[i] * b[j] - a[j] * b[i]) > error)
      return false;
  return true;
}

/* One representative of a class that the sweep has not left behind. */
struct open_class {
  double hi;
  uint32_t face;
};

/* Sweeps over the keys. A plane is compared with the planes whose key intervals
 * overlap its own, one representative of each class. */
static bool sweep(struct hsr_world *world, const double *lo, const double *hi,
                  const struct sorted_face *sorted, struct open_class *open) {
  uint32_t n = world->n_faces, n_open = 0;
  bool out_of_memory = false;
  world->mesh.n_planes = 0;
  for (uint32_t i = 0; i < n && !out_of_memory; i++) {
    uint32_t f = sorted[i].face, kept = 0, found = UINT32_MAX;
    for (uint32_t o = 0; o < n_open; o++) {
      if (open[o].hi < lo[f])
        continue; /* behind the sweep for good */
      open[kept] = open[o];
      uint32_t g = open[kept++].face;
      if (found == UINT32_MAX && maybe_parallel(world, f, g) &&
          hsr_exact_same_plane(hsr_face_loop(world, f), hsr_face_loop(world, g),
                               &out_of_memory))
        found = world->mesh.plane[g];
    }
    n_open = kept;
    if (found == UINT32_MAX) {
      found = world->mesh.n_planes++;
      open[n_open++] = (struct open_class){hi[f], f};
    }
    world->mesh.plane[f] = found;
  }
  return !out_of_memory;
}

static enum hsr_status classify_planes(struct hsr_world *world) {
  size_t n = world->n_faces;
  double *lo = malloc((n + 1) * sizeof *lo), *hi = malloc((n + 1) * sizeof *hi);
  struct open_class *open = malloc((n + 1) * sizeof *open);
  struct sorted_face *sorted = NULL;
  if (lo && hi && open) {
    find_keys(&world->mesh, world->n_faces, lo, hi);
    sorted = sort_faces(lo, world->n_faces);
  }
  bool done = sorted && sweep(world, lo, hi, sorted, open);
  free(sorted);
  free(open);
  free(hi);
  free(lo);
  return done ? HSR_OK : HSR_E_NOMEM;
}

void hsr_world_find_plane(struct hsr_world *world, uint32_t f,
                          bool *out_of_memory) {
  find_plane(world, f);
  world->mesh.deviation[f] = find_deviation(world, f, out_of_memory);
}

enum hsr_status hsr_world_find_planes(struct hsr_world *world,
                                      struct hsr_error *err) {
  bool out_of_memory = false;
  for (uint32_t f = 0; f < world->n_faces; f++)
    hsr_world_find_plane(world, f, &out_of_memory);
  if (out_of_memory)
    return hsr_fail_nomem(err);
  enum hsr_status status = check(world, err);
  if (status)
    return status;
  return classify_planes(world) ? hsr_fail_nomem(err) : HSR_OK;
}
