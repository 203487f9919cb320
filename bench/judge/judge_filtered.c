/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/judge/judge_filtered.h"
#include "bench/run/crew.h"
#include "common/answers/kinds/filtered.h"

#include <stdlib.h>
#include <string.h>

enum { BITS = HSR_SUB * HSR_SUB };

struct loop {
  const struct hsr_setup *oracle;
  const struct hsr_filtering *filtering;
  const struct hsr_view *pixels;
  const bool *wanted;
  struct hsr_kernel kernel;
  struct crew *crew;
  struct hsr_tally tally;
  struct hsr_answer drawn; /* ids: one sub-sample of the cells */
  uint32_t *sums;
};

/* The pixel that is dx to the right and dy below of that of cell (i, j), if it is
 * one that is wanted; else -1. */
static long target(const struct loop *loop, int i, int j, int dx, int dy) {
  int m = loop->pixels->m, n = loop->pixels->n;
  int x = i / loop->kernel.cells + dx, y = j / loop->kernel.cells + dy;
  if (x < 0 || x >= m || y < 0 || y >= n)
    return -1;
  long k = (long)y * m + x;
  return !loop->wanted || loop->wanted[k] ? k : -1;
}

static bool reaches_any(const struct loop *loop, int i, int j, int bit) {
  for (int dy = -1; dy <= 1; dy++)
    for (int dx = -1; dx <= 1; dx++)
      if (loop->kernel.weight[dy + 1][dx + 1][bit] &&
          target(loop, i, j, dx, dy) >= 0)
        return true;
  return false;
}

/* Adds what sub-sample `bit` of cell (i, j), which shows a face, gives. */
static void add(struct loop *loop, int i, int j, int bit, uint32_t face) {
  uint16_t rgb[3];
  hsr_filter_colour(loop->oracle->world, loop->pixels, face, rgb);
  for (int dy = -1; dy <= 1; dy++)
    for (int dx = -1; dx <= 1; dx++) {
      long k = target(loop, i, j, dx, dy);
      for (int c = 0; c < 3 && k >= 0; c++)
        loop->sums[3 * k + c] +=
            loop->kernel.weight[dy + 1][dx + 1][bit] * rgb[c];
    }
}

static enum hsr_status ask(struct loop *loop, const struct hsr_view *view,
                           struct hsr_error *err) {
  return crew_render(loop->crew, loop->oracle, view, &loop->drawn, &loop->tally,
                     err);
}

/* One sub-sample of all cells of a pattern: drawn at once where it is all that
 * there are, else one by one. */
static enum hsr_status ask_subsample(struct loop *loop, int pattern, int bit,
                                     struct hsr_error *err) {
  struct hsr_view view =
      hsr_subsample_view(loop->pixels, loop->filtering->filter, pattern, bit);
  bool at_once = pattern < 0 && !loop->wanted;
  enum hsr_status status = at_once ? ask(loop, &view, err) : HSR_OK;
  for (int j = 0; j < view.n && !status; j++)
    for (int i = 0; i < view.m && !status; i++) {
      if (hsr_jitter_pattern(loop->filtering, i, j) != pattern ||
          !reaches_any(loop, i, j, bit))
        continue;
      view.window = (struct hsr_window){i, j, i + 1, j + 1};
      if (!at_once)
        status = ask(loop, &view, err);
      if (!status)
        add(loop, i, j, bit,
            hsr_answer_ids_of(
                &loop->drawn)[(size_t)j * (size_t)view.m + (size_t)i]);
    }
  return status;
}

enum hsr_status judge_sums(const struct hsr_setup *oracle,
                           const struct hsr_filtering *filtering,
                           const struct hsr_view *view, const bool *wanted,
                           uint32_t *sums, struct hsr_error *err) {
  memset(sums, 0, 3 * (size_t)view->m * (size_t)view->n * sizeof *sums);
  struct loop loop = {.oracle = oracle,
                      .filtering = filtering,
                      .pixels = view,
                      .wanted = wanted,
                      .crew = crew_new(1),
                      .sums = sums};
  hsr_kernel_init(&loop.kernel, filtering->filter);
  struct hsr_view cells = hsr_subsample_view(view, filtering->filter, -1, 0);
  enum hsr_status status = answer_init(&loop.drawn, oracle, &cells, err);
  if (!status && !loop.crew)
    status = hsr_fail_nomem(err);
  int first = filtering->patterns ? 0 : -1;
  int last = filtering->patterns ? filtering->patterns - 1 : -1;
  for (int pattern = first; pattern <= last; pattern++)
    for (int bit = 0; bit < BITS && !status; bit++)
      if (loop.kernel.all >> bit & 1)
        status = ask_subsample(&loop, pattern, bit, err);
  hsr_answer_free(&loop.drawn);
  crew_free(loop.crew);
  return status;
}

enum hsr_status judge_filtered(const struct hsr_setup *oracle,
                               const struct hsr_view *view, const bool *wanted,
                               struct hsr_answer *answer,
                               struct hsr_error *err) {
  struct hsr_filtering filtering = hsr_form_filtering(&answer->form);
  return judge_sums(oracle, &filtering, view, wanted,
                    hsr_answer_sums_of(answer), err);
}
