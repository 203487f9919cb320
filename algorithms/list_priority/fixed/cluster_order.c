/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/list_priority/fixed/cluster_order.h"

enum hsr_status hsr_cluster_order_init(struct hsr_cluster_order *order,
                                       const struct hsr_screen *screen,
                                       struct hsr_arena *arena,
                                       struct hsr_tally *tally) {
  const struct hsr_clusters *clusters = screen->world->clusters;
  *order = (struct hsr_cluster_order){screen, clusters, tally, NULL, 1};
  order->open = HSR_NEW(arena, uint32_t, (size_t)clusters->n_separators + 2);
  if (!order->open)
    return HSR_E_NOMEM;
  order->open[0] = clusters->root;
  return HSR_OK;
}

/* On which side of a separator the eye is: +1 in front of it, -1 behind, 0 on
 * it. */
static int side_of_eye(const struct hsr_cluster_order *order, uint32_t number) {
  const struct hsr_separator *s = &order->clusters->separator[number];
  double eye = order->screen->view->eye[s->axis];
  int side = s->face != HSR_NO_FACE
                 ? hsr_eye_side(order->screen, s->face, order->tally)
                 : (eye > s->at) - (eye < s->at);
  HSR_STEP(order->tally, HSR_INTER_CLUSTER,
           s->face != HSR_NO_FACE ? HSR_FACE(s->face) : HSR_NOTHING,
           HSR_CELL(number, 0, 0), HSR_NOWHERE, side + 1);
  return side;
}

bool hsr_next_cluster(struct hsr_cluster_order *order, bool nearest_first,
                      uint32_t *cluster) {
  while (order->n_open) {
    uint32_t next = order->open[--order->n_open];
    if (next & HSR_IS_CLUSTER) {
      *cluster = next & ~HSR_IS_CLUSTER;
      return true;
    }
    const struct hsr_separator *s = &order->clusters->separator[next];
    bool front_first = (side_of_eye(order, next) > 0) == nearest_first;
    order->open[order->n_open++] = front_first ? s->behind : s->front;
    order->open[order->n_open++] = front_first ? s->front : s->behind;
  }
  return false;
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"inter-cluster priority",
     "separating planes that the eye is compared with", HSR_COMPARE,
     HSR_OF_FACE, HSR_OF_CELL, "behind|on it|in front", .key = "inter-cluster"},
    {NULL}};

static double predict_inter_cluster(const struct hsr_table1 *t) {
  return 10 * t->C_t;
}

static const struct hsr_step steps[] = {{"inter-cluster priority",
                                         HSR_INTER_CLUSTER, HSR_KIND_TREE,
                                         "10 C_t", predict_inter_cluster},
                                        {NULL}};

static const struct hsr_sort sorts[] = {
    {"clusters", "Z", "tree of separating planes", "once a frame"}, {NULL}};

const struct hsr_part hsr_cluster_order_part = {
    HSR_PART_CLUSTER_ORDER, counters, steps, sorts, {NULL}};
