/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of hsr bench share. plan.c tells which cells there are;
 * machine.c, on what they run; group.c takes all cells of one scene, view and
 * size: judged first, then timed by turns.c, then recorded; summary.c tells
 * what came of it. */
#ifndef HSR_BENCH_SWEEP_SWEEP_H
#define HSR_BENCH_SWEEP_SWEEP_H

#include "bench/command.h"
#include "bench/judge/judge.h"
#include "bench/results/results.h"

enum {
  SWEEP_MOST_NAMES = 4096,
  SWEEP_MOST_VIEWS = 1000,
  SWEEP_MOST_SIZES = 16,
  SWEEP_MOST_THREADS = 8,
  SWEEP_MOST_ENTRANTS = 256,
  SWEEP_MOST_STARTS = 64,
  SWEEP_MOST_REPETITIONS = 1000
};

struct sweep_options {
  struct option_base base;
  const char *scene[SWEEP_MOST_NAMES];
  int n_scenes;
  const char *algorithm[SWEEP_MOST_ENTRANTS], *peer[SWEEP_MOST_ENTRANTS];
  int n_algorithms, n_peers;
  int m[SWEEP_MOST_SIZES], n[SWEEP_MOST_SIZES], n_sizes;
  long threads[SWEEP_MOST_THREADS];
  int n_threads;
  long views, walk, starts, repetitions, seed, timeout, memory_mb;
  long samples; /* of each picture that are compared; 0: as the scene allows */
  long shard, shards;        /* shard from 1 */
  const char *only;          /* pattern of keys, or NULL */
  const char *output;        /* NULL: nowhere that lasts */
  const char *reference;     /* whose time the others' are divided by */
  const char *baseline;      /* earlier results, or NULL */
  bool resume, list, counts; /* counts: and no times */
};

#define SWEEP_OPTIONS_STANDARD                                                 \
  {                                                                            \
    .views = 1, .walk = 1, .starts = 5, .repetitions = 9, .seed = 1,           \
    .timeout = 60, .shard = 1, .shards = 1, .reference = "zbuffer"             \
  }

/* Who takes part in every group: an algorithm, or a peer, on so many threads.
 */
struct entrant {
  const char *name;
  const struct hsr_listed *listed; /* NULL: a peer */
  struct hsr_choice choice;        /* of an algorithm's options */
  const char *kind;                /* "ids", "segments", "filtered", "none" */
  long threads;
};

struct plan {
  const struct sweep_options *options;
  char **scene; /* names, patterns resolved */
  size_t n_scenes;
  struct entrant entrant[SWEEP_MOST_ENTRANTS];
  int n_entrants;
  char *peers_program; /* NULL without peers */
  json_t *peers;       /* what it lists; owns the peers' names */
};

/* A scene, view and size: cells that are judged by the same picture and timed
 * in turn. Or a walk: so many views in a row, each of which a round draws. */
struct place {
  const char *scene;
  int view; /* from 1 */
  int walk; /* views; 1: no walk */
  int m, n;
};

/* --- plan.c --------------------------------------------------------------- */

/* Resolves the patterns of scenes and algorithms. To be freed also after a
 * failure: HSR_E_USAGE for a name or pattern that matches nothing, or a name
 * that no record can hold; HSR_E_NOMEM. */
enum hsr_status plan_init(struct plan *plan,
                          const struct sweep_options *options,
                          struct hsr_error *err);
void plan_free(struct plan *plan);

size_t plan_places(const struct plan *plan);
struct place plan_place(const struct plan *plan, size_t k);

/* The key of a cell, as in results.h. */
void plan_key(const struct place *place, const struct entrant *entrant,
              char key[RESULTS_KEY]);

/* Whether the cell is of this shard and asked for by --only. */
bool plan_wants(const struct plan *plan, size_t place,
                const struct entrant *entrant);

/* --- peers.c -------------------------------------------------------------- */

/* Finds hsr-peers and what it lists, for the plan. HSR_E_USAGE if there is
 * none; HSR_E_NOMEM. */
enum hsr_status peers_open(struct plan *plan, struct hsr_error *err);

/* How much of a line drawing by a peer differs from the line oracle's; nothing
 * is compared where the judge gives no answer in time. */
void peers_judge(const struct plan *plan, const struct place *place,
                 const char *name, struct cell *cell);

/* --- machine.c ------------------------------------------------------------ */

/* The header record of this run; NULL for lack of memory. */
json_t *sweep_header(const struct sweep_options *options, const char *run,
                     int argc, char **argv);

/* A hash of this program's file, 16 hexadecimal digits; of a scene's faces. */
void hash_program(char hash[17]);
void hash_scene(const struct hsr_scene *scene, char hash[17]);

/* --- turns.c -------------------------------------------------------------- */

/* What one process start of an entrant gave. */
struct start {
  double import_seconds, adapt_seconds, prepare_seconds;
  double shade_seconds, write_seconds; /* < 0: not measured */
  long before_kb, peak_kb, inner;
  double seconds[SWEEP_MOST_REPETITIONS];
};

struct turn_taker {
  const struct entrant *entrant;
  const char *ids_file; /* where the first start leaves its picture; or NULL */
  struct start *starts; /* as many as are asked for; owned by the caller */
  long need_kb;         /* how much memory it takes, about */
  enum verdict verdict; /* RIGHT as long as all goes well */
  enum hsr_status failure; /* why its process ended, if it did by itself */
};

/* Starts all takers' processes, as often as the options say, and lets them take
 * turns, in an order of its own every round. Where they have not room beside
 * each other they do it in several lots. `random` is the seed of the orders.
 * HSR_E_NOMEM, also where there can be no more processes. A taker that fails
 * is left out from there on. */
enum hsr_status take_turns(const struct plan *plan, const struct place *place,
                           struct turn_taker *taker, int n, uint64_t random,
                           struct hsr_error *err);

/* --- group.c -------------------------------------------------------------- */

struct sweep {
  const struct plan *plan;
  const char *run;
  struct results results; /* what there is already, and what comes */
  int file;               /* -1: none */
};

/* Judges, times and records the cells of a place that are wanted and not there
 * yet. */
enum hsr_status sweep_place(struct sweep *sweep, size_t place,
                            struct hsr_error *err);

/* Writes a record, one line at once, and adds it to the results. Takes the
 * reference, also on failure; NULL is HSR_E_NOMEM. */
enum hsr_status sweep_record(struct sweep *sweep, json_t *record,
                             struct hsr_error *err);

/* --- command.c ------------------------------------------------------------ */

/* Runs the plan, into the file that its options name, if they do. *results are
 * its records, after those that the file had; to be freed also after a
 * failure. The words of the command line go into the header. */
enum hsr_status sweep_run(const struct plan *plan, int argc, char **argv,
                          struct results *results, struct hsr_error *err);

/* --- summary.c ------------------------------------------------------------ */

/* Prints the table of the results' cells with the ratios to the reference. */
enum hsr_status print_summary(const struct results *results,
                              const char *reference, struct hsr_error *err);

/* Prints how the cells differ from those of the same keys in `old`.
 * HSR_E_DIFFERENCE if any is slower, or is no longer right. */
enum hsr_status print_changes(const struct results *results,
                              const struct results *old, const char *reference,
                              struct hsr_error *err);

#endif
