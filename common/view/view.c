/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/view/view.h"
#include "common/view/path.h"

#include <math.h>
#include <string.h>

static void cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/* v / |v|, scaled first so that no square over- or underflows. */
static void normalise(double v[3]) {
  double largest = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
  double length = 0;
  for (int k = 0; k < 3; k++) {
    v[k] /= largest;
    length += v[k] * v[k];
  }
  length = sqrt(length);
  for (int k = 0; k < 3; k++)
    v[k] /= length;
}

/* tan(fov/2). It is exact at 90 degrees, so that scenes can be made with exact
 * ties. */
static double half_tangent(double fov_degrees) {
  const double pi = 3.14159265358979323846;
  return fov_degrees == 90 ? 1 : tan(fov_degrees * (pi / 360));
}

/* The eye's coordinate in parallel projection. `forward` is the same coordinate
 * of F. */
static double place_at_infinity(double forward) {
  return forward > 0 ? -INFINITY : forward < 0 ? INFINITY : NAN;
}

/* `right` and `up` have length 1. */
static void place_light(struct hsr_view *view, const double right[3],
                        const double up[3]) {
  const double *given = view->camera.light;
  bool is_given = hsr_camera_has_light(&view->camera);
  for (int k = 0; k < 3; k++) {
    view->lamp[k] = -view->F[k] - 0.23 * right[k] + 0.31 * up[k];
    view->light[k] = is_given ? given[k] : view->lamp[k];
  }
  view->light[3] = given[3];
}

enum hsr_status hsr_view_complete(struct hsr_view *view, const double right[3],
                                  const double up[3], struct hsr_error *err) {
  for (int k = 0; k < 3; k++)
    view->eye[k] = view->parallel ? place_at_infinity(view->F[k]) : view->E[k];
  place_light(view, right, up);
  bool out_of_memory = false;
  if (!hsr_exact_view_matrices(view, &out_of_memory))
    return out_of_memory
               ? hsr_fail_nomem(err)
               : hsr_fail(err, HSR_E_INPUT,
                          "camera: its forward, right and up are dependent");
  return HSR_OK;
}

/* hsr_view_init_tile of a tile that is in range. */
static enum hsr_status init(struct hsr_view *view,
                            const struct hsr_camera *camera, int m, int n,
                            const struct hsr_window *tile,
                            struct hsr_error *err) {
  enum hsr_status status = hsr_camera_check(camera, err);
  if (status)
    return status;
  int across = tile->x1 - tile->x0, down = tile->y1 - tile->y0;
  *view = (struct hsr_view){.camera = *camera,
                            .m = across,
                            .n = down,
                            .whole_m = m,
                            .whole_n = n,
                            .left = tile->x0,
                            .top = tile->y0,
                            .window = {0, 0, across, down},
                            .parallel = camera->parallel > 0,
                            .near = camera->near};
  double right[3], up[3];
  double half =
      view->parallel ? camera->parallel / 2 : half_tangent(camera->fov);
  for (int k = 0; k < 3; k++) {
    view->E[k] = camera->eye[k];
    view->F[k] = camera->at[k] - camera->eye[k];
  }
  normalise(view->F);
  cross(view->F, camera->up, right);
  normalise(right);
  cross(right, view->F, up);
  for (int k = 0; k < 3; k++) {
    view->U[k] = half * up[k];
    view->R[k] = (double)m / n * half * right[k];
  }
  return hsr_view_complete(view, right, up, err);
}

enum hsr_status hsr_view_init(struct hsr_view *view,
                              const struct hsr_camera *camera, int m, int n,
                              struct hsr_error *err) {
  if (m < 1 || n < 1 || m > HSR_MAX_SIZE || n > HSR_MAX_SIZE)
    return hsr_fail(err, HSR_E_USAGE,
                    "a picture of %d x %d samples: each side must be 1 to %d",
                    m, n, HSR_MAX_SIZE);
  return init(view, camera, m, n, &(struct hsr_window){0, 0, m, n}, err);
}

/* Whether [a, b) is not empty, is in [0, n) and can be drawn at once. */
static bool is_part(int a, int b, int n) {
  return 0 <= a && a < b && b <= n && b - a <= HSR_MAX_SIZE;
}

enum hsr_status hsr_view_init_tile(struct hsr_view *view,
                                   const struct hsr_camera *camera, int m,
                                   int n, const struct hsr_window *tile,
                                   struct hsr_error *err) {
  if (m < 1 || n < 1 || m > HSR_MAX_WHOLE || n > HSR_MAX_WHOLE)
    return hsr_fail(err, HSR_E_USAGE,
                    "a picture of %d x %d samples in tiles: each side must be "
                    "1 to %d",
                    m, n, HSR_MAX_WHOLE);
  if (!is_part(tile->x0, tile->x1, m) || !is_part(tile->y0, tile->y1, n))
    return hsr_fail(err, HSR_E_USAGE,
                    "a tile must be in its picture, and each side 1 to %d",
                    HSR_MAX_SIZE);
  return init(view, camera, m, n, tile, err);
}

struct hsr_view hsr_view_finer(const struct hsr_view *view, int across,
                               int down) {
  struct hsr_view finer = *view;
  finer.m *= across;
  finer.n *= down;
  finer.whole_m *= across;
  finer.whole_n *= down;
  finer.left *= across;
  finer.top *= down;
  finer.offset_x = finer.offset_y = 0;
  finer.window = (struct hsr_window){0, 0, finer.m, finer.n};
  for (int k = 0; k < 3; k++) {
    finer.screen[0][k] *= across;
    finer.screen[1][k] *= down;
    finer.ray[1][k] /= across;
    finer.ray[2][k] /= down;
  }
  finer.origin[0] *= across;
  finer.origin[1] *= down;
  return finer;
}

void hsr_view_follow(struct hsr_view *view, const struct hsr_view *before) {
  struct hsr_view_before *b = &view->before;
  *b = (struct hsr_view_before){
      .exists = true, .parallel = before->parallel, .near = before->near};
  memcpy(b->E, before->E, sizeof b->E);
  memcpy(b->F, before->F, sizeof b->F);
  memcpy(b->R, before->R, sizeof b->R);
  memcpy(b->U, before->U, sizeof b->U);
  memcpy(b->screen, before->screen, sizeof b->screen);
  memcpy(b->origin, before->origin, sizeof b->origin);
  memcpy(b->depth, before->depth, sizeof b->depth);
}

enum hsr_status hsr_view_init_of(struct hsr_view *view,
                                 const struct hsr_scene *scene, uint32_t number,
                                 int m, int n, struct hsr_error *err) {
  struct hsr_view before;
  enum hsr_status status =
      number ? hsr_view_init(&before, &scene->views[number - 1], m, n, err)
             : HSR_OK;
  if (!status)
    status = hsr_view_init(view, &scene->views[number], m, n, err);
  if (!status && number)
    hsr_view_follow(view, &before);
  return status;
}
