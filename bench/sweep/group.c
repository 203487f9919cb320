/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of one scene, view and size: judged, timed, recorded. */
#include "algorithms/setup.h"
#include "bench/modules/variant.h"
#include "bench/options/scene.h"
#include "bench/programs/module.h"
#include "bench/results/json.h"
#include "bench/run/stage.h"
#include "bench/run/table1.h"
#include "common/statistics/depth.h"
#include "bench/run/terminate.h"
#include "bench/sweep/journal.h"
#include "bench/sweep/programs.h"
#include "bench/terminal/terminal.h"
#include "common/answers/kinds/segments.h"
#include "common/files/json/json.h"

#include <errno.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* Memory in which the judges' processes leave their findings. */
struct shared {
  struct hsr_table1 table1; /* of the first view */
  struct hsr_overlaps overlaps;
  bool has_table1;     /* and the overlaps */
  struct cell cells[]; /* one for each entrant. Of a walk, one for each view and
                          entrant, until add_walk adds those of all views to
                          those of the first */
};

struct place_run {
  struct sweep *sweep;
  struct place place;
  size_t number;
  struct stage stage;
  struct hsr_view *view; /* the views of the walk */
  int *view_number;      /* the number of each, from 0 */
  char scene_hash[17];
  const struct entrant *entrant[SWEEP_MOST_ENTRANTS]; /* those to do */
  int n;
  struct shared *shared;
  bool kept[SWEEP_MOST_ENTRANTS];  /* judged before: by the journal */
  bool noted[SWEEP_MOST_ENTRANTS]; /* in the journal */
  uint32_t *picture;    /* the oracle's of all views, shared; NULL unless
                        programs take part, which the peers are, too */
  uint32_t *drawn;      /* a program's */
  struct wanted *lines; /* the line oracle's, of all views; NULL unless a
                           program draws lines rightly */
  struct hsr_drawing lines_drawn;               /* a program's */
  struct hsr_setup triangles;                   /* for programs of users */
  struct program_job job[SWEEP_MOST_ENTRANTS];  /* for programs */
  struct turn_taker taker[SWEEP_MOST_ENTRANTS]; /* entrants that are timed */
};

static bool is_peer(const struct entrant *e) {
  return !e->listed;
}

/* A program of a user's. */
static bool is_program(const struct entrant *e) {
  return e->listed && program_is(e->listed->plain);
}

static size_t picture_size(const struct place_run *run) {
  return (size_t)run->place.m * (size_t)run->place.n * sizeof *run->picture;
}

/* --- Recording ------------------------------------------------------------ */

/* Writes all in one piece, if the file takes it so. */
static bool write_all(int file, const char *text, size_t length) {
  for (size_t done = 0; done < length;) {
    ssize_t n = write(file, text + done, length - done);
    if (n < 0 && errno != EINTR)
      return false;
    done += n > 0 ? (size_t)n : 0;
  }
  return true;
}

enum hsr_status sweep_record(struct sweep *sweep, json_t *record,
                             struct hsr_error *err) {
  char *text =
      record ? json_dumps(record, JSON_COMPACT | JSON_ENSURE_ASCII) : NULL;
  enum hsr_status status = text ? HSR_OK : hsr_fail_nomem(err);
  if (!status && sweep->file >= 0) {
    size_t length = strlen(text);
    text[length] = '\n'; /* in place of the final zero */
    if (!write_all(sweep->file, text, length + 1))
      status = hsr_fail(err, HSR_E_INPUT, "%s: %s",
                        sweep->plan->options->output, strerror(errno));
  }
  if (!status)
    status = results_add(&sweep->results, record, err);
  free(text);
  json_decref(record);
  return status;
}

/* --- Judging -------------------------------------------------------------- */

static void judge_form(const struct place_run *run, struct hsr_form form) {
  const struct sweep_options *o = run->sweep->plan->options;
  struct hsr_variant algorithm[SWEEP_MOST_ENTRANTS];
  long threads[SWEEP_MOST_ENTRANTS];
  struct group group = {
      .algorithm = algorithm,
      .threads = threads,
      .timeout = o->timeout,
      .memory_mb = o->memory_mb,
      .samples = samples_to_compare(&run->stage.world, &form, o->samples),
      .world = &run->stage.world,
      .form = form,
      .view = run->view,
      .number = run->view_number,
      .left_out = run->kept,
      .n_views = run->place.walk,
      .cells = run->shared->cells,
      .picture = run->picture};
  /* Peers come after all algorithms. */
  for (int k = 0; k < run->n && run->entrant[k]->listed; k++) {
    algorithm[k].listed = run->entrant[k]->listed;
    algorithm[k].choice = run->entrant[k]->choice;
    threads[k] = run->entrant[k]->threads;
    group.n_algorithms++;
  }
  end_process((int)judge_group(&group));
}

/* Measures Table I, if the faces are laid out. */
static void judge_statistics(const struct place_run *run) {
  if (hsr_is_roster(&run->stage.world))
    end_process(HSR_OK);
  enum hsr_status status =
      measure_table1(&run->stage.world, run->view, &run->shared->table1, NULL);
  if (!status)
    status = hsr_overlaps_measure(&run->stage.world, run->view,
                                  &run->shared->overlaps, NULL);
  run->shared->has_table1 = !status;
  end_process((int)status);
}

/* Lists the forms to judge, each once. Peers are judged by ids. */
static int list_forms(const struct place_run *run,
                      struct hsr_form form[SWEEP_MOST_ENTRANTS + 1]) {
  int n = 0;
  if (run->picture)
    form[n++] = hsr_form_standard(HSR_IDS);
  for (int k = 0; k < run->n && run->entrant[k]->listed; k++) {
    if (run->kept[k])
      continue;
    const struct hsr_form *its = &run->entrant[k]->choice.form;
    bool known = !oracle_of(its->type);
    for (int i = 0; i < n; i++)
      known |= hsr_same_form(&form[i], its);
    if (!known)
      form[n++] = *its;
  }
  return n;
}

/* Adds the findings on a later picture; the worst verdict counts for all. */
static void add_cell(struct cell *sum, const struct cell *cell) {
  if (cell->verdict > sum->verdict) {
    sum->verdict = cell->verdict;
    sum->failure = cell->failure;
    memcpy(sum->refusal, cell->refusal, sizeof sum->refusal);
  }
  sum->compared += cell->compared;
  sum->mismatches += cell->mismatches;
  sum->counting_mismatches += cell->counting_mismatches;
  for (int c = 0; c < HSR_MAX_COUNTERS; c++)
    sum->count[c] += cell->count[c];
  for (int c = 0; c < HSR_N_CULLS; c++)
    sum->culled[c] += cell->culled[c];
  sum->depths_compared += cell->depths_compared;
  sum->depths_exact += cell->depths_exact;
}

/* Adds up the entrant's cells of a walk, in which peers take no part. */
static void add_walk(const struct place_run *run, int k) {
  for (int view = 1; view < run->place.walk; view++)
    add_cell(&run->shared->cells[k], &run->shared->cells[view * run->n + k]);
}

/* --- The journal ---------------------------------------------------------- */

static void key_of(const struct place_run *run, int k, char key[RESULTS_KEY]) {
  plan_key(&run->place, run->entrant[k], key);
}

/* Whether all views of an algorithm are judged. */
static bool is_judged(const struct place_run *run, int k) {
  for (int view = 0; view < run->place.walk; view++)
    if (!__atomic_load_n(&run->shared->cells[view * run->n + k].done,
                         __ATOMIC_ACQUIRE))
      return false;
  return run->entrant[k]->listed;
}

/* Notes what is judged and not noted yet. */
static bool note_judged(struct place_run *run) {
  for (int k = 0; k < run->n; k++) {
    char key[RESULTS_KEY];
    if (run->noted[k] || !is_judged(run, k))
      continue;
    run->noted[k] = true;
    add_walk(run, k);
    key_of(run, k, key);
    if (!journal_judged(&run->sweep->journal, key, run->scene_hash,
                        &run->shared->cells[k]))
      return false;
  }
  return true;
}

static bool note_timed(void *data, const struct turn_taker *taker, int start) {
  struct place_run *run = data;
  char key[RESULTS_KEY];
  plan_key(&run->place, taker->entrant, key);
  return !taker->entrant->listed ||
         journal_timed(&run->sweep->journal, key, run->scene_hash, start,
                       &taker->starts[start]);
}

/* The entrant that a note is about; -1: none of them, or of another scene. */
static int find_entrant(const struct place_run *run, const struct note *note) {
  if (strcmp(note->scene_hash, run->scene_hash))
    return -1;
  for (int k = 0; k < run->n; k++) {
    char key[RESULTS_KEY];
    key_of(run, k, key);
    if (!strcmp(key, note->key))
      return k;
  }
  return -1;
}

/* Takes over what the journal says was judged. */
static void read_judged(struct place_run *run) {
  struct note note;
  journal_rewind(&run->sweep->journal);
  while (journal_next(&run->sweep->journal, &note)) {
    int k = note.start < 0 ? find_entrant(run, &note) : -1;
    if (k < 0)
      continue;
    run->shared->cells[k] = note.cell;
    run->kept[k] = run->noted[k] = true;
  }
}

/* Takes over the starts that were timed. */
static void read_timed(struct place_run *run) {
  struct note note;
  journal_rewind(&run->sweep->journal);
  while (journal_next(&run->sweep->journal, &note)) {
    int k = note.start < 0 ? -1 : find_entrant(run, &note);
    if (k < 0 || !run->taker[k].starts ||
        note.start >= run->sweep->plan->options->starts ||
        note.times.repetitions != run->sweep->plan->options->repetitions)
      continue;
    run->taker[k].starts[note.start] = note.times;
    run->taker[k].has[note.start] = true;
  }
}

/* "1 of 2, house 1 512x512" */
static void name_place(const struct place_run *run,
                       char name[RESULTS_KEY + 40]) {
  char key[RESULTS_KEY];
  plan_key(&run->place, NULL, key);
  snprintf(name, RESULTS_KEY + 40, "%zu of %zu, %s", run->number + 1,
           plan_places(run->sweep->plan), key);
}

/* --- Judging all ---------------------------------------------------------- */

/* Waits for all processes, and notes what they have judged. After an interrupt
 * it waits no longer. */
static bool wait_and_note(struct place_run *run) {
  char name[RESULTS_KEY + 40], text[PROGRESS_TEXT];
  name_place(run, name);
  struct progress progress = progress_begin(stderr);
  bool good = true;
  pid_t ended;
  while (!interrupt_came() &&
         ((ended = waitpid(-1, NULL, WNOHANG)) >= 0 || errno == EINTR)) {
    if (ended)
      continue;
    int judged = 0;
    good = note_judged(run) && good;
    snprintf(text, sizeof text, "%.150s", name);
    for (int k = 0; k < run->n; k++) {
      judged += run->noted[k];
      if (!run->noted[k])
        progress_add(text, run->entrant[k]->name);
    }
    progress_close(text);
    progress_tell(&progress, (size_t)judged, (size_t)run->n,
                  "algorithms judged", text);
    nanosleep(&(struct timespec){0, 5000000}, NULL);
  }
  progress_end(&progress);
  return note_judged(run) && good;
}

/* Runs Table I and the judges of all forms, each in a process, at the same
 * time: nothing is timed yet. */
static enum hsr_status judge_all(struct place_run *run, struct hsr_error *err) {
  fflush(NULL);
  pid_t parent = getpid(), child = fork();
  if (child == 0) {
    end_with_parent(parent);
    judge_statistics(run);
  }
  bool good = child > 0;
  struct hsr_form form[SWEEP_MOST_ENTRANTS + 1];
  int n_forms = list_forms(run, form);
  for (int k = 0; k < n_forms && good; k++) {
    child = fork();
    if (child == 0) {
      end_with_parent(parent);
      judge_form(run, form[k]);
    }
    good = child > 0;
  }
  if (!wait_and_note(run))
    return hsr_fail(err, HSR_E_INPUT, "the journal cannot be written: %s",
                    strerror(errno));
  if (interrupt_came())
    return interrupt_fail(err);
  for (int k = 0; k < run->n; k++) {
    struct cell *cell = &run->shared->cells[k];
    if (!run->noted[k])
      add_walk(run, k);
    if (!run->entrant[k]->listed || cell->verdict != PENDING)
      continue;
    cell->verdict = REFUSED;
    snprintf(cell->refusal, sizeof cell->refusal,
             "refused, %s cannot be judged: the oracle failed",
             run->entrant[k]->name);
  }
  return good ? HSR_OK : hsr_fail_nomem(err);
}

/* --- Timing --------------------------------------------------------------- */

/* An oracle has no build that does not count. */
static bool is_oracle(const struct entrant *entrant) {
  return entrant->listed && entrant->listed->plain->flags & HSR_JUDGE;
}

/* What a program is started for. A peer knows the scene by its name. */
static void make_job(struct place_run *run, int k) {
  const struct entrant *e = run->entrant[k];
  bool peer = is_peer(e);
  run->job[k] =
      (struct program_job){.path = peer ? run->sweep->plan->peers_program
                                        : program_path(e->listed->plain),
                           .name = e->name,
                           .word = peer ? e->name : NULL,
                           .answer = e->kind,
                           .world = peer ? NULL : &run->stage.world,
                           .triangles = peer ? NULL : run->triangles.world,
                           .scene = run->place.scene,
                           .number = run->place.view,
                           .view = run->view,
                           .n_views = run->place.walk,
                           .threads = e->threads,
                           .memory_mb = run->sweep->plan->options->memory_mb,
                           .stopped = interrupt_came};
}

/* The triangles of the scene, for the first program that is right. */
static enum hsr_status make_triangles(struct place_run *run,
                                      struct hsr_error *err) {
  return run->triangles.algorithm
             ? HSR_OK
             : hsr_setup_init(&run->triangles, &program_demands, NULL,
                              &run->stage.world, err);
}

/* Asks the line oracle, for the first program that draws lines rightly. It was asked
 * before, in a process of its own, and took no longer than it may. */
static enum hsr_status ask_lines(struct place_run *run, int k,
                                 struct hsr_error *err) {
  const struct hsr_form *form = &run->entrant[k]->choice.form;
  struct group group = {.world = &run->stage.world,
                        .form = *form,
                        .view = run->view,
                        .number = run->view_number,
                        .n_views = run->place.walk};
  if (run->lines || form->type != HSR_SEGMENTS)
    return HSR_OK;
  run->lines = calloc((size_t)run->place.walk, sizeof *run->lines);
  return run->lines
             ? ask_oracle(&group, oracle_of(HSR_SEGMENTS), run->lines, err)
             : hsr_fail_nomem(err);
}

static void free_lines(struct place_run *run) {
  hsr_drawing_free(&run->lines_drawn);
  free_wanted(&(struct group){.n_views = run->place.walk}, run->lines);
}

/* Lines up those to be timed. Peers are timed whatever they draw. */
static enum hsr_status line_up(struct place_run *run, struct hsr_error *err) {
  const struct sweep_options *o = run->sweep->plan->options;
  for (int k = 0; k < run->n; k++) {
    bool peer = is_peer(run->entrant[k]);
    struct cell *cell = &run->shared->cells[k];
    if (peer)
      cell->verdict = RIGHT;
    struct turn_taker *taker = &run->taker[k];
    *taker = (struct turn_taker){.entrant = run->entrant[k],
                                 .need_kb = cell->peak_kb,
                                 .verdict = cell->verdict};
    if (is_program(run->entrant[k]) && cell->verdict == RIGHT) {
      enum hsr_status status = make_triangles(run, err);
      if (!status)
        status = ask_lines(run, k, err);
      if (status)
        return status;
      taker->adapt_seconds = run->triangles.adapt_seconds;
    }
    if (peer || is_program(run->entrant[k])) {
      make_job(run, k);
      taker->job = &run->job[k];
    }
    if (is_oracle(taker->entrant))
      taker->verdict = REFUSED;
    else if (cell->verdict == RIGHT) {
      taker->starts = calloc((size_t)o->starts, sizeof *taker->starts);
      if (!taker->starts)
        return hsr_fail_nomem(err);
    }
  }
  return HSR_OK;
}

static bool names_cells(const struct entrant *peer) {
  return !strcmp(peer->kind, "cells");
}

/* What a peer should have at a sample where the oracle has this face: the face,
 * or the cell that it belongs to. */
static uint32_t wanted_of(const struct place_run *run, int k, uint32_t face) {
  uint32_t cell;
  int side;
  if (!names_cells(run->entrant[k]) || face == HSR_BACKGROUND)
    return face;
  hsr_grid_face(run->stage.scene->grid, face, &cell, &side);
  return cell;
}

/* Compares the picture of a view that a program has drawn last with the oracle's,
 * if there is one. Returns how many samples of it differ. */
static uint64_t compare_picture(const struct place_run *run, int k, int view,
                                uint64_t *compared) {
  size_t n = picture_size(run) / sizeof *run->picture;
  const uint32_t *right = run->picture + (size_t)view * n;
  uint64_t differing = 0;
  *compared = 0;
  for (size_t s = 0; s < n; s++)
    if (right[s] != HSR_NOT_WRITTEN) {
      ++*compared;
      differing += run->drawn[s] != wanted_of(run, k, right[s]);
    }
  return differing;
}

/* Compares the drawing of a view that a program has made last. */
static enum hsr_status judge_lines(struct place_run *run, int k, int view,
                                   struct turn_taker *taker,
                                   struct hsr_error *err) {
  const struct hsr_answer *right = &run->lines[view].answer;
  struct hsr_drawing_difference found;
  enum hsr_status status =
      program_read_segments(taker->program, NULL, &run->lines_drawn, err);
  if (status)
    return status;
  hsr_drawing_compare(
      &run->lines_drawn, hsr_answer_drawing_of(right),
      hsr_makes_how(run->entrant[k]->listed->plain, HSR_SEGMENTS) &
          HSR_VISIBLE_ONLY,
      &found);
  if (!found.differing)
    return HSR_OK;
  run->shared->cells[k].compared = found.edges;
  run->shared->cells[k].mismatches = found.differing;
  taker->verdict = WRONG;
  return HSR_OK;
}

/* A peer is timed whatever it draws. A program was judged before, and has no time
 * if it draws another picture now. */
static enum hsr_status judge_drawn(void *data, struct turn_taker *taker,
                                   int view, struct hsr_error *err) {
  struct place_run *run = data;
  int k = (int)(taker - run->taker);
  const struct entrant *e = run->entrant[k];
  struct cell *cell = &run->shared->cells[k];
  uint64_t compared;
  if (!is_peer(e) && !strcmp(e->kind, HSR_SEGMENTS->name))
    return judge_lines(run, k, view, taker, err);
  if (strcmp(e->kind, "ids") != 0 && !names_cells(e))
    return HSR_OK;
  enum hsr_status status = program_read_ids(taker->program, run->drawn, err);
  if (status)
    return status;
  uint64_t differing = compare_picture(run, k, view, &compared);
  if (!is_peer(e) && !differing)
    return HSR_OK;
  cell->compared = compared;
  cell->mismatches = differing;
  if (!is_peer(e))
    taker->verdict = WRONG;
  return HSR_OK;
}

/* Times are recorded only together with mismatches: a peer whose answer could
 * not be compared has no times. */
static void judge_peer(struct place_run *run, int k) {
  const struct entrant *peer = run->entrant[k];
  struct cell *cell = &run->shared->cells[k];
  if (!strcmp(peer->kind, "segments") || !strcmp(peer->kind, "groups"))
    peers_judge(run->sweep->plan, &run->place, peer->name, cell);
  if (cell->mismatches)
    cell->verdict = WRONG;
  if (cell->verdict == RIGHT && !cell->compared && strcmp(peer->kind, "none")) {
    cell->verdict = run->taker[k].verdict = REFUSED;
    snprintf(cell->refusal, sizeof cell->refusal,
             "refused, the drawing of %s could not be judged", peer->name);
  }
}

/* Peers are not asked before they are started. */
static void note_refusal(const struct entrant *peer, struct cell *cell) {
  cell->verdict = REFUSED;
  snprintf(cell->refusal, sizeof cell->refusal,
           "refused, %s does not draw such scenes", peer->name);
}

/* When the place should be done, if the sweep has a budget. */
static double end_of(const struct place_run *run) {
  const struct plan *plan = run->sweep->plan;
  if (!plan->options->budget)
    return INFINITY;
  return run->sweep->begin + (double)plan->options->budget *
                                 (double)(run->number + 1) /
                                 (double)plan_places(plan);
}

static enum hsr_status time_all(struct place_run *run, struct hsr_error *err) {
  const struct sweep_options *o = run->sweep->plan->options;
  enum hsr_status status = line_up(run, err);
  if (!status)
    read_timed(run);
  char name[RESULTS_KEY + 40];
  name_place(run, name);
  struct turn_listener listener = {note_timed, run, judge_drawn, name,
                                   end_of(run)};
  if (!status && o->starts && !o->counts)
    status =
        take_turns(run->sweep->plan, &run->place, run->taker, run->n,
                   (uint64_t)o->seed * 1000003u + run->number, &listener, err);
  if (status)
    return status;
  for (int k = 0; k < run->n; k++) {
    struct cell *cell = &run->shared->cells[k];
    struct turn_taker *taker = &run->taker[k];
    if (is_program(run->entrant[k]) && taker->verdict == RIGHT &&
        !taker->has_counted)
      program_turn_count(run->sweep->plan, taker);
    if (cell->verdict == RIGHT && !is_oracle(run->entrant[k])) {
      cell->verdict = taker->verdict;
      cell->failure = taker->failure;
      memcpy(cell->why, taker->why, sizeof cell->why);
    }
    if (cell->verdict == CRASH && cell->failure == HSR_E_REFUSED)
      note_refusal(run->entrant[k], cell);
    if (!run->entrant[k]->listed)
      judge_peer(run, k);
  }
  return HSR_OK;
}

/* --- Records -------------------------------------------------------------- */

static json_t *table1_json(const struct shared *shared) {
  json_t *table = json_object();
#define X(field, symbol, meaning)                                              \
  json_object_set_new(table, symbol,                                           \
                      shared->has_table1                                       \
                          ? number_or_null(shared->table1.field)               \
                          : json_null());
  HSR_TABLE1(X)
#undef X
  return table;
}

static json_t *overlap(const struct shared *shared, double f) {
  return shared->has_table1 ? number_or_null(f) : json_null();
}

static json_t *overlaps_json(const struct shared *shared) {
  const struct hsr_overlaps *o = &shared->overlaps;
  return json_pack("{so so so}", "x", overlap(shared, o->f_x), "y",
                   overlap(shared, o->f_y), "z", overlap(shared, o->f_z));
}

/* Adds the walk to a record, if there is one. Takes and returns the reference.
 */
static json_t *with_walk(const struct place_run *run, json_t *record) {
  if (run->place.walk == 1 ||
      !json_object_set_new(record, "walk", json_integer(run->place.walk)))
    return record;
  json_decref(record);
  return NULL;
}

static json_t *view_record(const struct place_run *run) {
  return with_walk(run,
                   json_pack("{ss ss ss ss si si si so so}", "record", "view",
                             "run", run->sweep->run, "scene", run->place.scene,
                             "scene_hash", run->scene_hash, "view",
                             run->place.view, "width", run->place.m, "height",
                             run->place.n, "table1", table1_json(run->shared),
                             "overlaps", overlaps_json(run->shared)));
}

static json_t *seconds_or_null(double seconds) {
  return seconds < 0 ? json_null() : json_real(seconds);
}

static json_t *start_json(const struct start *start, long repetitions) {
  json_t *seconds = json_array();
  for (long k = 0; k < repetitions; k++)
    hsr_json_append(&seconds, json_real(start->seconds[k]));
  return json_pack("{s{so so so so so} s{so sI} sI so}", "phases", "import",
                   seconds_or_null(start->import_seconds), "adapt",
                   seconds_or_null(start->adapt_seconds), "prepare",
                   seconds_or_null(start->prepare_seconds), "shade",
                   seconds_or_null(start->shade_seconds), "write",
                   seconds_or_null(start->write_seconds), "memory_kb", "before",
                   start->before_kb < 0
                       ? json_null()
                       : json_integer((json_int_t)start->before_kb),
                   "peak", (json_int_t)start->peak_kb, "inner",
                   (json_int_t)start->inner, "seconds", seconds);
}

/* The times, if every start was timed to its end. */
static json_t *starts_json(const struct place_run *run, int k) {
  const struct sweep_options *o = run->sweep->plan->options;
  const struct turn_taker *taker = &run->taker[k];
  json_t *starts = json_array();
  if (!o->counts && taker->verdict == RIGHT && taker->starts)
    for (long s = 0; s < taker->n_starts; s++)
      hsr_json_append(&starts, start_json(&taker->starts[s], o->repetitions));
  return starts;
}

static json_t *counts_json(const struct place_run *run, int k) {
  const struct hsr_listed *listed = run->entrant[k]->listed;
  const struct cell *cell = &run->shared->cells[k];
  if (!listed || (cell->verdict != RIGHT && cell->verdict != WRONG))
    return json_null();
  if (is_program(run->entrant[k]))
    return run->taker[k].counts ? json_incref(run->taker[k].counts)
                                : json_null();
  json_t *counts = json_object();
  const struct hsr_counter *c = listed->counting->counters;
  for (int i = 0; c && c[i].name; i++)
    json_object_set_new(counts, c[i].name,
                        json_integer((json_int_t)cell->count[i]));
  return counts;
}

/* The faces that the core left out; null: nobody counted. */
static json_t *culled_json(const struct place_run *run, int k) {
  const struct cell *cell = &run->shared->cells[k];
  if (!run->entrant[k]->listed || is_program(run->entrant[k]))
    return json_null();
  json_t *culled = json_object();
  for (int c = 0; c < HSR_N_CULLS; c++)
    if (cell->culled[c])
      json_object_set_new(culled, hsr_cull_name[c],
                          json_integer((json_int_t)cell->culled[c]));
  return culled;
}

static json_t *depths_json(const struct cell *cell) {
  if (!cell->depths_compared)
    return json_null();
  return json_pack("{sI sI}", "compared", (json_int_t)cell->depths_compared,
                   "exact", (json_int_t)cell->depths_exact);
}

/* Told only where the counting build differs from the one that is timed. */
static json_t *counting_json(const struct cell *cell) {
  return cell->counting_mismatches == cell->mismatches
             ? NULL
             : json_integer((json_int_t)cell->counting_mismatches);
}

static const char *status_name(const struct cell *cell) {
  if (cell->verdict == CRASH && cell->failure == HSR_E_NOMEM)
    return "memory";
  return verdict_name(cell->verdict);
}

/* Why there is no time, or what was compared, in words; `text` is scratch for
 * them. */
static const char *reason_of(const struct sweep_options *o,
                             const struct entrant *entrant,
                             const struct cell *cell, char text[80]) {
  if (cell->refusal[0])
    return cell->refusal;
  if (cell->verdict == TIMEOUT && cell->why[0])
    return cell->why;
  if (cell->verdict == TIMEOUT)
    snprintf(text, 80, "a picture took longer than %ld s", o->timeout);
  else if (cell->verdict == CRASH && cell->failure == HSR_E_NOMEM)
    snprintf(text, 80, "took more memory than there was");
  else if (cell->verdict == CRASH && cell->why[0])
    return cell->why;
  else if (cell->compared && names_cells(entrant))
    return "compared by cells, not by their sides";
  else if (cell->compared && !strcmp(entrant->kind, "groups"))
    return "a group is wrong if it is called hidden and shows a face";
  else
    return NULL;
  return text;
}

static json_t *cell_record(const struct place_run *run, int k) {
  const struct entrant *e = run->entrant[k];
  const struct cell *cell = &run->shared->cells[k];
  char reason[80];
  bool known_wrong =
      e->listed &&
      hsr_choice_flags(e->listed->plain, &e->choice) & HSR_KNOWN_WRONG;
  json_t *record = json_pack(
      "{ss ss ss si si si ss sb sb ss sI ss sI so* sI ss? so so so so so}",
      "record", "cell", "run", run->sweep->run, "scene", run->place.scene,
      "view", run->place.view, "width", run->place.m, "height", run->place.n,
      "algorithm", e->name, "peer", !e->listed, "known_wrong", known_wrong,
      "kind", e->kind, "threads", (json_int_t)e->threads, "status",
      status_name(cell), "mismatches", (json_int_t)cell->mismatches,
      "counting_mismatches", counting_json(cell), "compared",
      (json_int_t)cell->compared, "reason",
      reason_of(run->sweep->plan->options, e, cell, reason), "adapted",
      adapted_json(cell), "counts", counts_json(run, k), "culled",
      culled_json(run, k), "depths", depths_json(cell), "starts",
      starts_json(run, k));
  return with_walk(run, record);
}

/* Records the view and its cells; those that were judged, if not `all`. */
static enum hsr_status record(struct place_run *run, bool all,
                              struct hsr_error *err) {
  enum hsr_status status = sweep_record(run->sweep, view_record(run), err);
  for (int k = 0; k < run->n && !status; k++)
    if (all || run->noted[k])
      status = sweep_record(run->sweep, cell_record(run, k), err);
  if (!status && run->sweep->file >= 0)
    fdatasync(run->sweep->file);
  return status;
}

/* --- A place -------------------------------------------------------------- */

/* Whether a recorded cell has everything that is asked for. If it was only
 * counted, its times may be missing. */
static bool is_done(const json_t *cell, const struct entrant *entrant,
                    const struct sweep_options *o) {
  const char *status = json_string_value(json_object_get(cell, "status"));
  return cell && (o->counts || is_oracle(entrant) || !status ||
                  strcmp(status, "ok") != 0 ||
                  json_array_size(json_object_get(cell, "starts")) > 0);
}

/* Chooses the entrants whose cells are wanted and not yet recorded, in the
 * order of the plan: algorithms first. */
static void choose_entrants(struct place_run *run) {
  const struct plan *plan = run->sweep->plan;
  for (int k = 0; k < plan->n_entrants; k++) {
    char key[RESULTS_KEY];
    plan_key(&run->place, &plan->entrant[k], key);
    if (plan_wants(plan, run->number, &plan->entrant[k]) &&
        !is_done(results_cell(&run->sweep->results, key), &plan->entrant[k],
                 plan->options))
      run->entrant[run->n++] = &plan->entrant[k];
  }
}

/* Checks that the scene is still the same: it may be a file. */
static enum hsr_status check_scene(const struct place_run *run,
                                   struct hsr_error *err) {
  char key[RESULTS_KEY];
  plan_key(&run->place, NULL, key);
  const char *before = json_string_value(
      json_object_get(results_view(&run->sweep->results, key), "scene_hash"));
  if (!before || !strcmp(before, run->scene_hash))
    return HSR_OK;
  return hsr_fail(err, HSR_E_INPUT,
                  "--resume: %.300s is another scene than before",
                  run->place.scene);
}

/* Peers among them. */
static bool has_programs(const struct place_run *run) {
  bool any = false;
  for (int k = 0; k < run->n; k++)
    any |= is_peer(run->entrant[k]) || is_program(run->entrant[k]);
  return any;
}

/* How many faces are laid out at most; 0 if nobody needs that. */
static uint32_t most_laid_out(const struct place_run *run) {
  uint32_t most = 0;
  for (int k = 0; k < run->n; k++) {
    const struct entrant *its = run->entrant[k];
    uint32_t own = its->listed ? most_to_judge(its->listed, &its->choice)
                               : HSR_MOST_LAID_OUT;
    most = own > most ? own : most;
  }
  return most;
}

static size_t shared_size(const struct place_run *run) {
  return sizeof *run->shared +
         (size_t)(run->n * run->place.walk) * sizeof *run->shared->cells;
}

/* After an interrupt: records what was judged, if anything was. Its starts stay
 * in the journal. */
static enum hsr_status record_judged(struct place_run *run,
                                     struct hsr_error *err) {
  bool any = false;
  for (int k = 0; k < run->n; k++)
    any |= run->noted[k];
  enum hsr_status status = any ? record(run, false, err) : HSR_OK;
  return status ? status : interrupt_fail(err);
}

static enum hsr_status choose_views(struct place_run *run,
                                    struct hsr_error *err) {
  const struct place *p = &run->place;
  run->view = calloc((size_t)p->walk, sizeof *run->view);
  run->view_number = calloc((size_t)p->walk, sizeof *run->view_number);
  if (!run->view || !run->view_number)
    return hsr_fail_nomem(err);
  for (int k = 0; k < p->walk; k++)
    run->view_number[k] = p->view - 1 + k;
  return stage_walk(&run->stage, p->view, p->walk, run->view, err);
}

/* Says what was left out of a scene, with its first place. */
static void say_scene(const struct place_run *run) {
  const struct hsr_import *import = &run->stage.imported;
  const char *name = run->place.scene;
  if (!run->number ||
      strcmp(plan_place(run->sweep->plan, run->number - 1).scene, name))
    say_opened(name, import->notes, import->n_dropped,
               run->stage.scene->enlarged);
}

static enum hsr_status open_place(struct place_run *run,
                                  struct hsr_error *err) {
  const struct place *p = &run->place;
  enum hsr_status status =
      stage_open(&run->stage, p->scene, most_laid_out(run),
                 p->view + p->walk - 1, p->m, p->n, 1, err);
  if (!status)
    say_scene(run);
  if (!status)
    status = choose_views(run, err);
  if (status)
    return status;
  hash_scene(run->stage.scene, run->scene_hash);
  status = check_scene(run, err);
  if (status)
    return status;
  run->shared = shared_memory(shared_size(run));
  if (!run->shared)
    return hsr_fail_nomem(err);
  read_judged(run);
  if (!has_programs(run))
    return HSR_OK;
  run->picture = shared_memory((size_t)run->place.walk * picture_size(run));
  run->drawn = malloc(picture_size(run));
  return run->picture && run->drawn ? HSR_OK : hsr_fail_nomem(err);
}

static void close_place(struct place_run *run) {
  for (int k = 0; k < run->n; k++) {
    free(run->taker[k].starts);
    json_decref(run->taker[k].counts);
  }
  if (run->picture)
    munmap(run->picture, (size_t)run->place.walk * picture_size(run));
  free(run->drawn);
  free_lines(run);
  if (run->triangles.algorithm)
    hsr_setup_free(&run->triangles);
  if (run->shared)
    munmap(run->shared, shared_size(run));
  free(run->view);
  free(run->view_number);
  stage_close(&run->stage);
  free(run);
}

enum hsr_status sweep_place(struct sweep *sweep, size_t number,
                            struct hsr_error *err) {
  struct place_run *run = calloc(1, sizeof *run);
  if (!run)
    return hsr_fail_nomem(err);
  run->sweep = sweep;
  run->number = number;
  run->place = plan_place(sweep->plan, number);
  choose_entrants(run);
  enum hsr_status status = HSR_OK;
  if (run->n) {
    status = open_place(run, err);
    if (!status)
      status = judge_all(run, err);
    if (!status)
      status = time_all(run, err);
    if (status == HSR_E_STOPPED)
      status = record_judged(run, err);
    else if (!status)
      status = record(run, true, err);
    if (!status)
      journal_clear(&sweep->journal);
  }
  close_place(run);
  return status;
}
