/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the samples of a grid look as splats: opacity and colour by density, a
 * factor by gradient, and light. docs/composited-picture.md says how the
 * numbers are used.
 *
 * Source      J. E. Swan II, PhD thesis, Ohio State University, 1998, 1.2.1:
 *             tables classify a sample by its density and gradient, and shade
 *             it. */
#ifndef HSR_COMMON_GRIDS_PALETTE_H
#define HSR_COMMON_GRIDS_PALETTE_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_LEVELS = 256 };

/* Values of 16 bits are fractions of 65535. Colours are linear. */
struct hsr_palette {
  uint16_t opacity[HSR_LEVELS];  /* by level of density */
  uint16_t rgb[HSR_LEVELS][3];   /* by level of density */
  uint16_t gradient[HSR_LEVELS]; /* by level of gradient: a factor of the
                                    opacity */
  bool has_window;
  double window[2]; /* the densities of level 0 and level 255 */
  bool own_colours; /* samples that have a colour of their own keep it */
  uint16_t ambient, diffuse, specular; /* the parts of the light */
  int exponent;                        /* of the specular light, 1..128 */
  bool eye_light;   /* the light is at the eye, and light[] is not used */
  int16_t light[3]; /* the direction to the light, in the world, about 1024
                       long */
};

/* A control point: a level, and a table's values at it. Tables of opacity or of
 * a factor use value[0] only. */
struct hsr_palette_point {
  int level; /* 0..255 */
  uint16_t value[3];
};

/* Returns the value of a table at `level`, 0..255, in one channel. The table is
 * given by an array of control points, with ascending levels of which the last
 * is 255. Between points v0 at k0 and v1 at k1 the value is (v0 (k1 - level) +
 * v1 (level - k0)) / (k1 - k0), rounded down. Before the first point it is that
 * of the first point. */
uint16_t hsr_palette_at(const struct hsr_palette_point *point, int level,
                        int channel);

/* Sets *palette to the built-in palette with this name. False if there is none;
 * *palette is then as it was. */
bool hsr_palette_find(const char *name, struct hsr_palette *palette);

/* The names of all built-in palettes, and what each is for. The list ends with
 * .name == NULL. */
struct hsr_palette_name {
  const char *name, *meaning;
};
extern const struct hsr_palette_name hsr_palette_names[];

#ifdef __cplusplus
}
#endif
#endif
