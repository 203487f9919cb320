/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Counts, work picture and trace pass through a crew. */
#include "bench/command.h"
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

int main(void) {
  struct tap tap = plan(7);
  struct both_worlds worlds;
  open_worlds(&worlds, "house");
  struct hsr_view view;
  struct hsr_setup setup;
  const struct hsr_algorithm *a = hsr_algorithm_find("raycast")->counting;
  if (hsr_view_init(&view, &worlds.scene->views[0], M, N, NULL) ||
      hsr_setup_init(&setup, a, NULL, &worlds.world, NULL))
    abort();
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
  close_worlds(&worlds);
  return finish(&tap);
}
