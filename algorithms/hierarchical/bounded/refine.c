/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Refine of the thesis, 5.4.3: the order in which cells are divided, the
 * passes, and when to stop. */
#include "algorithms/hierarchical/bounded/refine.h"
#include "common/answers/kinds/area.h"

#include <math.h>

double hsr_bounded_width(const double lo[3], const double hi[3]) {
  double width = 0;
  for (int c = 0; c < 3; c++)
    width = fmax(width, hi[c] - lo[c]);
  return width;
}

void hsr_bounded_accept(const struct hsr_bounded_refining *r, int i, int j) {
  const struct hsr_bounded_tree *t = r->tree;
  size_t at = (size_t)j * (size_t)t->job->answer->m + (size_t)i;
  HSR_ACCEPTED(t->tally, HSR_BOUNDED_PIXELS, HSR_NOTHING, HSR_NOTHING,
               HSR_AT(i, j), r->answer + 3 * at);
}

/* Has a limit been reached? */
static bool is_over(const struct hsr_bounded_refining *r) {
  return r->tree->n_cells > r->limits->cells || hsr_bounded_is_late(r->tree);
}

static void end_pass(struct hsr_bounded_refining *r,
                     const struct hsr_bounded_way *way, int *pass) {
  const struct hsr_job *job = r->tree->job;
  if (!job->passes)
    return;
  way->write(r);
  job->passes->show(job->passes->whom, job->answer, (*pass)++);
}

/* A pass is one size, or as many cells as there were pixels to be refined. */
static bool refine(struct hsr_bounded_refining *r,
                   const struct hsr_bounded_way *way, int *pass) {
  uint64_t steps = 0, first = r->unfinished;
  struct hsr_bounded_item item;
  for (int size = 0; r->unfinished && hsr_bounded_pop(&r->queue, &item);) {
    if (r->queue.order == HSR_BOUNDED_LEVELS && r->queue.at != size) {
      size = r->queue.at;
      if (steps)
        end_pass(r, way, pass);
    }
    if (is_over(r))
      return true;
    if (!way->is_wanted(r, &item))
      continue;
    HSR_STEP(
        r->tree->tally, HSR_BOUNDED_REFINED,
        hsr_bounded_subject(hsr_bounded_cell(r->tree, item.cell)), HSR_NOTHING,
        hsr_bounded_window(r->tree, hsr_bounded_cell(r->tree, item.cell)), 0);
    if (!way->refine(r, &item))
      return false;
    if (++steps % first == 0 && r->queue.order == HSR_BOUNDED_QUEUE)
      end_pass(r, way, pass);
  }
  return true;
}

enum hsr_status hsr_bounded_refine(struct hsr_bounded_tree *t,
                                   const struct hsr_bounded_limits *limits,
                                   struct hsr_error *err) {
  const struct hsr_bounded_way *way = limits->form.filter == HSR_AREA_BOX
                                          ? &hsr_bounded_within_pixels
                                          : &hsr_bounded_across_pixels;
  struct hsr_bounded_refining r = {
      .tree = t,
      .limits = limits,
      .answer = hsr_answer_areas_of(t->job->answer),
      .queue = {.order = limits->order, .arena = t->job->scratch}};
  int pass = 0;
  if (!way->begin(&r))
    return hsr_fail_nomem(err);
  end_pass(&r, way, &pass);
  if (!refine(&r, way, &pass))
    return hsr_fail_nomem(err);
  end_pass(&r, way, &pass);
  way->accept_rest(&r);
  return HSR_OK;
}
