/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The format of a file, by its name. */
#ifndef HSR_COMMON_FILES_SUFFIX_H
#define HSR_COMMON_FILES_SUFFIX_H

#include <stdbool.h>
#include <string.h>
#include <strings.h>

/* Whether `path` ends in `suffix`, ".svg", in upper or lower case. */
static inline bool hsr_ends_in(const char *path, const char *suffix) {
  size_t n = strlen(path), k = strlen(suffix);
  return n >= k && !strcasecmp(path + n - k, suffix);
}

/* Whether a file of this name holds a drawing on paper. */
static inline bool hsr_is_paper_file(const char *path) {
  return hsr_ends_in(path, ".svg") || hsr_ends_in(path, ".pdf") ||
         hsr_ends_in(path, ".eps") || hsr_ends_in(path, ".dxf");
}

/* Whether a file of this name can hold a line drawing or polygons, but no
 * picture of pixels. */
static inline bool hsr_is_line_file(const char *path) {
  return hsr_is_paper_file(path) || hsr_ends_in(path, ".vtp") ||
         hsr_ends_in(path, ".json");
}

/* Whether a file of this name holds numbers, without colours. */
static inline bool hsr_is_array_file(const char *path) {
  return hsr_ends_in(path, ".npy");
}

/* Whether a file of this name holds depths and nothing else. */
static inline bool hsr_is_depth_file(const char *path) {
  return hsr_ends_in(path, ".depth.npy") || hsr_ends_in(path, ".depth.png");
}

/* Whether a file of this name holds colours as an array of numbers. */
static inline bool hsr_is_colour_array(const char *path) {
  return hsr_ends_in(path, ".rgb.npy");
}

/* Whether a file of this name may hold the colours of pixels. */
static inline bool hsr_is_colour_file(const char *path) {
  return hsr_is_colour_array(path) ||
         !(hsr_is_line_file(path) || hsr_is_array_file(path) ||
           hsr_is_depth_file(path));
}

/* Whether a file of this name can hold an opacity beside the colours. */
static inline bool hsr_can_be_clear(const char *path) {
  return hsr_is_colour_array(path) || hsr_ends_in(path, ".exr") ||
         (hsr_ends_in(path, ".png") && !hsr_is_depth_file(path));
}

#endif
