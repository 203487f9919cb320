/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/stranger/table.h"
#include "common/files/whole_input.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* A text that is read. */
struct text {
  const char *path;
  const char *at, *end;
  int line;
};

static bool is_gap(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == '\r';
}

/* Goes to the next word of the line. False if there is none. */
static bool next_word(struct text *t) {
  while (t->at < t->end && is_gap(*t->at))
    t->at++;
  if (t->at < t->end && *t->at == '#')
    while (t->at < t->end && *t->at != '\n')
      t->at++;
  return t->at < t->end && *t->at != '\n';
}

/* Takes a word: a whole number below 2^32 - 1, or none. */
static bool take_number(struct text *t, uint32_t *number) {
  const char *begin = t->at;
  uint64_t value = 0;
  bool good = true;
  for (; t->at < t->end && !is_gap(*t->at) && *t->at != '\n' && *t->at != '#';
       t->at++) {
    good &= *t->at >= '0' && *t->at <= '9' && value < UINT32_MAX;
    value = 10 * value + (uint64_t)(*t->at - '0');
  }
  *number = (uint32_t)value;
  if (t->at - begin == 4 && !memcmp(begin, "none", 4)) {
    *number = UINT32_MAX;
    return true;
  }
  return good && value < UINT32_MAX;
}

/* Takes a line. *n becomes the numbers of it, which are `columns` or none. */
static enum hsr_status take_line(struct text *t, size_t columns,
                                 uint32_t *number, size_t *n,
                                 struct hsr_error *err) {
  uint32_t value;
  for (*n = 0; next_word(t); ++*n) {
    bool good = take_number(t, &value);
    if (*n < columns && good && (value < UINT32_MAX || *n + 1 == columns))
      number[*n] = value;
    else if (*n < columns)
      return hsr_fail(err, HSR_E_INPUT, "%s:%d: word %zu is no whole number",
                      hsr_path_shown(t->path), t->line, *n + 1);
  }
  if (*n && *n != columns)
    return hsr_fail(err, HSR_E_INPUT, "%s:%d: %zu numbers; %zu are needed",
                    hsr_path_shown(t->path), t->line, *n, columns);
  return HSR_OK;
}

static enum hsr_status add_row(struct table *table, size_t columns,
                               const uint32_t *number, struct hsr_error *err) {
  const size_t n = table->rows;
  if ((n & (n - 1)) == 0) { /* there is room for 2^k rows */
    size_t room = n ? 2 * n : 1;
    uint32_t *larger =
        realloc(table->number, room * columns * sizeof *table->number);
    if (!larger)
      return hsr_fail_nomem(err);
    table->number = larger;
  }
  memcpy(table->number + n * columns, number, columns * sizeof *number);
  table->rows++;
  return HSR_OK;
}

enum hsr_status table_read(const char *path, size_t columns,
                           struct table *table, struct hsr_error *err) {
  uint32_t number[8];
  unsigned char *bytes;
  size_t size, n;
  *table = (struct table){.number = NULL};
  enum hsr_status status = hsr_whole_input(path, &bytes, &size, err);
  if (status)
    return status;
  struct text t = {path, (const char *)bytes, (const char *)bytes + size, 1};
  while (!status && t.at < t.end) {
    status = take_line(&t, columns, number, &n, err);
    if (!status && n)
      status = add_row(table, columns, number, err);
    t.at += t.at < t.end; /* the end of the line */
    t.line++;
  }
  free(bytes);
  if (!status && !table->rows)
    status =
        hsr_fail(err, HSR_E_INPUT, "%s: has no numbers", hsr_path_shown(path));
  return status;
}
