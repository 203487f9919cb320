/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "config.h"

#include "common/files/cells/cells_library.h"
#include "common/adapt/adapt.h"
#include "common/files/library.h"
#include "common/files/suffix.h"
#include "common/scene/standard.h"

#include <stdlib.h>
#include <string.h>

bool hsr_cells_fit(enum hsr_cell_kind kind, const char *path) {
  if (hsr_ends_in(path, ".vtu"))
    return true;
  if (hsr_ends_in(path, ".vtp"))
    return kind == HSR_CELL_POLYGON || kind == HSR_CELL_LINE;
  return kind == HSR_CELL_POLYGON && hsr_ends_in(path, ".stl");
}

bool hsr_cells_keep_data(const char *path) {
  return hsr_ends_in(path, ".vtp") || hsr_ends_in(path, ".vtu");
}

enum hsr_status hsr_cells_write(const struct hsr_cells *cells, const char *path,
                                struct hsr_error *err) {
#if HSR_HAVE_VTK
  const void *table;
  enum hsr_status status =
      hsr_library_table("hsr-cells.so", "hsr_cells", &table, err);
  const struct hsr_cells_library *library = table;
  return status ? status : library->write(cells, path, err);
#else
  (void)cells;
  return hsr_fail(err, HSR_E_INPUT,
                  "%.200s: this build of hsr, without VTK, does not write it",
                  path);
#endif
}

/* --- Colours -------------------------------------------------------------- */

static int compare(const void *a, const void *b) {
  const float *x = a, *y = b;
  for (int k = 0; k < 4; k++)
    if (x[k] < y[k] || x[k] > y[k])
      return x[k] < y[k] ? -1 : 1;
  return 0;
}

bool hsr_scene_has_colours(const struct hsr_scene *scene) {
  static const float standard[3] = HSR_STANDARD_COLOUR;
  for (uint32_t o = 0; o < scene->n_objects; o++)
    for (uint32_t f = 0; f < scene->objects[o].n_faces; f++)
      if (memcmp(hsr_face_rgb(&scene->objects[o], f), standard,
                 sizeof standard) != 0)
        return true;
  return false;
}

static void get_colour(const struct hsr_object *object, uint32_t face,
                       float rgba[4]) {
  memcpy(rgba, hsr_face_rgb(object, face), 3 * sizeof *rgba);
  rgba[3] = hsr_face_opacity(object, face);
}

enum hsr_status hsr_colours_of(struct hsr_colours *c,
                               const struct hsr_object *objects,
                               uint32_t n_objects, struct hsr_error *err) {
  const size_t size = 4 * sizeof(float);
  size_t n = 0;
  *c = (struct hsr_colours){.rgba = NULL};
  for (uint32_t o = 0; o < n_objects; o++)
    n += objects[o].n_faces;
  c->rgba = malloc((n + 1) * size);
  c->of = malloc((n + 1) * sizeof *c->of);
  if (!c->rgba || !c->of)
    return hsr_fail_nomem(err);
  size_t all = 0;
  for (uint32_t o = 0; o < n_objects; o++)
    for (uint32_t f = 0; f < objects[o].n_faces; f++)
      get_colour(&objects[o], f, c->rgba + 4 * all++);
  qsort(c->rgba, n, size, compare);
  for (size_t k = 0; k < n; k++)
    if (!k || compare(c->rgba + 4 * (c->n - 1), c->rgba + 4 * k))
      memmove(c->rgba + 4 * (size_t)c->n++, c->rgba + 4 * k, size);
  all = 0;
  for (uint32_t o = 0; o < n_objects; o++)
    for (uint32_t f = 0; f < objects[o].n_faces; f++) {
      float rgba[4];
      get_colour(&objects[o], f, rgba);
      const float *found = bsearch(rgba, c->rgba, c->n, size, compare);
      c->of[all++] = (uint32_t)((found - c->rgba) / 4);
    }
  return HSR_OK;
}

void hsr_colours_free(struct hsr_colours *colours) {
  free(colours->rgba);
  free(colours->of);
}

/* --- Triangles ------------------------------------------------------------ */

enum hsr_status hsr_world_triangulate(const struct hsr_world *world,
                                      struct hsr_world *out, bool *changed,
                                      struct hsr_error *err) {
  const struct hsr_adapter *adapter = hsr_adapters;
  while (adapter->mends != HSR_TR)
    adapter++;
  *changed = false;
  *out = (struct hsr_world){.roster.scene = NULL};
  return adapter->adapt(world, out, changed, err);
}
