/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/json/json.h"

#include <string.h>

void hsr_json_append(json_t **array, json_t *value) {
  /* Both functions take NULL for an error and free the value. */
  if (json_array_append_new(*array, value)) {
    json_decref(*array);
    *array = NULL;
  }
}

json_t *hsr_json_words(const char *text, char mark) {
  if (!text)
    return json_null();
  json_t *words = json_array();
  for (const char *end; (end = strchr(text, mark)); text = end + 1)
    hsr_json_append(&words, json_stringn(text, (size_t)(end - text)));
  hsr_json_append(&words, json_string(text));
  return words;
}
