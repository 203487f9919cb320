/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The text of a JSON file, and words for messages about it. */
#ifndef HSR_COMMON_FILES_JSON_FILE_H
#define HSR_COMMON_FILES_JSON_FILE_H

#include "common/base/status.h"

#include <jansson.h>

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Reads a regular file. *text must be NULL before the call. It becomes a
 * malloc'ed array with the *length bytes of the file, without a NUL at the end.
 * The caller frees it, also after a failure. HSR_E_INPUT if the file cannot be
 * read, is not a regular file, or has a NUL byte, which the parser might take
 * for its end; HSR_E_NOMEM. */
enum hsr_status hsr_json_load(const char *path, char **text, size_t *length,
                              struct hsr_error *err);

/* Returns the kind of a value, for messages: "an object", "a number", ... */
const char *hsr_json_kind(const json_t *value);

#ifdef __cplusplus
}
#endif
#endif
