/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Expanding a scene, and the planes of its faces.
 *
 * Source      Newell's plane equation: Sutherland et al. 1974, eq. 6.
 * Notation    u = 2^-53; a hat marks a computed value; d_i = V_i - V_0.
 *
 * Error of N. With V_0 as origin Newell's normal is the sum of
 * d_i x d_{i+1}, i = 1 .. k-2. A product of two differences carries three
 * roundings (1 + u)^3; a component sums 2(k - 2) of them, in at most 2(k - 2)
 * additions. With P the largest component of the sum of |d_iy d_{i+1}z| +
 * |d_iz d_{i+1}y| (as computed, itself within (1 + u)^{2k} of its value) the
 * error of every component is at most (2k + 3) u P to first order; 4(k + 1) u P
 * is stored, which covers the higher orders for every k < 2^48. To it 2^-960 is
 * added, which covers underflow.
 *
 * Error of the anchor. The plane passes through the mean of the vertices, V_0 +
 * (sum of d_i) / k. Each d_i carries one rounding, the sum k - 2, the division
 * and the last addition one each: at most (k + 2) u times the largest of |V_0|
 * + sum |d_i| by components; twice that is stored. A triangle's plane passes
 * through V_0 itself, with no error.
 *
 * Deviation. N.(V - P) as computed carries the error of N over |V - P|_1, the
 * anchor's over |N|_1, and a rounding of the difference, three of the products
 * and sums; all are added, doubled. Where that leaves it open whether every
 * vertex is on the plane, the exact predicate tells; of a quadrilateral,
 * whether its four vertices are coplanar. */
#include "common/scene/world.h"
#include "common/scene/pieces.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double U = DBL_EPSILON / 2;
static const double TINY = 0x1p-960;

enum hsr_status hsr_world_allocate(struct hsr_world *world,
                                   struct hsr_arena *arena) {
  size_t nv = world->n_vertices, nf = world->n_faces, nc = world->n_corners;
  world->x = HSR_NEW(arena, double, nv);
  world->y = HSR_NEW(arena, double, nv);
  world->z = HSR_NEW(arena, double, nv);
  world->start = HSR_NEW(arena, uint32_t, nf + 1);
  world->vertex = HSR_NEW(arena, uint32_t, nc);
  world->object = HSR_NEW(arena, uint32_t, nf);
  world->instance = HSR_NEW(arena, uint32_t, nf);
  world->one_sided = HSR_NEW(arena, bool, nf);
  if (!world->first)
    world->first =
        HSR_NEW(arena, uint32_t, (size_t)world->scene->n_instances + 1);
  world->nx = HSR_NEW(arena, double, nf);
  world->ny = HSR_NEW(arena, double, nf);
  world->nz = HSR_NEW(arena, double, nf);
  world->n_error = HSR_NEW(arena, double, nf);
  world->px = HSR_NEW(arena, double, nf);
  world->py = HSR_NEW(arena, double, nf);
  world->pz = HSR_NEW(arena, double, nf);
  world->anchor_error = HSR_NEW(arena, double, nf);
  world->deviation = HSR_NEW(arena, double, nf);
  world->plane = HSR_NEW(arena, uint32_t, nf);
  bool all = world->x && world->y && world->z && world->start &&
             world->vertex && world->object && world->instance &&
             world->one_sided && world->first && world->nx && world->ny &&
             world->nz && world->n_error && world->px && world->py &&
             world->pz && world->anchor_error && world->deviation &&
             world->plane;
  return all ? HSR_OK : HSR_E_NOMEM;
}

/* Counts the faces, and numbers them by instances. */
static enum hsr_status number_faces(struct hsr_world *world,
                                    struct hsr_error *err) {
  const struct hsr_scene *scene = world->scene;
  world->first =
      HSR_NEW(&world->arena, uint32_t, (size_t)scene->n_instances + 1);
  if (!world->first)
    return hsr_fail_nomem(err);
  world->all_triangles = true;
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    const struct hsr_object *object =
        &scene->objects[scene->instances[i].object];
    world->first[i] = world->n_faces;
    world->n_faces += object->n_faces;
    if (object->start[object->n_faces] != 3 * (uint64_t)object->n_faces)
      world->all_triangles = false;
  }
  world->first[scene->n_instances] = world->n_faces;
  return HSR_OK;
}

/* Counts what the faces consist of. */
static enum hsr_status measure(struct hsr_world *world, struct hsr_error *err) {
  const struct hsr_scene *scene = world->scene;
  uint64_t nv = 0, nc = 0;
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    const struct hsr_object *object =
        &scene->objects[scene->instances[i].object];
    nv += object->n_vertices;
    nc += object->start[object->n_faces];
  }
  if (nv >= UINT32_MAX || nc >= UINT32_MAX)
    return hsr_fail(err, HSR_E_NOMEM,
                    "the scene is too large to be laid out: %u faces",
                    world->n_faces);
  world->n_vertices = (uint32_t)nv;
  world->n_corners = (uint32_t)nc;
  return HSR_OK;
}

/* Puts instance i at vertex v, face f, corner c of the arrays. */
static void expand_instance(struct hsr_world *world, uint32_t i, uint32_t v,
                            uint32_t f, uint32_t c) {
  const struct hsr_instance *instance = &world->scene->instances[i];
  const struct hsr_object *object = &world->scene->objects[instance->object];
  for (uint32_t k = 0; k < object->n_vertices; k++) {
    double p[3];
    hsr_instance_vertex(instance->m, object->xyz + 3 * (size_t)k, p);
    world->x[v + k] = p[0];
    world->y[v + k] = p[1];
    world->z[v + k] = p[2];
  }
  for (uint32_t k = 0; k < object->n_faces; k++) {
    world->start[f + k] = c + object->start[k];
    world->object[f + k] = instance->object;
    world->instance[f + k] = i;
    world->one_sided[f + k] = object->one_sided;
  }
  for (uint32_t k = 0; k < object->start[object->n_faces]; k++)
    world->vertex[c + k] = v + object->vertex[k];
}

static void expand(struct hsr_world *world) {
  const struct hsr_scene *scene = world->scene;
  uint32_t v = 0, f = 0, c = 0;
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    const struct hsr_object *object =
        &scene->objects[scene->instances[i].object];
    expand_instance(world, i, v, f, c);
    v += object->n_vertices;
    f += object->n_faces;
    c += object->start[object->n_faces];
  }
  world->start[f] = c;
}

/* Newell's plane, vertex by vertex; the first is the origin. */
struct newell {
  uint32_t n; /* vertices so far */
  double first[3], previous[3];
  double normal[3], size[3]; /* and the sum of what it is a sum of, positive */
  double sum[3], reach[3];   /* of the vertices; and the same */
};

static void newell_add(struct newell *plane, const double v[3]) {
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

/* A point of the plane: the mean of the vertices, or of a triangle the first.
 */
static void newell_anchor(const struct newell *plane, double anchor[3]) {
  for (int a = 0; a < 3; a++)
    anchor[a] = plane->n == 3 ? plane->first[a]
                              : plane->first[a] + plane->sum[a] / plane->n;
}

/* Newell's normal and the anchor of face f, with their errors. */
static void find_plane(struct hsr_world *world, uint32_t f) {
  struct newell plane = {.n = 0};
  for (uint32_t c = world->start[f]; c < world->start[f + 1]; c++) {
    uint32_t v = world->vertex[c];
    newell_add(&plane, (double[]){world->x[v], world->y[v], world->z[v]});
  }
  double anchor[3];
  newell_anchor(&plane, anchor);
  double p = fmax(plane.size[0], fmax(plane.size[1], plane.size[2]));
  double r = fmax(plane.reach[0], fmax(plane.reach[1], plane.reach[2]));
  world->nx[f] = plane.normal[0];
  world->ny[f] = plane.normal[1];
  world->nz[f] = plane.normal[2];
  world->n_error[f] = 4 * (plane.n + 1.0) * U * p + TINY;
  world->px[f] = anchor[0];
  world->py[f] = anchor[1];
  world->pz[f] = anchor[2];
  world->anchor_error[f] =
      plane.n == 3 ? 0 : 2 * (plane.n + 2.0) * U * r + TINY;
}

/* An upper bound of |N . (V - P)| over the vertices of face f. */
static double find_deviation(const struct hsr_world *world, uint32_t f,
                             bool *out_of_memory) {
  if (hsr_face_size(world, f) == 3)
    return 0;
  bool may_be_flat = true;
  const double n[3] = {world->nx[f], world->ny[f], world->nz[f]};
  double n1 = fabs(n[0]) + fabs(n[1]) + fabs(n[2]), largest = 0;
  for (uint32_t k = world->start[f]; k < world->start[f + 1]; k++) {
    uint32_t v = world->vertex[k];
    double r[3] = {world->x[v] - world->px[f], world->y[v] - world->py[f],
                   world->z[v] - world->pz[f]};
    double r1 = fabs(r[0]) + fabs(r[1]) + fabs(r[2]);
    double error = 2 * (world->n_error[f] * r1 + world->anchor_error[f] * n1) +
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
  return fmax(fabs(world->nx[f]), fmax(fabs(world->ny[f]), fabs(world->nz[f])));
}

/* What an instance made of the object's faces must still be faces. */
static enum hsr_status check(const struct hsr_world *world,
                             struct hsr_error *err) {
  for (uint32_t v = 0; v < world->n_vertices; v++)
    if (!(fabs(world->x[v]) <= 1e30 && fabs(world->y[v]) <= 1e30 &&
          fabs(world->z[v]) <= 1e30))
      return hsr_fail(err, HSR_E_INPUT,
                      "an instance takes a vertex out of range (above 1e30)");
  bool out_of_memory = false;
  for (uint32_t f = 0; f < world->n_faces; f++)
    if (largest_normal(world, f) <= world->n_error[f] &&
        !hsr_exact_has_normal(hsr_face_loop(world, f), &out_of_memory))
      return hsr_fail(
          err, HSR_E_INPUT,
          "object %s: an instance takes the area of face id %u to zero",
          world->scene->objects[world->object[f]].name, f);
  return out_of_memory ? hsr_fail_nomem(err) : HSR_OK;
}

/* --- Equal planes --------------------------------------------------------- */

/* A number that equal planes share: a fixed generic linear form in the unit
 * normal and the distance, without its sign, known to lie in [lo, hi]. */
struct plane_key {
  double lo, hi;
  uint32_t face;
};

/* Error of the key: the unit normal is off by at most 2 sqrt(3) n_error/|N| +
 * 4u in each component, the distance by that times the anchor's size plus the
 * anchor's error and three roundings; the form's coefficients are below 1. All
 * is doubled. */
static struct plane_key plane_key(const struct hsr_world *world, uint32_t f) {
  double n[3] = {world->nx[f], world->ny[f], world->nz[f]};
  double p[3] = {world->px[f], world->py[f], world->pz[f]};
  double scale = largest_normal(world, f);
  for (int k = 0; k < 3; k++)
    n[k] /= scale;
  double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  double reach = fabs(p[0]) + fabs(p[1]) + fabs(p[2]);
  double d = (n[0] * p[0] + n[1] * p[1] + n[2] * p[2]) / length;
  double key = fabs((0.5432 * n[0] + 0.8107 * n[1] + 0.3219 * n[2]) / length +
                    0.6173 * d);
  double turn = 4 * (world->n_error[f] / (scale * length)) + 8 * U;
  double error =
      8 * (turn * (1 + reach) + world->anchor_error[f]) + 16 * U * (1 + key);
  if (!(error < INFINITY)) /* the normal is lost: compare with all */
    return (struct plane_key){-INFINITY, INFINITY, f};
  return (struct plane_key){key - error, key + error, f};
}

static int compare_keys(const void *a, const void *b) {
  const struct plane_key *k = a, *l = b;
  if (k->lo != l->lo)
    return k->lo < l->lo ? -1 : 1;
  return (k->face > l->face) - (k->face < l->face);
}

/* Cheap, and certain when it says no: whether the normals may be parallel. */
static bool maybe_parallel(const struct hsr_world *world, uint32_t f,
                           uint32_t g) {
  double a[3] = {world->nx[f], world->ny[f], world->nz[f]};
  double b[3] = {world->nx[g], world->ny[g], world->nz[g]};
  double fa = largest_normal(world, f), fb = largest_normal(world, g);
  double error = 4 * (fa * world->n_error[g] + fb * world->n_error[f] +
                      world->n_error[f] * world->n_error[g]) +
                 8 * U * fa * fb;
  for (int i = 0, j = 1; i < 3; i++, j = (j + 1) % 3)
    if (fabs(a[i] * b[j] - a[j] * b[i]) > error)
      return false;
  return true;
}

/* Sweeps over the keys: a plane is compared with those whose intervals reach
 * into its own, one representative a class. */
static enum hsr_status classify_planes(struct hsr_world *world) {
  uint32_t n = world->n_faces, n_open = 0;
  struct plane_key *key = malloc(n * sizeof *key);
  struct plane_key *open = malloc(n * sizeof *open);
  bool out_of_memory = !key || !open;
  for (uint32_t f = 0; f < n && !out_of_memory; f++)
    key[f] = plane_key(world, f);
  if (!out_of_memory)
    qsort(key, n, sizeof *key, compare_keys);
  world->n_planes = 0;
  for (uint32_t i = 0; i < n && !out_of_memory; i++) {
    uint32_t f = key[i].face, kept = 0, found = UINT32_MAX;
    for (uint32_t o = 0; o < n_open; o++) {
      if (open[o].hi < key[i].lo)
        continue; /* behind the sweep for good */
      open[kept] = open[o];
      uint32_t g = open[kept++].face;
      if (found == UINT32_MAX && maybe_parallel(world, f, g) &&
          hsr_exact_same_plane(hsr_face_loop(world, f), hsr_face_loop(world, g),
                               &out_of_memory)) {
        found = world->plane[g];
        open[kept - 1].hi = fmax(open[kept - 1].hi, key[i].hi);
      }
    }
    n_open = kept;
    if (found == UINT32_MAX) {
      found = world->n_planes++;
      open[n_open++] = key[i];
    }
    world->plane[f] = found;
  }
  free(key);
  free(open);
  return out_of_memory ? HSR_E_NOMEM : HSR_OK;
}

void hsr_world_find_plane(struct hsr_world *world, uint32_t f,
                          bool *out_of_memory) {
  find_plane(world, f);
  world->deviation[f] = find_deviation(world, f, out_of_memory);
}

/* Planes and what the algorithms assume, of faces that are laid out. */
static enum hsr_status finish(struct hsr_world *world, struct hsr_error *err) {
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

enum hsr_status hsr_world_init(struct hsr_world *world,
                               const struct hsr_scene *scene,
                               struct hsr_error *err) {
  enum hsr_status status = hsr_world_outline(world, scene, err);
  if (!status)
    status = measure(world, err);
  if (status)
    return status;
  if (hsr_world_allocate(world, &world->arena))
    return hsr_fail_nomem(err);
  expand(world);
  return finish(world, err);
}

void hsr_world_free(struct hsr_world *world) {
  hsr_arena_free(&world->arena);
}

/* --- Outlines ------------------------------------------------------------- */

enum hsr_status hsr_world_outline(struct hsr_world *world,
                                  const struct hsr_scene *scene,
                                  struct hsr_error *err) {
  *world = (struct hsr_world){.scene = scene};
  return number_faces(world, err);
}

enum hsr_status hsr_world_open(struct hsr_world *world,
                               const struct hsr_scene *scene, uint32_t most,
                               struct hsr_error *err) {
  uint64_t n = 0;
  for (uint32_t i = 0; i < scene->n_instances; i++)
    n += scene->objects[scene->instances[i].object].n_faces;
  return n <= most ? hsr_world_init(world, scene, err)
                   : hsr_world_outline(world, scene, err);
}

uint32_t hsr_instance_of(const struct hsr_world *world, uint32_t f) {
  uint32_t lo = 0,
           hi = world->scene->n_instances; /* first[lo] <= f < first[hi] */
  while (hi - lo > 1) {
    uint32_t middle = lo + (hi - lo) / 2;
    if (world->first[middle] <= f)
      lo = middle;
    else
      hi = middle;
  }
  return lo;
}

struct hsr_place hsr_place_of(const struct hsr_world *world, uint32_t id) {
  if (world->pieces)
    world = world->pieces->whole;
  uint32_t i = hsr_instance_of(world, id);
  return (struct hsr_place){
      &world->scene->objects[world->scene->instances[i].object], i,
      id - world->first[i]};
}

void hsr_place_plane(const struct hsr_world *world, struct hsr_place place,
                     double normal[3], double anchor[3]) {
  const struct hsr_object *object = place.object;
  const double *m = world->scene->instances[place.instance].m;
  struct newell plane = {.n = 0};
  for (uint32_t c = object->start[place.face];
       c < object->start[place.face + 1]; c++) {
    double p[3];
    hsr_instance_vertex(m, object->xyz + 3 * (size_t)object->vertex[c], p);
    newell_add(&plane, p);
  }
  memcpy(normal, plane.normal, sizeof plane.normal);
  newell_anchor(&plane, anchor);
}

static uint32_t size_of(const struct hsr_place *at) {
  return at->object->start[at->face + 1] - at->object->start[at->face];
}

void hsr_world_lay_out(struct hsr_world *out, uint32_t f) {
  struct hsr_place at = hsr_place_of(out, out->id[f]);
  const struct hsr_instance *instance = &out->scene->instances[at.instance];
  const uint32_t *vertex = at.object->vertex + at.object->start[at.face];
  out->start[f + 1] = out->start[f] + size_of(&at);
  for (uint32_t c = out->start[f]; c < out->start[f + 1]; c++, vertex++) {
    double p[3];
    hsr_instance_vertex(instance->m, at.object->xyz + 3 * (size_t)*vertex, p);
    out->x[c] = p[0];
    out->y[c] = p[1];
    out->z[c] = p[2];
    out->vertex[c] = c;
  }
  out->object[f] = instance->object;
  out->instance[f] = at.instance;
  out->one_sided[f] = at.object->one_sided;
}

enum hsr_status hsr_world_extract(struct hsr_world *out,
                                  const struct hsr_world *world,
                                  const uint32_t *id, uint32_t n,
                                  struct hsr_error *err) {
  *out = (struct hsr_world){.scene = world->scene,
                            .n_faces = n,
                            .first = world->first,
                            .id = id,
                            .all_triangles = true};
  for (uint32_t f = 0; f < n; f++) {
    struct hsr_place at = hsr_place_of(world, id[f]);
    out->n_corners += size_of(&at);
    out->all_triangles &= size_of(&at) == 3;
  }
  out->n_vertices = out->n_corners;
  if (hsr_world_allocate(out, &out->arena))
    return hsr_fail_nomem(err);
  out->start[0] = 0;
  for (uint32_t f = 0; f < n; f++)
    hsr_world_lay_out(out, f);
  return finish(out, err);
}
