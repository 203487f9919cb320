/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One texel a pixel: the one that its ray meets.
 *
 * Source      E. Catmull, "A Subdivision Algorithm for Computer Display of
 *             Curved Surfaces", PhD thesis, University of Utah, 1974, where
 *             textures begin; as point sampling in Heckbert 1986
 *
 * Notation, invariant, ties, departures and cost are those of textures.h. */
#include "algorithms/volume/textures/textures.h"
#include "common/answers/kinds/composited.h"

static void filter(struct hsr_texture *x, const struct hsr_preimage *pre,
                   double mean[HSR_TEXTURE_CHANNELS]) {
  int p = hsr_texel_of(pre->at[0], x->n[0]),
      q = hsr_texel_of(pre->at[1], x->n[1]);
  HSR_STEP(x->tally, HSR_TEXTURE_TEXELS, HSR_CELL(0, p, q), HSR_THE_WINDOW,
           HSR_AT(pre->i, pre->j), 0);
  for (int c = 0; c < HSR_TEXTURE_CHANNELS; c++)
    mean[c] = x->texel[(size_t)q * (size_t)x->n[0] + (size_t)p][c];
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_texture x;
  if (hsr_textures_begin(&x, job))
    return hsr_fail_nomem(err);
  x.filter = filter;
  hsr_textures_draw(&x, job);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_textures_part}, {NULL}};

static const struct hsr_line outline[] = {
    {"for each pixel: does its ray meet the layer?",
     HSR_RAISES(HSR_TEXTURE_RAYS)},
    {"  if so, read the texel there", HSR_RAISES(HSR_TEXTURE_TEXELS)},
    {"  write it, if it is not empty", HSR_RAISES(HSR_TEXTURE_WRITES)},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(texture_point) = {
    .name = "texture-point",
    .numbered = HSR_NUMBERED_TEXELS,
    .title = "Texture mapping, a texel a pixel",
    .authors = "E. Catmull",
    .year = 1974,
    .source = "Catmull, A Subdivision Algorithm for Computer Display of Curved "
              "Surfaces, PhD thesis, University of Utah, 1974",
    .taxonomy = HSR_VOLUME_SPACE,
    .subjects = 1 << HSR_GRID,
    .makes = {{HSR_COMPOSITED, 1 << HSR_XRAY}},
    .flags = HSR_INSTANCED | HSR_KNOWN_WRONG,
    .prepare = hsr_textures_prepare,
    .release = hsr_textures_release,
    .parts = uses,
    .outline = outline,
    .render = render};
