/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Making groups. How far boxes, axes, angles and apexes must be rounded outward
 * is proved in groups.c; the names of numbers are those of the proof. */
#include "algorithms/brute_force/zbuffer_fast/groups.h"
#include "common/base/numbers.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

static const double U = DBL_EPSILON / 2;
static const double TINY = 0x1p-960;

enum { SIZE = 32 /* triangles of a group */ };

/* --- Putting triangles into groups ---------------------------------------- */

/* A triangle on its way into a group: three times its centre, and its normal. */
struct item {
  float key[6];
  uint32_t face;
};

/* How much a difference of normals, of all that there is, counts beside the
 * length of a box. */
static const float NORMALS = 4;

static void make_item(const struct hsr_world *world, uint32_t f,
                      struct item *item) {
  const struct hsr_mesh *mesh = &world->mesh;
  const double *const at[3] = {mesh->x, mesh->y, mesh->z};
  const double normal[3] = {mesh->nx[f], mesh->ny[f], mesh->nz[f]};
  double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] +
                       normal[2] * normal[2]);
  item->face = f;
  for (int k = 0; k < 3; k++) {
    item->key[k] = 0;
    for (uint32_t c = 0; c < 3; c++)
      item->key[k] += (float)at[k][mesh->vertex[3 * (size_t)f + c]];
    item->key[3 + k] = length > 0 ? (float)(normal[k] / length) : 0;
  }
}

/* By which key n items are divided: that in which they differ most. */
static int choose_key(const struct item *item, size_t n) {
  float lo[6], hi[6], size = 0, most = -1;
  memcpy(lo, item->key, sizeof lo);
  memcpy(hi, item->key, sizeof hi);
  for (size_t i = 1; i < n; i++)
    for (int k = 0; k < 6; k++) {
      float x = item[i].key[k];
      lo[k] = x < lo[k] ? x : lo[k];
      hi[k] = x > hi[k] ? x : hi[k];
    }
  int best = 0;
  for (int k = 0; k < 6; k++) {
    float length = hi[k] - lo[k];
    size = k < 3 && length > size ? length : size;
    length *= k < 3 ? 1 : NORMALS * size;
    best = length > most ? k : best;
    most = length > most ? length : most;
  }
  return best;
}

/* Parts n > 1 items, by Hoare's method, into so many with keys that are at most
 * some value and others with keys that are at least that. */
static size_t part(struct item *item, size_t n, int key) {
  float a = item[0].key[key], b = item[(n - 1) / 2].key[key],
        c = item[n - 1].key[key];
  float middle = a < b ? (b < c   ? b
                          : a < c ? c
                                  : a)
                       : (a < c   ? a
                          : b < c ? c
                                  : b);
  size_t i = 0, j = n - 1;
  while (true) { /* what has the middle key stops both */
    while (item[i].key[key] < middle)
      i++;
    while (item[j].key[key] > middle)
      j--;
    if (i >= j)
      return j + 1;
    struct item moved = item[i];
    item[i++] = item[j];
    item[j--] = moved;
  }
}

/* Moves the `left` items with the least keys before the others. */
static void divide(struct item *item, size_t n, size_t left, int key) {
  while (n > 1 && left > 0) {
    size_t lower = part(item, n, key);
    if (left < lower) {
      n = lower;
    } else {
      item += lower;
      n -= lower;
      left -= lower;
    }
  }
}

static int compare_faces(const void *a, const void *b) {
  uint32_t f = ((const struct item *)a)->face,
           g = ((const struct item *)b)->face;
  return (f > g) - (f < g);
}

/* Divides n items, and their halves, until each part is a group. */
static void divide_all(struct item *item, size_t n) {
  while (n > SIZE) {
    size_t groups = (n + SIZE - 1) / SIZE, left = groups / 2 * SIZE;
    divide(item, n, left, choose_key(item, n));
    divide_all(item, left);
    item += left;
    n -= left;
  }
  qsort(item, n, sizeof *item, compare_faces);
}

/* The triangles in their new order: fills what is told of groups by numbers. */
static void fill_list(struct hsr_groups *g, const struct hsr_world *world,
                      const struct item *item) {
  const struct hsr_mesh *mesh = &world->mesh;
  for (uint32_t k = 0; k < world->n_faces; k++) {
    uint32_t f = item[k].face;
    memcpy(g->list.vertex + 3 * (size_t)k, mesh->vertex + 3 * (size_t)f,
           3 * sizeof *g->list.vertex);
    g->list.face[k] = f;
    g->list.one_sided[k] = mesh->one_sided[f];
  }
}

/* The sizes of the groups that `divide_all` makes, in their order. */
static void cut(struct hsr_groups *g, uint32_t begin, uint32_t end) {
  while (end - begin > SIZE) {
    uint32_t left = (end - begin + SIZE - 1) / SIZE / 2 * SIZE;
    cut(g, begin, begin + left);
    begin += left;
  }
  g->first[g->n++] = begin;
}

/* Renumbers the vertices as the groups first have them. owner[] tells whose a
 * vertex is, by its new number; number[] is UINT32_MAX at first. */
static void number_vertices(struct hsr_groups *g, const struct hsr_mesh *mesh,
                            uint32_t *number, uint32_t *owner) {
  uint32_t n = 0;
  for (uint32_t k = 0; k < g->n; k++) {
    g->first_vertex[k] = n;
    for (size_t c = 3 * (size_t)g->first[k]; c < 3 * (size_t)g->first[k + 1];
         c++) {
      uint32_t v = g->list.vertex[c];
      if (number[v] == UINT32_MAX) {
        g->x[n] = mesh->x[v];
        g->y[n] = mesh->y[v];
        g->z[n] = mesh->z[v];
        owner[n] = k;
        number[v] = n++;
      }
      g->list.vertex[c] = number[v];
    }
  }
  g->first_vertex[g->n] = n;
}

/* The groups before group k whose vertices it has, each once: into near[], unless
 * that is NULL. met[] tells where a group was met last. Returns how many. */
static uint32_t find_near(const struct hsr_groups *g, uint32_t k,
                          const uint32_t *owner, uint32_t *met,
                          uint32_t *near) {
  uint32_t n = 0;
  for (size_t c = 3 * (size_t)g->first[k]; c < 3 * (size_t)g->first[k + 1];
       c++) {
    uint32_t of = owner[g->list.vertex[c]];
    if (of == k || met[of] == k)
      continue;
    met[of] = k;
    if (near)
      near[n] = of;
    n++;
  }
  return n;
}

static enum hsr_status find_all_near(struct hsr_groups *g,
                                     const uint32_t *owner, uint32_t *met) {
  g->first_near[0] = 0;
  for (int pass = 0; pass < 2; pass++) {
    memset(met, 0xff, g->n * sizeof *met);
    for (uint32_t k = 0; k < g->n; k++) {
      uint32_t *near = pass ? g->near + g->first_near[k] : NULL;
      g->first_near[k + 1] =
          g->first_near[k] + find_near(g, k, owner, met, near);
    }
    if (!pass)
      g->near = HSR_NEW(&g->arena, uint32_t, g->first_near[g->n]);
    if (!g->near)
      return HSR_E_NOMEM;
  }
  return HSR_OK;
}

/* --- Boxes and cones ------------------------------------------------------ */

static void find_box(struct hsr_groups *g, uint32_t k) {
  const double *const at[3] = {g->x, g->y, g->z};
  for (int a = 0; a < 3; a++) {
    double lo = INFINITY, hi = -INFINITY;
    for (size_t c = 3 * (size_t)g->first[k]; c < 3 * (size_t)g->first[k + 1];
         c++) {
      double x = at[a][g->list.vertex[c]];
      lo = hsr_min(lo, x);
      hi = hsr_max(hi, x);
    }
    g->lo[a][k] = lo;
    g->hi[a][k] = hi;
    g->bounds.lo[a] = hsr_min(g->bounds.lo[a], lo);
    g->bounds.hi[a] = hsr_max(g->bounds.hi[a], hi);
  }
}

/* A sum of three products, and of their sizes. */
struct sum {
  double value, size;
};

static struct sum dot(const double a[3], const double b[3]) {
  double x = a[0] * b[0], y = a[1] * b[1], z = a[2] * b[2];
  return (struct sum){x + y + z, fabs(x) + fabs(y) + fabs(z)};
}

static void normal_of(const struct hsr_mesh *mesh, uint32_t f, double n[3]) {
  n[0] = mesh->nx[f];
  n[1] = mesh->ny[f];
  n[2] = mesh->nz[f];
}

/* A mean of the group's normals. False if there is none, or a triangle has two
 * sides. */
static bool find_axis(const struct hsr_groups *g, uint32_t k,
                      const struct hsr_mesh *mesh, double axis[3]) {
  double mean[3] = {0};
  for (uint32_t t = g->first[k]; t < g->first[k + 1]; t++) {
    double n[3];
    normal_of(mesh, g->list.face[t], n);
    double length = sqrt(dot(n, n).value);
    if (!g->list.one_sided[t] || !(length > 0x1p-480))
      return false;
    for (int a = 0; a < 3; a++)
      mean[a] += n[a] / length;
  }
  double length = sqrt(dot(mean, mean).value);
  for (int a = 0; a < 3; a++)
    axis[a] = mean[a] / length;
  return length > 0x1p-10;
}

/* c of the proof. */
static double least_cosine(const struct hsr_groups *g, uint32_t k,
                           const struct hsr_mesh *mesh, const double axis[3]) {
  double least = 1;
  for (uint32_t t = g->first[k]; t < g->first[k + 1]; t++) {
    uint32_t f = g->list.face[t];
    double n[3];
    normal_of(mesh, f, n);
    double length = sqrt(dot(n, n).value);
    least = hsr_min(least, dot(n, axis).value / length -
                               4 * mesh->n_error[f] / length - 0x1p-40);
  }
  return least;
}

/* t of the proof: how far the apex lies behind `centre`. */
static double find_depth(const struct hsr_groups *g, uint32_t k,
                         const struct hsr_mesh *mesh, const double axis[3],
                         const double centre[3]) {
  double depth = 0, size = 0;
  for (uint32_t t = g->first[k]; t < g->first[k + 1]; t++) {
    uint32_t f = g->list.face[t];
    double n[3], e = mesh->n_error[f],
                 r[3] = {mesh->px[f] - centre[0], mesh->py[f] - centre[1],
                         mesh->pz[f] - centre[2]};
    normal_of(mesh, f, n);
    struct sum off = dot(n, r), along = dot(n, axis);
    double above = -off.value + 16 * U * off.size + TINY +
                   2 * e * (fabs(r[0]) + fabs(r[1]) + fabs(r[2]));
    double steep = along.value - 16 * U * along.size - TINY -
                   2 * e * (fabs(axis[0]) + fabs(axis[1]) + fabs(axis[2]));
    depth = hsr_max(depth, above / steep);
  }
  for (int a = 0; a < 3; a++)
    size = hsr_max(size, fabs(centre[a]));
  return depth * (1 + 0x1p-40) + 0x1p-45 * size + 0x1p-900;
}

static void find_cone(struct hsr_groups *g, uint32_t k,
                      const struct hsr_mesh *mesh) {
  double axis[3], centre[3], c = 0;
  for (int a = 0; a < 3; a++) {
    g->apex[a][k] = g->axis[a][k] = 0;
    centre[a] = g->lo[a][k] / 2 + g->hi[a][k] / 2;
  }
  g->sine2[k] = INFINITY;
  if (find_axis(g, k, mesh, axis))
    c = least_cosine(g, k, mesh, axis);
  if (!(c >= 1.0 / 16))
    return;
  double depth = find_depth(g, k, mesh, axis, centre);
  double sine = sqrt(1 - c * c) + 0x1p-40;
  for (int a = 0; a < 3; a++) {
    g->apex[a][k] = centre[a] - depth * axis[a];
    g->axis[a][k] = axis[a];
  }
  g->sine2[k] = sine * sine;
}

/* --- Making them ---------------------------------------------------------- */

static enum hsr_status allocate(struct hsr_groups *g, uint32_t n_faces,
                                uint32_t n_vertices) {
  struct hsr_arena *arena = &g->arena;
  size_t n = (size_t)(n_faces + SIZE - 1) / SIZE;
  bool all = true;
  g->first = HSR_NEW(arena, uint32_t, n + 1);
  g->first_vertex = HSR_NEW(arena, uint32_t, n + 1);
  g->first_near = HSR_NEW(arena, uint32_t, n + 1);
  g->sine2 = HSR_NEW(arena, double, n);
  for (int a = 0; a < 3; a++) {
    g->lo[a] = HSR_NEW(arena, double, n);
    g->hi[a] = HSR_NEW(arena, double, n);
    g->apex[a] = HSR_NEW(arena, double, n);
    g->axis[a] = HSR_NEW(arena, double, n);
    all &= g->lo[a] && g->hi[a] && g->apex[a] && g->axis[a];
  }
  g->list.vertex = HSR_NEW(arena, uint32_t, 3 * (size_t)n_faces);
  g->list.face = HSR_NEW(arena, uint32_t, n_faces);
  g->list.one_sided = HSR_NEW(arena, bool, n_faces);
  g->x = HSR_NEW(arena, double, n_vertices);
  g->y = HSR_NEW(arena, double, n_vertices);
  g->z = HSR_NEW(arena, double, n_vertices);
  return all && g->first && g->first_vertex && g->first_near && g->sine2 &&
                 g->list.vertex && g->list.face && g->list.one_sided && g->x &&
                 g->y && g->z
             ? HSR_OK
             : HSR_E_NOMEM;
}

/* The same with memory that is given back at the end. */
static enum hsr_status make(struct hsr_groups *g, const struct hsr_world *world,
                            struct hsr_arena *scratch) {
  uint32_t n = world->n_faces, n_vertices = world->mesh.n_vertices;
  struct item *item = HSR_NEW(scratch, struct item, n);
  uint32_t *number = HSR_NEW(scratch, uint32_t, n_vertices);
  uint32_t *owner = HSR_NEW(scratch, uint32_t, n_vertices);
  if (!item || !number || !owner || allocate(g, n, n_vertices))
    return HSR_E_NOMEM;
  for (uint32_t f = 0; f < n; f++)
    make_item(world, f, &item[f]);
  divide_all(item, n);
  fill_list(g, world, item);
  cut(g, 0, n);
  g->first[g->n] = n;
  memset(number, 0xff, n_vertices * sizeof *number);
  number_vertices(g, &world->mesh, number, owner);
  uint32_t *met = HSR_NEW(scratch, uint32_t, g->n);
  if (!met || find_all_near(g, owner, met))
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < g->n; k++) {
    find_box(g, k);
    find_cone(g, k, &world->mesh);
  }
  return HSR_OK;
}

enum hsr_status hsr_groups_make(struct hsr_groups *g,
                                const struct hsr_world *world) {
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  *g = (struct hsr_groups){.arena = HSR_ARENA_EMPTY,
                           .bounds = {{INFINITY, INFINITY, INFINITY},
                                      {-INFINITY, -INFINITY, -INFINITY}}};
  enum hsr_status status = make(g, world, &scratch);
  hsr_arena_free(&scratch);
  return status;
}
