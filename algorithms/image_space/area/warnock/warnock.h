/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnock's subdivision as other algorithms use it: until few faces are left in
 * a window. See warnock.c.
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

/* Solves windows that are neither homogeneous nor simple, once few faces are
 * open in them: no more than most_faces, with no more than most_corners corners
 * in all. Open faces are the surrounders and intersecters that no surrounder
 * hides. */
struct hsr_finisher {
  uint32_t most_faces, most_corners;
  void (*finish)(void *context, const struct hsr_window *window,
                 const uint32_t *faces, uint32_t n);
  void *context;
};

/* Few faces: fewer than 100. Scenes have four corners a face or so. */
enum { HSR_FEW_FACES = 99, HSR_FEW_CORNERS = 8 * HSR_FEW_FACES };

/* The view's window. The finisher counts from HSR_WARNOCK_FINISHER on.
 * HSR_E_NOMEM. */
enum hsr_status hsr_warnock_run(const struct hsr_job *job,
                                const struct hsr_screen *screen,
                                const struct hsr_finisher *finisher);

/* The counters that it keeps, in their order. Faces that are inherited as
 * disjoint or hidden are not looked at: their counters are computed. */
enum {
  HSR_WARNOCK_Z_SORT,
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
  HSR_WARNOCK_RUNS,
  HSR_N_WARNOCK_COUNTERS,
  HSR_WARNOCK_FINISHED = HSR_N_WARNOCK_COUNTERS,
  HSR_WARNOCK_FINISHER /* the first of the finisher's own */
};
#define HSR_WARNOCK_COUNTERS                                                   \
  {"Z sort", "faces put into buckets, in each of two passes", HSR_SORT,        \
   HSR_OF_FACE},                                                               \
      {"Warnock special", "faces tested against a window",                     \
       HSR_COMPARE,       HSR_OF_FACE,                                         \
       HSR_OF_WINDOW,     "disjoint|intersecter|surrounder"},                  \
      {"depth search", "faces compared in depth with a surrounder",            \
       HSR_COMPARE,    HSR_OF_FACE,                                            \
       HSR_OF_FACE,    "undecided|behind|in front"},                           \
      {"windows", "windows examined", HSR_ACTIVATE, HSR_OF_WINDOW},            \
      {"subdivisions", "windows divided into smaller ones", HSR_SUBDIVIDE,     \
       HSR_OF_WINDOW},                                                         \
      {"minimax culls", "faces tested that their boxes decided",               \
       HSR_COMPARE,     HSR_OF_FACE,                                           \
       HSR_OF_WINDOW,   "disjoint|intersecter"},                               \
      {"inherited surrounders",                                                \
       "faces not tested, since they surround a larger window", HSR_ACTIVATE,  \
       HSR_OF_FACE, HSR_OF_WINDOW},                                            \
      {"inherited disjoints",                                                  \
       "faces not tested, since they are disjoint from a larger window",       \
       HSR_REJECT,                                                             \
       HSR_OF_FACE,                                                            \
       HSR_OF_WINDOW,                                                          \
       NULL,                                                                   \
       true},                                                                  \
      {"hidden faces",                                                         \
       "faces not tested, since a surrounder hides them",                      \
       HSR_REJECT,                                                             \
       HSR_OF_FACE,                                                            \
       HSR_OF_WINDOW,                                                          \
       NULL,                                                                   \
       true},                                                                  \
      {"empty windows", "decided: no face in them", HSR_ACCEPT, HSR_OF_FACE,   \
       HSR_OF_WINDOW},                                                         \
      {"homogeneous windows", "decided: a critical surround", HSR_ACCEPT,      \
       HSR_OF_FACE, HSR_OF_WINDOW},                                            \
      {"one face", "decided: no surrounder and one intersecter", HSR_ACCEPT,   \
       HSR_OF_FACE, HSR_OF_FACE},                                              \
      {"one in front",                                                         \
       "decided: one intersecter before the critical surround", HSR_ACCEPT,    \
       HSR_OF_FACE, HSR_OF_FACE},                                              \
      {"samples", "decided: windows of a single sample", HSR_ACCEPT,           \
       HSR_OF_FACE, HSR_OF_WINDOW},                                            \
  {                                                                            \
    "runs", "runs of samples of the one intersecter", HSR_ACCEPT, HSR_OF_FACE, \
        HSR_OF_WINDOW                                                          \
  }
#define HSR_FINISHED_COUNTERS                                                  \
  HSR_WARNOCK_COUNTERS, {                                                      \
    "finished windows", "left to the other algorithm", HSR_RETIRE,             \
        HSR_OF_WINDOW                                                          \
  }

/* The lines of the outline: of a window, and of what remains of one. */
#define HSR_WARNOCK_WINDOW_LINES                                               \
  {"Z sort: put the faces into buckets by depth, in two passes",               \
   HSR_RAISES(HSR_WARNOCK_Z_SORT)},                                            \
      {"for each window, of which the picture is the first",                   \
       HSR_RAISES(HSR_WARNOCK_WINDOWS)},                                       \
      {"  for each face, in Z order: disjoint, an intersecter, a surrounder?", \
       HSR_RAISES(HSR_WARNOCK_SPECIAL) | HSR_RAISES(HSR_WARNOCK_MINIMAX)},     \
      {"    inherit what is known from a larger window",                       \
       HSR_RAISES(HSR_WARNOCK_OLD_SURROUNDERS) |                               \
           HSR_RAISES(HSR_WARNOCK_OLD_DISJOINTS)},                             \
      {"    stop at the first face that is behind all of a surrounder",        \
       HSR_RAISES(HSR_WARNOCK_HIDDEN_FACES)},                                  \
      {"  find the critical surround; which faces are behind it?",             \
       HSR_RAISES(HSR_WARNOCK_DEPTH_SEARCH)},                                  \
      {"  if the window is homogeneous, show the surround or the background",  \
       HSR_RAISES(HSR_WARNOCK_EMPTY) | HSR_RAISES(HSR_WARNOCK_HOMOGENEOUS) |   \
           HSR_RAISES(HSR_WARNOCK_SAMPLES)},                                   \
      {"  if one intersecter is left, show what is behind it",                 \
       HSR_RAISES(HSR_WARNOCK_ONE_FACE) |                                      \
           HSR_RAISES(HSR_WARNOCK_ONE_IN_FRONT)},                              \
  {                                                                            \
    "    and then the intersecter", HSR_RAISES(HSR_WARNOCK_RUNS)               \
  }
#define HSR_WARNOCK_LINES                                                      \
  HSR_WARNOCK_WINDOW_LINES, {                                                  \
    "  else divide the window into four", HSR_RAISES(HSR_WARNOCK_SUBDIVISIONS) \
  }
#define HSR_FINISHED_LINES                                                     \
  HSR_WARNOCK_WINDOW_LINES, {                                                  \
    "  else divide the window into four; but leave few faces to the other "    \
    "algorithm:",                                                              \
        HSR_RAISES(HSR_WARNOCK_SUBDIVISIONS) |                                 \
            HSR_RAISES(HSR_WARNOCK_FINISHED)                                   \
  }

/* The same for the arrays of steps and sorts. Figure 29b being lost, the sorts
 * are reconstructed from the text. */
#define HSR_WARNOCK_STEPS                                                      \
  {"Z sort", HSR_WARNOCK_Z_SORT, 1, "2 F_r", hsr_predict_warnock_z_sort},      \
      {"Warnock special", HSR_WARNOCK_SPECIAL, 100, "100 L_v D_c",             \
       hsr_predict_warnock_special},                                           \
  {                                                                            \
    "depth search", HSR_WARNOCK_DEPTH_SEARCH, 1, "L_v D_c",                    \
        hsr_predict_warnock_depth_search                                       \
  }
#define HSR_WARNOCK_SORTS                                                      \
  {"faces", "Z", "radix 512 Quicksort, two passes", "once a frame"},           \
      {"faces", "(XY)", "radix 4 Quicksort: cull and subdivision",             \
       "once a window"},                                                       \
  {                                                                            \
    "surrounders and intersecters", "Z", "exhaustive search at the corners",   \
        "once a window"                                                        \
  }

static inline double hsr_predict_warnock_z_sort(const struct hsr_table1 *t) {
  return 2 * t->F_r;
}
static inline double hsr_predict_warnock_special(const struct hsr_table1 *t) {
  return 100 * t->L_v * t->D_c;
}
static inline double
hsr_predict_warnock_depth_search(const struct hsr_table1 *t) {
  return t->L_v * t->D_c;
}

#ifdef __cplusplus
}
#endif
#endif
