/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inverse texture mapping: every pixel asks which texels of a layer it sees. A
 * grid of one layer is a texture, its samples are the texels.
 *
 * Source      P. S. Heckbert, "Survey of Texture Mapping", IEEE Computer
 *             Graphics and Applications 6 (11), 1986; L. Williams, "Pyramidal
 *             Parametrics", SIGGRAPH 1983; F. C. Crow, "Summed-Area Tables for
 *             Texture Mapping", SIGGRAPH 1984. J. E. Swan II, PhD thesis, Ohio
 *             State University, 1998, 3.5, proposes the forward map beside them:
 *             that is splat-xray:normalise=on:antialias=on.
 * Notation    a texel (p, q) is the cell p along the first axis of the layer and q
 *             along the second. In texels, it is the square from (p, q) to (p + 1,
 *             q + 1). The preimage of a pixel is the parallelogram around the
 *             point at which its ray meets the layer, by the derivatives there.
 * Invariant   a pixel is written once. It is empty if its ray misses the layer.
 * Ties        a ray that meets the edge of two texels meets the farther along
 *             the axis. Doubles decide, and nothing is claimed to be exact.
 * Departures  of what is asked for in a composited picture, only `attenuate` and
 *             `width` count, which makes preimages larger; with texture-convolve,
 *             `kernel` does, too. A sample that is not kept is a texel without
 *             opacity.
 *             Texels have their colours in the view's light. So levels and
 *             tables are built anew for each window.
 * Known wrong the pictures are other ones than the definition's
 *             (docs/composited-picture.md), as they are made by other filters.
 * Cost        texels read, and those of which levels or tables are built
 *
 * Files: texture.c meets the layer and writes pixels; texture_point.c,
 * texture_mipmap.c, texture_table.c and texture_convolve.c read texels. */
#ifndef HSR_ALGORITHMS_TEXTURES_H
#define HSR_ALGORITHMS_TEXTURES_H

#include "algorithms/engines/splats/splats.h"

/* --- What the modules have in common -------------------------------------- */

/* What they count; and what those count that build levels or tables. */
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
  int across, axis[2];      /* the layer is across one axis, along the others */
  int n[2];                 /* texels along these */
  double place;             /* of the layer, along `across` */
  uint16_t (*texel)[HSR_TEXTURE_CHANNELS]; /* (p, q) at q n[0] + p */

  /* What a module gives to a pixel: premultiplied colour and opacity, from 0 to
   * 65535. */
  void (*filter)(struct hsr_texture *, const struct hsr_preimage *,
                 double mean[HSR_TEXTURE_CHANNELS]);
  void *model; /* of the module */
};

/* Where a ray meets the layer. */
struct hsr_preimage {
  int i, j;               /* the pixel */
  double from[3], way[3]; /* the ray: from + t way */
  double t;               /* there: the depth */
  double at[2];           /* there, in texels */
  double dx[2], dy[2];    /* how `at` changes to the next pixel */
};

/* Refuses a grid that is not one layer. HSR_E_REFUSED. */
enum hsr_status hsr_textures_prepare(const struct hsr_world *world,
                                     const long *option, void **prepared,
                                     struct hsr_error *err);
void hsr_textures_release(void *prepared);

/* Begins a frame. HSR_E_NOMEM. */
enum hsr_status hsr_textures_begin(struct hsr_texture *texture,
                                   const struct hsr_job *job);

/* Calls texture->filter for every pixel that meets the layer, and writes what it
 * gives. */
void hsr_textures_draw(struct hsr_texture *texture, const struct hsr_job *job);

/* The texel of so many texels that a place is in. */
static inline int hsr_texel_of(double at, int n) {
  int p = at > 0 ? (int)at : 0;
  return p < n ? p : n - 1;
}

/* The sides of the box around a preimage, in texels, times `width`. */
void hsr_preimage_sides(const struct hsr_texture *texture,
                        const struct hsr_preimage *pre, double side[2]);

#endif
