/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Clusters in the order of their priority for one eye: Schumacker's walk of the
 * tree of separating planes, each of which is looked at once.
 *
 * Source      R. A. Schumacker, B. Brand, M. Gilliland, W. Sharp, 1969; as
 *             described by Sutherland et al. 1974, "List-Priority Algorithms",
 *             figure 19. Why it is right: common/scene/clusters.h. */
#ifndef HSR_ALGORITHMS_CLUSTER_ORDER_H
#define HSR_ALGORITHMS_CLUSTER_ORDER_H

#include "algorithms/algorithm.h"
#include "common/exact/order.h"

struct hsr_cluster_order {
  const struct hsr_screen *screen;
  const struct hsr_clusters *clusters;
  struct hsr_tally *tally;
  int counter;    /* of the planes that are looked at */
  uint32_t *open; /* separators and clusters to come, the last one first */
  uint32_t n_open;
};

/* Memory from `arena`. HSR_E_NOMEM. */
static inline enum hsr_status
hsr_cluster_order_init(struct hsr_cluster_order *order,
                       const struct hsr_screen *screen, struct hsr_arena *arena,
                       struct hsr_tally *tally, int counter) {
  const struct hsr_clusters *clusters = screen->world->clusters;
  *order =
      (struct hsr_cluster_order){screen, clusters, tally, counter, NULL, 1};
  order->open = HSR_NEW(arena, uint32_t, (size_t)clusters->n_separators + 2);
  if (!order->open)
    return HSR_E_NOMEM;
  order->open[0] = clusters->root;
  return HSR_OK;
}

/* On which side of a separator the eye is: +1 in front of it, -1 behind, 0 on
 * it. */
static inline int hsr_separator_side(const struct hsr_cluster_order *order,
                                     uint32_t number) {
  const struct hsr_separator *s = &order->clusters->separator[number];
  HSR_STEP9(order->tally, order->counter, HSR_COMPARE, s->face, number, 0, 0, 0,
            0);
  if (s->face != HSR_NO_FACE)
    return hsr_eye_side(order->screen, s->face, order->tally);
  double eye = order->screen->view->E[s->axis];
  return eye > s->at ? 1 : eye < s->at ? -1 : 0;
}

/* The next cluster, the nearest first or else the farthest: false, if that was
 * all. */
static inline bool hsr_next_cluster(struct hsr_cluster_order *order,
                                    bool nearest_first, uint32_t *cluster) {
  while (order->n_open) {
    uint32_t next = order->open[--order->n_open];
    if (next & HSR_IS_CLUSTER) {
      *cluster = next & ~HSR_IS_CLUSTER;
      return true;
    }
    const struct hsr_separator *s = &order->clusters->separator[next];
    bool front_first = (hsr_separator_side(order, next) > 0) == nearest_first;
    order->open[order->n_open++] = front_first ? s->behind : s->front;
    order->open[order->n_open++] = front_first ? s->front : s->behind;
  }
  return false;
}

#endif
