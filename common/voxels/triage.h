/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Triage coverage masks: which of the 8 x 8 cells of a square a line leaves
 * inside, which outside, by looking it up.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 3 and 4.2; N. Greene, PhD thesis, UC Santa Cruz,
 *             1995, 4.4.
 * Notation    (C, V): covered cells, inside the line, and vacant ones, outside;
 *             the others are active. Bit 8 row + column.
 * Square      [0, 1] x [0, 1], y down; corner 0 (0, 0), 1 (1, 0), 2 (1, 1),
 *             3 (0, 1); side k from corner k to the next.
 * Entry       for two sides and an interval of each: of all lines through both
 *             intervals, corner 0 being inside. For a line of the other way C
 *             and V change places.
 * Certain     C and V hold for every line that meets the two sides within
 *             HSR_TRIAGE_SLACK of the intervals. The masks of samples are those
 *             of the line between the middles, and may be wrong. */
#ifndef HSR_COMMON_TRIAGE_H
#define HSR_COMMON_TRIAGE_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_triage {
  uint64_t c, v;
};

enum { HSR_TRIAGE_MOST = 256 }; /* intervals a side */
#define HSR_TRIAGE_SLACK 0x1p-12

struct hsr_triage_tables {
  int intervals;           /* K a side */
  struct hsr_triage *mask; /* 6 K^2: pair of sides, interval, interval */
};

/* The pairs of sides, by the corners that are inside, bit k for corner k: the
 * sides that the line crosses, ascending; none if it crosses other than two. */
struct hsr_triage_pair {
  signed char pair, first, second; /* pair -1: none */
};
extern const struct hsr_triage_pair hsr_triage_pairs[16];

/* HSR_E_NOMEM; freed with hsr_triage_free also then. */
enum hsr_status hsr_triage_init(struct hsr_triage_tables *tables, int intervals,
                                struct hsr_error *err);
void hsr_triage_free(struct hsr_triage_tables *tables);

/* A line's place in the tables: that which is f at corner 0, and step[0] more
 * at corner 1, step[1] more at corner 3; per[k] is 1/step[k]. -1 if it has
 * none, or it crosses a side along which known[k] is false. Sets whether corner
 * 0 is inside. */
static inline int hsr_triage_entry(int intervals, double f,
                                   const double step[2], const double per[2],
                                   const bool known[2], bool *inside) {
  double corner[4] = {f, f + step[0], f + step[0] + step[1], f + step[1]};
  unsigned signs = (unsigned)(corner[0] > 0) | (unsigned)(corner[1] > 0) << 1 |
                   (unsigned)(corner[2] > 0) << 2 |
                   (unsigned)(corner[3] > 0) << 3;
  struct hsr_triage_pair pair = hsr_triage_pairs[signs];
  int s = pair.first, t = pair.second;
  *inside = signs & 1;
  if (pair.pair < 0 || !known[s & 1] || !known[t & 1])
    return -1;
  int i = (int)(corner[s] * per[s & 1] * (s < 2 ? -intervals : intervals));
  int j = (int)(corner[t] * per[t & 1] * (t < 2 ? -intervals : intervals));
  i = i < 0 ? 0 : i >= intervals ? intervals - 1 : i;
  j = j < 0 ? 0 : j >= intervals ? intervals - 1 : j;
  return (pair.pair * intervals + i) * intervals + j;
}

/* The masks of samples with the tables' entries: bit 8 row + column is sample
 * (x[bit], y[bit]) of the square. 6 intervals^2 of them, the caller's. */
void hsr_sample_masks(int intervals, const double x[64], const double y[64],
                      uint64_t *mask);

#ifdef __cplusplus
}
#endif
#endif
