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

/* The ids of n samples of an empty scene; NULL for lack of memory. */
static uint32_t *background(size_t n) {
  uint32_t *ids = malloc(n * sizeof *ids);
  for (size_t k = 0; ids && k < n; k++)
    ids[k] = HSR_BACKGROUND;
  return ids;
}

static enum hsr_status init_filtered(struct answer *answer,
                                     const struct hsr_algorithm *algorithm,
                                     const struct hsr_filtering *filtering,
                                     const struct hsr_view *view,
                                     struct hsr_error *err) {
  size_t n = (size_t)view->m * (size_t)view->n;
  bool jittered = filtering->patterns, filters = algorithm->flags & HSR_FILTERS;
  if (!jittered && !filters &&
      (view->m > HSR_MAX_SIZE / HSR_SUB || view->n > HSR_MAX_SIZE / HSR_SUB))
    return hsr_fail(err, HSR_E_REFUSED,
                    "%d x %d pixels of %d x %d samples, without jitter: each "
                    "side must be 1 to %d",
                    view->m, view->n, HSR_SUB, HSR_SUB, HSR_MAX_SIZE / HSR_SUB);
  answer->sums = calloc(3 * n, sizeof *answer->sums);
  if (!filters)
    answer->sub_samples = background(jittered ? n : HSR_SUB * HSR_SUB * n);
  return answer->sums && (filters || answer->sub_samples) ? HSR_OK
                                                          : hsr_fail_nomem(err);
}

enum hsr_status answer_init(struct answer *answer,
                            const struct hsr_algorithm *algorithm,
                            const struct hsr_choice *choice,
                            const struct hsr_view *view,
                            struct hsr_error *err) {
  struct hsr_choice standard = hsr_choice_standard(algorithm);
  if (!choice)
    choice = &standard;
  *answer = (struct answer){.ids = NULL};
  switch (hsr_choice_kind(algorithm, choice)) {
  case HSR_SEGMENTS:
    return HSR_OK;
  case HSR_IDS:
    answer->ids = background((size_t)view->m * (size_t)view->n);
    return answer->ids ? HSR_OK : hsr_fail_nomem(err);
  default:
    return init_filtered(answer, algorithm, &choice->filtering, view, err);
  }
}

void answer_free(struct answer *answer) {
  free(answer->ids);
  free(answer->sums);
  free(answer->sub_samples);
  hsr_drawing_free(&answer->drawing);
}

/* Who draws, and into what. */
struct task {
  const struct hsr_setup *setup;
  uint32_t *ids, *sums;
  struct hsr_drawing *drawing;
};

/* The picture in parts, bands of rows or squares, taken by whoever is free. */
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

/* The view of part k alone. */
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
                          .ids = task->ids,
                          .ids_stride = (size_t)view.m,
                          .sums = task->sums,
                          .drawing = task->drawing};
    if (task->sums)
      job.filtering = &task->setup->choice.filtering;
    worker->status = hsr_setup_render(task->setup, &job, &worker->err);
    if (worker->status)
      break;
  }
  return NULL;
}

/* Where no thread can be had, the first one does the work. */
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

/* Into squares, if so chosen; else into bands for several threads. */
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
  bool whole = task->setup->flags & HSR_FRAME_STATE || !task->ids ||
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

/* --- Filtered ------------------------------------------------------------- */

/* One picture of 8 m x 8 n samples. */
static enum hsr_status filter_fine(struct crew *crew, const struct task *task,
                                   const struct hsr_view *pixels,
                                   const struct hsr_kernel *kernel,
                                   uint32_t *sums, struct hsr_tally *tally,
                                   struct hsr_error *err) {
  struct hsr_view fine;
  enum hsr_status status = hsr_view_init(
      &fine, &pixels->camera, HSR_SUB * pixels->m, HSR_SUB * pixels->n, err);
  if (!status)
    status = draw(crew, task, &fine, tally, err);
  if (!status)
    hsr_filter_add_picture(kernel, task->setup->world, pixels, task->ids, sums);
  return status;
}

/* A picture of m x n samples for each pattern and sub-sample. */
static enum hsr_status filter_jittered(struct crew *crew,
                                       const struct task *task,
                                       const struct hsr_view *pixels,
                                       const struct hsr_kernel *kernel,
                                       uint32_t *sums, struct hsr_tally *tally,
                                       struct hsr_error *err) {
  const struct hsr_filtering *filtering = &task->setup->choice.filtering;
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < filtering->patterns * HSR_SUB * HSR_SUB && !status; k++) {
    int pattern = k / (HSR_SUB * HSR_SUB), bit = k % (HSR_SUB * HSR_SUB);
    struct hsr_view view = hsr_subsample_view(pixels, pattern, bit);
    status = draw(crew, task, &view, tally, err);
    if (!status)
      hsr_filter_add_subsample(kernel, filtering, task->setup->world, pixels,
                               pattern, bit, task->ids, sums);
  }
  return status;
}

static enum hsr_status filter(struct crew *crew, const struct hsr_setup *setup,
                              const struct hsr_view *view,
                              struct answer *answer, struct hsr_tally *tally,
                              struct hsr_error *err) {
  uint32_t *sums = answer->sums;
  memset(sums, 0, 3 * (size_t)view->m * (size_t)view->n * sizeof *sums);
  struct task task = {.setup = setup, .ids = answer->sub_samples};
  if (!task.ids) {
    task.sums = sums;
    return draw(crew, &task, view, tally, err);
  }
  struct hsr_kernel kernel;
  hsr_kernel_init(&kernel, setup->choice.filtering.filter);
  return setup->choice.filtering.patterns
             ? filter_jittered(crew, &task, view, &kernel, sums, tally, err)
             : filter_fine(crew, &task, view, &kernel, sums, tally, err);
}

enum hsr_status crew_render(struct crew *crew, const struct hsr_setup *setup,
                            const struct hsr_view *view, struct answer *answer,
                            struct hsr_tally *tally, struct hsr_error *err) {
  if (answer->sums)
    return filter(crew, setup, view, answer, tally, err);
  struct task task = {
      .setup = setup, .ids = answer->ids, .drawing = &answer->drawing};
  hsr_drawing_clear(&answer->drawing);
  return draw(crew, &task, view, tally, err);
}

enum hsr_status render_view(const struct hsr_setup *setup,
                            const struct hsr_view *view, long threads,
                            struct answer *answer, struct hsr_tally *tally,
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
