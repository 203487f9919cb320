/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Visible polygons as arrays. */
#include "bench/library/library.h"
#include "common/answers/kinds/polygons.h"

#include <stdlib.h>

static enum hsr_status make_room(struct lib_polygons *to,
                                 const struct hsr_polygons *from,
                                 struct hsr_error *err) {
  to->face = malloc((from->n_regions + 1) * sizeof *to->face);
  to->cycle = malloc((from->n_regions + 1) * sizeof *to->cycle);
  to->point = malloc((from->n_cycles + 1) * sizeof *to->point);
  to->xy = malloc((2 * from->n_sides + 1) * sizeof *to->xy);
  return to->face && to->cycle && to->point && to->xy ? HSR_OK
                                                      : hsr_fail_nomem(err);
}

void lib_polygons_free(struct lib_polygons *polygons) {
  free(polygons->face);
  free(polygons->cycle);
  free(polygons->point);
  free(polygons->xy);
  *polygons = (struct lib_polygons){.face = NULL};
}

enum hsr_status lib_polygons_make(struct lib_answer *answer,
                                  struct hsr_error *err) {
  const struct hsr_polygons *from = hsr_answer_polygons_of(&answer->answer);
  struct lib_polygons *to = &answer->polygons;
  if (!from)
    return HSR_OK;
  lib_polygons_free(to);
  enum hsr_status status = make_room(to, from, err);
  if (status)
    return status;
  size_t cycles = 0, points = 0;
  to->cycle[0] = to->point[0] = 0;
  for (size_t r = 0; r < from->n_regions; r++) {
    const struct hsr_polygon_region *region = &from->region[r];
    to->face[r] = region->face;
    for (size_t c = region->first; c < region->first + region->n; c++) {
      const struct hsr_polygon_cycle *cycle = &from->cycle[c];
      for (size_t s = cycle->first; s < cycle->first + cycle->n; s++)
        memcpy(&to->xy[2 * points++], from->side[s].at, 2 * sizeof *to->xy);
      to->point[++cycles] = points;
    }
    to->cycle[r + 1] = cycles;
  }
  return HSR_OK;
}

enum hsr_status hsr_get_polygons(const struct lib_answer *answer,
                                 struct hsr_polygon_arrays *polygons,
                                 struct hsr_error *err) {
  if (!answer)
    return lib_null("answer", err);
  const struct hsr_polygons *own = hsr_answer_polygons_of(&answer->answer);
  if (!own)
    return hsr_fail(err, HSR_E_USAGE,
                    "an answer of the kind %s has no polygons",
                    answer->answer.form.type->name);
  struct hsr_polygon_arrays found = {.n_regions = own->n_regions,
                                     .n_cycles = own->n_cycles,
                                     .n_points = own->n_sides,
                                     .face = answer->polygons.face,
                                     .cycle = answer->polygons.cycle,
                                     .point = answer->polygons.point,
                                     .xy = answer->polygons.xy};
  return lib_give("polygons", polygons, sizeof found, &found, err);
}
