/* SPDX-License-Identifier: GPL-3.0-or-later */
/* jansson's parser, with lack of memory told apart from wrong input; and
 * parsing a text part by part, so that a long list is never one tree in
 * memory. */
#ifndef HSR_COMMON_JSON_READ_H
#define HSR_COMMON_JSON_READ_H

#include <jansson.h>

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Parses the bytes that `read` returns until it returns 0, as
 * json_load_callback does with the same flags. The caller owns the value. NULL:
 * memory ran out and *out_of_memory is true, or else *error says what is
 * wrong. */
json_t *hsr_json_read(json_load_callback_t read, void *data, size_t flags,
                      bool *out_of_memory, json_error_t *error);

/* The same for a text of `length` bytes. */
json_t *hsr_json_read_text(const char *text, size_t length, size_t flags,
                           bool *out_of_memory, json_error_t *error);

/* A part of a text: one value, or a list, which is the text between the
 * brackets of an array. Borrowed. */
struct hsr_json_part {
  const char *text; /* NULL: there is nothing */
  size_t length;
  int line; /* the line of the whole text where it begins, from 1 */
};

enum { HSR_JSON_MOST_LISTS = 16 };

/* The members that are read as lists. levels[0] has the keys of such members of
 * the outermost value, at most HSR_JSON_MOST_LISTS, ended by NULL. levels[1]
 * has those of an element of such a list, and so on. A NULL ends the levels. */
typedef const char *const *hsr_json_levels;

/* Parses a value, as hsr_json_read does. If it is an object, every member
 * levels[0][k] that is an array becomes an empty array in the tree, and list[k]
 * gets its elements. list[k] is NULL if it has none or the member is absent. If
 * the value is an array and levels[0] is not NULL, it becomes an empty array
 * too. The line in *error counts from the start of the whole text. If a list
 * does not end, it is the line of the first fault in the list. */
json_t *hsr_json_read_part(struct hsr_json_part part, size_t flags,
                           const hsr_json_levels *levels,
                           struct hsr_json_part *list, bool *out_of_memory,
                           json_error_t *error);

/* Returns the number of line ends in [at, end). */
int hsr_json_lines(const char *at, const char *end);

/* Returns the number of elements of a list, by its commas. The elements are not
 * checked. */
size_t hsr_json_count(struct hsr_json_part list);

/* Removes the first element from *list and sets *element to it. False if the
 * list has none. */
bool hsr_json_next(struct hsr_json_part *list, struct hsr_json_part *element);

#ifdef __cplusplus
}
#endif
#endif
