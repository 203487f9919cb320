/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The refinement pass (thesis, 5.4.3), for bounded/ only. It has two ways: for
 * a filter that is one pixel wide, and for wider ones. refine.c has what is
 * common. */
#ifndef HSR_ALGORITHMS_BOUNDED_REFINE_H
#define HSR_ALGORITHMS_BOUNDED_REFINE_H

#include "algorithms/hierarchical/bounded/bounded.h"
#include "algorithms/hierarchical/bounded/queue.h"
#include "common/answers/kinds/area.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_bounded_refining {
  struct hsr_bounded_tree *tree;
  const struct hsr_bounded_limits *limits;
  struct hsr_area_bounds *answer; /* of the whole picture */
  struct hsr_bounded_queue queue;
  uint64_t unfinished; /* pixels whose intervals are too wide yet */
  struct hsr_bounded_spread *spread; /* hsr_bounded_across_pixels only */
};

/* What differs in the two ways. */
struct hsr_bounded_way {
  /* Bounds the cells that the tiling pass left, accepts the pixels whose
   * intervals are narrow enough, and fills the queue. False: out of memory. */
  bool (*begin)(struct hsr_bounded_refining *r);
  /* Does a leaf that was taken from the queue still exist, and is it of
     * use? */
  bool (*is_wanted)(const struct hsr_bounded_refining *r,
                    const struct hsr_bounded_item *item);
  /* Divides a leaf. False: out of memory. */
  bool (*refine)(struct hsr_bounded_refining *r,
                 const struct hsr_bounded_item *item);
  /* write: writes the pixels that have not been accepted, as they are known
   * so far. accept_rest: accepts them. */
  void (*write)(struct hsr_bounded_refining *r);
  void (*accept_rest)(struct hsr_bounded_refining *r);
};
extern const struct hsr_bounded_way hsr_bounded_within_pixels,
    hsr_bounded_across_pixels;

/* The width of the widest of a cell's intervals. */
double hsr_bounded_width(const double lo[3], const double hi[3]);

/* Counts that pixel (i, j) is accepted. It has been written. */
void hsr_bounded_accept(const struct hsr_bounded_refining *r, int i, int j);

/* x, which is not negative, made smaller or larger by a share of itself. */
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
