/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The refinement pass, in its two ways: for a filter of a pixel, and for wider
 * ones. The thesis, 5.4.3. */
#ifndef HSR_ALGORITHMS_BOUNDED_REFINE_H
#define HSR_ALGORITHMS_BOUNDED_REFINE_H

#include "algorithms/hierarchical/bounded/bounded.h"
#include "algorithms/hierarchical/bounded/queue.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_bounded_refining {
  struct hsr_bounded_tree *tree;
  const struct hsr_bounded_limits *limits;
  struct hsr_area_bounds *answer; /* of all the picture */
  struct hsr_bounded_queue queue;
  uint64_t unfinished;               /* pixels */
  struct hsr_bounded_spread *spread; /* across pixels only */
};

struct hsr_bounded_way {
  /* Bounds what the tiling pass left, and fills the queue; accepts the pixels
   * that are known well enough. False if memory ran out. */
  bool (*begin)(struct hsr_bounded_refining *r);
  /* Is a leaf from the queue still there, and of use? */
  bool (*is_wanted)(const struct hsr_bounded_refining *r,
                    const struct hsr_bounded_item *item);
  /* Divides a leaf. False if memory ran out. */
  bool (*refine)(struct hsr_bounded_refining *r,
                 const struct hsr_bounded_item *item);
  /* Writes the pixels that are not accepted as they are; and accepts them. */
  void (*write)(struct hsr_bounded_refining *r);
  void (*accept_rest)(struct hsr_bounded_refining *r);
};
extern const struct hsr_bounded_way hsr_bounded_within_pixels,
    hsr_bounded_across_pixels;

/* The widest interval of a cell. */
double hsr_bounded_width(const double lo[3], const double hi[3]);

/* Tells that pixel (i, j), which is written, is done. */
void hsr_bounded_accept(const struct hsr_bounded_refining *r, int i, int j);

/* x, not negative, moved outward by a share of itself. */
static inline double hsr_bounded_down(double x, double by) {
  return x - by * x;
}
static inline double hsr_bounded_up(double x, double by) {
  return x + by * x;
}

#ifdef __cplusplus
}
#endif
#endif
