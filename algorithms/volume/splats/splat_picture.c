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
  for (int c = 0; c < s->channels; c++) {
    picture->plane[c] =
        HSR_NEW_ZEROED(s->job->scratch, uint16_t, height * picture->stride);
    if (!picture->plane[c])
      return HSR_E_NOMEM;
  }
  return HSR_OK;
}

void hsr_splats_clear(const struct hsr_splats *s,
                      struct hsr_splat_picture *picture) {
  size_t count = (size_t)(s->window.y1 - s->window.y0) * picture->stride;
  for (int c = 0; c < s->channels; c++)
    memset(picture->plane[c], 0, count * sizeof *picture->plane[c]);
}

/* The channels of the pixels from x on in row j. */
static void find_row(const struct hsr_splats *s,
                     const struct hsr_splat_picture *picture, int x, int j,
                     uint16_t *E[HSR_SPLAT_CHANNELS]) {
  size_t at =
      (size_t)(j - s->window.y0) * picture->stride + (size_t)(x - s->window.x0);
  for (int c = 0; c < s->channels; c++)
    E[c] = picture->plane[c] + at;
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
static void put_over(int channels, uint16_t *E[HSR_SPLAT_CHANNELS],
                     hsr_splat_lanes D) {
  const uint16_t *opacity = D[OPACITY];
  for (int c = 0; c < channels; c++)
    for (int l = 0; l < LANES; l++)
      E[c][l] = joined(D[c][l], E[c][l], opacity[l]);
}

HSR_VECTOR
static void put_under(int channels, uint16_t *E[HSR_SPLAT_CHANNELS],
                      hsr_splat_lanes D) {
  uint16_t opacity[LANES];
  for (int l = 0; l < LANES; l++)
    opacity[l] = E[OPACITY][l];
  for (int c = 0; c < channels; c++)
    for (int l = 0; l < LANES; l++)
      E[c][l] = joined(E[c][l], D[c][l], opacity[l]);
}

void hsr_splats_over(const struct hsr_splats *s,
                     struct hsr_splat_picture *picture, int x, int j,
                     hsr_splat_lanes D) {
  uint16_t *E[HSR_SPLAT_CHANNELS];
  find_row(s, picture, x, j, E);
  put_over(s->channels, E, D);
}

void hsr_splats_under(const struct hsr_splats *s,
                      struct hsr_splat_picture *picture, int x, int j,
                      hsr_splat_lanes D) {
  uint16_t *E[HSR_SPLAT_CHANNELS];
  find_row(s, picture, x, j, E);
  put_under(s->channels, E, D);
}

HSR_VECTOR
static void add_up(int channels, uint16_t *E[HSR_SPLAT_CHANNELS],
                   hsr_splat_lanes D) {
  for (int c = 0; c < channels; c++)
    for (int l = 0; l < LANES; l++) {
      uint16_t sum = (uint16_t)(E[c][l] + D[c][l]);
      E[c][l] = sum < D[c][l] ? UINT16_MAX : sum;
    }
}

void hsr_splats_add(const struct hsr_splats *s,
                    struct hsr_splat_picture *picture, int x, int j,
                    hsr_splat_lanes D) {
  uint16_t *E[HSR_SPLAT_CHANNELS];
  find_row(s, picture, x, j, E);
  add_up(s->channels, E, D);
}

void hsr_splats_fold(struct hsr_splats *s, struct hsr_splat_picture *sums,
                     const struct hsr_window *where,
                     struct hsr_splat_picture *picture) {
  uint16_t *E[HSR_SPLAT_CHANNELS];
  hsr_splat_lanes D;
  for (int j = where->y0; j < where->y1; j++)
    for (int x = where->x0; x < where->x1; x += LANES) {
      find_row(s, sums, x, j, E);
      for (int c = 0; c < s->channels; c++) {
        memcpy(D[c], E[c], sizeof D[c]);
        memset(E[c], 0, sizeof D[c]);
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
      uint16_t *row[HSR_SPLAT_CHANNELS];
      uint64_t E[HSR_SPLAT_CHANNELS];
      find_row(s, picture, i, j, row);
      for (int c = 0; c < s->channels; c++)
        E[c] = *row[c];
      hsr_splats_write(s, i, j, E);
    }
}
