/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contour edges sorted by the upper left corner of the smallest rectangle
 * around their images.
 *
 * Source      Sutherland et al. 1974, chapter IV, "Area Coherence": a proposal
 *             in two sentences.
 * Invariant   from n_unknown on, contour[] is in the order of the corners, and
 *             reach[k] is the greatest y1 of the boxes [n_unknown, k]. So it
 *             does not decrease, and no box before the first that reaches down
 *             to another box overlaps that one
 * Cost        about N log N comparisons to sort, 2 log N to find an edge's part
 *             of the N, and one for each box of that part, most of which lie to
 *             the left or to the right; how small the part is depends on the
 *             longest edges */
#include "algorithms/object_space/edges/edge_intersection.h"

#include <math.h>
#include <string.h>

static bool is_known(const struct hsr_network *network, uint32_t e) {
  return network->box[e].x0 > -INFINITY;
}

/* Whether the corner of a comes before that of b. */
static bool is_before(const struct hsr_network *network, uint32_t a, uint32_t b,
                      int counter) {
  const struct hsr_image_box *p = &network->box[a], *q = &network->box[b];
  bool before = p->y0 < q->y0 || (p->y0 <= q->y0 && p->x0 < q->x0);
  HSR_STEP(network->tally, counter, hsr_edge_subject(network->edges, a),
           hsr_edge_subject(network->edges, b), HSR_NOWHERE, before);
  return before;
}

/* Merges two runs, [begin, middle) and [middle, end), into `to`. */
static void merge(const struct hsr_network *network, const uint32_t *from,
                  uint32_t begin, uint32_t middle, uint32_t end, uint32_t *to,
                  int counter) {
  uint32_t left = begin, right = middle;
  for (uint32_t k = begin; k < end; k++) {
    bool is_left =
        left < middle &&
        (right >= end || !is_before(network, from[right], from[left], counter));
    to[k] = is_left ? from[left++] : from[right++];
  }
}

/* Merge sort of contour[] from n_unknown on. */
static void sort(struct hsr_network *network, uint32_t *spare, int counter) {
  uint32_t n = network->n_contour, *from = network->contour, *to = spare;
  for (uint32_t run = 1; run < n; run *= 2) {
    for (uint32_t k = network->n_unknown; k < n; k += 2 * run) {
      uint32_t middle = k + run < n ? k + run : n;
      uint32_t end = middle + run < n ? middle + run : n;
      merge(network, from, k, middle, end, to, counter);
    }
    uint32_t *swap = from;
    from = to;
    to = swap;
  }
  memmove(network->contour + network->n_unknown, from + network->n_unknown,
          (n - network->n_unknown) * sizeof *from);
}

enum hsr_status hsr_network_sort_boxes(struct hsr_network *network,
                                       int counter) {
  struct hsr_arena *arena = network->job->scratch;
  uint32_t n = network->n_contour, *spare = HSR_NEW(arena, uint32_t, n);
  network->reach = HSR_NEW(arena, double, n);
  if (!spare || !network->reach)
    return HSR_E_NOMEM;
  network->n_unknown = 0;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t e = network->contour[k];
    if (is_known(network, e))
      continue;
    network->contour[k] = network->contour[network->n_unknown];
    network->contour[network->n_unknown++] = e;
  }
  sort(network, spare, counter);
  double reach = -INFINITY;
  for (uint32_t k = network->n_unknown; k < n; k++) {
    reach = fmax(reach, network->box[network->contour[k]].y1);
    network->reach[k] = reach;
  }
  return HSR_OK;
}

/* The first k from n_unknown on of which, with `lower`, the box begins below y;
 * or else of which reach[] is at y or below. */
static uint32_t search(const struct hsr_network *network, uint32_t e, double y,
                       bool lower, int counter) {
  uint32_t begin = network->n_unknown, end = network->n_contour;
  while (begin < end) {
    uint32_t middle = begin + (end - begin) / 2, c = network->contour[middle];
    bool is_there =
        lower ? network->box[c].y0 > y : network->reach[middle] >= y;
    HSR_STEP(network->tally, counter, hsr_edge_subject(network->edges, e),
             hsr_edge_subject(network->edges, c), HSR_NOWHERE, is_there);
    if (is_there)
      end = middle;
    else
      begin = middle + 1;
  }
  return begin;
}

void hsr_network_find_boxes(const struct hsr_network *network, uint32_t e,
                            int counter, uint32_t *begin, uint32_t *end) {
  const struct hsr_image_box *box = &network->box[e];
  *begin = search(network, e, box->y0, false, counter);
  *end = search(network, e, box->y1, true, counter);
}

bool hsr_network_is_near(const struct hsr_network *network, uint32_t e,
                         uint32_t c, int counter) {
  bool near = hsr_boxes_overlap(&network->box[e], &network->box[c]);
  HSR_STEP(network->tally, counter, hsr_edge_subject(network->edges, e),
           hsr_edge_subject(network->edges, c), HSR_NOWHERE, near);
  return near;
}
