/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A rectangle of samples. */
#ifndef HSR_COMMON_BASE_WINDOW_H
#define HSR_COMMON_BASE_WINDOW_H

/* Columns [x0, x1), rows [y0, y1). */
struct hsr_window {
  int x0, y0, x1, y1;
};

#endif
