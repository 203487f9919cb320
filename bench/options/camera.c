/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/options/camera.h"
#include "bench/options/words.h"
#include "common/files/json/palette_json.h"
#include "common/files/json/scene_json.h"
#include "common/view/standard.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const char *const camera_keys[CAMERA_WORDS] = {
    "eye", "at", "up", "fov", "near", "parallel", "light", "sun", "up-axis"};
enum { FOV = 3, PARALLEL = 5, LIGHT, SUN, AXIS };

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
  int look = key - CAMERA_LOOK;
  if (look >= 0 && look < HSR_STANDARD_VIEWS) {
    const char *name = hsr_standard_views[look];
    if (o->look && strcmp(o->look, name) != 0)
      return option_fail(base, "--%s and --%s: one standard view", o->look,
                         name);
    o->look = name;
    return 0;
  }
  int k = key - CAMERA_EYE;
  if (k < 0 || k >= CAMERA_WORDS)
    return ARGP_ERR_UNKNOWN;
  if (k == AXIS && (arg[0] < 'x' || arg[0] > 'z' || arg[1]))
    return option_fail(base, "--up-axis %s: must be x, y or z", arg);
  double number[3];
  bool is_fit = k == PARALLEL && (!strcmp(arg, "fit") || !strcmp(arg, "same"));
  bool is_point = k < CAMERA_PLACES || k >= LIGHT;
  if (!is_fit && k != AXIS &&
      (is_point ? !parse_point(arg, number) : !parse_number(arg, number)))
    return option_fail(base, "--%s %s: must be %s", camera_keys[k], arg,
                       is_point        ? "a point, X,Y,Z"
                       : k == PARALLEL ? "a number, fit or same"
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
  return o->look || has_any(o, CAMERA_WORDS);
}

bool names_a_place(const struct camera_options *o) {
  return o->look || has_any(o, CAMERA_PLACES);
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

/* What a standard view excludes. */
static enum hsr_status check_look(const struct camera_options *o, long view,
                                  struct hsr_error *err) {
  if (!o->look)
    return HSR_OK;
  const char *other = o->file ? "camera" : view > 1 ? "view" : NULL;
  for (int k = 0; k <= FOV; k++)
    if (o->word[k])
      other = camera_keys[k];
  if (o->word[PARALLEL] && !strcmp(o->word[PARALLEL], "same"))
    other = "parallel same";
  return other ? hsr_fail(err, HSR_E_USAGE,
                          "--%s is a whole view; --%s does not go with it",
                          o->look, other)
               : HSR_OK;
}

/* A name in the making. */
struct name {
  char *text;
  size_t n;     /* its length; MOST_AIMED_NAME or more: it is too long */
  char between; /* what stands before the next word */
};

static void add(struct name *name, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void add(struct name *name, const char *format, ...) {
  va_list args;
  va_start(args, format);
  if (name->n < MOST_AIMED_NAME)
    name->n += (size_t)vsnprintf(name->text + name->n,
                                 MOST_AIMED_NAME - name->n, format, args);
  va_end(args);
}

static void add_word(struct name *name, const char *key, const char *value) {
  add(name, "%c%s=%s", name->between, key, value);
  name->between = ':';
}

static int common_divisor(int m, int n) {
  return n ? common_divisor(n, m % n) : m;
}

/* --parallel, or what a standard view has without it. */
static void add_parallel(struct name *name, const struct camera_options *o,
                         int m, int n) {
  const char *value = o->word[PARALLEL] ? o->word[PARALLEL] : "fit";
  char fit[40];
  if (!strcmp(value, "fit")) {
    const int d = common_divisor(m, n);
    snprintf(fit, sizeof fit, "fit-%dx%d", m / d, n / d);
    value = fit;
  }
  add_word(name, camera_keys[PARALLEL], value);
}

/* The standard view and the axis come before all others. */
static void add_words(struct name *name, const struct camera_options *o, int m,
                      int n) {
  if (o->look)
    add_word(name, "look", o->look);
  for (int place = 0; place < CAMERA_WORDS; place++) {
    const int k = place ? place - 1 : AXIS;
    if (k == PARALLEL && (o->word[k] || o->look))
      add_parallel(name, o, m, n);
    else if (o->word[k])
      add_word(name, camera_keys[k], o->word[k]);
  }
}

enum hsr_status aim_name(const struct camera_options *o, long view, int m,
                         int n, const char *scene, char aimed[MOST_AIMED_NAME],
                         struct hsr_error *err) {
  struct name name = {.text = aimed, .between = '@'};
  enum hsr_status status = check_look(o, view, err);
  if (!status && o->palette)
    status = check_palette(o->palette, err);
  if (status)
    return status;
  add(&name, "%s%s%s", scene, o->file ? "@" : "", o->file ? o->file : "");
  if (view > 1 && has_camera_words(o)) {
    add(&name, "@view=%ld", view);
    name.between = ':';
  }
  add_words(&name, o, m, n);
  if (o->palette)
    add(&name, "@palette=%s", o->palette);
  return name.n < MOST_AIMED_NAME
             ? HSR_OK
             : hsr_fail(err, HSR_E_USAGE,
                        "%.100s...: the name is longer than %d bytes", scene,
                        MOST_AIMED_NAME - 1);
}
