/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A rectangle of samples. */
#ifndef HSR_COMMON_BASE_WINDOW_H
#define HSR_COMMON_BASE_WINDOW_H

/* Columns [x0, x1) from the left and rows [y0, y1) from the top. The window is
 * empty if x0 >= x1 or y0 >= y1. */
struct hsr_window {
  int x0, y0, x1, y1;
};

#endif
