/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Channels of pixels, over and under others. Sixteen pixels at once. */
#include "algorithms/volume/splats/splats.h"
#include "common/base/vector.h"

#include <string.h>

enum { LANES = HSR_SPLAT_LANES, OPACITY = HSR_SPLAT_OPACITY };

enum hsr_status hsr_splats_open(struct hsr_splats *s,
                                struct hsr_splat_picture *picture) {
  const struct hsr_window *w = &s->window;
  size_t height = (size_t)(w->y1 - w->y0);
  picture->stride = (size_t)(w->x1 - w->x0) + LANES;
  picture->weight = NULL;
  for (int c = 0; c < s->channels; c++) {
    picture->plane[c] =
        HSR_NEW_ZEROED(s->job->scratch, uint16_t, height * picture->stride);
    if (!picture->plane[c])
      return HSR_E_NOMEM;
  }
  if (s->splatting.normalise)
    picture->weight =
        HSR_NEW_ZEROED(s->job->scratch, uint64_t, height * picture->stride);
  return s->splatting.normalise && !picture->weight ? HSR_E_NOMEM : HSR_OK;
}

void hsr_splats_clear(const struct hsr_splats *s,
                      struct hsr_splat_picture *picture) {
  size_t count = (size_t)(s->window.y1 - s->window.y0) * picture->stride;
  for (int c = 0; c < s->channels; c++)
    memset(picture->plane[c], 0, count * sizeof *picture->plane[c]);
  if (picture->weight)
    memset(picture->weight, 0, count * sizeof *picture->weight);
}

/* Where pixel (x, j) is in a plane. */
static size_t place_of(const struct hsr_splats *s,
                       const struct hsr_splat_picture *picture, int x, int j) {
  return (size_t)(j - s->window.y0) * picture->stride +
         (size_t)(x - s->window.x0);
}

HSR_VECTOR
void hsr_splats_give(const struct hsr_splats *s, const struct hsr_placed *p,
                     const uint16_t weight[LANES], hsr_splat_lanes D) {
  for (int c = 0; c <= OPACITY; c++)
    for (int l = 0; l < LANES; l++)
      D[c][l] = (uint16_t)((uint32_t)weight[l] * p->colour[c] >> 16);
  if (s->channels == HSR_SPLAT_CHANNELS)
    for (int l = 0; l < LANES; l++)
      D[HSR_SPLAT_WEIGHT][l] =
          (uint16_t)((uint64_t)weight[l] * p->energy >> 16);
}

/* a + b - ceil(a b / 65536), which is a + floor(b (65536 - a) / 65536). */
static inline uint16_t joined(uint16_t a, uint16_t b, uint16_t by) {
  uint32_t product = (uint32_t)b * by;
  uint16_t high = (uint16_t)(product >> 16), low = (uint16_t)product;
  return (uint16_t)(a + b - high - (low != 0));
}

HSR_VECTOR
static void put_over(uint16_t *const plane[HSR_SPLAT_CHANNELS], size_t at,
                     hsr_splat_lanes D) {
  const uint16_t *opacity = D[OPACITY];
  for (int c = 0; c <= OPACITY; c++)
    for (int l = 0; l < LANES; l++)
      plane[c][at + (size_t)l] =
          joined(D[c][l], plane[c][at + (size_t)l], opacity[l]);
}

HSR_VECTOR
static void put_under(uint16_t *const plane[HSR_SPLAT_CHANNELS], size_t at,
                      const uint16_t opacity[LANES], hsr_splat_lanes D) {
  for (int c = 0; c <= OPACITY; c++)
    for (int l = 0; l < LANES; l++)
      plane[c][at + (size_t)l] =
          joined(plane[c][at + (size_t)l], D[c][l], opacity[l]);
}

void hsr_splats_over(const struct hsr_splats *s,
                     struct hsr_splat_picture *picture, int x, int j,
                     hsr_splat_lanes D) {
  size_t at = place_of(s, picture, x, j);
  put_over(picture->plane, at, D);
  for (size_t l = 0; picture->weight && l < LANES; l++) {
    uint64_t *weight = &picture->weight[at + l];
    *weight =
        D[HSR_SPLAT_WEIGHT][l] + (*weight * (65536u - D[OPACITY][l]) >> 16);
  }
}

void hsr_splats_under(const struct hsr_splats *s,
                      struct hsr_splat_picture *picture, int x, int j,
                      hsr_splat_lanes D) {
  size_t at = place_of(s, picture, x, j);
  uint16_t opacity[LANES];
  memcpy(opacity, picture->plane[OPACITY] + at, sizeof opacity);
  put_under(picture->plane, at, opacity, D);
  for (size_t l = 0; picture->weight && l < LANES; l++)
    picture->weight[at + l] +=
        (uint64_t)D[HSR_SPLAT_WEIGHT][l] * (65536u - opacity[l]) >> 16;
}

HSR_VECTOR
static void add_up(int channels, uint16_t *const plane[HSR_SPLAT_CHANNELS],
                   size_t at, hsr_splat_lanes D) {
  for (int c = 0; c < channels; c++)
    for (int l = 0; l < LANES; l++) {
      uint16_t *E = plane[c] + at, sum = (uint16_t)(E[l] + D[c][l]);
      E[l] = sum < D[c][l] ? UINT16_MAX : sum;
    }
}

void hsr_splats_add(const struct hsr_splats *s,
                    struct hsr_splat_picture *picture, int x, int j,
                    hsr_splat_lanes D) {
  add_up(s->channels, picture->plane, place_of(s, picture, x, j), D);
}

void hsr_splats_fold(struct hsr_splats *s, struct hsr_splat_picture *sums,
                     const struct hsr_window *where,
                     struct hsr_splat_picture *picture) {
  hsr_splat_lanes D;
  for (int j = where->y0; j < where->y1; j++)
    for (int x = where->x0; x < where->x1; x += LANES) {
      size_t at = place_of(s, sums, x, j);
      for (int c = 0; c < s->channels; c++) {
        memcpy(D[c], sums->plane[c] + at, sizeof D[c]);
        memset(sums->plane[c] + at, 0, sizeof D[c]);
      }
      for (int l = 0; HSR_COUNTING && l < LANES; l++)
        if (D[OPACITY][l])
          HSR_STEP(s->tally, HSR_SPLAT_FOLDS, HSR_NOTHING, HSR_THE_WINDOW,
                   HSR_AT(x + l, j), 0);
      hsr_splats_over(s, picture, x, j, D);
    }
}

void hsr_splats_count(struct hsr_splats *s, const struct hsr_placed *p, int x,
                      int j, const uint16_t weight[LANES]) {
  for (int l = 0; HSR_COUNTING && l < LANES; l++)
    if (weight[l]) {
      HSR_STEP(s->tally, HSR_SPLAT_UPDATES, HSR_CELL(p->cell, 0, 0),
               HSR_THE_WINDOW, HSR_AT(x + l, j), 0);
      HSR_TOUCH(s->tally, x + l, j);
    }
}

void hsr_splats_write(struct hsr_splats *s, int i, int j,
                      const uint64_t E[HSR_SPLAT_CHANNELS]) {
  uint16_t *rgba = hsr_answer_rgba_of(s->job->answer) +
                   4 * ((size_t)j * (size_t)s->view->m + (size_t)i);
  bool any = false;
  for (int c = 0; c <= OPACITY; c++) {
    uint64_t value = E[c];
    if (s->splatting.normalise)
      value = E[HSR_SPLAT_WEIGHT] ? 65536 * value / E[HSR_SPLAT_WEIGHT] : 0;
    rgba[c] = (uint16_t)(value < 65535 ? value : 65535);
    any |= rgba[c] > 0;
  }
  if (any)
    HSR_ACCEPTED(s->tally, HSR_SPLAT_WRITES, HSR_NOTHING, HSR_THE_WINDOW,
                 HSR_AT(i, j), rgba);
}

void hsr_splats_finish(struct hsr_splats *s,
                       const struct hsr_splat_picture *picture) {
  const struct hsr_window *w = &s->window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      uint64_t E[HSR_SPLAT_CHANNELS] = {0};
      size_t at = place_of(s, picture, i, j);
      for (int c = 0; c <= OPACITY; c++)
        E[c] = picture->plane[c][at];
      if (picture->weight)
        E[HSR_SPLAT_WEIGHT] = picture->weight[at];
      hsr_splats_write(s, i, j, E);
    }
}
