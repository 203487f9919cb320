/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of names, and suggestions for a misspelt word. */
#ifndef HSR_COMMON_BASE_NAMES_H
#define HSR_COMMON_BASE_NAMES_H

#include "common/base/status.h"

#include <stddef.h>

/* A list that grows: a malloc'ed array of n malloc'ed strings, with room for
 * `cap`. It is empty if it is all zero. */
struct hsr_names {
  char **names;
  size_t n, cap;
};

/* Appends a copy of the first `length` characters of `name`, ended by a NUL.
 * HSR_E_NOMEM; the list is then as it was. */
enum hsr_status hsr_names_add(struct hsr_names *list, const char *name,
                              size_t length);

/* Frees the strings and the array. The list is empty afterwards. */
void hsr_names_free(struct hsr_names *list);

/* Appends ": did you mean a, b?" to the string `text`, an array of `size`
 * bytes, or nothing if no name resembles `word`. At most five names are listed.
 * A name resembles a word if one contains the other, or if about a third of
 * the word's letters must be changed. What does not fit into `text` is cut
 * off. */
void hsr_names_like(const struct hsr_names *list, const char *word, char *text,
                    size_t size);

/* The same of a table: its elements have `stride` bytes and begin with their
 * names, and the last has none. */
void hsr_names_like_of(const void *table, size_t stride, const char *word,
                       char *text, size_t size);

#endif
