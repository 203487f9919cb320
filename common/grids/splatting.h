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

#endif
