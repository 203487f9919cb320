/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faces against rectangles of samples: what all subdivision of the picture
 * asks.
 *
 * Source      J. E. Warnock, "A hidden-surface algorithm for computer-generated
 *             halftone pictures", University of Utah, TR 4-15, 1969;
 *             Sutherland et al. 1974, figure 26, "Surrounding Polygons".
 * Notation    window -> area, a rectangle whose corners are samples;
 *             surrounder, intersecter, disjoint -> enum hsr_relation
 * Certain     a face that is said to be disjoint covers no sample of the area,
 *             and a surrounder covers all of them. Where neither can be proved,
 *             the face is an intersecter. An area of one sample has none. */
#ifndef HSR_ALGORITHMS_AREA_H
#define HSR_ALGORITHMS_AREA_H

#include "algorithms/algorithm.h"
#include "common/exact/screen.h"

/* Compiled twice, as the algorithms are. */
#define hsr_area_make HSR_OF_BUILD(hsr_area_make)
#define hsr_area_relate HSR_OF_BUILD(hsr_area_relate)
#define hsr_area_depths HSR_OF_BUILD(hsr_area_depths)
#define hsr_area_order HSR_OF_BUILD(hsr_area_order)

struct hsr_area {
  int x0, y0, x1, y1; /* columns [x0, x1), rows [y0, y1) */
  int level;          /* the caller's: of subdivision, 0 the picture */
  /* On the screen: of the first and the last column and row; the centre. */
  double sx[2], sy[2], centre_x, centre_y, half_width, half_height;
};

/* The area of these samples, of which there is at least one. Its level is 0. */
struct hsr_area hsr_area_make(const struct hsr_view *view,
                              struct hsr_window samples);

static inline bool hsr_area_is_sample(const struct hsr_area *area) {
  return area->x1 - area->x0 == 1 && area->y1 - area->y0 == 1;
}

static inline struct hsr_window hsr_area_samples(const struct hsr_area *area) {
  return hsr_window_make(area->x0, area->y0, area->x1, area->y1);
}

/* Figure 26. */
enum hsr_relation { HSR_DISJOINT, HSR_INTERSECTER, HSR_SURROUNDER };

/* How a relevant face lies to an area. *by_box: its bounds told. */
enum hsr_relation hsr_area_relate(const struct hsr_screen *screen, uint32_t f,
                                  const struct hsr_area *area, bool *by_box,
                                  struct hsr_tally *tally);

/* The depths of a face's plane at the corners of an area, as hsr_depth. */
struct hsr_area_depths {
  uint32_t id;
  double q[4], error;
};
struct hsr_area_depths hsr_area_depths(const struct hsr_screen *screen,
                                       uint32_t f, const struct hsr_area *area);

/* +1 if f is nearer than g at all corners of one area, and so between them, -1
 * if g is, 0 if neither or not certain. */
int hsr_area_order(const struct hsr_screen *screen,
                   const struct hsr_area_depths *f,
                   const struct hsr_area_depths *g);

#endif
