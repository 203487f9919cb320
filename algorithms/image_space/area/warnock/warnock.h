/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnock's subdivision as other modules use it: windows are subdivided until
 * few faces are left in them; another algorithm solves these. See warnock.c.
 *
 * Source      Sutherland et al. 1974, "Other Combinations of Sorting": some
 *             subdivision, "say until fewer than 100 polygons remained", then
 *             Newell's method, or Watkins', within that area.
 * Few         How many faces to leave was measured at 512 x 512: the work in
 *             millions of comparisons, weighted as in Table III,
 *
 *             fewer than     4     16    100   1000  all of them  Warnock alone
 *             Watkins
 *               house      2.2    1.3    1.5    1.7      1.7          4.0
 *               harbor      16     10    8.4    6.5      5.3           21
 *               big harbor 141    119     95     65       33          147
 *             Newell
 *               house      2.0   0.48   0.28   0.25     0.24          4.0
 *               harbor      16    8.6    5.3    3.4      3.3           21
 *               big harbor 141    120     96     69       64          147
 *
 *             In the harbors most of it is Warnock special, at 100 for each
 *             face and window. Only with Watkins in the house is there a best
 *             number. So the survey's number is taken. */
#ifndef HSR_ALGORITHMS_WARNOCK_H
#define HSR_ALGORITHMS_WARNOCK_H

#include "algorithms/algorithm.h"
#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The other algorithm. It gets the windows that are neither homogeneous nor
 * simple, as soon as few faces are open in them: no more than most_faces, with
 * no more than most_corners corners in all. Open faces are the surrounders and
 * intersecters that no surrounder hides. */
struct hsr_finisher {
  uint32_t most_faces, most_corners;
  /* Solves a window, none of whose samples is covered by other faces than these
   * n. */
  void (*finish)(void *context, const struct hsr_window *window,
                 const uint32_t *faces, uint32_t n);
  void *context;
};

/* The survey's number: fewer than 100 faces. Faces have about four corners in
 * most scenes. */
enum { HSR_FEW_FACES = 99, HSR_FEW_CORNERS = 8 * HSR_FEW_FACES };

/* Solves the view's window, with windows left to `finisher`; NULL: Warnock's
 * algorithm solves all. The screen's faces have been culled. Memory from
 * job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_warnock_run(const struct hsr_job *job,
                                const struct hsr_screen *screen,
                                const struct hsr_finisher *finisher);

/* The part of the subdivision; and that of windows left to another algorithm.
 * Faces that a window inherits as disjoint or hidden are not looked at: their
 * counters are computed. Groups of lines of each outline: the tests of a
 * window; and what is done with a window that they do not decide. */
extern const struct hsr_part hsr_warnock_part, hsr_finished_part;
enum {
  HSR_WARNOCK_Z_SORT = HSR_FIRST_OF(HSR_PART_WARNOCK),
  HSR_WARNOCK_SPECIAL,
  HSR_WARNOCK_DEPTH_SEARCH,
  HSR_WARNOCK_WINDOWS,
  HSR_WARNOCK_SUBDIVISIONS,
  HSR_WARNOCK_MINIMAX,
  HSR_WARNOCK_OLD_SURROUNDERS,
  HSR_WARNOCK_OLD_DISJOINTS,
  HSR_WARNOCK_HIDDEN_FACES,
  HSR_WARNOCK_EMPTY,
  HSR_WARNOCK_HOMOGENEOUS,
  HSR_WARNOCK_ONE_FACE,
  HSR_WARNOCK_ONE_IN_FRONT,
  HSR_WARNOCK_SAMPLES,
  HSR_WARNOCK_RUNS
};
enum { HSR_WARNOCK_FINISHED = HSR_FIRST_OF(HSR_PART_FINISHED) };
enum { HSR_WINDOW_LINES, HSR_DIVIDE_LINES };

#ifdef __cplusplus
}
#endif
#endif
