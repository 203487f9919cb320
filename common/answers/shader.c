/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/answers/shader.h"
#include "common/answers/filter.h"
#include "common/view/picture.h"

#include <math.h>
#include <string.h>

const double hsr_sky_low[3] = {.875, .75, .625},
             hsr_sky_high[3] = {.125, .25, .625};

unsigned hsr_shader_parts(enum hsr_shader shader) {
  static const unsigned parts[] = {
      [HSR_SHADER_FLAT] = 0,
      [HSR_SHADER_GOURAUD] = HSR_PART_CORNERS,
      [HSR_SHADER_CHECKER] = HSR_PART_BOARD,
      [HSR_SHADER_BUMPS] = HSR_PART_BOARD | HSR_PART_BUMPS,
      [HSR_SHADER_PHONG] = HSR_PART_HIGHLIGHT,
      [HSR_SHADER_SKY] = HSR_PART_SKY,
      [HSR_SHADER_WATER] =
          HSR_PART_BOARD | HSR_PART_BUMPS | HSR_PART_HIGHLIGHT | HSR_PART_SKY};
  return parts[shader];
}

/* To length 1. What is zero stays so. */
static void normalise(double v[3]) {
  double most = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2]))), length = 0;
  for (int k = 0; k < 3 && most > 0; k++) {
    v[k] /= most;
    length += v[k] * v[k];
  }
  for (int k = 0; k < 3 && most > 0; k++)
    v[k] /= sqrt(length);
}

enum hsr_status hsr_shades_init(struct hsr_shades *shades,
                                enum hsr_shader shader, double side,
                                const struct hsr_world *world,
                                const struct hsr_view *view,
                                struct hsr_arena *arena) {
  *shades = (struct hsr_shades){.parts = hsr_shader_parts(shader),
                                .side = side,
                                .world = world,
                                .view = view,
                                .arena = arena};
  for (int k = 0; k < 3; k++)
    shades->light[k] = view->lamp[k];
  normalise(shades->light);
  if (shades->parts & HSR_PART_CORNERS)
    shades->normals =
        HSR_NEW_ZEROED(arena, double *, world->roster.scene->n_objects);
  return shades->parts & HSR_PART_CORNERS && !shades->normals ? HSR_E_NOMEM
                                                              : HSR_OK;
}

/* --- Corners -------------------------------------------------------------- */

/* Newell's normal of a face, in its object's frame. */
static void face_normal(const struct hsr_object *object, uint32_t f,
                        double normal[3]) {
  const uint32_t *vertex = object->vertex + object->start[f];
  uint32_t n = object->start[f + 1] - object->start[f];
  const double *o = object->xyz + 3 * (size_t)vertex[0];
  memset(normal, 0, 3 * sizeof *normal);
  for (uint32_t i = 1; i + 1 < n; i++) {
    const double *a = object->xyz + 3 * (size_t)vertex[i];
    const double *b = object->xyz + 3 * (size_t)vertex[i + 1];
    for (int k = 0; k < 3; k++) {
      int l = (k + 1) % 3, m = (k + 2) % 3;
      normal[k] +=
          (a[l] - o[l]) * (b[m] - o[m]) - (a[m] - o[m]) * (b[l] - o[l]);
    }
  }
}

/* Adds the normals of an object's faces to those of the vertices of its mesh. */
static void add_normals(const struct hsr_object *object, double *normals) {
  for (uint32_t f = 0; f < object->n_faces; f++) {
    double normal[3];
    face_normal(object, f, normal);
    for (uint32_t i = object->start[f]; i < object->start[f + 1]; i++) {
      const size_t v = hsr_mesh_vertex(object, object->vertex[i]);
      for (size_t k = 0; k < 3; k++)
        normals[3 * v + k] += normal[k];
    }
  }
}

/* Of each vertex of an object's mesh, the sum of its faces' normals. The groups
 * of a mesh have one array. */
static const double *vertex_normals(struct hsr_shades *s,
                                    const struct hsr_object *object) {
  const struct hsr_group *group = &object->group;
  const uint32_t n_groups = group->vertex ? group->of : 1;
  const size_t n = group->vertex ? group->n_vertices : object->n_vertices;
  const struct hsr_object *first = object - group->number;
  double **normals = &s->normals[first - s->world->roster.scene->objects];
  if (*normals)
    return *normals;
  *normals = HSR_NEW_ZEROED(s->arena, double, 3 * n);
  for (uint32_t g = 0; *normals && g < n_groups; g++)
    add_normals(&first[g], *normals);
  return *normals;
}

/* A normal of an object in the world: by the cofactors of the matrix. */
static void place_normal(const double m[12], const double normal[3],
                         double out[3]) {
  for (int k = 0; k < 3; k++) {
    const double *a = m + 4 * ((k + 1) % 3), *b = m + 4 * ((k + 2) % 3);
    out[k] = 0;
    for (int c = 0; c < 3; c++) {
      int d = (c + 1) % 3, e = (c + 2) % 3;
      out[k] += normal[c] * (a[d] * b[e] - a[e] * b[d]);
    }
  }
}

static uint16_t in_16_bits(double value) {
  return (uint16_t)floor(fmin(fmax(value, 0), 1) * 65535 + 0.5);
}

static bool shade_corners(struct hsr_shades *s, const struct hsr_place *at,
                          struct hsr_shaded_face *face) {
  const struct hsr_object *object = at->object;
  const double *m = s->world->roster.scene->instances[at->instance].m;
  const double *normals = vertex_normals(s, object);
  const float *own =
      object->rgb ? object->rgb + 3 * (size_t)at->face : object->colour;
  for (uint32_t k = 0; normals && k < 3; k++) {
    const uint32_t v = object->vertex[object->start[at->face] + k];
    double normal[3], corner[3];
    place_normal(m, normals + 3 * (size_t)hsr_mesh_vertex(object, v), normal);
    hsr_instance_vertex(m, object->xyz + 3 * (size_t)v, corner);
    bool any = normal[0] != 0 || normal[1] != 0 || normal[2] != 0;
    double light =
        hsr_picture_light(s->view, any ? normal : face->normal, corner);
    for (int c = 0; c < 3; c++)
      face->corner[k][c] = in_16_bits((double)own[c] * light);
  }
  return normals != NULL;
}

/* --- Faces ---------------------------------------------------------------- */

bool hsr_shades_face(struct hsr_shades *s, uint32_t id,
                     struct hsr_shaded_face *face) {
  *face = (struct hsr_shaded_face){.u = 1, .v = 2};
  hsr_filter_colour(s->world, s->view, id, face->rgb);
  if (!s->parts || id == HSR_BACKGROUND)
    return true;
  double anchor[3];
  struct hsr_place at = hsr_place_of(s->world, id);
  hsr_place_plane(s->world, at, face->normal, anchor);
  double height = hsr_view_height(s->view, face->normal, anchor);
  int most = 0;
  for (int k = 1; k < 3; k++)
    if (fabs(face->normal[k]) > fabs(face->normal[most]))
      most = k;
  face->u = (most + 1) % 3;
  face->v = (most + 2) % 3;
  normalise(face->normal);
  for (int k = 0; k < 3 && height > 0; k++)
    face->normal[k] = -face->normal[k];
  face->by_corners =
      s->parts & HSR_PART_CORNERS &&
      !hsr_scene_lacks_faces(s->world->roster.scene) &&
      at.object->start[at.face + 1] - at.object->start[at.face] == 3;
  return !face->by_corners || shade_corners(s, &at, face);
}
