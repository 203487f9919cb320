/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/json/json_file.h"

#include "common/files/json/json_read.h"
#include "common/files/whole_input.h"

#include <string.h>

const char *hsr_json_kind(const json_t *value) {
  switch (json_typeof(value)) {
  case JSON_OBJECT:
    return "an object";
  case JSON_ARRAY:
    return "an array";
  case JSON_STRING:
    return "a string";
  case JSON_TRUE:
  case JSON_FALSE:
    return "a truth value";
  case JSON_NULL:
    return "null";
  default:
    return "a number";
  }
}

enum hsr_status hsr_json_load(const char *path, char **text, size_t *length,
                              struct hsr_error *err) {
  unsigned char *bytes;
  enum hsr_status status = hsr_whole_input(path, &bytes, length, err);
  if (status)
    return status;
  *text = (char *)bytes;
  const char *nul = memchr(*text, 0, *length);
  return nul ? hsr_fail(err, HSR_E_INPUT, "%s:%d: a NUL byte",
                        hsr_path_shown(path), 1 + hsr_json_lines(*text, nul))
             : HSR_OK;
}
