/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/palette_json.h"

#include "common/base/names.h"
#include "common/files/json_file.h"
#include "common/files/json_read.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char SCHEMA[] = "hsr-palette/1";

enum { ONE = 65535, LIGHT_LENGTH = 1024, MOST_EXPONENT = 128 };

struct reader {
  const char *path;
  json_t *root;
  struct hsr_error *err;
};

/* --- Messages ------------------------------------------------------------- */

/* A place in the file as a JSON pointer: a member, and what is in it. */
struct place {
  char text[80];
};

static struct place member(const char *key) {
  struct place place;
  snprintf(place.text, sizeof place.text, "/%s", key);
  return place;
}

static struct place element(struct place of, size_t index) {
  size_t n = strlen(of.text);
  snprintf(of.text + n, sizeof of.text - n, "/%zu", index);
  return of;
}

/* HSR_E_INPUT: "FILE: POINTER: text". */
static enum hsr_status refuse(const struct reader *reader, struct place place,
                              const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static enum hsr_status refuse(const struct reader *reader, struct place place,
                              const char *format, ...) {
  char text[200];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  return hsr_fail(reader->err, HSR_E_INPUT, "%s: %s%s%s",
                  hsr_json_shown(reader->path), place.text,
                  *place.text ? ": " : "", text);
}

static enum hsr_status wrong_kind(const struct reader *reader,
                                  struct place place, const char *expected,
                                  const json_t *value) {
  return refuse(reader, place, "must be %s, not %s", expected,
                hsr_json_kind(value));
}

/* ": did you mean ...?", or "". */
static void hint_at(const char *const *names, const char *word, char *hint,
                    size_t size) {
  struct hsr_names list = {0};
  bool whole = true; /* there is no hint without memory */
  for (; *names && whole; names++)
    whole = !hsr_names_add(&list, *names, strlen(*names));
  *hint = '\0';
  if (whole)
    hsr_names_like(&list, word, hint, size);
  hsr_names_free(&list);
}

/* --- Values --------------------------------------------------------------- */

/* 0 to 1 becomes 0 to 65535. */
static enum hsr_status read_share(const struct reader *reader,
                                  struct place place, const json_t *value,
                                  uint16_t *to) {
  if (!json_is_number(value))
    return wrong_kind(reader, place, "a number", value);
  double share = json_number_value(value);
  if (!(share >= 0 && share <= 1))
    return refuse(reader, place, "%.9g is not between 0 and 1", share);
  *to = (uint16_t)lrint(ONE * share);
  return HSR_OK;
}

/* In doubles: by srgb.h, which has floats, byte 111 would become 10418, where
 * 10417.4983 is exact. No byte is closer to a half. */
static uint16_t decode(int byte) {
  double encoded = byte / 255.0;
  return (uint16_t)lrint(ONE * (encoded <= 0.04045
                                    ? encoded / 12.92
                                    : pow((encoded + 0.055) / 1.055, 2.4)));
}

/* "#rrggbb". False if the text is anything else. */
static bool parse_colour(const char *text, uint16_t to[3]) {
  if (strlen(text) != 7 || *text != '#' ||
      strspn(text + 1, "0123456789abcdefABCDEF") != 6)
    return false;
  unsigned long rgb = strtoul(text + 1, NULL, 16);
  for (int c = 0; c < 3; c++)
    to[c] = decode((int)(rgb >> (16 - 8 * c) & 255));
  return true;
}

static enum hsr_status read_colour(const struct reader *reader,
                                   struct place place, const json_t *value,
                                   uint16_t to[3]) {
  static const char what[] = "a colour, \"#rrggbb\" or [R, G, B]";
  if (json_is_string(value))
    return parse_colour(json_string_value(value), to)
               ? HSR_OK
               : refuse(reader, place, "must be %s, not '%.40s'", what,
                        json_string_value(value));
  if (!json_is_array(value))
    return wrong_kind(reader, place, what, value);
  if (json_array_size(value) != 3)
    return refuse(reader, place, "must have 3 numbers, not %zu",
                  json_array_size(value));
  enum hsr_status status = HSR_OK;
  for (size_t c = 0; c < 3 && !status; c++)
    status =
        read_share(reader, element(place, c), json_array_get(value, c), &to[c]);
  return status;
}

static enum hsr_status read_whole(const struct reader *reader,
                                  struct place place, const json_t *value,
                                  int least, int most, int *to) {
  if (!json_is_number(value))
    return wrong_kind(reader, place, "a number", value);
  double number = json_number_value(value);
  if (!(number >= least && number <= most) || number != floor(number))
    return refuse(reader, place, "%.9g is no whole number from %d to %d",
                  number, least, most);
  *to = (int)number;
  return HSR_OK;
}

/* --- Control points ------------------------------------------------------- */

typedef enum hsr_status read_value(const struct reader *reader,
                                   struct place place, const json_t *value,
                                   uint16_t *to);

/* As many as there are levels, and one more that ends them. */
struct points {
  struct hsr_palette_point point[HSR_LEVELS + 1];
};

static enum hsr_status read_point(const struct reader *reader,
                                  struct place place, const json_t *value,
                                  int before, read_value *read,
                                  struct hsr_palette_point *point) {
  if (!json_is_array(value))
    return wrong_kind(reader, place, "a pair [LEVEL, VALUE]", value);
  if (json_array_size(value) != 2)
    return refuse(reader, place,
                  "must be a pair [LEVEL, VALUE], not %zu "
                  "values",
                  json_array_size(value));
  struct place level = element(place, 0);
  enum hsr_status status = read_whole(reader, level, json_array_get(value, 0),
                                      0, HSR_LEVELS - 1, &point->level);
  if (!status && point->level <= before)
    return refuse(reader, level, "level %d must be above the one before, %d",
                  point->level, before);
  return status ? status
                : read(reader, element(place, 1), json_array_get(value, 1),
                       point->value);
}

/* If there is a member `key`, *points becomes its points, and *found is set.
 * The last is at level 255. */
static enum hsr_status read_points(const struct reader *reader, const char *key,
                                   read_value *read, struct points *points,
                                   bool *found) {
  const json_t *list = json_object_get(reader->root, key);
  *found = list;
  if (!list)
    return HSR_OK;
  if (!json_is_array(list))
    return wrong_kind(reader, member(key), "an array", list);
  if (!json_array_size(list))
    return refuse(reader, member(key), "must have at least one point");
  /* Levels ascend, and so there are no more points than levels. */
  size_t n = json_array_size(list), k = 0;
  int before = -1;
  enum hsr_status status = HSR_OK;
  for (; k < n && !status; k++) {
    status =
        read_point(reader, element(member(key), k), json_array_get(list, k),
                   before, read, &points->point[k]);
    if (!status)
      before = points->point[k].level;
  }
  if (!status && before < HSR_LEVELS - 1) {
    points->point[k] = points->point[k - 1];
    points->point[k].level = HSR_LEVELS - 1;
  }
  return status;
}

/* A table of one number a level; it is kept if there is no such member. */
static enum hsr_status read_table(const struct reader *reader, const char *key,
                                  uint16_t table[HSR_LEVELS]) {
  struct points points;
  bool found;
  enum hsr_status status =
      read_points(reader, key, read_share, &points, &found);
  for (int k = 0; k < HSR_LEVELS && found && !status; k++)
    table[k] = hsr_palette_at(points.point, k, 0);
  return status;
}

static enum hsr_status read_colours(const struct reader *reader,
                                    struct hsr_palette *palette) {
  struct points points;
  bool found;
  enum hsr_status status =
      read_points(reader, "colour", read_colour, &points, &found);
  if (status || !found)
    return status;
  palette->own_colours = false;
  for (int k = 0; k < HSR_LEVELS; k++)
    for (int c = 0; c < 3; c++)
      palette->rgb[k][c] = hsr_palette_at(points.point, k, c);
  return HSR_OK;
}

/* --- Light ---------------------------------------------------------------- */

/* About 1024 long. False if it is nowhere. */
static bool set_direction(const double v[3], int16_t light[3]) {
  double most = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
  if (!(most > 0))
    return false;
  double x = v[0] / most, y = v[1] / most, z = v[2] / most;
  double length = sqrt(x * x + y * y + z * z);
  light[0] = (int16_t)lrint(LIGHT_LENGTH * x / length);
  light[1] = (int16_t)lrint(LIGHT_LENGTH * y / length);
  light[2] = (int16_t)lrint(LIGHT_LENGTH * z / length);
  return true;
}

static enum hsr_status read_light(const struct reader *reader,
                                  struct hsr_palette *palette) {
  static const char what[] = "\"eye\" or a direction [X, Y, Z]";
  const json_t *light = json_object_get(reader->root, "light");
  struct place place = member("light");
  double v[3];
  if (!light)
    return HSR_OK;
  if (json_is_string(light) && !strcmp(json_string_value(light), "eye"))
    return HSR_OK;
  if (json_is_string(light))
    return refuse(reader, place, "must be %s, not '%.40s'", what,
                  json_string_value(light));
  if (!json_is_array(light))
    return wrong_kind(reader, place, what, light);
  if (json_array_size(light) != 3)
    return refuse(reader, place, "must have 3 numbers, not %zu",
                  json_array_size(light));
  for (size_t a = 0; a < 3; a++) {
    const json_t *number = json_array_get(light, a);
    if (!json_is_number(number))
      return wrong_kind(reader, element(place, a), "a number", number);
    v[a] = json_number_value(number);
  }
  palette->eye_light = false;
  return set_direction(v, palette->light)
             ? HSR_OK
             : refuse(reader, place, "0, 0, 0 is no direction");
}

static enum hsr_status read_strengths(const struct reader *reader,
                                      struct hsr_palette *palette) {
  const struct {
    const char *key;
    uint16_t *to;
  } all[] = {{"ambient", &palette->ambient},
             {"diffuse", &palette->diffuse},
             {"specular", &palette->specular}};
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < sizeof all / sizeof *all && !status; k++) {
    const json_t *value = json_object_get(reader->root, all[k].key);
    if (value)
      status = read_share(reader, member(all[k].key), value, all[k].to);
  }
  const json_t *exponent = json_object_get(reader->root, "exponent");
  if (exponent && !status)
    status = read_whole(reader, member("exponent"), exponent, 1, MOST_EXPONENT,
                        &palette->exponent);
  return status;
}

/* --- The whole file ------------------------------------------------------- */

static enum hsr_status check_keys(const struct reader *reader) {
  static const char *const known[] = {
      "schema",  "opacity", "colour",   "gradient", "own_colours", "light",
      "ambient", "diffuse", "specular", "exponent", NULL};
  for (void *i = json_object_iter(reader->root); i;
       i = json_object_iter_next(reader->root, i)) {
    const char *key = json_object_iter_key(i);
    const char *const *k = known;
    while (*k && strcmp(*k, key))
      k++;
    char hint[100];
    if (*k)
      continue;
    hint_at(known, key, hint, sizeof hint);
    return refuse(reader, member(key), "unknown key%s", hint);
  }
  return HSR_OK;
}

static enum hsr_status check_schema(const struct reader *reader) {
  struct place outermost = {""};
  if (!json_is_object(reader->root))
    return wrong_kind(reader, outermost, "an object", reader->root);
  const json_t *schema = json_object_get(reader->root, "schema");
  if (!schema)
    return refuse(reader, outermost, "'schema' is missing");
  if (!json_is_string(schema))
    return wrong_kind(reader, member("schema"), "a string", schema);
  return strcmp(json_string_value(schema), SCHEMA)
             ? refuse(reader, member("schema"), "must be '%s', not '%.60s'",
                      SCHEMA, json_string_value(schema))
             : HSR_OK;
}

static enum hsr_status read_own_colours(const struct reader *reader,
                                        struct hsr_palette *palette) {
  const json_t *own = json_object_get(reader->root, "own_colours");
  if (own && !json_is_boolean(own))
    return wrong_kind(reader, member("own_colours"), "true or false", own);
  if (own)
    palette->own_colours = json_is_true(own);
  return HSR_OK;
}

/* What a file without members says. */
static struct hsr_palette standard(void) {
  struct hsr_palette palette;
  hsr_palette_find("flat", &palette);
  palette.ambient = palette.specular = ONE / 5;
  palette.diffuse = ONE - ONE / 5;
  palette.exponent = 16;
  return palette;
}

static enum hsr_status read_palette(const struct reader *reader,
                                    struct hsr_palette *palette) {
  enum hsr_status status = check_schema(reader);
  if (!status)
    status = check_keys(reader);
  if (!status)
    status = read_table(reader, "opacity", palette->opacity);
  if (!status)
    status = read_colours(reader, palette);
  if (!status)
    status = read_table(reader, "gradient", palette->gradient);
  if (!status)
    status = read_own_colours(reader, palette);
  if (!status)
    status = read_light(reader, palette);
  return status ? status : read_strengths(reader, palette);
}

enum hsr_status hsr_palette_json_read(const char *path,
                                      struct hsr_palette *palette,
                                      struct hsr_error *err) {
  struct reader reader = {path, NULL, err};
  struct hsr_palette read = standard();
  char *text = NULL;
  size_t length = 0;
  bool out_of_memory = false;
  json_error_t error;
  enum hsr_status status = hsr_json_load(path, &text, &length, err);
  if (!status) {
    reader.root = hsr_json_read_text(
        text, length,
        JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL | JSON_DECODE_ANY,
        &out_of_memory, &error);
    status = out_of_memory ? hsr_fail_nomem(err)
             : reader.root
                 ? read_palette(&reader, &read)
                 : hsr_fail(err, HSR_E_INPUT, "%s:%d: %s", hsr_json_shown(path),
                            error.line, error.text);
  }
  json_decref(reader.root);
  free(text);
  if (!status)
    *palette = read;
  return status;
}

enum hsr_status hsr_palette_open(const char *name, struct hsr_palette *palette,
                                 struct hsr_error *err) {
  static const char suffix[] = ".json";
  enum { MOST_NAMES = 32 };
  size_t n = strlen(name), k = sizeof suffix - 1;
  if (n > k && !strcmp(name + n - k, suffix))
    return hsr_palette_json_read(name, palette, err);
  if (hsr_palette_find(name, palette))
    return HSR_OK;
  const char *names[MOST_NAMES] = {NULL};
  char hint[200];
  for (k = 0; hsr_palette_names[k].name && k + 1 < MOST_NAMES; k++)
    names[k] = hsr_palette_names[k].name;
  hint_at(names, name, hint, sizeof hint);
  return hsr_fail(err, HSR_E_USAGE, "there is no palette '%.100s'%s", name,
                  *hint ? hint
                        : " (see hsr list; the name of a file ends in .json)");
}
