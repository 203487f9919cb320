/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes on the screen, as four arrays of their bounds: so many boxes at once
 * are tested for overlapping another box. */
#ifndef HSR_ALGORITHMS_BOX_ROWS_H
#define HSR_ALGORITHMS_BOX_ROWS_H

#include "algorithms/algorithm.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_float_box {
  float x0, y0, x1, y1;
};

/* A box that overlaps no other. */
static inline struct hsr_float_box hsr_no_float_box(void) {
  return (struct hsr_float_box){INFINITY, INFINITY, -INFINITY, -INFINITY};
}

/* A float that is certainly below, or above, a number. */
static inline float hsr_float_below(double x) {
  return nextafterf((float)x, -INFINITY);
}
static inline float hsr_float_above(double x) {
  return nextafterf((float)x, INFINITY);
}

/* Box k is from (x0[k], y0[k]) to (x1[k], y1[k]). The arrays are borrowed. */
struct hsr_box_rows {
  float *x0, *y0, *x1, *y1;
};

/* For n boxes from number k on: sets near[i] to 1 if box k + i has a point in
 * common with `box`, else to 0. Returns whether any is 1. */
bool hsr_box_rows_near(const struct hsr_box_rows *rows, size_t k, size_t n,
                       const struct hsr_float_box *box, uint8_t *near);

#ifdef __cplusplus
}
#endif
#endif
