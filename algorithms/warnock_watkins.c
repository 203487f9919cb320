/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnock's subdivision until few faces are left in a window, and there
 * Watkins' scan lines.
 *
 * Source      Sutherland et al. 1974, "Other Combinations of Sorting": (XY)p
 *             YXZ, a partial sort in (XY) before the one of Watkins; proposed
 *             in two sentences.
 */
#include "algorithms/warnock.h"
#include "algorithms/watkins.h"
#include <stdlib.h>

enum { MOST_FACES = 32, MOST_CORNERS = 8 * MOST_FACES };

static const struct hsr_counter counters[] = {
    HSR_FINISHED_COUNTERS, HSR_WATKINS_COUNTERS("Watkins: "), {NULL, NULL}};

static const struct hsr_step steps[] = {
    HSR_WARNOCK_STEPS,
    HSR_WATKINS_STEPS(HSR_WARNOCK_FINISHER, "Watkins: "),
    {NULL, 0, 0, NULL, NULL}};

static const struct hsr_sort sorts[] = {
    HSR_WARNOCK_SORTS, HSR_WATKINS_SORTS, {NULL, NULL, NULL, NULL}};

static void finish(void *watkins, const struct hsr_window *window,
                   const uint32_t *faces, uint32_t n) {
  hsr_watkins_solve(watkins, window, faces, n);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  uint32_t K = getenv("K") ? (uint32_t)atoi(getenv("K")) : MOST_FACES;
  const struct hsr_scan_room room = {
      .edges = 12*K, .cut = K, .columns = 8*K+4};
  struct hsr_screen screen;
  struct hsr_watkins watkins;
  const struct hsr_finisher finisher = {K, 8 * K, finish, &watkins};
  if (hsr_screen_make(&screen, job->world, job->view, job->scratch,
                      job->tally) ||
      hsr_watkins_reserve(&watkins, job, &screen, room, job->world->n_faces) ||
      hsr_warnock_run(job, &screen, &finisher))
    return hsr_fail_nomem(err);
  return HSR_OK;
}

const struct hsr_algorithm HSR_ALGORITHM(warnock_watkins) = {
    .name = "warnock-watkins",
    .title = "Warnock's subdivision, then Watkins' scan lines",
    .authors = "I. E. Sutherland, R. F. Sproull, R. A. Schumacker",
    .year = 1974,
    .source = "proposed in Sutherland et al., Computing Surveys 6(1), 1974, "
              "\"Other Combinations of Sorting\"",
    .taxonomy = HSR_IMAGE_SPACE_AREA,
    .sort_order = "(XY)p YXZ",
    .coherence = "area; scan line; edge; floating right end of the sample span",
    .restrictions = 0,
    .kind = HSR_IDS,
    .sorts = sorts,
    .counters = counters,
    .steps = steps,
    .render = render};
