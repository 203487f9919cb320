/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes of arrays: faces with instances, and grids. */
#include "bench/library/library.h"
#include "common/base/share.h"
#include "common/files/mesh/exchange.h"
#include "common/grids/densities.h"
#include "common/grids/grid.h"

#include <math.h>
#include <stdlib.h>

/* --- Faces ---------------------------------------------------------------- */

static enum hsr_status check_length(const char *what, size_t n,
                                    struct hsr_error *err) {
  return n < UINT32_MAX ? HSR_OK
                        : hsr_fail(err, HSR_E_USAGE,
                                   "arrays: %s is %zu; it must be below 2^32 - "
                                   "1",
                                   what, n);
}

/* Whether the lengths of the arrays fit one another. */
static enum hsr_status check_arrays(const struct hsr_arrays *a,
                                    struct hsr_error *err) {
  if (!a->xyz || !a->vertex)
    return lib_null(a->xyz ? "arrays: vertex" : "arrays: xyz", err);
  enum hsr_status status = check_length("n_vertices", a->n_vertices, err);
  if (!status)
    status = check_length("n_faces", a->n_faces, err);
  if (!status)
    status = check_length("n_corners", a->n_corners, err);
  if (!status)
    status = check_length("n_instances", a->n_instances, err);
  if (!status && a->n_instances && !a->instance)
    status = lib_null("arrays: instance", err);
  if (status)
    return status;
  size_t corners = a->ring ? 0 : 3 * a->n_faces;
  for (size_t f = 0; a->ring && f < a->n_faces; f++)
    corners += a->ring[f];
  if (!a->n_faces || corners != a->n_corners)
    return hsr_fail(err, HSR_E_USAGE,
                    "arrays: %zu faces have %zu corners, but n_corners is %zu",
                    a->n_faces, corners, a->n_corners);
  return HSR_OK;
}

static enum hsr_status add_vertices(struct hsr_object *object,
                                    const struct hsr_arrays *a,
                                    struct hsr_error *err) {
  for (size_t v = 0; v < a->n_vertices; v++) {
    const double *at = &a->xyz[3 * v];
    enum hsr_status status =
        hsr_object_vertex(object, at[0], at[1], at[2], NULL);
    if (status == HSR_E_NOMEM)
      return hsr_fail_nomem(err);
    if (status)
      return hsr_fail(err, HSR_E_INPUT,
                      "arrays: vertex %zu: a coordinate is not finite", v);
  }
  return HSR_OK;
}

/* Whether all n are in 0 to 1. */
static bool are_shares(const float *x, int n) {
  for (int k = 0; k < n; k++)
    if (!(x[k] >= 0 && x[k] <= 1))
      return false;
  return true;
}

/* Adds face f, whose first corner is at `vertex`. */
static enum hsr_status add_face(struct hsr_object *object,
                                const struct hsr_arrays *a, size_t f,
                                const uint32_t *vertex) {
  const float *rgb = a->rgb ? &a->rgb[3 * f] : NULL;
  enum hsr_status status =
      hsr_object_face(object, vertex, a->ring ? a->ring[f] : 3, rgb);
  return status || !a->opacity
             ? status
             : hsr_object_set_opacity(object, (uint32_t)f, a->opacity[f]);
}

static enum hsr_status add_faces(struct hsr_object *object,
                                 const struct hsr_arrays *a,
                                 struct hsr_error *err) {
  const uint32_t *vertex = a->vertex;
  for (size_t f = 0; f < a->n_faces; f++) {
    if (a->rgb && !are_shares(&a->rgb[3 * f], 3))
      return hsr_fail(err, HSR_E_INPUT,
                      "arrays: face %zu: a colour is not in 0 to 1", f);
    if (a->opacity && !are_shares(&a->opacity[f], 1))
      return hsr_fail(err, HSR_E_INPUT,
                      "arrays: face %zu: its opacity is not in 0 to 1", f);
    enum hsr_status status = add_face(object, a, f, vertex);
    if (status == HSR_E_NOMEM)
      return hsr_fail_nomem(err);
    if (status)
      return hsr_fail(err, HSR_E_INPUT,
                      "arrays: face %zu: it has fewer than 3 vertices, or one "
                      "that is out of range or follows itself",
                      f);
    vertex += a->ring ? a->ring[f] : 3;
  }
  return HSR_OK;
}

/* The object, once or in each of its places. */
static enum hsr_status add_instances(struct hsr_scene *scene,
                                     const struct hsr_arrays *a,
                                     struct hsr_error *err) {
  for (size_t k = 0; k < a->n_instances; k++) {
    enum hsr_status status = hsr_scene_instance(scene, 0, &a->instance[12 * k]);
    if (status == HSR_E_NOMEM)
      return hsr_fail_nomem(err);
    if (status)
      return hsr_fail(err, HSR_E_INPUT,
                      "arrays: instance %zu: a number is not finite", k);
  }
  return HSR_OK;
}

/* Fills a scene, which is empty. */
static enum hsr_status fill(struct hsr_scene *scene, const struct hsr_arrays *a,
                            const struct hsr_open_options *options,
                            struct hsr_error *err) {
  bool solid = false;
  struct hsr_object *object = hsr_scene_object(scene, scene->name);
  if (!object ||
      hsr_object_reserve(object, (uint32_t)a->n_vertices, (uint32_t)a->n_faces))
    return hsr_fail_nomem(err);
  scene->threads = hsr_threads(options->threads);
  enum hsr_status status = add_vertices(object, a, err);
  if (!status)
    status = add_faces(object, a, err);
  if (!status)
    status = add_instances(scene, a, err);
  if (status)
    return status;
  if (hsr_object_is_solid(object, scene->threads, &solid))
    return hsr_fail_nomem(err);
  object->one_sided = solid && !options->two_sided;
  return hsr_scene_finish(scene, err);
}

/* Makes *handle of a scene that is filled with this status, or deletes the
 * scene. */
static enum hsr_status wrap(struct hsr_scene *scene, enum hsr_status status,
                            struct lib_scene **handle, struct hsr_error *err) {
  struct lib_scene *made = status ? NULL : lib_scene_new();
  if (!made) {
    hsr_scene_delete(scene);
    return status ? status : hsr_fail_nomem(err);
  }
  hsr_scene_enlarge(scene);
  made->scene = scene;
  *handle = made;
  return HSR_OK;
}

enum hsr_status hsr_open_arrays(const struct hsr_arrays *arrays,
                                const struct hsr_open_options *options,
                                struct lib_scene **scene,
                                struct hsr_error *err) {
  struct hsr_open_options taken;
  struct hsr_arrays a;
  if (scene)
    *scene = NULL;
  if (!arrays || !scene)
    return lib_null(arrays ? "scene" : "arrays", err);
  enum hsr_status status = lib_open_options(options, &taken, err);
  if (!status)
    status = lib_take("arrays", &a, sizeof a, arrays, err);
  if (!status)
    status = check_arrays(&a, err);
  if (status)
    return status;
  struct hsr_scene *made = hsr_scene_new(a.name ? a.name : "arrays");
  status = made ? fill(made, &a, &taken, err) : hsr_fail_nomem(err);
  return wrap(made, status, scene, err);
}

/* --- Grids ---------------------------------------------------------------- */

enum { MOST_SAMPLES = 1 << 20 }; /* along an axis */

static size_t index_of(const struct hsr_grid_arrays *g, const uint32_t at[3]) {
  return ((size_t)at[2] * g->n[1] + at[1]) * g->n[0] + at[0];
}

static enum hsr_status copy_slice(void *data, uint32_t k, float *density,
                                  struct hsr_error *err) {
  (void)err;
  const struct hsr_grid_arrays *g = data;
  size_t n = (size_t)g->n[0] * g->n[1];
  memcpy(density, g->density + n * k, n * sizeof *density);
  return HSR_OK;
}

static void copy_colour(void *data, const uint32_t at[3], float density,
                        float rgb[3]) {
  (void)density;
  const struct hsr_grid_arrays *g = data;
  memcpy(rgb, g->rgb + 3 * index_of(g, at), 3 * sizeof *rgb);
}

static enum hsr_status check_grid(const struct hsr_grid_arrays *g,
                                  struct hsr_error *err) {
  size_t n = 1;
  if (!g->density)
    return lib_null("grid: density", err);
  for (int axis = 0; axis < 3; axis++) {
    if (g->n[axis] < 1 || g->n[axis] > MOST_SAMPLES)
      return hsr_fail(err, HSR_E_USAGE, "grid: n[%d] is %u; it must be 1 to %d",
                      axis, g->n[axis], MOST_SAMPLES);
    n *= g->n[axis];
  }
  if (!(g->least <= g->most))
    return hsr_fail(err, HSR_E_USAGE, "grid: least must not be above most");
  for (size_t k = 0; g->rgb && k < n; k++)
    if (!are_shares(&g->rgb[3 * k], 3))
      return hsr_fail(err, HSR_E_INPUT,
                      "grid: sample %zu: a colour is not in 0 to 1", k);
  return HSR_OK;
}

/* Places 0, 1, 2 ... for axes that have none of their own. */
static double *count_places(const struct hsr_grid_arrays *g) {
  uint32_t n = 0;
  for (int axis = 0; axis < 3; axis++)
    n = g->n[axis] > n ? g->n[axis] : n;
  double *at = malloc(n * sizeof *at);
  for (uint32_t k = 0; at && k < n; k++)
    at[k] = k;
  return at;
}

static enum hsr_status make_grid(const struct hsr_grid_arrays *g,
                                 const double *places, struct hsr_grid *grid,
                                 struct hsr_error *err) {
  struct hsr_grid_samples samples = {.n = {g->n[0], g->n[1], g->n[2]},
                                     .slice = copy_slice,
                                     .colour = g->rgb ? copy_colour : NULL,
                                     .data = (void *)g};
  const struct hsr_grid_keep keep = {.least = g->least, .most = g->most};
  for (int axis = 0; axis < 3; axis++)
    samples.position[axis] = g->at[axis] ? g->at[axis] : places;
  struct hsr_densities *d = malloc(sizeof *d);
  enum hsr_status status =
      d ? hsr_densities_measure(d, g->n[2], (size_t)g->n[0] * g->n[1],
                                copy_slice, (void *)g, err)
        : hsr_fail_nomem(err);
  if (!status) {
    samples.low = d->low;
    samples.high = d->high;
    status = hsr_grid_init(grid, &samples, &keep, err);
  }
  grid->densities = d;
  return status;
}

static enum hsr_status fill_grid(struct hsr_scene *scene,
                                 const struct hsr_grid_arrays *g, int threads,
                                 struct hsr_error *err) {
  struct hsr_grid grid = {.n_cells = 0};
  scene->threads = hsr_threads(threads);
  double *places = count_places(g);
  enum hsr_status status =
      places ? make_grid(g, places, &grid, err) : hsr_fail_nomem(err);
  free(places);
  if (!status && hsr_scene_set_grid(scene, &grid))
    status = hsr_fail_nomem(err);
  hsr_grid_free(&grid);
  return status ? status : hsr_scene_finish(scene, err);
}

enum hsr_status hsr_open_grid(const struct hsr_grid_arrays *grid,
                              const struct hsr_open_options *options,
                              struct lib_scene **scene, struct hsr_error *err) {
  struct hsr_open_options taken;
  struct hsr_grid_arrays g;
  if (scene)
    *scene = NULL;
  if (!grid || !scene)
    return lib_null(grid ? "scene" : "grid", err);
  enum hsr_status status = lib_open_options(options, &taken, err);
  if (!status)
    status = lib_take("grid", &g, sizeof g, grid, err);
  if (!status)
    status = check_grid(&g, err);
  if (status)
    return status;
  struct hsr_scene *made = hsr_scene_new(g.name ? g.name : "grid");
  status = made ? fill_grid(made, &g, taken.threads, err) : hsr_fail_nomem(err);
  return wrap(made, status, scene, err);
}
