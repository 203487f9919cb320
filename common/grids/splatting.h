/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options of a composited picture. docs/composited-picture.md defines
 * them. */
#ifndef HSR_COMMON_GRIDS_SPLATTING_H
#define HSR_COMMON_GRIDS_SPLATTING_H

#include <stdbool.h>
#include <stdint.h>

enum hsr_model {
  HSR_OVER,
  HSR_UNDER,
  HSR_SHEET,
  HSR_VOLUME,
  HSR_XRAY,
  HSR_SLAB
};
enum hsr_splat_kernel { HSR_CRAWFIS_MAX, HSR_GAUSSIAN };
enum hsr_splat_blur {
  HSR_SHARP,
  HSR_BLUR_BY_AREA,
  HSR_BLUR_EXACTLY,
  HSR_BLUR_ACCUMULATE
};

struct hsr_splatting {
  enum hsr_model model;
  enum hsr_splat_kernel kernel;
  double width; /* a factor of the kernel's size, 1..100 */
  bool antialias;
  uint32_t attenuate; /* a factor of opacities, in units of 1/65536 */
  bool normalise;     /* never of the model slab */
  bool per_length;   /* opacity=length; always of the model slab, and never with
                        `normalise`, nor of the model xray */
  uint64_t exposure; /* of the model xray, in units of 1/65536 */
  int buckets;       /* of the models volume and slab, along the view */
  enum hsr_splat_blur blur;
  double threshold; /* a splat that moves by at most this, in cells, is not
                       blurred; 0..1000 */
  int frames; /* of HSR_BLUR_ACCUMULATE, the first and the last view included;
                 2..1024 */
};

/* Returns sum * exposure / 65536, rounded down, for the model xray. If the
 * product overflows, the result is 65535, which is the largest answer. */
static inline uint64_t hsr_splat_exposed(uint64_t sum, uint64_t exposure) {
  bool is_most = exposure && sum > UINT64_MAX / exposure;
  return is_most ? UINT16_MAX : sum * exposure >> 16;
}

/* Returns the answer of one channel of a pixel from its sum E and the pixel's
 * sum of weights. */
static inline uint16_t hsr_splat_channel(const struct hsr_splatting *splatting,
                                         uint64_t E, uint64_t weight) {
  if (splatting->normalise)
    E = weight ? 65536 * E / weight : 0;
  return E < UINT16_MAX ? (uint16_t)E : UINT16_MAX;
}

#endif
