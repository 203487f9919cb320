/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pixels that splats are put into. */
#include "algorithms/engines/splats/splats.h"
#include "common/answers/kinds/composited.h"

#include <string.h>

enum { OPACITY = HSR_SPLAT_OPACITY };

enum hsr_status hsr_splats_open(struct hsr_splats *s,
                                const struct hsr_splat_tile *tile,
                                struct hsr_splat_picture *picture) {
  const struct hsr_window *w = &tile->window;
  struct hsr_arena *arena = s->job->scratch;
  size_t stride = (size_t)(w->x1 - w->x0) + HSR_SPLAT_LANES,
         count = stride * (size_t)(w->y1 - w->y0 + HSR_SPLAT_SPARE);
  bool is_sum = s->splatting.model == HSR_XRAY,
       has_weight = s->splatting.normalise;
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

static void fold_pixel(uint16_t sum[4], uint64_t *sum_weight, uint16_t E[4],
                       uint64_t *weight) {
  uint32_t opacity = sum[OPACITY];
  for (int c = 0; c <= OPACITY; c++)
    E[c] = (uint16_t)(sum[c] + (E[c] * (65536 - opacity) >> 16));
  memset(sum, 0, 4 * sizeof *sum);
  if (!weight)
    return;
  uint64_t most = *sum_weight < UINT16_MAX ? *sum_weight : UINT16_MAX;
  *weight = most + (*weight * (65536 - opacity) >> 16);
  *sum_weight = 0;
}

void hsr_splats_fold(struct hsr_splats *s, struct hsr_splat_picture *sums,
                     const struct hsr_window *where,
                     struct hsr_splat_picture *picture) {
  for (int j = where->y0; j < where->y1; j++)
    for (int i = where->x0; i < where->x1; i++) {
      size_t from = hsr_splats_at(sums, i, j),
             to = hsr_splats_at(picture, i, j);
      uint64_t none = 0;
      if (!memcmp(sums->rgba[from], &none, sizeof none) &&
          !(sums->weight && sums->weight[from]))
        continue;
      HSR_STEP(s->tally, HSR_SPLAT_FOLDS, HSR_NOTHING, HSR_THE_WINDOW,
               HSR_AT(i, j), 0);
      fold_pixel(sums->rgba[from], sums->weight ? &sums->weight[from] : NULL,
                 picture->rgba[to],
                 picture->weight ? &picture->weight[to] : NULL);
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
