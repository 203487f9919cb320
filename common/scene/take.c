/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/scene/scene.h"

#include <stdlib.h>
#include <string.h>

/* Makes room for n elements and `more`. False: out of memory, or too many. */
static bool make_room(void *array, uint32_t *cap, uint32_t n, uint32_t more,
                      size_t size) {
  void *old, *grown;
  if (more <= *cap - n)
    return true;
  if (more >= UINT32_MAX - n)
    return false;
  memcpy(&old, array, sizeof old);
  grown = realloc(old, ((size_t)n + more) * size);
  if (!grown)
    return false;
  memcpy(array, &grown, sizeof grown);
  *cap = n + more;
  return true;
}

enum hsr_status hsr_scene_take(struct hsr_scene *scene,
                               struct hsr_scene *from) {
  const uint32_t n = scene->n_objects;
  if (!make_room(&scene->objects, &scene->cap_objects, n, from->n_objects,
                 sizeof *scene->objects) ||
      !make_room(&scene->instances, &scene->cap_instances, scene->n_instances,
                 from->n_instances, sizeof *scene->instances) ||
      !make_room(&scene->views, &scene->cap_views, scene->n_views,
                 from->n_views, sizeof *scene->views))
    return HSR_E_NOMEM;
  for (uint32_t o = 0; o < from->n_objects; o++)
    scene->objects[scene->n_objects++] = from->objects[o];
  for (uint32_t i = 0; i < from->n_instances; i++) {
    scene->instances[scene->n_instances] = from->instances[i];
    scene->instances[scene->n_instances++].object += n;
  }
  for (uint32_t v = 0; v < from->n_views; v++)
    scene->views[scene->n_views++] = from->views[v];
  from->n_objects = from->n_instances = from->n_views = 0;
  return HSR_OK;
}
