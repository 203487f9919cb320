/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Implied edges that are carried from row to row: see implied.h. */
#include "algorithms/engines/scan_line/implied.h"

bool hsr_implied_note(struct hsr_implied *implied, const struct hsr_scan *scan,
                      uint32_t f, uint32_t g, int j) {
  if (implied->points == 2 || (implied->points == 1 && implied->row == j))
    return false;
  const struct hsr_depth_plane *p = &scan->screen.plane[f];
  const struct hsr_depth_plane *q = &scan->screen.plane[g];
  double y = hsr_sample_y(scan->job->view, j);
  double x = ((q->b - p->b) * y + q->c - p->c) / (p->a - q->a);
  if (implied->points)
    implied->increment = (x - implied->x) / (j - implied->row);
  implied->x = x;
  implied->row = j;
  implied->points++;
  return true;
}

int hsr_implied_column(const struct hsr_implied *implied,
                       const struct hsr_scan *scan, int j) {
  const struct hsr_view *view = scan->job->view;
  double x = implied->x + (j - implied->row) * implied->increment;
  double column = ceil(x - hsr_sample_x(view, 0));
  return column > -1 ? (int)fmin(column, view->m + 1) : -1;
}
