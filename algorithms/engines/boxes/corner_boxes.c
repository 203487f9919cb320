/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes of images sorted by their upper left corners: see corner_boxes.h. */
#include "algorithms/engines/boxes/corner_boxes.h"

#include <math.h>
#include <string.h>

static bool is_known(const struct hsr_image_box *box) {
  return box->x0 > -INFINITY;
}

/* --- The sort ------------------------------------------------------------- */

/* Whether the corner of a comes before that of b. */
static bool is_before(const struct hsr_corner_boxes *s, uint32_t a,
                      uint32_t b) {
  const struct hsr_image_box *p = &s->box[a], *q = &s->box[b];
  bool before = p->y0 < q->y0 || (p->y0 <= q->y0 && p->x0 < q->x0);
  HSR_STEP(s->tally, s->sort, s->subject(s->context, a),
           s->subject(s->context, b), HSR_NOWHERE, before);
  return before;
}

/* Merges two runs, [begin, middle) and [middle, end), into `to`. */
static void merge(const struct hsr_corner_boxes *s, const uint32_t *from,
                  uint32_t begin, uint32_t middle, uint32_t end, uint32_t *to) {
  uint32_t left = begin, right = middle;
  for (uint32_t k = begin; k < end; k++) {
    bool is_left = left < middle &&
                   (right >= end || !is_before(s, from[right], from[left]));
    to[k] = is_left ? from[left++] : from[right++];
  }
}

/* Merge sort of item[] from n_unknown on. */
static void sort(struct hsr_corner_boxes *s, uint32_t *spare) {
  uint32_t n = s->n, *from = s->item, *to = spare;
  for (uint32_t run = 1; run < n; run *= 2) {
    for (uint32_t k = s->n_unknown; k < n; k += 2 * run) {
      uint32_t middle = k + run < n ? k + run : n;
      uint32_t end = middle + run < n ? middle + run : n;
      merge(s, from, k, middle, end, to);
    }
    uint32_t *swap = from;
    from = to;
    to = swap;
  }
  memmove(s->item + s->n_unknown, from + s->n_unknown,
          (n - s->n_unknown) * sizeof *from);
}

enum hsr_status hsr_corner_boxes_sort(struct hsr_corner_boxes *s,
                                      struct hsr_arena *arena) {
  s->near = HSR_NEW(arena, uint32_t, s->n);
  s->reach = HSR_NEW(arena, double, s->n);
  if (!s->near || !s->reach)
    return HSR_E_NOMEM;
  s->n_unknown = 0;
  for (uint32_t k = 0; k < s->n; k++) {
    uint32_t item = s->item[k];
    if (is_known(&s->box[item]))
      continue;
    s->item[k] = s->item[s->n_unknown];
    s->item[s->n_unknown++] = item;
  }
  sort(s, s->near);
  double reach = -INFINITY;
  for (uint32_t k = s->n_unknown; k < s->n; k++) {
    reach = fmax(reach, s->box[s->item[k]].y1);
    s->reach[k] = reach;
  }
  return HSR_OK;
}

/* --- What is near --------------------------------------------------------- */

/* The first k from n_unknown on of which, with `lower`, the box begins below y;
 * or else of which reach[] is at y or below. */
static uint32_t search(const struct hsr_corner_boxes *s, double y, bool lower,
                       struct hsr_subject of) {
  uint32_t begin = s->n_unknown, end = s->n;
  (void)of; /* for the trace */
  while (begin < end) {
    uint32_t middle = begin + (end - begin) / 2, c = s->item[middle];
    bool is_there = lower ? s->box[c].y0 > y : s->reach[middle] >= y;
    HSR_STEP(s->tally, s->search, of, s->subject(s->context, c), HSR_NOWHERE,
             is_there);
    if (is_there)
      end = middle;
    else
      begin = middle + 1;
  }
  return begin;
}

uint32_t hsr_corner_boxes_find(const struct hsr_corner_boxes *s,
                               const struct hsr_image_box *box,
                               struct hsr_subject of) {
  uint32_t begin = search(s, box->y0, false, of);
  uint32_t end = search(s, box->y1, true, of);
  uint32_t n = 0;
  for (uint32_t k = 0; k < s->n_unknown; k++)
    s->near[n++] = s->item[k];
  for (uint32_t k = begin; k < end; k++) {
    uint32_t c = s->item[k];
    bool near = hsr_boxes_overlap(box, &s->box[c]);
    HSR_STEP(s->tally, s->search, of, s->subject(s->context, c), HSR_NOWHERE,
             near);
    if (near)
      s->near[n++] = c;
  }
  return n;
}

/* --- Words ---------------------------------------------------------------- */

const struct hsr_word hsr_box_sortings[] = {
    [HSR_NOT_SORTED] = {"none", "not: an edge is compared with all of them", 0},
    [HSR_BY_CORNER] = {"corner",
                       "by their boxes' upper left corners: an edge is put "
                       "to those that may be near it",
                       0},
    {NULL}};

const struct hsr_word hsr_edge_sortings[] = {
    [HSR_NOT_SORTED] = {"none", "not: an edge is compared with all of them", 0},
    [HSR_BY_CORNER] = {"corner",
                       "by their boxes' upper left corners: an edge is put "
                       "to those that may be near it",
                       0},
    [HSR_IN_GROUPS] =
        {"groups",
         "not, but in groups of 64 neighbors, which are mostly of "
         "one object: an edge is put to those of groups that are "
         "near it",
         0},
    {NULL}};
