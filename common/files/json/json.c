/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/json/json.h"

void hsr_json_append(json_t **array, json_t *value) {
  /* Both functions take NULL for an error and free the value. */
  if (json_array_append_new(*array, value)) {
    json_decref(*array);
    *array = NULL;
  }
}
