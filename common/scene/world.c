/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laying out a scene: every instance expanded. */
#include "common/scene/planes.h"

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
  if (!world->outline.first)
    world->outline.first =
        HSR_NEW(arena, uint32_t, (size_t)world->outline.scene->n_instances + 1);
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
             world->outline.first && world->mesh.nx && world->mesh.ny &&
             world->mesh.nz && world->mesh.n_error && world->mesh.px &&
             world->mesh.py && world->mesh.pz && world->mesh.anchor_error &&
             world->mesh.deviation && world->mesh.plane;
  return all ? HSR_OK : HSR_E_NOMEM;
}

/* Counts the vertices and corners. */
static enum hsr_status measure(struct hsr_world *world, struct hsr_error *err) {
  const struct hsr_scene *scene = world->outline.scene;
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
  world->mesh.n_vertices = (uint32_t)nv;
  world->mesh.n_corners = (uint32_t)nc;
  return HSR_OK;
}

/* Puts instance i at vertex v, face f, corner c of the arrays. */
static void expand_instance(struct hsr_world *world, uint32_t i, uint32_t v,
                            uint32_t f, uint32_t c) {
  const struct hsr_instance *instance = &world->outline.scene->instances[i];
  const struct hsr_object *object =
      &world->outline.scene->objects[instance->object];
  for (uint32_t k = 0; k < object->n_vertices; k++) {
    double p[3];
    hsr_instance_vertex(instance->m, object->xyz + 3 * (size_t)k, p);
    world->mesh.x[v + k] = p[0];
    world->mesh.y[v + k] = p[1];
    world->mesh.z[v + k] = p[2];
  }
  for (uint32_t k = 0; k < object->n_faces; k++) {
    world->mesh.start[f + k] = c + object->start[k];
    world->mesh.object[f + k] = instance->object;
    world->mesh.instance[f + k] = i;
    world->mesh.one_sided[f + k] = object->one_sided;
  }
  for (uint32_t k = 0; k < object->start[object->n_faces]; k++)
    world->mesh.vertex[c + k] = v + object->vertex[k];
}

static void expand(struct hsr_world *world) {
  const struct hsr_scene *scene = world->outline.scene;
  uint32_t v = 0, f = 0, c = 0;
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    const struct hsr_object *object =
        &scene->objects[scene->instances[i].object];
    expand_instance(world, i, v, f, c);
    v += object->n_vertices;
    f += object->n_faces;
    c += object->start[object->n_faces];
  }
  world->mesh.start[f] = c;
}

enum hsr_status hsr_world_init(struct hsr_world *world, struct hsr_scene *scene,
                               struct hsr_error *err) {
  enum hsr_status status = hsr_world_outline(world, scene, err);
  if (!status)
    status = hsr_scene_make_faces(scene, err);
  if (!status)
    status = measure(world, err);
  if (status)
    return status;
  if (hsr_world_allocate(world, &world->arena))
    return hsr_fail_nomem(err);
  expand(world);
  return hsr_world_find_planes(world, err);
}

void hsr_world_free(struct hsr_world *world) {
  hsr_arena_free(&world->arena);
}

enum hsr_status hsr_world_open(struct hsr_world *world, struct hsr_scene *scene,
                               uint32_t most, struct hsr_error *err) {
  uint64_t n = hsr_scene_faces(scene);
  if (n <= most)
    return hsr_world_init(world, scene, err);
  enum hsr_status status = hsr_world_outline(world, scene, err);
  return status || n > HSR_MOST_LAID_OUT ? status
                                         : hsr_scene_make_faces(scene, err);
}
