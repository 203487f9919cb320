/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/options/camera.h"
#include "bench/options/words.h"
#include "common/files/json/palette_json.h"
#include "common/files/json/scene_json.h"

#include <stdio.h>
#include <string.h>

static const char *const camera_keys[CAMERA_WORDS] = {
    "eye", "at", "up", "fov", "near", "parallel", "light", "sun", "up-axis"};
enum { PARALLEL = 5, LIGHT, SUN, AXIS };

error_t parse_camera_option(struct camera_options *o, int key, char *arg,
                            struct option_base *base) {
  if (key == CAMERA_FILE) {
    o->file = arg;
    return 0;
  }
  if (key == PALETTE) {
    o->palette = arg;
    return 0;
  }
  int k = key - CAMERA_EYE;
  if (k < 0 || k >= CAMERA_WORDS)
    return ARGP_ERR_UNKNOWN;
  if (k == AXIS && (arg[0] < 'x' || arg[0] > 'z' || arg[1]))
    return option_fail(base, "--up-axis %s: must be x, y or z", arg);
  double number[3];
  bool is_fit = k == PARALLEL && !strcmp(arg, "fit");
  bool is_point = k < CAMERA_PLACES || k >= LIGHT;
  if (!is_fit && k != AXIS &&
      (is_point ? !parse_point(arg, number) : !parse_number(arg, number)))
    return option_fail(base, "--%s %s: must be %s", camera_keys[k], arg,
                       is_point        ? "a point, X,Y,Z"
                       : k == PARALLEL ? "a number, or fit"
                                       : "a number");
  o->word[k] = arg;
  return 0;
}

const char *light_option(const struct camera_options *o) {
  return o->word[LIGHT] ? "--light" : o->word[SUN] ? "--sun" : NULL;
}

static bool has_any(const struct camera_options *o, int n) {
  for (int k = 0; k < n; k++)
    if (o->word[k])
      return true;
  return false;
}

bool has_camera_words(const struct camera_options *o) {
  return has_any(o, CAMERA_WORDS);
}

bool names_a_place(const struct camera_options *o) {
  return has_any(o, CAMERA_PLACES);
}

enum hsr_status count_views(const struct camera_options *o, long standard,
                            long most, long *n, struct hsr_error *err) {
  *n = names_a_place(o) ? 1 : standard;
  if (!o->file || names_a_place(o))
    return HSR_OK;
  struct hsr_scene *scene = hsr_scene_new("");
  if (!scene)
    return hsr_fail_nomem(err);
  enum hsr_status status = hsr_cameras_json_read(scene, o->file, err);
  *n = scene->n_views < most ? (long)scene->n_views : most;
  hsr_scene_delete(scene);
  return status;
}

/* Whether the palette can be had, before a scene is opened, which may take
 * long. */
static enum hsr_status check_palette(const char *name, struct hsr_error *err) {
  struct hsr_palette palette;
  if (strchr(name, '@'))
    return hsr_fail(err, HSR_E_USAGE,
                    "--palette %.200s: must be without an '@', which divides "
                    "the names of scenes",
                    name);
  return hsr_palette_open(name, &palette, err);
}

enum hsr_status aim_name(const struct camera_options *o, long view,
                         const char *scene, char aimed[MOST_AIMED_NAME],
                         struct hsr_error *err) {
  size_t size = MOST_AIMED_NAME;
  enum hsr_status status = o->palette ? check_palette(o->palette, err) : HSR_OK;
  if (status)
    return status;
  size_t n = (size_t)snprintf(aimed, size, "%s%s%s", scene, o->file ? "@" : "",
                              o->file ? o->file : "");
  char between = '@';
  if (view > 1 && has_camera_words(o) && n < size) {
    n += (size_t)snprintf(aimed + n, size - n, "@view=%ld", view);
    between = ':';
  }
  for (int place = 0; place < CAMERA_WORDS && n < size; place++) {
    int k = place ? place - 1 : AXIS; /* the axis comes before all others */
    if (!o->word[k])
      continue;
    n += (size_t)snprintf(aimed + n, size - n, "%c%s=%s", between,
                          camera_keys[k], o->word[k]);
    between = ':';
  }
  if (o->palette && n < size)
    n += (size_t)snprintf(aimed + n, size - n, "@palette=%s", o->palette);
  return n < size ? HSR_OK
                  : hsr_fail(err, HSR_E_USAGE,
                             "%.100s...: the name is longer than %d bytes",
                             scene, MOST_AIMED_NAME - 1);
}
