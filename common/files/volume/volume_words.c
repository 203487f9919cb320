/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/volume/volume_words.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const keys[] = {"least",  "most",      "gradient", "sides",
                                   "size",   "type",      "offset",   "spacing",
                                   "levels", "photograph"};
enum { N_KEYS = sizeof keys / sizeof *keys, LONGEST = 256 };

static const struct hsr_raw_type types[] = {
    {"u8", 1, false, false, false},     {"i8", 1, true, false, false},
    {"u16-le", 2, false, false, false}, {"u16-be", 2, false, false, true},
    {"i16-le", 2, true, false, false},  {"i16-be", 2, true, false, true},
    {"f32-le", 4, true, true, false},   {"f32-be", 4, true, true, true}};

/* Whether a word, from behind its colon, begins with a key that is known. */
static bool is_word(const char *at) {
  for (int k = 0; k < N_KEYS; k++) {
    size_t n = strlen(keys[k]);
    if (!strncmp(at, keys[k], n) && at[n] == '=')
      return true;
  }
  return false;
}

size_t hsr_name_before_words(const char *name) {
  for (const char *at = name; (at = strchr(at, ':')); at++)
    if (is_word(at + 1))
      return (size_t)(at - name);
  return strlen(name);
}

static bool read_real(const char *text, double *value) {
  char *end;
  *value = strtod(text, &end);
  return end != text && !*end && isfinite(*value);
}

static bool read_size(const char *text, uint32_t size[3]) {
  char end;
  if (strspn(text, "0123456789x") != strlen(text) ||
      sscanf(text, "%7ux%7ux%7u%c", &size[0], &size[1], &size[2], &end) != 3)
    return false;
  for (int a = 0; a < 3; a++)
    if (size[a] < 1 || size[a] > HSR_VOLUME_MOST)
      return false;
  return true;
}

static bool read_spacing(const char *text, double spacing[3]) {
  char end;
  if (sscanf(text, "%20lfx%20lfx%20lf%c", &spacing[0], &spacing[1], &spacing[2],
             &end) != 3)
    return false;
  for (int a = 0; a < 3; a++)
    if (!(spacing[a] > 0 && spacing[a] < 1e20))
      return false;
  return true;
}

static bool read_type(const char *text, struct hsr_raw_type *type) {
  for (size_t k = 0; k < sizeof types / sizeof *types; k++)
    if (!strcmp(types[k].name, text)) {
      *type = types[k];
      return true;
    }
  return false;
}

static bool read_whole(const char *text, uint64_t most, uint64_t *value) {
  char end;
  unsigned long long number;
  if (strspn(text, "0123456789") != strlen(text) ||
      sscanf(text, "%18llu%c", &number, &end) != 1 || number > most)
    return false;
  *value = number;
  return true;
}

static bool read_word(struct hsr_volume_words *w, const char *key,
                      const char *value) {
  uint64_t whole = 0;
  if (!strcmp(key, "least"))
    return read_real(value, &w->least);
  if (!strcmp(key, "most"))
    return read_real(value, &w->most);
  if (!strcmp(key, "gradient"))
    return read_real(value, &w->gradient);
  if (!strcmp(key, "sides"))
    return w->all_sides = !strcmp(value, "all");
  if (!strcmp(key, "size"))
    return read_size(value, w->size);
  if (!strcmp(key, "type"))
    return read_type(value, &w->type);
  if (!strcmp(key, "offset"))
    return read_whole(value, UINT64_C(1) << 50, &w->offset);
  if (!strcmp(key, "spacing"))
    return read_spacing(value, w->spacing);
  if (!strcmp(key, "photograph")) {
    snprintf(w->photograph, sizeof w->photograph, "%s", value);
    return *value;
  }
  if (strcmp(key, "levels") != 0 || !read_whole(value, 4096, &whole))
    return false;
  w->levels = (uint32_t)whole;
  return whole > 0;
}

enum hsr_status hsr_volume_words_read(struct hsr_volume_words *words,
                                      const char *name, struct hsr_error *err) {
  *words = (struct hsr_volume_words){.least = NAN,
                                     .most = INFINITY,
                                     .type = types[0],
                                     .spacing = {1, 1, 1},
                                     .levels = 64};
  const char *at = name + hsr_name_before_words(name);
  while (*at == ':') {
    char word[LONGEST];
    size_t n = strcspn(++at, ":");
    snprintf(word, sizeof word, "%.*s", (int)n, at);
    char *equals = strchr(word, '=');
    if (equals)
      *equals++ = '\0';
    if (!equals || n >= sizeof word || !read_word(words, word, equals))
      return hsr_fail(err, HSR_E_INPUT,
                      "%.150s: the word \"%.*s\" is not known, or cannot be so",
                      name, n < 60 ? (int)n : 60, at);
    at += n;
  }
  return HSR_OK;
}
