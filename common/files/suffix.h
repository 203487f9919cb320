/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A file's format, by its name. */
#ifndef HSR_COMMON_FILES_SUFFIX_H
#define HSR_COMMON_FILES_SUFFIX_H

#include <stdbool.h>
#include <string.h>
#include <strings.h>

/* Whether `path` ends in `suffix`, ".svg", whatever the case of its letters. */
static inline bool hsr_ends_in(const char *path, const char *suffix) {
  const char *dot = strrchr(path, '.');
  return dot && !strcasecmp(dot, suffix);
}

/* Whether a file of this name can hold only a line drawing. */
static inline bool hsr_is_line_file(const char *path) {
  return hsr_ends_in(path, ".svg") || hsr_ends_in(path, ".pdf") ||
         hsr_ends_in(path, ".vtp");
}

#endif
