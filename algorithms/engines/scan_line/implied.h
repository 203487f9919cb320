/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An implied edge, where two faces penetrate, that is carried from row to row.
 * The planes of two faces meet on a straight line of the screen. So where they
 * meet on two rows says where they do on all. */
#ifndef HSR_ALGORITHMS_IMPLIED_H
#define HSR_ALGORITHMS_IMPLIED_H

#include "algorithms/engines/scan_line/scan_line.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How much of it is known: its place on `row`, if there is a point; and its
 * increment from row to row, if there are two. In pixels, rounded: where it is
 * used, exact comparisons must follow. */
struct hsr_implied {
  int points, row;
  double x, increment;
};

/* Notes the point of row j, calculated from the planes of f and g, unless two
 * are known. True if it was noted. */
bool hsr_implied_note(struct hsr_implied *implied, const struct hsr_scan *scan,
                      uint32_t f, uint32_t g, int j);

/* The first column to the right of the edge on row j, extrapolated from its two
 * points; within [-1, m + 1]. */
int hsr_implied_column(const struct hsr_implied *implied,
                       const struct hsr_scan *scan, int j);

#ifdef __cplusplus
}
#endif
#endif
