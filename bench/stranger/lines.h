/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Judging anybody's line drawing: docs/correct-drawing.md says what is right.
 * Each edge that is wrong gets one kind, the first that holds. */
#ifndef HSR_BENCH_STRANGER_LINES_H
#define HSR_BENCH_STRANGER_LINES_H

#include "bench/library/library.h"
#include "common/lines/drawing.h"

enum line_kind {
  LINE_VISIBLE_ONLY,  /* its visible parts are right, and no other is there */
  LINE_HIDDEN_OR_NOT, /* its hidden parts are told from visible ones, but not by
                         how many faces hide them */
  LINE_COUNT,         /* the intervals are right, but not their invisibility */
  LINE_ENDS,          /* only the ends of intervals are a little off */
  LINE_MISSING,       /* it is not there */
  LINE_EXTRA,         /* no such edge is to be drawn */
  LINE_WRONG,         /* other */
  LINE_KINDS
};

/* The ends of intervals that are so far off are a little off. */
#define LINE_LITTLE 1e-5

struct line_reason {
  enum line_kind kind;
  uint64_t edges;
  struct hsr_edge_name first;
};

struct line_verdict {
  uint64_t compared, differing;          /* edges */
  struct line_reason reason[LINE_KINDS]; /* by how many edges they explain */
  int n_reasons;
};

/* "edge": the word of a kind for programs; and what is said. */
const char *line_key(enum line_kind kind);
const char *line_words(enum line_kind kind);

/* Judges a drawing, which is sorted, for the camera and size of a request.
 * Errors as hsr_judge. */
enum hsr_status lines_judge(struct lib_scene *scene,
                            const struct hsr_request *request,
                            const struct hsr_drawing *drawing,
                            struct line_verdict *verdict,
                            struct hsr_error *err);

#endif
