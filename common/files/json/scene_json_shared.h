/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What reading and writing scene files share. */
#ifndef HSR_COMMON_FILES_SCENE_JSON_SHARED_H
#define HSR_COMMON_FILES_SCENE_JSON_SHARED_H

#include "common/scene/scene.h"

#include <jansson.h>

#define HSR_SCENE_SCHEMA "hsr-scene/1"
#define HSR_CAMERA_SCHEMA "hsr-camera/1"

/* The objects' numbers by name, HSR_JSON_AMBIGUOUS where several share one.
 * NULL: out of memory. */
enum { HSR_JSON_AMBIGUOUS = -1 };
json_t *hsr_json_number_objects(const struct hsr_scene *scene);

#endif
