/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes of images sorted by their upper left corners, to find those near an
 * edge.
 *
 * Source      Sutherland et al. 1974, chapter IV, "Area Coherence": a proposal
 *             in two sentences, for edges; and "Other Combinations of Sorting",
 *             for Roberts' objects.
 * Invariant   from n_unknown on, item[] is in the order of the corners, and
 *             reach[k] is the greatest y1 of the boxes [n_unknown, k]. So it
 *             does not decrease, and no box before the first that reaches down
 *             to another box overlaps that one
 * Cost        about N log N comparisons to sort, 2 log N to find an edge's part
 *             of the N, and one for each box of that part, most of which lie to
 *             the left or to the right; how small the part is depends on the
 *             tallest boxes */
#ifndef HSR_ALGORITHMS_CORNER_BOXES_H
#define HSR_ALGORITHMS_CORNER_BOXES_H

#include "algorithms/algorithm.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What an image lies within: the whole plane, if the image is not known. */
struct hsr_image_box {
  double x0, y0, x1, y1;
};

static inline bool hsr_boxes_overlap(const struct hsr_image_box *a,
                                     const struct hsr_image_box *b) {
  return a->x0 <= b->x1 && b->x0 <= a->x1 && a->y0 <= b->y1 && b->y0 <= a->y1;
}

struct hsr_corner_boxes {
  const struct hsr_image_box *box; /* by item; borrowed */
  uint32_t *item, n;               /* borrowed */
  struct hsr_tally *tally;
  int sort, search; /* counters: of comparisons of two items; of an item with
                       the box that is asked about */
  struct hsr_subject (*subject)(const void *context, uint32_t item);
  const void *context;

  /* What the sort fills: the first n_unknown items have no box, and near[] has
   * room for all. */
  uint32_t n_unknown, *near;
  double *reach;
};

/* Sorts item[] by y0, and by x0 where these are equal. Memory from `arena`.
 * HSR_E_NOMEM. */
enum hsr_status hsr_corner_boxes_sort(struct hsr_corner_boxes *boxes,
                                      struct hsr_arena *arena);

/* Puts the items whose boxes overlap `box`, or are unknown, into near[].
 * Returns how many. `of` is whose box it is, the first subject of the steps. */
uint32_t hsr_corner_boxes_find(const struct hsr_corner_boxes *boxes,
                               const struct hsr_image_box *box,
                               struct hsr_subject of);

/* What it counts, where edges are sorted. */
extern const struct hsr_part hsr_box_sort_part;
enum { HSR_BOX_SORT = HSR_FIRST_OF(HSR_PART_BOX_SORT) };

/* The words of the option. */
enum { HSR_NOT_SORTED, HSR_BY_CORNER };
extern const struct hsr_word hsr_box_sortings[];

#ifdef __cplusplus
}
#endif
#endif
