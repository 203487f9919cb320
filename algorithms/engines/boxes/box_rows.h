/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes on the screen, their bounds side by side in memory: which of them overlap
 * another box is told many at once. What overlaps nothing is not touched. */
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

/* A box that overlaps none. */
static inline struct hsr_float_box hsr_no_float_box(void) {
  return (struct hsr_float_box){INFINITY, INFINITY, -INFINITY, -INFINITY};
}

/* The next float below a number, and above. */
static inline float hsr_float_below(double x) {
  return nextafterf((float)x, -INFINITY);
}
static inline float hsr_float_above(double x) {
  return nextafterf((float)x, INFINITY);
}

/* Box k is from (x0[k], y0[k]) to (x1[k], y1[k]). All borrowed. */
struct hsr_box_rows {
  float *x0, *y0, *x1, *y1;
};

/* Sets near[i] to 1 if box k + i has a point in common with `box`, else to 0, for
 * n boxes. Returns whether any is set. */
bool hsr_box_rows_near(const struct hsr_box_rows *rows, size_t k, size_t n,
                       const struct hsr_float_box *box, uint8_t *near);

#ifdef __cplusplus
}
#endif
#endif
