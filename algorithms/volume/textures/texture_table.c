/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A summed-area table: the mean of any rectangle of texels by its four corners.
 *
 * Source      F. C. Crow, "Summed-Area Tables for Texture Mapping", SIGGRAPH
 *             1984
 * Notation    S(p, q) is the sum of all texels before p and before q. The
 *             rectangle is that around the preimage, and at least one texel a
 *             side.
 * Corners     between entries the table is bilinear, which is the integral of
 *             the texture as squares of one colour. The rectangle ends where the
 *             layer does.
 * Exact       entries are whole numbers below 2^53.
 * Cost        16 entries a pixel, however large its preimage is; all of the table
 *             is built
 *
 * Invariant, ties, departures and the rest are those of textures.h. */
#include "algorithms/volume/textures/textures.h"
#include "common/answers/kinds/composited.h"

#include <math.h>
#include <string.h>

enum { CHANNELS = HSR_TEXTURE_CHANNELS };

/* --- The table ------------------------------------------------------------ */

static double *entry(const struct hsr_texture *x, int p, int q) {
  double(*table)[CHANNELS] = x->model;
  return table[(size_t)q * ((size_t)x->n[0] + 1) + (size_t)p];
}

static void fill_entry(struct hsr_texture *x, int p, int q) {
  const uint16_t *texel =
      x->texel[(size_t)(q - 1) * (size_t)x->n[0] + (size_t)(p - 1)];
  const double *left = entry(x, p - 1, q), *above = entry(x, p, q - 1),
               *both = entry(x, p - 1, q - 1);
  HSR_STEP(x->tally, HSR_TEXTURE_BUILT, HSR_CELL(0, p, q), HSR_NOTHING,
           HSR_NOWHERE, 0);
  for (int c = 0; c < CHANNELS; c++)
    entry(x, p, q)[c] = texel[c] + left[c] + above[c] - both[c];
}

/* The first row and the first column stay 0. */
static enum hsr_status build(struct hsr_texture *x) {
  size_t n = ((size_t)x->n[0] + 1) * ((size_t)x->n[1] + 1);
  x->model = hsr_arena_zeroed(x->arena, n, CHANNELS * sizeof(double));
  if (!x->model)
    return HSR_E_NOMEM;
  for (int q = 1; q <= x->n[1]; q++)
    for (int p = 1; p <= x->n[0]; p++)
      fill_entry(x, p, q);
  return HSR_OK;
}

/* --- Pixels --------------------------------------------------------------- */

/* Adds S at a place, times `sign`. */
static void add_corner(struct hsr_texture *x, const struct hsr_preimage *pre,
                       double at_p, double at_q, double sign,
                       double sum[CHANNELS]) {
  int p0 = hsr_texel_of(at_p, x->n[0]), q0 = hsr_texel_of(at_q, x->n[1]);
  for (int q = q0; q <= q0 + 1; q++)
    for (int p = p0; p <= p0 + 1; p++) {
      double weight = (1 - fabs(at_p - p)) * (1 - fabs(at_q - q));
      HSR_STEP(x->tally, HSR_TEXTURE_TEXELS, HSR_CELL(0, p, q), HSR_THE_WINDOW,
               HSR_AT(pre->i, pre->j), 0);
      for (int c = 0; c < CHANNELS; c++)
        sum[c] += sign * weight * entry(x, p, q)[c];
    }
}

static void filter(struct hsr_texture *x, const struct hsr_preimage *pre,
                   double mean[CHANNELS]) {
  double side[2], from[2], to[2];
  hsr_preimage_sides(x, pre, side);
  for (int a = 0; a < 2; a++) {
    double half = fmax(1, side[a]) / 2;
    from[a] = fmax(0, pre->at[a] - half);
    to[a] = fmin(x->n[a], pre->at[a] + half);
  }
  add_corner(x, pre, to[0], to[1], 1, mean);
  add_corner(x, pre, from[0], to[1], -1, mean);
  add_corner(x, pre, to[0], from[1], -1, mean);
  add_corner(x, pre, from[0], from[1], 1, mean);
  for (int c = 0; c < CHANNELS; c++)
    mean[c] /= (to[0] - from[0]) * (to[1] - from[1]);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_texture x;
  if (hsr_textures_begin(&x, job) || build(&x))
    return hsr_fail_nomem(err);
  x.filter = filter;
  hsr_textures_draw(&x, job);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_textures_part}, {&hsr_built_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"build the table: each entry from three others and a texel",
     HSR_RAISES(HSR_TEXTURE_BUILT)},
    {"for each pixel: does its ray meet the layer?",
     HSR_RAISES(HSR_TEXTURE_RAYS)},
    {"  if so, find the rectangle around its preimage"},
    {"  for each corner, read the four entries around it",
     HSR_RAISES(HSR_TEXTURE_TEXELS)},
    {"  write the mean, if it is not empty", HSR_RAISES(HSR_TEXTURE_WRITES)},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(texture_table) = {
    .name = "texture-table",
    .numbered = HSR_NUMBERED_ENTRIES,
    .title = "Crow's summed-area table",
    .authors = "F. C. Crow",
    .year = 1984,
    .source = "Crow, Summed-Area Tables for Texture Mapping, SIGGRAPH 1984",
    .taxonomy = HSR_VOLUME_SPACE,
    .subjects = 1 << HSR_GRID,
    .makes = {{HSR_COMPOSITED, 1 << HSR_XRAY}},
    .flags = HSR_INSTANCED | HSR_KNOWN_WRONG,
    .prepare = hsr_textures_prepare,
    .release = hsr_textures_release,
    .parts = uses,
    .outline = outline,
    .render = render};
