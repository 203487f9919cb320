/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/suite/flat.h"
#include "bench/suite/exact.h"
#include "common/files/cells/cells.h"
#include "common/scene/pieces.h"

#include <stdio.h>
#include <stdlib.h>

/* A new object for the faces from `first` on. */
static struct hsr_object *begin_run(struct hsr_scene *flat, bool one_sided,
                                    uint32_t first) {
  char name[40];
  snprintf(name, sizeof name, "%s-sided-from-%u", one_sided ? "one" : "two",
           first);
  struct hsr_object *object = hsr_scene_object(flat, name);
  if (object)
    object->one_sided = one_sided;
  return object;
}

/* --- Polygons ------------------------------------------------------------- */

/* One instance: its vertices, from `base` on, and its faces. */
static enum hsr_status add_instance(struct hsr_object *object,
                                    const struct hsr_world *world,
                                    uint32_t instance, uint32_t base,
                                    uint32_t n_vertices) {
  const struct hsr_mesh *mesh = &world->mesh;
  const uint32_t *first = world->roster.first + instance;
  const uint32_t shift = base - object->n_vertices;
  enum hsr_status status = HSR_OK;
  for (uint32_t v = base; v < base + n_vertices && !status; v++)
    status =
        hsr_object_vertex(object, mesh->x[v], mesh->y[v], mesh->z[v], NULL);
  uint32_t *corner =
      malloc(((size_t)hsr_most_corners(world) + 1) * sizeof *corner);
  if (!corner)
    return HSR_E_NOMEM;
  for (uint32_t f = first[0]; f < first[1] && !status; f++) {
    const uint32_t n = hsr_face_size(world, f);
    for (uint32_t k = 0; k < n; k++)
      corner[k] = mesh->vertex[mesh->start[f] + k] - shift;
    status = hsr_object_face(object, corner, n, NULL);
  }
  free(corner);
  return status;
}

enum hsr_status flat_make(const struct hsr_world *world,
                          struct hsr_scene **flat, struct hsr_error *err) {
  const struct hsr_scene *scene = world->roster.scene;
  struct hsr_object *object = NULL;
  uint32_t base = 0;
  enum hsr_status status = HSR_OK;
  *flat = hsr_scene_new(scene->name);
  if (!*flat)
    return hsr_fail_nomem(err);
  for (uint32_t i = 0; i < scene->n_instances && !status; i++) {
    const struct hsr_object *from = &scene->objects[scene->instances[i].object];
    if (!object || object->one_sided != from->one_sided)
      object = begin_run(*flat, from->one_sided, world->roster.first[i]);
    if (!object)
      return hsr_fail_nomem(err);
    status = add_instance(object, world, i, base, from->n_vertices);
    base += from->n_vertices;
  }
  return status ? hsr_fail_nomem(err) : HSR_OK;
}

/* --- Triangles ------------------------------------------------------------ */

static void corners_of(const struct hsr_world *world, uint32_t f,
                       double corner[3][3], bool *exact) {
  const struct hsr_mesh *mesh = &world->mesh;
  for (uint32_t k = 0; k < 3; k++) {
    const uint32_t v = mesh->vertex[mesh->start[f] + k];
    const double x[3] = {mesh->x[v], mesh->y[v], mesh->z[v]};
    for (int c = 0; c < 3; c++) {
      corner[k][c] = (double)(float)x[c];
      *exact &= corner[k][c] == x[c];
    }
  }
}

static enum hsr_status add_triangle(struct hsr_object *object,
                                    const double corner[3][3]) {
  uint32_t v[3];
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < 3 && !status; k++)
    status = hsr_object_vertex(object, corner[k][0], corner[k][1], corner[k][2],
                               &v[k]);
  return status ? status : hsr_object_face(object, v, 3, NULL);
}

/* Fills `rounded` and what belongs to it. *exact becomes false if a coordinate
 * was rounded. */
static enum hsr_status round_triangles(const struct hsr_world *whole,
                                       const struct hsr_world *world,
                                       struct flat_triangles *t, bool *exact) {
  struct hsr_object *object = NULL;
  double corner[3][3];
  uint32_t n = 0;
  for (uint32_t k = 0; k < t->n; k++) {
    corners_of(world, k, corner, exact);
    if (!exact_has_area(corner)) {
      t->n_without_area++;
      continue;
    }
    const bool one_sided = whole->mesh.one_sided[t->of[k]];
    if (!object || object->one_sided != one_sided)
      object = begin_run(t->rounded, one_sided, n);
    if (!object || add_triangle(object, corner))
      return HSR_E_NOMEM;
    t->of_rounded[n++] = t->of[k];
  }
  return HSR_OK;
}

static enum hsr_status list_triangles(const struct hsr_world *whole,
                                      const struct hsr_world *world,
                                      bool changed, struct flat_triangles *t,
                                      struct hsr_error *err) {
  bool exact = true;
  t->n = world->n_faces;
  t->of = malloc(t->n * sizeof *t->of);
  t->of_rounded = malloc(t->n * sizeof *t->of_rounded);
  t->rounded = hsr_scene_new(whole->roster.scene->name);
  if (!t->of || !t->of_rounded || !t->rounded)
    return hsr_fail_nomem(err);
  for (uint32_t k = 0; k < t->n; k++)
    t->of[k] = hsr_world_parent(world, k);
  if (round_triangles(whole, world, t, &exact))
    return hsr_fail_nomem(err);
  if (exact && !changed) {
    hsr_scene_delete(t->rounded);
    t->rounded = NULL;
  }
  return HSR_OK;
}

enum hsr_status flat_triangulate(const struct hsr_world *world,
                                 struct flat_triangles *triangles,
                                 struct hsr_error *err) {
  struct hsr_world divided;
  bool changed = false;
  *triangles = (struct flat_triangles){.n = 0};
  enum hsr_status status =
      hsr_world_triangulate(world, &divided, &changed, err);
  if (!status)
    status = list_triangles(world, changed ? &divided : world, changed,
                            triangles, err);
  if (changed)
    hsr_world_free(&divided);
  return status;
}

void flat_free(struct flat_triangles *triangles) {
  free(triangles->of);
  free(triangles->of_rounded);
  hsr_scene_delete(triangles->rounded);
}
