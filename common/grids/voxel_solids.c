/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/grids/voxel_solids.h"
#include "common/adapt/adapt.h"

#include <stdlib.h>

/* What cubes are written as. */
struct writer {
  const struct hsr_voxel_solids *answer;
  uint32_t number; /* of the solid in hand */
};

static void write_cube(const struct writer *w, const int corner[3], int size) {
  const struct hsr_voxel_grid *grid = &w->answer->grid;
  int end[3];
  for (int k = 0; k < 3; k++)
    end[k] = corner[k] + size < grid->n[k] ? corner[k] + size : grid->n[k];
  for (int z = corner[2]; z < end[2]; z++)
    for (int y = corner[1]; y < end[1]; y++)
      for (int x = corner[0]; x < end[0]; x++)
        w->answer->solid[hsr_voxel_number(grid, x, y, z)] = w->number;
}

static void write_cubes(void *context, const int corner[3], int size,
                        uint64_t mask) {
  for (int bit = 0; bit < 64; bit++) {
    int of_bit[3] = {corner[0] + bit % 4 * size, corner[1] + bit / 4 % 4 * size,
                     corner[2] + bit / 16 * size};
    if (mask >> bit & 1)
      write_cube(context, of_bit, size);
  }
}

static enum hsr_status check(const struct hsr_volumes *volumes,
                             struct hsr_error *err) {
  for (uint32_t b = 0; b < volumes->n_bodies; b++)
    if (volumes->solid_start[b] == volumes->solid_start[b + 1])
      return hsr_fail(
          err, HSR_E_REFUSED,
          "%s: face %u is not of a closed solid that can be divided "
          "into convex parts",
          hsr_restriction_code(HSR_CC), volumes->face[volumes->face_start[b]]);
  return HSR_OK;
}

static enum hsr_status tile_all(struct hsr_voxel_solids *answer,
                                const struct hsr_volumes *volumes,
                                struct hsr_voxels *voxels,
                                struct hsr_error *err) {
  struct writer writer = {answer, 0};
  struct hsr_voxel_sink sink = {write_cubes, &writer};
  enum hsr_status status = HSR_OK;
  for (uint32_t b = 0; b < volumes->n_bodies && !status; b++) {
    writer.number = b + 1;
    for (uint32_t v = volumes->solid_start[b];
         v < volumes->solid_start[b + 1] && !status; v++)
      status = hsr_voxels_tile(voxels, v, &sink, err);
  }
  return status;
}

enum hsr_status hsr_voxel_solids_init(struct hsr_voxel_solids *answer,
                                      const struct hsr_volumes *volumes,
                                      int most, struct hsr_error *err) {
  *answer = (struct hsr_voxel_solids){.n_solids = volumes->n_bodies};
  enum hsr_status status = check(volumes, err);
  if (!status)
    status =
        hsr_voxel_grid_init(&answer->grid, volumes->edges->world, most, err);
  if (status)
    return status;
  const int *n = answer->grid.n;
  answer->n_volumes = volumes->n - volumes->solid_start[0];
  answer->solid =
      calloc((size_t)n[0] * (size_t)n[1] * (size_t)n[2], sizeof *answer->solid);
  if (!answer->solid)
    return hsr_fail_nomem(err);
  struct hsr_voxels voxels;
  status = hsr_voxels_init(&voxels, &answer->grid, volumes, err);
  if (!status)
    status = tile_all(answer, volumes, &voxels, err);
  answer->work = voxels.work;
  answer->pyramid_bytes = voxels.pyramid_bytes;
  hsr_voxels_free(&voxels);
  return status;
}

void hsr_voxel_solids_free(struct hsr_voxel_solids *answer) {
  free(answer->solid);
}

/* Whether one of the six next to a voxel is in another solid, or in none. */
static bool is_surface(const struct hsr_voxel_solids *answer, const int at[3]) {
  const int *n = answer->grid.n;
  const uint32_t *solid =
      &answer->solid[hsr_voxel_number(&answer->grid, at[0], at[1], at[2])];
  size_t step = 1;
  for (int k = 0; k < 3; k++) {
    if (at[k] == 0 || at[k] == n[k] - 1 || *(solid - step) != *solid ||
        solid[step] != *solid)
      return true;
    step *= (size_t)n[k];
  }
  return false;
}

void hsr_voxel_solids_count(const struct hsr_voxel_solids *answer,
                            uint64_t *set, uint64_t *surface) {
  const int *n = answer->grid.n;
  int at[3];
  *set = *surface = 0;
  for (at[2] = 0; at[2] < n[2]; at[2]++)
    for (at[1] = 0; at[1] < n[1]; at[1]++)
      for (at[0] = 0; at[0] < n[0]; at[0]++) {
        size_t k = hsr_voxel_number(&answer->grid, at[0], at[1], at[2]);
        *set += answer->solid[k] != 0;
        *surface += answer->solid[k] && is_surface(answer, at);
      }
}
