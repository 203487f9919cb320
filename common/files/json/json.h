/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Building JSON with jansson. */
#ifndef HSR_COMMON_FILES_JSON_H
#define HSR_COMMON_FILES_JSON_H

#include <jansson.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Appends a value and takes over the caller's reference to it. If that fails,
 * or the value is NULL, *array is freed and becomes NULL. So a failure shows in
 * the value that is printed in the end. */
void hsr_json_append(json_t **array, json_t *value);

#ifdef __cplusplus
}
#endif
#endif
