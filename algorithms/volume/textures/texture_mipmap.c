/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A pyramid of ever smaller textures; a pixel reads two of its levels.
 *
 * Source      L. Williams, "Pyramidal Parametrics", SIGGRAPH 1983
 * Notation    D, by which the level is chosen, is the side of the square around
 *             the preimage. The level is log2 D, at least 0.
 * Levels      a texel is the mean of four of the level before. Where a level has
 *             an odd number of texels along an axis, its last ones count twice.
 * Departures  beyond the rim of the layer, its last texels go on.
 * Cost        8 texels a pixel, 4 if it is not smaller than a texel; a third of the
 *             texture is built
 *
 * Invariant, ties and the rest are those of textures.h. */
#include "algorithms/volume/textures/textures.h"
#include "common/answers/kinds/composited.h"

#include <math.h>

enum { CHANNELS = HSR_TEXTURE_CHANNELS, MOST_LEVELS = 24 };

struct level {
  int n[2];
  float (*texel)[CHANNELS];
};

struct pyramid {
  int n;
  struct level level[MOST_LEVELS];
};

/* --- Levels --------------------------------------------------------------- */

static float *texel_at(const struct level *l, int p, int q) {
  p = p < 0 ? 0 : p < l->n[0] ? p : l->n[0] - 1;
  q = q < 0 ? 0 : q < l->n[1] ? q : l->n[1] - 1;
  return l->texel[(size_t)q * (size_t)l->n[0] + (size_t)p];
}

static bool open_level(struct hsr_texture *x, struct level *l, int n0, int n1) {
  *l = (struct level){.n = {n0, n1}};
  l->texel =
      hsr_arena_array(x->arena, (size_t)n0 * (size_t)n1, sizeof *l->texel);
  return l->texel;
}

static void average(const struct level *before, int p, int q, float *mean) {
  for (int c = 0; c < CHANNELS; c++)
    mean[c] = (texel_at(before, 2 * p, 2 * q)[c] +
               texel_at(before, 2 * p + 1, 2 * q)[c] +
               texel_at(before, 2 * p, 2 * q + 1)[c] +
               texel_at(before, 2 * p + 1, 2 * q + 1)[c]) /
              4;
}

static void fill_level(struct hsr_texture *x, const struct pyramid *pyramid,
                       int k) {
  const struct level *l = &pyramid->level[k];
  for (int q = 0; q < l->n[1]; q++)
    for (int p = 0; p < l->n[0]; p++) {
      HSR_STEP(x->tally, HSR_TEXTURE_BUILT, HSR_CELL(k, p, q), HSR_NOTHING,
               HSR_NOWHERE, 0);
      average(&pyramid->level[k - 1], p, q, texel_at(l, p, q));
    }
}

static enum hsr_status build(struct hsr_texture *x, struct pyramid *pyramid) {
  size_t n = (size_t)x->n[0] * (size_t)x->n[1];
  struct level *l = pyramid->level;
  if (!open_level(x, l, x->n[0], x->n[1]))
    return HSR_E_NOMEM;
  for (size_t k = 0; k < n; k++)
    for (int c = 0; c < CHANNELS; c++)
      l->texel[k][c] = x->texel[k][c];
  for (pyramid->n = 1; l->n[0] > 1 || l->n[1] > 1; pyramid->n++, l++) {
    if (!open_level(x, l + 1, (l->n[0] + 1) / 2, (l->n[1] + 1) / 2))
      return HSR_E_NOMEM;
    fill_level(x, pyramid, pyramid->n);
  }
  return HSR_OK;
}

/* --- Pixels --------------------------------------------------------------- */

/* Adds four texels around a place, times `share`. */
static void add_level(struct hsr_texture *x, const struct hsr_preimage *pre,
                      int k, double share, double mean[CHANNELS]) {
  const struct level *l = &((struct pyramid *)x->model)->level[k];
  double at[2] = {ldexp(pre->at[0], -k) - 0.5, ldexp(pre->at[1], -k) - 0.5};
  int p0 = (int)floor(at[0]), q0 = (int)floor(at[1]);
  for (int q = q0; q <= q0 + 1; q++)
    for (int p = p0; p <= p0 + 1; p++) {
      const float *texel = texel_at(l, p, q);
      double weight = share * (1 - fabs(at[0] - p)) * (1 - fabs(at[1] - q));
      HSR_STEP(x->tally, HSR_TEXTURE_TEXELS,
               HSR_CELL(k, (texel - l->texel[0]) / CHANNELS % l->n[0],
                        (texel - l->texel[0]) / CHANNELS / l->n[0]),
               HSR_THE_WINDOW, HSR_AT(pre->i, pre->j), 0);
      for (int c = 0; c < CHANNELS; c++)
        mean[c] += weight * (double)texel[c];
    }
}

static void filter(struct hsr_texture *x, const struct hsr_preimage *pre,
                   double mean[CHANNELS]) {
  const struct pyramid *pyramid = x->model;
  double side[2];
  hsr_preimage_sides(x, pre, side);
  double level = log2(fmax(1, fmax(side[0], side[1])));
  level = fmin(level, pyramid->n - 1);
  int k = (int)level;
  double above = level - k;
  add_level(x, pre, k, 1 - above, mean);
  if (above > 0)
    add_level(x, pre, k + 1, above, mean);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_texture x;
  struct pyramid pyramid = {.n = 0};
  if (hsr_textures_begin(&x, job) || build(&x, &pyramid))
    return hsr_fail_nomem(err);
  x.filter = filter;
  x.model = &pyramid;
  hsr_textures_draw(&x, job);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_textures_part}, {&hsr_built_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"build each level of means of four texels of the one before",
     HSR_RAISES(HSR_TEXTURE_BUILT)},
    {"for each pixel: does its ray meet the layer?",
     HSR_RAISES(HSR_TEXTURE_RAYS)},
    {"  if so, choose two levels by the square around its preimage"},
    {"  read four texels of each", HSR_RAISES(HSR_TEXTURE_TEXELS)},
    {"  write their mean, if it is not empty", HSR_RAISES(HSR_TEXTURE_WRITES)},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(texture_mipmap) = {
    .name = "texture-mipmap",
    .numbered = HSR_NUMBERED_TEXELS,
    .title = "Williams' mip-map",
    .authors = "L. Williams",
    .year = 1983,
    .source = "Williams, Pyramidal Parametrics, SIGGRAPH 1983",
    .taxonomy = HSR_VOLUME_SPACE,
    .subjects = 1 << HSR_GRID,
    .makes = {{HSR_COMPOSITED, 1 << HSR_XRAY}},
    .flags = HSR_INSTANCED | HSR_KNOWN_WRONG,
    .prepare = hsr_textures_prepare,
    .release = hsr_textures_release,
    .parts = uses,
    .outline = outline,
    .render = render};
