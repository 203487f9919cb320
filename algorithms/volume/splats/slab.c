/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slabs across the view. Notation: the model slab of
 * docs/composited-picture.md. */
#include "algorithms/volume/splats/slab.h"

#include <string.h>

enum {
  ONE = UINT16_MAX,
  EACH = ONE / (HSR_LEVELS - 1), /* from a level to the next */
  OPACITY = HSR_SPLAT_OPACITY
};

/* --- Sums ----------------------------------------------------------------- */

enum hsr_status hsr_slab_open(struct hsr_splats *s,
                              const struct hsr_splat_picture *picture,
                              struct hsr_slab *slab) {
  slab->sum =
      hsr_arena_zeroed(s->job->scratch, picture->count, sizeof *slab->sum);
  return slab->sum ? HSR_OK : HSR_E_NOMEM;
}

struct hsr_slab_sample hsr_slab_sample(const struct hsr_splats *s,
                                       const struct hsr_placed *p) {
  const struct hsr_grid *g = s->grid;
  const struct hsr_splat_light *light = &s->light[g->normal[p->cell]];
  struct hsr_slab_sample sample = {
      {[HSR_SLAB_WEIGHT] = 65536,
       [HSR_SLAB_LEVEL] = (uint32_t)EACH * g->level[p->cell],
       [HSR_SLAB_STEEP] = (uint32_t)EACH * g->steep[p->cell],
       [HSR_SLAB_SHADE] = light->shade,
       [HSR_SLAB_GLOSS] = light->gloss}};
  uint32_t rgb[OPACITY];
  hsr_splats_base(s, p->cell, rgb);
  memcpy(&sample.value[HSR_SLAB_RGB], rgb, sizeof rgb);
  for (int c = 0; c < HSR_SLAB_CHANNELS; c++)
    sample.value[c] = (uint32_t)((uint64_t)sample.value[c] * p->energy >> 16);
  return sample;
}

/* --- What the means show -------------------------------------------------- */

/* The mean of a channel, at most `most`. */
static uint32_t mean(const uint64_t sum[HSR_SLAB_CHANNELS], int channel,
                     uint32_t most) {
  uint64_t found = (sum[channel] << 16) / sum[HSR_SLAB_WEIGHT];
  return found < most ? (uint32_t)found : most;
}

/* Between two entries of a table, the share of the second of which is part /
 * EACH. */
static uint32_t between(uint32_t lower, uint32_t upper, uint32_t part) {
  return ((EACH - part) * lower + part * upper) / EACH;
}

struct entries {
  uint32_t lower, upper, part;
};

static struct entries entries_at(uint32_t level) {
  uint32_t lower = level / EACH,
           upper = lower < HSR_LEVELS - 1 ? lower + 1 : lower;
  return (struct entries){lower, upper, level % EACH};
}

/* A: of the mean density and the mean gradient. */
static uint32_t opacity_of(const struct hsr_splats *s, struct entries level,
                           struct entries steep) {
  const struct hsr_palette *p = &s->grid->palette;
  uint64_t O = between(p->opacity[level.lower], p->opacity[level.upper],
                       level.part),
           G = between(p->gradient[steep.lower], p->gradient[steep.upper],
                       steep.part);
  return (uint32_t)(O * G / ONE * s->splatting.attenuate >> 16);
}

static uint32_t colour_of(const struct hsr_splats *s,
                          const uint64_t sum[HSR_SLAB_CHANNELS], int channel,
                          struct entries level) {
  const struct hsr_palette *p = &s->grid->palette;
  if (s->grid->rgb && p->own_colours)
    return mean(sum, HSR_SLAB_RGB + channel, ONE);
  return between(p->rgb[level.lower][channel], p->rgb[level.upper][channel],
                 level.part);
}

/* S: what takes the place of a splat. */
static void classify(const struct hsr_splats *s,
                     const uint64_t sum[HSR_SLAB_CHANNELS], uint16_t S[4]) {
  struct entries level = entries_at(mean(sum, HSR_SLAB_LEVEL, ONE)),
                 steep = entries_at(mean(sum, HSR_SLAB_STEEP, ONE));
  uint64_t shade = mean(sum, HSR_SLAB_SHADE, 2 * ONE),
           gloss = mean(sum, HSR_SLAB_GLOSS, ONE);
  uint64_t length = s->length[opacity_of(s, level, steep)];
  uint64_t M = length * sum[HSR_SLAB_WEIGHT] >> 16;
  uint64_t opacity = (uint64_t)ONE * hsr_splats_veil(s, M) >> 16;
  for (int c = 0; c < OPACITY; c++) {
    uint64_t lit = colour_of(s, sum, c, level) * shade / ONE + gloss;
    S[c] = (uint16_t)((lit < ONE ? lit : ONE) * opacity / ONE);
  }
  S[OPACITY] = (uint16_t)opacity;
}

void hsr_slab_fold(struct hsr_splats *s, struct hsr_slab *slab,
                   const struct hsr_window *where,
                   struct hsr_splat_picture *picture) {
  for (int j = where->y0; j < where->y1; j++)
    for (int i = where->x0; i < where->x1; i++) {
      size_t at = hsr_splats_at(picture, i, j);
      uint16_t S[4];
      if (!slab->sum[at][HSR_SLAB_WEIGHT]) {
        memset(slab->sum[at], 0, sizeof slab->sum[at]);
        continue;
      }
      HSR_STEP(s->tally, HSR_SPLAT_FOLDS, HSR_NOTHING, HSR_THE_WINDOW,
               HSR_AT(i, j), 0);
      classify(s, slab->sum[at], S);
      memset(slab->sum[at], 0, sizeof slab->sum[at]);
      hsr_splats_put_over(picture, at, S);
    }
}
