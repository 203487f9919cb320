/* SPDX-License-Identifier: GPL-3.0-or-later */
/* jansson's parser, with a lack of memory that is told as such. */
#ifndef HSR_COMMON_JSON_READ_H
#define HSR_COMMON_JSON_READ_H

#include <jansson.h>

#include <stdbool.h>

/* Parses what `read` gives until that is 0 bytes, as json_load_callback. NULL:
 * *out_of_memory, or else the fault that *error tells. */
json_t *hsr_json_read(json_load_callback_t read, void *data, size_t flags,
                      bool *out_of_memory, json_error_t *error);

/* The same of a text of that length. */
json_t *hsr_json_read_text(const char *text, size_t length, size_t flags,
                           bool *out_of_memory, json_error_t *error);

#endif
