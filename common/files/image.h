/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Image files, through OpenImageIO. */
#ifndef HSR_COMMON_IMAGE_H
#define HSR_COMMON_IMAGE_H

#include "common/view/picture.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes a picture in the format of the suffix:
 *   .exr  channels R G B Z as float and id as 32-bit unsigned (rgb, depth and
 *         ids must all be there);
 *   any other suffix that OpenImageIO writes (.png, .ppm, .tif, .jpg ...): rgb
 *         as 8 bits a channel, sRGB-encoded.
 * Writes to a temporary name beside `path` and renames it, so that a failure
 * leaves no partial file. `text`, NULL or "key=value" lines, goes into the
 * file's metadata where the format has a place. HSR_E_INPUT: the suffix is not
 * known or the file cannot be written (*err names it); HSR_E_NOMEM. */
enum hsr_status hsr_image_write(const char *path,
                                const struct hsr_picture *picture,
                                const char *text, struct hsr_error *err);

/* Writes colours, of which the share alpha[k], 0 to 1, of pixel k is there, as
 * .png, with 8 bits a channel. Fails as hsr_image_write. */
enum hsr_status hsr_image_write_alpha(const char *path,
                                      const struct hsr_picture *picture,
                                      const float *alpha, const char *text,
                                      struct hsr_error *err);

/* Writes values from 0 to 1, m x n, through a perceptual colour ramp, dark to
 * bright. Not to .exr. Fails as hsr_image_write. */
enum hsr_status hsr_image_write_ramp(const char *path, int m, int n,
                                     const float *x, struct hsr_error *err);

/* Writes one float channel, m x n. To .exr as it is (channel Y); to others
 * through that ramp, logarithmically, the largest value brightest. Fails as
 * hsr_image_write. */
enum hsr_status hsr_image_write_work(const char *path, int m, int n,
                                     const float *work, struct hsr_error *err);

/* A picture too large for memory, by its tiles: the ids of m x n samples in
 * squares of `side`, those at the right and the bottom being cut. They are
 * numbered by rows. */
enum { HSR_TILE_GRAIN = 256 }; /* `side` is a multiple of this */
struct hsr_tile_grid {
  int m, n, side;
};
static inline int hsr_tiles_along(int n, int side) {
  return (n + side - 1) / side;
}
static inline long hsr_tile_count(const struct hsr_tile_grid *t) {
  return (long)hsr_tiles_along(t->m, t->side) * hsr_tiles_along(t->n, t->side);
}
static inline struct hsr_window hsr_tile_window(const struct hsr_tile_grid *t,
                                                long number) {
  int across = hsr_tiles_along(t->m, t->side);
  int x = (int)(number % across) * t->side;
  int y = (int)(number / across) * t->side;
  struct hsr_window tile = {x, y, x + t->side < t->m ? x + t->side : t->m,
                            y + t->side < t->n ? y + t->side : t->n};
  return tile;
}

/* Writes the ids of one tile, by its rows, as an .exr file of its own: channel
 * id, 32-bit unsigned, with its place in the whole picture. Files and failures
 * as for hsr_image_write. */
enum hsr_status hsr_image_write_tile(const char *path,
                                     const struct hsr_tile_grid *tiling,
                                     long number, const uint32_t *ids,
                                     const char *text, struct hsr_error *err);

/* Joins the files of all tiles to one tiled .exr. The files are named, and the
 * progress is told, by `name`, which is called for each tile once, in order;
 * the name is needed until the next call. The bytes of the file depend only on
 * the ids, the text and the size of tiles. No more memory is taken than for a
 * few tiles. HSR_E_INPUT: a tile cannot be read or is none of this picture, or
 * the file cannot be written; HSR_E_NOMEM. */
enum hsr_status hsr_image_join_tiles(const char *path,
                                     const struct hsr_tile_grid *tiling,
                                     const char *(*name)(void *whom, long k),
                                     void *whom, const char *text,
                                     struct hsr_error *err);

/* Reads a picture in any format that OpenImageIO reads: linear colours, 3 a
 * pixel, or its first channel, 1 a pixel; by rows from the top. size[]:
 * columns, rows. *value is malloc'ed, the caller's; NULL after a failure. Takes
 * no more memory than a picture packed into so many bytes can need.
 * HSR_E_INPUT, HSR_E_NOMEM, HSR_E_INTERNAL. */
enum hsr_status hsr_image_read(const char *path, bool colours, uint32_t size[2],
                               float **value, struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
