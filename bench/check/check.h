/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of hsr check share: command.c chooses the scenes, views and
 * sizes to judge; report.c prints the results. */
#ifndef HSR_BENCH_CHECK_H
#define HSR_BENCH_CHECK_H

#include "bench/command.h"
#include "bench/judge/judge.h"

enum {
  MOST_SCENES = 4096,
  MOST_SIZES = 16,
  MOST_ALGORITHMS = 64,
  MOST_VIEWS = 1000
};

struct check_options {
  struct option_base base;
  const char *scene[MOST_SCENES];
  int n_scenes;
  int m[MOST_SIZES], n[MOST_SIZES], n_sizes;
  struct hsr_variant algorithm[MOST_ALGORITHMS];
  int n_algorithms;
  int view[MOST_VIEWS], n_views; /* from 0, in the order of judging */
  long samples, jobs, timeout;   /* samples 0: as many as the scene allows */
  long first_views;              /* --views; 0: not given */
  const char *order;             /* --order; or NULL */
  bool json, failures_only;
  struct hsr_import import;
};

/* --- All cells of a scene ------------------------------------------------- */

struct scene_run {
  const struct check_options *options;
  const char *name;
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view *view; /* one for each size and view, in judging order */
  struct cell *cells;    /* one for each size, view and algorithm; shared */
  size_t cells_size;
};

static inline struct cell *cell_at(const struct scene_run *run, int size,
                                   int view, int algorithm) {
  int picture = size * run->options->n_views + view;
  return &run->cells[picture * run->options->n_algorithms + algorithm];
}

/* --- The report ----------------------------------------------------------- */

struct totals {
  uint64_t compared[HSR_MOST_ANSWER_TYPES]; /* by the kind's number */
  uint64_t mismatches, depths, depths_exact;
  uint64_t expected; /* mismatches of algorithms that are known to be wrong */
  int failures;      /* cells that are neither ok nor refused */
  struct json_t *cells;
};

void report_begin(const struct check_options *options, struct totals *totals);

/* Prints a scene's cells and adds them up. HSR_E_NOMEM, also if an algorithm
 * had too little memory. */
enum hsr_status report_scene(const struct scene_run *run, struct totals *totals,
                             struct hsr_error *err);

enum hsr_status report_end(const struct check_options *options,
                           struct totals *totals, struct hsr_error *err);
void report_abandon(struct totals *totals);

#endif
