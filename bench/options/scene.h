/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scene of a command, and opening it. */
#ifndef HSR_BENCH_OPTIONS_SCENE_H
#define HSR_BENCH_OPTIONS_SCENE_H

#include "bench/options/camera.h"
#include "scenes/scenes.h"

/* The one scene of a subcommand. */
struct scene_options {
  const char *name;
  const char *format; /* of standard input, which is named "-"; or NULL */
  char of_input[50];  /* what its scene is called: "-.obj" */
  struct hsr_import import;
  char aimed[MOST_AIMED_NAME]; /* the name with its cameras and palette, once
                                  aim_scene has added them */
};

enum { STRICT = 0x180, TWO_SIDED, DROP_DEGENERATE, FORMAT, WELD };

/* Entries for an argp option array: how files are imported. Their parser stores
 * them in *import. ARGP_ERR_UNKNOWN if `key` is none of them. */
#define IMPORT_ARGP_OPTIONS                                                    \
  {"strict",                                                                   \
   STRICT,                                                                     \
   NULL,                                                                       \
   0,                                                                          \
   "refuse a file with faces that have no area, instead of leaving them out",  \
   0},                                                                         \
      {"drop-degenerate", DROP_DEGENERATE, NULL, OPTION_HIDDEN, NULL, 0},      \
      {"weld",                                                                 \
       WELD,                                                                   \
       "DISTANCE",                                                             \
       0,                                                                      \
       "join vertices of a mesh file that are no farther apart, in its unit",  \
       0},                                                                     \
  {                                                                            \
    "two-sided", TWO_SIDED, NULL, 0,                                           \
        "keep the back of a closed mesh, whose rear edges are hidden lines; "  \
        "without it, faces that turn their backs to the eye do not exist",     \
        0                                                                      \
  }
error_t parse_import_option(struct hsr_import *import, int key, const char *arg,
                            struct option_base *base);

/* The same, and --format; their parser takes the argument SCENE, too.
 * ARGP_ERR_UNKNOWN if `key` is neither. `command` is the name of the subcommand:
 * "render", ... */
#define SCENE_ARGP_OPTIONS                                                     \
  {"format",                                                                   \
   FORMAT,                                                                     \
   "obj|ply|stl|off|glb|vtp|nii|vti|scene.json|SUFFIX",                        \
   0,                                                                          \
   "what standard input holds, if SCENE is -",                                 \
   0},                                                                         \
      IMPORT_ARGP_OPTIONS
error_t parse_scene_option(struct scene_options *options, int key, char *arg,
                           const char *command, struct option_base *base);

/* Sets *path to a file with what comes from standard input, which has this
 * suffix. */
error_t parse_input(const char *suffix, const char *command,
                    struct option_base *base, const char **path);

/* Sets *path to the file that an option -o names. "-.png" is standard output as
 * .png, and "-" is it with the suffix `suffix`, unless that is NULL. */
error_t parse_output(const char *arg, const char *suffix, const char *command,
                     struct option_base *base, const char **path);

/* --jobs of subcommands that draw on so many threads. */
#define THREADS_ARGP_OPTION                                                    \
  { "jobs", 'J', "N", 0, "threads (standard: 1)", 0 }
error_t parse_threads(struct scene_options *options, long *threads,
                      const char *arg, struct option_base *base);

/* Opens a scene, which the caller deletes, and says on stderr how many faces
 * were left out of it, and what else was passed over. The errors are those of
 * hsr_scene_open. */
enum hsr_status open_scene(const char *name, struct hsr_import import,
                           struct hsr_scene **scene, struct hsr_error *err);

/* Says on stderr that z seems to be up, if a mesh file has coordinates like those
 * of a map, and the name asks for no views of its own. */
void say_map(const char *name, const struct hsr_scene *scene);

/* Whether the name alone makes the scene, anywhere: hsr_is_made_by_name, and no
 * option changes it. */
bool scene_is_made_by_name(const struct scene_options *options);

/* Says on stderr what was left out of a scene that was opened, and that it was
 * enlarged 2^enlarged times. */
void say_opened(const char *name, const char *notes, uint64_t n_dropped,
                int enlarged);

enum { MOST_PARTS = 1 << 20 }; /* of a scene, by --sort-last */

#endif
