/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An X-ray picture: all splats are added, in any order.
 *
 * Source      J. E. Swan II, PhD thesis, Ohio State University, 1998, 1.1: a
 *             projection that is a plain sum is both faster and more exact by
 *             splatting than by casting rays.
 * Sums        of 32 bits, which are moved into sums of 64 bits before they can
 *             overflow
 *
 * Notation, invariant, ties, departures and cost are those of splats.h. */
#include "algorithms/volume/splats/splats.h"
#include "common/base/vector.h"

enum { LANES = HSR_SPLAT_LANES, MOST_SPLATS = 65536 };

static const struct hsr_counter counters[] = {HSR_SPLAT_COUNTERS, {NULL}};

struct model {
  uint32_t *sum[HSR_SPLAT_CHANNELS]; /* since the last move */
  uint64_t *all[HSR_SPLAT_CHANNELS];
  size_t stride, count;
  int drawn; /* since the last move */
};

static enum hsr_status open_sums(struct hsr_splats *s, struct model *m) {
  const struct hsr_window *w = &s->window;
  m->stride = (size_t)(w->x1 - w->x0) + LANES;
  m->count = m->stride * (size_t)(w->y1 - w->y0);
  for (int c = 0; c < s->channels; c++) {
    m->sum[c] = HSR_NEW_ZEROED(s->job->scratch, uint32_t, m->count);
    m->all[c] = HSR_NEW_ZEROED(s->job->scratch, uint64_t, m->count);
    if (!m->sum[c] || !m->all[c])
      return HSR_E_NOMEM;
  }
  return HSR_OK;
}

static void move_sums(struct hsr_splats *s, struct model *m) {
  for (int c = 0; c < s->channels; c++)
    for (size_t k = 0; k < m->count; k++) {
      m->all[c][k] += m->sum[c][k];
      m->sum[c][k] = 0;
    }
  m->drawn = 0;
}

HSR_VECTOR
static void add_up(int channels, uint32_t *const sum[HSR_SPLAT_CHANNELS],
                   size_t at, hsr_splat_lanes D) {
  for (int c = 0; c < channels; c++)
    for (int l = 0; l < LANES; l++)
      sum[c][at + (size_t)l] += D[c][l];
}

static void draw(struct hsr_splats *s, const struct hsr_placed *p) {
  struct model *m = s->model;
  uint16_t weight[LANES];
  hsr_splat_lanes D;
  HSR_STEP(s->tally, HSR_SPLAT_SPLATS, HSR_CELL(p->cell, 0, 0), HSR_THE_WINDOW,
           p->box, 2);
  for (int j = p->box.y0; j < p->box.y1; j++)
    for (int x = p->box.x0; x < p->box.x1; x += LANES) {
      hsr_splats_weigh(s, p, x, j, weight);
      hsr_splats_count(s, p, x, j, weight);
      hsr_splats_give(s, p, weight, D);
      add_up(s->channels, m->sum,
             (size_t)(j - s->window.y0) * m->stride +
                 (size_t)(x - s->window.x0),
             D);
    }
  if (++m->drawn == MOST_SPLATS)
    move_sums(s, m);
}

/* min(65535, sum exposure / 65536), rounded down. */
static uint64_t exposed(uint64_t sum, uint64_t exposure) {
  bool is_most = exposure && sum > UINT64_MAX / exposure;
  return is_most ? UINT16_MAX : sum * exposure >> 16;
}

static void finish(struct hsr_splats *s, struct model *m) {
  const struct hsr_window *w = &s->window;
  move_sums(s, m);
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      uint64_t E[HSR_SPLAT_CHANNELS];
      for (int c = 0; c < s->channels; c++) {
        E[c] = m->all[c][(size_t)(j - w->y0) * m->stride + (size_t)(i - w->x0)];
        if (!s->splatting.normalise)
          E[c] = exposed(E[c], s->splatting.exposure);
      }
      hsr_splats_write(s, i, j, E);
    }
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_splats s;
  struct model m = {.drawn = 0};
  if (hsr_splats_begin(&s, job) || open_sums(&s, &m))
    return hsr_fail_nomem(err);
  s.model = &m;
  s.draw = draw;
  enum hsr_status status = hsr_splats_visit(&s, HSR_PBTF, false, err);
  finish(&s, &m);
  return status;
}

static const struct hsr_line outline[] = {
    {"for each sample that is kept", HSR_RAISES(HSR_SPLAT_CELLS)},
    {"  find its footprint; is it out of sight? leave it",
     HSR_RAISES(HSR_SPLAT_SPLATS)},
    {"  for each pixel of the footprint, add weight times colour",
     HSR_RAISES(HSR_SPLAT_UPDATES)},
    {"write the pixels that are not empty", HSR_RAISES(HSR_SPLAT_WRITES)},
    {NULL, 0}};

const struct hsr_algorithm HSR_ALGORITHM(splat_xray) = {
    HSR_OF_SPLATS,
    .name = "splat-xray",
    .title = "Splatting of an X-ray picture",
    .authors = "L. Westover; J. E. Swan II",
    .year = 1990,
    .source = "Westover, Footprint Evaluation for Volume Rendering, SIGGRAPH "
              "1990; Swan, Object-Order Rendering of Discrete Objects, PhD "
              "thesis, Ohio State University, 1998",
    .makes = 1 << HSR_XRAY,
    .counters = counters,
    .outline = outline,
    .render = render};
