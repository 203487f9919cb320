/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr lab: the laboratory, with a scene of the user's in it. The page itself is
 * under reports/lab; its state/asked.js reads what is written here.
 *
 * asked.c    what the page opens with, as JSON
 * first.c    the pictures that it shows while its core starts
 * command.c  the options, and the file */
#ifndef HSR_BENCH_LAB_H
#define HSR_BENCH_LAB_H

#include "bench/options/view.h"

#include <jansson.h>

/* The most faces of a scene that goes into the page, and the most algorithms;
 * samples a row, and rows, of the first pictures. */
enum {
  LAB_MOST_FACES = 100000,
  LAB_MOST_ALGORITHMS = 3,
  LAB_FIRST_M = 480,
  LAB_FIRST_N = 360
};

/* What the page opens with:
 *
 *   scene       its name. A built-in one that needs no files is made anew by the
 *               page, and has sliders for its parameters
 *   file        of any other scene: the text of a .scene.json
 *   camera      {eye, at, up, fov, near, parallel, light}, as struct hsr_camera
 *   algorithms  those that draw, with their options
 *
 * `name` is the scene's as the user gave it, without the words of a camera. *asked
 * is a new reference. HSR_E_INPUT for a volume from a file; HSR_E_REFUSED for more
 * than LAB_MOST_FACES faces; else as open_scene and choose_view. */
enum hsr_status lab_asked(const char *name, const struct scene_options *scene,
                          const struct view_options *view, json_t *algorithms,
                          json_t **asked, struct hsr_error *err);

/* Writes the first pictures as HTML: what each algorithm draws of the scene, as
 * .png. Nothing, if one of them draws lines, refuses the scene, or takes
 * long. */
void lab_put_first(const struct scene_options *scene,
                   const struct view_options *view, const json_t *algorithms,
                   FILE *out);

#endif
