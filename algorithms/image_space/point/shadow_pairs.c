/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/image_space/point/shadow_pairs.h"

#include <math.h>
#include <string.h>

/* The boxes of all blockers on all sides. */
static void project_blockers(struct hsr_shadow_pairs *p) {
  const struct hsr_lighting *lighting = &p->shadow.lighting;
  size_t sides = (size_t)hsr_light_sides(lighting);
  for (uint32_t k = 0; k < p->shadow.n_blockers; k++)
    for (size_t s = 0; s < sides; s++)
      p->seen[k * sides + s] = hsr_light_sees(
          lighting, p->shadow.blocker[k], (int)s, 0, &p->box[k * sides + s]);
}

enum hsr_status hsr_shadow_pairs_begin(struct hsr_shadow_pairs *pairs,
                                       const struct hsr_job *job,
                                       const struct hsr_screen *screen) {
  struct hsr_arena *arena = job->scratch;
  uint32_t n_faces = job->world->n_faces;
  *pairs = (struct hsr_shadow_pairs){0};
  if (hsr_shadow_begin(&pairs->shadow, job, screen))
    return HSR_E_NOMEM;
  size_t n = (size_t)pairs->shadow.n_blockers *
             (size_t)hsr_light_sides(&pairs->shadow.lighting);
  pairs->box = HSR_NEW(arena, struct hsr_light_box, n);
  pairs->seen = HSR_NEW(arena, bool, n);
  pairs->casters = HSR_NEW(arena, struct hsr_casters, n_faces);
  pairs->found = HSR_NEW(arena, uint32_t, pairs->shadow.n_blockers);
  if (!pairs->box || !pairs->seen || !pairs->casters || !pairs->found)
    return HSR_E_NOMEM;
  for (uint32_t f = 0; f < n_faces; f++)
    pairs->casters[f] = (struct hsr_casters){NULL, HSR_NO_ID};
  project_blockers(pairs);
  return HSR_OK;
}

static bool overlap(const struct hsr_light_box *a,
                    const struct hsr_light_box *b) {
  return a->low[0] <= b->high[0] && b->low[0] <= a->high[0] &&
         a->low[1] <= b->high[1] && b->low[1] <= a->high[1];
}

/* The part of f that may be seen, as the light sees it on each side. */
struct receiver {
  struct hsr_light_box box[HSR_LIGHT_SIDES];
  bool seen[HSR_LIGHT_SIDES];
};

static bool is_pair(const struct hsr_shadow_pairs *p,
                    const struct receiver *receiver, uint32_t k, uint32_t f) {
  const struct hsr_shadow *shadow = &p->shadow;
  size_t sides = (size_t)hsr_light_sides(&shadow->lighting);
  for (size_t s = 0; s < sides; s++)
    if (receiver->seen[s] && p->seen[k * sides + s] &&
        overlap(&receiver->box[s], &p->box[k * sides + s]))
      return hsr_may_shade(&shadow->lighting, shadow->blocker[k], f,
                           shadow->job->tally);
  return false;
}

/* Makes the list of a face that is seen for the first time. */
static enum hsr_status find_casters(struct hsr_shadow_pairs *p, uint32_t f) {
  const struct hsr_shadow *shadow = &p->shadow;
  struct hsr_tally *tally = shadow->job->tally;
  struct hsr_casters *casters = &p->casters[f];
  struct receiver receiver;
  double reach = hsr_off_hull(&shadow->lighting, f);
  uint32_t n = 0;
  for (int s = 0; s < hsr_light_sides(&shadow->lighting); s++)
    receiver.seen[s] =
        hsr_light_sees(&shadow->lighting, f, s, reach, &receiver.box[s]);
  for (uint32_t k = 0; k < shadow->n_blockers; k++) {
    bool pair = is_pair(p, &receiver, k, f);
    HSR_STEP(tally, HSR_PAIR_TESTS, HSR_FACE(shadow->blocker[k]), HSR_FACE(f),
             HSR_NOWHERE, pair);
    if (pair)
      p->found[n++] = k;
  }
  casters->n = n;
  casters->blocker = HSR_NEW(shadow->job->scratch, uint32_t, n + 1);
  if (!casters->blocker)
    return HSR_E_NOMEM;
  memcpy(casters->blocker, p->found, n * sizeof *p->found);
  return HSR_OK;
}

/* --- Segments ------------------------------------------------------------- */

/* The image of a segment of a row on one face, which is straight, lies between
 * those of its ends. -1: they are on two sides, or cannot be told. */
static int image_of_segment(const struct hsr_shadow_pairs *p, uint32_t f,
                            int x0, int x1, int j, struct hsr_light_box *box) {
  const struct hsr_lighting *lighting = &p->shadow.lighting;
  struct hsr_lit_point left, right;
  struct hsr_light_box end;
  hsr_lit_point_find(lighting, f, x0, j, &left);
  hsr_lit_point_find(lighting, f, x1 - 1, j, &right);
  int side = hsr_light_image(lighting, &left, box);
  if (hsr_light_image(lighting, &right, &end) != side)
    return -1;
  for (int c = 0; c < 2; c++) {
    box->low[c] = fmin(box->low[c], end.low[c]);
    box->high[c] = fmax(box->high[c], end.high[c]);
  }
  return side;
}

/* Of the faces that may shade f, those that may shade the segment: found[]. */
static uint32_t find_active(struct hsr_shadow_pairs *p, uint32_t f, int x0,
                            int x1, int j) {
  const struct hsr_shadow *shadow = &p->shadow;
  const struct hsr_casters *casters = &p->casters[f];
  struct hsr_tally *tally = shadow->job->tally;
  struct hsr_light_box segment;
  int sides = hsr_light_sides(&shadow->lighting);
  int s = image_of_segment(p, f, x0, x1, j, &segment);
  uint32_t n = 0;
  for (uint32_t k = 0; k < casters->n; k++) {
    size_t b = casters->blocker[k], at = b * (size_t)sides + (size_t)s;
    bool active = s < 0 || (p->seen[at] && overlap(&segment, &p->box[at]));
    HSR_STEP(tally, HSR_SEGMENT_TESTS, HSR_FACE(shadow->blocker[b]),
             HSR_FACE(f), HSR_ON(x0, x1, j), active);
    if (active)
      p->found[n++] = shadow->blocker[b];
  }
  return n;
}

/* Whether none of the n faces found blocks the light from the sample. */
static bool is_lit(struct hsr_shadow_pairs *p, uint32_t f, uint32_t n, int i,
                   int j) {
  struct hsr_lit_point point;
  if (!n)
    return true;
  hsr_lit_point_find(&p->shadow.lighting, f, i, j, &point);
  uint32_t k = hsr_shadow_test(&p->shadow, &point, i, j, p->found, n);
  if (k == n)
    return true;
  uint32_t blocker = p->found[k];
  p->found[k] = p->found[0];
  p->found[0] = blocker;
  return false;
}

enum hsr_status hsr_shadow_pairs_show(struct hsr_shadow_pairs *pairs,
                                      uint32_t f, int x0, int x1, int j) {
  if (f == HSR_BACKGROUND ||
      !hsr_shadow_faces(&pairs->shadow, f, HSR_ON(x0, x1, j)))
    return HSR_OK;
  if (pairs->casters[f].n == HSR_NO_ID && find_casters(pairs, f))
    return HSR_E_NOMEM;
  uint32_t n = find_active(pairs, f, x0, x1, j);
  for (int i = x0, end; i < x1; i = end + 1) {
    for (end = i; end < x1 && is_lit(pairs, f, n, end, j);)
      end++;
    if (i < end)
      hsr_shadow_lit(&pairs->shadow, f, i, end, j);
  }
  return HSR_OK;
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"shadow pairs",
     "faces compared with a visible one, as the light sees both", HSR_COMPARE,
     HSR_OF_FACE, HSR_OF_FACE, "no pair|a pair"},
    {"segment tests",
     "faces of pairs compared with a visible segment, as the light sees "
     "both",
     HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "apart|overlapping"},
    {NULL}};

static const struct hsr_line lines[] = {
    {"", .part = &hsr_shadow_part, .group = HSR_SHADOW_FACING_LINES},
    {"  when it is first seen: which faces overlap it about the light?",
     HSR_RAISES(HSR_PAIR_TESTS)},
    {"  which of these overlap the visible segment?",
     HSR_RAISES(HSR_SEGMENT_TESTS)},
    {"  for each sample of the segment, and each of these faces"},
    {"    ", .part = &hsr_shadow_part, .group = HSR_SHADOW_LINES},
    {NULL}};

const struct hsr_part hsr_shadow_pairs_part = {
    HSR_PART_SHADOW_PAIRS, counters, NULL, NULL, {lines}};
