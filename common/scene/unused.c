/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/scene/unused.h"
#include "common/base/share.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_odd(const struct hsr_object *object, uint32_t v) {
  const double *at = object->xyz + 3 * (size_t)v;
  return !hsr_coordinates_fit(at, 3);
}

static uint32_t find_odd(void *context, uint32_t from, uint32_t to) {
  uint32_t v = from;
  while (v < to && !is_odd(context, v))
    v++;
  return v;
}

/* Whether a face uses an odd vertex. */
static bool find_use(const struct hsr_object *object, uint32_t *vertex,
                     uint32_t *face) {
  for (uint32_t f = 0; f < object->n_faces; f++)
    for (uint32_t k = object->start[f]; k < object->start[f + 1]; k++)
      if (is_odd(object, object->vertex[k])) {
        *vertex = object->vertex[k];
        *face = f;
        return true;
      }
  return false;
}

enum hsr_status hsr_object_settle_unused(struct hsr_object *object, int threads,
                                         uint32_t *n, uint32_t *vertex,
                                         uint32_t *face) {
  enum { RANGE = 1 << 16 }; /* vertices that a thread takes at a time */
  const uint32_t n_vertices = object->n_vertices;
  uint32_t v = hsr_share_search(threads, n_vertices, RANGE, find_odd, object);
  *n = 0;
  if (v == n_vertices || !object->n_faces)
    return HSR_OK;
  if (find_use(object, vertex, face))
    return HSR_E_INPUT;
  const double *place = object->xyz + 3 * (size_t)object->vertex[0];
  for (; v < n_vertices; v++)
    if (is_odd(object, v)) {
      memcpy(object->xyz + 3 * (size_t)v, place, 3 * sizeof *place);
      ++*n;
    }
  return HSR_OK;
}
