/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/peers/shared/samples.h"

#include "algorithms/engines/splats/splats.h"

#include <math.h>
#include <stdlib.h>

#define SAME 1e-9 /* relative to a cell's size */

double grid_spacing(const struct hsr_grid *grid, int axis) {
  return (grid->bound[axis][grid->n[axis]] - grid->bound[axis][0]) /
         grid->n[axis];
}

bool grid_is_even(const struct hsr_grid *grid) {
  for (int axis = 0; axis < 3; axis++) {
    double size = grid_spacing(grid, axis);
    for (uint32_t k = 0; k < grid->n[axis]; k++) {
      double own = grid->bound[axis][k + 1] - grid->bound[axis][k];
      double at = grid->at[axis][0] + k * size;
      if (fabs(own - size) > SAME * size ||
          fabs(grid->at[axis][k] - at) > SAME * size * (k + 1))
        return false;
    }
  }
  return true;
}

static void place(struct samples *s, const struct hsr_grid *grid) {
  s->count = 1;
  for (int axis = 0; axis < 3; axis++) {
    s->n[axis] = (int)grid->n[axis] + 2 * SAMPLES_AROUND;
    s->count *= (size_t)s->n[axis];
    s->spacing[axis] = grid_spacing(grid, axis);
    s->first[axis] = grid->at[axis][0] - SAMPLES_AROUND * s->spacing[axis];
  }
}

static size_t voxel_of(const struct samples *s, const struct hsr_grid *grid,
                       uint32_t cell) {
  uint32_t at[3];
  hsr_grid_place(grid, cell, at);
  size_t voxel = 0;
  for (int axis = 2; axis >= 0; axis--)
    voxel = voxel * (size_t)s->n[axis] + at[axis] + SAMPLES_AROUND;
  return voxel;
}

static void colour(struct samples *s, const struct hsr_splats *splats) {
  for (uint32_t cell = 0; cell < splats->grid->n_cells; cell++) {
    uint16_t c[HSR_SPLAT_OPACITY + 1];
    hsr_splats_colour(splats, cell, hsr_splats_opacity(splats, cell), c);
    size_t voxel = voxel_of(s, splats->grid, cell);
    double opacity = c[HSR_SPLAT_OPACITY];
    s->opacity[voxel] = (float)(opacity / 65535);
    s->rgba[voxel][3] = (uint8_t)lrint(opacity / 257);
    for (int k = 0; k < 3 && opacity > 0; k++)
      s->rgba[voxel][k] = (uint8_t)lrint(fmin(255, 255 * c[k] / opacity));
  }
}

/* Gives a clear voxel, which is not at the rim, the mean colour of those around
 * it that are not clear. */
static void colour_clear(struct samples *s, size_t voxel) {
  ptrdiff_t row = s->n[0], slice = row * s->n[1];
  int sum[3] = {0, 0, 0}, n = 0;
  for (ptrdiff_t k = -1; k <= 1; k++)
    for (ptrdiff_t j = -1; j <= 1; j++)
      for (ptrdiff_t i = -1; i <= 1; i++) {
        const uint8_t *other =
            s->rgba[(ptrdiff_t)voxel + i + j * row + k * slice];
        n += other[3] > 0;
        for (int c = 0; c < 3 && other[3]; c++)
          sum[c] += other[c];
      }
  for (int c = 0; c < 3 && n; c++)
    s->rgba[voxel][c] = (uint8_t)(sum[c] / n);
}

static void colour_around(struct samples *s) {
  size_t row = (size_t)s->n[0], slice = row * (size_t)s->n[1];
  for (size_t voxel = slice + row + 1; voxel + slice + row + 1 < s->count;
       voxel++)
    if (!s->rgba[voxel][3])
      colour_clear(s, voxel);
}

enum hsr_status samples_init(struct samples *s, const struct hsr_setup *setup,
                             const struct hsr_view *view,
                             struct hsr_answer *answer, struct hsr_error *err) {
  const struct hsr_grid *grid = setup->world->roster.scene->grid;
  *s = (struct samples){.count = 0};
  if (!grid_is_even(grid))
    return hsr_fail(err, HSR_E_REFUSED,
                    "the grid's cells are not all of one size");
  place(s, grid);
  s->opacity = calloc(s->count, sizeof *s->opacity);
  s->rgba = calloc(s->count, sizeof *s->rgba);
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.work = NULL};
  struct hsr_job job = {.world = setup->world,
                        .view = view,
                        .scratch = &arena,
                        .tally = &tally,
                        .answer = answer};
  struct hsr_splats splats;
  bool good = s->opacity && s->rgba && !hsr_splats_begin(&splats, &job);
  if (good) {
    colour(s, &splats);
    colour_around(s);
  }
  hsr_arena_free(&arena);
  return good ? HSR_OK : hsr_fail_nomem(err);
}

void samples_free(struct samples *s) {
  free(s->opacity);
  free(s->rgba);
}

double samples_cells_per_length(const struct samples *s,
                                const struct hsr_view *view) {
  double sum = 0;
  for (int k = 0; k < 3; k++)
    sum += view->F[k] * view->F[k] / (s->spacing[k] * s->spacing[k]);
  return sqrt(sum);
}
