/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/cubes/cube_objects.h"
#include "algorithms/engines/cubes/cube_cells.h"
#include "common/base/numbers.h"
#include "common/base/share.h"
#include "common/exact/predicates.h"
#include "common/trees/grain.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* Faces of an object that one thread takes whole. Of more, an octree is made by
 * several (common/trees/octree_shared.c). */
enum { SMALL = 2048 };

/* --- Which faces are loose, and which are fans ------------------------------ */

/* Twice the area is the length of Newell's normal. */
static void face_normal(const struct hsr_loop *loop, double normal[3]) {
  const double *o = loop->x + 3 * (size_t)loop->vertex[0];
  memset(normal, 0, 3 * sizeof *normal);
  for (uint32_t c = 1; c + 1 < loop->n; c++) {
    const double *a = loop->x + 3 * (size_t)loop->vertex[c];
    const double *b = loop->x + 3 * (size_t)loop->vertex[c + 1];
    for (int k = 0, l = 1, m = 2; k < 3; k++, l = (l + 1) % 3, m = (m + 1) % 3)
      normal[k] +=
          (a[l] - o[l]) * (b[m] - o[m]) - (a[m] - o[m]) * (b[l] - o[l]);
  }
}

/* The sign of the turn at b, on the way from a to c, in two coordinates of each.
 * 0: doubles do not tell. The differences, products and sum are rounded five
 * times, by 2^-53 of the larger term each time. */
static int turn(const double *a, const double *b, const double *c, int x,
                int y) {
  double left = (b[x] - a[x]) * (c[y] - b[y]);
  double right = (b[y] - a[y]) * (c[x] - b[x]);
  double turn = left - right, least = 0x1p-50 * (fabs(left) + fabs(right));
  return !(fabs(turn) > least + 0x1p-1000) ? 0 : turn > 0 ? 1 : -1;
}

/* Is a flat face convex for certain, with no corner on the line of its
 * neighbours? All turns have one sign, and the way around changes twice between
 * left and right: so it goes around once. */
static bool is_convex(struct hsr_loop loop, const double n[3]) {
  int axis = fabs(n[0]) >= fabs(n[1]) && fabs(n[0]) >= fabs(n[2]) ? 0
             : fabs(n[1]) >= fabs(n[2])                           ? 1
                                                                  : 2;
  int x = (axis + 1) % 3, y = (axis + 2) % 3, sign = 0, way = 0, changes = 0;
  /* The first edge is seen again at the end. */
  for (uint32_t k = 0; k <= loop.n; k++) {
    const double *a = loop.x + 3 * (size_t)loop.vertex[k % loop.n];
    const double *b = loop.x + 3 * (size_t)loop.vertex[(k + 1) % loop.n];
    const double *c = loop.x + 3 * (size_t)loop.vertex[(k + 2) % loop.n];
    int here = turn(a, b, c, x, y);
    if (!here || (sign && here != sign))
      return false;
    sign = here;
    int along = (b[x] > a[x]) - (b[x] < a[x]);
    changes += along && way && along != way;
    way = along ? along : way;
  }
  return changes <= 2;
}

static bool is_fan(struct hsr_loop loop) {
  double n[3];
  if (loop.n < 4 || loop.n > HSR_FAN_CORNERS)
    return false;
  face_normal(&loop, n);
  return is_convex(loop, n);
}

/* The faces of object o that go into cubes: how many, in into[]. The others are
 * marked as loose. */
static uint32_t part_loose(const struct hsr_cubes *cubes, uint32_t o,
                           uint32_t *into, bool *out_of_memory) {
  const struct hsr_scene *scene = cubes->scene;
  const struct hsr_object *object = &scene->objects[o];
  uint32_t n = object->n_faces, kept = 0;
  bool exact = true;
  if (object->start[n] != 3 * (uint64_t)n) {
    for (uint32_t i = 0; i < scene->n_instances && exact; i++)
      exact =
          scene->instances[i].object != o ||
          hsr_instance_is_exact(&scene->instances[i], cubes->object[o].grain,
                                cubes->object[o].reach);
  }
  for (uint32_t f = 0; f < n; f++) {
    struct hsr_loop loop = hsr_object_loop(object, f);
    if (loop.n == 3 || (exact && hsr_is_flat(loop, out_of_memory))) {
      into[kept++] = f;
      cubes->object[o].is_fan[f] = is_fan(loop);
    } else {
      cubes->object[o].is_loose[f] = true;
    }
  }
  return kept;
}

/* --- An object's octree --------------------------------------------------- */

struct faces {
  const struct hsr_object *object;
  const uint32_t *number; /* of those that are placed */
  double reach;
};

static struct hsr_box face_bounds(const void *context, uint32_t k) {
  const struct faces *faces = context;
  struct hsr_loop loop = hsr_object_loop(faces->object, faces->number[k]);
  struct hsr_box box = {{INFINITY, INFINITY, INFINITY},
                        {-INFINITY, -INFINITY, -INFINITY}};
  for (uint32_t c = 0; c < loop.n; c++)
    for (int a = 0; a < 3; a++) {
      double x = loop.x[3 * (size_t)loop.vertex[c] + (size_t)a];
      box.lo[a] = x < box.lo[a] ? x : box.lo[a];
      box.hi[a] = x > box.hi[a] ? x : box.hi[a];
    }
  return box;
}

static double face_area(const void *context, uint32_t k) {
  const struct faces *faces = context;
  struct hsr_loop loop = hsr_object_loop(faces->object, faces->number[k]);
  double n[3];
  face_normal(&loop, n);
  return 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

/* Flat faces are in the hull of their corners. */
static unsigned face_meets(const void *context, uint32_t k,
                           const struct hsr_eight_boxes *boxes) {
  const struct faces *faces = context;
  struct hsr_loop loop = hsr_object_loop(faces->object, faces->number[k]);
  double n[3];
  face_normal(&loop, n);
  return hsr_boxes_that_meet_polygon(boxes, loop, n, 0);
}

static void find_bounds(const struct hsr_object *object,
                        struct hsr_cubes_object *c) {
  c->bounds = (struct hsr_box){{INFINITY, INFINITY, INFINITY},
                               {-INFINITY, -INFINITY, -INFINITY}};
  for (size_t k = 0; k < 3 * (size_t)object->n_vertices; k++) {
    c->bounds.lo[k % 3] = fmin(c->bounds.lo[k % 3], object->xyz[k]);
    c->bounds.hi[k % 3] = fmax(c->bounds.hi[k % 3], object->xyz[k]);
  }
}

/* --- An octree with its cells ----------------------------------------------- */

/* Of all cells, which are made. */
static void find_largest_cell(struct hsr_cubes *cubes,
                              const struct hsr_cubes_object *c) {
  for (uint32_t k = 0; k < c->octree.n_nodes; k++) {
    const struct hsr_cell *cell = &c->cell[k];
    const uint32_t *start = c->start + cell->first_start;
    cubes->most_faces = hsr_max_u32(cubes->most_faces, cell->n_faces);
    cubes->most_vertices = hsr_max_u32(cubes->most_vertices, cell->n_vertices);
    cubes->most_corners =
        hsr_max_u32(cubes->most_corners, start[cell->n_faces]);
  }
}

/* What the octree of an object is made of. */
static struct hsr_primitives primitives_of(struct hsr_cubes *cubes, uint32_t o,
                                           struct faces *faces,
                                           uint32_t n_placed) {
  struct hsr_cubes_object *c = &cubes->object[o];
  *faces = (struct faces){&cubes->scene->objects[o], c->number, c->reach};
  return (struct hsr_primitives){n_placed, faces, face_bounds, face_area,
                                 face_meets};
}

static enum hsr_status make_octree(struct hsr_cubes *cubes, uint32_t o,
                                   uint32_t n_placed,
                                   const struct hsr_octree_rule *rule,
                                   int threads, struct hsr_arena *arena) {
  struct hsr_cubes_object *c = &cubes->object[o];
  struct faces faces;
  struct hsr_primitives primitives = primitives_of(cubes, o, &faces, n_placed);
  enum hsr_status status =
      hsr_octree_init(&c->octree, &primitives, rule, c->bounds.lo,
                      hsr_longest_side(&c->bounds), threads, arena);
  return status ? status
                : hsr_cells_make(c, &cubes->scene->objects[o], threads, arena);
}

/* --- Bit by bit ------------------------------------------------------------ */

bool hsr_cubes_divide(struct hsr_cubes *cubes, uint32_t o, uint32_t k,
                      enum hsr_status *status) {
  struct hsr_cubes_object *c = &cubes->object[o];
  if (!c->lazy || hsr_lazy_node(c->lazy, k)->divided)
    return false;
  uint32_t before = c->octree.n_nodes;
  bool good = !hsr_octree_divide(c->lazy, k);
  c->octree = c->lazy->octree;
  if (!good || !hsr_cells_make_empty(c->maker, before, &cubes->arena) ||
      !hsr_cells_make_one(c->maker, k, &cubes->arena))
    *status = HSR_E_NOMEM;
  return true;
}

static enum hsr_status begin_octree(struct hsr_cubes *cubes, uint32_t o,
                                    uint32_t n_placed,
                                    const struct hsr_octree_rule *rule) {
  const struct hsr_object *object = &cubes->scene->objects[o];
  struct hsr_cubes_object *c = &cubes->object[o];
  struct hsr_arena *arena = &cubes->arena;
  struct faces *faces = HSR_NEW(arena, struct faces, 1);
  c->lazy = HSR_NEW(arena, struct hsr_lazy_octree, 1);
  c->maker = HSR_NEW_ZEROED(arena, struct hsr_cell_maker, 1);
  if (!faces || !c->lazy || !c->maker)
    return HSR_E_NOMEM;
  struct hsr_primitives primitives = primitives_of(cubes, o, faces, n_placed);
  *c->maker = (struct hsr_cell_maker){
      .object = object,
      .c = c,
      .number = HSR_NEW(arena, uint32_t, object->n_vertices),
      .mark = HSR_NEW_ZEROED(arena, uint32_t, object->n_vertices)};
  if (!c->maker->number || !c->maker->mark ||
      hsr_octree_begin(c->lazy, &primitives, rule, c->bounds.lo,
                       hsr_longest_side(&c->bounds), arena))
    return HSR_E_NOMEM;
  c->octree = c->lazy->octree;
  cubes->most_faces = hsr_max_u32(cubes->most_faces, n_placed);
  cubes->most_vertices = hsr_max_u32(cubes->most_vertices, object->n_vertices);
  cubes->most_corners =
      hsr_max_u32(cubes->most_corners, object->start[object->n_faces]);
  return hsr_cells_make_empty(c->maker, 0, arena) ? HSR_OK : HSR_E_NOMEM;
}

/* --- Objects -------------------------------------------------------------- */

/* Finds which faces of an object go into cubes, and how many. Only the object's
 * place is written to, and the arena. */
static enum hsr_status look_at_object(struct hsr_cubes *cubes, uint32_t o,
                                      struct hsr_arena *arena,
                                      uint32_t *n_placed) {
  const struct hsr_object *object = &cubes->scene->objects[o];
  struct hsr_cubes_object *c = &cubes->object[o];
  bool out_of_memory = false;
  uint32_t *number = HSR_NEW(arena, uint32_t, object->n_faces);
  c->is_loose = HSR_NEW_ZEROED(arena, bool, object->n_faces);
  c->is_fan = HSR_NEW_ZEROED(arena, bool, object->n_faces);
  if (!number || !c->is_loose || !c->is_fan)
    return HSR_E_NOMEM;
  c->number = number;
  find_bounds(object, c);
  c->reach = hsr_reach(object);
  c->grain = hsr_grain(object->xyz, 3 * (size_t)object->n_vertices);
  *n_placed = part_loose(cubes, o, number, &out_of_memory);
  c->n_loose = object->n_faces - *n_placed;
  return out_of_memory ? HSR_E_NOMEM : HSR_OK;
}

static enum hsr_status make_object(struct hsr_cubes *cubes, uint32_t o,
                                   const struct hsr_octree_rule *rule,
                                   int threads, struct hsr_arena *arena) {
  uint32_t n_placed;
  enum hsr_status status = look_at_object(cubes, o, arena, &n_placed);
  return status ? status
                : make_octree(cubes, o, n_placed, rule, threads, arena);
}

static enum hsr_status begin_object(struct hsr_cubes *cubes, uint32_t o,
                                    const struct hsr_octree_rule *rule) {
  uint32_t n_placed;
  enum hsr_status status = look_at_object(cubes, o, &cubes->arena, &n_placed);
  return status ? status : begin_octree(cubes, o, n_placed, rule);
}

/* Objects of few faces, which threads take whole. */
struct small_objects {
  struct hsr_cubes *cubes;
  const struct hsr_octree_rule *rule;
  uint32_t *object;
  uint32_t n;
  atomic_bool failed;
};

static bool is_small(const struct hsr_object *object) {
  return object->n_faces <= SMALL;
}

static void make_small(void *context, uint32_t k, int thread) {
  struct small_objects *small = context;
  struct hsr_cubes *cubes = small->cubes;
  if (!atomic_load(&small->failed) &&
      make_object(cubes, small->object[k], small->rule, 1,
                  &cubes->crew[thread]))
    atomic_store(&small->failed, true);
}

static enum hsr_status make_small_objects(struct hsr_cubes *cubes,
                                          const struct hsr_octree_rule *rule) {
  const struct hsr_scene *scene = cubes->scene;
  struct small_objects small = {
      .cubes = cubes,
      .rule = rule,
      .object = HSR_NEW(&cubes->arena, uint32_t, scene->n_objects)};
  cubes->n_crew = hsr_threads(scene->threads);
  cubes->crew = calloc((size_t)cubes->n_crew, sizeof *cubes->crew);
  if (!small.object || !cubes->crew)
    return HSR_E_NOMEM;
  for (uint32_t o = 0; o < scene->n_objects; o++)
    if (is_small(&scene->objects[o]))
      small.object[small.n++] = o;
  hsr_share(cubes->n_crew, small.n, make_small, &small);
  return atomic_load(&small.failed) ? HSR_E_NOMEM : HSR_OK;
}

/* The small ones beside one another; then the others, each by all threads. */
enum hsr_status hsr_cubes_make_objects(struct hsr_cubes *cubes,
                                       const struct hsr_octree_rule *rule) {
  const struct hsr_scene *scene = cubes->scene;
  enum hsr_status status = make_small_objects(cubes, rule);
  for (uint32_t o = 0; o < scene->n_objects && !status; o++)
    if (!is_small(&scene->objects[o]))
      status = make_object(cubes, o, rule, scene->threads, &cubes->arena);
  for (uint32_t o = 0; o < scene->n_objects && !status; o++)
    find_largest_cell(cubes, &cubes->object[o]);
  return status;
}

enum hsr_status hsr_cubes_begin_objects(struct hsr_cubes *cubes,
                                        const struct hsr_octree_rule *rule) {
  enum hsr_status status = HSR_OK;
  for (uint32_t o = 0; o < cubes->scene->n_objects && !status; o++)
    status = begin_object(cubes, o, rule);
  return status;
}
