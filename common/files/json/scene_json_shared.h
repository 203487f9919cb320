/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Code that the reader and the writer of scene files share. */
#ifndef HSR_COMMON_FILES_SCENE_JSON_SHARED_H
#define HSR_COMMON_FILES_SCENE_JSON_SHARED_H

#include "common/scene/scene.h"

#include <jansson.h>

#define HSR_SCENE_SCHEMA "hsr-scene/1"
#define HSR_CAMERA_SCHEMA "hsr-camera/1"

/* Adds a name and its number to a JSON object. A name that is added more than
 * once gets the number HSR_JSON_AMBIGUOUS. False: out of memory. */
enum { HSR_JSON_AMBIGUOUS = -1 };
bool hsr_json_add_number(json_t *numbers, const char *name, uint32_t number);

#endif
