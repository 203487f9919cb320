/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A line drawing: the edges of a picture, in intervals of one quantitative
 * invisibility each. docs/correct-drawing.md has the definition. */
#ifndef HSR_COMMON_DRAWING_H
#define HSR_COMMON_DRAWING_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Which edge: of faces, a < b being its vertices, and part 0; or implied, a < b
 * being the faces that penetrate, and part its number among theirs. */
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

/* Intervals, in the order of the definition. All zero is an empty drawing; it
 * owns its memory, which is kept from frame to frame. */
struct hsr_drawing {
  struct hsr_segment *segment;
  size_t n, room;
};

/* What becomes of the hidden parts of edges where a drawing is shown. */
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

/* Appends an interval; or, if it begins on the same edge where the last one
 * ends and has the same invisibility, lengthens that. HSR_E_NOMEM. */
enum hsr_status hsr_drawing_add(struct hsr_drawing *drawing,
                                const struct hsr_segment *segment);

/* < 0, 0 or > 0: the order of edges in a drawing. */
int hsr_edge_name_compare(const struct hsr_edge_name *a,
                          const struct hsr_edge_name *b);

/* Brings the edges into their order. The intervals of an edge, which must
 * follow one another, stay as they are. HSR_E_NOMEM. */
enum hsr_status hsr_drawing_sort(struct hsr_drawing *drawing);

/* How two drawings of one scene and view compare: the intervals of each edge
 * must agree in number, order and invisibility, and their ends within
 * HSR_DRAWING_TOLERANCE, relatively. With `visible_only`, the intervals of
 * `wanted` are first taken together as visible and hidden ones. */
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
