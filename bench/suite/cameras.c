/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/suite/cameras.h"
#include "common/files/json/json.h"

#include <math.h>
#include <string.h>

static json_t *numbers(const double *x, int n) {
  json_t *array = json_array();
  for (int k = 0; k < n; k++)
    hsr_json_append(&array, json_real(x[k] + 0)); /* no -0 */
  return array;
}

static json_t *camera_json(const struct hsr_camera *c) {
  return json_pack("{so so so sf sf sf}", "eye", numbers(c->eye, 3), "at",
                   numbers(c->at, 3), "up", numbers(c->up, 3), "fov", c->fov,
                   "near", c->near, "parallel", c->parallel);
}

static json_t *rays_json(const struct hsr_view *view) {
  return json_pack("{so so so so sb}", "E", numbers(view->E, 3), "F",
                   numbers(view->F, 3), "R", numbers(view->R, 3), "U",
                   numbers(view->U, 3), "parallel", view->parallel);
}

/* --- Matrices ------------------------------------------------------------- */

/* The planes before and behind all that is visible. What lies on the camera's near
 * plane does not exist, but OpenGL and Vulkan keep what is on theirs; so theirs is
 * half way from there to the nearest that is visible. */
struct planes {
  double near, far;
};

static struct planes find_planes(const struct hsr_world *world,
                                 const struct hsr_view *view,
                                 const double *depth) {
  double least = (double)INFINITY, farthest = 0;
  for (size_t k = 0; k < (size_t)view->m * (size_t)view->n; k++)
    least = fmin(least, depth[k]);
  for (uint32_t v = 0; v < world->mesh.n_vertices; v++) {
    const double p[3] = {world->mesh.x[v], world->mesh.y[v], world->mesh.z[v]};
    double image[3];
    hsr_view_project(view, p, image);
    farthest = fmax(farthest, image[2]);
  }
  struct planes planes = {view->near, 1.001 * farthest};
  if (isfinite(least))
    planes.near += (least - view->near) / 2;
  else if (!view->parallel && !(planes.near > 0))
    planes.near = planes.far / 1024;
  if (!(planes.far > planes.near))
    planes.far = 2 * planes.near + 1;
  return planes;
}

enum convention { OPENGL, VULKAN };

/* The rows of z for clip coordinates: z = t * scale + add. */
static void depth_row(const struct planes *p, bool parallel,
                      enum convention convention, double *scale, double *add) {
  const double range = p->far - p->near;
  const double n = p->near, f = p->far;
  if (convention == OPENGL) {
    *scale = parallel ? 2 / range : (f + n) / range;
    *add = parallel ? -(f + n) / range : -2 * f * n / range;
  } else {
    *scale = parallel ? 1 / range : f / range;
    *add = parallel ? -n / range : -f * n / range;
  }
}

/* By columns. */
static json_t *by_columns(double row[4][4]) {
  double column[16];
  for (int r = 0; r < 4; r++)
    for (int c = 0; c < 4; c++)
      column[4 * c + r] = row[r][c];
  return numbers(column, 16);
}

/* From the world to clip coordinates, from the matrices of the view, which are
 * exact but for one rounding. */
static json_t *world_to_clip(const struct hsr_view *view,
                             const struct planes *planes,
                             enum convention convention) {
  double row[4][4] = {{0}}, scale, add;
  const double down = convention == VULKAN ? 1 : -1;
  depth_row(planes, view->parallel, convention, &scale, &add);
  for (int k = 0; k < 3; k++) {
    const double w = view->screen[2][k];
    row[0][k] = 2 * view->screen[0][k] / view->m - w;
    row[1][k] = down * (2 * view->screen[1][k] / view->n - w);
    row[2][k] = scale * view->depth[k];
    row[3][k] = w;
  }
  row[2][3] = add;
  row[3][3] = view->parallel;
  for (int r = 0; r < 4; r++)
    for (int k = 0; k < 3; k++)
      row[r][3] -= row[r][k] * view->E[k];
  return by_columns(row);
}

static double length(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* From the world to the eye, which looks along -z. */
static json_t *world_to_eye(const struct hsr_view *view) {
  double row[4][4] = {{0}};
  const double *const axis[3] = {view->R, view->U, view->F};
  for (int r = 0; r < 3; r++) {
    const double unit = r < 2 ? 1 / length(axis[r]) : -1;
    for (int k = 0; k < 3; k++) {
      row[r][k] = unit * axis[r][k];
      row[r][3] -= row[r][k] * view->E[k];
    }
  }
  row[3][3] = 1;
  return by_columns(row);
}

static json_t *eye_to_clip(const struct hsr_view *view,
                           const struct planes *planes,
                           enum convention convention) {
  double row[4][4] = {{0}}, scale, add;
  depth_row(planes, view->parallel, convention, &scale, &add);
  row[0][0] = 1 / length(view->R);
  row[1][1] = (convention == VULKAN ? -1 : 1) / length(view->U);
  row[2][2] = -scale;
  row[2][3] = add;
  row[3][2] = view->parallel ? 0 : -1;
  row[3][3] = view->parallel;
  return by_columns(row);
}

static json_t *matrices_json(const struct hsr_view *view,
                             const struct planes *planes,
                             enum convention convention) {
  return json_pack("{sf sf so so so}", "near", planes->near, "far", planes->far,
                   "matrix", world_to_clip(view, planes, convention), "view",
                   world_to_eye(view), "projection",
                   eye_to_clip(view, planes, convention));
}

bool add_camera(json_t *to, const struct hsr_world *world,
                const struct hsr_view *view, const double *depth) {
  const struct planes planes = find_planes(world, view, depth);
  return !json_object_set_new(to, "camera", camera_json(&view->camera)) &&
         !json_object_set_new(to, "rays", rays_json(view)) &&
         !json_object_set_new(to, "opengl",
                              matrices_json(view, &planes, OPENGL)) &&
         !json_object_set_new(to, "vulkan",
                              matrices_json(view, &planes, VULKAN));
}
