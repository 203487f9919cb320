/* SPDX-License-Identifier: GPL-3.0-or-later */
/* .scene.json files, through jansson; the format is docs/scene.schema.json. */
#ifndef HSR_COMMON_SCENE_JSON_H
#define HSR_COMMON_SCENE_JSON_H

#include "common/files/mesh/exchange.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Appends everything in the file to an empty scene. The caller must call
 * hsr_scene_finish. Paths of mesh files are relative to the scene file.
 * HSR_E_INPUT with file and line, or the JSON path of the offending value;
 * HSR_E_NOMEM. */
enum hsr_status hsr_scene_json_read(struct hsr_scene *scene, const char *path,
                                    struct hsr_import *import,
                                    struct hsr_error *err);

/* The same of another frame than the file's own: instances that have places are
 * where they are in that frame. */
enum hsr_status hsr_scene_json_read_frame(struct hsr_scene *scene,
                                          const char *path, long frame,
                                          struct hsr_import *import,
                                          struct hsr_error *err);

/* Appends the views of a file of cameras, {"schema": "hsr-camera/1", "views":
 * [...]}, to a scene. Each view is as in a scene file, and there is at least
 * one. HSR_E_INPUT, HSR_E_NOMEM. */
enum hsr_status hsr_cameras_json_read(struct hsr_scene *scene, const char *path,
                                      struct hsr_error *err);

/* Writes such a file of n views, each number in full precision. HSR_E_INPUT: it
 * cannot be written; HSR_E_NOMEM. */
enum hsr_status hsr_cameras_json_write(const struct hsr_camera *views,
                                       uint32_t n, const char *path,
                                       struct hsr_error *err);

/* Writes a scene so that reading it back gives the same doubles. */
enum hsr_status hsr_scene_json_write(const struct hsr_scene *scene,
                                     const char *path, struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
