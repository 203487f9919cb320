/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the subcommands of hsr share: options, scenes and views by name, and
 * running one algorithm. */
#ifndef HSR_BENCH_COMMAND_H
#define HSR_BENCH_COMMAND_H

#include "config.h"

#include "algorithms/setup.h"
#include "algorithms/variant.h"
#include "common/answers/area.h"
#include "scenes/scenes.h"

#include <argp.h>
#include <stdio.h>

/* A subcommand. argv[0] is its name. HSR_E_DIFFERENCE ends the program with
 * status 1 and without a message. Any other failure ends it with the message in
 * *err. */
struct hsr_command {
  const char *name;
  const char *about; /* for --help; NULL: --help does not show it */
  enum hsr_status (*run)(int argc, char **argv, struct hsr_error *err);
};

enum hsr_status command_list(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_scenes(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_stats(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_times(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_tables(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_render(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_view(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_export(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_check(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_bench(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_report(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_trace(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_lesson(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_voxels(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_areas(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_errors(int argc, char **argv, struct hsr_error *err);
enum hsr_status command_worker(int argc, char **argv, struct hsr_error *err);

/* --- Options -------------------------------------------------------------- */

/* Parses argv with an argp parser, which reports the faults that it finds by
 * option_fail. Any other fault of the command line becomes one line as well.
 * --help prints and ends the program. HSR_E_USAGE. */
enum hsr_status parse_options(const struct argp *argp, int argc, char **argv,
                              void *input, struct hsr_error *err);

/* For use in an argp parser: stores the message and makes parse_options return
 * HSR_E_USAGE. `input` of every parser starts with a struct option_base. */
struct option_base {
  struct hsr_error *err;
  bool failed;
};
error_t option_fail(struct option_base *base, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* For subcommands that only take --json; --help prints `about`. */
enum hsr_status parse_json_option(int argc, char **argv, const char *about,
                                  bool *json, struct hsr_error *err);

enum { MOST_PARTS = 1 << 20 }; /* of --sort-last */

/* Parse "640x480", or "512", which is 512x512; "x,y,z"; a decimal number; a whole
 * number from `least` to `most`. False if the text is anything else. */
bool parse_size(const char *text, int *m, int *n);
bool parse_size_to(const char *text, int most, int *m, int *n); /* each side */
bool parse_point(const char *text, double point[3]);
bool parse_number(const char *text, double *number);
bool parse_count(const char *text, long least, long most, long *count);

/* "A-B" or "A", of numbers from `least` on, A <= B. */
bool parse_range(const char *text, long least, long *first, long *last);

/* --filter of area pictures: a name of hsr_area_filters. */
error_t parse_area_filter(enum hsr_area_filter *filter, const char *arg,
                          struct option_base *base);

/* --crease of line drawings. */
error_t parse_crease(double *degrees, const char *arg,
                     struct option_base *base);

/* The name of a file of a series: the number in the place of the pattern's only
 * %d, which may have a width, as in f%03d.png; %% stands for one %. False if
 * the pattern has no such place, or several, or the name does not fit. */
enum { MOST_FILE_NAME = 4096 };
bool series_name(const char *pattern, long number, char name[MOST_FILE_NAME]);

/* The cameras that the options describe, and the palette. They become a part of
 * the scene's name (scenes/cameras.h), so that whoever gets the name looks from
 * there, and sees samples as splats like that. */
enum { CAMERA_WORDS = 8, CAMERA_PLACES = 3, MOST_AIMED_NAME = 1024 };
struct camera_options {
  const char *file;               /* of --camera, or NULL */
  const char *word[CAMERA_WORDS]; /* of --eye, --at, --up, --fov, --near,
                                     --parallel, --light, --sun */
  const char *palette;            /* of --palette, or NULL */
};

/* Entries for an argp option array, and their parser. ARGP_ERR_UNKNOWN if `key`
 * is none of them. */
enum { CAMERA_EYE = 0x100, CAMERA_FILE = CAMERA_EYE + CAMERA_WORDS, PALETTE };
#define CAMERA_ARGP_OPTIONS                                                     \
  {NULL, 0, NULL, 0, "Where to look from:", 10},                                \
      {"eye", CAMERA_EYE, "X,Y,Z", 0, "look from here", 10},                    \
      {"at", CAMERA_EYE + 1, "X,Y,Z", 0, "look at this point", 10},             \
      {"up", CAMERA_EYE + 2, "X,Y,Z", 0, "this direction is up", 10},           \
      {"fov", CAMERA_EYE + 3, "DEG", 0, "vertical angle of view, degrees", 10}, \
      {"near", CAMERA_EYE + 4, "T", 0, "nothing exists up to this distance",    \
       10},                                                                     \
      {"parallel",                                                              \
       CAMERA_EYE + 5,                                                          \
       "HEIGHT",                                                                \
       0,                                                                       \
       "in parallel projection, the picture so high; fit: as high as what is "  \
       "in perspective around the point looked at",                             \
       10},                                                                     \
      {"light",                                                                 \
       CAMERA_EYE + 6,                                                          \
       "X,Y,Z",                                                                 \
       0,                                                                       \
       "shadows are cast by a light at this point",                             \
       10},                                                                     \
      {"sun",                                                                   \
       CAMERA_EYE + 7,                                                          \
       "X,Y,Z",                                                                 \
       0,                                                                       \
       "shadows are cast by a sun in this direction",                           \
       10},                                                                     \
      {"camera",                                                                \
       CAMERA_FILE,                                                             \
       "FILE",                                                                  \
       0,                                                                       \
       "look from the views of this file, not from those of the scene",         \
       10},                                                                     \
  {                                                                             \
    "palette", PALETTE, "NAME|FILE.json", 0,                                    \
        "how samples of a grid look as splats: a palette of hsr list or a "     \
        "file",                                                                 \
        11                                                                      \
  }
error_t parse_camera_option(struct camera_options *options, int key, char *arg,
                            struct option_base *base);

/* Whether there is any word; and one that says where to look from, to, or what
 * is up: then the scene has one view. */
bool has_camera_words(const struct camera_options *options);
bool names_a_place(const struct camera_options *options);

/* The option that gives a light, "--light" or "--sun"; NULL: none does. */
const char *light_option(const struct camera_options *options);

/* How many views are meant if --views does not say so: one if a place is named,
 * those of the file of --camera, or else `standard`; `most` at most.
 * HSR_E_INPUT, HSR_E_NOMEM: the file cannot be read. */
enum hsr_status count_views(const struct camera_options *options, long standard,
                            long most, long *n, struct hsr_error *err);

/* Adds the cameras and the palette to a scene's name. Words change the scene's
 * view number `view`, from 1. HSR_E_USAGE if the name becomes too long, or
 * there is no such palette; HSR_E_INPUT, HSR_E_NOMEM: its file cannot be
 * read. */
enum hsr_status aim_name(const struct camera_options *options, long view,
                         const char *scene, char aimed[MOST_AIMED_NAME],
                         struct hsr_error *err);

/* The one scene of a subcommand. */
struct scene_options {
  const char *name;
  struct hsr_import import;
  char aimed[MOST_AIMED_NAME]; /* the name with its cameras and palette, once
                                  aim_scene has added them */
};

/* An entry for an argp option array, and the parser of that option and of the
 * argument SCENE. ARGP_ERR_UNKNOWN if `key` is neither. `command` is the name
 * of the subcommand: "render", ... */
enum { DROP_DEGENERATE = 0x180, TWO_SIDED };
#define SCENE_ARGP_OPTIONS                                                     \
  {"drop-degenerate",                                                          \
   DROP_DEGENERATE,                                                            \
   NULL,                                                                       \
   0,                                                                          \
   "leave out faces of a mesh file that have no area or repeat a vertex, "     \
   "instead of refusing the file",                                             \
   0},                                                                         \
  {                                                                            \
    "two-sided", TWO_SIDED, NULL, 0,                                           \
        "keep the back of a closed mesh, whose rear edges are hidden lines; "  \
        "without it, faces that turn their backs to the eye do not exist",     \
        0                                                                      \
  }
/* The same options, into a struct hsr_import. False if `key` is none. */
bool parse_import_option(struct hsr_import *import, int key);
error_t parse_scene_option(struct scene_options *options, int key, char *arg,
                           const char *command, struct option_base *base);

/* Opens a scene, which the caller deletes, and says on stderr how many faces
 * were left out of it, and what else was passed over. The errors are those of
 * hsr_scene_open. */
enum hsr_status open_scene(const char *name, struct hsr_import import,
                           struct hsr_scene **scene, struct hsr_error *err);

/* Where to look from: one of the scene's views, changed by the options given,
 * and how many samples. */
struct view_options {
  long view; /* from 1 */
  int m, n;
  struct camera_options camera;
};
#define VIEW_OPTIONS_STANDARD                                                  \
  { .view = 1, .m = 512, .n = 512 }

/* Entries for an argp option array, and their parser. ARGP_ERR_UNKNOWN if `key`
 * is none of them. */
#define VIEW_ARGP_OPTIONS VIEW_ARGP_OPTIONS_OF("512x512")
#define VIEW_ARGP_OPTIONS_OF(size)                                             \
  {"size", 's', "MxN", 0, "samples a row x rows (standard: " size ")", 0},     \
      {"view",                                                                 \
       'v',                                                                    \
       "K",                                                                    \
       0,                                                                      \
       "look from the scene's view K, from 1 (standard: 1)",                   \
       10},                                                                    \
      CAMERA_ARGP_OPTIONS
error_t parse_view_option(struct view_options *options, int key, char *arg,
                          struct option_base *base);

/* Adds the cameras and the palette to the scene's name. If there are words, the
 * scene's only view is the one that they describe, and view->view becomes 1.
 * The errors are those of aim_name. */
enum hsr_status aim_scene(struct scene_options *scene,
                          struct view_options *view, struct hsr_error *err);

/* The view that is chosen of a scene, with `samples` x `samples` a pixel.
 * HSR_E_USAGE if it has no such view; else as hsr_view_init. */
enum hsr_status choose_view(const struct view_options *options,
                            const struct hsr_scene *scene, int samples,
                            struct hsr_view *view, struct hsr_error *err);

/* --- Running -------------------------------------------------------------- */

long processors(void); /* available to this process; at least 1 */

/* Makes an answer of the form that the setup chooses, in which nothing is
 * drawn. It is to be freed with hsr_answer_free also after a failure.
 * HSR_E_NOMEM; HSR_E_REFUSED if a picture to be folded would be too large. */
enum hsr_status answer_init(struct hsr_answer *answer,
                            const struct hsr_setup *setup,
                            const struct hsr_view *view, struct hsr_error *err);

/* Threads, each with its own memory, which lasts from frame to frame. At least
 * one and at most 64. NULL for lack of memory. */
struct crew *crew_new(long threads);
void crew_free(struct crew *crew); /* NULL is allowed */

/* From now on the crews of all ranks (bench/run/ranks.h) draw every picture
 * together. Each rank has to call crew_render for the same pictures; only in
 * rank 0 the answer is complete then. An answer that is made as a whole, rank 0
 * makes alone. */
void crew_join_ranks(struct crew *crew);

/* What a crew has done in this rank so far. */
struct crew_work {
  double seconds;         /* of processors, drawing */
  double bytes, messages; /* sent to rank 0 */
  double parts;           /* drawn, of pictures that ranks share */
};
struct crew_work crew_work(const struct crew *crew);

/* Renders the view's whole window with an algorithm that is prepared, and adds
 * its counts to *tally. The whole crew makes an answer that can be made by
 * windows: each thread takes a band of rows at a time, or a square if the
 * setup's choice says so. One thread makes it alone if the algorithm keeps
 * frame state, if the kind of answer is made as a whole, or if somebody
 * listens. If the answer is folded from pictures, the crew draws these and one
 * thread folds them. */
enum hsr_status crew_render(struct crew *crew, const struct hsr_setup *setup,
                            const struct hsr_view *view,
                            struct hsr_answer *answer, struct hsr_tally *tally,
                            struct hsr_error *err);

/* The same, by a crew that is made for this one frame. *seconds, unless NULL,
 * becomes the time of the rendering alone. */
enum hsr_status render_view(const struct hsr_setup *setup,
                            const struct hsr_view *view, long threads,
                            struct hsr_answer *answer, struct hsr_tally *tally,
                            double *seconds, struct hsr_error *err);

/* Measures Table I of a view. It draws the picture to learn what is visible. */
enum hsr_status measure_table1(const struct hsr_world *world,
                               const struct hsr_view *view,
                               struct hsr_table1 *table, struct hsr_error *err);

#endif
