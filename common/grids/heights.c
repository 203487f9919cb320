/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/grids/heights.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* The least level beside a column. */
static uint32_t least_beside(const struct hsr_heights *h, uint32_t x,
                             uint32_t z) {
  const uint32_t *at = h->level + (size_t)z * h->n[0] + x;
  uint32_t least = *at;
  if (x > 0 && at[-1] < least)
    least = at[-1];
  if (x + 1 < h->n[0] && at[1] < least)
    least = at[1];
  if (z > 0 && at[-(ptrdiff_t)h->n[0]] < least)
    least = at[-(ptrdiff_t)h->n[0]];
  if (z + 1 < h->n[1] && at[h->n[0]] < least)
    least = at[h->n[0]];
  return least;
}

static enum hsr_status column_slice(void *data, uint32_t z, float *density,
                                    struct hsr_error *err) {
  const struct hsr_heights *h = data;
  (void)err;
  memset(density, 0, (size_t)h->n[0] * h->levels * sizeof *density);
  for (uint32_t x = 0; x < h->n[0]; x++) {
    uint32_t top = h->level[(size_t)z * h->n[0] + x];
    uint32_t least = least_beside(h, x, z);
    for (uint32_t y = least < top ? least + 1 : top; y <= top; y++)
      density[(size_t)y * h->n[0] + x] = 1;
  }
  return HSR_OK;
}

/* Water, meadows, rock and snow. */
static void by_level(float share, float rgb[3]) {
  static const float band[4][3] = {{0.10f, 0.20f, 0.45f},
                                   {0.15f, 0.35f, 0.10f},
                                   {0.35f, 0.28f, 0.20f},
                                   {0.85f, 0.87f, 0.90f}};
  float at = 3 * share;
  int low = at < 1 ? 0 : at < 2 ? 1 : 2;
  for (int k = 0; k < 3; k++)
    rgb[k] =
        band[low][k] + (at - (float)low) * (band[low + 1][k] - band[low][k]);
}

static void colour_of(void *data, const uint32_t at[3], float density,
                      float rgb[3]) {
  const struct hsr_heights *h = data;
  (void)density;
  if (h->rgb)
    memcpy(rgb, h->rgb + 3 * ((size_t)at[2] * h->n[0] + at[0]),
           3 * sizeof *rgb);
  else
    by_level((float)at[1] / (float)h->levels, rgb);
}

static double height_at(const struct hsr_heights *h, uint32_t x, uint32_t z) {
  size_t at = (size_t)z * h->n[0] + x;
  return h->height ? (double)h->height[at] : (double)h->level[at];
}

static void normal_of(void *data, const uint32_t at[3], double normal[3]) {
  const struct hsr_heights *h = data;
  uint32_t x0 = at[0] ? at[0] - 1 : 0, z0 = at[2] ? at[2] - 1 : 0,
           x1 = at[0] + 1 < h->n[0] ? at[0] + 1 : at[0],
           z1 = at[2] + 1 < h->n[1] ? at[2] + 1 : at[2];
  normal[0] =
      x1 > x0 ? (height_at(h, x0, at[2]) - height_at(h, x1, at[2])) / (x1 - x0)
              : 0;
  normal[1] = 1;
  normal[2] =
      z1 > z0 ? (height_at(h, at[0], z0) - height_at(h, at[0], z1)) / (z1 - z0)
              : 0;
}

enum hsr_status hsr_heights_grid(struct hsr_grid *grid,
                                 const struct hsr_heights *heights,
                                 struct hsr_error *err) {
  static const struct hsr_grid_keep positive = {.least = 1, .most = INFINITY};
  struct hsr_heights own = *heights;
  const uint32_t n[3] = {own.n[0], own.levels, own.n[1]};
  uint32_t most = n[0] > n[1] ? n[0] : n[1];
  most = most > n[2] ? most : n[2];
  double *at = malloc(most * sizeof *at);
  *grid = (struct hsr_grid){.n_cells = 0};
  if (!at)
    return hsr_fail_nomem(err);
  for (uint32_t k = 0; k < most; k++)
    at[k] = k;
  const struct hsr_grid_samples samples = {.n = {n[0], n[1], n[2]},
                                           .position = {at, at, at},
                                           .slice = column_slice,
                                           .colour = colour_of,
                                           .data = &own,
                                           .normal = normal_of};
  enum hsr_status status = hsr_grid_init(grid, &samples, &positive, err);
  free(at);
  return status;
}
