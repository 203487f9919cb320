/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The planes of a world's faces.
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
 * quadrilateral, it decides whether the four vertices are coplanar.
 *
 * Spans. The exact plane of a flat face takes as long as the face has corners,
 * and it may be asked for as often as there are other faces. So three corners
 * far from one another stand for many. Doubles choose them, and exact numbers
 * check that their normal is not zero and which way it points. */
#include "common/scene/planes.h"
#include "common/base/numbers.h"
#include "common/base/share.h"

#include <float.h>
#include <math.h>
#include <stdatomic.h>
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

/* Newell's normal of a triangle, from V_0 to p and q, and the sizes of its
 * terms. Its sums have one term, so it is rounded as by hsr_newell_add. */
static void cross(const double p[3], const double q[3], double normal[3],
                  double size[3]) {
  for (int a = 0, b = 1, c = 2; a < 3; a++, b = (b + 1) % 3, c = (c + 1) % 3) {
    double plus = p[b] * q[c], minus = p[c] * q[b];
    normal[a] = plus - minus;
    size[a] = fabs(plus) + fabs(minus);
  }
}

static bool triangle_has_normal(const struct hsr_loop *face) {
  const double *const at[3] = {face->x, face->y, face->z};
  size_t first = (size_t)face->stride * face->vertex[0],
         second = (size_t)face->stride * face->vertex[1],
         third = (size_t)face->stride * face->vertex[2];
  double p[3], q[3], normal[3], size[3], most = 0;
  for (int a = 0; a < 3; a++) {
    p[a] = at[a][second] - at[a][first];
    q[a] = at[a][third] - at[a][first];
  }
  cross(p, q, normal, size);
  for (int a = 0; a < 3; a++)
    most = hsr_max(most, fabs(normal[a]));
  return most > normal_error(3, size);
}

bool hsr_has_normal_for_certain(const struct hsr_loop *face) {
  if (face->n == 3)
    return triangle_has_normal(face);
  struct hsr_newell plane = {.n = 0};
  for (uint32_t k = 0; k < face->n; k++) {
    size_t at = (size_t)face->stride * face->vertex[k];
    hsr_newell_add(&plane, (double[]){face->x[at], face->y[at], face->z[at]});
  }
  double most = hsr_max(fabs(plane.normal[0]),
                        hsr_max(fabs(plane.normal[1]), fabs(plane.normal[2])));
  return most > normal_error(plane.n, plane.size);
}

/* What find_plane finds for a triangle, rounded alike; the anchor is V_0. */
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
  cross(p, q, normal, size);
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

static enum hsr_status check_vertices(const struct hsr_mesh *mesh,
                                      struct hsr_error *err) {
  for (uint32_t v = 0; v < mesh->n_vertices; v++)
    if (!(fabs(mesh->x[v]) <= 1e30 && fabs(mesh->y[v]) <= 1e30 &&
          fabs(mesh->z[v]) <= 1e30))
      return hsr_fail(err, HSR_E_INPUT,
                      "an instance takes a vertex out of range (above 1e30)");
  return HSR_OK;
}

/* Whether face f, whose plane is found, has no area in its instance. */
static bool has_no_area(const struct hsr_world *world, uint32_t f,
                        bool *out_of_memory) {
  return hsr_largest_normal(&world->mesh, f) <= world->mesh.n_error[f] &&
         !hsr_exact_has_normal(hsr_face_loop(world, f), out_of_memory);
}

enum { RANGE = 4096 }; /* faces that a thread takes at a time */
struct finding {
  struct hsr_world *world;
  atomic_bool out_of_memory;
};

/* Finds the planes of some faces. The first of no area, or `to`. */
static uint32_t find_range(void *context, uint32_t from, uint32_t to) {
  struct finding *finding = context;
  bool out_of_memory = false;
  uint32_t bad = to;
  for (uint32_t f = from; f < to; f++) {
    hsr_world_find_plane(finding->world, f, &out_of_memory);
    if (bad == to && has_no_area(finding->world, f, &out_of_memory))
      bad = f;
  }
  if (out_of_memory)
    atomic_store(&finding->out_of_memory, true);
  return bad;
}

/* Finds the planes of all faces, and checks that those of every instance are
 * still valid. */
static enum hsr_status find_all(struct hsr_world *world,
                                struct hsr_error *err) {
  struct finding finding = {.world = world};
  const struct hsr_scene *scene = world->roster.scene;
  enum hsr_status status = check_vertices(&world->mesh, err);
  if (status)
    return status;
  uint32_t f = hsr_share_search(scene->threads, world->n_faces, RANGE,
                                find_range, &finding);
  if (atomic_load(&finding.out_of_memory))
    return hsr_fail_nomem(err);
  if (f == world->n_faces)
    return HSR_OK;
  return hsr_fail(err, HSR_E_INPUT,
                  "object %s: an instance takes the area of face id %u to zero",
                  scene->objects[world->mesh.object[f]].name, f);
}

void hsr_world_find_plane(struct hsr_world *world, uint32_t f,
                          bool *out_of_memory) {
  find_plane(world, f);
  world->mesh.deviation[f] = find_deviation(world, f, out_of_memory);
}

/* --- Spans ---------------------------------------------------------------- */

/* From vertex v to vertex w. */
static void way_to(const struct hsr_mesh *mesh, uint32_t v, uint32_t w,
                   double way[3]) {
  way[0] = mesh->x[w] - mesh->x[v];
  way[1] = mesh->y[w] - mesh->y[v];
  way[2] = mesh->z[w] - mesh->z[v];
}

static double sum_of_squares(const double v[3]) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

/* Finds a span of face f, which is flat. False if doubles do not lead to one.
 */
static bool find_span(const struct hsr_world *world, uint32_t f,
                      struct hsr_span *span, bool *out_of_memory) {
  const struct hsr_mesh *mesh = &world->mesh;
  const uint32_t *vertex = mesh->vertex + mesh->start[f];
  uint32_t n = hsr_face_size(world, f), *v = span->vertex;
  span->face = f;
  v[0] = v[1] = v[2] = vertex[0];
  double way[3], side[3], most = 0;
  for (uint32_t k = 1; k < n; k++) {
    way_to(mesh, v[0], vertex[k], way);
    if (sum_of_squares(way) > most) {
      most = sum_of_squares(way);
      v[1] = vertex[k];
    }
  }
  way_to(mesh, v[0], v[1], side);
  most = 0;
  for (uint32_t k = 1; k < n; k++) {
    double normal[3], size[3];
    way_to(mesh, v[0], vertex[k], way);
    cross(side, way, normal, size);
    if (sum_of_squares(normal) > most) {
      most = sum_of_squares(normal);
      v[2] = vertex[k];
    }
  }
  const double normal[3] = {fabs(mesh->nx[f]), fabs(mesh->ny[f]),
                            fabs(mesh->nz[f])};
  int axis = normal[0] >= normal[1] && normal[0] >= normal[2] ? 0
             : normal[1] >= normal[2]                         ? 1
                                                              : 2;
  struct hsr_loop three = hsr_face_loop(world, f);
  three.vertex = v;
  three.n = 3;
  int own = hsr_exact_normal_sign(hsr_face_loop(world, f), axis, out_of_memory),
      found = hsr_exact_normal_sign(three, axis, out_of_memory);
  if (own && found == -own) {
    uint32_t swapped = v[1];
    v[1] = v[2];
    v[2] = swapped;
  }
  return own && found;
}

/* Finds the spans of all flat faces with many corners. HSR_E_NOMEM. */
static enum hsr_status find_spans(struct hsr_world *world) {
  struct hsr_mesh *mesh = &world->mesh;
  bool out_of_memory = false;
  uint32_t n = 0;
  for (uint32_t f = 0; f < world->n_faces; f++)
    n += hsr_face_size(world, f) > HSR_SMALL_FACE && mesh->deviation[f] == 0;
  mesh->span = n ? HSR_NEW(&world->arena, struct hsr_span, n) : NULL;
  if (n && !mesh->span)
    return HSR_E_NOMEM;
  for (uint32_t f = 0; n && f < world->n_faces; f++)
    if (hsr_face_size(world, f) > HSR_SMALL_FACE && mesh->deviation[f] == 0)
      mesh->n_spans +=
          find_span(world, f, &mesh->span[mesh->n_spans], &out_of_memory);
  return out_of_memory ? HSR_E_NOMEM : HSR_OK;
}

struct hsr_loop hsr_spanning_loop(const struct hsr_world *world, uint32_t f) {
  struct hsr_loop loop = hsr_face_loop(world, f);
  if (loop.n <= HSR_SMALL_FACE)
    return loop;
  const struct hsr_span *span = world->mesh.span;
  uint32_t k = 0, end = world->mesh.n_spans;
  while (k <
         end) { /* all before k are of lesser faces, from end on of others */
    uint32_t middle = k + (end - k) / 2;
    if (span[middle].face < f)
      k = middle + 1;
    else
      end = middle;
  }
  if (k < world->mesh.n_spans && span[k].face == f) {
    loop.vertex = span[k].vertex;
    loop.n = 3;
  }
  return loop;
}

enum hsr_status hsr_world_find_planes(struct hsr_world *world,
                                      struct hsr_error *err) {
  enum hsr_status status = find_all(world, err);
  if (status)
    return status;
  return hsr_world_classify_planes(world) || find_spans(world)
             ? hsr_fail_nomem(err)
             : HSR_OK;
}
