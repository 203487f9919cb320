/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Conversion between linear light and the sRGB encoding of files (IEC
 * 61966-2-1), both 0..1. */
#ifndef HSR_COMMON_SRGB_H
#define HSR_COMMON_SRGB_H

#include <math.h>
#include <stdint.h>

static inline float hsr_srgb_decode(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f
                             : powf((encoded + 0.055f) / 1.055f, 2.4f);
}

static inline float hsr_srgb_encode(float linear) {
  return linear <= 0.0031308f ? linear * 12.92f
                              : 1.055f * powf(linear, 1 / 2.4f) - 0.055f;
}

/* The same in doubles: texts have room for them, and then any float comes back
 * as it was. */
static inline double hsr_srgb_decode_real(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92
                            : pow((encoded + 0.055) / 1.055, 2.4);
}

static inline double hsr_srgb_encode_real(double linear) {
  return linear <= 0.0031308 ? linear * 12.92
                             : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

/* A linear channel as a byte. */
static inline unsigned char hsr_srgb_byte(float linear) {
  return (unsigned char)lrintf(255 *
                               fminf(fmaxf(hsr_srgb_encode(linear), 0), 1));
}

/* 0xrrggbb of three linear channels of 16 bits. */
static inline uint32_t hsr_srgb_of(const uint16_t channel[3]) {
  uint32_t rgb = 0;
  for (int c = 0; c < 3; c++)
    rgb = rgb << 8 |
          (uint32_t)lrintf(255 * hsr_srgb_encode((float)channel[c] / 65535));
  return rgb;
}

#endif
