/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Notation    u = 2^-53; an instance takes X to M X + m.
 *
 * Slack. hsr_instance_vertex makes seven roundings, of terms no larger than
 * |M| |X|inf-sums and |m|: a coordinate is off by at most 8 u (sum of |M_kl|
 * reach + |m_k|). What lies between vertices is off by no more, as the same
 * convex combination. Bounds are grown by twice that.
 * Where an instance is exact (common/trees/grain.h), a plane stays one. */
#include "algorithms/engines/cubes/cube_objects.h"
#include "common/trees/grain.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double U = DBL_EPSILON / 2;

/* --- The octree of instances ---------------------------------------------- */

struct hsr_box hsr_cubes_bounds(const struct hsr_cubes *cubes, uint32_t i) {
  const struct hsr_instance *instance = &cubes->scene->instances[i];
  const struct hsr_cubes_object *c = &cubes->object[instance->object];
  bool exact = hsr_instance_is_exact(instance, c->grain, c->reach);
  const double *row = instance->m;
  struct hsr_box box;
  for (int k = 0; k < 3; k++, row += 4) {
    double lo = row[3], hi = row[3], size = fabs(row[3]);
    for (int l = 0; l < 3; l++) {
      double a = row[l] * c->bounds.lo[l], b = row[l] * c->bounds.hi[l];
      lo += fmin(a, b);
      hi += fmax(a, b);
      size += fabs(row[l]) * c->reach;
    }
    double slack = exact ? 0 : 32 * U * size + 0x1p-960; /* underflow */
    box.lo[k] = lo - slack;
    box.hi[k] = hi + slack;
  }
  return box;
}

/* Those that do not move. */
struct still {
  uint32_t *instance;
  struct hsr_box *bounds;
};

static struct hsr_box bounds_of(const void *context, uint32_t k) {
  const struct still *still = context;
  return still->bounds[k];
}

static double area_of(const void *context, uint32_t k) {
  const struct still *still = context;
  double side = hsr_longest_side(&still->bounds[k]);
  return side * side;
}

/* One instance to a cube; those on the planes of a grid stay whole if the
 * cubes' planes are the grid's: the root is a power of two times as large as
 * the largest instance. */
static enum hsr_status place_still(struct hsr_cubes *cubes,
                                   const struct still *still, uint32_t n,
                                   const struct hsr_box *all, double largest) {
  double side = largest;
  while (side < hsr_longest_side(all))
    side *= 2;
  struct hsr_primitives primitives = {n, still, bounds_of, area_of, NULL};
  struct hsr_octree_rule rule = {.small = 0.1, .most = 1, .least = 1};
  struct hsr_octree *octree = &cubes->octree;
  if (cubes->lazy) {
    if (hsr_octree_begin(cubes->lazy, &primitives, &rule, all->lo, side,
                         &cubes->arena))
      return HSR_E_NOMEM;
    *octree = cubes->lazy->octree;
    cubes->still = still->instance;
  } else if (hsr_octree_init(octree, &primitives, &rule, all->lo, side,
                             cubes->scene->threads, &cubes->arena)) {
    return HSR_E_NOMEM;
  }
  for (uint32_t k = 0; k < octree->n_items && !cubes->lazy; k++)
    octree->item[k] = still->instance[octree->item[k]];
  return HSR_OK;
}

bool hsr_cubes_divide_instances(struct hsr_cubes *cubes, uint32_t k,
                                enum hsr_status *status) {
  if (!cubes->lazy || hsr_lazy_node(cubes->lazy, k)->divided)
    return false;
  if (hsr_octree_divide(cubes->lazy, k))
    *status = HSR_E_NOMEM;
  cubes->octree = cubes->lazy->octree;
  return true;
}

/* In the arena, since an octree that is divided bit by bit keeps asking. */
static struct still *new_still(struct hsr_cubes *cubes) {
  struct hsr_arena *arena = &cubes->arena;
  uint32_t n = cubes->scene->n_instances;
  struct still *still = HSR_NEW(arena, struct still, 1);
  if (!still)
    return NULL;
  still->instance = HSR_NEW(arena, uint32_t, n);
  still->bounds = HSR_NEW(arena, struct hsr_box, n);
  return still->instance && still->bounds ? still : NULL;
}

static enum hsr_status make_instances(struct hsr_cubes *cubes) {
  uint32_t n = cubes->scene->n_instances, n_still = 0;
  struct still *still = new_still(cubes);
  cubes->mover = HSR_NEW(&cubes->arena, uint32_t, n);
  struct hsr_box all = {{INFINITY, INFINITY, INFINITY},
                        {-INFINITY, -INFINITY, -INFINITY}};
  double largest = 0;
  bool good = still && cubes->mover;
  for (uint32_t i = 0; i < n && good; i++) {
    struct hsr_box box = hsr_cubes_bounds(cubes, i);
    for (int k = 0; k < 3; k++) {
      all.lo[k] = fmin(all.lo[k], box.lo[k]);
      all.hi[k] = fmax(all.hi[k], box.hi[k]);
    }
    if (cubes->scene->objects[cubes->scene->instances[i].object].moves) {
      cubes->mover[cubes->n_movers++] = i;
      continue;
    }
    largest = fmax(largest, hsr_longest_side(&box));
    still->instance[n_still] = i;
    still->bounds[n_still++] = box;
  }
  if (largest == 0) /* nothing is still, or all in one point */
    largest = fmax(hsr_longest_side(&all), 0x1p-900);
  good = good && !place_still(cubes, still, n_still, &all, largest);
  return good ? HSR_OK : HSR_E_NOMEM;
}

/* --- Loose faces ---------------------------------------------------------- */

/* Their ids, into id[] unless it is NULL: how many. */
static size_t list_loose(const struct hsr_cubes *cubes,
                         const struct hsr_world *world, uint32_t *id) {
  size_t n = 0;
  for (uint32_t i = 0; i < cubes->scene->n_instances; i++) {
    uint32_t o = cubes->scene->instances[i].object;
    const struct hsr_cubes_object *c = &cubes->object[o];
    for (uint32_t f = 0;
         id && c->n_loose &&
         f < world->roster.first[i + 1] - world->roster.first[i];
         f++)
      if (c->is_loose[f])
        id[n++] = world->roster.first[i] + f;
    n += id ? 0 : c->n_loose;
  }
  return n;
}

static enum hsr_status lay_out_loose(struct hsr_cubes *cubes,
                                     const struct hsr_world *world,
                                     struct hsr_error *err) {
  size_t n = list_loose(cubes, world, NULL);
  cubes->loose_id = HSR_NEW(&cubes->arena, uint32_t, n);
  if (!cubes->loose_id)
    return hsr_fail_nomem(err);
  list_loose(cubes, world, cubes->loose_id);
  return hsr_world_extract(&cubes->loose, world, cubes->loose_id, (uint32_t)n,
                           err);
}

static enum hsr_status init(struct hsr_cubes *cubes,
                            const struct hsr_world *world,
                            const struct hsr_octree_rule *rule, bool lazily,
                            struct hsr_error *err) {
  *cubes = (struct hsr_cubes){.scene = world->roster.scene};
  uint32_t n = cubes->scene->n_objects;
  for (uint32_t o = 0; o < n; o++) {
    const struct hsr_object *object = &cubes->scene->objects[o];
    if (object->n_faces > cubes->most_object_faces)
      cubes->most_object_faces = object->n_faces;
    if (object->moves &&
        object->start[object->n_faces] != 3 * (uint64_t)object->n_faces)
      return hsr_fail(err, HSR_E_REFUSED,
                      "object %s, which moves, is not of triangles",
                      object->name);
  }
  cubes->object = HSR_NEW_ZEROED(&cubes->arena, struct hsr_cubes_object, n);
  if (lazily)
    cubes->lazy = HSR_NEW(&cubes->arena, struct hsr_lazy_octree, 1);
  enum hsr_status status =
      cubes->object && (cubes->lazy || !lazily) ? HSR_OK : HSR_E_NOMEM;
  if (!status)
    status = lazily ? hsr_cubes_begin_objects(cubes, rule)
                    : hsr_cubes_make_objects(cubes, rule);
  if (!status)
    status = make_instances(cubes);
  return status ? hsr_fail_nomem(err) : lay_out_loose(cubes, world, err);
}

enum hsr_status hsr_cubes_init(struct hsr_cubes *cubes,
                               const struct hsr_world *world,
                               const struct hsr_octree_rule *rule,
                               struct hsr_error *err) {
  return init(cubes, world, rule, false, err);
}

enum hsr_status hsr_cubes_init_lazily(struct hsr_cubes *cubes,
                                      const struct hsr_world *world,
                                      const struct hsr_octree_rule *rule,
                                      struct hsr_error *err) {
  return init(cubes, world, rule, true, err);
}

void hsr_cubes_free(struct hsr_cubes *cubes) {
  hsr_world_free(&cubes->loose);
  for (int k = 0; cubes->crew && k < cubes->n_crew; k++)
    hsr_arena_free(&cubes->crew[k]);
  free(cubes->crew);
  hsr_arena_free(&cubes->arena);
}
