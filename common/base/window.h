/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A rectangle of samples. */
#ifndef HSR_COMMON_BASE_WINDOW_H
#define HSR_COMMON_BASE_WINDOW_H

/* Columns [x0, x1) from the left and rows [y0, y1) from the top. The window is
 * empty if x0 >= x1 or y0 >= y1. */
struct hsr_window {
  int x0, y0, x1, y1;
};

/* Returns the part that two windows have in common. It may be empty. */
static inline struct hsr_window hsr_window_meet(const struct hsr_window *a,
                                                const struct hsr_window *b) {
  struct hsr_window w = {
      a->x0 > b->x0 ? a->x0 : b->x0, a->y0 > b->y0 ? a->y0 : b->y0,
      a->x1 < b->x1 ? a->x1 : b->x1, a->y1 < b->y1 ? a->y1 : b->y1};
  return w;
}

#endif
