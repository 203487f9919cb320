/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Brute force with a large memory: the z-buffer.
 *
 * Source      Sutherland, Sproull and Schumacker 1974, appendix B, "Brute-Force
 *             Image-Space"; E. Catmull, PhD thesis, University of Utah, 1974.
 * Notation    raster element -> sample (i, j); recorded colour -> the id of a
 *             face, in the answer's ids; recorded depth -> depth[]. A depth is
 *             q = 1/t, or -t in parallel projection: greater is nearer.
 * Invariant   after each face, every sample holds the id and the depth of the
 *             nearest of the faces so far that cover it; if none covers it, it
 *             holds HSR_BACKGROUND and its depth is not set
 * Ties        two depths may differ by less than their error bounds. Then
 *             hsr_nearer_by compares them exactly. Of two faces in one plane,
 *             the lower id is nearer
 * Departures  the culls that the paper calls universally applicable come first.
 *             The first face at a sample is compared with no recorded depth,
 *             but counts as one depth test.
 * Cost        10 H_f^2 F_r predicted
 *
 * The module zbuffer-fast (zbuffer_fast/) is the same algorithm in floats, in
 * batches, with transparent faces and shadows. */
#include "algorithms/algorithm.h"
#include "common/exact/screen.h"

enum { DEPTH_TESTS, WRITES, OVERWRITES };

/* One frame. The memory has two parts, for the samples of the window, by rows:
 * ids, which are the answer's, and depths. */
struct frame {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  struct hsr_screen screen;
  double *depth; /* set only where there is a face */
  int *columns;  /* the ends of a face's spans on a row (hsr_face_spans) */
};

static double *recorded_depth(const struct frame *s, int i, int j) {
  const struct hsr_window *w = &s->job->view->window;
  return &s->depth[(size_t)(j - w->y0) * (size_t)(w->x1 - w->x0) +
                   (size_t)(i - w->x0)];
}

/* Is face f, at depth q, nearer than the recorded face `held`, at held_q? */
static bool is_nearer(const struct frame *s, uint32_t f, double q,
                      uint32_t held, double held_q, int i, int j) {
  bool nearer = held == HSR_BACKGROUND ||
                hsr_nearer_by(&s->screen, f, held, q - held_q,
                              hsr_sample_x(s->job->view, i),
                              hsr_sample_y(s->job->view, j), s->tally);
  HSR_STEP(s->tally, DEPTH_TESTS, HSR_FACE(f), HSR_FACE(held), HSR_AT(i, j),
           nearer);
  return nearer;
}

/* Replaces what is recorded by face f and its depth. */
static void record(const struct frame *s, uint32_t f, double q, uint32_t *held,
                   double *held_q, int i, int j) {
  HSR_STEP(s->tally, WRITES, HSR_FACE(f), HSR_FACE(*held), HSR_AT(i, j), 0);
  if (*held != HSR_BACKGROUND)
    HSR_STEP(s->tally, OVERWRITES, HSR_FACE(*held), HSR_FACE(f), HSR_AT(i, j),
             0);
  *held = f;
  *held_q = q;
}

/* Face f covers the samples [x0, x1) of row j. Compares and records it at those
 * in the window. */
static void scan_span(const struct frame *s, uint32_t f, int x0, int x1,
                      int j) {
  const struct hsr_window *w = &s->job->view->window;
  uint32_t *row = hsr_job_row(s->job, j);
  x0 = x0 > w->x0 ? x0 : w->x0;
  x1 = x1 < w->x1 ? x1 : w->x1;
  for (int i = x0; i < x1; i++) {
    double q = hsr_depth(&s->screen, f, i, j);
    double *held_q = recorded_depth(s, i, j);
    HSR_TOUCH(s->tally, i, j);
    if (is_nearer(s, f, q, row[i], *held_q, i, j))
      record(s, f, q, &row[i], held_q, i, j);
  }
}

/* Scan-converts face f, row by row. */
static void scan_face(const struct frame *s, uint32_t f) {
  const struct hsr_bounds *bounds = &s->screen.bounds[f];
  struct hsr_face_rows rows;
  hsr_face_rows_begin(&rows, &s->screen, f, s->tally);
  for (int j = bounds->y0; j < bounds->y1; j++) {
    int n = hsr_face_rows_spans(&rows, j, s->columns, s->tally);
    for (int k = 0; k < n; k += 2)
      scan_span(s, f, s->columns[k], s->columns[k + 1], j);
  }
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct frame s = {.job = job, .tally = job->tally};
  const struct hsr_window *w = &job->view->window;
  s.depth = HSR_NEW(job->scratch, double,
                    (size_t)(w->x1 - w->x0) * (size_t)(w->y1 - w->y0));
  s.columns = HSR_NEW(job->scratch, int, hsr_most_corners(job->world) + 4);
  if (!s.depth || !s.columns ||
      hsr_screen_make(&s.screen, job->world, job->view, job->scratch,
                      job->tally))
    return hsr_fail_nomem(err);
  hsr_job_clear(job); /* where there is no face, no depth is compared */
  for (uint32_t r = 0; r < s.screen.n_relevant; r++)
    scan_face(&s, s.screen.relevant[r]);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_counter counters[] = {
    [DEPTH_TESTS] = {"depth tests", "depths compared with the recorded ones",
                     HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    [WRITES] = {"writes", "samples written, overwrites counted each time",
                HSR_ACCEPT, HSR_OF_FACE, HSR_OF_FACE},
    [OVERWRITES] = {"overwrites", "writes where there was a face already",
                    HSR_RETIRE, HSR_OF_FACE, HSR_OF_FACE},
    {NULL}};

static const struct hsr_line outline[] = {
    {"clear the memory: at each raster element, no face"},
    {"for each relevant face"},
    {"  for each raster element that it covers, row by row"},
    {"    is it nearer than the recorded depth?", HSR_RAISES(DEPTH_TESTS)},
    {"      if so, record its depth and its id", HSR_RAISES(WRITES)},
    {"        instead of those of another face", HSR_RAISES(OVERWRITES)},
    {"show the recorded ids"},
    {NULL}};

static double predict_comparisons(const struct hsr_table1 *t) {
  return 10 * t->H_f * t->H_f * t->F_r;
}

static const struct hsr_step steps[] = {{"depth comparison", DEPTH_TESTS,
                                         HSR_KIND_SAMPLE, "10 H_f^2 F_r",
                                         predict_comparisons},
                                        {"writes", WRITES, HSR_KIND_WRITE},
                                        {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(zbuffer) = {
    .name = "zbuffer",
    .title = "Brute force with a large memory: the z-buffer",
    .authors = "E. Catmull; Sutherland, Sproull and Schumacker",
    .year = 1974,
    .source = "Catmull, PhD thesis, University of Utah, 1974; Sutherland et "
              "al., Computing Surveys 6(1), 1974, appendix B",
    .taxonomy = HSR_BRUTE_FORCE,
    .sort_order = "Z(XY)",
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .counters = counters,
    .outline = outline,
    .steps = steps,
    .render = render};
