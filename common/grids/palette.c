/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/grids/palette.h"

#include <string.h>

enum { ONE = 65535 };

/* What is 0 at `from` and 1 at `to`, and linear between: of one colour. */
static void ramp(struct hsr_palette *p, int from, int to, uint32_t most,
                 const uint16_t rgb[3]) {
  for (int k = 0; k < HSR_LEVELS; k++) {
    int at = k < from ? from : k > to ? to : k;
    p->opacity[k] =
        (uint16_t)(most * (uint32_t)(at - from) / (uint32_t)(to - from));
    memcpy(p->rgb[k], rgb, sizeof p->rgb[k]);
  }
}

static void all_opaque(struct hsr_palette *p) {
  for (int k = 0; k < HSR_LEVELS; k++) {
    p->opacity[k] = p->gradient[k] = ONE;
    for (int c = 0; c < 3; c++)
      p->rgb[k][c] = ONE * 3 / 4;
  }
  p->own_colours = p->eye_light = true;
  p->exponent = 1;
}

static void make_flat(struct hsr_palette *p) {
  all_opaque(p);
  p->ambient = ONE;
}

static void make_solid(struct hsr_palette *p) {
  all_opaque(p);
  p->ambient = ONE / 5;
  p->diffuse = ONE - ONE / 5;
  p->specular = ONE / 6;
  p->exponent = 24;
}

static void make_haze(struct hsr_palette *p) {
  static const uint16_t white[3] = {ONE, ONE, ONE};
  ramp(p, 0, HSR_LEVELS - 1, ONE / 8, white);
  for (int k = 0; k < HSR_LEVELS; k++)
    p->gradient[k] = ONE;
  p->ambient = ONE;
  p->eye_light = true;
  p->exponent = 1;
}

/* After M. Levoy, "Display of Surfaces from Volume Data", 1988: what changes
 * fast is opaque. */
static void make_surfaces(struct hsr_palette *p) {
  make_solid(p);
  for (int k = 0; k < HSR_LEVELS; k++)
    p->gradient[k] = (uint16_t)(k >= 128 ? ONE : k * ONE / 128);
}

const struct hsr_palette_name hsr_palette_names[] = {
    {"flat", "opaque, in the samples' own colours, without light"},
    {"solid", "opaque, lit from the eye"},
    {"haze", "white, an eighth opaque at the greatest density, without light"},
    {"surfaces", "opaque where the density changes fast, lit from the eye"},
    {NULL, NULL}};

bool hsr_palette_find(const char *name, struct hsr_palette *palette) {
  static void (*const make[])(struct hsr_palette *) = {
      make_flat, make_solid, make_haze, make_surfaces};
  for (int k = 0; hsr_palette_names[k].name; k++)
    if (!strcmp(name, hsr_palette_names[k].name)) {
      *palette = (struct hsr_palette){.exponent = 0};
      make[k](palette);
      return true;
    }
  return false;
}
