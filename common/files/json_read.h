/* SPDX-License-Identifier: GPL-3.0-or-later */
/* jansson's parser, with a lack of memory that is told as such; and texts read
 * in parts, so that there is never a tree of all of a long list. */
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

/* A part of a text, which is borrowed: a value, or what is between the brackets
 * of an array. NULL: there is nothing. */
struct hsr_json_part {
  const char *text;
  size_t length;
  int line; /* where it begins */
};

enum { HSR_JSON_MOST_LISTS = 4 };

/* What members are read as lists: levels[0] has the keys of those of a value,
 * up to HSR_JSON_MOST_LISTS and ended by NULL; levels[1] those of a value that
 * is an element of such a list; and so on. NULL ends all. */
typedef const char *const *hsr_json_levels;

/* Parses a value, as hsr_json_read. Where it is an object, its members that are
 * arrays and called as levels[0][k] are empty in the tree, and list[k] has
 * their elements, unless there are none; the other lists are NULL. Where it is
 * an array, and there is a level, it is empty, too. *error has a line of the
 * whole text: of a list that does not end, that of the first fault in it. */
json_t *hsr_json_read_part(struct hsr_json_part part, size_t flags,
                           const hsr_json_levels *levels,
                           struct hsr_json_part *list, bool *out_of_memory,
                           json_error_t *error);

/* The lines that end between two places of a text. */
int hsr_json_lines(const char *at, const char *end);

/* The elements of a list, as far as commas tell. */
size_t hsr_json_count(struct hsr_json_part list);

/* Takes the first element off a list; false if it has none. */
bool hsr_json_next(struct hsr_json_part *list, struct hsr_json_part *element);

#endif
