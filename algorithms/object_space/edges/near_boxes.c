/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/object_space/edges/near_boxes.h"

static struct hsr_float_box float_box(const struct hsr_image_box *box) {
  return (struct hsr_float_box){
      box->x0 == box->x0 ? hsr_float_below(box->x0) : -INFINITY,
      box->y0 == box->y0 ? hsr_float_below(box->y0) : -INFINITY,
      box->x1 == box->x1 ? hsr_float_above(box->x1) : INFINITY,
      box->y1 == box->y1 ? hsr_float_above(box->y1) : INFINITY};
}

enum hsr_status hsr_near_boxes_make(struct hsr_near_boxes *boxes,
                                    const struct hsr_image_box *box,
                                    const uint32_t *item, uint32_t n,
                                    struct hsr_arena *arena) {
  float *bound = HSR_NEW(arena, float, 4 * (size_t)n);
  *boxes = (struct hsr_near_boxes){.n = n, .near = HSR_NEW(arena, uint8_t, n)};
  if (!bound || !boxes->near)
    return HSR_E_NOMEM;
  boxes->rows = (struct hsr_box_rows){bound, bound + n, bound + 2 * (size_t)n,
                                      bound + 3 * (size_t)n};
  for (uint32_t k = 0; k < n; k++) {
    struct hsr_float_box own = float_box(&box[item[k]]);
    boxes->rows.x0[k] = own.x0;
    boxes->rows.y0[k] = own.y0;
    boxes->rows.x1[k] = own.x1;
    boxes->rows.y1[k] = own.y1;
  }
  return HSR_OK;
}

void hsr_near_boxes_find(struct hsr_near_boxes *boxes,
                         const struct hsr_image_box *box) {
  struct hsr_float_box around = float_box(box);
  hsr_box_rows_near(&boxes->rows, 0, boxes->n, &around, boxes->near);
}
