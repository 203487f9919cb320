/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "config.h"

#include "bench/run/crew.h"
#include "bench/ranks/ranks.h"

#include "common/base/clock.h"
#include "common/base/share.h"

#include <math.h>
#include <pthread.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { PARTS_OF_WORKER = 32, LEAST_SIDE = 16 };

long processors(void) {
  cpu_set_t set;
  if (!sched_getaffinity(0, sizeof set, &set) && CPU_COUNT(&set) > 0)
    return CPU_COUNT(&set);
  return 1;
}

/* What is drawn, and the answer that it goes into. The picture is in parts:
 * bands of rows, or squares. A worker that is free, of whatever rank, takes the
 * next part. */
struct parts {
  const struct hsr_setup *setup;
  const struct hsr_view *view;
  struct hsr_answer *answer;
  int width, height, across, all;
  int threads; /* that a part may use itself */
  struct queue queue;
  bool *is_own; /* which parts this rank has drawn; NULL: there is one rank */
};

struct worker {
  struct parts *parts;
  struct hsr_arena scratch;
  struct hsr_tally tally;
  struct hsr_error err;
  enum hsr_status status;
  double seconds; /* of a processor, for the last picture */
};

/* How far the crew is, for whoever watches it. */
struct progress_of_crew {
  struct crew_watch watch; /* .tell is NULL: nobody watches */
  pthread_mutex_t turn;    /* for the rest, and for calls of `tell` */
  int begun, all;          /* parts of the picture at hand */
  long before, pictures;   /* pictures of the answer before it; and all */
  bool stopped;
};

struct crew {
  int n;
  bool together; /* with those of all ranks */
  struct crew_work work;
  struct progress_of_crew progress;
  struct worker worker[];
};

struct crew *crew_new(long threads) {
  int n = hsr_threads(threads);
  struct crew *crew =
      calloc(1, sizeof *crew + (size_t)n * sizeof *crew->worker);
  if (!crew)
    return NULL;
  crew->n = n;
  pthread_mutex_init(&crew->progress.turn, NULL);
  return crew;
}

void crew_free(struct crew *crew) {
  for (int k = 0; crew && k < crew->n; k++)
    hsr_arena_free(&crew->worker[k].scratch);
  if (crew)
    pthread_mutex_destroy(&crew->progress.turn);
  free(crew);
}

void crew_watch(struct crew *crew, const struct crew_watch *watch) {
  crew->progress.watch = *watch;
}

void crew_join_ranks(struct crew *crew) {
  crew->together = ranks_count() > 1;
}

struct crew_work crew_work(const struct crew *crew) {
  return crew->work;
}

static struct hsr_window window_of_part(const struct parts *parts, int k) {
  struct hsr_window w = parts->view->window;
  w.x0 += k % parts->across * parts->width;
  w.y0 += k / parts->across * parts->height;
  if (w.x1 - w.x0 > parts->width)
    w.x1 = w.x0 + parts->width;
  if (w.y1 - w.y0 > parts->height)
    w.y1 = w.y0 + parts->height;
  return w;
}

/* Of the thread that asks. */
static double processor_seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Tells that one more part is begun. Returns whether the crew goes on. */
static bool begin_part(struct progress_of_crew *p) {
  if (!p->watch.tell)
    return true;
  pthread_mutex_lock(&p->turn);
  double part = (double)p->begun++ / p->all;
  if (!p->stopped)
    p->stopped = !p->watch.tell(p->watch.whom, ((double)p->before + part) /
                                                   (double)p->pictures);
  bool goes_on = !p->stopped;
  pthread_mutex_unlock(&p->turn);
  return goes_on;
}

/* The same of an algorithm that draws the whole picture in its own tiles. */
static bool tell_share(void *whom, double share) {
  struct progress_of_crew *p = whom;
  pthread_mutex_lock(&p->turn);
  if (!p->stopped)
    p->stopped = !p->watch.tell(
        p->watch.whom, ((double)p->before + (p->begun - 1 + share) / p->all) /
                           (double)p->pictures);
  bool goes_on = !p->stopped;
  pthread_mutex_unlock(&p->turn);
  return goes_on;
}

static enum hsr_status say_stopped(struct hsr_error *err) {
  return hsr_fail(err, HSR_E_STOPPED, "stopped by whoever asked for it");
}

static void work(void *context, int thread) {
  struct crew *crew = context;
  struct worker *worker = &crew->worker[thread];
  struct parts *parts = worker->parts;
  double begin = processor_seconds();
  for (int k; (k = (int)queue_take(&parts->queue)) >= 0;) {
    if (!begin_part(&crew->progress)) {
      worker->status = say_stopped(&worker->err);
      break;
    }
    struct hsr_view view = *parts->view;
    view.window = window_of_part(parts, k);
    if (parts->is_own)
      parts->is_own[k] = true;
    hsr_arena_reset(&worker->scratch);
    const struct hsr_watch watch = {tell_share, &crew->progress};
    struct hsr_job job = {.view = &view,
                          .scratch = &worker->scratch,
                          .tally = &worker->tally,
                          .answer = parts->answer,
                          .threads = parts->threads,
                          .tile = (int)parts->setup->choice.window,
                          .watch = crew->progress.watch.tell ? &watch : NULL};
    worker->status = hsr_setup_render(parts->setup, &job, &worker->err);
    if (worker->status)
      break;
  }
  worker->seconds = processor_seconds() - begin;
}

static void get_ready(struct worker *worker, struct parts *parts,
                      const struct hsr_tally *tally) {
  worker->parts = parts;
  worker->status = HSR_OK;
  worker->seconds = 0;
  worker->tally = (struct hsr_tally){.work = tally->work,
                                     .work_stride = tally->work_stride,
                                     .trace = tally->trace};
}

/* Squares of about so many samples that each of n workers draws some. */
static int side_for(double samples, long n) {
  int side = (int)ceil(sqrt(samples / (double)(n * PARTS_OF_WORKER)));
  return side > LEAST_SIDE ? side : LEAST_SIDE;
}

/* A picture is one part for an algorithm that divides it itself. Others it divides
 * into squares if these are chosen, or for several ranks; otherwise into bands
 * for several threads, or for those who watch: at least `bands` of them. */
static void divide(struct parts *parts, int threads, int bands, bool by_ranks) {
  const struct hsr_window *w = &parts->view->window;
  int columns = w->x1 - w->x0, rows = w->y1 - w->y0;
  bool whole = parts->setup->flags & HSR_OWN_TILES && !by_ranks;
  int window = whole ? 0 : (int)parts->setup->choice.window;
  if (!window && by_ranks)
    window = side_for((double)columns * rows, (long)threads * ranks_count());
  parts->width = window ? window : columns;
  int least = threads > 1 ? 4 * threads : 1;
  bands = whole ? 1 : bands > least ? bands : least;
  parts->height = window ? window : bands > 1 ? rows / bands + 1 : rows;
  parts->across = (columns + parts->width - 1) / parts->width;
  parts->all = parts->across * ((rows + parts->height - 1) / parts->height);
  queue_open(&parts->queue, parts->all, by_ranks);
}

static enum hsr_status draw_parts(struct crew *crew, struct parts *parts,
                                  int threads, struct hsr_tally *tally,
                                  struct hsr_error *err) {
  for (int k = 0; k < threads; k++)
    get_ready(&crew->worker[k], parts, tally);
  hsr_threads_run(threads, work, crew);
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < threads; k++) {
    struct worker *worker = &crew->worker[k];
    if (worker->status && !status) {
      status = worker->status;
      if (err)
        *err = worker->err;
    }
    hsr_tally_add(tally, &worker->tally);
    crew->work.seconds += worker->seconds;
  }
  return status;
}

/* --- Several ranks -------------------------------------------------------- */

/* Sends what this rank has drawn to rank 0. */
static void send_parts(struct crew *crew, const struct parts *parts,
                       void *bytes) {
  for (int k = 0; k < parts->all; k++) {
    if (!parts->is_own[k])
      continue;
    struct hsr_window window = window_of_part(parts, k);
    size_t size = hsr_answer_window_size(parts->answer, &window);
    hsr_answer_pack(parts->answer, &window, bytes);
    ranks_send(k, bytes, size);
    crew->work.bytes += (double)size;
    crew->work.messages++;
  }
}

/* Receives what the others have drawn. */
static void receive_parts(const struct parts *parts, void *bytes, size_t most) {
  int missing = 0;
  for (int k = 0; k < parts->all; k++)
    missing += !parts->is_own[k];
  for (; missing; missing--) {
    int k = ranks_receive(bytes, most);
    struct hsr_window window = window_of_part(parts, k);
    hsr_answer_unpack(parts->answer, &window, bytes);
  }
}

/* All ranks draw, each what it takes from the queue, and rank 0 puts their
 * parts together. */
static enum hsr_status draw_together(struct crew *crew, struct parts *parts,
                                     int threads, struct hsr_tally *tally,
                                     struct hsr_error *err) {
  struct hsr_window first = window_of_part(parts, 0); /* none is larger */
  size_t most = hsr_answer_window_size(parts->answer, &first);
  void *bytes = malloc(most);
  parts->is_own = calloc((size_t)parts->all, sizeof *parts->is_own);
  enum hsr_status status = bytes && parts->is_own
                               ? draw_parts(crew, parts, threads, tally, err)
                               : hsr_fail_nomem(err);
  for (int k = 0; parts->is_own && k < parts->all; k++)
    crew->work.parts += parts->is_own[k];
  if (!status && ranks_own())
    send_parts(crew, parts, bytes);
  else if (!status)
    receive_parts(parts, bytes, most);
  free(bytes);
  free(parts->is_own);
  return status;
}

/* --- Whole answers -------------------------------------------------------- */

static void clear(struct hsr_answer *answer) {
  if (answer->form.type->clear)
    answer->form.type->clear(answer);
}

/* Draws one picture: the answer, or one that it is folded from. */
static enum hsr_status draw(struct crew *crew, const struct hsr_setup *setup,
                            const struct hsr_view *view,
                            struct hsr_answer *answer, struct hsr_tally *tally,
                            struct hsr_error *err) {
  clear(answer);
  bool whole = !answer->form.type->by_windows ||
               tally->trace; /* its events are in order */
  bool together = crew->together && !whole;
  if (crew->together && whole && ranks_own())
    return HSR_OK; /* rank 0 makes it alone */
  bool alone = whole || setup->flags & HSR_FRAME_STATE;
  bool own_tiles = setup->flags & HSR_OWN_TILES && !together;
  int threads = alone || own_tiles ? 1 : crew->n;
  struct parts parts = {.setup = setup,
                        .view = view,
                        .answer = answer,
                        .threads = own_tiles && !alone ? crew->n : 1};
  divide(&parts, threads, alone ? 1 : crew->progress.watch.parts, together);
  crew->progress.begun = 0;
  crew->progress.all = parts.all;
  return together ? draw_together(crew, &parts, threads, tally, err)
                  : draw_parts(crew, &parts, threads, tally, err);
}

/* Folds the answer from pictures that the crew draws. */
static enum hsr_status fold(struct crew *crew, const struct hsr_setup *setup,
                            const struct hsr_view *view,
                            struct hsr_answer *answer, struct hsr_tally *tally,
                            struct hsr_error *err) {
  const struct hsr_fold *how = answer->form.type->fold;
  enum hsr_status status = HSR_OK;
  clear(answer);
  crew->progress.pictures = how->n(&answer->form);
  for (long k = 0; k < crew->progress.pictures && !status; k++) {
    struct hsr_view picture;
    crew->progress.before = k;
    status = how->view(&answer->form, view, k, &picture, err);
    if (!status)
      status = draw(crew, setup, &picture, answer->picture, tally, err);
    if (!status && !(crew->together && ranks_own()))
      how->add(answer, setup->world, view, k);
  }
  return status;
}

enum hsr_status crew_render(struct crew *crew, const struct hsr_setup *setup,
                            const struct hsr_view *view,
                            struct hsr_answer *answer, struct hsr_tally *tally,
                            struct hsr_error *err) {
  struct progress_of_crew *progress = &crew->progress;
  progress->before = 0;
  progress->pictures = 1;
  progress->stopped = false;
  enum hsr_status status =
      (answer->picture ? fold : draw)(crew, setup, view, answer, tally, err);
  if (!status && progress->watch.tell)
    progress->watch.tell(progress->watch.whom, 1);
  return status;
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
  double begin = hsr_seconds_now();
  enum hsr_status status = crew_render(crew, setup, view, answer, tally, err);
  if (seconds)
    *seconds = hsr_seconds_now() - begin;
  crew_free(crew);
  return status;
}
