/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/scene/scene.h"
#include "common/base/arena.h"
#include "common/polygon/polygon.h"
#include "common/base/numbers.h"
#include "common/base/share.h"
#include "common/scene/grid_object.h"
#include "common/scene/motion.h"
#include "common/scene/part.h"
#include "common/scene/planes.h"
#include "common/scene/standard.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

const char *const hsr_scene_subject_name[HSR_N_SCENE_SUBJECTS] = {"faces",
                                                                  "a grid"};

/* With coordinates up to this size, every product that the filters and the
 * intervals form is within the range of doubles; see common/exact/screen.h. */
static const double LARGEST_COORDINATE = 1e30;

struct hsr_scene *hsr_scene_new(const char *name) {
  struct hsr_scene *scene = calloc(1, sizeof *scene);
  if (!scene)
    return NULL;
  scene->name = strdup(name);
  if (!scene->name) {
    free(scene);
    return NULL;
  }
  for (int k = 0; k < 3; k++)
    scene->stand[k][k] = 1;
  return scene;
}

static void object_free(struct hsr_object *object) {
  free(object->name);
  free(object->xyz);
  free(object->start);
  free(object->vertex);
  free(object->rgb);
  free(object->face_opacity);
  free(object->group.vertex);
}

void hsr_scene_delete(struct hsr_scene *scene) {
  if (!scene)
    return;
  for (uint32_t o = 0; o < scene->n_objects; o++)
    object_free(&scene->objects[o]);
  free(scene->objects);
  free(scene->instances);
  free(scene->views);
  if (scene->grid)
    hsr_grid_free(scene->grid);
  free(scene->grid);
  hsr_motions_free(scene->motions);
  free(scene->name);
  free(scene);
}

/* Makes room for `larger` elements of `size` bytes in *array. False if memory
 * ran out; the array is then as it was. */
static bool make_room(void *array, uint32_t *cap, uint32_t larger,
                      size_t size) {
  if (larger <= *cap)
    return true;
  void *old;
  memcpy(&old, array, sizeof old);
  void *moved = realloc(old, (size_t)larger * size);
  if (!moved)
    return false;
  hsr_huge_pages(moved, (size_t)larger * size);
  memcpy(array, &moved, sizeof moved);
  *cap = larger;
  return true;
}

/* The same for `wanted` elements at least, by doubling. */
static bool reserve(void *array, uint32_t *cap, uint32_t wanted, size_t size) {
  if (wanted <= *cap)
    return true;
  uint32_t larger = *cap < 16 ? 16 : *cap;
  while (larger < wanted)
    larger = larger > UINT32_MAX / 2 ? UINT32_MAX : 2 * larger;
  return make_room(array, cap, larger, size);
}

struct hsr_object *hsr_scene_object(struct hsr_scene *scene, const char *name) {
  if (!reserve(&scene->objects, &scene->cap_objects, scene->n_objects + 1,
               sizeof *scene->objects))
    return NULL;
  struct hsr_object object = {.colour = HSR_STANDARD_COLOUR, .opacity = 1};
  object.name = strdup(name);
  object.start = malloc(16 * sizeof *object.start);
  if (!object.name || !object.start) {
    object_free(&object);
    return NULL;
  }
  object.start[0] = 0;
  object.cap_faces = 15;
  scene->objects[scene->n_objects] = object;
  return &scene->objects[scene->n_objects++];
}

enum hsr_status hsr_scene_set_grid(struct hsr_scene *scene,
                                   struct hsr_grid *grid) {
  scene->subject = HSR_GRID;
  scene->grid = malloc(sizeof *grid);
  if (!scene->grid)
    hsr_grid_free(grid);
  else
    *scene->grid = *grid;
  *grid = (struct hsr_grid){.n_cells = 0};
  return scene->grid && hsr_scene_object(scene, "cells") ? HSR_OK : HSR_E_NOMEM;
}

uint64_t hsr_scene_faces(const struct hsr_scene *scene) {
  uint64_t n = 0;
  if (scene->grid)
    return scene->grid->n_faces;
  for (uint32_t i = 0; i < scene->n_instances; i++)
    n += scene->objects[scene->instances[i].object].n_faces;
  return n;
}

enum hsr_status hsr_scene_make_faces(struct hsr_scene *scene,
                                     struct hsr_error *err) {
  if (!hsr_scene_lacks_faces(scene))
    return HSR_OK;
  return hsr_grid_make_object(scene->grid, &scene->objects[0])
             ? hsr_fail_nomem(err)
             : HSR_OK;
}

enum hsr_status hsr_object_reserve(struct hsr_object *object,
                                   uint32_t n_vertices, uint32_t n_faces) {
  uint32_t cap = object->cap_faces + 1;
  if (!make_room(&object->xyz, &object->cap_vertices, n_vertices,
                 3 * sizeof *object->xyz) ||
      !make_room(&object->start, &cap, n_faces + 1, sizeof *object->start))
    return HSR_E_NOMEM;
  /* What belongs to single faces is as long as cap_faces says. */
  if (!object->rgb && !object->face_opacity)
    object->cap_faces = cap - 1;
  return HSR_OK;
}

enum hsr_status hsr_object_vertex(struct hsr_object *object, double x, double y,
                                  double z, uint32_t *number) {
  if (!isfinite(x) || !isfinite(y) || !isfinite(z) ||
      object->n_vertices >= UINT32_MAX - 1)
    return HSR_E_INPUT;
  if (!reserve(&object->xyz, &object->cap_vertices, object->n_vertices + 1,
               3 * sizeof *object->xyz))
    return HSR_E_NOMEM;
  double *v = object->xyz + 3 * (size_t)object->n_vertices;
  v[0] = x;
  v[1] = y;
  v[2] = z;
  if (number)
    *number = object->n_vertices;
  object->n_vertices++;
  return HSR_OK;
}

/* Gives every face so far the object's colour, so that the next one may have
 * another. */
static bool colour_faces(struct hsr_object *object) {
  object->rgb = malloc(3 * ((size_t)object->cap_faces + 1) * sizeof(float));
  if (!object->rgb)
    return false;
  for (uint32_t f = 0; f < object->n_faces; f++)
    memcpy(object->rgb + 3 * (size_t)f, object->colour, 3 * sizeof(float));
  return true;
}

/* Gives every face so far the object's opacity. */
static bool open_faces(struct hsr_object *object) {
  object->face_opacity =
      malloc(((size_t)object->cap_faces + 1) * sizeof(float));
  for (uint32_t f = 0; object->face_opacity && f < object->n_faces; f++)
    object->face_opacity[f] = object->opacity;
  return object->face_opacity;
}

/* Makes an array that has `width` numbers for each face as long as start[]. It
 * may be NULL, and stays so. */
static bool lengthen(float **array, uint32_t cap, size_t width) {
  if (!*array)
    return true;
  float *longer = realloc(*array, width * cap * sizeof *longer);
  if (longer)
    *array = longer;
  return longer;
}

/* Room for one more face, of n corners. */
static bool reserve_face(struct hsr_object *object, uint32_t n) {
  uint32_t n_corners = object->start[object->n_faces];
  uint32_t cap = object->cap_faces + 1; /* of start[], one longer */
  if (!reserve(&object->start, &cap, object->n_faces + 2,
               sizeof *object->start))
    return false;
  if (cap - 1 > object->cap_faces && (!lengthen(&object->rgb, cap, 3) ||
                                      !lengthen(&object->face_opacity, cap, 1)))
    return false; /* an array is longer than cap_faces says: no harm */
  object->cap_faces = cap - 1;
  return reserve(&object->vertex, &object->cap_corners, n_corners + n,
                 sizeof *object->vertex);
}

/* Whether a vertex follows itself, all around. */
static bool has_repeats(const uint32_t *vertices, size_t n) {
  for (size_t i = 0, before = n - 1; i < n; before = i++)
    if (vertices[i] == vertices[before])
      return true;
  return false;
}

enum hsr_status hsr_object_face(struct hsr_object *object,
                                const uint32_t *vertices, size_t n,
                                const float *rgb) {
  uint32_t n_corners = object->start[object->n_faces];
  if (n < 3 || n > UINT32_MAX - 2 - n_corners ||
      object->n_faces >= UINT32_MAX - 2)
    return HSR_E_INPUT;
  for (size_t i = 0; i < n; i++)
    if (vertices[i] >= object->n_vertices)
      return HSR_E_INPUT;
  if (has_repeats(vertices, n))
    return HSR_E_INPUT;
  if (!reserve_face(object, (uint32_t)n) ||
      (rgb && !object->rgb && !colour_faces(object)))
    return HSR_E_NOMEM;
  memcpy(object->vertex + n_corners, vertices, n * sizeof *vertices);
  if (object->rgb)
    memcpy(object->rgb + 3 * (size_t)object->n_faces,
           rgb ? rgb : object->colour, 3 * sizeof(float));
  if (object->face_opacity)
    object->face_opacity[object->n_faces] = object->opacity;
  object->n_faces++;
  object->start[object->n_faces] = n_corners + (uint32_t)n;
  return HSR_OK;
}

enum hsr_status hsr_object_set_opacity(struct hsr_object *object, uint32_t face,
                                       float opacity) {
  if (hsr_face_opacity(object, face) == opacity)
    return HSR_OK;
  if (!object->face_opacity && !open_faces(object))
    return HSR_E_NOMEM;
  object->face_opacity[face] = opacity;
  return HSR_OK;
}

uint32_t *hsr_object_triangles(struct hsr_object *object, uint32_t n) {
  uint32_t corner = object->start[object->n_faces],
           cap = object->cap_faces + 1; /* of start[], one longer */
  if (n > (UINT32_MAX - 2 - corner) / 3 ||
      n > UINT32_MAX - 3 - object->n_faces || object->rgb ||
      object->face_opacity ||
      !reserve(&object->start, &cap, object->n_faces + n + 1,
               sizeof *object->start))
    return NULL;
  object->cap_faces = cap - 1;
  if (!reserve(&object->vertex, &object->cap_corners, corner + 3 * n,
               sizeof *object->vertex))
    return NULL;
  for (uint32_t k = 1; k <= n; k++)
    object->start[object->n_faces + k] = corner + 3 * k;
  object->n_faces += n;
  return object->vertex + corner;
}

enum hsr_status hsr_scene_instance(struct hsr_scene *scene, uint32_t object,
                                   const double m[12]) {
  static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  if (!m)
    m = identity;
  for (int i = 0; i < 12; i++)
    if (!isfinite(m[i]))
      return HSR_E_INPUT;
  uint32_t n = scene->n_instances;
  if (object >= scene->n_objects || n == UINT32_MAX ||
      (n && scene->instances[n - 1].object > object))
    return HSR_E_INPUT;
  if (!reserve(&scene->instances, &scene->cap_instances, n + 1,
               sizeof *scene->instances))
    return HSR_E_NOMEM;
  scene->instances[n].object = object;
  memcpy(scene->instances[n].m, m, sizeof scene->instances[n].m);
  scene->n_instances++;
  return HSR_OK;
}

enum hsr_status hsr_scene_view(struct hsr_scene *scene,
                               const struct hsr_camera *camera) {
  enum hsr_status status = hsr_camera_check(camera, NULL);
  if (status)
    return status;
  if (!reserve(&scene->views, &scene->cap_views, scene->n_views + 1,
               sizeof *scene->views))
    return HSR_E_NOMEM;
  scene->views[scene->n_views++] = *camera;
  return HSR_OK;
}

bool hsr_coordinates_fit(const double *v, int n) {
  for (int i = 0; i < n; i++)
    if (!(fabs(v[i]) <= LARGEST_COORDINATE))
      return false;
  return true;
}

enum hsr_status hsr_camera_check(const struct hsr_camera *camera,
                                 struct hsr_error *err) {
  if (!hsr_coordinates_fit(camera->eye, 3) ||
      !hsr_coordinates_fit(camera->at, 3) ||
      !hsr_coordinates_fit(camera->up, 3) ||
      !hsr_coordinates_fit(&camera->fov, 1) ||
      !hsr_coordinates_fit(&camera->near, 1) ||
      !hsr_coordinates_fit(&camera->parallel, 1) ||
      !hsr_coordinates_fit(camera->light, 4))
    return hsr_fail(err, HSR_E_INPUT,
                    "camera: a value is not finite or above %g",
                    LARGEST_COORDINATE);
  if (!(camera->parallel >= 0))
    return hsr_fail(err, HSR_E_INPUT,
                    "camera: the height of a parallel view must not be "
                    "negative");
  if (!(camera->parallel > 0 || (camera->fov > 0 && camera->fov < 180)))
    return hsr_fail(err, HSR_E_INPUT,
                    "camera: fov must lie between 0 and 180 degrees, not %g",
                    camera->fov);
  if (!(camera->near >= 0))
    return hsr_fail(err, HSR_E_INPUT, "camera: near must not be negative");
  double f[3], u[3], length = 0, up = 0, normal = 0;
  for (int k = 0; k < 3; k++) {
    f[k] = camera->at[k] - camera->eye[k];
    u[k] = camera->up[k];
    length = fmax(length, fabs(f[k]));
    up = fmax(up, fabs(u[k]));
  }
  if (!(length > 0))
    return hsr_fail(err, HSR_E_INPUT, "camera: eye and at are the same point");
  if (!(up > 0))
    return hsr_fail(err, HSR_E_INPUT, "camera: up is zero");
  for (int k = 0; k < 3; k++)
    normal =
        fmax(normal, fabs(f[(k + 1) % 3] / length * (u[(k + 2) % 3] / up) -
                          f[(k + 2) % 3] / length * (u[(k + 1) % 3] / up)));
  if (normal > 1e-12)
    return HSR_OK;
  int across = 0; /* the axis that is farthest from the view */
  for (int k = 1; k < 3; k++)
    across = fabs(f[k]) < fabs(f[across]) ? k : across;
  return hsr_fail(err, HSR_E_INPUT,
                  "camera: up runs along the view, from eye to at; another up "
                  "would do, as --up %d,%d,%d",
                  across == 0, across == 1, across == 2);
}

/* |d|. Squares may underflow. */
static double length_of(const double d[3]) {
  double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  return length >= 0x1p-500 ? length : hypot(hypot(d[0], d[1]), d[2]);
}

void hsr_scene_extent_begin(struct hsr_scene_extent *extent) {
  *extent = (struct hsr_scene_extent){.lo = {INFINITY, INFINITY, INFINITY},
                                      .hi = {-INFINITY, -INFINITY, -INFINITY}};
}

static inline void add_point(struct hsr_scene_extent *extent,
                             const double p[3]) {
  for (int k = 0; k < 3; k++) {
    extent->lo[k] = hsr_min(extent->lo[k], p[k]);
    extent->hi[k] = hsr_max(extent->hi[k], p[k]);
  }
}

void hsr_scene_extent_add(struct hsr_scene_extent *extent, const double p[3]) {
  add_point(extent, p);
}

void hsr_scene_extent_centre(struct hsr_scene_extent *extent) {
  for (int k = 0; k < 3; k++)
    extent->centre[k] = extent->lo[k] + (extent->hi[k] - extent->lo[k]) / 2;
}

static inline void reach_point(struct hsr_scene_extent *extent,
                               const double p[3]) {
  double d[3];
  for (int k = 0; k < 3; k++)
    d[k] = p[k] - extent->centre[k];
  extent->radius = hsr_max(extent->radius, length_of(d));
}

void hsr_scene_extent_reach(struct hsr_scene_extent *extent,
                            const double p[3]) {
  reach_point(extent, p);
}

/* Calls add_point or reach_point for all vertices. It is inlined for each of
 * them, so that the extent stays in registers. */
static inline __attribute__((always_inline)) void
add_instance(struct hsr_scene_extent *extent, const struct hsr_scene *scene,
             const struct hsr_instance *instance,
             void (*add)(struct hsr_scene_extent *, const double *)) {
  const struct hsr_object *object = &scene->objects[instance->object];
  struct hsr_scene_extent own = *extent;
  for (uint32_t v = 0; v < object->n_vertices; v++) {
    double p[3];
    hsr_instance_vertex(instance->m, object->xyz + 3 * (size_t)v, p);
    add(&own, p);
  }
  *extent = own;
}

/* Calls `add` for corners of each row of kept cells: two that are opposite, or all
 * eight. */
static void add_grid(struct hsr_scene_extent *extent,
                     const struct hsr_grid *grid, int corners,
                     void (*add)(struct hsr_scene_extent *, const double *)) {
  const uint32_t rows = grid->n[1] * grid->n[2];
  for (uint32_t row = 0; row < rows; row++) {
    if (grid->row[row] == grid->row[row + 1])
      continue;
    const uint32_t first[3] = {grid->x[grid->row[row]], row % grid->n[1],
                               row / grid->n[1]},
                   last = grid->x[grid->row[row + 1] - 1];
    for (int c = 0; c < 8; c += corners == 8 ? 1 : 7) {
      const double p[3] = {
          grid->bound[0][c & 1 ? last + 1 : first[0]],
          grid->bound[1][first[1] + (c >> 1 & 1)],
          grid->bound[2][first[2] + (c >> 2 & 1)],
      };
      add(extent, p);
    }
  }
}

/* Of the cells that are kept. */
static double sphere_of_grid(const struct hsr_grid *grid, double centre[3]) {
  struct hsr_scene_extent extent;
  hsr_scene_extent_begin(&extent);
  add_grid(&extent, grid, 2, add_point);
  hsr_scene_extent_centre(&extent);
  add_grid(&extent, grid, 8, reach_point);
  memcpy(centre, extent.centre, sizeof extent.centre);
  return extent.radius;
}

double hsr_scene_sphere(const struct hsr_scene *scene, double centre[3]) {
  if (scene->grid)
    return sphere_of_grid(scene->grid, centre);
  struct hsr_scene_extent extent;
  hsr_scene_extent_begin(&extent);
  for (uint32_t i = 0; i < scene->n_instances; i++)
    add_instance(&extent, scene, &scene->instances[i], add_point);
  hsr_scene_extent_centre(&extent);
  for (uint32_t i = 0; i < scene->n_instances; i++)
    add_instance(&extent, scene, &scene->instances[i], reach_point);
  memcpy(centre, extent.centre, sizeof extent.centre);
  return extent.radius;
}

enum hsr_status hsr_scene_add_orbit(struct hsr_scene *scene, unsigned n) {
  double centre[3], radius = hsr_scene_sphere(scene, centre);
  return hsr_scene_add_orbit_around(scene, centre, radius, n);
}

enum hsr_status hsr_scene_add_orbit_around(struct hsr_scene *scene,
                                           const double centre[3],
                                           double radius, unsigned n) {
  if (!(radius > 0) || !isfinite(radius))
    return HSR_E_INPUT;
  for (unsigned i = 0; i < n; i++) {
    /* Rational points of the circle, irregularly spaced. */
    double t = (2.0 * (i % 4) + 1) / 4 - 1 + 0.07 * (i / 4 + 1);
    double c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
    for (unsigned quarter = i % 4; quarter; quarter--) {
      double turned = -s;
      s = c;
      c = turned;
    }
    /* 1 / sin(45/2 degrees) is 2.613: the sphere just fits. */
    const double by[3] = {2.46 * radius * s, 0.89 * radius, 2.46 * radius * c};
    struct hsr_camera camera = {.fov = 45};
    for (int a = 0; a < 3; a++) {
      camera.at[a] = camera.eye[a] = centre[a];
      camera.up[a] = scene->stand[1][a];
      for (int k = 0; k < 3; k++)
        camera.eye[a] += by[k] * scene->stand[k][a];
    }
    enum hsr_status status = hsr_scene_view(scene, &camera);
    if (status)
      return status;
  }
  return HSR_OK;
}

struct checking {
  const struct hsr_object *object;
  atomic_bool out_of_memory;
};

/* The first of some faces that has no area, or `to`. */
static uint32_t check_faces(void *context, uint32_t from, uint32_t to) {
  struct checking *checking = context;
  const struct hsr_object *object = checking->object;
  bool out_of_memory = false, good = true;
  uint32_t f = from;
  while (f < to && good) {
    uint32_t start = object->start[f];
    struct hsr_loop loop = {
        object->xyz, object->xyz + 1,        object->xyz + 2,
        3,           object->vertex + start, object->start[f + 1] - start};
    good = hsr_has_normal_for_certain(&loop) ||
           hsr_exact_has_normal(loop, &out_of_memory);
    f += good;
  }
  if (out_of_memory)
    atomic_store(&checking->out_of_memory, true);
  return f;
}

static enum hsr_status check_object(const struct hsr_object *object,
                                    int threads, struct hsr_error *err) {
  for (uint32_t v = 0; v < object->n_vertices; v++)
    if (!hsr_coordinates_fit(object->xyz + 3 * (size_t)v, 3))
      return hsr_fail(err, HSR_E_INPUT,
                      "object %s: vertex %u has a coordinate above %g",
                      object->name, v, LARGEST_COORDINATE);
  enum { RANGE = 4096 }; /* faces that a thread takes at a time */
  struct checking checking = {.object = object};
  uint32_t f =
      hsr_share_search(threads, object->n_faces, RANGE, check_faces, &checking);
  if (atomic_load(&checking.out_of_memory))
    return hsr_fail_nomem(err);
  if (f < object->n_faces)
    return hsr_fail(err, HSR_E_INPUT,
                    "object %s: face %u has no area (its normal is zero)",
                    object->name, f);
  return HSR_OK;
}

static enum hsr_status check_grid(const struct hsr_grid *grid,
                                  struct hsr_error *err) {
  for (int a = 0; a < 3; a++)
    if (!hsr_coordinates_fit(
            (double[]){grid->bound[a][0], grid->bound[a][grid->n[a]]}, 2))
      return hsr_fail(err, HSR_E_INPUT,
                      "the grid has a coordinate above %g along %c",
                      LARGEST_COORDINATE, "xyz"[a]);
  return HSR_OK;
}

/* Gives an identity instance to every object that has none. The list is
 * rebuilt, since it is sorted by object. */
static enum hsr_status place_unplaced(struct hsr_scene *scene) {
  uint32_t n_old = scene->n_instances;
  struct hsr_instance *old = scene->instances;
  if (scene->motions && scene->motions->n)
    return HSR_OK; /* their numbers stay */
  scene->instances = NULL;
  scene->n_instances = scene->cap_instances = 0;
  enum hsr_status status = HSR_OK;
  uint32_t i = 0;
  for (uint32_t o = 0; o < scene->n_objects && !status; o++) {
    if (i == n_old || old[i].object != o)
      status = hsr_scene_instance(scene, o, NULL);
    for (; i < n_old && old[i].object == o && !status; i++)
      status = hsr_scene_instance(scene, o, old[i].m);
  }
  free(old);
  return status;
}

enum hsr_status hsr_scene_finish(struct hsr_scene *scene,
                                 struct hsr_error *err) {
  enum hsr_status status = place_unplaced(scene);
  if (status)
    return hsr_fail_nomem(err);
  uint64_t n_faces = hsr_scene_faces(scene);
  if (!n_faces)
    return hsr_fail(err, HSR_E_INPUT, "the scene has no face");
  if (n_faces > UINT32_MAX - 1)
    return hsr_fail(err, HSR_E_INPUT,
                    "the scene has %llu faces; at most 2^32 - 2 can be named",
                    (unsigned long long)n_faces);
  if (scene->grid)
    status = check_grid(scene->grid, err);
  for (uint32_t o = 0; o < scene->n_objects && !status; o++)
    status = check_object(&scene->objects[o], scene->threads, err);
  if (status)
    return status;
  if (!scene->n_views) {
    status = hsr_scene_add_orbit(scene, 8);
    if (status == HSR_E_NOMEM)
      return hsr_fail_nomem(err);
    if (status)
      return hsr_fail(err, status, "the scene has no extent to look at");
  }
  return HSR_OK;
}

/* --- Tiny scenes ---------------------------------------------------------- */

/* A scene with a coordinate of at least this size is not enlarged. */
static const double LARGE = 0x1p-100;

/* The largest absolute value of n numbers, or the first that is at least
 * LARGE. */
static double largest(const double *v, size_t n) {
  double most = 0;
  for (size_t k = 0; k < n && most < LARGE; k++)
    most = hsr_max(most, fabs(v[k]));
  return most;
}

static double largest_vertex(const struct hsr_object *object) {
  return largest(object->xyz, 3 * (size_t)object->n_vertices);
}

/* A bound of all coordinates in the world, and of the terms of which they are
 * the sums. If it is LARGE, it may be too small. */
static double extent(const struct hsr_scene *scene) {
  double most = 0;
  for (uint32_t o = 0, i = 0; o < scene->n_objects; o++) {
    double vertex = largest_vertex(&scene->objects[o]);
    most = fmax(most, vertex);
    for (; i < scene->n_instances && scene->instances[i].object == o; i++) {
      const double *m = scene->instances[i].m;
      for (int row = 0; row < 12; row += 4)
        most = fmax(most, 3 * largest(m + row, 3) * vertex + fabs(m[row + 3]));
    }
  }
  for (int a = 0; a < 3 && scene->grid; a++)
    most = fmax(most, largest(scene->grid->bound[a], scene->grid->n[a] + 1));
  for (uint32_t k = 0; k < scene->n_views; k++) {
    const struct hsr_camera *view = &scene->views[k];
    most = fmax(most, fmax(largest(view->eye, 3), largest(view->at, 3)));
    most = fmax(most, fmax(view->near, view->parallel));
    if (view->light[3] > 0)
      most = fmax(most, largest(view->light, 3));
  }
  return most;
}

static void enlarge(double *v, size_t n, int exponent) {
  for (size_t k = 0; k < n; k++)
    v[k] = ldexp(v[k], exponent);
}

void hsr_scene_enlarge(struct hsr_scene *scene) {
  int exponent;
  double size = extent(scene);
  if (!(size > 0 && size < LARGE))
    return;
  frexp(size, &exponent);
  scene->enlarged -= exponent;
  for (uint32_t o = 0; o < scene->n_objects; o++)
    enlarge(scene->objects[o].xyz, 3 * (size_t)scene->objects[o].n_vertices,
            -exponent);
  for (int a = 0; a < 3 && scene->grid; a++) {
    enlarge(scene->grid->bound[a], scene->grid->n[a] + 1, -exponent);
    enlarge(scene->grid->at[a], scene->grid->n[a], -exponent);
  }
  for (uint32_t i = 0; i < scene->n_instances; i++)
    for (int row = 0; row < 12; row += 4)
      enlarge(scene->instances[i].m + row + 3, 1, -exponent);
  hsr_motions_enlarge(scene->motions, -exponent);
  for (uint32_t k = 0; k < scene->n_views; k++) {
    struct hsr_camera *view = &scene->views[k];
    enlarge(view->eye, 3, -exponent);
    enlarge(view->at, 3, -exponent);
    enlarge(&view->near, 1, -exponent);
    enlarge(&view->parallel, 1, -exponent);
    if (view->light[3] > 0)
      enlarge(view->light, 3, -exponent);
  }
}
