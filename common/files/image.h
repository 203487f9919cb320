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

/* Writes values from 0 to 1, m x n, through a perceptual colour ramp, dark to
 * bright. Not to .exr. Fails as hsr_image_write. */
enum hsr_status hsr_image_write_ramp(const char *path, int m, int n,
                                     const float *x, struct hsr_error *err);

/* Writes one float channel, m x n. To .exr as it is (channel Y); to others
 * through that ramp, logarithmically, the largest value brightest. Fails as
 * hsr_image_write. */
enum hsr_status hsr_image_write_work(const char *path, int m, int n,
                                     const float *work, struct hsr_error *err);

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
