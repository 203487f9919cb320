/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnock's subdivision until few faces are left in a window, then Newell's
 * priority list and beads within it.
 *
 * Source      Sutherland et al. 1974, "Other Combinations of Sorting": a
 *             proposal in two sentences, and its sorting order (XY)p ZYX, p for
 *             a partial sort.
 * Notation    that of warnock.c, priority_list.h and newell.c; how few faces:
 *             warnock.h
 * Ties        those of priority_list.h
 * Departures  those of all three; the depths of a piece, by which the list is
 *             sorted, are those that it has in the window, as though it had
 *             been clipped to it
 * Cost        the steps of both, with the predictions for each alone. Here
 *             Warnock special ends early. Newell's steps leave out the faces
 *             that a surrounder hides, but take a face once for each window
 *             that it is in */
#include "algorithms/list_priority/per_frame/newell.h"
#include "algorithms/image_space/area/warnock/warnock.h"

static const struct hsr_counter counters[] = {
    HSR_FINISHED_COUNTERS, HSR_NEWELL_COUNTERS("Newell: "), {NULL}};

static const struct hsr_step steps[] = {
    HSR_WARNOCK_STEPS,
    HSR_NEWELL_STEPS(HSR_WARNOCK_FINISHER, "Newell: "),
    {NULL}};

static const struct hsr_sort sorts[] = {
    HSR_WARNOCK_SORTS, HSR_LIST_SORTS, HSR_BEAD_SORTS, {NULL}};

static const struct hsr_line outline[] = {
    HSR_FINISHED_LINES,
    HSR_NEWELL_OUTLINE(HSR_WARNOCK_FINISHER, "    "),
    {NULL}};

static void finish(void *newell, const struct hsr_window *window,
                   const uint32_t *faces, uint32_t n) {
  hsr_newell_solve(newell, window, faces, n);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_screen screen;
  struct hsr_newell newell;
  struct hsr_finisher finisher = {HSR_FEW_FACES, HSR_FEW_CORNERS, finish,
                                  &newell};
  if (hsr_screen_make(&screen, job->world, job->view, job->scratch,
                      job->tally) ||
      hsr_newell_reserve(&newell, job, &screen, NULL, HSR_FEW_FACES))
    return hsr_fail_nomem(err);
  newell.list.parts = true;
  if (hsr_warnock_run(job, &screen, &finisher) || newell.list.out_of_memory)
    return hsr_fail_nomem(err);
  return HSR_OK;
}

const struct hsr_algorithm HSR_ALGORITHM(warnock_newell) = {
    .name = "warnock-newell",
    .title = "Warnock's subdivision, then Newell's priority list",
    .authors = "I. E. Sutherland, R. F. Sproull, R. A. Schumacker",
    .year = 1974,
    .source = "proposed in Computing Surveys 6(1), 1974, \"Other Combinations "
              "of Sorting\"",
    .taxonomy = HSR_IMAGE_SPACE_AREA,
    .sort_order = "(XY)p ZYX",
    .coherence = "area; depth",
    .restrictions = 0,
    .subjects = 1 << HSR_FACES,
    .kind = HSR_IDS,
    .sorts = sorts,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .render = render};
