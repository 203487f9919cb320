/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/scene/grid_object.h"

#include <stdlib.h>
#include <string.h>

/* The vertices of the corners of cells, in two layers: those below and those
 * above a slice of cells. */
struct layers {
  const struct hsr_grid *grid;
  struct hsr_object *object;
  uint32_t *below, *above; /* NONE: not made yet */
  size_t size;             /* corners a layer */
};
static const uint32_t NONE = UINT32_MAX;

static void forget(uint32_t *layer, size_t size) {
  memset(layer, 0xff, size * sizeof *layer);
}

static enum hsr_status vertex_of(struct layers *layers, const uint32_t at[3],
                                 bool is_above, uint32_t *vertex) {
  const struct hsr_grid *g = layers->grid;
  uint32_t *layer = is_above ? layers->above : layers->below;
  uint32_t *place = &layer[(size_t)at[1] * (g->n[0] + 1) + at[0]];
  enum hsr_status status = HSR_OK;
  if (*place == NONE)
    status = hsr_object_vertex(layers->object, g->bound[0][at[0]],
                               g->bound[1][at[1]], g->bound[2][at[2]], place);
  *vertex = *place;
  return status;
}

static enum hsr_status add_side(struct layers *layers, const uint32_t cell[3],
                                int side, const float rgb[3]) {
  uint32_t corner[4][3], vertex[4];
  hsr_grid_corner_places(cell, side, corner);
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < 4 && !status; k++)
    status = vertex_of(layers, corner[k], corner[k][2] > cell[2], &vertex[k]);
  return status ? status : hsr_object_face(layers->object, vertex, 4, rgb);
}

static enum hsr_status add_slice(struct layers *layers, uint32_t k) {
  const struct hsr_grid *g = layers->grid;
  enum hsr_status status = HSR_OK;
  for (uint32_t j = 0; j < g->n[1]; j++) {
    size_t row = (size_t)k * g->n[1] + j;
    for (uint32_t c = g->row[row]; c < g->row[row + 1] && !status; c++) {
      const uint32_t at[3] = {g->x[c], j, k};
      float rgb[3];
      hsr_grid_rgb(g, c, rgb);
      for (int side = 0; side < 6 && !status; side++)
        if (g->sides[c] >> side & 1)
          status = add_side(layers, at, side, rgb);
    }
  }
  return status;
}

enum hsr_status hsr_grid_make_object(const struct hsr_grid *grid,
                                     struct hsr_object *object) {
  struct layers layers = {.grid = grid, .object = object};
  layers.size = ((size_t)grid->n[0] + 1) * ((size_t)grid->n[1] + 1);
  uint32_t *memory = malloc(2 * layers.size * sizeof *memory);
  if (!memory)
    return HSR_E_NOMEM;
  layers.below = memory;
  layers.above = memory + layers.size;
  forget(layers.above, layers.size);
  enum hsr_status status = HSR_OK;
  for (uint32_t k = 0; k < grid->n[2] && !status; k++) {
    uint32_t *kept = layers.above;
    layers.above = layers.below;
    layers.below = kept;
    forget(layers.above, layers.size);
    status = add_slice(&layers, k);
  }
  object->one_sided = true;
  free(memory);
  return status;
}
