/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/view/standard.h"
#include "common/base/numbers.h"
#include "common/scene/part.h"

#include <math.h>
#include <string.h>

/* --- Fitting -------------------------------------------------------------- */

/* The directions of a view, of length 1, and the image so far: how far it
 * reaches to the right and upwards, from the eye. */
struct image {
  const struct hsr_camera *camera;
  double forward[3], right[3], up[3];
  double lo[2], hi[2];
};

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void normalise(double v[3]) {
  const double length = hypot(hypot(v[0], v[1]), v[2]);
  for (int k = 0; k < 3; k++)
    v[k] /= length;
}

static void cross(const double a[3], const double b[3], double out[3]) {
  for (int k = 0; k < 3; k++)
    out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static struct image begin_image(const struct hsr_camera *camera) {
  struct image image = {.camera = camera,
                        .lo = {INFINITY, INFINITY},
                        .hi = {-INFINITY, -INFINITY}};
  double up[3];
  for (int k = 0; k < 3; k++) {
    image.forward[k] = camera->at[k] - camera->eye[k];
    up[k] = camera->up[k];
  }
  normalise(image.forward);
  normalise(up);
  cross(image.forward, up, image.right);
  normalise(image.right);
  cross(image.right, image.forward, image.up);
  return image;
}

static void add_point(struct image *image, const double p[2]) {
  for (int k = 0; k < 2; k++) {
    image->lo[k] = hsr_min(image->lo[k], p[k]);
    image->hi[k] = hsr_max(image->hi[k], p[k]);
  }
}

/* A point in the frame of the view: right, up, and in front of `near`. */
static void place(const struct image *image, const double p[3], double out[3]) {
  double d[3];
  for (int k = 0; k < 3; k++)
    d[k] = p[k] - image->camera->eye[k];
  out[0] = dot(d, image->right);
  out[1] = dot(d, image->up);
  out[2] = dot(d, image->forward) - image->camera->near;
}

/* Adds the part of a side of a face that is in front. */
static void add_side(struct image *image, const double a[3],
                     const double b[3]) {
  if (a[2] > 0)
    add_point(image, a);
  if ((a[2] > 0) == (b[2] > 0))
    return;
  const double t = a[2] / (a[2] - b[2]);
  add_point(image,
            (double[]){a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
}

static void add_instance(struct image *image, const struct hsr_object *object,
                         const double m[12]) {
  for (uint32_t f = 0; f < object->n_faces; f++) {
    const uint32_t first = object->start[f], end = object->start[f + 1];
    double a[3], b[3], p[3];
    for (uint32_t k = first; k <= end; k++) {
      const uint32_t v = object->vertex[k < end ? k : first];
      hsr_instance_vertex(m, object->xyz + 3 * (size_t)v, p);
      place(image, p, b);
      if (k > first)
        add_side(image, a, b);
      memcpy(a, b, sizeof a);
    }
  }
}

/* Adds the twelve edges of a kept cell. */
static void add_cell(struct image *image, const struct hsr_grid *grid,
                     uint32_t cell) {
  uint32_t at[3];
  double corner[8][3];
  hsr_grid_place(grid, cell, at);
  for (int c = 0; c < 8; c++) {
    double p[3];
    for (int a = 0; a < 3; a++)
      p[a] = grid->bound[a][at[a] + (c >> a & 1)];
    place(image, p, corner[c]);
  }
  for (int c = 0; c < 8; c++)
    for (int a = 0; a < 3; a++)
      if (!(c >> a & 1))
        add_side(image, corner[c], corner[c | 1 << a]);
}

static struct image find_image(const struct hsr_scene *scene,
                               const struct hsr_camera *camera) {
  struct image image = begin_image(camera);
  if (scene->grid)
    for (uint32_t c = 0; c < scene->grid->n_cells; c++)
      if (scene->grid->sides[c])
        add_cell(&image, scene->grid, c);
  for (uint32_t i = 0; i < scene->n_instances && !scene->grid; i++)
    add_instance(&image, &scene->objects[scene->instances[i].object],
                 scene->instances[i].m);
  return image;
}

/* Lets a camera look at a point, the eye being so far from it along each axis.
 * Both are put on a lattice on which their difference is exact. So the direction
 * does not depend on the place: an isometric view is exactly one anywhere, and
 * edges whose images should lie on one another do. */
static void look_at(struct hsr_camera *camera, const double at[3],
                    const double to_eye[3]) {
  double most = 0;
  int exponent;
  for (int k = 0; k < 3; k++)
    most = fmax(most, fabs(at[k]) + fabs(to_eye[k]));
  frexp(most, &exponent);
  const double step = ldexp(1, exponent - 52);
  for (int k = 0; k < 3; k++) {
    camera->at[k] = step * round(at[k] / step);
    camera->eye[k] = camera->at[k] + step * round(to_eye[k] / step);
  }
}

enum hsr_status hsr_camera_fit(const struct hsr_scene *scene, double m,
                               double n, struct hsr_camera *camera,
                               struct hsr_error *err) {
  struct hsr_error why;
  camera->parallel = 1;
  if (hsr_camera_check(camera, &why))
    return hsr_fail(err, HSR_E_USAGE, "%s", why.text);
  const struct image image = find_image(scene, camera);
  const double across = image.hi[0] - image.lo[0],
               high = image.hi[1] - image.lo[1];
  if (!(across >= 0))
    return hsr_fail(
        err, HSR_E_USAGE,
        "parallel=fit: nothing of the scene is in front of the eye");
  double at[3], to_eye[3];
  for (int k = 0; k < 3; k++) {
    at[k] = camera->at[k] + (image.lo[0] + across / 2) * image.right[k] +
            (image.lo[1] + high / 2) * image.up[k];
    to_eye[k] = camera->eye[k] - camera->at[k];
  }
  look_at(camera, at, to_eye);
  camera->parallel = fmax(high, across * n / m) / (1 - 2 * HSR_FIT_MARGIN);
  if (!(camera->parallel > 0))
    return hsr_fail(err, HSR_E_USAGE,
                    "parallel=fit: the image of the scene is a point");
  return hsr_camera_check(camera, &why)
             ? hsr_fail(err, HSR_E_USAGE, "%s", why.text)
             : HSR_OK;
}

/* --- Standard views ------------------------------------------------------- */

const char *const hsr_standard_views[HSR_STANDARD_VIEWS + 1] = {
    "front", "back", "left", "right", "top", "bottom", "iso", "dimetric", NULL};

/* Along right, up and towards the viewer of the front: the direction from the
 * scene to the eye, and what is up. The squares of a direction (a, a, c) of
 * length 1 with 1 - a^2 = 4 (1 - c^2) are 1/9, 1/9 and 7/9: seen from there,
 * depth is half as long as width and height. */
static const struct {
  double eye[3], up[3];
} standards[] = {
    {{0, 0, 1}, {0, 1, 0}},  {{0, 0, -1}, {0, 1, 0}},
    {{-1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {0, 1, 0}},
    {{0, 1, 0}, {0, 0, -1}}, {{0, -1, 0}, {0, 0, 1}},
    {{1, 1, 1}, {0, 1, 0}},  {{1, 1, 2.6457513110645906}, {0, 1, 0}}};

/* What is right, upwards and towards the viewer if an axis is up: a frame that
 * stands on y is turned onto the axis. */
static void stand_on(const struct hsr_scene *scene, int axis,
                     double stand[3][3]) {
  memcpy(stand, scene->stand, sizeof scene->stand);
  if (axis < 0 || stand[1][axis] > 0)
    return;
  static const double turned[3][3][3] = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                                         {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                         {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
  memcpy(stand, turned[axis], sizeof scene->stand);
}

enum hsr_status hsr_standard_view(const struct hsr_scene *scene,
                                  const char *name, int up_axis,
                                  struct hsr_camera *camera,
                                  struct hsr_error *err) {
  int k = 0;
  while (hsr_standard_views[k] && strcmp(hsr_standard_views[k], name) != 0)
    k++;
  if (!hsr_standard_views[k])
    return hsr_fail(err, HSR_E_USAGE,
                    "look: '%.40s' must be front, back, left, right, top, "
                    "bottom, iso or dimetric",
                    name);
  double stand[3][3], centre[3], to_eye[3] = {0, 0, 0};
  const double radius = hsr_scene_sphere(scene, centre);
  stand_on(scene, up_axis, stand);
  for (int a = 0; a < 3; a++) {
    camera->up[a] = 0;
    for (int s = 0; s < 3; s++) {
      to_eye[a] += 2 * radius * standards[k].eye[s] * stand[s][a];
      camera->up[a] += standards[k].up[s] * stand[s][a];
    }
  }
  look_at(camera, centre, to_eye);
  camera->near = 0;
  return hsr_camera_fit(scene, 1, 1, camera, err);
}
