/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All bytes of a file. */
#ifndef HSR_COMMON_FILES_WHOLE_INPUT_H
#define HSR_COMMON_FILES_WHOLE_INPUT_H

#include "common/base/status.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the path as messages show it: all of it, or its last 180 bytes if it
 * is longer. The result is a part of `path`. */
const char *hsr_path_shown(const char *path);

/* Fills *err with "PATH: WHAT: " and the reason in errno, and returns
 * HSR_E_INPUT. If the reason is lack of memory, it is hsr_fail_nomem
 * instead. */
enum hsr_status hsr_path_fail(const char *path, const char *what,
                              struct hsr_error *err);

/* Reads a regular file. *bytes becomes a malloc'ed array of *size bytes, which
 * the caller frees; NULL after a failure. HSR_E_INPUT if it cannot be read or
 * is not a regular file; HSR_E_NOMEM. */
enum hsr_status hsr_whole_input(const char *path, unsigned char **bytes,
                                size_t *size, struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
