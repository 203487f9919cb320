/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes of a list of edges or faces, side by side in memory: those that are apart
 * from another box are found many at once. Whole blocks of the list are compared
 * first: neighbours in the list are mostly close to each other. The build that is
 * timed passes over what is apart, the counting build counts each. */
#ifndef HSR_ALGORITHMS_NEAR_BOXES_H
#define HSR_ALGORITHMS_NEAR_BOXES_H

#include "algorithms/engines/boxes/box_rows.h"
#include "algorithms/engines/boxes/corner_boxes.h"

#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_near_boxes {
  struct hsr_box_rows rows;
  uint32_t n;
  uint8_t *near; /* by item: 0 if it is apart from the box last asked about */
  struct hsr_box_rows block_rows; /* around the boxes of each block of items */
  uint8_t *block_near;            /* by block, likewise */
};

/* Of the boxes of n items. Memory is the arena's. HSR_E_NOMEM. */
enum hsr_status hsr_near_boxes_make(struct hsr_near_boxes *boxes,
                                    const struct hsr_image_box *box,
                                    const uint32_t *item, uint32_t n,
                                    struct hsr_arena *arena);

/* Finds what is near a box. A bound that is not a number is beyond all. */
void hsr_near_boxes_find(struct hsr_near_boxes *boxes,
                         const struct hsr_image_box *box);

/* The first item from k on that is to be looked at; boxes->n if none is. */
static inline uint32_t hsr_near_boxes_next(const struct hsr_near_boxes *boxes,
                                           uint32_t k) {
  if (HSR_COUNTING || k == boxes->n)
    return k;
  const uint8_t *found =
      (const uint8_t *)memchr(boxes->near + k, 1, boxes->n - k);
  return found ? (uint32_t)(found - boxes->near) : boxes->n;
}

#ifdef __cplusplus
}
#endif
#endif
