/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The boxes of a list of edges or faces, as arrays of their bounds: so many
 * boxes at once are compared with another box. Boxes around whole blocks of the
 * list are compared first, since neighbours in the list are mostly close to
 * each other. The build that is timed passes over all items that are apart; the
 * counting build visits every item, and counts it. */
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
  uint8_t *near; /* by item: 0 if it is apart from the box asked about last */
  struct hsr_box_rows block_rows; /* by block of items: a box around theirs */
  uint8_t *block_near;            /* by block: as near[] */
};

/* Makes *boxes of n items, the k-th of which has the box box[item[k]]. Nothing
 * is borrowed; the arrays are the arena's. HSR_E_NOMEM. */
enum hsr_status hsr_near_boxes_make(struct hsr_near_boxes *boxes,
                                    const struct hsr_image_box *box,
                                    const uint32_t *item, uint32_t n,
                                    struct hsr_arena *arena);

/* Finds which items are near a box: fills near[]. A bound that is NaN counts as
 * infinite. */
void hsr_near_boxes_find(struct hsr_near_boxes *boxes,
                         const struct hsr_image_box *box);

/* The first item from number k on that must be visited; boxes->n: there is
 * none. */
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
