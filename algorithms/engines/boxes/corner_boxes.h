/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes around images of edges or volumes, sorted by their upper left corners,
 * to find those that overlap the box of an edge.
 *
 * Source      Sutherland et al. 1974, chapter IV, "Area Coherence": a proposal
 *             in two sentences, for edges; and "Other Combinations of Sorting",
 *             for Roberts' objects.
 * Invariant   From n_unknown on, item[] is in the order of the corners, and
 *             reach[k] is the greatest y1 of the boxes of item[n_unknown] to
 *             item[k]. So reach[] does not decrease. The boxes before the first
 *             k with reach[k] >= y0 of another box all lie above that box.
 * Cost        About N log N comparisons to sort. To find the part of the list
 *             that may overlap an edge's box takes 2 log N, and then one for
 *             each box of that part, most of which lie to the left or to the
 *             right. How small the part is depends on the tallest boxes. */
#ifndef HSR_ALGORITHMS_CORNER_BOXES_H
#define HSR_ALGORITHMS_CORNER_BOXES_H

#include "algorithms/algorithm.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A box that holds an image, in pixels; the whole plane if the image is not
 * known. */
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
  int sort;   /* counter: a comparison of two items */
  int search; /* counter: a comparison of an item with the box asked about */

  /* An item as the subject of a step. */
  struct hsr_subject (*subject)(const void *context, uint32_t item);
  const void *context;

  /* Filled by the sort. The first n_unknown items are those whose images are
   * not known. near[] has room for all items. */
  uint32_t n_unknown, *near;
  double *reach;
};

/* Sorts item[] by y0, and by x0 where these are equal. The caller has set the
 * members before n_unknown. Memory from `arena`. HSR_E_NOMEM. */
enum hsr_status hsr_corner_boxes_sort(struct hsr_corner_boxes *boxes,
                                      struct hsr_arena *arena);

/* Puts the items whose boxes overlap `box`, or are unknown, into near[].
 * Returns how many. `of` is what the box belongs to: the first subject of the
 * steps. */
uint32_t hsr_corner_boxes_find(const struct hsr_corner_boxes *boxes,
                               const struct hsr_image_box *box,
                               struct hsr_subject of);

/* The counters of the part of modules that sort edges, or take them in groups
 * (edge_intersection.h). */
enum { HSR_BOX_SORT = HSR_FIRST_OF(HSR_PART_BOX_SORT), HSR_BOX_GROUPS };

/* The words of the option that chooses the sort; edges may also be grouped. */
enum { HSR_NOT_SORTED, HSR_BY_CORNER, HSR_IN_GROUPS };
extern const struct hsr_word hsr_box_sortings[], hsr_edge_sortings[];

#ifdef __cplusplus
}
#endif
#endif
