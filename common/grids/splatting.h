/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is asked for in a composited picture: the options of
 * docs/composited-picture.md. */
#ifndef HSR_COMMON_GRIDS_SPLATTING_H
#define HSR_COMMON_GRIDS_SPLATTING_H

#include <stdbool.h>
#include <stdint.h>

enum hsr_model { HSR_OVER, HSR_UNDER, HSR_SHEET, HSR_VOLUME, HSR_XRAY };
enum hsr_splat_kernel { HSR_CRAWFIS_MAX, HSR_GAUSSIAN };
enum hsr_splat_blur { HSR_SHARP, HSR_BLUR_BY_AREA, HSR_BLUR_EXACTLY };

struct hsr_splatting {
  enum hsr_model model;
  enum hsr_splat_kernel kernel;
  double width; /* 1..100 */
  bool antialias;
  uint32_t attenuate; /* q: 65536 is 1 */
  bool normalise;
  uint64_t exposure; /* 65536 is 1 */
  int buckets;
  enum hsr_splat_blur blur;
  double threshold; /* 0..1000 */
};

/* xray: sum exposure / 65536, rounded down; of large ones at least 65535. */
static inline uint64_t hsr_splat_exposed(uint64_t sum, uint64_t exposure) {
  bool is_most = exposure && sum > UINT64_MAX / exposure;
  return is_most ? UINT16_MAX : sum * exposure >> 16;
}

/* The answer of a channel E; the weight is that of its pixel. */
static inline uint16_t hsr_splat_channel(const struct hsr_splatting *splatting,
                                         uint64_t E, uint64_t weight) {
  if (splatting->normalise)
    E = weight ? 65536 * E / weight : 0;
  return E < UINT16_MAX ? (uint16_t)E : UINT16_MAX;
}

#endif
