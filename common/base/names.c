/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/base/names.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum hsr_status hsr_names_add(struct hsr_names *list, const char *name,
                              size_t length) {
  if (list->n == list->cap) {
    size_t cap = list->cap ? 2 * list->cap : 16;
    char **names = realloc(list->names, cap * sizeof *names);
    if (!names)
      return HSR_E_NOMEM;
    list->names = names;
    list->cap = cap;
  }
  char *copy = malloc(length + 1);
  if (!copy)
    return HSR_E_NOMEM;
  memcpy(copy, name, length);
  copy[length] = '\0';
  list->names[list->n++] = copy;
  return HSR_OK;
}

void hsr_names_free(struct hsr_names *list) {
  for (size_t i = 0; i < list->n; i++)
    free(list->names[i]);
  free(list->names);
  *list = (struct hsr_names){0};
}

enum { LONGEST_WORD = 63, MOST_LISTED = 5 };

static size_t least(size_t a, size_t b) {
  return a < b ? a : b;
}

/* How many letters must be put in, left out, changed or swapped with their
 * neighbour to make one word of the other. */
static size_t distance(const char *a, const char *b) {
  size_t row[3][LONGEST_WORD + 2], m = strlen(a), n = strlen(b);
  for (size_t k = 0; k <= n; k++)
    row[0][k] = k;
  for (size_t i = 1; i <= m; i++) {
    size_t *now = row[i % 3], *last = row[(i + 2) % 3], *old = row[(i + 1) % 3];
    now[0] = i;
    for (size_t k = 1; k <= n; k++) {
      now[k] = least(last[k - 1] + (a[i - 1] != b[k - 1]),
                     least(last[k], now[k - 1]) + 1);
      if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1])
        now[k] = least(now[k], old[k - 2] + 1);
    }
  }
  return row[m % 3][n];
}

/* Close: a third of the letters or fewer to mend, or one within the other. */
static bool resembles(const char *name, const char *word) {
  size_t length = strlen(word);
  if (!length || length > LONGEST_WORD || strlen(name) > LONGEST_WORD)
    return false;
  if (length >= 3 && (strstr(name, word) || strstr(word, name)))
    return true;
  return distance(name, word) <= (length < 3 ? 1 : (length + 1) / 3);
}

/* Appends a name if it resembles the word; *found have been before. */
static void offer(const char *name, const char *word, int *found, char *text,
                  size_t size) {
  size_t used = strlen(text);
  if (*found < MOST_LISTED && resembles(name, word))
    snprintf(text + used, size - used, "%s%s",
             (*found)++ ? ", " : ": did you mean ", name);
}

static void ask(int found, char *text, size_t size) {
  size_t used = strlen(text);
  if (found)
    snprintf(text + used, size - used, "?");
}

void hsr_names_like(const struct hsr_names *list, const char *word, char *text,
                    size_t size) {
  int found = 0;
  for (size_t i = 0; i < list->n; i++)
    offer(list->names[i], word, &found, text, size);
  ask(found, text, size);
}

void hsr_names_like_of(const void *table, size_t stride, const char *word,
                       char *text, size_t size) {
  int found = 0;
  const char *const *name = table;
  for (; *name; name = (const void *)((const char *)name + stride))
    offer(*name, word, &found, text, size);
  ask(found, text, size);
}
