/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/command.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

error_t option_fail(struct option_base *base, const char *format, ...) {
  char text[400];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  hsr_fail(base->err, HSR_E_USAGE, "%s", text);
  base->failed = true;
  return EINVAL;
}

enum hsr_status parse_options(const struct argp *argp, int argc, char **argv,
                              void *input, struct hsr_error *err) {
  struct option_base *base = input;
  base->err = err;
  base->failed = false;
  char name[32], *first = argv[0];
  snprintf(name, sizeof name, "hsr %s", first);
  argv[0] = name;
  for (int k = 1; k < argc; k++)
    if (!strcmp(argv[k], "--help") || !strcmp(argv[k], "-?")) {
      argp_help(argp, stdout, ARGP_HELP_STD_HELP & ~ARGP_HELP_EXIT_OK, name);
      exit(fflush(stdout) ? HSR_E_INPUT : 0);
    }
  /* We print the errors. An argp that prints none prints no help either. */
  int at = 1;
  error_t failed =
      argp_parse(argp, argc, argv, ARGP_NO_ERRS | ARGP_NO_HELP, &at, input);
  argv[0] = first;
  if (!failed)
    return HSR_OK;
  if (failed == ENOMEM)
    return hsr_fail_nomem(err);
  if (base->failed)
    return HSR_E_USAGE;
  return hsr_fail(err, HSR_E_USAGE,
                  "%s: '%s' is not an option or lacks its value (see hsr %s "
                  "--help)",
                  first, argv[at > 1 && at <= argc ? at - 1 : argc - 1], first);
}

struct json_options {
  struct option_base base;
  bool *json;
};

static error_t parse_json(int key, char *arg, struct argp_state *state) {
  struct json_options *options = state->input;
  if (key == ARGP_KEY_ARG)
    return option_fail(&options->base, "takes no scene or file, not '%s'", arg);
  if (key != 'j')
    return ARGP_ERR_UNKNOWN;
  *options->json = true;
  return 0;
}

enum hsr_status parse_json_option(int argc, char **argv, const char *about,
                                  bool *json, struct hsr_error *err) {
  const struct argp_option entries[] = {
      {"json", 'j', NULL, 0, "print one JSON object", 0}, {0}};
  const struct argp argp = {entries, parse_json, NULL, about, NULL, NULL, NULL};
  struct json_options options = {.json = json};
  *json = false;
  return parse_options(&argp, argc, argv, &options, err);
}

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

bool parse_size(const char *text, int *m, int *n) {
  char *end;
  errno = 0;
  long width = strtol(text, &end, 10);
  if (end == text || *end != 'x' || errno)
    return false;
  const char *second = end + 1;
  long height = strtol(second, &end, 10);
  if (end == second || *end || errno || width < 1 || height < 1 ||
      width > HSR_MAX_SIZE || height > HSR_MAX_SIZE)
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

error_t parse_scene_option(struct scene_options *o, int key, char *arg,
                           const char *command, struct option_base *base) {
  switch (key) {
  case DROP_DEGENERATE:
    o->import.drop_degenerate = true;
    return 0;
  case ARGP_KEY_ARG:
    if (o->name)
      return option_fail(base, "%s: one scene at a time, not also '%s'",
                         command, arg);
    o->name = arg;
    return 0;
  case ARGP_KEY_END:
    if (!o->name)
      return option_fail(base, "%s: which scene? (see hsr %s --help)", command,
                         command);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

enum hsr_status open_scene(const char *name, struct hsr_import import,
                           struct hsr_scene **scene, struct hsr_error *err) {
  enum hsr_status status = hsr_scene_open(name, &import, scene, err);
  if (!status && import.n_dropped)
    fprintf(stderr, "hsr: %s: %llu degenerate faces left out\n", name,
            (unsigned long long)import.n_dropped);
  return status;
}

error_t parse_view_option(struct view_options *o, int key, char *arg,
                          struct option_base *base) {
  switch (key) {
  case 'v':
    if (!parse_count(arg, 1, 1000000, &o->view))
      return option_fail(base, "--view %s: views are numbered from 1", arg);
    return 0;
  case 's':
    if (!parse_size(arg, &o->m, &o->n))
      return option_fail(base, "--size %s: must be MxN, each 1 to %d", arg,
                         HSR_MAX_SIZE);
    return 0;
  case VIEW_EYE:
  case VIEW_AT:
  case VIEW_UP: {
    double *point = key == VIEW_EYE  ? o->camera.eye
                    : key == VIEW_AT ? o->camera.at
                                     : o->camera.up;
    if (!parse_point(arg, point))
      return option_fail(base, "'%s': a point is three numbers, X,Y,Z", arg);
    o->has_eye |= key == VIEW_EYE;
    o->has_at |= key == VIEW_AT;
    o->has_up |= key == VIEW_UP;
    return 0;
  }
  case VIEW_FOV:
  case VIEW_NEAR: {
    if (!parse_number(arg, key == VIEW_FOV ? &o->camera.fov : &o->camera.near))
      return option_fail(base, "'%s' is not a number", arg);
    o->has_fov |= key == VIEW_FOV;
    o->has_near |= key == VIEW_NEAR;
    return 0;
  }
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

enum hsr_status choose_camera(const struct view_options *o,
                              const struct hsr_scene *scene,
                              struct hsr_camera *camera,
                              struct hsr_error *err) {
  if (o->view > (long)scene->n_views)
    return hsr_fail(err, HSR_E_USAGE, "%s has %u views; there is no view %ld",
                    scene->name, scene->n_views, o->view);
  *camera = scene->views[o->view - 1];
  for (int k = 0; k < 3; k++) {
    if (o->has_eye)
      camera->eye[k] = o->camera.eye[k];
    if (o->has_at)
      camera->at[k] = o->camera.at[k];
    if (o->has_up)
      camera->up[k] = o->camera.up[k];
  }
  if (o->has_fov)
    camera->fov = o->camera.fov;
  if (o->has_near)
    camera->near = o->camera.near;
  return hsr_camera_check(camera, err) ? HSR_E_USAGE : HSR_OK;
}
