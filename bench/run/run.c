/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Running an algorithm over a view, on one thread or several. */
#include "bench/command.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { MOST_THREADS = 64 };

double seconds_now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

long processors(void) {
  cpu_set_t set;
  if (!sched_getaffinity(0, sizeof set, &set) && CPU_COUNT(&set) > 0)
    return CPU_COUNT(&set);
  return 1;
}

/* What is drawn, and the answer that it goes into. */
struct task {
  const struct hsr_setup *setup;
  struct hsr_answer *answer;
};

/* The picture in parts: bands of rows, or squares. A worker that is free takes
 * the next part. */
struct parts {
  const struct task *task;
  const struct hsr_view *view;
  int width, height, across, all;
  atomic_int next;
};

struct worker {
  struct parts *parts;
  pthread_t thread;
  bool started;
  struct hsr_arena scratch;
  struct hsr_tally tally;
  struct hsr_error err;
  enum hsr_status status;
};

struct crew {
  long n;
  struct worker worker[];
};

struct crew *crew_new(long threads) {
  if (threads > MOST_THREADS)
    threads = MOST_THREADS;
  if (threads < 1)
    threads = 1;
  struct crew *crew =
      calloc(1, sizeof *crew + (size_t)threads * sizeof *crew->worker);
  if (crew)
    crew->n = threads;
  return crew;
}

void crew_free(struct crew *crew) {
  for (long k = 0; crew && k < crew->n; k++)
    hsr_arena_free(&crew->worker[k].scratch);
  free(crew);
}

/* The view whose window is part k. */
static struct hsr_view view_of_part(const struct parts *parts, int k) {
  struct hsr_view view = *parts->view;
  struct hsr_window *w = &view.window;
  w->x0 += k % parts->across * parts->width;
  w->y0 += k / parts->across * parts->height;
  if (w->x1 - w->x0 > parts->width)
    w->x1 = w->x0 + parts->width;
  if (w->y1 - w->y0 > parts->height)
    w->y1 = w->y0 + parts->height;
  return view;
}

static void *work(void *argument) {
  struct worker *worker = argument;
  struct parts *parts = worker->parts;
  const struct task *task = parts->task;
  for (int k; (k = atomic_fetch_add(&parts->next, 1)) < parts->all;) {
    struct hsr_view view = view_of_part(parts, k);
    hsr_arena_reset(&worker->scratch);
    struct hsr_job job = {.view = &view,
                          .scratch = &worker->scratch,
                          .tally = &worker->tally,
                          .answer = task->answer};
    worker->status = hsr_setup_render(task->setup, &job, &worker->err);
    if (worker->status)
      break;
  }
  return NULL;
}

/* If no thread can be started, the first one does the work. */
static void start(struct worker *worker, struct parts *parts,
                  const struct hsr_tally *tally, bool in_thread) {
  worker->parts = parts;
  worker->status = HSR_OK;
  worker->tally = (struct hsr_tally){.work = tally->work,
                                     .work_stride = tally->work_stride,
                                     .trace = tally->trace};
  worker->started =
      in_thread && !pthread_create(&worker->thread, NULL, work, worker);
}

/* Divides the picture into squares if these are chosen; otherwise into bands
 * for several threads. */
static void divide(struct parts *parts, long threads) {
  const struct hsr_window *w = &parts->view->window;
  int columns = w->x1 - w->x0, rows = w->y1 - w->y0;
  int window = (int)parts->task->setup->choice.window;
  parts->width = window ? window : columns;
  parts->height = window        ? window
                  : threads > 1 ? rows / (int)(4 * threads) + 1
                                : rows;
  parts->across = (columns + parts->width - 1) / parts->width;
  parts->all = parts->across * ((rows + parts->height - 1) / parts->height);
}

static enum hsr_status draw(struct crew *crew, const struct task *task,
                            const struct hsr_view *view,
                            struct hsr_tally *tally, struct hsr_error *err) {
  bool whole = task->setup->flags & HSR_FRAME_STATE ||
               !task->answer->form.type->by_windows ||
               tally->trace; /* its events are in order */
  long threads = whole ? 1 : crew->n;
  struct parts parts = {.task = task, .view = view};
  divide(&parts, threads);
  for (long k = 0; k < threads; k++)
    start(&crew->worker[k], &parts, tally, k > 0);
  work(&crew->worker[0]);
  enum hsr_status status = HSR_OK;
  for (long k = 0; k < threads; k++) {
    struct worker *worker = &crew->worker[k];
    if (worker->started)
      pthread_join(worker->thread, NULL);
    if (worker->status && !status) {
      status = worker->status;
      if (err)
        *err = worker->err;
    }
    hsr_tally_add(tally, &worker->tally);
  }
  return status;
}

/* --- Answers that are folded from pictures -------------------------------- */

static enum hsr_status fold(struct crew *crew, const struct hsr_setup *setup,
                            const struct hsr_view *view,
                            struct hsr_answer *answer, struct hsr_tally *tally,
                            struct hsr_error *err) {
  const struct hsr_fold *how = answer->form.type->fold;
  struct task task = {.setup = setup, .answer = answer->picture};
  enum hsr_status status = HSR_OK;
  for (long k = 0; k < how->n(&answer->form) && !status; k++) {
    struct hsr_view picture;
    status = how->view(&answer->form, view, k, &picture, err);
    if (!status)
      status = draw(crew, &task, &picture, tally, err);
    if (!status)
      how->add(answer, setup->world, view, k);
  }
  return status;
}

enum hsr_status crew_render(struct crew *crew, const struct hsr_setup *setup,
                            const struct hsr_view *view,
                            struct hsr_answer *answer, struct hsr_tally *tally,
                            struct hsr_error *err) {
  if (answer->form.type->clear)
    answer->form.type->clear(answer);
  if (answer->picture)
    return fold(crew, setup, view, answer, tally, err);
  struct task task = {.setup = setup, .answer = answer};
  return draw(crew, &task, view, tally, err);
}

enum hsr_status answer_init(struct hsr_answer *answer,
                            const struct hsr_setup *setup,
                            const struct hsr_view *view,
                            struct hsr_error *err) {
  return hsr_answer_make(answer, &setup->choice.form, view,
                         hsr_choice_folds(setup->algorithm, &setup->choice),
                         err);
}

enum hsr_status render_view(const struct hsr_setup *setup,
                            const struct hsr_view *view, long threads,
                            struct hsr_answer *answer, struct hsr_tally *tally,
                            double *seconds, struct hsr_error *err) {
  struct crew *crew = crew_new(threads);
  if (!crew)
    return hsr_fail_nomem(err);
  double begin = seconds_now();
  enum hsr_status status = crew_render(crew, setup, view, answer, tally, err);
  if (seconds)
    *seconds = seconds_now() - begin;
  crew_free(crew);
  return status;
}
