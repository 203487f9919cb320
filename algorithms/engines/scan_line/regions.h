/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decisions of a scan line that are carried to the next one: what is visible
 * between two edges of the X sort list is decided once, and holds as long as
 * the region between these edges is untroubled.
 *
 * Notation    Region: what lies between two edges, `first` and `last`, on the
 *             rows on which its decision holds. No edge `first`: it begins at
 *             the window's left side. No `last`: it ends at the right one.
 *             Place k of a list: behind the first k of its edges.
 * Why a carried decision is right
 *             It is carried to a row if three things hold.
 *             - From `first` to `last` the list holds the same edges as on the
 *             row before, in the same order.
 *             - At `first` the same faces are involved as there. A face is
 *             involved if an odd number of its edges have been passed. So the
 *             same faces cover the same places between the same edges.
 *             - The row comes before the region's `until`. On the rows up to
 *             there the plane of the visible face lies before those of all
 *             others, wherever these are involved in the region. That is
 *             proved when the decision is made (hsr_regions_foresee): the
 *             difference of two planes' 1/t is linear on the screen. So it is
 *             positive in a trapezoid if it is so at the four corners: on the
 *             two edges that bound it, on this row and on the last one. Or it
 *             is not negative at both vertices of one of the edges, and
 *             positive along the other: two faces that touch along an edge. A
 *             sample on the left edge is perturbed to the right of it, and one
 *             on the right edge is not of the region.
 *             Nothing is asked of convexity, and faces may penetrate outside
 *             of the region.
 * Samples     Where an edge passes is known within a tolerance, and a plane's
 *             1/t within its error. Corners must differ by more than both. The
 *             perturbation of samples is less than any such difference. At
 *             vertices the planes are compared exactly.
 * Invariants  differs[] says of which pieces an odd number of edges are passed
 *             in just one of the two lists: the first `here` edges of the row's
 *             and the first `there` of old[]. n_differ: how many these are. The
 *             edges from `here` up to `agreed` are known to be those from
 *             `there` on. */
#ifndef HSR_ALGORITHMS_REGIONS_H
#define HSR_ALGORITHMS_REGIONS_H

#include "algorithms/engines/scan_line/scan_line.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What has been decided of a region. */
struct hsr_region {
  uint32_t last; /* edge; HSR_NO_ID: none */
  uint32_t face; /* the visible one, or HSR_BACKGROUND */
  int until;     /* the first row for which it is not proved */
  int row;       /* the last one on which it was found to hold */
};

/* Counters of the module's own. */
struct hsr_regions_counters {
  int tests;     /* an edge is compared with one of the row before */
  int ends;      /* does an edge of a region end before the next row? */
  int forecasts; /* two faces, along an edge that bounds where both are */
};

struct hsr_regions {
  struct hsr_scan *scan; /* borrowed */
  struct hsr_regions_counters counters;
  int j;

  uint32_t n_list;              /* of the row's list */
  uint32_t *old, n_old, *place; /* that of the row before; by edge: its number
                                   there, if it is there */
  struct hsr_region *region;    /* by first edge; the last one: by none */

  bool *differs;
  uint32_t n_differ, here, there, agreed;
};

/* Begins a window whose edges have all been added; n_pieces: more than the
 * greatest number of a piece. The scan is borrowed; memory from job->scratch.
 * HSR_E_NOMEM. */
enum hsr_status hsr_regions_begin(struct hsr_regions *regions,
                                  struct hsr_scan *scan, size_t n_pieces,
                                  struct hsr_regions_counters counters);

/* Begins row j, when the scan has been brought to it; and ends it. */
void hsr_regions_open(struct hsr_regions *regions, int j);
void hsr_regions_close(struct hsr_regions *regions);

/* The region that begins at place k of the list, if its decision can be carried
 * to this row; else NULL. *end: the place in front of its last edge. */
const struct hsr_region *hsr_regions_carried(struct hsr_regions *regions,
                                             uint32_t k, uint32_t *end);

/* Notes what has been decided between places k and `end`, to hold up to row
 * `until`. The decision is about all samples that the two edges bound. */
void hsr_regions_note(struct hsr_regions *regions, uint32_t k, uint32_t end,
                      uint32_t face, int until);

/* The first row after this one for which it is not proved that the plane of f
 * is nearer than that of g at all samples between the edges `left` and `right`;
 * HSR_NO_ID: the side of the window. At most `until`. This row itself, if it is
 * not proved here. */
int hsr_regions_foresee(struct hsr_regions *regions, uint32_t f, uint32_t g,
                        uint32_t left, uint32_t right, int until);

/* Whether all edges go on to the next row, from the one in front of place k to
 * the one in front of place `end`. */
bool hsr_regions_go_on(struct hsr_regions *regions, uint32_t k, uint32_t end);

/* The edge in front of place k of the list, and the one behind it. */
static inline uint32_t hsr_regions_before(const struct hsr_regions *regions,
                                          uint32_t k) {
  return k ? regions->scan->list[k - 1] : HSR_NO_ID;
}
static inline uint32_t hsr_regions_after(const struct hsr_regions *regions,
                                         uint32_t k) {
  return k < regions->n_list ? regions->scan->list[k] : HSR_NO_ID;
}

#ifdef __cplusplus
}
#endif
#endif
