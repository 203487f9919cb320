/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/boxes/near_boxes.h"

static struct hsr_float_box float_box(const struct hsr_image_box *box) {
  return (struct hsr_float_box){
      box->x0 == box->x0 ? hsr_float_below(box->x0) : -INFINITY,
      box->y0 == box->y0 ? hsr_float_below(box->y0) : -INFINITY,
      box->x1 == box->x1 ? hsr_float_above(box->x1) : INFINITY,
      box->y1 == box->y1 ? hsr_float_above(box->y1) : INFINITY};
}

static bool allocate(struct hsr_box_rows *rows, uint32_t n,
                     struct hsr_arena *arena) {
  float *bound = HSR_NEW(arena, float, 4 * (size_t)n);
  if (bound)
    *rows = (struct hsr_box_rows){bound, bound + n, bound + 2 * (size_t)n,
                                  bound + 3 * (size_t)n};
  return bound;
}

static void set(struct hsr_box_rows *rows, uint32_t k,
                const struct hsr_float_box *box) {
  rows->x0[k] = box->x0;
  rows->y0[k] = box->y0;
  rows->x1[k] = box->x1;
  rows->y1[k] = box->y1;
}

/* The box around the boxes of items [k, end). */
static struct hsr_float_box around(const struct hsr_box_rows *rows, uint32_t k,
                                   uint32_t end) {
  struct hsr_float_box box = hsr_no_float_box();
  for (; k < end; k++) {
    box.x0 = fminf(box.x0, rows->x0[k]);
    box.y0 = fminf(box.y0, rows->y0[k]);
    box.x1 = fmaxf(box.x1, rows->x1[k]);
    box.y1 = fmaxf(box.y1, rows->y1[k]);
  }
  return box;
}

static uint32_t end_of(const struct hsr_near_boxes *boxes, uint32_t group) {
  uint32_t first = group * HSR_BOX_GROUP;
  return boxes->n - first < HSR_BOX_GROUP ? boxes->n : first + HSR_BOX_GROUP;
}

static enum hsr_status make_groups(struct hsr_near_boxes *boxes,
                                   struct hsr_arena *arena) {
  uint32_t n = hsr_near_boxes_n_groups(boxes);
  boxes->group_near = HSR_NEW_ZEROED(arena, uint8_t, n);
  if (!boxes->group_near || !allocate(&boxes->group_rows, n, arena))
    return HSR_E_NOMEM;
  for (uint32_t g = 0; g < n; g++) {
    struct hsr_float_box all =
        around(&boxes->rows, g * HSR_BOX_GROUP, end_of(boxes, g));
    set(&boxes->group_rows, g, &all);
  }
  return HSR_OK;
}

enum hsr_status hsr_near_boxes_make(struct hsr_near_boxes *boxes,
                                    const struct hsr_image_box *box,
                                    const uint32_t *item, uint32_t n,
                                    bool in_groups, struct hsr_arena *arena) {
  *boxes = (struct hsr_near_boxes){.n = n,
                                   .near = HSR_NEW_ZEROED(arena, uint8_t, n),
                                   .in_groups = in_groups};
  if (!boxes->near || !allocate(&boxes->rows, n, arena))
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < n; k++) {
    struct hsr_float_box own = float_box(&box[item[k]]);
    set(&boxes->rows, k, &own);
  }
  return in_groups ? make_groups(boxes, arena) : HSR_OK;
}

/* Forgets what was near the box before. */
static void clear(struct hsr_near_boxes *boxes) {
  for (uint32_t g = 0; g < hsr_near_boxes_n_groups(boxes); g++)
    if (boxes->group_near[g])
      memset(boxes->near + g * HSR_BOX_GROUP, 0,
             end_of(boxes, g) - g * HSR_BOX_GROUP);
}

static void find_in_groups(struct hsr_near_boxes *boxes,
                           const struct hsr_float_box *asked) {
  uint32_t n = hsr_near_boxes_n_groups(boxes);
  clear(boxes);
  hsr_box_rows_near(&boxes->group_rows, 0, n, asked, boxes->group_near);
  for (uint32_t g = 0; g < n; g++)
    if (boxes->group_near[g])
      hsr_box_rows_near(&boxes->rows, g * HSR_BOX_GROUP,
                        end_of(boxes, g) - g * HSR_BOX_GROUP, asked,
                        boxes->near + g * HSR_BOX_GROUP);
}

void hsr_near_boxes_find(struct hsr_near_boxes *boxes,
                         const struct hsr_image_box *box) {
  struct hsr_float_box asked = float_box(box);
  if (boxes->in_groups)
    find_in_groups(boxes, &asked);
  else
    hsr_box_rows_near(&boxes->rows, 0, boxes->n, &asked, boxes->near);
}

void hsr_near_boxes_find_among(struct hsr_near_boxes *boxes, uint32_t k,
                               uint32_t end, const struct hsr_image_box *box) {
  struct hsr_float_box asked = float_box(box);
  hsr_box_rows_near(&boxes->rows, k, end - k, &asked, boxes->near + k);
}

uint32_t hsr_near_boxes_compared(const struct hsr_near_boxes *boxes) {
  uint32_t n = boxes->in_groups ? 0 : boxes->n;
  for (uint32_t g = 0; g < hsr_near_boxes_n_groups(boxes); g++)
    if (boxes->group_near[g])
      n += end_of(boxes, g) - g * HSR_BOX_GROUP;
  return n;
}
