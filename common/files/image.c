/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/colour_tiles.h"
#include "common/files/image_library.h"
#include "common/files/library.h"
#include "common/files/suffix.h"

#include <stdlib.h>
#include <string.h>

static enum hsr_status load(const struct hsr_image_library **images,
                            struct hsr_error *err) {
  const void *table;
  enum hsr_status status =
      hsr_library_table("hsr-images.so", "hsr_images", &table, err);
  *images = table;
  return status;
}

/* What writes a picture's colours: of .png files, the common ones, a small
 * library does. */
static enum hsr_status load_writer(const char *path,
                                   const struct hsr_image_library **images,
                                   struct hsr_error *err) {
  const void *table;
  if (!hsr_ends_in(path, ".png"))
    return load(images, err);
  enum hsr_status status =
      hsr_library_table("hsr-png.so", "hsr_png", &table, err);
  *images = table;
  return status;
}

/* R G B, or R G B A, of each pixel. */
static enum hsr_status write_colours(const char *path,
                                     const struct hsr_picture *picture,
                                     struct hsr_error *err) {
  size_t n = (size_t)picture->m * (size_t)picture->n,
         channels = picture->alpha ? 4 : 3;
  float *all = malloc(channels * n * sizeof *all);
  if (!all)
    return hsr_fail_nomem(err);
  for (size_t k = 0; k < n; k++) {
    memcpy(all + channels * k, picture->rgb + 3 * k, 3 * sizeof *all);
    if (picture->alpha)
      all[channels * k + 3] = picture->alpha[k];
  }
  const struct hsr_npy array = {
      .kind = 'f',
      .bytes = sizeof *all,
      .n_dimensions = 3,
      .size = {(uint64_t)picture->n, (uint64_t)picture->m, channels},
      .data = all};
  enum hsr_status status = hsr_npy_write(path, &array, err);
  free(all);
  return status;
}

enum hsr_status hsr_image_write(const char *path,
                                const struct hsr_picture *picture,
                                const char *text, struct hsr_error *err) {
  if (hsr_is_array_file(path))
    return write_colours(path, picture, err);
  const struct hsr_image_library *images;
  enum hsr_status status = load_writer(path, &images, err);
  return status ? status : images->write(path, picture, text, err);
}

enum hsr_status hsr_image_write_depths(const char *path, int m, int n,
                                       const double *depth, const char *text,
                                       struct hsr_error *err) {
  const struct hsr_npy array = {.kind = 'f',
                                .bytes = sizeof *depth,
                                .n_dimensions = 2,
                                .size = {(uint64_t)n, (uint64_t)m},
                                .data = (void *)depth};
  if (hsr_is_array_file(path))
    return hsr_npy_write(path, &array, err);
  const struct hsr_image_library *images;
  enum hsr_status status = load(&images, err);
  return status ? status : images->write_depths(path, m, n, depth, text, err);
}

enum hsr_status hsr_image_write_work(const char *path, int m, int n,
                                     const float *work, struct hsr_error *err) {
  const struct hsr_image_library *images;
  enum hsr_status status = load(&images, err);
  return status ? status : images->write_work(path, m, n, work, err);
}

enum hsr_status hsr_image_write_ramp(const char *path, int m, int n,
                                     const float *x, struct hsr_error *err) {
  const struct hsr_image_library *images;
  enum hsr_status status = load(&images, err);
  return status ? status : images->write_ramp(path, m, n, x, err);
}

enum hsr_status hsr_image_write_tile(const char *path,
                                     const struct hsr_tile_grid *tiling,
                                     long number, const uint32_t *ids,
                                     const char *text, struct hsr_error *err) {
  const struct hsr_image_library *images;
  enum hsr_status status = load(&images, err);
  return status ? status
                : images->write_tile(path, tiling, number, 1, ids, text, err);
}

enum hsr_status hsr_image_join_tiles(const char *path,
                                     const struct hsr_tile_grid *tiling,
                                     const char *(*name)(void *whom, long k),
                                     void *whom, const char *text,
                                     struct hsr_error *err) {
  const struct hsr_image_library *images;
  enum hsr_status status = load(&images, err);
  return status ? status
                : images->join_tiles(path, tiling, 1, name, whom, text, err);
}

enum hsr_status hsr_image_write_colour_tile(const char *path,
                                            const struct hsr_tile_grid *tiling,
                                            long number, int channels,
                                            const float *pixels,
                                            const char *text,
                                            struct hsr_error *err) {
  const struct hsr_image_library *images;
  enum hsr_status status = load(&images, err);
  return status ? status
                : images->write_tile(path, tiling, number, channels, pixels,
                                     text, err);
}

enum hsr_status
hsr_image_join_colour_tiles(const char *path,
                            const struct hsr_tile_grid *tiling, int channels,
                            const char *(*name)(void *whom, long k), void *whom,
                            const char *text, struct hsr_error *err) {
  const struct hsr_image_library *images;
  enum hsr_status status = load(&images, err);
  return status ? status
                : images->join_tiles(path, tiling, channels, name, whom, text,
                                     err);
}

enum hsr_status hsr_image_read(const char *path, bool colours, uint32_t size[2],
                               float **value, struct hsr_error *err) {
  *value = NULL;
  const struct hsr_image_library *images;
  enum hsr_status status = load(&images, err);
  return status ? status : images->read(path, colours, size, value, err);
}

enum hsr_status hsr_image_read_numbers(const char *path, const char *channel,
                                       struct hsr_npy *numbers,
                                       struct hsr_error *err) {
  *numbers = (struct hsr_npy){.data = NULL};
  const struct hsr_image_library *images;
  enum hsr_status status = load(&images, err);
  return status ? status : images->read_numbers(path, channel, numbers, err);
}
