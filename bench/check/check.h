/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the files of hsr check share: command.c chooses the scenes, views and
 * sizes to judge; report.c prints the results as lines or, by matrix.c and
 * json.c, as a table or as JSON. */
#ifndef HSR_BENCH_CHECK_H
#define HSR_BENCH_CHECK_H

#include "bench/modules/variant.h"
#include "bench/judge/judge.h"
#include "bench/options/camera.h"
#include "scenes/scenes.h"

enum {
  MOST_SCENES = 4096,
  MOST_SIZES = 16,
  MOST_ALGORITHMS = 128,
  MOST_VIEWS = 1000
};

struct check_options {
  struct option_base base;
  const char *scene[MOST_SCENES];
  int n_scenes;
  struct camera_options camera;
  int m[MOST_SIZES], n[MOST_SIZES], n_sizes;
  struct hsr_variant algorithm[MOST_ALGORITHMS];
  int n_algorithms;
  bool all_algorithms;           /* nobody chose them */
  int view[MOST_VIEWS], n_views; /* from 0, in the order of judging */
  long samples, jobs, timeout;   /* samples 0: as many as the scene allows */
  sem_t *turns;                  /* as many as jobs */
  long first_views;              /* --views; 0: not given */
  const char *order;             /* --order; or NULL */
  bool json, matrix, failures_only;
  const char *differences; /* a folder, or NULL */
  struct hsr_import import;
  bool sort_last;
  long parts;                   /* of --sort-last; 0: as many as ranks */
  bool frames;                  /* --frames: views are frames */
  long first_frame, last_frame; /* of them; view[k] is frame - 1 */
};

/* What a view is called that is judged. */
static inline const char *view_word(const struct check_options *options) {
  return options->frames ? "frame" : "view";
}

/* --- All cells of a scene ------------------------------------------------- */

struct scene_run {
  const struct check_options *options;
  int number; /* in the options */
  char name[MOST_AIMED_NAME];
  struct progress *progress;
  struct hsr_scene *scene;
  struct hsr_world world;
  struct walk walk;      /* of --frames; else .n is 0 */
  struct hsr_view *view; /* one for each size and view, in judging order */
  struct cell *cells;    /* one for each size, view and algorithm; shared */
  size_t cells_size;
};

static inline struct cell *cell_at(const struct scene_run *run, int size,
                                   int view, int algorithm) {
  int picture = size * run->options->n_views + view;
  return &run->cells[picture * run->options->n_algorithms + algorithm];
}

static inline const struct hsr_answer_type *
kind_of(const struct check_options *options, int algorithm) {
  return options->algorithm[algorithm].choice.form.type;
}

/* Whether the algorithm keeps something from one view to the next. */
static inline bool keeps_state(const struct hsr_variant *v) {
  return hsr_choice_flags(v->listed->plain, &v->choice) & HSR_FRAME_STATE;
}

/* Whether it is known that the algorithm draws wrong pictures at times. */
static inline bool is_known_wrong(const struct check_options *options,
                                  int algorithm) {
  const struct hsr_variant *v = &options->algorithm[algorithm];
  return hsr_choice_flags(v->listed->plain, &v->choice) & HSR_KNOWN_WRONG;
}

/* Whether the algorithm draws grids alone, the scene is none, and nobody asked
 * for the algorithm. Its refusal is not told then. */
static inline bool is_left_out(const struct scene_run *run, int algorithm) {
  const struct check_options *o = run->options;
  unsigned subjects = o->algorithm[algorithm].listed->plain->subjects;
  return o->all_algorithms && run->scene->subject == HSR_FACES &&
         !(subjects & 1u << HSR_FACES);
}

/* What became of an algorithm over all views of a size. */
struct outcome {
  enum verdict worst;
  uint64_t mismatches; /* of the build that is timed */
};
struct outcome outcome_of(const struct scene_run *run, int size, int algorithm);

/* Of a scene in parts, `world` tells the number of faces alone. */

/* Judges what algorithms make of a scene that is drawn in parts
 * (bench/check/sort_last.c), and fills the cells of rank 0. run->name is set; all
 * else is made here. Fails as hsr_scene_open_part; HSR_E_USAGE if there are
 * fewer parts than ranks. */
enum hsr_status judge_parts(struct scene_run *run, struct hsr_error *err);

/* Whether an algorithm draws what is summed, so that the answers to the parts of
 * a grid can be added up. */
bool is_summed(const struct check_options *options, int algorithm);

/* Does for those algorithms what judge_parts does for the others
 * (bench/check/sort_last_sums.c). `part` tells how many parts there are, and how
 * many views. Rank 0 has to open the whole scene. */
enum hsr_status judge_summed_parts(struct scene_run *run,
                                   const struct hsr_scene_part *part,
                                   struct hsr_error *err);

/* Makes the views in all sizes: the scene has them. As hsr_view_init. */
enum hsr_status init_views(struct scene_run *run, const struct hsr_scene *scene,
                           struct hsr_error *err);

/* Opens the frames of a scene, the first of which is run->scene, and makes their
 * views in all sizes (bench/check/walk.c). Fails as open_scene; HSR_E_INPUT also
 * if a frame breaks what the first promises. */
enum hsr_status open_walk(struct scene_run *run, struct hsr_error *err);
void close_walk(struct scene_run *run);

/* The last of the views, from 0. */
uint32_t last_view(const struct check_options *options);

/* How many faces are laid out at most; 0 if nobody needs that. */
uint32_t most_laid_out(const struct check_options *options);

/* --- Totals --------------------------------------------------------------- */

struct totals {
  uint64_t compared
      [HSR_MOST_ANSWER_TYPES]; /* places, by the number of the first kind
                                            that calls them so */
  uint64_t mismatches, depths, depths_exact;
  uint64_t counting; /* mismatches of builds that count, where they differ from
                        those of the build that is timed */
  uint64_t expected; /* mismatches of algorithms that are known to be wrong */
  int failures;      /* cells that are neither ok nor refused */
  int crashed, late; /* of these */
  struct json_t *cells;
};

/* --- scenes.c ------------------------------------------------------------- */

/* Judges all scenes and reports them in their order. What fails ends it: the
 * scenes before it are reported. */
enum hsr_status check_scenes(const struct check_options *options,
                             struct totals *totals, struct hsr_error *err);

/* --- The report ----------------------------------------------------------- */

void report_begin(const struct check_options *options, struct totals *totals);

/* Prints a scene's cells and adds them up. HSR_E_NOMEM, also if an algorithm
 * had too little memory. */
enum hsr_status report_scene(const struct scene_run *run, struct totals *totals,
                             struct hsr_error *err);

enum hsr_status report_end(const struct check_options *options,
                           struct totals *totals, struct hsr_error *err);
void report_abandon(struct totals *totals);

/* --- matrix.c ------------------------------------------------------------- */

/* A row for each scene and size, with a column for each algorithm: the
 * mismatches over all views, or the worst verdict. */
void matrix_begin(const struct check_options *options);
void matrix_scene(const struct scene_run *run);

/* --- json.c --------------------------------------------------------------- */

/* New references, or NULL for lack of memory. */
struct json_t *cell_json(const struct scene_run *run, int size, int view,
                         int algorithm);
struct json_t *totals_json(const struct totals *totals);

#endif
