/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A line drawing: the edges of a picture, divided into intervals of one
 * quantitative invisibility each. docs/correct-drawing.md has the definition.
  */
#ifndef HSR_COMMON_DRAWING_H
#define HSR_COMMON_DRAWING_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Names an edge. An edge of faces: a < b are its vertices, part is 0. An
 * implied edge: a < b are the faces that penetrate, part is its number among
 * theirs. */
struct hsr_edge_name {
  bool implied;
  uint32_t a, b, part;
};

/* One interval of an edge. */
struct hsr_segment {
  struct hsr_edge_name edge;
  uint32_t invisibility; /* how many faces hide it */
  double t0, t1;         /* in [0, 1], along the edge */
  double from[3], to[3]; /* its ends in world space, rounded: for output */
};

/* Intervals, in the order of the definition. All zero is an empty drawing. It
 * owns its memory, which is kept from frame to frame; hsr_drawing_free frees
 * it. */
struct hsr_drawing {
  struct hsr_segment *segment;
  size_t n, room;
};

/* How the hidden parts of edges are shown. */
enum hsr_hidden {
  HSR_HIDDEN_NONE,   /* left out */
  HSR_HIDDEN_DASHED, /* dashed */
  HSR_HIDDEN_THIN,   /* thinner and lighter, the more faces hide them */
  HSR_HIDDEN_ALL     /* like the visible ones */
};

/* Empties the drawing and keeps its memory. */
static inline void hsr_drawing_clear(struct hsr_drawing *drawing) {
  drawing->n = 0;
}
void hsr_drawing_free(struct hsr_drawing *drawing);

/* Appends an interval. If it begins where the last one ends, on the same edge
 * and with the same invisibility, lengthens that one instead. HSR_E_NOMEM. */
enum hsr_status hsr_drawing_add(struct hsr_drawing *drawing,
                                const struct hsr_segment *segment);

/* The order of edges in a drawing: < 0, 0 or > 0 as a comes before b, is b, or
 * comes after it. */
int hsr_edge_name_compare(const struct hsr_edge_name *a,
                          const struct hsr_edge_name *b);

/* Sorts the edges. The intervals of one edge must follow one another, and keep
 * their order. HSR_E_NOMEM. */
enum hsr_status hsr_drawing_sort(struct hsr_drawing *drawing);

/* Compares two drawings of one scene and view. The intervals of each edge must
 * agree in number, order and invisibility, and their ends to a relative
 * HSR_DRAWING_TOLERANCE. With `visible_only`, the intervals of `wanted` are
 * first merged into visible and hidden ones. */
#define HSR_DRAWING_TOLERANCE 1e-12
struct hsr_drawing_difference {
  uint64_t edges;             /* in either drawing */
  uint64_t differing;         /* of them, those whose intervals do not agree */
  struct hsr_edge_name first; /* the first of those */
};
void hsr_drawing_compare(const struct hsr_drawing *got,
                         const struct hsr_drawing *wanted, bool visible_only,
                         struct hsr_drawing_difference *difference);

#ifdef __cplusplus
}
#endif
#endif
