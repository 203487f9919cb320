/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An example to copy: faces one after another, the nearest so far stays.
 *
 * Source      nobody's: a z-buffer that keeps ids and asks for depths again.
 *             In a file of yours: author, title, where and when it was
 *             published, pages.
 * Notation    the paper's words -> this file's
 * Invariant   after face k, every sample shows the nearest of the first k faces
 *             that cover it
 * Ties        by hsr_nearer: the picture's order
 * Departures  what is done otherwise than in the paper, and why
 * Cost        depth tests: samples that are covered once more
 *
 * It is built and tested (tests/example). To make an algorithm of it, copy it
 * to the folder of its taxonomy, write another name for `example`, and add the
 * name to algorithms/list.def and the file to the local.mk of its branch. It also
 * works as it is outside of the tree (docs/modules-outside.md). */
#include "algorithms/algorithm.h"
#include "common/exact/screen.h"

/* What is counted, and told to who listens. */
enum { SPANS, DEPTH, WRITES };

/* One frame. All memory is taken at its beginning. */
struct frame {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  struct hsr_screen screen;
  int *columns; /* the ends of a face's spans on a row */
};

/* Face f at the samples [x0, x1) of row j, as far as they are in the window. */
static void show_span(struct frame *s, uint32_t f, int x0, int x1, int j) {
  const struct hsr_window *w = &s->job->view->window;
  x0 = x0 > w->x0 ? x0 : w->x0;
  x1 = x1 < w->x1 ? x1 : w->x1;
  uint32_t *row = hsr_job_row(s->job, j);
  HSR_STEP(s->tally, SPANS, HSR_FACE(f), HSR_THE_WINDOW, HSR_ON(x0, x1, j), 0);
  for (int i = x0; i < x1; i++) {
    HSR_TOUCH(s->tally, i, j);
    if (row[i] != HSR_BACKGROUND) {
      bool nearer = hsr_nearer(&s->screen, f, row[i], i, j, s->tally);
      HSR_STEP(s->tally, DEPTH, HSR_FACE(f), HSR_FACE(row[i]), HSR_AT(i, j),
               nearer);
      if (!nearer)
        continue;
    }
    HSR_STEP(s->tally, WRITES, HSR_FACE(f), HSR_THE_WINDOW, HSR_AT(i, j), 0);
    row[i] = f;
  }
}

/* All rows of the window that face f may cover. */
static void show_face(struct frame *s, uint32_t f) {
  const struct hsr_bounds *bounds = &s->screen.bounds[f];
  struct hsr_face_rows rows;
  hsr_face_rows_begin(&rows, &s->screen, f, s->tally);
  for (int j = bounds->y0; j < bounds->y1; j++) {
    int n = hsr_face_rows_spans(&rows, j, s->columns, s->tally);
    for (int k = 0; k < n; k += 2)
      show_span(s, f, s->columns[k], s->columns[k + 1], j);
  }
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct frame s = {.job = job, .tally = job->tally};
  s.columns = HSR_NEW(job->scratch, int, hsr_most_corners(job->world) + 4);
  if (!s.columns || hsr_screen_make(&s.screen, job->world, job->view,
                                    job->scratch, job->tally))
    return hsr_fail_nomem(err);
  hsr_job_clear(job);
  for (uint32_t r = 0; r < s.screen.n_relevant; r++)
    show_face(&s, s.screen.relevant[r]);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_counter counters[] = {
    [SPANS] = {"spans", "stretches of a row that a face covers", HSR_SPAN,
               HSR_OF_FACE, HSR_OF_WINDOW},
    [DEPTH] = {"depth tests", "depths compared", HSR_COMPARE, HSR_OF_FACE,
               HSR_OF_FACE, "farther|nearer"},
    [WRITES] = {"writes", "samples given to a face", HSR_ACCEPT, HSR_OF_FACE,
                HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line outline[] = {
    {"for each relevant face"},
    {"  for each span of samples that it covers", HSR_RAISES(SPANS)},
    {"    for each sample of the span"},
    {"      is the face nearer than the one that the sample shows?",
     HSR_RAISES(DEPTH)},
    {"      if so, or if it shows none, show the face", HSR_RAISES(WRITES)},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(example) = {
    .name = "example",
    .title = "Faces one after another",
    .authors = "hsr",
    .source = "an example",
    .taxonomy = HSR_BRUTE_FORCE,
    .sort_order = "Z(XY)",
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .counters = counters,
    .outline = outline,
    .render = render};
