/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The text of a JSON file, and words for messages about it. */
#ifndef HSR_COMMON_FILES_JSON_FILE_H
#define HSR_COMMON_FILES_JSON_FILE_H

#include "common/base/status.h"

#include <jansson.h>

#include <stddef.h>

/* Reads a regular file. *text must be NULL before the call. It becomes a
 * malloc'ed array with the *length bytes of the file, without a NUL at the end.
 * The caller frees it, also after a failure. HSR_E_INPUT if the file cannot be
 * read, is not a regular file, or has a NUL byte, which the parser might take
 * for its end; HSR_E_NOMEM. */
enum hsr_status hsr_json_load(const char *path, char **text, size_t *length,
                              struct hsr_error *err);

/* Fills *err with "PATH: WHAT: " and the reason in errno, and returns
 * HSR_E_INPUT. If the reason is lack of memory, it is hsr_fail_nomem
 * instead. */
enum hsr_status hsr_json_fail_errno(const char *path, const char *what,
                                    struct hsr_error *err);

/* Returns the path as messages show it: all of it, or its last 180 bytes if it
 * is longer. The result is a part of `path`. */
const char *hsr_json_shown(const char *path);

/* Returns the kind of a value, for messages: "an object", "a number", ... */
const char *hsr_json_kind(const json_t *value);

#endif
