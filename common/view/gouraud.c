/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/view/gouraud.h"
#include "common/scene/planes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The faces of an object about each vertex: face[start[v]] up to start[v + 1].
 */
struct incidence {
  uint32_t *start, *face;
};

/* The face that is being shaded. */
struct shaded_face {
  uint32_t id, n, room;
  double normal[3], anchor[3];
  double (*corner)[3]; /* in the world */
  float *light;        /* of each corner */
  float rgb[3];
};

struct gouraud {
  const struct hsr_world *world;
  const struct hsr_view *view;
  const struct hsr_scene *scene;
  struct incidence *object;
  struct shaded_face face;
};

/* --- Objects -------------------------------------------------------------- */

static bool find_incidence(const struct hsr_object *object,
                           struct incidence *found) {
  uint32_t n_corners = object->start[object->n_faces];
  found->start = calloc((size_t)object->n_vertices + 2, sizeof *found->start);
  found->face = malloc(((size_t)n_corners + 1) * sizeof *found->face);
  if (!found->start || !found->face)
    return false;
  uint32_t *end = found->start + 1; /* end[v] becomes the start of v + 1 */
  for (uint32_t c = 0; c < n_corners; c++)
    end[object->vertex[c] + 1]++;
  for (uint32_t v = 0; v < object->n_vertices; v++)
    end[v + 1] += end[v];
  for (uint32_t f = 0; f < object->n_faces; f++)
    for (uint32_t c = object->start[f]; c < object->start[f + 1]; c++)
      found->face[end[object->vertex[c]]++] = f;
  return true;
}

/* --- Corners -------------------------------------------------------------- */

/* The unit normal of a face in the world, and a point of its plane. False if
 * the normal has no length, or one that is not finite. */
static bool find_normal(const struct hsr_world *world, struct hsr_place place,
                        double normal[3], double anchor[3]) {
  hsr_place_plane(world, place, normal, anchor);
  double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] +
                       normal[2] * normal[2]);
  for (int k = 0; k < 3; k++)
    normal[k] /= length;
  return length > 0 && isfinite(length);
}

/* The mean of the normals about vertex v, of any length. */
static void find_corner_normal(const struct gouraud *g, struct hsr_place place,
                               uint32_t v, double mean[3]) {
  const struct incidence *about =
      &g->object[g->scene->instances[place.instance].object];
  const double smooth = cos(HSR_SMOOTH * 3.14159265358979323846 / 180);
  const double *own = g->face.normal;
  memset(mean, 0, 3 * sizeof *mean);
  for (uint32_t k = about->start[v]; k < about->start[v + 1]; k++) {
    double normal[3], anchor[3];
    place.face = about->face[k];
    if (!find_normal(g->world, place, normal, anchor) ||
        normal[0] * own[0] + normal[1] * own[1] + normal[2] * own[2] < smooth)
      continue;
    for (int c = 0; c < 3; c++)
      mean[c] += normal[c];
  }
}

/* The face's own normal decides which side is seen. */
static float light_corner(const struct gouraud *g, struct hsr_place place,
                          uint32_t v) {
  double mean[3];
  find_corner_normal(g, place, v, mean);
  return hsr_picture_light_of(
      g->view, mean,
      hsr_view_height(g->view, g->face.normal, g->face.anchor) > 0);
}

static bool make_room(struct shaded_face *face, uint32_t n) {
  if (n <= face->room)
    return true;
  free(face->corner);
  free(face->light);
  face->corner = malloc(n * sizeof *face->corner);
  face->light = malloc(n * sizeof *face->light);
  face->room = n;
  return face->corner && face->light;
}

static bool find_face(struct gouraud *g, uint32_t id) {
  struct hsr_place place = hsr_place_of(g->world, id);
  const struct hsr_object *object = place.object;
  const double *m = g->scene->instances[place.instance].m;
  const uint32_t *vertex = object->vertex + object->start[place.face];
  struct shaded_face *face = &g->face;
  face->id = id;
  face->n = object->start[place.face + 1] - object->start[place.face];
  if (!make_room(face, face->n))
    return false;
  find_normal(g->world, place, face->normal, face->anchor);
  for (uint32_t c = 0; c < face->n; c++) {
    hsr_instance_vertex(m, object->xyz + 3 * (size_t)vertex[c],
                        face->corner[c]);
    face->light[c] = light_corner(g, place, vertex[c]);
  }
  memcpy(face->rgb, hsr_face_rgb(object, place.face), sizeof face->rgb);
  return true;
}

/* --- Samples -------------------------------------------------------------- */

/* Where the ray of a sample meets the face's plane. */
static void find_point(const struct gouraud *g, double sx, double sy,
                       double point[3]) {
  const struct hsr_view *view = g->view;
  const double *n = g->face.normal, *p = g->face.anchor;
  double origin[3], along[3], height = 0, slope = 0;
  for (int k = 0; k < 3; k++) {
    double aside =
        view->ray[0][k] + sx * view->ray[1][k] + sy * view->ray[2][k];
    origin[k] = view->E[k] + (view->parallel ? aside : 0);
    along[k] = view->parallel ? view->F[k] : aside;
    height += n[k] * (p[k] - origin[k]);
    slope += n[k] * along[k];
  }
  for (int k = 0; k < 3; k++)
    point[k] = origin[k] + height / slope * along[k];
}

/* An edge that the line through a point meets, nearest to it on one side. */
struct crossing {
  bool found;
  double distance;
  float light;
};

static void keep_nearer(struct crossing *kept, double distance, float light) {
  if (!kept->found || distance < kept->distance)
    *kept = (struct crossing){true, distance, light};
}

/* The light at a point of the face. Of the axes the one that the normal is
 * nearest to is left out; the line is parallel to the first of the others. */
static float light_at(const struct shaded_face *face, const double point[3]) {
  int z = 0;
  for (int k = 1; k < 3; k++)
    if (fabs(face->normal[k]) > fabs(face->normal[z]))
      z = k;
  int x = (z + 1) % 3, y = (z + 2) % 3;
  struct crossing left = {.found = false}, right = left;
  for (uint32_t b = 0, a = face->n - 1; b < face->n; a = b++) {
    const double *p = face->corner[a], *q = face->corner[b];
    if ((p[y] > point[y]) == (q[y] > point[y]))
      continue;
    double share = (point[y] - p[y]) / (q[y] - p[y]);
    double distance = p[x] + share * (q[x] - p[x]) - point[x];
    float light =
        face->light[a] + (float)share * (face->light[b] - face->light[a]);
    if (distance <= 0)
      keep_nearer(&left, -distance, light);
    else
      keep_nearer(&right, distance, light);
  }
  if (!left.found && !right.found)
    return face->light[0]; /* the point is beyond the face by a rounding */
  if (!left.found || !right.found)
    return left.found ? left.light : right.light;
  double width = left.distance + right.distance;
  float share = width > 0 ? (float)(left.distance / width) : 0;
  return left.light + share * (right.light - left.light);
}

static void shade_sample(const struct gouraud *g, int i, int j, float *rgb) {
  double point[3];
  find_point(g, hsr_sample_x(g->view, i), hsr_sample_y(g->view, j), point);
  float light = light_at(&g->face, point);
  for (int c = 0; c < 3; c++)
    rgb[c] = g->face.rgb[c] * light;
}

static bool shade(struct gouraud *g, const uint32_t *ids, float *rgb) {
  float background[3];
  hsr_picture_colour(g->world, g->view, HSR_BACKGROUND, HSR_SHADE_GOURAUD,
                     background);
  for (int j = 0; j < g->view->n; j++)
    for (int i = 0; i < g->view->m; i++) {
      size_t k = (size_t)j * (size_t)g->view->m + (size_t)i;
      if (ids[k] == HSR_BACKGROUND) {
        memcpy(rgb + 3 * k, background, sizeof background);
        continue;
      }
      if (ids[k] != g->face.id && !find_face(g, ids[k]))
        return false;
      shade_sample(g, i, j, rgb + 3 * k);
    }
  return true;
}

enum hsr_status hsr_gouraud_shade(const struct hsr_world *world,
                                  const struct hsr_view *view,
                                  const uint32_t *ids, float *rgb,
                                  struct hsr_error *err) {
  const struct hsr_scene *scene = world->roster.scene;
  struct gouraud g = {
      .world = world, .view = view, .scene = scene, .face.id = HSR_BACKGROUND};
  g.object = calloc(scene->n_objects, sizeof *g.object);
  bool good = g.object;
  for (uint32_t o = 0; good && o < scene->n_objects; o++)
    good = find_incidence(&scene->objects[o], &g.object[o]);
  good = good && shade(&g, ids, rgb);
  for (uint32_t o = 0; g.object && o < scene->n_objects; o++) {
    free(g.object[o].start);
    free(g.object[o].face);
  }
  free(g.object);
  free(g.face.corner);
  free(g.face.light);
  return good ? HSR_OK : hsr_fail_nomem(err);
}
