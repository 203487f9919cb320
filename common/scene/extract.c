/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Some faces of a scene, laid out by themselves. */
#include "common/scene/planes.h"

static uint32_t size_of(const struct hsr_scene *scene,
                        const struct hsr_place *at) {
  if (hsr_scene_lacks_faces(scene))
    return 4;
  return at->object->start[at->face + 1] - at->object->start[at->face];
}

static void set_vertex(struct hsr_world *out, uint32_t c, const double p[3]) {
  out->mesh.x[c] = p[0];
  out->mesh.y[c] = p[1];
  out->mesh.z[c] = p[2];
  out->mesh.vertex[c] = c;
}

static void set_object(struct hsr_world *out, uint32_t f, uint32_t instance,
                       bool one_sided) {
  out->mesh.object[f] = out->roster.scene->instances[instance].object;
  out->mesh.instance[f] = instance;
  out->mesh.one_sided[f] = one_sided;
}

/* Face id[f] of a grid whose faces are not made. */
static void lay_out_side(struct hsr_world *out, uint32_t f) {
  const struct hsr_grid *grid = out->roster.scene->grid;
  uint32_t cell, at[3];
  int side;
  double corner[4][3];
  hsr_grid_face(grid, out->id[f], &cell, &side);
  hsr_grid_place(grid, cell, at);
  hsr_grid_corners(grid, at, side, corner);
  out->mesh.start[f + 1] = out->mesh.start[f] + 4;
  for (uint32_t k = 0; k < 4; k++)
    set_vertex(out, out->mesh.start[f] + k, corner[k]);
  set_object(out, f, 0, true);
}

void hsr_world_lay_out(struct hsr_world *out, uint32_t f) {
  if (hsr_scene_lacks_faces(out->roster.scene)) {
    lay_out_side(out, f);
    return;
  }
  struct hsr_place at = hsr_place_of(out, out->id[f]);
  const struct hsr_instance *instance =
      &out->roster.scene->instances[at.instance];
  const uint32_t *vertex = at.object->vertex + at.object->start[at.face];
  out->mesh.start[f + 1] = out->mesh.start[f] + size_of(out->roster.scene, &at);
  for (uint32_t c = out->mesh.start[f]; c < out->mesh.start[f + 1];
       c++, vertex++) {
    double p[3];
    hsr_instance_vertex(instance->m, at.object->xyz + 3 * (size_t)*vertex, p);
    set_vertex(out, c, p);
  }
  set_object(out, f, at.instance, at.object->one_sided);
}

enum hsr_status hsr_world_extract(struct hsr_world *out,
                                  const struct hsr_world *world,
                                  const uint32_t *id, uint32_t n,
                                  struct hsr_error *err) {
  *out = (struct hsr_world){.roster.scene = world->roster.scene,
                            .n_faces = n,
                            .roster.first = world->roster.first,
                            .id = id,
                            .roster.all_triangles = true};
  for (uint32_t f = 0; f < n; f++) {
    struct hsr_place at = hsr_place_of(world, id[f]);
    uint32_t size = size_of(out->roster.scene, &at);
    out->mesh.n_corners += size;
    out->roster.all_triangles &= size == 3;
  }
  out->mesh.n_vertices = out->mesh.n_corners;
  if (hsr_world_allocate(out, &out->arena))
    return hsr_fail_nomem(err);
  out->mesh.start[0] = 0;
  for (uint32_t f = 0; f < n; f++)
    hsr_world_lay_out(out, f);
  return hsr_world_find_planes(out, err);
}
