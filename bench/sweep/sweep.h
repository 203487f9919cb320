/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of hsr bench share. plan.c lists the cells. machine.c
 * describes the machine that they run on. group.c takes all cells of one scene,
 * view and size: it judges them, has turns.c time them, and records them.
 * changes.c compares the results with earlier ones, and finds cliffs. merge.c puts shards
 * together. */
#ifndef HSR_BENCH_SWEEP_SWEEP_H
#define HSR_BENCH_SWEEP_SWEEP_H

#include "bench/judge/judge.h"
#include "bench/options/camera.h"
#include "bench/options/command.h"
#include "bench/results/results.h"
#include "bench/terminal/interrupt.h"

enum {
  SWEEP_MOST_NAMES = 4096,
  SWEEP_MOST_VIEWS = 1000,
  SWEEP_MOST_SIZES = 16,
  SWEEP_MOST_THREADS = 8,
  SWEEP_MOST_ENTRANTS = 256,
  SWEEP_MOST_STARTS = 64,
  SWEEP_BUDGET_STARTS = 5,
  SWEEP_MOST_REPETITIONS = 1000
};

struct sweep_options {
  struct option_base base;
  const char *scene[SWEEP_MOST_NAMES];
  int n_scenes;
  struct camera_options camera;
  const char *algorithm[SWEEP_MOST_ENTRANTS], *peer[SWEEP_MOST_ENTRANTS];
  int n_algorithms, n_peers;
  int m[SWEEP_MOST_SIZES], n[SWEEP_MOST_SIZES], n_sizes;
  long threads[SWEEP_MOST_THREADS];
  int n_threads;
  long views, walk, starts, repetitions, seed, timeout, memory_mb;
  long budget;  /* seconds that the sweep should take; 0: any. Then there are as
                   many starts as there is time for, up to `starts`, but from
                   SWEEP_BUDGET_STARTS on no more than the times need to be
                   known well */
  long samples; /* compared in each picture; 0: as many as the scene allows */
  long shard, shards;        /* shard from 1 */
  const char *only;          /* pattern of keys, or NULL */
  const char *output;        /* file of results; NULL: they are not kept */
  const char *reference;     /* by whose time the others are divided */
  const char *baseline;      /* file of earlier results, or NULL */
  long cliffs;               /* how far out of line a cliff is; 0: none told */
  bool resume, list, counts; /* counts: nothing is timed */
  bool starts_given, views_given;
};

#define SWEEP_OPTIONS_STANDARD                                                 \
  {                                                                            \
    .views = 1, .walk = 1, .starts = 5, .repetitions = 9, .seed = 1,           \
    .timeout = 60, .shard = 1, .shards = 1, .reference = "zbuffer-fast"        \
  }

/* What takes part in every group: an algorithm or a peer, on a number of
 * threads. */
struct entrant {
  const char *name;
  const struct hsr_listed *listed; /* NULL: a peer */
  struct hsr_choice choice;        /* of an algorithm's options */
  const char *kind;                /* "ids", "segments", "filtered", "none";
                                      of peers also "cells", "groups" */
  long threads;
};

struct plan {
  const struct sweep_options *options;
  char **scene; /* names; patterns are resolved */
  size_t n_scenes;
  struct entrant entrant[SWEEP_MOST_ENTRANTS];
  int n_entrants;
  char *peers_program; /* NULL without peers */
  json_t *peers;       /* its list of peers, which owns their names */
};

/* A scene, view and size. Its cells are judged by the same picture, and timed
 * in turn. Or a walk: several views in a row, all of which a round draws. */
struct place {
  const char *scene;
  int view; /* from 1 */
  int walk; /* views; 1: no walk */
  int m, n;
};

/* --- command.c ------------------------------------------------------------ */

/* Reads the command line of hsr bench, argv[0] being "bench". The options
 * borrow from argv, whose words are cut. HSR_E_USAGE; HSR_E_INPUT for a file of
 * cameras. */
enum hsr_status sweep_parse(int argc, char **argv,
                            struct sweep_options *options,
                            struct hsr_error *err);

/* --- merge.c -------------------------------------------------------------- */

/* hsr bench merge, argv[0] being "merge". HSR_E_INPUT if files do not fit
 * together or cannot be read or written; HSR_E_USAGE; HSR_E_NOMEM. */
enum hsr_status command_merge(int argc, char **argv, struct hsr_error *err);

/* --- plan.c --------------------------------------------------------------- */

/* Resolves the patterns of scenes and algorithms. *plan is to be freed also
 * after a failure. HSR_E_USAGE for a name or pattern that matches nothing, or a
 * name that is too long for a record; HSR_E_NOMEM. */
enum hsr_status plan_init(struct plan *plan,
                          const struct sweep_options *options,
                          struct hsr_error *err);
void plan_free(struct plan *plan);

size_t plan_places(const struct plan *plan);
struct place plan_place(const struct plan *plan, size_t k);

/* The key of a cell, as in results.h. */
void plan_key(const struct place *place, const struct entrant *entrant,
              char key[RESULTS_KEY]);

/* Whether the cell is in this shard and --only asks for it. */
bool plan_wants(const struct plan *plan, size_t place,
                const struct entrant *entrant);

/* --- peers.c -------------------------------------------------------------- */

/* Finds hsr-peers and reads its list of peers into the plan. HSR_E_USAGE if
 * there is no hsr-peers; HSR_E_NOMEM. */
enum hsr_status peers_open(struct plan *plan, struct hsr_error *err);

/* Compares a peer's line drawing with the line oracle's, and sets the cell's
 * numbers. Nothing is compared if the judge gives no answer in time. */
void peers_judge(const struct plan *plan, const struct place *place,
                 const char *name, struct cell *cell);

/* --- machine.c ------------------------------------------------------------ */

/* The header record of this run; NULL for lack of memory. */
json_t *sweep_header(const struct sweep_options *options, const char *run,
                     const char *code, int argc, char **argv);

/* Hashes of this program's file and of a scene's faces: 16 hexadecimal digits.
 */
void hash_program(char hash[17]);
void hash_scene(const struct hsr_scene *scene, char hash[17]);

/* --- turns.c -------------------------------------------------------------- */

/* What was measured in one process start of an entrant. */
struct start {
  double import_seconds, adapt_seconds, prepare_seconds;
  double shade_seconds, write_seconds; /* < 0: not measured */
  long before_kb, peak_kb, inner;
  long repetitions; /* how many seconds follow */
  double seconds[SWEEP_MOST_REPETITIONS];
};

struct program;
struct program_job;

struct turn_taker {
  const struct entrant *entrant;
  const struct program_job *job; /* of a program; NULL: one of ours */
  struct program *program;       /* while it runs */
  double adapt_seconds; /* what was done to the scene for it, before it began */
  long rounds;          /* of a program, in a sample */
  bool has_counted;     /* it was asked for its counts */
  json_t *counts;       /* that it told, a new reference; or NULL */
  char why[480];        /* in words, what went wrong with it */
  struct start *starts; /* one for each start; owned by the caller */
  bool has[SWEEP_MOST_STARTS]; /* the starts that are timed */
  int n_starts;                /* to be recorded */
  long need_kb;                /* roughly the memory that it takes */
  enum verdict verdict;        /* RIGHT until something goes wrong */
  enum hsr_status failure; /* why its process ended, if it ended by itself */
};

/* Who hears of a start that is timed, by a function that returns false to end
 * the turns with HSR_E_INPUT; and how long they last. */
struct turn_listener {
  bool (*timed)(void *data, const struct turn_taker *taker, int start);
  void *data;
  /* Judges the picture that a program has drawn last, of this view of the walk,
   * from 0. A wrong one becomes its taker's verdict. Fails as program_read_ids.
   */
  enum hsr_status (*drawn)(void *data, struct turn_taker *taker, int view,
                           struct hsr_error *err);
  const char *name; /* of what is timed, for progress */
  double end;       /* no start is begun after this time, but for the first two;
                       INFINITY: all starts are wanted */
};

/* Starts all takers' processes, as often as the options say, and lets them take
 * turns, in a new order every round. Starts that a taker has already are left
 * out. Takers that do not fit into memory together run in several lots.
 * `random` is the seed of the orders. A taker that fails is left out from then
 * on. HSR_E_NOMEM, also if no more processes can be started; HSR_E_STOPPED
 * after an interrupt. */
enum hsr_status take_turns(const struct plan *plan, const struct place *place,
                           struct turn_taker *taker, int n, uint64_t random,
                           const struct turn_listener *listener,
                           struct hsr_error *err);

/* --- group.c -------------------------------------------------------------- */

/* Notes of what is not recorded yet: journal.h. */
struct journal {
  int file; /* -1: none */
  char *path;
  off_t at; /* the note to be read next */
};

struct sweep {
  const struct plan *plan;
  struct journal journal;
  const char *run;
  char code[17];          /* hash_program */
  struct results results; /* earlier ones, and those of this run */
  int file;               /* -1: none */
  bool is_new;            /* the file was made by this run */
  double begin;           /* hsr_seconds_now() */
};

/* Judges, times and records those cells of a place that are wanted and have no
 * record yet. HSR_E_STOPPED after an interrupt: the cells that were judged are
 * recorded without times. */
enum hsr_status sweep_place(struct sweep *sweep, size_t place,
                            struct hsr_error *err);

/* Writes a record as a whole line, in one go, and adds it to the results. Takes
 * the reference, also on failure. A record of NULL gives HSR_E_NOMEM. */
enum hsr_status sweep_record(struct sweep *sweep, json_t *record,
                             struct hsr_error *err);

/* --- command.c ------------------------------------------------------------ */

/* Runs the plan. Its records go into the file that the options name, if any,
 * and into *results, after those that the file already had. *results is to be
 * freed also after a failure. The words of the command line go into the
 * header. */
enum hsr_status sweep_run(const struct plan *plan, int argc, char **argv,
                          struct results *results, struct hsr_error *err);

/* --- changes.c ------------------------------------------------------------ */

/* Prints how the cells differ from those of the same keys in `old`.
 * HSR_E_DIFFERENCE if any is slower, or is no longer right. */
enum hsr_status print_changes(const struct results *results,
                              const struct results *old, const char *reference,
                              struct hsr_error *err);

/* Prints each cell that is a cliff: it takes over `times` times as long as its
 * module's other cells lead to expect. These are compared by their ratios to the
 * reference, which grows with faces and samples alone; what is expected is the
 * median. HSR_E_NOMEM. */
enum hsr_status print_cliffs(const struct results *results,
                             const char *reference, long times,
                             struct hsr_error *err);

#endif
