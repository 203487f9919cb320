/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Watkins' scan lines on pieces that have an order of priority: his last step
 * compares priority numbers instead of depths. For newell_watkins.c and
 * schumacker_newell_watkins.c.
 *
 * Notation    priority number -> the place at which a piece left the list that
 *             put it in order, the farthest first; the lists of several clusters
 *             follow one another
 * Invariant   of two pieces that cover a sample, the one with the greater number
 *             is the nearer one, unless both are of thick faces, or one of a
 *             loose face
 * Departures  Two segments of thick faces, or of which one is loose, are compared
 *             in depth at both ends of what they share. If the answers differ,
 *             the crossing is searched for, as depth is linear along the row.
 *             These comparisons are counted apart. */
#ifndef HSR_ALGORITHMS_PRIORITY_SCAN_H
#define HSR_ALGORITHMS_PRIORITY_SCAN_H

#include "algorithms/image_space/point/watkins.h"
#include "algorithms/list_priority/per_frame/priority_list.h"

struct hsr_priority_scan {
  struct hsr_priority_list list;
  struct hsr_growing pieces; /* struct hsr_piece, by priority number */
  struct hsr_scan_room room; /* that they need */
  bool *loose;               /* by face: it has no place in the order */
  struct hsr_watkins watkins;
};

/* Begins a frame. The arguments are those of hsr_list_reserve. HSR_E_NOMEM. */
enum hsr_status hsr_priority_scan_reserve(struct hsr_priority_scan *scan,
                                          const struct hsr_job *job,
                                          const struct hsr_screen *screen,
                                          struct hsr_keeper *keeper);

/* Puts n faces in order, and behind those that are there. HSR_E_NOMEM. */
enum hsr_status hsr_priority_scan_add(struct hsr_priority_scan *scan,
                                      const uint32_t *faces, uint32_t n);

/* Adds a face that has no place in the order. HSR_E_NOMEM. */
enum hsr_status hsr_priority_scan_add_loose(struct hsr_priority_scan *scan,
                                            uint32_t f);

/* Solves the view's window. HSR_E_NOMEM. */
enum hsr_status hsr_priority_scan_solve(struct hsr_priority_scan *scan);

/* The part of the last step, and its counters. Its lines stand between the two
 * groups of those of hsr_spans_part. */
extern const struct hsr_part hsr_priority_search_part;
enum {
  HSR_PRIORITY_SEARCH = HSR_FIRST_OF(HSR_PART_PRIORITY_SEARCH),
  HSR_PRIORITY_THICKNESS
};

#endif
