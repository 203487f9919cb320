/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of hsr check share. Each tells a part of it: check.c which
 * scenes, views and sizes; judge.c how the algorithms of a kind are judged on
 * one of them; check_report.c what came of it. */
#ifndef HSR_BENCH_CHECK_H
#define HSR_BENCH_CHECK_H

#include "bench/command.h"

enum {
  MOST_SCENES = 4096,
  MOST_SIZES = 16,
  MOST_ALGORITHMS = 64,
  N_KINDS = HSR_FILTERED + 1
};

struct check_options {
  struct option_base base;
  const char *scene[MOST_SCENES];
  int n_scenes;
  int m[MOST_SIZES], n[MOST_SIZES], n_sizes;
  const struct hsr_listed *algorithm[MOST_ALGORITHMS];
  int n_algorithms;
  long views, jobs, timeout;
  bool json, failures_only;
  struct hsr_import import;
};

/* The oracle of a kind; NULL if there is none. */
const struct hsr_algorithm *oracle_of(enum hsr_kind kind);

/* --- One cell: an algorithm on a scene, view and size ------------------------
 */

enum verdict { PENDING, RIGHT, WRONG, REFUSED, TIMEOUT, CRASH };

/* In memory shared between the processes. */
struct cell {
  enum verdict verdict;
  enum hsr_status failure; /* why the process stopped, if not HSR_OK */
  uint64_t compared;       /* samples, or edges, in the build that is timed */
  uint64_t mismatches;     /* of those in both builds */
  struct {                 /* the first of them */
    int i, j;
    uint32_t got, wanted;
    struct hsr_edge_name edge; /* of a line drawing */
  } first;
  uint64_t depths_compared, depths_exact;
  const char
      *adapted[HSR_MAX_ADAPTATIONS]; /* adapters that changed the scene */
  int n_adaptations;
  char refusal[560]; /* who refused and why, if it was not for its expense */
};

/* All algorithms of a kind on one scene, view and size. */
struct group {
  const struct check_options *options;
  const struct hsr_world *world;
  enum hsr_kind kind;
  struct hsr_view view;
  struct cell *cells; /* an algorithm, also of the other kinds */
};

/* To be called in a process of its own. Where the oracle of line drawings takes
 * longer than a picture may, that ends by SIGALRM, and the cells are refused.
 * Any failure is the oracle's. */
enum hsr_status judge_group(const struct group *group);

/* --- All cells of a scene ----------------------------------------------------
 */

struct scene_run {
  const struct check_options *options;
  const char *name;
  struct hsr_scene *scene;
  struct hsr_world world;
  struct cell *cells; /* a size, view and algorithm; shared */
  size_t cells_size;
};

static inline struct cell *cell_at(const struct scene_run *run, int size,
                                   int view, int algorithm) {
  int picture = size * (int)run->options->views + view;
  return &run->cells[picture * run->options->n_algorithms + algorithm];
}

/* --- The report --------------------------------------------------------------
 */

struct totals {
  uint64_t compared[N_KINDS], mismatches, depths, depths_exact;
  uint64_t expected; /* mismatches of algorithms that are known to be wrong */
  int failures;      /* cells that are neither ok nor refused */
  struct json_t *cells;
};

void report_begin(const struct check_options *options, struct totals *totals);

/* Prints a scene's cells and adds them up. HSR_E_NOMEM, also where an algorithm
 * had too little memory. */
enum hsr_status report_scene(const struct scene_run *run, struct totals *totals,
                             struct hsr_error *err);

enum hsr_status report_end(const struct check_options *options,
                           struct totals *totals, struct hsr_error *err);
void report_abandon(struct totals *totals);

#endif
