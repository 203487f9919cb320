/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The text of a JSON file, and words for messages about it. */
#ifndef HSR_COMMON_FILES_JSON_FILE_H
#define HSR_COMMON_FILES_JSON_FILE_H

#include "common/base/status.h"

#include <jansson.h>

#include <stddef.h>

/* Reads a regular file of *length bytes. The caller frees *text, also after a
 * failure; it is NULL before. HSR_E_INPUT if the file cannot be read, is no
 * regular file, or holds a NUL, which would end it for the parser, or be
 * overlooked; HSR_E_NOMEM. */
enum hsr_status hsr_json_load(const char *path, char **text, size_t *length,
                              struct hsr_error *err);

/* HSR_E_INPUT, "PATH: WHAT: why", by errno; HSR_E_NOMEM if that is why. */
enum hsr_status hsr_json_fail_errno(const char *path, const char *what,
                                    struct hsr_error *err);

/* The last part of a path that is too long to leave room for a message. */
const char *hsr_json_shown(const char *path);

/* "an object", "a number", ... */
const char *hsr_json_kind(const json_t *value);

#endif
