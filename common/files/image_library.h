/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of hsr-images.so and, of them only `write`, of hsr-png.so. Only
 * for image.c, image_oiio.cc and image_png.c. */
#ifndef HSR_COMMON_IMAGE_LIBRARY_H
#define HSR_COMMON_IMAGE_LIBRARY_H

#include "common/files/image.h"

/* As the functions of image.h. */
struct hsr_image_library {
  enum hsr_status (*write)(const char *path, const struct hsr_picture *picture,
                           const char *text, struct hsr_error *err);
  enum hsr_status (*write_depths)(const char *path, int m, int n,
                                  const double *depth, const char *text,
                                  struct hsr_error *err);
  enum hsr_status (*write_work)(const char *path, int m, int n,
                                const float *work, struct hsr_error *err);
  enum hsr_status (*write_ramp)(const char *path, int m, int n, const float *x,
                                struct hsr_error *err);
  enum hsr_status (*read)(const char *path, bool colours, uint32_t size[2],
                          float **value, struct hsr_error *err);
  enum hsr_status (*read_numbers)(const char *path, const char *channel,
                                  struct hsr_npy *numbers,
                                  struct hsr_error *err);
  /* Pixels are 3 or 4 floats each; or, of one channel, ids of 32 bits. */
  enum hsr_status (*write_tile)(const char *path,
                                const struct hsr_tile_grid *tiling, long number,
                                int channels, const void *pixels,
                                const char *text, struct hsr_error *err);
  enum hsr_status (*join_tiles)(const char *path,
                                const struct hsr_tile_grid *tiling,
                                int channels,
                                const char *(*name)(void *whom, long k),
                                void *whom, const char *text,
                                struct hsr_error *err);
};

#endif
