/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Clusters in the order of their priority for one eye: Schumacker's walk of the
 * tree of separating planes. It looks at each plane once.
 *
 * Source      R. A. Schumacker, B. Brand, M. Gilliland, W. Sharp, 1969; as
 *             described by Sutherland et al. 1974, "List-Priority Algorithms",
 *             figure 19. Why it is right: common/scene/clusters.h. */
#ifndef HSR_ALGORITHMS_CLUSTER_ORDER_H
#define HSR_ALGORITHMS_CLUSTER_ORDER_H

#include "algorithms/algorithm.h"
#include "common/exact/order.h"

/* The counter of the planes: a is the face whose plane it is, if it is one's; b
 * is the number of the separator. */
#define HSR_INTER_CLUSTER_COUNTER                                              \
  {                                                                            \
    "inter-cluster priority",                                                  \
        "separating planes that the eye is compared with", HSR_COMPARE,        \
        HSR_OF_FACE, HSR_OF_CELL, "behind|on it|in front"                      \
  }

struct hsr_cluster_order {
  const struct hsr_screen *screen;
  const struct hsr_clusters *clusters;
  struct hsr_tally *tally;
  int counter;    /* HSR_INTER_CLUSTER_COUNTER */
  uint32_t *open; /* a stack of separators and clusters to come */
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
  double eye = order->screen->view->eye[s->axis];
  int side = s->face != HSR_NO_FACE
                 ? hsr_eye_side(order->screen, s->face, order->tally)
                 : (eye > s->at) - (eye < s->at);
  HSR_STEP(order->tally, order->counter,
           s->face != HSR_NO_FACE ? HSR_FACE(s->face) : HSR_NOTHING,
           HSR_CELL(number, 0, 0), HSR_NOWHERE, side + 1);
  return side;
}

/* The next cluster, from the nearest or from the farthest on. False if that was
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
