/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of a separate command, hsr-fixtures: algorithms that fail in every
 * possible way, for which hsr bench must never show a time; and good ones to
 * compare them with. */
#include "bench/modules/modules.h"
#include "common/answers/kinds/filtered.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

extern const struct hsr_algorithm hsr_counting_oracle;
extern const struct hsr_algorithm hsr_algorithm_null, hsr_counting_null;
extern const struct hsr_algorithm hsr_algorithm_zbuffer_fast,
    hsr_counting_zbuffer_fast;
extern const struct hsr_algorithm hsr_algorithm_watkins, hsr_counting_watkins;

static int frames; /* drawn by this process */

static void sleep_ms(long ms) {
  nanosleep(&(struct timespec){.tv_nsec = ms * 1000000}, NULL);
}

static enum hsr_status zbuffer(const struct hsr_job *job,
                               struct hsr_error *err) {
  struct hsr_job own = *job;
  own.prepared = NULL; /* what a fixture prepared is not zbuffer's */
  return hsr_algorithm_zbuffer_fast.render(&own, err);
}

/* --- Wrong ---------------------------------------------------------------- */

static enum hsr_status broken(const struct hsr_job *job,
                              struct hsr_error *err) {
  enum hsr_status status = zbuffer(job, err);
  const struct hsr_window *w = &job->view->window;
  job->answer->ids[(size_t)w->y0 * (size_t)job->answer->m + (size_t)w->x0] ^= 1;
  return status;
}

/* Right if one thread draws all, wrong if several do. */
static enum hsr_status banded(const struct hsr_job *job,
                              struct hsr_error *err) {
  const struct hsr_window *w = &job->view->window;
  return w->y1 - w->y0 < job->view->n ? broken(job, err) : zbuffer(job, err);
}

/* Right in the first two frames after it was prepared, and then wrong. */
static enum hsr_status forget(const struct hsr_world *world, const long *option,
                              void **prepared, struct hsr_error *err) {
  (void)option;
  (void)world;
  (void)err;
  frames = 0;
  *prepared = &frames;
  return HSR_OK;
}

static enum hsr_status stale(const struct hsr_job *job, struct hsr_error *err) {
  return ++frames > 2 ? broken(job, err) : zbuffer(job, err);
}

static void forgotten(void *prepared) {
  (void)prepared;
}

/* --- Failing at once ------------------------------------------------------ */

static enum hsr_status crasher(const struct hsr_job *job,
                               struct hsr_error *err) {
  (void)job;
  (void)err;
  abort();
}

static enum hsr_status staller(const struct hsr_job *job,
                               struct hsr_error *err) {
  (void)err;
  while (job)
    sleep_ms(100);
  return HSR_OK;
}

/* Takes memory until it gets no more; at most 2 GB, to spare the machine. */
static enum hsr_status hog(const struct hsr_job *job, struct hsr_error *err) {
  for (int k = 0; k < 2048; k++)
    if (!HSR_NEW(job->scratch, char, 1 << 20))
      return hsr_fail_nomem(err);
  return zbuffer(job, err);
}

/* --- Failing later -----------------------------------------------------------
 * To be judged they draw two frames. To be timed they draw about 10 before the
 * first round, and about three a round.
 */

static bool is_late(void) {
  sleep_ms(2);
  return ++frames > 14;
}

static enum hsr_status late(const struct hsr_job *job, struct hsr_error *err) {
  return is_late() ? crasher(job, err) : zbuffer(job, err);
}

static enum hsr_status late_staller(const struct hsr_job *job,
                                    struct hsr_error *err) {
  return is_late() ? staller(job, err) : zbuffer(job, err);
}

/* Fails when all frames are drawn. */
static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  (void)option;
  (void)world;
  (void)err;
  *prepared = &frames;
  return HSR_OK;
}

static enum hsr_status count_frames(const struct hsr_job *job,
                                    struct hsr_error *err) {
  frames++;
  return zbuffer(job, err);
}

static void crash_at_last(void *prepared) {
  if (prepared && frames > 2)
    abort();
}

static void stall_at_last(void *prepared) {
  while (prepared && frames > 2)
    sleep_ms(100);
}

/* --- Good ----------------------------------------------------------------- */

static enum hsr_status sleeper(const struct hsr_job *job,
                               struct hsr_error *err) {
  sleep_ms(20);
  return zbuffer(job, err);
}

/* In every frame, appends its name to the file that HSR_WITNESS names. */
static enum hsr_status witness(const struct hsr_job *job, const char *name,
                               struct hsr_error *err) {
  const char *path = getenv("HSR_WITNESS");
  FILE *file = path ? fopen(path, "a") : NULL;
  if (file) {
    fprintf(file, "%s\n", name);
    fclose(file);
  }
  sleep_ms(5); /* so that it draws few frames */
  return zbuffer(job, err);
}

/* The same, with the place that it looks from. */
static enum hsr_status walker(const struct hsr_job *job,
                              struct hsr_error *err) {
  const double *eye = job->view->camera.eye;
  char place[100];
  snprintf(place, sizeof place, "%g,%g,%g", eye[0], eye[1], eye[2]);
  return witness(job, place, err);
}

static enum hsr_status witness_a(const struct hsr_job *job,
                                 struct hsr_error *err) {
  return witness(job, "a", err);
}
static enum hsr_status witness_b(const struct hsr_job *job,
                                 struct hsr_error *err) {
  return witness(job, "b", err);
}
static enum hsr_status witness_c(const struct hsr_job *job,
                                 struct hsr_error *err) {
  return witness(job, "c", err);
}

/* Filters its picture itself if asked to, sub-sample by sub-sample. */
static enum hsr_status own_filter(const struct hsr_job *job,
                                  struct hsr_error *err) {
  uint32_t *sums = hsr_answer_sums_of(job->answer);
  if (!sums)
    return zbuffer(job, err);
  static uint32_t ids[64 * 48];
  const struct hsr_filtering filtering = hsr_form_filtering(&job->answer->form);
  struct hsr_kernel kernel;
  hsr_kernel_init(&kernel, filtering.filter);
  enum hsr_status status =
      job->view->m > 64 || job->view->n > 48 ? HSR_E_INTERNAL : HSR_OK;
  for (int p = filtering.patterns ? 0 : -1;
       p < (filtering.patterns ? filtering.patterns : 0); p++)
    for (int bit = 0; bit < 64 && !status; bit++) {
      struct hsr_view view =
          hsr_subsample_view(job->view, HSR_FILTER_BOX, p, bit);
      struct hsr_answer picture = hsr_answer_of_ids(ids, view.m, view.n);
      struct hsr_job part = *job;
      part.view = &view;
      part.answer = &picture;
      status = zbuffer(&part, err);
      hsr_filter_add_subsample(&kernel, &filtering, job->world, job->view, p,
                               bit, ids, sums);
    }
  return status;
}

/* Wrong by the least possible amount, in the green sum of pixel (5, 0). */
static enum hsr_status off_by_one(const struct hsr_job *job,
                                  struct hsr_error *err) {
  enum hsr_status status = own_filter(job, err);
  uint32_t *sums = hsr_answer_sums_of(job->answer);
  if (sums)
    sums[3 * 5 + 1]++;
  return status;
}

/* --- The list ------------------------------------------------------------- */

#define FIXTURE(id, text, ...)                                                 \
  static const struct hsr_algorithm fixture_##id = {.name = text,              \
                                                    .title = text,             \
                                                    .authors = "hsr",          \
                                                    .source = "tests",         \
                                                    .taxonomy = HSR_YARDSTICK, \
                                                    .subjects = 1              \
                                                                << HSR_FACES,  \
                                                    .makes[0] = {HSR_IDS},     \
                                                    __VA_ARGS__};
FIXTURE(broken, "broken", .render = broken)
FIXTURE(banded, "banded", .render = banded)
FIXTURE(stale, "stale", .prepare = forget, .render = stale,
        .release = forgotten, .flags = HSR_FRAME_STATE)
FIXTURE(follower, "follower", .prepare = forget, .render = stale,
        .release = forgotten, .flags = HSR_FRAME_STATE | HSR_FOLLOWS)
FIXTURE(fresh, "fresh", .prepare = forget, .render = stale,
        .release = forgotten)
FIXTURE(crasher, "crasher", .render = crasher)
FIXTURE(staller, "staller", .render = staller)
FIXTURE(hog, "hog", .render = hog)
FIXTURE(late, "late", .render = late)
FIXTURE(late_staller, "late-staller", .render = late_staller)
FIXTURE(last, "last", .prepare = prepare, .render = count_frames,
        .release = crash_at_last)
FIXTURE(last_staller, "last-staller", .prepare = prepare,
        .render = count_frames, .release = stall_at_last)
FIXTURE(own_filter, "own-filter", .render = own_filter,
        .makes[1] = {HSR_FILTERED, HSR_WORDS_OF_64})
FIXTURE(off_by_one, "off-by-one", .render = off_by_one,
        .makes[1] = {HSR_FILTERED, HSR_WORDS_OF_64})
FIXTURE(sleeper, "sleeper", .render = sleeper)
FIXTURE(walker, "walker", .render = walker)
FIXTURE(still, "still", .render = zbuffer, .flags = HSR_FRAME_STATE)
FIXTURE(witness_a, "witness-a", .render = witness_a)
FIXTURE(witness_b, "witness-b", .render = witness_b)
FIXTURE(witness_c, "witness-c", .render = witness_c)
FIXTURE(same_1, "same-1", .render = zbuffer)
FIXTURE(same_2, "same-2", .render = zbuffer)
FIXTURE(same_3, "same-3", .render = zbuffer)
FIXTURE(same_4, "same-4", .render = zbuffer)

#define BOTH(id)                                                               \
  { &fixture_##id, &fixture_##id }
const struct hsr_listed hsr_modules[] = {
    {&hsr_counting_oracle, &hsr_counting_oracle},
    {&hsr_algorithm_null, &hsr_counting_null},
    {&hsr_algorithm_zbuffer_fast, &hsr_counting_zbuffer_fast},
    {&hsr_algorithm_watkins, &hsr_counting_watkins},
    BOTH(broken),
    BOTH(stale),
    BOTH(follower),
    BOTH(fresh),
    BOTH(banded),
    BOTH(crasher),
    BOTH(staller),
    BOTH(hog),
    BOTH(late),
    BOTH(late_staller),
    BOTH(last),
    BOTH(last_staller),
    BOTH(own_filter),
    BOTH(off_by_one),
    BOTH(sleeper),
    BOTH(still),
    BOTH(walker),
    BOTH(witness_a),
    BOTH(witness_b),
    BOTH(witness_c),
    BOTH(same_1),
    BOTH(same_2),
    BOTH(same_3),
    BOTH(same_4),
    {NULL, NULL}};
