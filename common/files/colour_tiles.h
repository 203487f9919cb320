/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tiles of pictures of colours: as those of ids in common/files/image.h, but with
 * the channels R, G, B of 32-bit floats, 3 a pixel. */
#ifndef HSR_COMMON_COLOUR_TILES_H
#define HSR_COMMON_COLOUR_TILES_H

#include "common/files/image.h"

#ifdef __cplusplus
extern "C" {
#endif

/* As hsr_image_write_tile and hsr_image_join_tiles. */
enum hsr_status hsr_image_write_colour_tile(const char *path,
                                            const struct hsr_tile_grid *tiling,
                                            long number, const float *rgb,
                                            const char *text,
                                            struct hsr_error *err);
enum hsr_status
hsr_image_join_colour_tiles(const char *path,
                            const struct hsr_tile_grid *tiling,
                            const char *(*name)(void *whom, long k), void *whom,
                            const char *text, struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
