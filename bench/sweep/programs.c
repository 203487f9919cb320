/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/sweep/programs.h"
#include "bench/run/serve.h"
#include "common/base/clock.h"

#include <string.h>

/* --- What goes wrong ------------------------------------------------------ */

/* A failure of the program becomes the taker's. An interrupt is none. */
static void note_end(struct turn_taker *taker, enum hsr_status status,
                     const struct hsr_error *err) {
  bool late = program_was_late(taker->program);
  program_turn_kill(taker);
  if (status == HSR_E_STOPPED && !late)
    return;
  taker->verdict = late ? TIMEOUT : CRASH;
  taker->failure = late ? HSR_OK : status;
  snprintf(taker->why, sizeof taker->why, "%s", err->text);
}

void program_turn_kill(struct turn_taker *taker) {
  program_kill(taker->program);
  taker->program = NULL;
}

/* --- Frames --------------------------------------------------------------- */

/* Seconds that it may take to be ready: each of three phases as long as a frame. */
static double patience(const struct plan *plan) {
  return 3 * (double)plan->options->timeout;
}

/* Draws n rounds. */
static enum hsr_status draw_rounds(const struct plan *plan,
                                   struct turn_taker *taker, long n,
                                   double *seconds, struct hsr_error *err) {
  return program_draw(taker->program, 'f', n * plan->options->walk,
                      (double)plan->options->timeout, seconds, NULL, err);
}

static enum hsr_status warm_up(const struct plan *plan,
                               struct turn_taker *taker,
                               struct hsr_error *err) {
  double begin = hsr_seconds_now(), least = -1;
  long most = PROGRAM_MOST_FRAMES / plan->options->walk;
  enum hsr_status status = HSR_OK;
  for (long k = 0; !status && (k < SERVE_WARM_ROUNDS ||
                               hsr_seconds_now() - begin < SERVE_WARM_SECONDS);
       k++) {
    double seconds;
    status = draw_rounds(plan, taker, 1, &seconds, err);
    if (!status && (least < 0 || seconds < least))
      least = seconds;
  }
  double rounds = SERVE_SAMPLE_SECONDS / (least > 1e-9 ? least : 1e-9);
  taker->rounds = rounds >= (double)most ? most : (long)rounds + 1;
  return status;
}

/* --- A start -------------------------------------------------------------- */

static double known(double seconds, double otherwise) {
  return seconds < 0 ? otherwise : seconds;
}

bool program_turn_begin(const struct plan *plan, struct turn_taker *taker,
                        int start) {
  struct hsr_error err;
  struct program_phases phases;
  enum hsr_status status = program_start(taker->job, &taker->program, &err);
  if (status == HSR_E_NOMEM)
    return false;
  if (!status)
    status = program_ready(taker->program, patience(plan), &phases, &err);
  if (!status)
    status = warm_up(plan, taker, &err);
  if (status) {
    note_end(taker, status, &err);
    return true;
  }
  struct start *into = &taker->starts[start];
  into->import_seconds = phases.import;
  into->adapt_seconds = known(phases.adapt, taker->adapt_seconds);
  into->prepare_seconds = phases.prepare;
  into->before_kb = phases.before_kb;
  into->inner = taker->rounds * plan->options->walk;
  into->shade_seconds = into->write_seconds = -1;
  into->repetitions = plan->options->repetitions;
  return true;
}

/* Draws frames, the last of which is the picture of this view, and has it judged:
 * what it is to write is unwritten before. */
static enum hsr_status draw_judged(const struct plan *plan,
                                   struct turn_taker *taker,
                                   const struct turn_listener *listener,
                                   long frames, int view, double *seconds,
                                   struct hsr_error *err) {
  enum hsr_status status = program_unset(taker->program, err);
  if (!status)
    status = program_draw(taker->program, 'f', frames,
                          (double)plan->options->timeout, seconds, NULL, err);
  return status ? status : listener->drawn(listener->data, taker, view, err);
}

/* A round without the clock, every picture of which is judged. It refills the
 * caches, too. */
static enum hsr_status judge_round(const struct plan *plan,
                                   struct turn_taker *taker,
                                   const struct turn_listener *listener,
                                   struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (int view = 0; view < plan->options->walk && !status; view++)
    if (taker->verdict == RIGHT)
      status = draw_judged(plan, taker, listener, 1, view, NULL, err);
  return status;
}

/* The frames that are timed in a round. They are drawn one over the other, and the
 * last one is judged. Batches of two lengths take turns, so that it is not always
 * the same one of a program that has two buffers. */
static long frames_in(const struct plan *plan, const struct turn_taker *taker,
                      int round) {
  bool shorter = taker->rounds > 1 && round % 2;
  return (taker->rounds - shorter) * plan->options->walk;
}

void program_turn_draw(const struct plan *plan, struct turn_taker *taker,
                       const struct turn_listener *listener, int start,
                       int round) {
  struct hsr_error err;
  double seconds = 0;
  long frames = frames_in(plan, taker, round);
  int last = (int)plan->options->walk - 1;
  enum hsr_status status = HSR_OK;
  if (frames > 1)
    status = judge_round(plan, taker, listener, &err);
  if (!status && taker->verdict == RIGHT)
    status = draw_judged(plan, taker, listener, frames, last, &seconds, &err);
  taker->starts[start].seconds[round] = seconds / (double)frames;
  if (status)
    note_end(taker, status, &err);
  else if (taker->verdict != RIGHT)
    program_turn_kill(taker);
}

/* --- The end -------------------------------------------------------------- */

/* Adds the counts of a line to those of the taker. */
static void add_counts(struct turn_taker *taker, const json_t *line) {
  const char *name;
  json_t *value;
  json_t *counts = json_object_get(line, "counts");
  if (!taker->counts && json_is_object(counts))
    taker->counts = json_object();
  json_object_foreach(counts, name, value) {
    json_t *sum = json_object_get(taker->counts, name);
    json_object_set_new(taker->counts, name,
                        json_integer((json_int_t)json_number_value(value) +
                                     json_integer_value(sum)));
  }
}

static enum hsr_status count(const struct plan *plan, struct turn_taker *taker,
                             struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  taker->has_counted = true;
  for (long k = 0; k < plan->options->walk && !status; k++) {
    json_t *line = NULL;
    status = program_draw(taker->program, 'c', 1,
                          (double)plan->options->timeout, NULL, &line, err);
    add_counts(taker, line);
    json_decref(line);
  }
  return status;
}

static void end(struct turn_taker *taker) {
  struct hsr_error err;
  enum hsr_status status = program_end(taker->program, &err);
  taker->program = NULL;
  if (!status)
    return;
  taker->verdict = CRASH;
  taker->failure = status;
  snprintf(taker->why, sizeof taker->why, "%s", err.text);
}

void program_turn_finish(const struct plan *plan, struct turn_taker *taker,
                         int start) {
  struct hsr_error err;
  taker->starts[start].peak_kb = program_peak_kb(taker->program);
  enum hsr_status status =
      taker->has_counted ? HSR_OK : count(plan, taker, &err);
  if (status) {
    note_end(taker, status, &err);
    return;
  }
  end(taker);
}

void program_turn_count(const struct plan *plan, struct turn_taker *taker) {
  struct hsr_error err;
  struct program_phases phases;
  enum hsr_status status = program_start(taker->job, &taker->program, &err);
  if (!status)
    status = program_ready(taker->program, patience(plan), &phases, &err);
  if (!status)
    status = count(plan, taker, &err);
  if (status)
    note_end(taker, status, &err);
  else
    end(taker);
}
