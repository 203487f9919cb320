/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/lab/lab.h"
#include "common/files/json/scene_json.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static enum hsr_status check(const struct hsr_scene *scene,
                             struct hsr_error *err) {
  uint64_t n = hsr_scene_faces(scene);
  if (scene->grid)
    return hsr_fail(err, HSR_E_INPUT,
                    "%s: is a volume; the laboratory takes faces, and volumes "
                    "that are built in (hsr scenes)",
                    scene->name);
  if (n > LAB_MOST_FACES)
    return hsr_fail(err, HSR_E_REFUSED,
                    "%s: has %llu faces; the laboratory takes %d at most",
                    scene->name, (unsigned long long)n, (int)LAB_MOST_FACES);
  return HSR_OK;
}

/* The scene as the text of a .scene.json: a new reference. */
static enum hsr_status file_json(const struct hsr_scene *scene, json_t **file,
                                 struct hsr_error *err) {
  char *text = NULL;
  size_t n = 0;
  FILE *out = open_memstream(&text, &n);
  if (!out)
    return hsr_fail_nomem(err);
  enum hsr_status status = hsr_scene_json_print(scene, out, err);
  bool failed = ferror(out);
  failed = fclose(out) || failed;
  *file = status || failed ? NULL : json_stringn(text, n);
  free(text);
  return status || *file ? status : hsr_fail_nomem(err);
}

/* NULL if the page makes the scene by its name. */
static enum hsr_status scene_json(const struct hsr_scene *scene,
                                  const struct scene_options *options,
                                  json_t **file, struct hsr_error *err) {
  if (scene_is_made_by_name(options))
    return HSR_OK;
  enum hsr_status status = check(scene, err);
  return status ? status : file_json(scene, file, err);
}

static json_t *camera_json(const struct hsr_camera *c) {
  return json_pack("{s[fff] s[fff] s[fff] sf sf sf s[ffff]}", "eye", c->eye[0],
                   c->eye[1], c->eye[2], "at", c->at[0], c->at[1], c->at[2],
                   "up", c->up[0], c->up[1], c->up[2], "fov", c->fov, "near",
                   c->near, "parallel", c->parallel, "light", c->light[0],
                   c->light[1], c->light[2], c->light[3]);
}

enum hsr_status lab_asked(const char *name, const struct scene_options *options,
                          const struct view_options *view, json_t *algorithms,
                          json_t **asked, struct hsr_error *err) {
  struct hsr_scene *scene = NULL;
  struct hsr_view seen;
  json_t *file = NULL;
  enum hsr_status status =
      open_scene(options->name, options->import, &scene, err);
  if (!status)
    status = choose_view(view, scene, 1, &seen, err);
  if (!status)
    status = scene_json(scene, options, &file, err);
  if (!status) {
    *asked = json_pack("{ss so* so sO}", "scene", name, "file", file, "camera",
                       camera_json(&seen.camera), "algorithms", algorithms);
    status = *asked ? HSR_OK : hsr_fail_nomem(err);
  }
  hsr_scene_delete(scene);
  return status;
}
