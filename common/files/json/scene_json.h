/* SPDX-License-Identifier: GPL-3.0-or-later */
/* .scene.json files, through jansson; the format is docs/schemas/scene.schema.json. */
#ifndef HSR_COMMON_SCENE_JSON_H
#define HSR_COMMON_SCENE_JSON_H

#include "common/files/mesh/exchange.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Reads a scene file into an empty scene. The caller must call
 * hsr_scene_finish. Paths of mesh files are relative to the scene file.
 * `import` is as in hsr_mesh_read. HSR_E_INPUT, with the file and the line or
 * JSON pointer of the wrong value; HSR_E_NOMEM. After a failure the scene may
 * be partly filled. */
enum hsr_status hsr_scene_json_read(struct hsr_scene *scene, const char *path,
                                    struct hsr_import *import,
                                    struct hsr_error *err);

/* The same for frame `frame` instead of the file's own (common/scene/motion.h).
 * Instances whose places are given for each frame are put where they are in
 * that frame. */
enum hsr_status hsr_scene_json_read_frame(struct hsr_scene *scene,
                                          const char *path, long frame,
                                          struct hsr_import *import,
                                          struct hsr_error *err);

/* Appends the views of a camera file to a scene. The file is {"schema":
 * "hsr-camera/1", "views": [...]}, with at least one view, each as in a scene
 * file. HSR_E_INPUT, as hsr_scene_json_read; HSR_E_NOMEM. */
enum hsr_status hsr_cameras_json_read(struct hsr_scene *scene, const char *path,
                                      struct hsr_error *err);

/* Writes a camera file with n views. Reading it back gives the same doubles.
 * HSR_E_INPUT if it cannot be written; HSR_E_NOMEM. */
enum hsr_status hsr_cameras_json_write(const struct hsr_camera *views,
                                       uint32_t n, const char *path,
                                       struct hsr_error *err);

/* The same, to a stream that is open. */
enum hsr_status hsr_cameras_json_print(const struct hsr_camera *views,
                                       uint32_t n, FILE *out,
                                       struct hsr_error *err);

/* Writes a scene file. Reading it back gives the same doubles. HSR_E_INPUT if
 * it cannot be written; HSR_E_NOMEM. */
enum hsr_status hsr_scene_json_write(const struct hsr_scene *scene,
                                     const char *path, struct hsr_error *err);

/* The same, to a stream that is open; the caller looks whether it could be
 * written. */
enum hsr_status hsr_scene_json_print(const struct hsr_scene *scene, FILE *out,
                                     struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
