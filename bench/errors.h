/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hsr errors is asked, of faces and of grids. */
#ifndef HSR_BENCH_ERRORS_H
#define HSR_BENCH_ERRORS_H

#include "bench/client/client.h"
#include "bench/judge/integral/integral.h"
#include "bench/options/command.h"
#include "bench/options/words.h"
#include "common/answers/kinds/area.h"

enum { MOST_ALGORITHMS = 32, MOST_SIDES = 64, MOST_PICTURES = 32 };

struct errors_options {
  struct option_base base;
  struct scene_options scene;
  struct view_options view;
  const char *algorithm[MOST_ALGORITHMS];
  int n_algorithms;
  const char *where;
  bool json;
  long threads;

  /* of faces */
  long side[MOST_SIDES]; /* N of N x N samples */
  int n_sides;
  enum hsr_area_filter filter;
  bool has_filter;

  /* of grids */
  const char *picture[MOST_PICTURES]; /* files */
  int n_pictures;
  enum integral_field field;
  bool has_field; /* else sums are measured by sums */
  double width;   /* of intervals; 0: as is usual */
};

/* Of a pixel that is wrong by as much colours of 8 bits may show it. */
static const double errors_much = 1. / 256;

/* Errors of at least 2^-16 are seen in a picture of them: from 0 to 1. */
float errors_shown(double error);

/* Writes a picture of where the errors of picture `number` are, if there is to be
 * one, and its name into `to`. */
enum hsr_status errors_write_where(const struct errors_options *options,
                                   long number, const float *shown,
                                   char to[MOST_FILE_NAME],
                                   struct hsr_error *err);

/* Does the work for a scene that is a grid. */
enum hsr_status errors_of_grid(const struct errors_options *options,
                               struct lib_scene *scene, struct hsr_error *err);

#endif
