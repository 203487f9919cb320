/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pixels that splats are put into. */
#include "algorithms/engines/splats/splats.h"
#include "common/answers/kinds/composited.h"

#include <string.h>

enum { OPACITY = HSR_SPLAT_OPACITY };

static enum hsr_status open(struct hsr_splats *s,
                            const struct hsr_splat_tile *tile,
                            struct hsr_splat_picture *picture, bool is_sum,
                            bool has_weight) {
  const struct hsr_window *w = &tile->window;
  struct hsr_arena *arena = s->job->scratch;
  size_t stride = (size_t)(w->x1 - w->x0) + HSR_SPLAT_LANES,
         count = stride * (size_t)(w->y1 - w->y0 + HSR_SPLAT_SPARE);
  *picture =
      (struct hsr_splat_picture){.window = w, .stride = stride, .count = count};
  if (is_sum)
    picture->sum = hsr_arena_array(arena, count, sizeof *picture->sum);
  else
    picture->rgba = hsr_arena_array(arena, count, sizeof *picture->rgba);
  if (has_weight)
    picture->weight = HSR_NEW(arena, uint64_t, count);
  if (!(is_sum ? (void *)picture->sum : (void *)picture->rgba) ||
      (has_weight && !picture->weight))
    return HSR_E_NOMEM;
  hsr_splats_clear(picture);
  return HSR_OK;
}

enum hsr_status hsr_splats_open(struct hsr_splats *s,
                                const struct hsr_splat_tile *tile,
                                struct hsr_splat_picture *picture) {
  return open(s, tile, picture, false, s->splatting.normalise);
}

enum hsr_status hsr_splats_open_sums(struct hsr_splats *s,
                                     const struct hsr_splat_tile *tile,
                                     struct hsr_splat_picture *picture) {
  bool per_length = s->splatting.per_length;
  return open(s, tile, picture, per_length || s->splatting.model == HSR_XRAY,
              per_length || s->splatting.normalise);
}

void hsr_splats_clear(struct hsr_splat_picture *picture) {
  size_t count = picture->count;
  if (picture->rgba)
    memset(picture->rgba, 0, count * sizeof *picture->rgba);
  if (picture->sum)
    memset(picture->sum, 0, count * sizeof *picture->sum);
  if (picture->weight)
    memset(picture->weight, 0, count * sizeof *picture->weight);
}

/* --- Sums over the picture ------------------------------------------------ */

static bool is_empty(const struct hsr_splat_picture *sums, size_t at) {
  static const uint16_t none[4] = {0};
  bool has_weight = sums->weight && sums->weight[at];
  return !has_weight &&
         (sums->sum || !memcmp(sums->rgba[at], none, sizeof none));
}

/* What the sums of a pixel give, which then are 0. With opacity=length that is
 * the mean colour, as opaque as all of them. */
static void take_mean(const struct hsr_splats *s,
                      struct hsr_splat_picture *sums, size_t at,
                      uint16_t S[4]) {
  uint32_t *sum = sums->sum[at];
  uint64_t opacity =
      (uint64_t)UINT16_MAX * hsr_splats_veil(s, sums->weight[at]) >> 16;
  for (int c = 0; c < OPACITY; c++)
    S[c] = (uint16_t)(sum[OPACITY] ? opacity * sum[c] / sum[OPACITY] : 0);
  S[OPACITY] = (uint16_t)opacity;
  memset(sum, 0, sizeof sums->sum[at]);
  sums->weight[at] = 0;
}

static uint64_t take_sum(struct hsr_splat_picture *sums, size_t at,
                         uint16_t S[4]) {
  memcpy(S, sums->rgba[at], sizeof sums->rgba[at]);
  memset(sums->rgba[at], 0, sizeof sums->rgba[at]);
  if (!sums->weight)
    return 0;
  uint64_t weight =
      sums->weight[at] < UINT16_MAX ? sums->weight[at] : UINT16_MAX;
  sums->weight[at] = 0;
  return weight;
}

void hsr_splats_put_over(struct hsr_splat_picture *picture, size_t at,
                         const uint16_t S[OPACITY + 1]) {
  uint16_t *E = picture->rgba[at];
  uint32_t left = 65536 - (uint32_t)S[OPACITY];
  for (int c = 0; c <= OPACITY; c++)
    E[c] = (uint16_t)(S[c] + (E[c] * left >> 16));
}

static void fold_pixel(struct hsr_splats *s, struct hsr_splat_picture *sums,
                       size_t from, struct hsr_splat_picture *picture,
                       size_t to) {
  uint16_t S[4];
  uint64_t weight = 0;
  if (sums->sum)
    take_mean(s, sums, from, S);
  else
    weight = take_sum(sums, from, S);
  hsr_splats_put_over(picture, to, S);
  if (picture->weight)
    picture->weight[to] =
        weight + (picture->weight[to] * (65536 - (uint64_t)S[OPACITY]) >> 16);
}

void hsr_splats_fold(struct hsr_splats *s, struct hsr_splat_picture *sums,
                     const struct hsr_window *where,
                     struct hsr_splat_picture *picture) {
  for (int j = where->y0; j < where->y1; j++)
    for (int i = where->x0; i < where->x1; i++) {
      size_t from = hsr_splats_at(sums, i, j),
             to = hsr_splats_at(picture, i, j);
      if (is_empty(sums, from))
        continue;
      HSR_STEP(s->tally, HSR_SPLAT_FOLDS, HSR_NOTHING, HSR_THE_WINDOW,
               HSR_AT(i, j), 0);
      fold_pixel(s, sums, from, picture, to);
    }
}

/* --- Answers -------------------------------------------------------------- */

void hsr_splats_write(struct hsr_splats *s, int i, int j,
                      const uint64_t E[HSR_SPLAT_CHANNELS]) {
  uint16_t *rgba = hsr_answer_rgba_of(s->job->answer) +
                   4 * ((size_t)j * (size_t)s->view->m + (size_t)i);
  bool any = false;
  for (int c = 0; c <= OPACITY; c++) {
    rgba[c] = hsr_splat_channel(&s->splatting, E[c], E[HSR_SPLAT_WEIGHT]);
    any |= rgba[c] > 0;
  }
  if (any)
    HSR_ACCEPTED(s->tally, HSR_SPLAT_WRITES, HSR_NOTHING, HSR_THE_WINDOW,
                 HSR_AT(i, j), rgba);
}

void hsr_splats_finish(struct hsr_splats *s,
                       const struct hsr_splat_picture *picture) {
  const struct hsr_window *w = picture->window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      uint64_t E[HSR_SPLAT_CHANNELS] = {0};
      size_t at = hsr_splats_at(picture, i, j);
      for (int c = 0; c <= OPACITY; c++)
        E[c] = picture->rgba[at][c];
      if (picture->weight)
        E[HSR_SPLAT_WEIGHT] = picture->weight[at];
      hsr_splats_write(s, i, j, E);
    }
}
