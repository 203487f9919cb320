/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/image_space/area/tiling/separate.h"

#include <math.h>

static void take_face(struct hsr_bsp *bsp, uint32_t f) {
  const struct hsr_world *world = bsp->world;
  uint32_t n = hsr_face_size(world, f), first = world->mesh.start[f];
  const uint32_t *vertex = world->mesh.vertex + first;
  bsp->piece[f] = (struct hsr_bsp_piece){f, first, n, 0, 0};
  for (uint32_t k = 0; k < n; k++)
    bsp->corner[first + k] = (struct hsr_bsp_corner){
        vertex[k], vertex[k], vertex[k + 1 < n ? k + 1 : 0]};
}

enum hsr_status hsr_separate_init(struct hsr_bsp *bsp,
                                  const struct hsr_world *world) {
  struct hsr_arena *arena = &bsp->arena;
  *bsp = (struct hsr_bsp){.world = world,
                          .x = world->mesh.x,
                          .y = world->mesh.y,
                          .z = world->mesh.z,
                          .n_points = world->mesh.n_vertices,
                          .n_pieces = world->n_faces,
                          .n_corners = world->mesh.n_corners};
  bsp->piece = HSR_NEW(arena, struct hsr_bsp_piece, bsp->n_pieces);
  bsp->corner = HSR_NEW(arena, struct hsr_bsp_corner, bsp->n_corners);
  bsp->error = HSR_NEW_ZEROED(arena, double, bsp->n_points);
  if (!bsp->piece || !bsp->corner || !bsp->error)
    return HSR_E_NOMEM;
  for (uint32_t f = 0; f < world->n_faces; f++)
    take_face(bsp, f);
  return HSR_OK;
}

struct hsr_bsp_cube hsr_all_points(const struct hsr_bsp *bsp) {
  struct hsr_bsp_cube all = {.n_points = bsp->n_points};
  const double *at[3] = {bsp->x, bsp->y, bsp->z};
  for (int k = 0; k < 3; k++) {
    all.tight.lo[k] = INFINITY;
    all.tight.hi[k] = -INFINITY;
    for (uint32_t v = 0; v < bsp->n_points; v++) {
      all.tight.lo[k] = fmin(all.tight.lo[k], at[k][v]);
      all.tight.hi[k] = fmax(all.tight.hi[k], at[k][v]);
    }
  }
  return all;
}
