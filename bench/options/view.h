/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The view of a command. */
#ifndef HSR_BENCH_OPTIONS_VIEW_H
#define HSR_BENCH_OPTIONS_VIEW_H

#include "bench/options/scene.h"
#include "common/view/view.h"

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

/* Parses an option of either; else ARGP_ERR_UNKNOWN. */
error_t parse_place_option(struct scene_options *scene,
                           struct view_options *view, int key, char *arg,
                           const char *command, struct option_base *base);

/* Adds the cameras and the palette to the scene's name. If there are words, the
 * scene's only view is the one that they describe, and view->view becomes 1.
 * The errors are those of aim_name. */
enum hsr_status aim_scene(struct scene_options *scene,
                          struct view_options *view, struct hsr_error *err);

/* Whether the scene has a view of this number, from 1. HSR_E_USAGE. */
enum hsr_status check_view(const struct hsr_scene *scene, long view,
                           struct hsr_error *err);

/* The view that is chosen of a scene, with `samples` x `samples` a pixel.
 * HSR_E_USAGE if it has no such view; else as hsr_view_init. */
enum hsr_status choose_view(const struct view_options *options,
                            const struct hsr_scene *scene, int samples,
                            struct hsr_view *view, struct hsr_error *err);

#endif
