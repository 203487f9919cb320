/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Image files, through OpenImageIO or, if a .png file is written, libpng. */
#ifndef HSR_COMMON_IMAGE_H
#define HSR_COMMON_IMAGE_H

#include "common/files/npy.h"
#include "common/view/picture.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes a picture in the format of the suffix:
 *   .exr  channels R G B as float; A if there is an alpha; Z as float and id as
 *         32-bit unsigned if there are depth and ids;
 *   .npy  floats: R G B and, if there is an alpha, A, of each pixel;
 *   any other suffix that OpenImageIO writes (.png, .ppm, .tif, .jpg ...): rgb
 *         with 8 bits a channel, sRGB-encoded. With an alpha, for .png, colours
 *         are divided by it before they are encoded, and A is a channel.
 * The file is written under a temporary name beside `path` and then renamed, so
 * that a failure leaves no partial file. `text` is NULL or lines of
 * "key=value", which are put into the file's metadata if the format has a place
 * for them. HSR_E_INPUT if the suffix is not known or the file cannot be
 * written; *err names it. HSR_E_NOMEM. */
enum hsr_status hsr_image_write(const char *path,
                                const struct hsr_picture *picture,
                                const char *text, struct hsr_error *err);

/* Writes depths, m x n, by rows from the top, of which those that are not finite
 * are of no face:
 *   .npy  doubles, as they are;
 *   .png  16 bits, grey: v is least + (v - 1) / 65534 (greatest - least), from 1
 *         for the least depth to 65535 for the greatest, and 0 is no face. The
 *         two are in the file's text, as DepthLeast and DepthGreatest.
 * Errors as hsr_image_write. */
enum hsr_status hsr_image_write_depths(const char *path, int m, int n,
                                       const double *depth, const char *text,
                                       struct hsr_error *err);

/* Writes m x n values from 0 to 1, x[j * m + i], as colours of a perceptual
 * ramp from dark to bright. Not for .exr. Errors as hsr_image_write. */
enum hsr_status hsr_image_write_ramp(const char *path, int m, int n,
                                     const float *x, struct hsr_error *err);

/* Writes a work picture, work[j * m + i], m x n. In .exr the numbers are kept,
 * in channel Y. In other formats their logarithms become colours of the ramp,
 * the largest brightest. Errors as hsr_image_write. */
enum hsr_status hsr_image_write_work(const char *path, int m, int n,
                                     const float *work, struct hsr_error *err);

/* The tiles of a picture that is too large for memory. Its m x n samples are
 * divided into squares of side x side. Those at the right and at the bottom are
 * smaller if need be. Tiles are numbered by rows, from 0. */
enum { HSR_TILE_GRAIN = 256 }; /* `side` is a multiple of this */
struct hsr_tile_grid {
  int m, n, side;
};

/* Returns how many tiles there are along n samples. */
static inline int hsr_tiles_along(int n, int side) {
  return (n + side - 1) / side;
}

/* Returns the number of tiles of a picture. */
static inline long hsr_tile_count(const struct hsr_tile_grid *t) {
  return (long)hsr_tiles_along(t->m, t->side) * hsr_tiles_along(t->n, t->side);
}

/* Returns the samples of a tile, in the picture. */
static inline struct hsr_window hsr_tile_window(const struct hsr_tile_grid *t,
                                                long number) {
  int across = hsr_tiles_along(t->m, t->side);
  int x = (int)(number % across) * t->side;
  int y = (int)(number / across) * t->side;
  struct hsr_window tile = {x, y, x + t->side < t->m ? x + t->side : t->m,
                            y + t->side < t->n ? y + t->side : t->n};
  return tile;
}

/* Writes the ids of tile `number`, by its rows, as an .exr file of its own. The
 * file has the channel id, 32-bit unsigned, and the tile's place in the
 * picture. `text`, temporary files and errors are as in hsr_image_write. */
enum hsr_status hsr_image_write_tile(const char *path,
                                     const struct hsr_tile_grid *tiling,
                                     long number, const uint32_t *ids,
                                     const char *text, struct hsr_error *err);

/* Joins the files of all tiles to one tiled .exr. name(whom, k) returns the
 * path of the file of tile k. It is called once for each tile, in order, so it
 * can show progress too. The path must be valid until the next call. The bytes
 * of the file depend only on the ids, the text and the size of tiles. Memory is
 * that of a few tiles. HSR_E_INPUT if a tile cannot be read or does not belong
 * to this picture, or if the file cannot be written; HSR_E_NOMEM. */
enum hsr_status hsr_image_join_tiles(const char *path,
                                     const struct hsr_tile_grid *tiling,
                                     const char *(*name)(void *whom, long k),
                                     void *whom, const char *text,
                                     struct hsr_error *err);

/* Reads a picture in any format that OpenImageIO reads, by rows from the top.
 * If `colours`, *value has 3 linear numbers a pixel; else it has the first
 * channel, 1 number a pixel. size[] becomes the numbers of columns and rows.
 * *value is malloc'ed and the caller frees it; NULL after a failure. Memory is
 * limited by what a file of this size can hold. HSR_E_INPUT if the file cannot
 * be read; HSR_E_NOMEM; HSR_E_INTERNAL if the library fails. */
enum hsr_status hsr_image_read(const char *path, bool colours, uint32_t size[2],
                               float **value, struct hsr_error *err);

/* Reads the numbers of a picture as they are stored, by rows from the top: of
 * the channel with this name, an array of rows and columns; if `channel` is
 * NULL, of all channels, an array of rows, columns and channels. *numbers is
 * freed by hsr_npy_free, also after a failure. HSR_E_INPUT also if there is no
 * such channel, if the file shows only a part of its picture, or if its numbers
 * are of a type that hsr_npy_read does not read; else as hsr_image_read. */
enum hsr_status hsr_image_read_numbers(const char *path, const char *channel,
                                       struct hsr_npy *numbers,
                                       struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
