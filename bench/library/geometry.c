/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The faces of a scene as arrays. */
#include "bench/library/library.h"

#include <stdlib.h>

void lib_geometry_free(struct lib_geometry *geometry) {
  free(geometry->xyz);
  free(geometry->ring);
  free(geometry->rgb);
  free(geometry->opacity);
  free(geometry->one_sided);
  free(geometry->object_name);
  *geometry = (struct lib_geometry){.xyz = NULL};
}

/* An array of n things; never NULL for lack of things. */
static void *array(size_t n, size_t size) {
  return calloc(n ? n : 1, size);
}

static bool allocate(struct lib_geometry *to, const struct hsr_world *world) {
  to->xyz = array(world->mesh.n_vertices, 3 * sizeof *to->xyz);
  to->ring = array(world->n_faces, sizeof *to->ring);
  to->rgb = array(world->n_faces, 3 * sizeof *to->rgb);
  to->opacity = array(world->n_faces, sizeof *to->opacity);
  to->one_sided = array(world->n_faces, sizeof *to->one_sided);
  to->object_name =
      array(world->roster.scene->n_objects, sizeof *to->object_name);
  return to->xyz && to->ring && to->rgb && to->opacity && to->one_sided &&
         to->object_name;
}

static void fill(struct lib_geometry *to, const struct hsr_world *world) {
  const struct hsr_mesh *mesh = &world->mesh;
  const struct hsr_scene *scene = world->roster.scene;
  for (uint32_t v = 0; v < mesh->n_vertices; v++) {
    double *at = &to->xyz[3 * (size_t)v];
    at[0] = mesh->x[v];
    at[1] = mesh->y[v];
    at[2] = mesh->z[v];
  }
  for (uint32_t f = 0; f < world->n_faces; f++) {
    const struct hsr_place place = hsr_place_of(world, f);
    to->ring[f] = hsr_face_size(world, f);
    memcpy(&to->rgb[3 * (size_t)f], hsr_face_rgb(place.object, place.face),
           3 * sizeof *to->rgb);
    to->opacity[f] = hsr_face_opacity(place.object, place.face);
    to->one_sided[f] = mesh->one_sided[f];
  }
  for (uint32_t k = 0; k < scene->n_objects; k++)
    to->object_name[k] = scene->objects[k].name;
}

/* Lays the scene out. The caller holds the lock for writing. */
static enum hsr_status lay_out(struct lib_scene *scene, struct hsr_error *err) {
  const uint64_t n = hsr_scene_faces(scene->scene);
  if (scene->has_laid_out)
    return HSR_OK;
  if (n > HSR_MOST_LAID_OUT)
    return hsr_fail(err, HSR_E_REFUSED,
                    "%s: %llu faces are too many to be laid out; the most are "
                    "%u",
                    scene->scene->name, (unsigned long long)n,
                    HSR_MOST_LAID_OUT);
  enum hsr_status status =
      hsr_world_open(&scene->laid_out, scene->scene, HSR_MOST_LAID_OUT, err);
  if (status)
    hsr_world_free(&scene->laid_out);
  scene->has_laid_out = !status;
  return status;
}

static enum hsr_status make(struct lib_scene *scene, struct hsr_error *err) {
  enum hsr_status status = lay_out(scene, err);
  if (status || scene->geometry.xyz)
    return status;
  if (!allocate(&scene->geometry, &scene->laid_out)) {
    lib_geometry_free(&scene->geometry);
    return hsr_fail_nomem(err);
  }
  fill(&scene->geometry, &scene->laid_out);
  return HSR_OK;
}

enum hsr_status hsr_get_geometry(const struct lib_scene *scene,
                                 struct hsr_geometry *geometry,
                                 struct hsr_error *err) {
  if (!scene)
    return lib_null("scene", err);
  struct lib_scene *handle = (struct lib_scene *)scene;
  pthread_rwlock_wrlock(&handle->lock);
  enum hsr_status status = make(handle, err);
  pthread_rwlock_unlock(&handle->lock);
  if (status)
    return status;
  const struct hsr_world *world = &handle->laid_out;
  const struct hsr_geometry found = {.xyz = handle->geometry.xyz,
                                     .n_vertices = world->mesh.n_vertices,
                                     .ring = handle->geometry.ring,
                                     .n_faces = world->n_faces,
                                     .vertex = world->mesh.vertex,
                                     .n_corners = world->mesh.n_corners,
                                     .rgb = handle->geometry.rgb,
                                     .opacity = handle->geometry.opacity,
                                     .object = world->mesh.object,
                                     .object_name =
                                         handle->geometry.object_name,
                                     .n_objects = handle->scene->n_objects,
                                     .one_sided = handle->geometry.one_sided};
  return lib_give("geometry", geometry, sizeof found, &found, err);
}
