/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/boxes/near_boxes.h"

static struct hsr_float_box float_box(const struct hsr_image_box *box) {
  return (struct hsr_float_box){
      box->x0 == box->x0 ? hsr_float_below(box->x0) : -INFINITY,
      box->y0 == box->y0 ? hsr_float_below(box->y0) : -INFINITY,
      box->x1 == box->x1 ? hsr_float_above(box->x1) : INFINITY,
      box->y1 == box->y1 ? hsr_float_above(box->y1) : INFINITY};
}

enum { BLOCK = 64 }; /* items */

static uint32_t n_blocks(uint32_t n) {
  return n / BLOCK + (n % BLOCK > 0);
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

static uint32_t end_of(const struct hsr_near_boxes *boxes, uint32_t block) {
  uint32_t first = block * BLOCK;
  return boxes->n - first < BLOCK ? boxes->n : first + BLOCK;
}

enum hsr_status hsr_near_boxes_make(struct hsr_near_boxes *boxes,
                                    const struct hsr_image_box *box,
                                    const uint32_t *item, uint32_t n,
                                    struct hsr_arena *arena) {
  *boxes = (struct hsr_near_boxes){
      .n = n,
      .near = HSR_NEW_ZEROED(arena, uint8_t, n),
      .block_near = HSR_NEW_ZEROED(arena, uint8_t, n_blocks(n))};
  if (!boxes->near || !boxes->block_near || !allocate(&boxes->rows, n, arena) ||
      !allocate(&boxes->block_rows, n_blocks(n), arena))
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < n; k++) {
    struct hsr_float_box own = float_box(&box[item[k]]);
    set(&boxes->rows, k, &own);
  }
  for (uint32_t b = 0; b < n_blocks(n); b++) {
    struct hsr_float_box all =
        around(&boxes->rows, b * BLOCK, end_of(boxes, b));
    set(&boxes->block_rows, b, &all);
  }
  return HSR_OK;
}

/* Forgets what was near the box before. */
static void clear(struct hsr_near_boxes *boxes) {
  for (uint32_t b = 0; b < n_blocks(boxes->n); b++)
    if (boxes->block_near[b])
      memset(boxes->near + b * BLOCK, 0, end_of(boxes, b) - b * BLOCK);
}

void hsr_near_boxes_find(struct hsr_near_boxes *boxes,
                         const struct hsr_image_box *box) {
  struct hsr_float_box asked = float_box(box);
  clear(boxes);
  hsr_box_rows_near(&boxes->block_rows, 0, n_blocks(boxes->n), &asked,
                    boxes->block_near);
  for (uint32_t b = 0; b < n_blocks(boxes->n); b++)
    if (boxes->block_near[b])
      hsr_box_rows_near(&boxes->rows, b * BLOCK, end_of(boxes, b) - b * BLOCK,
                        &asked, boxes->near + b * BLOCK);
}
