/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tiles of pictures of colours. They are as tiles of ids in
 * common/files/image.h, but with linear 32-bit floats: 3 a pixel, in the channels
 * R, G, B, or 4, with A, by which the others are multiplied. */
#ifndef HSR_COMMON_COLOUR_TILES_H
#define HSR_COMMON_COLOUR_TILES_H

#include "common/files/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* As hsr_image_write_tile and hsr_image_join_tiles. `pixels` has `channels` floats
 * a sample, 3 or 4. */
enum hsr_status hsr_image_write_colour_tile(
    const char *path, const struct hsr_tile_grid *tiling, long number,
    int channels, const float *pixels, const char *text, struct hsr_error *err);
enum hsr_status
hsr_image_join_colour_tiles(const char *path,
                            const struct hsr_tile_grid *tiling, int channels,
                            const char *(*name)(void *whom, long k), void *whom,
                            const char *text, struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
