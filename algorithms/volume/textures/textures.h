/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inverse texture mapping: for every pixel, the texels of a layer that it sees
 * are looked up. A grid of one layer is a texture; its samples are the texels.
 *
 * Source      P. S. Heckbert, "Survey of Texture Mapping", IEEE Computer
 *             Graphics and Applications 6 (11), 1986; L. Williams, "Pyramidal
 *             Parametrics", SIGGRAPH 1983; F. C. Crow, "Summed-Area Tables for
 *             Texture Mapping", SIGGRAPH 1984. J. E. Swan II, PhD thesis, Ohio
 *             State University, 1998, 3.5, proposes the forward map beside
 *             them: that is splat-xray:normalise=on:antialias=on.
 * Notation    a texel (p, q) is the cell p along the first axis of the layer
 *             and q along the second. In texels, it is the square from (p, q)
 *             to (p + 1, q + 1). The preimage of a pixel is the parallelogram
 *             around the point at which its ray meets the layer, by the
 *             derivatives there.
 * Invariant   a pixel is written once. It is empty if its ray misses the layer.
 * Ties        A ray that meets the edge between two texels meets the one that
 *             is farther along the axis. Doubles decide; nothing is claimed to
 *             be exact.
 * Departures  - Of the options of a composited picture only `attenuate` counts,
 *             and `width`, which makes preimages larger; with texture-convolve
 *             also `kernel`.
 *             - A sample that is not kept is a texel without opacity.
 *             - Texels have their colours in the view's light. So levels and
 *             tables are built anew for each window.
 * Known wrong The pictures are not those of the definition
 *             (docs/composited-picture.md), since other filters make them.
 * Cost        texels read, and those of which levels or tables are built
 *
 * Files: texture.c finds where rays meet the layer, and writes pixels;
 * texture_point.c, texture_mipmap.c, texture_table.c and texture_convolve.c are
 * the modules, which filter texels. */
#ifndef HSR_ALGORITHMS_TEXTURES_H
#define HSR_ALGORITHMS_TEXTURES_H

#include "algorithms/engines/splats/splats.h"

/* --- What the modules have in common -------------------------------------- */

/* The part that all the modules have; that of the modules that build levels or
 * tables; and their counters. */
extern const struct hsr_part hsr_textures_part, hsr_built_part;
enum {
  HSR_TEXTURE_RAYS = HSR_FIRST_OF(HSR_PART_TEXTURES),
  HSR_TEXTURE_TEXELS,
  HSR_TEXTURE_WRITES
};
enum { HSR_TEXTURE_BUILT = HSR_FIRST_OF(HSR_PART_BUILT) };

/* --- The frame ------------------------------------------------------------ */

enum { HSR_TEXTURE_CHANNELS = 4 };

struct hsr_preimage;
struct hsr_texture {
  const struct hsr_view *view;
  const struct hsr_grid *grid;
  struct hsr_tally *tally;
  struct hsr_arena *arena;
  struct hsr_splats splats; /* for its colours and kernels */
  int across;               /* the axis across which the layer lies */
  int axis[2];              /* the two axes along it */
  int n[2];                 /* texels along these */
  double place;             /* of the layer, the coordinate along `across` */
  uint16_t (*texel)[HSR_TEXTURE_CHANNELS]; /* (p, q) at q n[0] + p */

  /* Set by the module: finds what a pixel shows, premultiplied colour and
   * opacity from 0 to 65535. */
  void (*filter)(struct hsr_texture *, const struct hsr_preimage *,
                 double mean[HSR_TEXTURE_CHANNELS]);
  void *model; /* the module's own */
};

/* The place where the ray of a pixel meets the layer. */
struct hsr_preimage {
  int i, j;               /* the pixel */
  double from[3], way[3]; /* the ray: from + t way */
  double t;               /* its depth */
  double at[2];           /* the place in the layer, in texels */
  double dx[2], dy[2]; /* how `at` changes to the next pixel to the right, and
                             down */
};

/* `prepare` and `release` of these modules. HSR_E_REFUSED if the grid is not of
 * one layer; HSR_E_NOMEM. */
enum hsr_status hsr_textures_prepare(const struct hsr_world *world,
                                     const long *option, void **prepared,
                                     struct hsr_error *err);
void hsr_textures_release(void *prepared);

/* Begins a frame of a job, which is borrowed. The module sets filter and model
 * afterwards. HSR_E_NOMEM. */
enum hsr_status hsr_textures_begin(struct hsr_texture *texture,
                                   const struct hsr_job *job);

/* Calls texture->filter for every pixel of the window whose ray meets the
 * layer, and writes what it gives. */
void hsr_textures_draw(struct hsr_texture *texture, const struct hsr_job *job);

/* Which of n texels in a row holds the place `at`; the first or the last one if
 * it is outside. */
static inline int hsr_texel_of(double at, int n) {
  int p = at > 0 ? (int)at : 0;
  return p < n ? p : n - 1;
}

/* The sides of the box around a preimage, in texels, times the option
 * `width`. */
void hsr_preimage_sides(const struct hsr_texture *texture,
                        const struct hsr_preimage *pre, double side[2]);

#endif
