/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/exact/alone.h"
#include "common/exact/pair.h"

enum hsr_status hsr_alone_init(struct hsr_alone *alone,
                               const struct hsr_world *scene,
                               const struct hsr_view *view,
                               struct hsr_arena *arena) {
  uint32_t corners = hsr_largest_face(scene->roster.scene);
  alone->id = HSR_NO_ID;
  alone->world = (struct hsr_world){.roster.scene = scene->roster.scene,
                                    .mesh.n_vertices = corners,
                                    .n_faces = 1,
                                    .mesh.n_corners = corners,
                                    .roster.first = scene->roster.first,
                                    .id = &alone->id};
  if (hsr_world_allocate(&alone->world, arena))
    return HSR_E_NOMEM;
  alone->world.mesh.start[0] = 0;
  return hsr_screen_init(&alone->screen, &alone->world, view, arena);
}

void hsr_alone_take(struct hsr_alone *alone, uint32_t id) {
  if (alone->id == id)
    return;
  alone->id = id;
  hsr_world_lay_out(&alone->world, 0);
  hsr_screen_corners(&alone->screen, 0);
}
