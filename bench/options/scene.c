/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/options/scene.h"
#include "bench/options/words.h"
#include "bench/options/streams.h"
#include "common/files/suffix.h"
#include "scenes/cameras.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

error_t parse_import_option(struct hsr_import *import, int key, const char *arg,
                            struct option_base *base) {
  switch (key) {
  case STRICT:
    import->strict = true;
    return 0;
  case TWO_SIDED:
    import->two_sided = true;
    return 0;
  case DROP_DEGENERATE: /* which is the standard */
    return 0;
  case WELD:
    return parse_number(arg, &import->weld) && import->weld > 0
               ? 0
               : option_fail(base, "--weld %s: must be a distance above 0",
                             arg);
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

error_t parse_input(const char *suffix, const char *command,
                    struct option_base *base, const char **path) {
  *path = stream_input(suffix);
  if (!*path && errno == EBUSY)
    return option_fail(base, "%s: standard input can be read only once",
                       command);
  return *path ? 0
               : option_fail(base, "standard input: cannot be read: %s",
                             strerror(errno));
}

/* Reads standard input, if the scene is that. */
static error_t take_input(struct scene_options *o, const char *command,
                          struct option_base *base) {
  const bool is_input = !strcmp(o->name, "-");
  if (!is_input && o->format)
    return option_fail(base, "%s: --format is for the scene - alone", command);
  if (!is_input)
    return 0;
  if (!o->format)
    return option_fail(base,
                       "%s: --format says what standard input holds: obj, ply, "
                       "...",
                       command);
  error_t error = parse_input(o->format, command, base, &o->import.path);
  if (error)
    return error;
  snprintf(o->of_input, sizeof o->of_input, "-.%s",
           o->format + (*o->format == '.'));
  o->name = o->of_input;
  return 0;
}

error_t parse_output(const char *arg, const char *suffix, const char *command,
                     struct option_base *base, const char **path) {
  *path = arg;
  if (!is_stream(arg))
    return 0;
  if (!arg[1] && !suffix)
    return option_fail(
        base, "%s: -o -.SUFFIX says what goes to standard output", command);
  *path = stream_output(arg, suffix);
  if (!*path && errno == EBUSY)
    return option_fail(base, "%s: one file goes to standard output", command);
  return *path ? 0
               : option_fail(base, "standard output: cannot be written: %s",
                             strerror(errno));
}

error_t parse_scene_option(struct scene_options *o, int key, char *arg,
                           const char *command, struct option_base *base) {
  switch (key) {
  case ARGP_KEY_ARG:
    if (o->name)
      return option_fail(base, "%s: one scene at a time, not also '%s'",
                         command, arg);
    o->name = arg;
    return 0;
  case FORMAT:
    o->format = arg;
    return 0;
  case ARGP_KEY_END:
    if (!o->name)
      return option_fail(base, "%s: which scene? (see hsr %s --help)", command,
                         command);
    return take_input(o, command, base);
  default:
    return parse_import_option(&o->import, key, arg, base);
  }
}

error_t parse_threads(struct scene_options *options, long *threads,
                      const char *arg, struct option_base *base) {
  if (!parse_count(arg, 1, 64, threads))
    return option_fail(base, "--jobs %s: must be 1 to 64", arg);
  options->import.threads = (int)*threads;
  return 0;
}

void say_opened(const char *name, const char *notes, uint64_t n_dropped,
                int enlarged) {
  char told[sizeof((struct hsr_import *)NULL)->notes];
  streams_tell(notes, told, sizeof told);
  for (const char *note = told; *note;) {
    const int length = (int)strcspn(note, "\n");
    fprintf(stderr, "hsr: %.*s\n", length, note);
    note += length + (note[length] == '\n');
  }
  if (n_dropped)
    fprintf(stderr, "hsr: %s: %llu face%s without area left out\n", name,
            (unsigned long long)n_dropped, n_dropped == 1 ? "" : "s");
  if (enlarged)
    fprintf(stderr,
            "hsr: %s: too small to compute with, so it is drawn 2^%d times as "
            "large; depths and coordinates are those of the larger scene\n",
            name, enlarged);
}

bool scene_is_made_by_name(const struct scene_options *options) {
  return hsr_is_made_by_name(options->name) && !options->import.two_sided &&
         !(options->import.weld > 0);
}

enum hsr_status open_scene(const char *name, struct hsr_import import,
                           struct hsr_scene **scene, struct hsr_error *err) {
  enum hsr_status status = hsr_scene_open(name, &import, scene, err);
  if (!status)
    say_opened(name, import.notes, import.n_dropped, (*scene)->enlarged);
  return status;
}

/* Whether a place is far from x = 0 and y = 0, and no higher than mountains. */
static bool is_on_map(const double at[3]) {
  enum { FAR = 10000 }; /* metres */
  return fabs(at[0]) > FAR && fabs(at[1]) > FAR && fabs(at[2]) < FAR &&
         fmin(fabs(at[0]), fabs(at[1])) > 10 * fabs(at[2]);
}

void say_map(const char *name, const struct hsr_scene *scene) {
  bool is_map = scene->n_objects && hsr_is_mesh_name(name) &&
                !hsr_ends_in(name, ".gltf") && !hsr_ends_in(name, ".glb") &&
                !name[hsr_name_before_cameras(name)];
  for (uint32_t o = 0; o < scene->n_objects && is_map; o++)
    is_map = scene->objects[o].n_vertices && is_on_map(scene->objects[o].xyz);
  if (is_map)
    fprintf(
        stderr,
        "hsr: %s: x and y are like those of a map, where z is up; here y is "
        "up, and --up-axis=z turns the views\n",
        name);
}
