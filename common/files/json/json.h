/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Building JSON with jansson. */
#ifndef HSR_COMMON_FILES_JSON_H
#define HSR_COMMON_FILES_JSON_H

#include <jansson.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Appends a value to *array and takes over the caller's reference to it. If the
 * value is NULL or memory runs out, *array is released and becomes NULL. If it
 * is NULL already, the value is released. So a caller can append many values
 * and check *array once, at the end. */
void hsr_json_append(json_t **array, json_t *value);

/* A new array of the words of a text that `mark` separates; of an empty text, one
 * empty word. null if the text is NULL; NULL: out of memory. */
json_t *hsr_json_words(const char *text, char mark);

#ifdef __cplusplus
}
#endif
#endif
