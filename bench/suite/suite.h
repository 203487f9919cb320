/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr suite: scenes, cameras and right answers as files. command.c chooses the
 * scenes of suite.def; scene.c makes the files of one; flat.c makes it plain
 * faces and triangles; cameras.c has the matrices; exact.c the depths; right.c
 * asks hsr.h for the answers; folder.c keeps the folder whole; readme.c says
 * what to do with it. */
#ifndef HSR_BENCH_SUITE_SUITE_H
#define HSR_BENCH_SUITE_SUITE_H

#include "bench/suite/folder.h"

#include <stdbool.h>

/* A line of suite.def. */
struct suite_row {
  const char *group, *scene;
  int first, last; /* views, from 1; 0: the scene's last */
  int m, n;
  bool segments;
};

/* Ended by .scene == NULL. */
extern const struct suite_row suite_rows[];

/* The name of a scene in the suite: "house-parallel-same" of
 * "house@parallel=same". */
enum { SUITE_NAME = 64 };
void suite_name(const char *scene, char name[SUITE_NAME]);

/* Makes the files of the scene of row[0] to row[n_rows - 1], and appends what
 * there is to *scenes and *cases. HSR_E_STOPPED after Ctrl-C. */
enum hsr_status suite_add_scene(struct folder *folder,
                                const struct suite_row *row, int n_rows,
                                json_t **scenes, json_t **cases,
                                struct hsr_error *err);

/* Writes README.md. */
enum hsr_status suite_write_readme(struct folder *folder,
                                   struct hsr_error *err);

#endif
