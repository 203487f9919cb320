/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif

#include "scenes/cameras.h"

#include "common/files/json/palette_json.h"
#include "common/files/json/scene_json.h"
#include "common/grids/grid.h"
#include "common/view/standard.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const struct {
  const char *key;
  size_t place; /* in a struct hsr_camera */
  int n;        /* how many numbers */
} words[] = {{"eye", offsetof(struct hsr_camera, eye), 3},
             {"at", offsetof(struct hsr_camera, at), 3},
             {"up", offsetof(struct hsr_camera, up), 3},
             {"fov", offsetof(struct hsr_camera, fov), 1},
             {"near", offsetof(struct hsr_camera, near), 1},
             {"parallel", offsetof(struct hsr_camera, parallel), 1},
             {"light", offsetof(struct hsr_camera, light), 3},
             {"sun", offsetof(struct hsr_camera, light), 3}};
enum {
  N_WORDS = sizeof words / sizeof *words,
  N_PLACES = 3,
  FOV = 3,
  LIGHT = 6,
  SUN
};

static const char PALETTE[] = "palette", AXIS[] = "up-axis", LOOK[] = "look";

static bool is_file(const char *name, size_t n) {
  char *path = strndup(name, n);
  bool found = path && !access(path, F_OK);
  free(path);
  return found;
}

size_t hsr_name_before_cameras(const char *name) {
  size_t n = strlen(name);
  while (n && !is_file(name, n))
    for (n--; n && name[n] != '@'; n--)
      ;
  return n ? n : strcspn(name, "@");
}

/* --- Words ---------------------------------------------------------------- */

/* n numbers with commas between them, and nothing else. */
static bool read_numbers(const char *text, size_t length, int n, double *to) {
  const char *last = text + length;
  for (int k = 0; k < n; k++) {
    char *end;
    to[k] = strtod(text, &end);
    if (end == text || end > last || !isfinite(to[k]) ||
        (k < n - 1 ? *end != ',' : end != last))
      return false;
    text = end + 1;
  }
  return true;
}

static bool is_key(const char *word, const char *key) {
  size_t n = strlen(key);
  return !strncmp(word, key, n) && word[n] == '=';
}

/* A camera while words change it. */
struct aim {
  const struct hsr_scene *scene;
  struct hsr_camera *camera;
  char look[16]; /* the standard view; "": none */
};

/* The height at which, around the point `at`, as much is seen as in
 * perspective. */
static double fitting_height(const struct hsr_camera *c) {
  const double degree = 3.14159265358979323846 / 180;
  double distance = hypot(hypot(c->at[0] - c->eye[0], c->at[1] - c->eye[1]),
                          c->at[2] - c->eye[2]);
  return 2 * tan(c->fov / 2 * degree) * distance;
}

/* Turns what stands on the y axis so that it stands on another. */
static void turn_to_axis(int axis, double v[3]) {
  double x = v[0], y = v[1], z = v[2];
  v[0] = axis ? x : y;
  v[1] = 0 - (axis ? z : x); /* never -0 */
  v[2] = axis ? y : z;
}

/* up-axis=z: a view that stands on the y axis, as those that are made up do, is
 * turned about its point `at`. One that stands on the axis stays. A standard view
 * is taken once more. */
static enum hsr_status stand_on(const char *word, size_t length,
                                struct aim *aim, struct hsr_error *err) {
  struct hsr_camera *c = aim->camera;
  const double *up = c->up;
  int axis = length == 1 ? *word - 'x' : -1, l = (axis + 1) % 3,
      m = (axis + 2) % 3;
  double from[3];
  if (axis < 0 || axis > 2)
    return hsr_fail(err, HSR_E_USAGE, "up-axis: '%.*s' must be x, y or z",
                    (int)length, word);
  if (*aim->look)
    return hsr_standard_view(aim->scene, aim->look, axis, c, err);
  if (up[axis] > 0 && up[l] == 0 && up[m] == 0)
    return HSR_OK;
  if (!(up[0] == 0 && up[1] > 0 && up[2] == 0))
    return hsr_fail(err, HSR_E_USAGE,
                    "up-axis: the view stands on no axis; up=X,Y,Z tells what "
                    "is up");
  for (int k = 0; k < 3; k++)
    from[k] = c->eye[k] - c->at[k];
  turn_to_axis(axis, from);
  turn_to_axis(axis, c->up);
  for (int k = 0; k < 3; k++)
    c->eye[k] = c->at[k] + from[k];
  return HSR_OK;
}

/* look=front */
static enum hsr_status look(const char *word, size_t length, struct aim *aim,
                            struct hsr_error *err) {
  snprintf(aim->look, sizeof aim->look, "%.*s", (int)length, word);
  return hsr_standard_view(aim->scene, aim->look, -1, aim->camera, err);
}

/* parallel=fit, of a square picture, or parallel=fit-MxN. */
static enum hsr_status fit(const char *word, size_t length,
                           const struct aim *aim, struct hsr_error *err) {
  char shape[32] = "1x1";
  int m = 0, n = 0, end = -1;
  if (length > 3)
    snprintf(shape, sizeof shape, "%.*s", (int)(length - 4), word + 4);
  if ((length == 3 || word[3] == '-') &&
      sscanf(shape, "%6dx%6d%n", &m, &n, &end) == 2 && m > 0 && n > 0 &&
      !shape[end])
    return hsr_camera_fit(aim->scene, m, n, aim->camera, err);
  return hsr_fail(err, HSR_E_USAGE,
                  "parallel: '%.*s' must be fit, or fit-MxN for a picture of "
                  "M x N samples",
                  (int)length, word);
}

/* parallel=same, or fit */
static enum hsr_status size_word(const char *word, size_t length,
                                 const struct aim *aim, struct hsr_error *err) {
  if (*word == 'f')
    return fit(word, length, aim, err);
  aim->camera->parallel = fitting_height(aim->camera);
  return HSR_OK;
}

static bool begins(const char *word, size_t length, const char *with) {
  const size_t n = strlen(with);
  return length >= n && !strncmp(word, with, n);
}

static enum hsr_status read_word(const char *word, size_t length,
                                 struct aim *aim, struct hsr_error *err) {
  static const char SAME[] = "parallel=same", FIT[] = "parallel=fit";
  const size_t parallel = strlen("parallel=");
  struct hsr_camera *camera = aim->camera;
  if (begins(word, length, FIT) ||
      (length == sizeof SAME - 1 && begins(word, length, SAME)))
    return size_word(word + parallel, length - parallel, aim, err);
  if (is_key(word, AXIS))
    return stand_on(word + sizeof AXIS, length - sizeof AXIS, aim, err);
  if (is_key(word, LOOK))
    return look(word + sizeof LOOK, length - sizeof LOOK, aim, err);
  for (int k = 0; k < N_WORDS; k++) {
    if (!is_key(word, words[k].key))
      continue;
    size_t key = strlen(words[k].key) + 1;
    double number[3];
    if (!read_numbers(word + key, length - key, words[k].n, number))
      return hsr_fail(err, HSR_E_USAGE, "%s: '%.*s' must be %s", words[k].key,
                      (int)(length - key), word + key,
                      words[k].n == 3 ? "a point, X,Y,Z" : "a number");
    memcpy((char *)camera + words[k].place, number,
           (size_t)words[k].n * sizeof *number);
    if (k == FOV)
      camera->parallel = 0;
    if (k == LIGHT || k == SUN)
      camera->light[3] = k == LIGHT;
    return HSR_OK;
  }
  return hsr_fail(err, HSR_E_USAGE,
                  "'%.*s' says nothing of a camera: view=K, look=NAME, "
                  "up-axis=A, eye=X,Y,Z, at=X,Y,Z, up=X,Y,Z, fov=DEG, near=T, "
                  "parallel=HEIGHT, light=X,Y,Z or sun=X,Y,Z",
                  (int)length, word);
}

/* view=K, which may stand first: the number from 0. */
static enum hsr_status choose_view(const struct hsr_scene *scene,
                                   const char *word, size_t length,
                                   uint32_t *view, struct hsr_error *err) {
  char *end;
  unsigned long number = strtoul(word, &end, 10);
  if (*word < '0' || *word > '9' || end != word + length || !number)
    return hsr_fail(err, HSR_E_USAGE, "view: '%.*s' must be a number from 1",
                    (int)length, word);
  if (number > scene->n_views)
    return hsr_fail(err, HSR_E_USAGE, "%s has %u views; there is no view %.*s",
                    scene->name, scene->n_views, (int)length, word);
  *view = (uint32_t)(number - 1);
  return HSR_OK;
}

/* Changes a camera as the words from text on say. */
static enum hsr_status read_words(const char *text, const char *last,
                                  const struct hsr_scene *scene,
                                  struct hsr_camera *camera,
                                  struct hsr_error *err) {
  struct aim aim = {.scene = scene, .camera = camera};
  enum hsr_status status = HSR_OK;
  while (text < last && !status) {
    text += *text == ':';
    size_t n = strcspn(text, ":@");
    status = read_word(text, n, &aim, err);
    text += n;
  }
  struct hsr_error why;
  if (!status && hsr_camera_check(camera, &why))
    return hsr_fail(err, HSR_E_USAGE, "%s", why.text);
  return status;
}

/* Whether a word says where one looks from, to, or what is up. */
static bool name_a_place(const char *text, const char *last) {
  for (; text < last; text += strcspn(text, ":@")) {
    text += *text == ':';
    if (is_key(text, LOOK))
      return true;
    for (int k = 0; k < N_PLACES; k++)
      if (is_key(text, words[k].key))
        return true;
  }
  return false;
}

static enum hsr_status aim_by_words(struct hsr_scene *scene, const char *text,
                                    size_t length, struct hsr_error *err) {
  const char *last = text + length;
  uint32_t view = 0;
  enum hsr_status status = HSR_OK;
  bool is_one = name_a_place(text, last);
  if (is_key(text, "view")) {
    size_t n = strcspn(text, ":@");
    status = choose_view(scene, text + 5, n - 5, &view, err);
    text += n;
    is_one = true;
  }
  if (is_one && !status) {
    scene->views[0] = scene->views[view];
    scene->n_views = 1;
  }
  for (uint32_t k = 0; k < scene->n_views && !status; k++)
    status = read_words(text, last, scene, &scene->views[k], err);
  return status;
}

/* --- Files ---------------------------------------------------------------- */

static enum hsr_status aim_by_file(struct hsr_scene *scene, const char *text,
                                   size_t length, struct hsr_error *err) {
  char *path = strndup(text, length);
  if (!path)
    return hsr_fail_nomem(err);
  scene->n_views = 0;
  enum hsr_status status = hsr_cameras_json_read(scene, path, err);
  free(path);
  return status;
}

/* --- Palettes ------------------------------------------------------------- */

static enum hsr_status open_palette(const char *text, size_t length,
                                    struct hsr_palette *palette,
                                    struct hsr_error *err) {
  char *name = strndup(text, length);
  enum hsr_status status =
      name ? hsr_palette_open(name, palette, err) : hsr_fail_nomem(err);
  free(name);
  return status;
}

static enum hsr_status choose_palette(struct hsr_scene *scene, const char *text,
                                      size_t length, struct hsr_error *err) {
  if (!scene->grid)
    return hsr_fail(err, HSR_E_USAGE,
                    "%.200s: is no grid, and only the splats of grids have a "
                    "palette",
                    scene->name);
  enum hsr_status status =
      open_palette(text, length, &scene->grid->palette, err);
  if (!status && scene->grid->palette.has_window && !scene->grid->densities)
    return hsr_fail(err, HSR_E_USAGE,
                    "%.200s: its samples have no densities, and the palette "
                    "has a window of them",
                    scene->name);
  return status;
}

/* A palette of a file may have a window, which the densities of a volume are
 * levelled by while it is read. */
enum hsr_status hsr_scene_expect(struct hsr_scene *scene, const char *cameras,
                                 struct hsr_error *err) {
  struct hsr_palette palette = {.has_window = false};
  enum hsr_status status = HSR_OK;
  while (*cameras && !status) {
    const char *text = cameras + 1;
    size_t n = strcspn(text, "@");
    if (is_key(text, PALETTE))
      status = open_palette(text + sizeof PALETTE, n - sizeof PALETTE, &palette,
                            err);
    cameras = text + n;
  }
  if (!status && palette.has_window)
    memcpy(scene->window, palette.window, sizeof scene->window);
  return status;
}

static bool has_words(const char *text) {
  bool found = is_key(text, "view") || is_key(text, AXIS) || is_key(text, LOOK);
  for (int k = 0; k < N_WORDS; k++)
    found |= is_key(text, words[k].key);
  return found;
}

bool hsr_cameras_need_scene(const char *cameras) {
  return strstr(cameras, "look=") || strstr(cameras, "parallel=fit");
}

enum hsr_status hsr_scene_aim(struct hsr_scene *scene, const char *cameras,
                              struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  while (*cameras && !status) {
    const char *text = cameras + 1; /* after the '@' */
    size_t n = strcspn(text, "@");
    status = is_key(text, PALETTE)
                 ? choose_palette(scene, text + sizeof PALETTE,
                                  n - sizeof PALETTE, err)
             : has_words(text) ? aim_by_words(scene, text, n, err)
                               : aim_by_file(scene, text, n, err);
    cameras = text + n;
  }
  return status;
}

/* --- Turns ---------------------------------------------------------------- */

/* Turns the eye by an angle, in radians, about the line through `at` along `up`:
 * Rodrigues' formula. */
static struct hsr_camera turned(const struct hsr_camera *from, double angle) {
  struct hsr_camera camera = *from;
  double length = hypot(hypot(from->up[0], from->up[1]), from->up[2]);
  double d[3], axis[3], along = 0;
  for (int k = 0; k < 3; k++) {
    d[k] = from->eye[k] - from->at[k];
    axis[k] = from->up[k] / length;
    along += axis[k] * d[k];
  }
  for (int k = 0; k < 3; k++) {
    int l = (k + 1) % 3, m = (k + 2) % 3;
    double across = axis[l] * d[m] - axis[m] * d[l];
    camera.eye[k] = from->at[k] + d[k] * cos(angle) + across * sin(angle) +
                    axis[k] * along * (1 - cos(angle));
  }
  return camera;
}

enum hsr_status hsr_scene_turn(struct hsr_scene *scene, uint32_t view,
                               uint32_t n, struct hsr_error *err) {
  const double circle = 2 * 3.14159265358979323846;
  struct hsr_camera first = scene->views[view];
  enum hsr_status status = HSR_OK;
  scene->n_views = 0;
  for (uint32_t k = 0; k < n && !status; k++) {
    struct hsr_camera camera = k ? turned(&first, circle * k / n) : first;
    status = hsr_camera_check(&camera, err);
    if (!status && hsr_scene_view(scene, &camera))
      status = hsr_fail_nomem(err);
  }
  return status;
}
