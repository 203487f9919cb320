/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Some faces of a scene, laid out by themselves. */
#include "common/scene/planes.h"

static uint32_t size_of(const struct hsr_place *at) {
  return at->object->start[at->face + 1] - at->object->start[at->face];
}

void hsr_world_lay_out(struct hsr_world *out, uint32_t f) {
  struct hsr_place at = hsr_place_of(out, out->id[f]);
  const struct hsr_instance *instance =
      &out->outline.scene->instances[at.instance];
  const uint32_t *vertex = at.object->vertex + at.object->start[at.face];
  out->mesh.start[f + 1] = out->mesh.start[f] + size_of(&at);
  for (uint32_t c = out->mesh.start[f]; c < out->mesh.start[f + 1];
       c++, vertex++) {
    double p[3];
    hsr_instance_vertex(instance->m, at.object->xyz + 3 * (size_t)*vertex, p);
    out->mesh.x[c] = p[0];
    out->mesh.y[c] = p[1];
    out->mesh.z[c] = p[2];
    out->mesh.vertex[c] = c;
  }
  out->mesh.object[f] = instance->object;
  out->mesh.instance[f] = at.instance;
  out->mesh.one_sided[f] = at.object->one_sided;
}

enum hsr_status hsr_world_extract(struct hsr_world *out,
                                  const struct hsr_world *world,
                                  const uint32_t *id, uint32_t n,
                                  struct hsr_error *err) {
  *out = (struct hsr_world){.outline.scene = world->outline.scene,
                            .n_faces = n,
                            .outline.first = world->outline.first,
                            .id = id,
                            .outline.all_triangles = true};
  for (uint32_t f = 0; f < n; f++) {
    struct hsr_place at = hsr_place_of(world, id[f]);
    out->mesh.n_corners += size_of(&at);
    out->outline.all_triangles &= size_of(&at) == 3;
  }
  out->mesh.n_vertices = out->mesh.n_corners;
  if (hsr_world_allocate(out, &out->arena))
    return hsr_fail_nomem(err);
  out->mesh.start[0] = 0;
  for (uint32_t f = 0; f < n; f++)
    hsr_world_lay_out(out, f);
  return hsr_world_find_planes(out, err);
}
