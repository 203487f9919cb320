/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The surround test, in the three ways that the survey tells.
 *
 * Source      Sutherland et al. 1974, "Surrounding Polygons", figure 8.
 * Ways        sides: of a convex polygon, the sides of its edges' lines on which
 *             the point is; it ends at the first that differs.
 *             crossings: how many edges cross a semi-infinite line, which runs
 *             from the point to the left.
 *             angles: the sum of the angles that the edges subtend, in
 *             quadrants: two bits, as the survey notes.
 * Exact       The point is a sample, which is displaced infinitesimally
 *             (common/view/view.h). So no corner lies on the line or between
 *             two quadrants, and the point lies on no edge. Whether a corner is
 *             above or below the sample, to its left or right, and on which
 *             side of an edge the sample is: each is decided in doubles with a
 *             proved bound, else in exact numbers.
 * Twice       The survey takes a sum of 4 pi to be inside, of a polygon that
 *             overlaps itself. A face of a scene covers a sample if the parity
 *             of its crossings says so. The number of turns has that parity, so
 *             4 pi is outside here.
 * Convex      A face is known to be convex if it is a triangle; or if it
 *             certainly turns one way at all corners of its picture, and once
 *             around in all. That is asked once a frame, and not counted. Any
 *             other is left to `crossings`. */
#ifndef HSR_ALGORITHMS_SURROUND_H
#define HSR_ALGORITHMS_SURROUND_H

#include "algorithms/algorithm.h"
#include "common/exact/screen.h"

enum hsr_surround_way {
  HSR_SURROUND_SIDES,
  HSR_SURROUND_CROSSINGS,
  HSR_SURROUND_ANGLES
};

struct hsr_surround {
  const struct hsr_screen *screen;
  struct hsr_tally *tally;
  enum hsr_surround_way way;
  struct hsr_view columns; /* the view, turned: its rows are columns */
  signed char *convex;     /* by face: 1 yes, -1 not known to be, 0 not asked */
};

/* Begins a frame. The screen is borrowed; memory from `arena`. HSR_E_NOMEM. */
enum hsr_status hsr_surround_init(struct hsr_surround *s,
                                  const struct hsr_screen *screen,
                                  enum hsr_surround_way way,
                                  struct hsr_arena *arena,
                                  struct hsr_tally *tally);

/* Whether face f, which is whole, surrounds sample (i, j). */
bool hsr_surrounds(struct hsr_surround *s, uint32_t f, int i, int j);

/* The part of the test. */
extern const struct hsr_part hsr_surround_part;
enum {
  HSR_SURROUND_TESTS = HSR_FIRST_OF(HSR_PART_SURROUND),
  HSR_EDGE_SIDES,
  HSR_EDGE_ROWS,
  HSR_EDGE_CROSSINGS,
  HSR_CORNER_QUADRANTS,
  HSR_EDGE_DIAGONALS
};

#endif
