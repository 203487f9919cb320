/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/voxels/voxels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- The grid ------------------------------------------------------------- */

static void extend(double lo[3], double hi[3], const struct hsr_world *world,
                   uint32_t v) {
  const double at[3] = {world->mesh.x[v], world->mesh.y[v], world->mesh.z[v]};
  for (int k = 0; k < 3; k++) {
    lo[k] = fmin(lo[k], at[k]);
    hi[k] = fmax(hi[k], at[k]);
  }
}

/* Only corners of faces count: a vertex may be of no face. */
enum hsr_status hsr_voxel_grid_init(struct hsr_voxel_grid *grid,
                                    const struct hsr_world *world, int most,
                                    struct hsr_error *err) {
  double lo[3] = {INFINITY, INFINITY, INFINITY};
  double hi[3] = {-INFINITY, -INFINITY, -INFINITY}, longest = 0;
  for (uint32_t k = 0; k < world->mesh.n_corners; k++)
    extend(lo, hi, world, world->mesh.vertex[k]);
  for (int k = 0; k < 3; k++)
    longest = fmax(longest, hi[k] - lo[k]);
  grid->size = longest / most;
  if (!(grid->size >= 0x1p-900))
    return hsr_fail(err, HSR_E_INPUT, "the scene is too small for voxels");
  for (int k = 0; k < 3; k++) {
    double n = ceil((hi[k] - lo[k]) / grid->size);
    grid->lo[k] = lo[k];
    grid->n[k] = n < 1 ? 1 : n > most ? most : (int)n;
  }
  return HSR_OK;
}

bool hsr_same_voxel_grid(const struct hsr_voxel_grid *a,
                         const struct hsr_voxel_grid *b) {
  bool same = a->size == b->size;
  for (int k = 0; k < 3; k++)
    same = same && a->lo[k] == b->lo[k] && a->n[k] == b->n[k];
  return same;
}

/* --- Solids in voxels ----------------------------------------------------- */

enum hsr_status hsr_solid_voxels_open(struct hsr_solid_voxels *voxels,
                                      const struct hsr_voxel_grid *grid) {
  size_t n = hsr_voxel_count(grid);
  if (voxels->solid && hsr_same_voxel_grid(&voxels->grid, grid)) {
    memset(voxels->solid, 0, n * sizeof *voxels->solid);
    return HSR_OK;
  }
  free(voxels->solid);
  voxels->grid = *grid;
  voxels->solid = calloc(n, sizeof *voxels->solid);
  return voxels->solid ? HSR_OK : HSR_E_NOMEM;
}

void hsr_solid_voxels_free(struct hsr_solid_voxels *voxels) {
  free(voxels->solid);
  voxels->solid = NULL;
}

/* The part of a cube that is in the grid. */
static void put_cube(struct hsr_solid_voxels *voxels, uint32_t solid,
                     const int corner[3], int size) {
  const struct hsr_voxel_grid *grid = &voxels->grid;
  int end[3];
  for (int k = 0; k < 3; k++)
    end[k] = corner[k] + size < grid->n[k] ? corner[k] + size : grid->n[k];
  for (int z = corner[2]; z < end[2]; z++)
    for (int y = corner[1]; y < end[1]; y++)
      for (int x = corner[0]; x < end[0]; x++)
        voxels->solid[hsr_voxel_number(grid, x, y, z)] = solid;
}

void hsr_solid_voxels_put(struct hsr_solid_voxels *voxels,
                          const struct hsr_voxel_cubes *cubes) {
  int size = cubes->size;
  for (int bit = 0; bit < 64; bit++) {
    int corner[3] = {cubes->corner[0] + bit % 4 * size,
                     cubes->corner[1] + bit / 4 % 4 * size,
                     cubes->corner[2] + bit / 16 * size};
    if (cubes->mask >> bit & 1)
      put_cube(voxels, cubes->solid, corner, size);
  }
}

static bool is_surface(const struct hsr_solid_voxels *voxels, const int at[3]) {
  const int *n = voxels->grid.n;
  const uint32_t *solid =
      &voxels->solid[hsr_voxel_number(&voxels->grid, at[0], at[1], at[2])];
  size_t step = 1;
  for (int k = 0; k < 3; k++) {
    if (at[k] == 0 || at[k] == n[k] - 1 || *(solid - step) != *solid ||
        solid[step] != *solid)
      return true;
    step *= (size_t)n[k];
  }
  return false;
}

void hsr_solid_voxels_count(const struct hsr_solid_voxels *voxels,
                            uint64_t *set, uint64_t *surface) {
  const int *n = voxels->grid.n;
  int at[3];
  *set = *surface = 0;
  for (at[2] = 0; at[2] < n[2]; at[2]++)
    for (at[1] = 0; at[1] < n[1]; at[1]++)
      for (at[0] = 0; at[0] < n[0]; at[0]++) {
        size_t k = hsr_voxel_number(&voxels->grid, at[0], at[1], at[2]);
        *set += voxels->solid[k] != 0;
        *surface += voxels->solid[k] && is_surface(voxels, at);
      }
}
