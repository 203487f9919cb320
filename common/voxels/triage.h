/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Triage coverage masks: tables that say which of the 8 x 8 cells of a square
 * lie inside a line, which lie outside, and which the line may cross.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 3 and 4.2; N. Greene, PhD thesis, UC Santa Cruz,
 *             1995, 4.4.
 * Notation    C are the covered cells, which are inside the line. V are the
 *             vacant cells, which are outside. The others are active. A mask
 *             has bit 8 row + column for each cell.
 * Square      [0, 1] x [0, 1], y down; corner 0 (0, 0), 1 (1, 0), 2 (1, 1),
 *             3 (0, 1); side k from corner k to the next.
 * Entry       there is an entry for two sides of the square and an interval of
 *             each. It is for all lines that pass through both intervals and
 *             have corner 0 inside. For a line that has it outside, exchange C
 *             and V.
 * Certain     C and V are right for every line that meets the two sides within
 *             HSR_TRIAGE_SLACK of the intervals. The masks of samples
 *             (hsr_sample_masks) are those of the line between the middles of
 *             the intervals, and may be wrong for other lines. */
#ifndef HSR_COMMON_TRIAGE_H
#define HSR_COMMON_TRIAGE_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_triage {
  uint64_t c, v; /* C, V */
};

enum { HSR_TRIAGE_MOST = 256 }; /* most intervals along a side */
#define HSR_TRIAGE_SLACK 0x1p-12

struct hsr_triage_tables {
  int intervals;           /* K, along each side */
  struct hsr_triage *mask; /* 6 K^2, by pair of sides, interval of the first
                              side, interval of the second */
};

/* The two sides that a line crosses, first < second, and the number of their
 * pair, 0 to 5. pair -1: the line does not cross exactly two sides. The index
 * is the set of corners that are inside, bit k for corner k. */
struct hsr_triage_pair {
  signed char pair, first, second;
};
extern const struct hsr_triage_pair hsr_triage_pairs[16];

/* Makes the tables for 1 to HSR_TRIAGE_MOST intervals. They are freed with
 * hsr_triage_free also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_triage_init(struct hsr_triage_tables *tables, int intervals,
                                struct hsr_error *err);
void hsr_triage_free(struct hsr_triage_tables *tables);

/* Returns the index of a line's entry in the tables. The line is where a linear
 * function is 0; corners where it is positive are inside. The function is f at
 * corner 0, f + step[0] at corner 1 and f + step[1] at corner 3. per[k] is
 * 1/step[k]. known[k] says whether crossings of sides along direction k are
 * known well enough. -1 if the line does not cross exactly two sides, or
 * crosses a side with known[k] false. *inside becomes whether corner 0 is
 * inside. */
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

/* Fills mask[], an array of the caller with 6 intervals^2 elements, one for
 * each entry of the tables. A mask has a bit for each of 64 samples, (x[bit],
 * y[bit]) in the square: whether it is inside the line between the middles of
 * the entry's intervals. */
void hsr_sample_masks(int intervals, const double x[64], const double y[64],
                      uint64_t *mask);

#ifdef __cplusplus
}
#endif
#endif
