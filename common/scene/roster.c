/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rosters: which ids belong to which instance, and where a face stands. */
#include "common/scene/pieces.h"
#include "common/scene/planes.h"

#include <string.h>

/* Counts the faces, and finds the first id of each instance. */
static enum hsr_status number_faces(struct hsr_world *world,
                                    struct hsr_error *err) {
  const struct hsr_scene *scene = world->roster.scene;
  world->roster.first =
      HSR_NEW(&world->arena, uint32_t, (size_t)scene->n_instances + 1);
  if (!world->roster.first)
    return hsr_fail_nomem(err);
  world->roster.all_triangles = true;
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    const struct hsr_object *object =
        &scene->objects[scene->instances[i].object];
    world->roster.first[i] = world->n_faces;
    world->n_faces += object->n_faces;
    if (object->start[object->n_faces] != 3 * (uint64_t)object->n_faces)
      world->roster.all_triangles = false;
  }
  if (scene->grid) {
    world->n_faces = scene->grid->n_faces;
    world->roster.all_triangles = false;
  }
  world->roster.first[scene->n_instances] = world->n_faces;
  return HSR_OK;
}

enum hsr_status hsr_world_roster(struct hsr_world *world,
                                 const struct hsr_scene *scene,
                                 struct hsr_error *err) {
  *world = (struct hsr_world){.roster.scene = scene};
  return number_faces(world, err);
}

uint32_t hsr_instance_of(const struct hsr_roster *roster, uint32_t f) {
  uint32_t lo = 0, hi = roster->scene->n_instances;
  while (hi - lo > 1) { /* first[lo] <= f < first[hi] */
    uint32_t middle = lo + (hi - lo) / 2;
    if (roster->first[middle] <= f)
      lo = middle;
    else
      hi = middle;
  }
  return lo;
}

struct hsr_place hsr_place_of(const struct hsr_world *world, uint32_t id) {
  const struct hsr_roster *roster =
      world->pieces ? &world->pieces->whole->roster : &world->roster;
  uint32_t i = hsr_instance_of(roster, id);
  const struct hsr_scene *scene = roster->scene;
  return (struct hsr_place){&scene->objects[scene->instances[i].object], i,
                            id - roster->first[i]};
}

void hsr_place_plane(const struct hsr_world *world, struct hsr_place place,
                     double normal[3], double anchor[3]) {
  const struct hsr_object *object = place.object;
  const double *m = world->roster.scene->instances[place.instance].m;
  struct hsr_newell plane = {.n = 0};
  for (uint32_t c = object->start[place.face];
       c < object->start[place.face + 1]; c++) {
    double p[3];
    hsr_instance_vertex(m, object->xyz + 3 * (size_t)object->vertex[c], p);
    hsr_newell_add(&plane, p);
  }
  memcpy(normal, plane.normal, sizeof plane.normal);
  hsr_newell_anchor(&plane, anchor);
}
