/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the samples of a grid look as splats: opacity and colour by density, a
 * factor by gradient, and light.
 *
 * Source      J. E. Swan II, PhD thesis, Ohio State University, 1998, 1.1: a
 *             sample is classified by its density and gradient, and shaded, by
 *             tables. What the numbers do: docs/composited-picture.md. */
#ifndef HSR_COMMON_GRIDS_PALETTE_H
#define HSR_COMMON_GRIDS_PALETTE_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_LEVELS = 256 };

/* 65535 is 1. Colours are linear. */
struct hsr_palette {
  uint16_t opacity[HSR_LEVELS];  /* by density */
  uint16_t rgb[HSR_LEVELS][3];   /* by density */
  uint16_t gradient[HSR_LEVELS]; /* by gradient: a factor of the opacity */
  bool own_colours; /* samples that have a colour of their own keep it */
  uint16_t ambient, diffuse, specular;
  int exponent;     /* of the specular light, 1..128 */
  bool eye_light;   /* the light is at the eye */
  int16_t light[3]; /* or it comes from there: a direction in the world, about
                       1024 long */
};

/* A control point: a level, and what a table holds there. Only the first value
 * is used of points of opacity or of a factor. */
struct hsr_palette_point {
  int level; /* 0..255 */
  uint16_t value[3];
};

/* What a table of control points holds at `level` in one channel: between two
 * points v0 at k0 and v1 at k1 it is (v0 (k1 - level) + v1 (level - k0)) / (k1 -
 * k0), rounded down, and before the first point it is the first's value. Levels
 * of points ascend, and the last is 255. */
uint16_t hsr_palette_at(const struct hsr_palette_point *point, int level,
                        int channel);

/* The palettes that are built in, by name; `palette` is not touched if there is
 * none of that name. */
bool hsr_palette_find(const char *name, struct hsr_palette *palette);

/* All names, each with its meaning; ended by NULL. */
struct hsr_palette_name {
  const char *name, *meaning;
};
extern const struct hsr_palette_name hsr_palette_names[];

#ifdef __cplusplus
}
#endif
#endif
