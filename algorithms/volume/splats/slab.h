/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Slabs across the view: what samples measured is added in each pixel of a slab,
 * and what the means show is composited. So samples are classified and lit after
 * the volume is reconstructed, once a pixel and slab.
 *
 * Source      K. Mueller, T. Moeller, R. Crawfis, "Splatting Without the Blur",
 *             IEEE Visualization 1999; slabs parallel to the picture: K.
 *             Mueller, R. Crawfis, "Eliminating Popping Artifacts in Sheet
 *             Buffer-Based Splatting", IEEE Visualization 1998. What is right:
 *             docs/composited-picture.md, model slab.
 * Departures  Light is the mean of that on the samples' normals, not that on a
 *             gradient of the pixel: the grid keeps no densities of samples that
 *             are not kept.
 * Cost        a sum of CHANNELS numbers for each pixel of a footprint and slab
 *             that it reaches; one classification for each pixel of a slab that
 *             holds something */
#ifndef HSR_ALGORITHMS_SLAB_H
#define HSR_ALGORITHMS_SLAB_H

#include "algorithms/engines/splats/splats.h"

/* What is summed: weight, levels of density and gradient, light, and the samples'
 * own colours. */
enum hsr_slab_channel {
  HSR_SLAB_WEIGHT,
  HSR_SLAB_LEVEL,
  HSR_SLAB_STEEP,
  HSR_SLAB_SHADE,
  HSR_SLAB_GLOSS,
  HSR_SLAB_RGB,
  HSR_SLAB_CHANNELS = HSR_SLAB_RGB + 3
};

/* The pixels of a slab in a tile, which have the places of those of a picture. */
struct hsr_slab {
  uint64_t (*sum)[HSR_SLAB_CHANNELS];
};

/* What a splat adds to a pixel by a weight of 1. */
struct hsr_slab_sample {
  uint32_t value[HSR_SLAB_CHANNELS];
};

/* Allocates a slab beside a picture, all 0, from the job's scratch.
 * HSR_E_NOMEM. */
enum hsr_status hsr_slab_open(struct hsr_splats *splats,
                              const struct hsr_splat_picture *picture,
                              struct hsr_slab *slab);

/* What a splat adds: its sample's values times its energy. */
struct hsr_slab_sample hsr_slab_sample(const struct hsr_splats *splats,
                                       const struct hsr_placed *placed);

/* Adds it to the pixel at a place, by this weight. */
static inline void hsr_slab_add(struct hsr_slab *slab, size_t at,
                                const struct hsr_slab_sample *sample,
                                uint32_t weight) {
  for (int c = 0; c < HSR_SLAB_CHANNELS; c++)
    slab->sum[at][c] += (uint64_t)weight * sample->value[c] >> 16;
}

/* Puts a slab over the picture, in a part of it, and makes the slab's sums 0. */
void hsr_slab_fold(struct hsr_splats *splats, struct hsr_slab *slab,
                   const struct hsr_window *where,
                   struct hsr_splat_picture *picture);

#endif
