/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/boxes/box_rows.h"
#include "common/base/vector.h"

HSR_VECTOR static bool find_near(const float *x0, const float *y0,
                                 const float *x1, const float *y1, size_t n,
                                 struct hsr_float_box box, uint8_t *near) {
  unsigned any = 0;
  for (size_t i = 0; i < n; i++) {
    unsigned overlaps = (x0[i] <= box.x1) & (x1[i] >= box.x0) &
                        (y0[i] <= box.y1) & (y1[i] >= box.y0);
    near[i] = (uint8_t)overlaps;
    any |= overlaps;
  }
  return any;
}

bool hsr_box_rows_near(const struct hsr_box_rows *rows, size_t k, size_t n,
                       const struct hsr_float_box *box, uint8_t *near) {
  return find_near(rows->x0 + k, rows->y0 + k, rows->x1 + k, rows->y1 + k, n,
                   *box, near);
}
