/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laying out a scene: every instance expanded. */
#include "common/base/numbers.h"
#include "common/base/share.h"
#include "common/scene/planes.h"

#include <stdlib.h>
#include <string.h>

enum hsr_status hsr_world_allocate(struct hsr_world *world,
                                   struct hsr_arena *arena) {
  size_t nv = world->mesh.n_vertices, nf = world->n_faces,
         nc = world->mesh.n_corners;
  world->mesh.x = HSR_NEW(arena, double, nv);
  world->mesh.y = HSR_NEW(arena, double, nv);
  world->mesh.z = HSR_NEW(arena, double, nv);
  world->mesh.start = HSR_NEW(arena, uint32_t, nf + 1);
  world->mesh.vertex = HSR_NEW(arena, uint32_t, nc);
  world->mesh.object = HSR_NEW(arena, uint32_t, nf);
  world->mesh.instance = HSR_NEW(arena, uint32_t, nf);
  world->mesh.one_sided = HSR_NEW(arena, bool, nf);
  if (!world->roster.first)
    world->roster.first =
        HSR_NEW(arena, uint32_t, (size_t)world->roster.scene->n_instances + 1);
  world->mesh.nx = HSR_NEW(arena, double, nf);
  world->mesh.ny = HSR_NEW(arena, double, nf);
  world->mesh.nz = HSR_NEW(arena, double, nf);
  world->mesh.n_error = HSR_NEW(arena, double, nf);
  world->mesh.px = HSR_NEW(arena, double, nf);
  world->mesh.py = HSR_NEW(arena, double, nf);
  world->mesh.pz = HSR_NEW(arena, double, nf);
  world->mesh.anchor_error = HSR_NEW(arena, double, nf);
  world->mesh.deviation = HSR_NEW(arena, double, nf);
  world->mesh.plane = HSR_NEW(arena, uint32_t, nf);
  bool all = world->mesh.x && world->mesh.y && world->mesh.z &&
             world->mesh.start && world->mesh.vertex && world->mesh.object &&
             world->mesh.instance && world->mesh.one_sided &&
             world->roster.first && world->mesh.nx && world->mesh.ny &&
             world->mesh.nz && world->mesh.n_error && world->mesh.px &&
             world->mesh.py && world->mesh.pz && world->mesh.anchor_error &&
             world->mesh.deviation && world->mesh.plane;
  return all ? HSR_OK : HSR_E_NOMEM;
}

/* Instances are expanded in parts of so many vertices, faces and corners. */
enum { RANGE = 16384 };

/* Where an instance begins in the arrays, and which is its first part. */
struct place {
  uint64_t v, c; /* vertex 0 of the object, or of its mesh; and the corners */
  uint32_t f, part;
  bool shares; /* the object is a group, and shares the vertices of its mesh */
};

struct expanding {
  struct hsr_world *world;
  struct place *place; /* n_instances + 1 */
};

/* How many instances an object has, of which the first is `first`. */
static uint32_t count_instances(const struct hsr_scene *scene, uint32_t object,
                                uint32_t first) {
  uint32_t i = first;
  while (i < scene->n_instances && scene->instances[i].object == object)
    i++;
  return i - first;
}

/* Whether the groups of a mesh are placed alike, so that they can share
 * vertices. `first` is the first instance of the first group. */
static bool are_placed_alike(const struct hsr_scene *scene, uint32_t first) {
  const uint32_t object = scene->instances[first].object,
                 n = count_instances(scene, object, first),
                 of = scene->objects[object].group.of;
  for (uint32_t g = 0, i = first; g < of; g++, i += n) {
    if (scene->objects[object + g].moves ||
        count_instances(scene, object + g, i) != n)
      return false;
    for (uint32_t k = 0; k < n; k++)
      if (memcmp(scene->instances[i + k].m, scene->instances[first + k].m,
                 sizeof scene->instances->m) != 0)
        return false;
  }
  return true;
}

/* The last place is the end of all. Its v is the number of vertices. */
static void find_places(const struct hsr_scene *scene, struct place *place) {
  uint64_t v = 0;              /* vertices of the world so far */
  uint32_t first = 0, own = 0; /* instances: of the first group of a mesh, and
                                  of this object */
  bool alike = false;
  place[0] = (struct place){.f = 0};
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    const uint32_t o = scene->instances[i].object;
    const struct hsr_object *object = &scene->objects[o];
    const struct hsr_group *group = &object->group;
    const uint32_t nv = object->n_vertices, nf = object->n_faces,
                   nc = object->start[nf];
    if (!i || scene->instances[i - 1].object != o)
      own = i;
    if (group->vertex && group->number == 0 && own == i)
      alike = are_placed_alike(scene, first = i);
    place[i].shares = group->vertex && alike;
    const bool is_later = place[i].shares && group->number > 0;
    place[i].v = is_later ? place[first + (i - own)].v : v;
    if (!is_later)
      v += place[i].shares ? group->n_vertices : nv;
    place[i + 1] = (struct place){
        .v = v,
        .f = place[i].f + nf,
        .c = place[i].c + nc,
        .part = place[i].part +
                hsr_n_ranges(hsr_max_u32(nv, hsr_max_u32(nf, nc)), RANGE)};
  }
}

/* Counts the vertices and corners. */
static enum hsr_status measure(struct hsr_world *world, const struct place *end,
                               struct hsr_error *err) {
  if (end->v >= UINT32_MAX || end->c >= UINT32_MAX)
    return hsr_fail(err, HSR_E_NOMEM,
                    "the scene is too large to be laid out: %u faces",
                    world->n_faces);
  world->mesh.n_vertices = (uint32_t)end->v;
  world->mesh.n_corners = (uint32_t)end->c;
  return HSR_OK;
}

static uint32_t instance_of_part(const struct expanding *e, uint32_t part) {
  uint32_t lo = 0, hi = e->world->roster.scene->n_instances;
  while (hi - lo > 1) { /* place[lo].part <= part < place[hi].part */
    uint32_t middle = lo + (hi - lo) / 2;
    if (e->place[middle].part <= part)
      lo = middle;
    else
      hi = middle;
  }
  return lo;
}

/* The part of n things that range `part` has; none, perhaps. */
static struct hsr_range clipped(uint32_t n, uint32_t part) {
  return part < hsr_n_ranges(n, RANGE) ? hsr_range_of(n, RANGE, part)
                                       : (struct hsr_range){0, 0};
}

static void expand_part(void *context, uint32_t part, int thread) {
  const struct expanding *e = context;
  uint32_t i = instance_of_part(e, part);
  const struct place at = e->place[i];
  struct hsr_mesh *mesh = &e->world->mesh;
  const struct hsr_instance *instance = &e->world->roster.scene->instances[i];
  const struct hsr_object *object =
      &e->world->roster.scene->objects[instance->object];
  const uint32_t *number = at.shares ? object->group.vertex : NULL;
  struct hsr_range r = clipped(
      number ? object->group.n_own : object->n_vertices, part - at.part);
  (void)thread;
  for (uint32_t k = r.from; k < r.to; k++) {
    double p[3];
    const size_t v = at.v + (number ? number[k] : k);
    hsr_instance_vertex(instance->m, object->xyz + 3 * (size_t)k, p);
    mesh->x[v] = p[0];
    mesh->y[v] = p[1];
    mesh->z[v] = p[2];
  }
  r = clipped(object->n_faces, part - at.part);
  for (uint32_t k = r.from; k < r.to; k++) {
    mesh->start[at.f + k] = (uint32_t)at.c + object->start[k];
    mesh->object[at.f + k] = instance->object;
    mesh->instance[at.f + k] = i;
    mesh->one_sided[at.f + k] = object->one_sided;
  }
  r = clipped(object->start[object->n_faces], part - at.part);
  for (uint32_t k = r.from; k < r.to; k++) {
    const uint32_t v = object->vertex[k];
    mesh->vertex[at.c + k] = (uint32_t)at.v + (number ? number[v] : v);
  }
}

static enum hsr_status expand(struct hsr_world *world, struct hsr_error *err) {
  const struct hsr_scene *scene = world->roster.scene;
  const uint32_t n = scene->n_instances;
  struct expanding e = {world, malloc((n + (size_t)1) * sizeof *e.place)};
  if (!e.place)
    return hsr_fail_nomem(err);
  find_places(scene, e.place);
  enum hsr_status status = measure(world, &e.place[n], err);
  if (!status && hsr_world_allocate(world, &world->arena))
    status = hsr_fail_nomem(err);
  if (!status) {
    hsr_share(scene->threads, e.place[n].part, expand_part, &e);
    world->mesh.start[e.place[n].f] = world->mesh.n_corners;
  }
  free(e.place);
  return status;
}

enum hsr_status hsr_world_init(struct hsr_world *world, struct hsr_scene *scene,
                               struct hsr_error *err) {
  enum hsr_status status = hsr_world_roster(world, scene, err);
  if (!status)
    status = hsr_scene_make_faces(scene, err);
  if (!status)
    status = expand(world, err);
  return status ? status : hsr_world_find_planes(world, err);
}

uint32_t hsr_most_corners(const struct hsr_world *world) {
  uint32_t most = 0;
  for (uint32_t f = 0; f < world->n_faces; f++)
    if (most < hsr_face_size(world, f))
      most = hsr_face_size(world, f);
  return most;
}

void hsr_world_free(struct hsr_world *world) {
  hsr_arena_free(&world->arena);
}

enum hsr_status hsr_world_open(struct hsr_world *world, struct hsr_scene *scene,
                               uint32_t most, struct hsr_error *err) {
  uint64_t n = hsr_scene_faces(scene);
  if (n <= most)
    return hsr_world_init(world, scene, err);
  enum hsr_status status = hsr_world_roster(world, scene, err);
  return status || n > HSR_MOST_LAID_OUT ? status
                                         : hsr_scene_make_faces(scene, err);
}
