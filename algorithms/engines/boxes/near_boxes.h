/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The boxes of a list of edges, faces or volumes, as arrays of their bounds: so
 * many boxes at once are compared with another box, each of them once. In groups,
 * a box around GROUP neighbours of the list, which are mostly close to each other,
 * is compared first, and only those of groups that are near are compared alone. */
#ifndef HSR_ALGORITHMS_NEAR_BOXES_H
#define HSR_ALGORITHMS_NEAR_BOXES_H

#include "algorithms/engines/boxes/box_rows.h"
#include "algorithms/engines/boxes/corner_boxes.h"

#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_BOX_GROUP = 64 }; /* items */

struct hsr_near_boxes {
  struct hsr_box_rows rows;
  uint32_t n;
  uint8_t *near; /* by item: 0 if it is apart from the box asked about last. Of
                    groups that are apart, all are 0 */
  bool in_groups;
  struct hsr_box_rows group_rows; /* by group of items: a box around theirs */
  uint8_t *group_near; /* by group: as near[]; NULL if not in groups */
};

/* Makes *boxes of n items, the k-th of which has the box box[item[k]]. Nothing
 * is borrowed; the arrays are the arena's. HSR_E_NOMEM. */
enum hsr_status hsr_near_boxes_make(struct hsr_near_boxes *boxes,
                                    const struct hsr_image_box *box,
                                    const uint32_t *item, uint32_t n,
                                    bool in_groups, struct hsr_arena *arena);

/* Finds which items are near a box: fills near[]. A bound that is NaN counts as
 * infinite. */
void hsr_near_boxes_find(struct hsr_near_boxes *boxes,
                         const struct hsr_image_box *box);

/* The same of items [k, end) alone, whether there are groups or not. Others of
 * near[] stay as they are. */
void hsr_near_boxes_find_among(struct hsr_near_boxes *boxes, uint32_t k,
                               uint32_t end, const struct hsr_image_box *box);

static inline uint32_t hsr_near_boxes_n_groups(const struct hsr_near_boxes *b) {
  return b->in_groups ? b->n / HSR_BOX_GROUP + (b->n % HSR_BOX_GROUP > 0) : 0;
}

/* How many items the last find compared one by one. */
uint32_t hsr_near_boxes_compared(const struct hsr_near_boxes *boxes);

/* Whether item k was compared by it; whatever lies between is in group k / 64. */
static inline bool hsr_near_boxes_is_compared(const struct hsr_near_boxes *b,
                                              uint32_t k) {
  return !b->in_groups || b->group_near[k / HSR_BOX_GROUP];
}

/* The first near item from number k on, below `end`; `end`: there is none. */
static inline uint32_t hsr_near_boxes_next(const struct hsr_near_boxes *boxes,
                                           uint32_t k, uint32_t end) {
  if (k >= end)
    return end;
  const uint8_t *found = (const uint8_t *)memchr(boxes->near + k, 1, end - k);
  return found ? (uint32_t)(found - boxes->near) : end;
}

#ifdef __cplusplus
}
#endif
#endif
