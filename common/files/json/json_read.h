/* SPDX-License-Identifier: GPL-3.0-or-later */
/* jansson's parser, with lack of memory reported as such; and reading a text in
 * parts, so that a long list is never a tree as a whole. */
#ifndef HSR_COMMON_JSON_READ_H
#define HSR_COMMON_JSON_READ_H

#include <jansson.h>

#include <stdbool.h>

/* Parses what `read` gives until it gives 0 bytes, as json_load_callback does.
 * The caller owns the value. NULL: *out_of_memory is set, or else *error says
 * what is wrong. */
json_t *hsr_json_read(json_load_callback_t read, void *data, size_t flags,
                      bool *out_of_memory, json_error_t *error);

/* The same for a text of `length` bytes. */
json_t *hsr_json_read_text(const char *text, size_t length, size_t flags,
                           bool *out_of_memory, json_error_t *error);

/* A part of a text, which is borrowed: a value, or what is between the brackets
 * of an array. NULL: there is nothing. */
struct hsr_json_part {
  const char *text;
  size_t length;
  int line; /* where it begins */
};

enum { HSR_JSON_MOST_LISTS = 4 };

/* Which members are read as lists. levels[0] has the keys of such members of a
 * value, at most HSR_JSON_MOST_LISTS and ended by NULL; levels[1] those of an
 * element of such a list; and so on. A level that is NULL ends it. */
typedef const char *const *hsr_json_levels;

/* Parses a value, as hsr_json_read does. If it is an object, every member
 * levels[0][k] that is an array is empty in the tree, and list[k] has its
 * elements, unless there are none; the other lists are NULL. If it is an array,
 * and there is a level, the array is empty, too. The line in *error counts from
 * the start of the whole text; for a list that does not end, it is the line of
 * the first fault in it. */
json_t *hsr_json_read_part(struct hsr_json_part part, size_t flags,
                           const hsr_json_levels *levels,
                           struct hsr_json_part *list, bool *out_of_memory,
                           json_error_t *error);

/* The number of line ends between two places of a text. */
int hsr_json_lines(const char *at, const char *end);

/* The number of elements of a list, judged by its commas. */
size_t hsr_json_count(struct hsr_json_part list);

/* Takes the first element off a list; false if it has none. */
bool hsr_json_next(struct hsr_json_part *list, struct hsr_json_part *element);

#endif
