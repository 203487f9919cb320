/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Brute force with a large memory: the z-buffer.
 *
 * Source      Sutherland, Sproull and Schumacker 1974, appendix B, "Brute-Force
 *             Image-Space"; E. Catmull, PhD thesis, University of Utah, 1974.
 * Notation    raster element -> sample (i, j); recorded depth -> z, as q = 1/t,
 *             or in parallel projection -t: greater is nearer
 * Invariant   after each face, every sample has the id and the depth of the
 *             nearest of the faces so far that cover it
 * Ties        depths that are closer than their bounds are compared by
 *             hsr_nearer's exact fallback, which knows the picture's order
 * Departures  none in what is compared: the culls that the paper calls
 *             universally applicable come first
 * Cost        10 H_f^2 F_r predicted
 *
 * zbuffer_fast/ is the same for those who want the picture soon: in batches, in
 * floats, with transparent faces and shadows. */
#include "algorithms/algorithm.h"
#include "common/exact/screen.h"

enum { DEPTH, WRITES, OVERWRITES };

/* One frame. The two memories are for the samples of the window, by rows. */
struct frame {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  struct hsr_screen screen;
  double *z;    /* depths, where there is a face */
  int *columns; /* the ends of a face's spans on a row */
};

static double *recorded(const struct frame *s, int i, int j) {
  const struct hsr_window *w = &s->job->view->window;
  return &s->z[(size_t)(j - w->y0) * (size_t)(w->x1 - w->x0) +
               (size_t)(i - w->x0)];
}

/* Is face f, at depth q, nearer than what is recorded? */
static bool is_nearer(const struct frame *s, uint32_t f, double q,
                      uint32_t held, double z, int i, int j) {
  bool nearer =
      held == HSR_BACKGROUND ||
      hsr_nearer_by(&s->screen, f, held, q - z, hsr_sample_x(s->job->view, i),
                    hsr_sample_y(s->job->view, j), s->tally);
  HSR_STEP(s->tally, DEPTH, HSR_FACE(f), HSR_FACE(held), HSR_AT(i, j), nearer);
  return nearer;
}

static void record(const struct frame *s, uint32_t f, double q, uint32_t *held,
                   double *z, int i, int j) {
  HSR_STEP(s->tally, WRITES, HSR_FACE(f), HSR_FACE(*held), HSR_AT(i, j), 0);
  if (*held != HSR_BACKGROUND)
    HSR_STEP(s->tally, OVERWRITES, HSR_FACE(*held), HSR_FACE(f), HSR_AT(i, j),
             0);
  *held = f;
  *z = q;
}

/* Face f at the samples [x0, x1) of row j, as far as they are in the window. */
static void tile_span(const struct frame *s, uint32_t f, int x0, int x1,
                      int j) {
  const struct hsr_window *w = &s->job->view->window;
  uint32_t *row = hsr_job_row(s->job, j);
  x0 = x0 > w->x0 ? x0 : w->x0;
  x1 = x1 < w->x1 ? x1 : w->x1;
  for (int i = x0; i < x1; i++) {
    double q = hsr_depth(&s->screen, f, i, j), *z = recorded(s, i, j);
    HSR_TOUCH(s->tally, i, j);
    if (is_nearer(s, f, q, row[i], *z, i, j))
      record(s, f, q, &row[i], z, i, j);
  }
}

static void tile_face(const struct frame *s, uint32_t f) {
  const struct hsr_bounds *bounds = &s->screen.bounds[f];
  struct hsr_face_rows rows;
  hsr_face_rows_begin(&rows, &s->screen, f, s->tally);
  for (int j = bounds->y0; j < bounds->y1; j++) {
    int n = hsr_face_rows_spans(&rows, j, s->columns, s->tally);
    for (int k = 0; k < n; k += 2)
      tile_span(s, f, s->columns[k], s->columns[k + 1], j);
  }
}

static void clear(const struct hsr_job *job) {
  const struct hsr_window *w = &job->view->window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      hsr_job_row(job, j)[i] = HSR_BACKGROUND;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct frame s = {.job = job, .tally = job->tally};
  const struct hsr_window *w = &job->view->window;
  s.z = HSR_NEW(job->scratch, double,
                (size_t)(w->x1 - w->x0) * (size_t)(w->y1 - w->y0));
  s.columns = HSR_NEW(job->scratch, int, hsr_most_corners(job->world) + 4);
  if (!s.z || !s.columns ||
      hsr_screen_make(&s.screen, job->world, job->view, job->scratch,
                      job->tally))
    return hsr_fail_nomem(err);
  clear(job);
  for (uint32_t r = 0; r < s.screen.n_relevant; r++)
    tile_face(&s, s.screen.relevant[r]);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_counter counters[] = {
    [DEPTH] = {"depth tests", "depths compared with the recorded ones",
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
    {"    is it nearer than the recorded depth?", HSR_RAISES(DEPTH)},
    {"      if so, record its depth and its id", HSR_RAISES(WRITES)},
    {"        instead of those of another face", HSR_RAISES(OVERWRITES)},
    {"show the recorded ids"},
    {NULL}};

static double predict_tiling(const struct hsr_table1 *t) {
  return 10 * t->H_f * t->H_f * t->F_r;
}

static const struct hsr_step steps[] = {
    {"depth comparison", DEPTH, 10, "10 H_f^2 F_r", predict_tiling}, {NULL}};

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
    .kind = HSR_IDS,
    .counters = counters,
    .outline = outline,
    .steps = steps,
    .render = render};
