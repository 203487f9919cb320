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

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_warnock_part},           {&hsr_finished_part},
    {&hsr_list_part, "Newell: "},  {&hsr_painting_part, "Newell: "},
    {&hsr_beads_part, "Newell: "}, {NULL}};

static const struct hsr_sort sorts[] = {{.part = &hsr_warnock_part},
                                        {.part = &hsr_list_part},
                                        {.part = &hsr_beads_part},
                                        {NULL}};

static const struct hsr_line outline[] = {
    {"", .part = &hsr_finished_part},
    {"", .part = &hsr_finished_part, .group = HSR_DIVIDE_LINES},
    {"    ", .part = &hsr_list_part},
    {"    ", .part = &hsr_painting_part},
    {"    ", .part = &hsr_beads_part},
    {NULL}};

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
    .makes = {{HSR_IDS}},
    .sorts = sorts,
    .parts = uses,
    .outline = outline,
    .render = render};
