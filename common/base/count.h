/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Counting what an algorithm does, and tracing it: one layer for both.
 *
 * A step of an algorithm is counted by HSR_STEP. It adds one to a counter and,
 * when someone listens, it emits one event. So the number of events of a
 * counter is always its count.
 *
 * Where HSR_COUNTING is 0, the macros compile to nothing. The compiler still
 * checks their arguments, which must have no side effects. */
#ifndef HSR_COMMON_BASE_COUNT_H
#define HSR_COMMON_BASE_COUNT_H

#include "common/base/window.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(protected) /* for modules: hsr-module.h */

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

/* The kinds of subjects that a step may have. The comments give the meaning of
 * the numbers id[0], id[1], id[2] of a subject. An edge is named by its two
 * vertices and its face, or HSR_NO_ID if it belongs to several faces. A counter
 * whose subject is HSR_OF_EDGE may also count implied edges. */
#define HSR_SUBJECT_KINDS(X)                                                   \
  X(NOTHING, "nothing")                                                        \
  X(FACE, "face")            /* face */                                        \
  X(PIECE, "piece")          /* face, number of the piece */                   \
  X(EDGE, "edge")            /* vertex, vertex, face or HSR_NO_ID */           \
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

#define HSR_NO_ID UINT32_MAX /* no vertex, or no single face */
struct hsr_subject {
  enum hsr_subject_kind kind;
  uint32_t id[3];
};

/* What a counter of an algorithm counts. Every algorithm numbers its counters
 * from 0, with an enumeration in its file, and describes them in its
 * descriptor. A counter of a part that the descriptor does not list is not kept.
 * Its count is then unknown; it is not 0. Counters of different algorithms that count the
 * same thing have the same name. Code that several algorithms share is a part
 * (algorithms/part.h): counter k of part p has the number HSR_PART_SIZE p + k.
 */
enum { HSR_MAX_COUNTERS = 48, HSR_PART_SIZE = 64, HSR_MOST_PARTS = 40 };
struct hsr_counter {
  const char *name;    /* "X merge" */
  const char *meaning; /* "comparisons to merge entering edges into the list" */
  enum hsr_step_kind kind;
  enum hsr_subject_kind a, b; /* the subjects of its events */
  const char *outcomes; /* the outcomes of a step, from 0, with | between them:
                           "farther|nearer". NULL: a step decides nothing */
  bool computed; /* the program does not perform these steps, as hardware would,
                    but computes their number. HSR_COMPUTED adds it in bulk, and
                    the counter has no events */
  const char *key; /* a stable word of a to z and -, by which programs know the
                      counter: "cube-visited". NULL: no program looks for it */
  const char *outcome_keys; /* names by which programs know its outcomes, in the
                               order of these: "boxes||boxes body". A | parts the
                               outcomes. One outcome may have no key, or several
                               with spaces between them. A counter without
                               outcomes has one list, for all its steps. Several
                               counters may have the same keys. NULL: none */
};

/* Whether programs know the counter by that key. */
bool hsr_has_key(const struct hsr_counter *counter, const char *key);

/* Whether programs know that outcome of the counter, from 0, by that key. */
bool hsr_outcome_has_key(const struct hsr_counter *counter, int outcome,
                         const char *key);

/* The questions that common/exact/screen.h answers. A filter in doubles with a
 * proved error bound decides most of them. The exact path decides the others.
 * It is rare, and it is counted in the timed build too. */
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

/* Why the core leaves a face out before a module sees it (hsr_screen_place in
 * common/exact/screen.h). Counted in the timed build too. The survey's F_r leaves
 * out the first two kinds; a face of the third is relevant there. */
#define HSR_CULLS(X)                                                           \
  X(UNSEEN, "unseen") /* it does not exist for the eye: a back, or edge on */  \
  X(OUTSIDE, "outside") /* not in the picture, or not behind the near plane */ \
  X(BETWEEN,                                                                   \
    "between samples") /* in the picture, but no sample is in its     \
                                   bounds */

enum hsr_cull {
#define X(id, name) HSR_CULL_##id,
  HSR_CULLS(X)
#undef X
      HSR_N_CULLS
};
extern const char *const hsr_cull_name[HSR_N_CULLS];

/* --- Events --------------------------------------------------------------- */

/* One step of a run. */
struct hsr_event {
  uint64_t number;         /* in the run, from 0 */
  int counter;             /* its place in the algorithm's list of counters */
  struct hsr_subject a, b; /* in the scene's ids */
  uint32_t own[2]; /* id[0] of a and of b in the algorithm's own numbers, those
                      of the world that it was given */
  struct hsr_window window; /* in samples. If it is empty, the step has no
                               window or is about the whole picture */
  int outcome;              /* index of one of the counter's outcomes, or 0 */
  const void *part; /* of a step of kind HSR_ACCEPT, if the answer is not ids:
                       what the step adds to the answer, in a form that the kind
                       of answer defines. Of a step of another kind: the piece
                       that it is about, in that form, if the module tells it.
                       Else NULL. Borrowed for the call of `listen` */
};

/* The listener of a run. A traced run has one listener and one thread, so that
 * its events are in order. */
struct hsr_trace {
  /* Called for every event, which is borrowed for the call. */
  void (*listen)(void *context, const struct hsr_event *event);
  void *context;
  uint64_t n; /* events so far */

  /* Called before `listen`, with `names`. It turns the subjects of an event
   * from an algorithm's own numbers into the scene's ids. NULL: the algorithm's
   * numbers are the scene's ids. */
  void (*name)(const void *names, struct hsr_event *event);
  const void *names;
};

/* --- What one render counted ---------------------------------------------- */

/* A tally is all zero at the start. */
struct hsr_tally {
  /* A module may use a part that its descriptor does not list. The counts of
   * such parts stand from HSR_MAX_COUNTERS on, where only a test looks. */
  uint64_t count[HSR_MAX_COUNTERS + HSR_PART_SIZE];
  uint8_t base[HSR_MOST_PARTS];    /* the place in count[] of each part's first
                                      counter; set by hsr_tally_begin
                                      (algorithms/algorithm.h) */
  uint64_t exact[HSR_N_QUESTIONS]; /* questions that took the exact path */
  uint64_t culled[HSR_N_CULLS];    /* faces that the core left out */
  uint64_t depths_compared; /* depth comparisons, by the filter or exact; kept
                               in the counting build only */
  bool out_of_memory;       /* an exact predicate could not be decided */

  /* The work picture: each touch of a sample adds 1. Sample (i, j) is
   * work[j * work_stride + i]. Borrowed. NULL: no work picture is wanted. */
  float *work;
  size_t work_stride;

  struct hsr_trace *trace; /* borrowed; NULL when nobody listens */
};

/* Returns the index of a counter in count[]. */
static inline int hsr_tally_place(const struct hsr_tally *tally, int counter) {
  return tally->base[counter / HSR_PART_SIZE] + counter % HSR_PART_SIZE;
}

/* Returns the count of a counter. */
static inline uint64_t hsr_tally_count(const struct hsr_tally *tally,
                                       int counter) {
  return tally->count[hsr_tally_place(tally, counter)];
}

/* Adds the counts, questions and culled faces of `from` to those of `to`, and its
 * out_of_memory. Both must number their counters alike. The work picture and
 * the trace of `to` stay as they are. */
void hsr_tally_add(struct hsr_tally *to, const struct hsr_tally *from);

/* Emits one event to tally->trace, which must not be NULL. Callers use HSR_STEP
 * and HSR_ACCEPTED instead. */
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
/* f may be HSR_BACKGROUND (common/scene/scene.h), which is no face. */
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
 * one step. Subjects are in the numbers of the world that the algorithm was
 * given. Where the answer is ids, a step of kind HSR_ACCEPT says that face a,
 * or HSR_BACKGROUND, is written to all samples of the window.
 * HSR_ACCEPTED(tally, DRAWN, a, b, window, part): a step of kind HSR_ACCEPT
 * that adds `part` to an answer that is not ids.
 * HSR_STEPS(tally, MINIMAX, n): n steps that were made at once, as vector code
 * makes them. When someone listens, they are made known by HSR_STEP one by one
 * instead: ask HSR_LISTENED(tally).
 * HSR_COMPUTED(tally, Y_CULL, n): adds n to a counter that is computed.
 * HSR_TOUCH(tally, i, j): adds 1 to the sample in the work picture.
 * HSR_TOUCH_SPAN(tally, x0, x1, j): the samples [x0, x1) of row j were handled
 * in one operation. Each of them gets an equal share of 1 in the work picture.
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
#define HSR_STEPS(tally, counter, n) HSR_COMPUTED(tally, counter, n)
#define HSR_LISTENED(tally) ((tally)->trace != NULL)
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
#define HSR_STEPS(tally, counter, n) HSR_COMPUTED(tally, counter, n)
#define HSR_LISTENED(tally) ((void)sizeof(tally), false)
#define HSR_TOUCH(tally, i, j) ((void)sizeof((tally) + (i) + (j)))
#define HSR_TOUCH_SPAN(tally, x0_, x1_, j_)                                    \
  ((void)sizeof((tally) + (x0_) + (x1_) + (j_)))
#define HSR_COUNT_DEPTHS(tally, n) ((void)sizeof((tally) + (n)))
#endif
#define HSR_STEP(tally, counter, a, b, window, outcome)                        \
  HSR_TOLD(tally, counter, a, b, window, outcome, NULL)
#define HSR_ACCEPTED(tally, counter, a, b, window, part)                       \
  HSR_TOLD(tally, counter, a, b, window, 0, part)

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
