/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/view/depths.h"
#include "common/view/gouraud.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float BACKGROUND[3] = {0.055f, 0.07f, 0.10f};

/* t of the face's plane at screen point (sx, sy), in doubles. It is good to
 * float precision, which is enough for a picture. */
static double depth_of_plane(const struct hsr_world *world,
                             const struct hsr_view *view, uint32_t f, double sx,
                             double sy) {
  const double n[3] = {world->mesh.nx[f], world->mesh.ny[f], world->mesh.nz[f]};
  const double p[3] = {world->mesh.px[f], world->mesh.py[f], world->mesh.pz[f]};
  double slope = 0;
  for (int k = 0; k < 3; k++) {
    slope +=
        n[k] * (view->ray[0][k] + sx * view->ray[1][k] + sy * view->ray[2][k]);
    if (view->parallel)
      slope -= n[k] * (p[k] - view->E[k]);
  }
  return hsr_view_depth(view, slope / hsr_view_height(view, n, p));
}

/* At sample k of the picture; infinite where there is no face. */
static double depth_at(const struct hsr_world *world,
                       const struct hsr_view *view, const uint32_t *ids,
                       size_t k) {
  int i = (int)(k % (size_t)view->m), j = (int)(k / (size_t)view->m);
  return ids[k] == HSR_BACKGROUND
             ? (double)INFINITY
             : depth_of_plane(world, view, ids[k], hsr_sample_x(view, i),
                              hsr_sample_y(view, j));
}

void hsr_picture_depth(const struct hsr_world *world,
                       const struct hsr_view *view, const uint32_t *ids,
                       float *depth) {
  for (size_t k = 0; k < (size_t)view->m * (size_t)view->n; k++)
    depth[k] = (float)depth_at(world, view, ids, k);
}

void hsr_picture_depths(const struct hsr_world *world,
                        const struct hsr_view *view, const uint32_t *ids,
                        double *depth) {
  for (size_t k = 0; k < (size_t)view->m * (size_t)view->n; k++)
    depth[k] = depth_at(world, view, ids, k);
}

/* A colour that neighbouring ids do not share, by a multiplicative hash of the
 * id. */
static void id_colour(uint32_t id, float rgb[3]) {
  uint32_t h = id * 2654435761u;
  h ^= h >> 15;
  h *= 2246822519u;
  h ^= h >> 13;
  for (int k = 0; k < 3; k++)
    rgb[k] = 0.15f + 0.8f * (float)(h >> (8 * k) & 255) / 255;
}

static uint32_t scene_id(const struct hsr_world *world, uint32_t f) {
  return world->id ? world->id[f] : f;
}

/* The colour of a face of a grid. */
static void cell_colour(const struct hsr_grid *grid, uint32_t face,
                        float rgb[3]) {
  uint32_t cell;
  int side;
  hsr_grid_face(grid, face, &cell, &side);
  hsr_grid_rgb(grid, cell, rgb);
}

static void face_colour(const struct hsr_world *world, uint32_t f,
                        float rgb[3]) {
  if (hsr_scene_lacks_faces(world->roster.scene)) {
    cell_colour(world->roster.scene->grid, scene_id(world, f), rgb);
    return;
  }
  const struct hsr_object *object =
      &world->roster.scene->objects[world->mesh.object[f]];
  const float *colour =
      hsr_face_rgb(object, scene_id(world, f) -
                               world->roster.first[world->mesh.instance[f]]);
  for (int k = 0; k < 3; k++)
    rgb[k] = colour[k];
}

float hsr_picture_light_of(const struct hsr_view *view, const double n[3],
                           bool turned) {
  double length = 0, light_length = 0, lit = 0;
  for (int k = 0; k < 3; k++) {
    length += n[k] * n[k];
    light_length += view->lamp[k] * view->lamp[k];
    lit += n[k] * view->lamp[k];
  }
  double cosine = lit / sqrt(length * light_length);
  if (turned)
    cosine = -cosine;
  return (float)(cosine > 0 ? 0.25 + 0.75 * cosine : 0.25);
}

float hsr_picture_light(const struct hsr_view *view, const double n[3],
                        const double p[3]) {
  return hsr_picture_light_of(view, n, hsr_view_height(view, n, p) > 0);
}

static float lambert(const struct hsr_world *world, const struct hsr_view *view,
                     uint32_t f) {
  return hsr_picture_light(
      view, (double[]){world->mesh.nx[f], world->mesh.ny[f], world->mesh.nz[f]},
      (double[]){world->mesh.px[f], world->mesh.py[f], world->mesh.pz[f]});
}

void hsr_picture_colour(const struct hsr_world *world,
                        const struct hsr_view *view, uint32_t id,
                        enum hsr_shading shading, float rgb[3]) {
  if (id == HSR_BACKGROUND) {
    for (int c = 0; c < 3; c++)
      rgb[c] = BACKGROUND[c];
  } else if (shading == HSR_SHADE_IDS) {
    id_colour(scene_id(world, id), rgb);
  } else {
    float light = shading == HSR_SHADE_FLAT ? 1 : lambert(world, view, id);
    face_colour(world, id, rgb);
    for (int c = 0; c < 3; c++)
      rgb[c] *= light;
  }
}

void hsr_picture_shade(const struct hsr_world *world,
                       const struct hsr_view *view, const uint32_t *ids,
                       enum hsr_shading shading, float *rgb) {
  size_t n = (size_t)view->m * (size_t)view->n;
  uint32_t last = HSR_BACKGROUND;
  float colour[3] = {BACKGROUND[0], BACKGROUND[1], BACKGROUND[2]};
  for (size_t k = 0; k < n; k++) {
    if (ids[k] != last) {
      last = ids[k];
      hsr_picture_colour(world, view, last, shading, colour);
    }
    for (int c = 0; c < 3; c++)
      rgb[3 * k + (size_t)c] = colour[c];
  }
}

/* --- Pictures of a roster ------------------------------------------------- */

/* The faces that are seen in a picture, laid out in a world of their own, and
 * the picture in the face numbers of that world. */
struct seen {
  struct hsr_world world;
  uint32_t *id;  /* the scene's ids of the faces, ascending */
  uint32_t *ids; /* the picture */
};

static int compare_ids(const void *a, const void *b) {
  uint32_t f = *(const uint32_t *)a, g = *(const uint32_t *)b;
  return (f > g) - (f < g);
}

/* Whether sample k shows the same as the one before, which is often so. */
static bool is_as_before(const uint32_t *ids, size_t k) {
  return k && ids[k] == ids[k - 1];
}

/* Writes the different faces of a picture to id[], ascending. Returns how many.
 */
static uint32_t find_seen(const uint32_t *ids, size_t n, uint32_t *id) {
  size_t n_id = 0;
  for (size_t k = 0; k < n; k++)
    if (ids[k] != HSR_BACKGROUND && !is_as_before(ids, k))
      id[n_id++] = ids[k];
  qsort(id, n_id, sizeof *id, compare_ids);
  uint32_t kept = 0;
  for (size_t k = 0; k < n_id; k++)
    if (!kept || id[k] != id[kept - 1])
      id[kept++] = id[k];
  return kept;
}

/* The place of a face in id[]. The background has none and stays what it is. */
static uint32_t place_of(const uint32_t *id, uint32_t n, uint32_t face) {
  const uint32_t *found = bsearch(&face, id, n, sizeof *id, compare_ids);
  return found ? (uint32_t)(found - id) : HSR_BACKGROUND;
}

static enum hsr_status seen_init(struct seen *seen,
                                 const struct hsr_world *world,
                                 const uint32_t *ids, size_t n,
                                 struct hsr_error *err) {
  seen->id = malloc(n * sizeof *seen->id);
  seen->ids = malloc(n * sizeof *seen->ids);
  if (!seen->id || !seen->ids)
    return hsr_fail_nomem(err);
  uint32_t n_seen = find_seen(ids, n, seen->id);
  for (size_t k = 0; k < n; k++)
    seen->ids[k] = is_as_before(ids, k) ? seen->ids[k - 1]
                                        : place_of(seen->id, n_seen, ids[k]);
  return hsr_world_extract(&seen->world, world, seen->id, n_seen, err);
}

static void seen_free(struct seen *seen) {
  hsr_world_free(&seen->world);
  free(seen->id);
  free(seen->ids);
}

enum hsr_status hsr_picture_finish(const struct hsr_world *world,
                                   const struct hsr_view *view,
                                   const uint32_t *ids,
                                   enum hsr_shading shading, float *depth,
                                   float *rgb, struct hsr_error *err) {
  struct seen seen = {.ids = NULL};
  enum hsr_status status = HSR_OK;
  if (rgb && shading == HSR_SHADE_GOURAUD &&
      !hsr_scene_lacks_faces(world->roster.scene)) {
    status = hsr_gouraud_shade(world, view, ids, rgb, err);
    rgb = NULL;
  }
  if (status || !(depth || rgb))
    return status;
  if (hsr_is_roster(world)) {
    status =
        seen_init(&seen, world, ids, (size_t)view->m * (size_t)view->n, err);
    world = &seen.world;
    ids = seen.ids;
  }
  if (!status && depth)
    hsr_picture_depth(world, view, ids, depth);
  if (!status && rgb)
    hsr_picture_shade(world, view, ids, shading, rgb);
  seen_free(&seen);
  return status;
}
