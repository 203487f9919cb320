/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Counting what an algorithm does, and tracing it: one layer for both.
 *
 * A step of an algorithm is counted by HSR_STEP. It adds one to a counter and,
 * when someone listens, it emits one event. So the number of events of a
 * counter is always its count.
 *
 * Both compile to nothing if HSR_COUNTING is 0: the compiler checks their
 * arguments, which must have no side effects, and leaves them out. */
#ifndef HSR_COMMON_BASE_COUNT_H
#define HSR_COMMON_BASE_COUNT_H

#include "common/base/window.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* --- Counters ------------------------------------------------------------- */

/* The kind of step that a counter counts: one vocabulary for all algorithms. */
#define HSR_STEP_KINDS(X)                                                      \
  X(SORT, "sort")           /* a thing is put into its place */                \
  X(COMPARE, "compare")     /* two things are compared */                      \
  X(SPLIT, "split")         /* a face or an edge is divided */                 \
  X(SUBDIVIDE, "subdivide") /* a window, a cell or a span is divided */        \
  X(ACTIVATE, "activate")   /* a thing begins to matter */                     \
  X(RETIRE, "retire")       /* a thing ceases to matter */                     \
  X(SPAN, "span")           /* a stretch of a scan line is looked at */        \
  X(SAMPLE, "sample")       /* a sample is looked at */                        \
  X(REJECT, "reject")       /* a thing is found not to be visible */           \
  X(ACCEPT, "accept")       /* a part of the answer is written */

enum hsr_step_kind {
#define X(id, name) HSR_##id,
  HSR_STEP_KINDS(X)
#undef X
      HSR_N_STEP_KINDS
};
extern const char *const hsr_step_kind_name[HSR_N_STEP_KINDS];

/* The kinds of subjects that a step may have. The comments say what the numbers
 * id[0], id[1], id[2] of a subject mean. A counter of edges may also count
 * implied edges. */
#define HSR_SUBJECT_KINDS(X)                                                   \
  X(NOTHING, "nothing")                                                        \
  X(FACE, "face")   /* face */                                                 \
  X(PIECE, "piece") /* face, number of the piece */                            \
  X(EDGE, "edge")   /* vertex, vertex, face; HSR_NO_ID: of several faces */    \
  X(IMPLIED, "implied edge") /* face, face, part: where two faces penetrate */ \
  X(VERTEX, "vertex")        /* vertex */                                      \
  X(VOLUME, "volume")        /* number */                                      \
  X(CELL, "cell")     /* of a tree or a pyramid: number, or level, x, y */     \
  X(WINDOW, "window") /* the event's own window */

enum hsr_subject_kind {
#define X(id, name) HSR_OF_##id,
  HSR_SUBJECT_KINDS(X)
#undef X
      HSR_N_SUBJECT_KINDS
};
extern const char *const hsr_subject_kind_name[HSR_N_SUBJECT_KINDS];

#define HSR_NO_ID UINT32_MAX
struct hsr_subject {
  enum hsr_subject_kind kind;
  uint32_t id[3];
};

/* What a counter of an algorithm counts. Every algorithm numbers its counters
 * from 0, with an enumeration in its file, and describes them in its
 * descriptor. A counter that is not described there is not kept, which is not
 * the same as 0. Counters of different algorithms that count the same have the
 * same name. What several algorithms share are parts: counter k of part p has
 * the number HSR_PART_SIZE p + k (algorithms/part.h). */
enum { HSR_MAX_COUNTERS = 48, HSR_PART_SIZE = 64, HSR_MOST_PARTS = 32 };
struct hsr_counter {
  const char *name;    /* "X merge" */
  const char *meaning; /* "comparisons to merge entering edges into the list" */
  enum hsr_step_kind kind;
  enum hsr_subject_kind a, b; /* of its events */
  const char *outcomes; /* what a step may decide, a word for each outcome from
                           0, "farther|nearer"; NULL: nothing is decided */
  bool computed; /* added in bulk by HSR_COMPUTED: steps that hardware would do,
                    computed and not performed; it has no events */
};

/* The questions put to the services of common/exact/screen.h. Each is decided
 * by a filter in doubles with a proved bound, or else by the exact path. The
 * exact path is rare, and is counted in both builds. */
#define HSR_QUESTIONS(X)                                                       \
  X(DEPTH, "depth comparisons")                                                \
  X(CUT, "sides of cuts")                                                      \
  X(VERTEX, "vertices against planes")                                         \
  X(EDGE, "edge sides")                                                        \
  X(ROW, "row sides")                                                          \
  X(FACING, "facings")                                                         \
  X(NEAR, "near tests")                                                        \
  X(PLACE, "places along edges")                                               \
  X(FOOTPRINT, "footprints")

enum hsr_question {
#define X(id, name) HSR_ASK_##id,
  HSR_QUESTIONS(X)
#undef X
      HSR_N_QUESTIONS
};
extern const char *const hsr_question_name[HSR_N_QUESTIONS];

/* --- Events --------------------------------------------------------------- */

/* One step of a run. */
struct hsr_event {
  uint64_t number; /* in the run, from 0 */
  int counter;     /* its place in the algorithm's list of counters */
  struct hsr_subject a, b;
  uint32_t own[2]; /* the first numbers of a and b as the algorithm has them:
                      those of the faces that it was given */
  struct hsr_window window; /* in samples; empty: the whole picture, or none */
  int outcome;              /* which of the counter's outcomes; or 0 */
  const void *part; /* HSR_ACCEPT of an answer that is not ids: what is added to
                       it, in a form that its kind of answer defines; else NULL.
                       Borrowed for the call of `listen` */
};

/* The listener of a run. There is one at a time: a traced run is on one thread,
 * so that its events are in order. */
struct hsr_trace {
  /* Called for every event. Borrowed for the call. */
  void (*listen)(void *context, const struct hsr_event *event);
  void *context;
  uint64_t n; /* events so far */

  /* Called before `listen`, with `names`: turns the subjects of an event from
   * an algorithm's own numbers into the scene's. NULL: they are the scene's. */
  void (*name)(const void *names, struct hsr_event *event);
  const void *names;
};

/* --- What one render counted ---------------------------------------------- */

/* All zero at the start. */
struct hsr_tally {
  uint64_t count[HSR_MAX_COUNTERS];
  uint8_t base[HSR_MOST_PARTS];    /* where the counters of each part begin in
                                   count[]: hsr_tally_begin */
  uint64_t exact[HSR_N_QUESTIONS]; /* questions that took the exact path */
  uint64_t depths_compared; /* all of HSR_ASK_DEPTH; in the counting build */
  bool out_of_memory;       /* an exact predicate could not be decided */

  /* Work picture: 1 is added for each touch of a sample. Sample (i, j) is at
   * work[j * work_stride + i]. Borrowed; NULL when not asked for. */
  float *work;
  size_t work_stride;

  struct hsr_trace *trace; /* borrowed; NULL when nobody listens */
};

/* Where a counter is kept in count[]. */
static inline int hsr_tally_place(const struct hsr_tally *tally, int counter) {
  return tally->base[counter / HSR_PART_SIZE] + counter % HSR_PART_SIZE;
}

/* What a counter counted. */
static inline uint64_t hsr_tally_count(const struct hsr_tally *tally,
                                       int counter) {
  return tally->count[hsr_tally_place(tally, counter)];
}

/* Adds the counts and questions of `from` to those of `to`. */
void hsr_tally_add(struct hsr_tally *to, const struct hsr_tally *from);

/* What HSR_STEP does when someone listens. */
void hsr_tally_tell(struct hsr_tally *tally, int counter, struct hsr_subject a,
                    struct hsr_subject b, struct hsr_window window, int outcome,
                    const void *part);

/* --- The subjects and windows of a step ----------------------------------- */

static inline struct hsr_subject hsr_subject_make(enum hsr_subject_kind kind,
                                                  uint32_t x, uint32_t y,
                                                  uint32_t z) {
  struct hsr_subject subject = {kind, {x, y, z}};
  return subject;
}
#define HSR_NOTHING hsr_subject_make(HSR_OF_NOTHING, 0, 0, 0)
/* f may be HSR_BACKGROUND: no face. */
#define HSR_FACE(f) hsr_subject_make(HSR_OF_FACE, f, 0, 0)
#define HSR_PIECE(f, number) hsr_subject_make(HSR_OF_PIECE, f, number, 0)
#define HSR_EDGE(a, b, f) hsr_subject_make(HSR_OF_EDGE, a, b, f)
#define HSR_IMPLIED(f, g, part) hsr_subject_make(HSR_OF_IMPLIED, f, g, part)
#define HSR_VERTEX(v) hsr_subject_make(HSR_OF_VERTEX, v, 0, 0)
#define HSR_VOLUME(number) hsr_subject_make(HSR_OF_VOLUME, number, 0, 0)
#define HSR_CELL(level, x, y)                                                  \
  hsr_subject_make(HSR_OF_CELL, (uint32_t)(level), (uint32_t)(x), (uint32_t)(y))
#define HSR_THE_WINDOW hsr_subject_make(HSR_OF_WINDOW, 0, 0, 0)

static inline struct hsr_window hsr_window_make(int x0, int y0, int x1,
                                                int y1) {
  struct hsr_window window = {x0, y0, x1, y1};
  return window;
}
/* HSR_AT: one sample. HSR_ON: the columns [x0, x1) of row j. HSR_NOWHERE: no
 * window. */
#define HSR_AT(i, j) hsr_window_make(i, j, (i) + 1, (j) + 1)
#define HSR_ON(x0, x1, j) hsr_window_make(x0, j, x1, (j) + 1)
#define HSR_NOWHERE hsr_window_make(0, 0, 0, 0)

/* --- Counting ------------------------------------------------------------- */

#ifndef HSR_COUNTING
#define HSR_COUNTING 0
#endif

/* HSR_STEP(tally, X_MERGE, HSR_EDGE(...), HSR_EDGE(...), HSR_ON(...), outcome):
 * one step. Subjects are in the numbers of the world that the algorithm got. If
 * the answer is ids, a step of kind HSR_ACCEPT writes face a (HSR_BACKGROUND is
 * allowed) to all samples of the window.
 * HSR_ACCEPTED(tally, DRAWN, a, b, window, part): a step of kind HSR_ACCEPT
 * that adds `part` to an answer that is not ids.
 * HSR_COMPUTED(tally, Y_CULL, n): adds n to a counter that is computed.
 * HSR_TOUCH(tally, i, j): the sample was touched.
 * HSR_TOUCH_SPAN(tally, x0, x1, j): the samples [x0, x1) of row j were touched
 * all at once; each gets its share of 1.
 * HSR_COUNT_DEPTHS(tally, n): n more comparisons of two faces' depths. */
#if HSR_COUNTING
#define HSR_TOLD(tally, counter_, a, b, window, outcome, part)                 \
  do {                                                                         \
    (tally)->count[hsr_tally_place(tally, counter_)]++;                        \
    if ((tally)->trace)                                                        \
      hsr_tally_tell(tally, counter_, a, b, window, (int)(outcome), part);     \
  } while (0)
#define HSR_COMPUTED(tally, counter, n)                                        \
  ((void)((tally)->count[hsr_tally_place(tally, counter)] += (uint64_t)(n)))
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
/* The compiler checks the arguments and leaves the code out. */
#define HSR_TOLD(tally, counter, a, b, window, outcome, part)                  \
  do {                                                                         \
    if (0)                                                                     \
      hsr_tally_tell(tally, counter, a, b, window, (int)(outcome), part);      \
  } while (0)
#define HSR_COMPUTED(tally, counter, n)                                        \
  ((void)sizeof((tally) + (counter) + (n)))
#define HSR_TOUCH(tally, i, j) ((void)sizeof((tally) + (i) + (j)))
#define HSR_TOUCH_SPAN(tally, x0_, x1_, j_)                                    \
  ((void)sizeof((tally) + (x0_) + (x1_) + (j_)))
#define HSR_COUNT_DEPTHS(tally, n) ((void)sizeof((tally) + (n)))
#endif
#define HSR_STEP(tally, counter, a, b, window, outcome)                        \
  HSR_TOLD(tally, counter, a, b, window, outcome, NULL)
#define HSR_ACCEPTED(tally, counter, a, b, window, part)                       \
  HSR_TOLD(tally, counter, a, b, window, 0, part)

#ifdef __cplusplus
}
#endif
#endif
