/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A line drawing: the edges of a picture, divided into intervals of one
 * quantitative invisibility each. docs/correct-drawing.md has the
 * definition. */
#ifndef HSR_COMMON_DRAWING_H
#define HSR_COMMON_DRAWING_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(protected) /* for modules: hsr-module.h */

/* The name of an edge. For an edge of faces, a < b are its vertices, and part
 * is 0. For an implied edge, a < b are the faces that penetrate, and part is
 * its number, from 0, among the implied edges of these two. */
struct hsr_edge_name {
  bool implied;
  uint32_t a, b, part;
};

/* One interval of an edge. */
struct hsr_segment {
  struct hsr_edge_name edge;
  uint32_t invisibility; /* how many faces hide it */
  double t0, t1;         /* in [0, 1], along the edge */
  double from[3], to[3]; /* its ends, world units, rounded: for output */
};

/* Intervals, in the order of the definition. A drawing is empty if it is all
 * zero. It owns its array, which hsr_drawing_free frees. */
struct hsr_drawing {
  struct hsr_segment *segment;
  size_t n, room; /* intervals, and how many there is room for */
};

/* What else is known of the intervals of a drawing, for files. All borrowed. */
struct hsr_drawing_facts {
  const unsigned char *line_class; /* by interval: a number of class_name */
  const uint32_t *object;          /* by interval: a number of object_name */
  const char *const *class_name, *const *object_name; /* UTF-8, or nearly */
  size_t n_classes, n_objects;
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

/* Frees the array. The drawing is empty afterwards. */
void hsr_drawing_free(struct hsr_drawing *drawing);

/* Appends a copy of an interval. If it continues the last one, on the same edge
 * and with the same invisibility, the last one is lengthened instead.
 * HSR_E_NOMEM. */
enum hsr_status hsr_drawing_add(struct hsr_drawing *drawing,
                                const struct hsr_segment *segment);

/* Compares two edges by their order in a drawing. Returns < 0 if a comes before
 * b, 0 if they are equal, > 0 if a comes after b. */
int hsr_edge_name_compare(const struct hsr_edge_name *a,
                          const struct hsr_edge_name *b);

/* Sorts the edges into the order of the definition. The intervals of one edge
 * must be together. They keep their order. HSR_E_NOMEM. */
enum hsr_status hsr_drawing_sort(struct hsr_drawing *drawing);

/* The same for intervals in any order: those of one edge are sorted by where they
 * begin, and such as continue one another become one. HSR_E_NOMEM. */
enum hsr_status hsr_drawing_gather(struct hsr_drawing *drawing);

/* The result of hsr_drawing_compare. */
#define HSR_DRAWING_TOLERANCE 1e-12
struct hsr_drawing_difference {
  uint64_t edges;             /* edges in either drawing */
  uint64_t differing;         /* those of them whose intervals do not agree */
  struct hsr_edge_name first; /* the first edge that differs, if any does */
};

/* Compares two drawings of one scene and view, both sorted. The intervals of
 * each edge must agree in number, order and invisibility, and their ends to a
 * relative error of HSR_DRAWING_TOLERANCE. If `visible_only`, invisibilities
 * above 0 count as equal: the intervals of `wanted` are first merged into
 * visible and hidden ones. */
void hsr_drawing_compare(const struct hsr_drawing *got,
                         const struct hsr_drawing *wanted, bool visible_only,
                         struct hsr_drawing_difference *difference);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
