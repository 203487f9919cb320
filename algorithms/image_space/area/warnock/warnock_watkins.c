/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnock's subdivision until few faces are left in a window, then Watkins'
 * scan lines within it.
 *
 * Source      Sutherland et al. 1974, "Other Combinations of Sorting": a
 *             proposal in two sentences, and its sorting order (XY)p YXZ, p for
 *             a partial sort.
 * Notation    that of warnock.c and of watkins.c; how few faces: warnock.h
 * Ties        those of watkins.c
 * Departures  those of warnock.c and of scan_line.h; an edge beyond the
 *             window's sides stays in the X sort list, since it ends a segment
 * Cost        the steps of both, with the predictions for each alone. Here
 *             Warnock special ends early. Watkins' steps leave out the faces
 *             that a surrounder hides, but take a face once for each window
 *             that it is in */
#include "algorithms/image_space/area/warnock/warnock.h"
#include "algorithms/image_space/point/watkins.h"

static void finish(void *watkins, const struct hsr_window *window,
                   const uint32_t *faces, uint32_t n) {
  hsr_watkins_solve(watkins, window, faces, n);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  /* Any of the faces may be cut, and then has up to four ends more. */
  static const struct hsr_scan_room room = {.edges = HSR_FEW_CORNERS +
                                                     4 * HSR_FEW_FACES,
                                            .cut = HSR_FEW_FACES,
                                            .columns = HSR_FEW_CORNERS + 4};
  struct hsr_screen screen;
  struct hsr_watkins watkins;
  struct hsr_finisher finisher = {HSR_FEW_FACES, HSR_FEW_CORNERS, finish,
                                  &watkins};
  if (hsr_screen_make(&screen, job->world, job->view, job->scratch,
                      job->tally) ||
      hsr_watkins_reserve(&watkins, job, &screen, room, job->world->n_faces) ||
      hsr_warnock_run(job, &screen, &finisher))
    return hsr_fail_nomem(err);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_warnock_part},
                                      {&hsr_finished_part},
                                      {&hsr_scan_part, "Watkins: "},
                                      {&hsr_spans_part, "Watkins: "},
                                      {&hsr_depth_search_part, "Watkins: "},
                                      {NULL}};

static const struct hsr_sort sorts[] = {{.part = &hsr_warnock_part},
                                        {.part = &hsr_scan_part},
                                        {.part = &hsr_spans_part},
                                        {.part = &hsr_depth_search_part},
                                        {NULL}};

static const struct hsr_line outline[] = {
    {"", .part = &hsr_finished_part},
    {"", .part = &hsr_finished_part, .group = HSR_DIVIDE_LINES},
    {"    ", .part = &hsr_scan_part},
    {"    ", .part = &hsr_spans_part},
    {"    ", .part = &hsr_depth_search_part},
    {"    ", .part = &hsr_spans_part, .group = HSR_LINES_AFTER_SEARCH},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(warnock_watkins) = {
    .name = "warnock-watkins",
    .title = "Warnock's subdivision, then Watkins' scan lines",
    .authors = "I. E. Sutherland, R. F. Sproull, R. A. Schumacker",
    .year = 1974,
    .source = "proposed in Computing Surveys 6(1), 1974, \"Other Combinations "
              "of Sorting\"",
    .taxonomy = HSR_IMAGE_SPACE_AREA,
    .sort_order = "(XY)p YXZ",
    .coherence = "area; scan line; edge; floating right end of the sample span",
    .restrictions = 0,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .sorts = sorts,
    .parts = uses,
    .outline = outline,
    .render = render};
