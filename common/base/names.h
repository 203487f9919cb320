/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of names, and which of them a misspelt word resembles. */
#ifndef HSR_COMMON_BASE_NAMES_H
#define HSR_COMMON_BASE_NAMES_H

#include "common/base/status.h"

#include <stddef.h>

/* A list that grows. .names is a malloc'ed array of n malloc'ed strings. All
 * zero: empty. */
struct hsr_names {
  char **names;
  size_t n, cap;
};

/* Appends a copy of the first `length` characters. HSR_E_NOMEM. */
enum hsr_status hsr_names_add(struct hsr_names *list, const char *name,
                              size_t length);
void hsr_names_free(struct hsr_names *list);

/* Appends to `text`, which holds size bytes, the names that resemble `word`:
 * ": did you mean a, b?", or nothing. */
void hsr_names_like(const struct hsr_names *list, const char *word, char *text,
                    size_t size);

#endif
