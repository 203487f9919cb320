/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Code that the reader and the writer of scene files share. */
#ifndef HSR_COMMON_FILES_SCENE_JSON_SHARED_H
#define HSR_COMMON_FILES_SCENE_JSON_SHARED_H

#include "common/scene/scene.h"

#include <jansson.h>

#define HSR_SCENE_SCHEMA "hsr-scene/1"
#define HSR_CAMERA_SCHEMA "hsr-camera/1"

/* Returns a JSON object that maps the names of objects to their numbers. A name
 * that several objects share is mapped to HSR_JSON_AMBIGUOUS. The caller
 * releases it. NULL: out of memory. */
enum { HSR_JSON_AMBIGUOUS = -1 };
json_t *hsr_json_number_objects(const struct hsr_scene *scene);

#endif
