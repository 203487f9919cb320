/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Height maps: pictures whose first channel is a height. */
#include "common/files/image.h"
#include "common/files/volume/volume_words.h"
#include "common/grids/heights.h"

#include <math.h>
#include <stdlib.h>

/* A map while it is read. The arrays are malloc'ed. */
struct map {
  uint32_t n[2];
  float *height;   /* as in the picture, then by levels */
  float *rgb;      /* of a photograph; NULL: there is none */
  uint32_t *level; /* rounded down */
};

/* By their share of the greatest height, from 0 to levels - 1. A height that is
 * no number is 0. */
static enum hsr_status find_levels(struct map *map, uint32_t levels,
                                   struct hsr_error *err) {
  size_t n = (size_t)map->n[0] * map->n[1];
  float least = INFINITY, most = -INFINITY;
  map->level = malloc(n * sizeof *map->level);
  if (!map->level)
    return hsr_fail_nomem(err);
  for (size_t k = 0; k < n; k++)
    if (isfinite(map->height[k])) {
      least = fminf(least, map->height[k]);
      most = fmaxf(most, map->height[k]);
    }
  float width = most > least ? most - least : 1;
  for (size_t k = 0; k < n; k++) {
    map->height[k] = isfinite(map->height[k]) ? (map->height[k] - least) /
                                                    width * (float)(levels - 1)
                                              : 0;
    map->level[k] = (uint32_t)map->height[k];
  }
  return HSR_OK;
}

/* A photograph has one pixel for each height. */
static enum hsr_status read_photograph(struct map *map, const char *path,
                                       struct hsr_error *err) {
  uint32_t size[2];
  enum hsr_status status = hsr_image_read(path, true, size, &map->rgb, err);
  if (status || (size[0] == map->n[0] && size[1] == map->n[1]))
    return status;
  return hsr_fail(
      err, HSR_E_INPUT,
      "%.200s: has %u x %u pixels, but the map has %u x %u heights; "
      "there must be one for each",
      path, size[0], size[1], map->n[0], map->n[1]);
}

enum hsr_status hsr_heights_read(struct hsr_scene *scene, const char *path,
                                 const struct hsr_volume_words *words,
                                 struct hsr_error *err) {
  struct map map = {.height = NULL};
  struct hsr_grid grid = {.n_cells = 0};
  enum hsr_status status = hsr_image_read(path, false, map.n, &map.height, err);
  if (!status)
    status = find_levels(&map, words->levels, err);
  if (!status && *words->photograph)
    status = read_photograph(&map, words->photograph, err);
  if (!status) {
    const struct hsr_heights heights = {.n = {map.n[0], map.n[1]},
                                        .levels = words->levels,
                                        .level = map.level,
                                        .height = map.height,
                                        .rgb = map.rgb};
    status = hsr_heights_grid(&grid, &heights, err);
  }
  if (!status)
    status = hsr_scene_set_grid(scene, &grid);
  hsr_grid_free(&grid);
  free(map.height);
  free(map.rgb);
  free(map.level);
  return status == HSR_E_NOMEM ? hsr_fail_nomem(err) : status;
}
