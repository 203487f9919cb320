/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Counts, work picture and trace pass through a crew. */
#include "bench/modules/modules.h"
#include "bench/run/crew.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>

enum { M = 33, N = 24 };

struct ear {
  uint64_t heard, out_of_order;
};

static void listen(void *context, const struct hsr_event *event) {
  struct ear *ear = context;
  ear->out_of_order += event->number != ear->heard++;
}

/* The same picture, and the same sum of counts, in any windows by any crew. */
static void test_windows(struct tap *tap, const struct both_worlds *worlds) {
  static uint32_t wanted[M * N];
  const struct hsr_algorithm *a = hsr_algorithm_find("raycast")->counting;
  struct hsr_view view;
  uint64_t asked = 0;
  long different = 0;
  must_view(&view, &worlds->scene->views[0], M, N);
  draw_ids(a, &worlds->world, &view, wanted, NULL);
  for (int k = 0; k < 12; k++) {
    static const long sizes[] = {0, 1, 7, 8, 11, 40};
    struct hsr_setup setup;
    struct hsr_answer answer;
    struct hsr_tally tally = {.trace = NULL};
    struct hsr_choice choice = hsr_choice_standard(a);
    choice.window = sizes[k % 6];
    must_setup(&setup, a, &choice, &worlds->world);
    if (answer_init(&answer, &setup, &view, NULL))
      abort();
    struct crew *crew = crew_new(k < 6 ? 1 : 3);
    for (int s = 0; s < M * N; s++)
      hsr_answer_ids_of(&answer)[s] = UNWRITTEN;
    if (crew_render(crew, &setup, &view, &answer, &tally, NULL))
      abort();
    different += count_differences(&view, hsr_answer_ids_of(&answer), wanted);
    asked = k ? asked : tally.depths_compared;
    different += tally.depths_compared != asked;
    crew_free(crew);
    hsr_answer_free(&answer);
    hsr_setup_free(&setup);
  }
  ok(tap, !different, "windows: %ld differences", different);
}

/* Two pictures that differ in their last sample. */
static void test_difference(struct tap *tap) {
  static const uint32_t place[] = {1, M * N - 1};
  uint32_t ids[2][M * N] = {{0}};
  ids[0][M * N - 1] = 7;
  struct hsr_answer got = hsr_answer_of_ids(ids[0], M, N);
  struct hsr_answer wanted = hsr_answer_of_ids(ids[1], M, N);
  struct hsr_comparison c = {.got = &got, .wanted = &wanted, .n = M * N};
  struct hsr_difference all = {0}, few = {0}, one = {0};
  got.form.type->compare(&c, &all);
  c.place = place;
  c.n = 2;
  got.form.type->compare(&c, &few);
  c.n = 1;
  got.form.type->compare(&c, &one);
  ok(tap,
     all.differing == 1 && all.compared == M * N && few.differing == 1 &&
         few.compared == 2 && !one.differing,
     "the last sample differs: %s", few.first);
}

/* A picture large enough that every worker has a part in it. */
static void test_shares(struct tap *tap, const struct both_worlds *worlds) {
  const struct hsr_algorithm *a = hsr_algorithm_find("raycast")->counting;
  struct hsr_view view;
  struct hsr_setup setup;
  uint64_t count[2] = {0, 0}, depths[2];
  struct hsr_choice choice = hsr_choice_standard(a);
  choice.window = 16;
  must_view(&view, &worlds->scene->views[0], 4 * M, 4 * N);
  must_setup(&setup, a, &choice, &worlds->world);
  for (int k = 0; k < 2; k++) {
    struct hsr_answer answer;
    struct hsr_tally tally = {.trace = NULL};
    if (answer_init(&answer, &setup, &view, NULL) ||
        render_view(&setup, &view, k ? 4 : 1, &answer, &tally, NULL, NULL))
      abort();
    for (int c = 0; c < HSR_MAX_COUNTERS; c++)
      count[k] += tally.count[c];
    depths[k] = tally.depths_compared;
    hsr_answer_free(&answer);
  }
  ok(tap, count[0] && count[0] == count[1] && depths[0] == depths[1],
     "by one and by four: %llu and %llu steps", (unsigned long long)count[0],
     (unsigned long long)count[1]);
  hsr_setup_free(&setup);
}

static void test_sum(struct tap *tap) {
  struct hsr_tally to = {.depths_compared = 5}, one = {.depths_compared = 2};
  bool good = true;
  for (int k = 0; k < HSR_MAX_COUNTERS; k++)
    to.count[k] = (uint64_t)k, one.count[k] = 1;
  for (int q = 0; q < HSR_N_QUESTIONS; q++)
    to.exact[q] = 10, one.exact[q] = (uint64_t)q;
  for (int c = 0; c < HSR_N_CULLS; c++)
    to.culled[c] = 3, one.culled[c] = (uint64_t)c;
  hsr_tally_add(&to, &one);
  for (int k = 0; k < HSR_MAX_COUNTERS; k++)
    good &= to.count[k] == (uint64_t)k + 1;
  for (int q = 0; q < HSR_N_QUESTIONS; q++)
    good &= to.exact[q] == 10 + (uint64_t)q;
  for (int c = 0; c < HSR_N_CULLS; c++)
    good &= to.culled[c] == 3 + (uint64_t)c;
  good &= to.depths_compared == 7 && !to.out_of_memory;
  one.out_of_memory = true;
  hsr_tally_add(&to, &one);
  ok(tap, good && to.out_of_memory, "a tally is added, all of it");
}

int main(void) {
  struct tap tap = plan(11);
  struct both_worlds worlds;
  open_worlds(&worlds, "house");
  struct hsr_view view;
  struct hsr_setup setup;
  const struct hsr_algorithm *a = hsr_algorithm_find("raycast")->counting;
  must_view(&view, &worlds.scene->views[0], M, N);
  must_setup(&setup, a, NULL, &worlds.world);
  for (int threads = 1; threads <= 3; threads += 2) {
    struct hsr_answer answer;
    struct ear ear = {0};
    static float work[M * N];
    struct hsr_trace trace = {.listen = listen, .context = &ear};
    struct hsr_tally tally = {.trace = &trace, .work = work, .work_stride = M};
    if (answer_init(&answer, &setup, &view, NULL))
      abort();
    struct crew *crew = crew_new(threads);
    ok(&tap, !crew_render(crew, &setup, &view, &answer, &tally, NULL),
       "%d threads: drawn", threads);
    uint64_t count = 0;
    for (int k = 0; k < HSR_MAX_COUNTERS; k++)
      count += tally.count[k];
    ok(&tap, count > 0 && ear.heard == count,
       "%d threads: %llu steps, %llu events", threads,
       (unsigned long long)count, (unsigned long long)ear.heard);
    ok(&tap, !ear.out_of_order && trace.n == ear.heard,
       "%d threads: the events are in order", threads);
    double touched = 0;
    for (int k = 0; k < M * N; k++)
      touched += (double)work[k];
    if (threads == 1)
      ok(&tap, touched > 0, "the work picture: %g touches", touched);
    crew_free(crew);
    hsr_answer_free(&answer);
  }
  hsr_setup_free(&setup);
  test_windows(&tap, &worlds);
  test_shares(&tap, &worlds);
  test_sum(&tap);
  test_difference(&tap);
  close_worlds(&worlds);
  return finish(&tap);
}
