/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where to look from, and how samples of a grid look. */
#ifndef HSR_BENCH_OPTIONS_CAMERA_H
#define HSR_BENCH_OPTIONS_CAMERA_H

#include "bench/options/parser.h"

/* The cameras that the options describe, and the palette. They become a part of
 * the scene's name (scenes/cameras.h), so that whoever gets the name looks from
 * there, and sees samples as splats like that. */
enum { CAMERA_WORDS = 9, CAMERA_PLACES = 3, MOST_AIMED_NAME = 1024 };
struct camera_options {
  const char *file;               /* of --camera, or NULL */
  const char *word[CAMERA_WORDS]; /* of --eye, --at, --up, --fov, --near,
                                     --parallel, --light, --sun, --up-axis */
  const char *look;    /* of --front and so on, a name of hsr_standard_views; or
                          NULL */
  const char *palette; /* of --palette, or NULL */
};

/* Entries for an argp option array, and their parser. ARGP_ERR_UNKNOWN if `key`
 * is none of them. */
enum {
  CAMERA_EYE = 0x100,
  CAMERA_FILE = CAMERA_EYE + CAMERA_WORDS,
  PALETTE,
  CAMERA_LOOK = 0x120 /* front, and the others in their order */
};
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
       "fit|same|HEIGHT",                                                       \
       0,                                                                       \
       "in parallel projection, the picture so high; fit: the scene fills "     \
       "it, "                                                                   \
       "in its middle; same: as high as what is in perspective around the "     \
       "point looked at",                                                       \
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
      {"up-axis",                                                               \
       CAMERA_EYE + 8,                                                          \
       "x|y|z",                                                                 \
       0,                                                                       \
       "this axis is up: views that stand on y are turned to stand on it",      \
       10},                                                                     \
      {"front",                                                                 \
       CAMERA_LOOK + 0,                                                         \
       NULL,                                                                    \
       0,                                                                       \
       "in parallel projection, from the front: from z, with y up",             \
       10},                                                                     \
      {"back", CAMERA_LOOK + 1, NULL, 0, "from behind", 10},                    \
      {"left", CAMERA_LOOK + 2, NULL, 0, "from the left", 10},                  \
      {"right", CAMERA_LOOK + 3, NULL, 0, "from the right", 10},                \
      {"top",                                                                   \
       CAMERA_LOOK + 4,                                                         \
       NULL,                                                                    \
       0,                                                                       \
       "from above, the front at the bottom edge",                              \
       10},                                                                     \
      {"bottom",                                                                \
       CAMERA_LOOK + 5,                                                         \
       NULL,                                                                    \
       0,                                                                       \
       "from below, the front at the top edge",                                 \
       10},                                                                     \
      {"iso",                                                                   \
       CAMERA_LOOK + 6,                                                         \
       NULL,                                                                    \
       0,                                                                       \
       "isometric, from the front, the right and above",                        \
       10},                                                                     \
      {"dimetric",                                                              \
       CAMERA_LOOK + 7,                                                         \
       NULL,                                                                    \
       0,                                                                       \
       "dimetric of ISO 5456-3: depth is halved and runs at 42 degrees, "       \
       "width at 7",                                                            \
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

/* Whether there is any word, or a standard view; and one that says where to look
 * from, to, or what is up, or a standard view: then the scene has one view. */
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
 * view number `view`, from 1. What is to fit, fits a picture of m x n samples.
 * HSR_E_USAGE if the name becomes too long, there is no such palette, or a
 * standard view comes with a place, an angle, a file or another view; HSR_E_INPUT, HSR_E_NOMEM: its file cannot be
 * read. */
enum hsr_status aim_name(const struct camera_options *options, long view, int m,
                         int n, const char *scene, char aimed[MOST_AIMED_NAME],
                         struct hsr_error *err);

#endif
