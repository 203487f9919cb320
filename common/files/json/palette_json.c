/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/json/palette_json.h"

#include "common/base/names.h"
#include "common/files/json/json_members.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char SCHEMA[] = "hsr-palette/1";

enum { ONE = 65535, LIGHT_LENGTH = 1024, MOST_EXPONENT = 128 };

/* --- Values --------------------------------------------------------------- */

/* 0 to 1 becomes 0 to 65535. */
static enum hsr_status take_share(const struct hsr_json_node *at, void *to) {
  double share = 0;
  enum hsr_status status = hsr_json_share(at, &share);
  if (!status)
    *(uint16_t *)to = (uint16_t)lrint(ONE * share);
  return status;
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

static enum hsr_status take_colour(const struct hsr_json_node *at, void *to) {
  static const char what[] = "a colour, \"#rrggbb\" or [R, G, B]";
  uint16_t *rgb = to;
  double share[3];
  const char *text = json_string_value(at->value);
  if (text)
    return parse_colour(text, rgb)
               ? HSR_OK
               : hsr_json_refuse(at, "must be %s, not '%.40s'", what, text);
  if (!json_is_array(at->value))
    return hsr_json_wrong_kind(at, what);
  enum hsr_status status = hsr_json_numbers(at, 3, hsr_json_share, share);
  for (int c = 0; c < 3 && !status; c++)
    rgb[c] = (uint16_t)lrint(ONE * share[c]);
  return status;
}

static enum hsr_status take_exponent(const struct hsr_json_node *at, void *to) {
  return hsr_json_whole(at, 1, MOST_EXPONENT, to);
}

/* --- Tables of control points --------------------------------------------- */

/* As many as there are levels, and one more that ends them. */
struct points {
  hsr_json_take *take; /* reads the value of a point */
  struct hsr_palette_point point[HSR_LEVELS + 1];
};

/* Levels ascend, and so there are no more points than levels. */
static enum hsr_status take_point(const struct hsr_json_node *at, void *to) {
  struct points *points = to;
  struct hsr_palette_point *point = &points->point[at->index];
  const int before = at->index ? point[-1].level : -1;
  if (!json_is_array(at->value))
    return hsr_json_wrong_kind(at, "a pair [LEVEL, VALUE]");
  if (json_array_size(at->value) != 2)
    return hsr_json_refuse(at, "must be a pair [LEVEL, VALUE], not %zu values",
                           json_array_size(at->value));
  const struct hsr_json_node level = hsr_json_element(at, 0);
  const struct hsr_json_node value = hsr_json_element(at, 1);
  enum hsr_status status =
      hsr_json_whole(&level, 0, HSR_LEVELS - 1, &point->level);
  if (!status && point->level <= before)
    return hsr_json_refuse(&level, "level %d must be above the one before, %d",
                           point->level, before);
  return status ? status : points->take(&value, point->value);
}

/* The last point is at level 255. */
static enum hsr_status read_points(const struct hsr_json_node *at,
                                   struct points *points) {
  size_t n = json_array_size(at->value);
  if (json_is_array(at->value) && !n)
    return hsr_json_refuse(at, "must have at least one point");
  enum hsr_status status = hsr_json_elements(at, take_point, points);
  if (!status && points->point[n - 1].level < HSR_LEVELS - 1) {
    points->point[n] = points->point[n - 1];
    points->point[n].level = HSR_LEVELS - 1;
  }
  return status;
}

/* A table of one number a level. */
static enum hsr_status take_table(const struct hsr_json_node *at, void *to) {
  uint16_t *table = to;
  struct points points = {.take = take_share};
  enum hsr_status status = read_points(at, &points);
  for (int k = 0; k < HSR_LEVELS && !status; k++)
    table[k] = hsr_palette_at(points.point, k, 0);
  return status;
}

static enum hsr_status take_colours(const struct hsr_json_node *at, void *to) {
  struct hsr_palette *palette = to;
  struct points points = {.take = take_colour};
  enum hsr_status status = read_points(at, &points);
  if (status)
    return status;
  palette->own_colours = false;
  for (int k = 0; k < HSR_LEVELS; k++)
    for (int c = 0; c < 3; c++)
      palette->rgb[k][c] = hsr_palette_at(points.point, k, c);
  return HSR_OK;
}

/* --- The window ----------------------------------------------------------- */

static enum hsr_status take_window(const struct hsr_json_node *at, void *to) {
  struct hsr_palette *palette = to;
  enum hsr_status status =
      hsr_json_numbers(at, 2, hsr_json_number, palette->window);
  if (!status && !(palette->window[0] < palette->window[1]))
    return hsr_json_refuse(at, "the density of level 0 must be below that of "
                               "level 255");
  palette->has_window = !status;
  return status;
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

static enum hsr_status take_light(const struct hsr_json_node *at, void *to) {
  static const char what[] = "\"eye\" or a direction [X, Y, Z]";
  struct hsr_palette *palette = to;
  const char *text = json_string_value(at->value);
  double v[3];
  if (text)
    return !strcmp(text, "eye")
               ? HSR_OK
               : hsr_json_refuse(at, "must be %s, not '%.40s'", what, text);
  if (!json_is_array(at->value))
    return hsr_json_wrong_kind(at, what);
  enum hsr_status status = hsr_json_point(at, v);
  palette->eye_light = false;
  return status || set_direction(v, palette->light)
             ? status
             : hsr_json_refuse(at, "0, 0, 0 is no direction");
}

/* --- The whole file ------------------------------------------------------- */

/* What a file without members says. */
static struct hsr_palette standard(void) {
  struct hsr_palette palette;
  hsr_palette_find("flat", &palette);
  palette.ambient = palette.specular = ONE / 5;
  palette.diffuse = ONE - ONE / 5;
  palette.exponent = 16;
  return palette;
}

static enum hsr_status read_palette(const struct hsr_json_node *root,
                                    struct hsr_palette *palette) {
  const struct hsr_json_rule rules[] = {
      {"schema"},
      {"window", take_window, palette},
      {"opacity", take_table, palette->opacity},
      {"colour", take_colours, palette},
      {"gradient", take_table, palette->gradient},
      {"own_colours", hsr_json_bool, &palette->own_colours},
      {"light", take_light, palette},
      {"ambient", take_share, &palette->ambient},
      {"diffuse", take_share, &palette->diffuse},
      {"specular", take_share, &palette->specular},
      {"exponent", take_exponent, &palette->exponent},
      {0}};
  enum hsr_status status = hsr_json_check_schema(root, SCHEMA);
  return status ? status : hsr_json_object(root, rules);
}

enum hsr_status hsr_palette_json_read(const char *path,
                                      struct hsr_palette *palette,
                                      struct hsr_error *err) {
  static const hsr_json_levels whole = NULL;
  const struct hsr_json_input input = {path, NULL, err};
  struct hsr_json_node root = {.input = &input};
  struct hsr_palette read = standard();
  char *text = NULL;
  enum hsr_status status =
      hsr_json_open(&input, &whole, NULL, &text, &root.value);
  if (!status)
    status = read_palette(&root, &read);
  json_decref(root.value);
  free(text);
  if (!status)
    *palette = read;
  return status;
}

enum hsr_status hsr_palette_open(const char *name, struct hsr_palette *palette,
                                 struct hsr_error *err) {
  static const char suffix[] = ".json";
  size_t n = strlen(name), k = sizeof suffix - 1;
  if (n > k && !strcmp(name + n - k, suffix))
    return hsr_palette_json_read(name, palette, err);
  if (hsr_palette_find(name, palette))
    return HSR_OK;
  char hint[200] = "";
  hsr_names_like_of(hsr_palette_names, sizeof *hsr_palette_names, name, hint,
                    sizeof hint);
  return hsr_fail(err, HSR_E_USAGE, "there is no palette '%.100s'%s", name,
                  *hint ? hint
                        : " (see hsr list; the name of a file ends in .json)");
}
