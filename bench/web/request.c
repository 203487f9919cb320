/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the page asks for. */
#include "bench/web/web.h"

/* Members that are not there leave their numbers alone. */
static int read_numbers(json_t *object, const char *name, double *to, int n) {
  json_t *list = json_object_get(object, name);
  if (!list || json_is_null(list))
    return 0;
  if (json_array_size(list) != (size_t)n)
    return -1;
  for (int k = 0; k < n; k++) {
    const json_t *x = json_array_get(list, (size_t)k);
    if (!json_is_number(x))
      return -1;
    to[k] = json_number_value(x);
  }
  return 0;
}

static int read_number(json_t *object, const char *name, double *to) {
  json_t *x = json_object_get(object, name);
  if (!x || json_is_null(x))
    return 0;
  *to = json_number_value(x);
  return json_is_number(x) ? 0 : -1;
}

/* In parallel projection an angle of view has no effect, but must be possible. */
static int read_camera(json_t *json, struct lib_camera *camera) {
  *camera =
      (struct lib_camera){.size = sizeof *camera, .up = {0, 0, 1}, .fov = 45};
  return json_is_object(json) && !read_numbers(json, "eye", camera->eye, 3) &&
                 !read_numbers(json, "at", camera->at, 3) &&
                 !read_numbers(json, "up", camera->up, 3) &&
                 !read_number(json, "fov", &camera->fov) &&
                 !read_number(json, "near", &camera->near) &&
                 !read_number(json, "parallel", &camera->parallel) &&
                 !read_numbers(json, "light", camera->light, 4)
             ? 0
             : -1;
}

static int read_window(json_t *json, int window[4]) {
  double number[4] = {0, 0, 0, 0};
  if (read_numbers(json, "window", number, 4))
    return -1;
  for (int k = 0; k < 4; k++)
    window[k] = (int)number[k];
  return 0;
}

enum hsr_status web_request_read(struct web_request *to, const char *text,
                                 struct hsr_error *err) {
  json_error_t error;
  const char *algorithm = NULL;
  json_t *camera = NULL;
  int view = 0, counts = 0, work = 0;
  *to = (struct web_request){
      .request = {.size = sizeof to->request, .m = 256, .n = 256}};
  struct hsr_request *r = &to->request;
  to->json = json_loads(text, 0, &error);
  if (!to->json ||
      json_unpack(to->json, "{s?s s?o s?i s?i s?i s?b s?b}", "algorithm",
                  &algorithm, "camera", &camera, "view", &view, "m", &r->m, "n",
                  &r->n, "counts", &counts, "work", &work) ||
      read_window(to->json, r->window) ||
      read_numbers(to->json, "offset", r->offset, 2))
    return hsr_fail(err, HSR_E_USAGE,
                    "a request is {algorithm, camera or view, m, n, window, "
                    "counts, work, offset}");
  r->algorithm = algorithm;
  r->view = (uint32_t)view;
  r->counts = counts;
  r->work = work;
  if (!camera || json_is_null(camera))
    return HSR_OK;
  r->camera = &to->camera;
  return read_camera(camera, &to->camera)
             ? hsr_fail(err, HSR_E_USAGE,
                        "a camera is {eye, at, up, fov, near, parallel, light}")
             : HSR_OK;
}

void web_request_free(struct web_request *request) {
  json_decref(request->json);
  request->json = NULL;
}
