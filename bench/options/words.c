/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/options/words.h"
#include "common/view/view.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool parse_number(const char *text, double *number) {
  char *end;
  errno = 0;
  *number = strtod(text, &end);
  return end != text && !*end && isfinite(*number);
}

bool parse_count(const char *text, long least, long most, long *count) {
  char *end;
  errno = 0;
  *count = strtol(text, &end, 10);
  return end != text && !*end && !errno && *count >= least && *count <= most;
}

bool parse_range(const char *text, long least, long *first, long *last) {
  char start[32];
  size_t n = strcspn(text, "-");
  if (n >= sizeof start)
    return false;
  snprintf(start, sizeof start, "%.*s", (int)n, text);
  return parse_count(start, least, INT_MAX, first) &&
         parse_count(text[n] ? text + n + 1 : start, *first, INT_MAX, last);
}

bool parse_size(const char *text, int *m, int *n) {
  return parse_size_to(text, HSR_MAX_SIZE, m, n);
}

bool parse_size_to(const char *text, int most, int *m, int *n) {
  char *end;
  errno = 0;
  long width = strtol(text, &end, 10), height = width;
  if (end == text)
    return false;
  if (*end == 'x') {
    const char *second = end + 1;
    height = strtol(second, &end, 10);
    if (end == second)
      return false;
  }
  if (*end || errno || width < 1 || height < 1 || width > most || height > most)
    return false;
  *m = (int)width;
  *n = (int)height;
  return true;
}

bool parse_point(const char *text, double point[3]) {
  for (int k = 0; k < 3; k++) {
    char *end;
    point[k] = strtod(text, &end);
    if (end == text || *end != (k < 2 ? ',' : '\0') || !isfinite(point[k]))
      return false;
    text = end + 1;
  }
  return true;
}

bool next_name(const char **names, char *name, size_t size) {
  if (!**names)
    return false;
  size_t length = strcspn(*names, ",");
  snprintf(name, size, "%.*s", (int)length, *names);
  *names += length + ((*names)[length] == ',');
  return true;
}

bool series_name(const char *pattern, long number, char name[MOST_FILE_NAME]) {
  size_t n = 0;
  int places = 0;
  for (const char *c = pattern; *c && n + 1 < MOST_FILE_NAME; c++) {
    if (*c != '%' || c[1] == '%') {
      c += *c == '%';
      name[n++] = *c;
      continue;
    }
    bool zeros = c[1] == '0';
    int width = 0;
    for (c++; *c >= '0' && *c <= '9' && width < 20; c++)
      width = 10 * width + (*c - '0');
    if (*c != 'd' || width > 20)
      return false;
    places++;
    int used = snprintf(name + n, MOST_FILE_NAME - n, zeros ? "%0*ld" : "%*ld",
                        width, number);
    n += (size_t)used;
  }
  if (n + 1 >= MOST_FILE_NAME)
    return false;
  name[n] = '\0';
  return places == 1;
}
