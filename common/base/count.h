/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Counting what an algorithm does, and tracing it.
 *
 * HSR_COUNT and HSR_STEP compile to nothing unless HSR_COUNTING is 1. Their
 * arguments must not have side effects. */
#ifndef HSR_COMMON_COUNT_H
#define HSR_COMMON_COUNT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a counter of an algorithm counts. Every algorithm numbers its own, from
 * 0, with an enumeration in its file, and describes them in its descriptor;
 * what is not described there is not kept, which is not the same as 0. Like
 * counters of different algorithms bear the same name. */
#define HSR_MAX_COUNTERS 32
struct hsr_counter {
  const char *name;    /* "X merge" */
  const char *meaning; /* "comparisons to merge entering edges into the list" */
};

/* The questions put to the services of common/exact/screen.h. Each is decided by a
 * filter in doubles, whose bound is proved, or else by the exact path, which is
 * rare and counted in both builds. */
#define HSR_QUESTIONS(X)                                                       \
  X(DEPTH, "depth comparisons")                                                \
  X(CUT, "sides of cuts")                                                      \
  X(VERTEX, "vertices against planes")                                         \
  X(EDGE, "edge sides")                                                        \
  X(ROW, "row sides")                                                          \
  X(FACING, "facings")                                                         \
  X(NEAR, "near tests")                                                        \
  X(PLACE, "places along edges")

enum hsr_question {
#define X(id, name) HSR_ASK_##id,
  HSR_QUESTIONS(X)
#undef X
      HSR_N_QUESTIONS
};
extern const char *const hsr_question_name[HSR_N_QUESTIONS];

/* What a run traces: one vocabulary for all algorithms. */
enum hsr_event_kind {
  HSR_SORT,
  HSR_COMPARE,
  HSR_SPLIT,
  HSR_SUBDIVIDE,
  HSR_ACTIVATE,
  HSR_RETIRE,
  HSR_SPAN,
  HSR_SAMPLE,
  HSR_REJECT,
  HSR_ACCEPT
};

/* Subjects are face ids or edge numbers as the kind and counter tell, or
 * HSR_NOTHING; the window is in samples. */
#define HSR_NOTHING UINT32_MAX
struct hsr_event {
  enum hsr_event_kind kind;
  int counter; /* the algorithm's own number */
  uint32_t a, b;
  int x0, y0, x1, y1;
};

/* What one render counted. All zero to begin with. */
struct hsr_tally {
  uint64_t count[HSR_MAX_COUNTERS];
  int first; /* where one algorithm works inside another: the number that the
                inner one's counter 0 has among all */
  uint64_t exact[HSR_N_QUESTIONS]; /* questions that took the exact path */
  uint64_t depths_compared; /* all of HSR_ASK_DEPTH; in the counting build */
  bool out_of_memory;       /* an exact predicate could not be decided */

  /* Work picture, 1 a touch; NULL when not asked for. Sample (i, j) at
   * work[j * work_stride + i]. */
  float *work;
  size_t work_stride;

  /* Called for every event; NULL when not asked for. */
  void (*trace)(void *context, const struct hsr_event *event);
  void *trace_context;
};

/* Adds `from` to `to`: counts and questions. */
void hsr_tally_add(struct hsr_tally *to, const struct hsr_tally *from);

#ifndef HSR_COUNTING
#define HSR_COUNTING 0
#endif

/* HSR_COUNT(tally, X_SORT, n): n more. */
/* HSR_STEP(tally, X_SORT, HSR_COMPARE, a, b, x0, y0, x1, y1): one more, and an
 * event when someone listens. */
/* HSR_TOUCH(tally, i, j): the sample was touched. */
/* HSR_TOUCH_SPAN(tally, x0, x1, j): the samples [x0, x1) of row j were touched
 * all at once: each by its share. */
/* HSR_COUNT_DEPTHS(tally, n): n more comparisons of two faces' depths. */
#if HSR_COUNTING
#define HSR_COUNT(tally, counter, n)                                           \
  ((void)((tally)->count[(tally)->first + (counter)] += (uint64_t)(n)))
#define HSR_STEP(tally, counter, event_kind, a_, b_, x0_, y0_, x1_, y1_)       \
  do {                                                                         \
    int counter_ = (tally)->first + (counter);                                 \
    (tally)->count[counter_]++;                                                \
    if ((tally)->trace)                                                        \
      (tally)->trace((tally)->trace_context,                                   \
                     &(struct hsr_event){(event_kind), counter_, (a_), (b_),   \
                                         (x0_), (y0_), (x1_), (y1_)});         \
  } while (0)
#define HSR_TOUCH(tally, i, j)                                                 \
  do {                                                                         \
    if ((tally)->work)                                                         \
      (tally)->work[(size_t)(j) * (tally)->work_stride + (size_t)(i)] += 1;    \
  } while (0)
#define HSR_TOUCH_SPAN(tally, x0_, x1_, j_)                                    \
  do {                                                                         \
    for (int i_ = (x0_); (tally)->work && i_ < (x1_); i_++)                    \
      (tally)->work[(size_t)(j_) * (tally)->work_stride + (size_t)i_] +=       \
          1.0f / (float)((x1_) - (x0_));                                       \
  } while (0)
#define HSR_COUNT_DEPTHS(tally, n)                                             \
  ((void)((tally)->depths_compared += (uint64_t)(n)))
#else
/* sizeof: looked at by the compiler, not evaluated. */
#define HSR_COUNT(tally, counter, n) ((void)sizeof((tally) + (counter) + (n)))
#define HSR_STEP(tally, counter, event_kind, a_, b_, x0_, y0_, x1_, y1_)       \
  ((void)sizeof((tally) + (counter) + (event_kind) + (a_) + (b_) + (x0_) +     \
                (y0_) + (x1_) + (y1_)))
#define HSR_TOUCH(tally, i, j) ((void)sizeof((tally) + (i) + (j)))
#define HSR_TOUCH_SPAN(tally, x0_, x1_, j_)                                    \
  ((void)sizeof((tally) + (x0_) + (x1_) + (j_)))
#define HSR_COUNT_DEPTHS(tally, n) ((void)sizeof((tally) + (n)))
#endif

#ifdef __cplusplus
}
#endif
#endif
