/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Brute force with a large memory: the z-buffer. */
#include "algorithms/algorithm.h"
#include "common/screen.h"

enum { SAMPLES, WRITES };

static const struct hsr_counter counters[] = {
    [SAMPLES] = {"depth tests", "depths compared with the z-buffer"},
    [WRITES] = {"writes", "samples written, overwrites counted each time"},
    {NULL, NULL}};

static double predict(const struct hsr_table1 *t) {
  return 10 * t->H_f * t->H_f * t->F_r;
}

static const struct hsr_step steps[] = {
    {"depth comparison", SAMPLES, 10, "10 H_f^2 F_r", predict},
    {NULL, 0, 0, NULL, NULL}};

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_screen screen;
  if (hsr_screen_make(&screen, job->world, job->view, job->scratch, job->tally))
    return hsr_fail_nomem(err);
  const struct hsr_window *w = &job->view->window;
  int *columns = HSR_NEW(job->scratch, int, job->world->n_corners + 4);
  if (!columns)
    return hsr_fail_nomem(err);
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      job->ids[(size_t)j * job->ids_stride + (size_t)i] = HSR_BACKGROUND;
  for (uint32_t r = 0; r < screen.n_relevant; r++) {
    uint32_t f = screen.relevant[r];
    for (int j = screen.bounds[f].y0; j < screen.bounds[f].y1; j++) {
      uint32_t *row = job->ids + (size_t)j * job->ids_stride;
      int n = hsr_face_spans(&screen, f, j, columns, job->tally);
      for (int k = 0; k < n; k += 2) {
        int x0 = columns[k] < w->x0 ? w->x0 : columns[k];
        int x1 = columns[k + 1] > w->x1 ? w->x1 : columns[k + 1];
        for (int i = x0; i < x1; i++) {
          HSR_STEP(job->tally, SAMPLES, HSR_COMPARE, f, row[i], i, j, i + 1,
                   j + 1);
          HSR_TOUCH(job->tally, i, j);
          if (row[i] == HSR_BACKGROUND ||
              hsr_nearer(&screen, f, row[i], i, j, job->tally)) {
            row[i] = f;
            HSR_COUNT(job->tally, WRITES, 1);
          }
        }
      }
    }
  }
  return HSR_OK;
}

const struct hsr_algorithm HSR_ALGORITHM(zbuffer) = {
    .name = "zbuffer",
    .title = "Brute force with a large memory: the z-buffer",
    .authors = "E. Catmull; Sutherland, Sproull and Schumacker",
    .year = 1974,
    .source = "Catmull, PhD thesis, University of Utah, 1974; Sutherland et "
              "al., Computing Surveys 6(1), 1974, appendix B",
    .taxonomy = HSR_BRUTE_FORCE,
    .sort_order = "Z(XY)",
    .kind = HSR_IDS,
    .counters = counters,
    .steps = steps,
    .render = render};
