/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Clusters in the order of their priority for one eye: Schumacker's traversal
 * of the tree of separating planes. It compares each plane with the eye once.
 *
 * Source      R. A. Schumacker, B. Brand, M. Gilliland, W. Sharp, 1969; as
 *             described by Sutherland et al. 1974, "List-Priority Algorithms",
 *             figure 19. Why it is right: common/scene/clusters.h. */
#ifndef HSR_ALGORITHMS_CLUSTER_ORDER_H
#define HSR_ALGORITHMS_CLUSTER_ORDER_H

#include "algorithms/algorithm.h"
#include "common/exact/order.h"

/* The part and its counter. The first subject of a step is the face whose plane
 * separates, if it is that of a face; the second is the number of the
 * separator. */
extern const struct hsr_part hsr_cluster_order_part;
enum { HSR_INTER_CLUSTER = HSR_FIRST_OF(HSR_PART_CLUSTER_ORDER) };

struct hsr_cluster_order {
  const struct hsr_screen *screen;
  const struct hsr_clusters *clusters;
  struct hsr_tally *tally;
  uint32_t *open; /* a stack: the separators and clusters that are to come */
  uint32_t n_open;
};

/* Begins the order for the eye of screen->view. `screen` and `tally` are
 * borrowed as long as *order; memory is the arena's. HSR_E_NOMEM. */
enum hsr_status hsr_cluster_order_init(struct hsr_cluster_order *order,
                                       const struct hsr_screen *screen,
                                       struct hsr_arena *arena,
                                       struct hsr_tally *tally);

/* The next cluster, from front to back if nearest_first, else from back to
 * front. False: there is no other. */
bool hsr_next_cluster(struct hsr_cluster_order *order, bool nearest_first,
                      uint32_t *cluster);

#endif
