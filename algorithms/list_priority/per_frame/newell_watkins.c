/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newell's priority computer, then Watkins' scan lines, whose last step
 * compares priority numbers instead of depths.
 *
 * Source      suggested by E. Catmull and M. E. Newell, as Sutherland et al.
 *             1974 report under "Other Combinations of Sorting": a few
 *             sentences.
 * Notation    the list -> priority_list.h; scan line, segment, sample span ->
 *             watkins.c; priority number -> priority_scan.h
 * Invariant   that of priority_scan.h
 * Ties        those of priority_list.h; among thick faces, by hsr_nearer
 * Departures  Those of priority_list.h, priority_scan.h and scan_line.h. A divided
 *             face is its face and cuts, and gives its columns a row at a time
 *             (hsr_piece_spans).
 * Cost        those of priority_list.h; of watkins.c all but the depth search:
 *             a priority search is one comparison, where Table III has 30 */
#include "algorithms/list_priority/per_frame/priority_scan.h"

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_screen screen;
  struct hsr_priority_scan scan;
  if (hsr_screen_make(&screen, job->world, job->view, job->scratch,
                      job->tally) ||
      hsr_priority_scan_reserve(&scan, job, &screen, NULL) ||
      hsr_priority_scan_add(&scan, screen.relevant, screen.n_relevant) ||
      hsr_priority_scan_solve(&scan))
    return hsr_fail_nomem(err);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_list_part},
                                      {&hsr_scan_part},
                                      {&hsr_spans_part},
                                      {&hsr_priority_search_part},
                                      {NULL}};

static const struct hsr_line outline[] = {
    {"", .part = &hsr_list_part},
    {"  give P the next priority number"},
    {"", .part = &hsr_scan_part},
    {"", .part = &hsr_spans_part},
    {"", .part = &hsr_priority_search_part},
    {"", .part = &hsr_spans_part, .group = HSR_LINES_AFTER_SEARCH},
    {NULL}};

static const struct hsr_sort sorts[] = {{.part = &hsr_list_part},
                                        {.part = &hsr_scan_part},
                                        {.part = &hsr_spans_part},
                                        {.part = &hsr_priority_search_part},
                                        {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(newell_watkins) = {
    .name = "newell-watkins",
    .title = "Newell's priority list, then Watkins' scan lines",
    .authors = "E. Catmull, M. E. Newell",
    .year = 1974,
    .source = "suggested by both, as Sutherland et al., Computing Surveys "
              "6(1), 1974, report under \"Other Combinations of Sorting\"",
    .taxonomy = HSR_LIST_PRIORITY_PER_FRAME,
    .sort_order = "ZYXZ",
    .coherence = "depth; scan line; edge; floating right end of the sample "
                 "span",
    .restrictions = 0,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .sorts = sorts,
    .parts = uses,
    .outline = outline,
    .render = render};
