/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Splats, exactly: docs/composited-picture.md, Footprints. For what the filters
 * of a module leave open; each call takes microseconds. */
#ifndef HSR_COMMON_FOOTPRINT_H
#define HSR_COMMON_FOOTPRINT_H

#include "common/grids/splatting.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How far each kernel reaches, in millionths of a cell. */
extern const int hsr_kernel_reach[];

/* c, in millionths, of each kind of blur and each kernel. */
extern const int hsr_blur_factor[][2];

/* A splat as the definition has it. */
struct hsr_splat {
  const struct hsr_view *view;
  double at[3], size[3]; /* of the sample, and of its cell */
  double width;
  bool antialias;
  enum hsr_splat_kernel kernel;
  enum hsr_splat_blur blur;
  double threshold;
};

enum {
  HSR_FOOTPRINT = 1024, /* entries of a kernel's table; no weight beyond */
  HSR_FOOTPRINT_PARTS = 32
};

/* Each of these sets *out_of_memory if memory ran out, and any answer is given
 * then. */

/* Whether the depth of the sample exceeds near. */
bool hsr_exact_is_beyond_near(const struct hsr_splat *splat,
                              bool *out_of_memory);

/* Whether it is blurred by its motion since the view before. */
bool hsr_exact_is_blurred(const struct hsr_splat *splat, bool *out_of_memory);

/* The energy e, 0 to 65536. */
uint32_t hsr_exact_energy(const struct hsr_splat *splat, bool *out_of_memory);

/* The index of the weight in pixel (i, j); HSR_FOOTPRINT if it is not covered.
 */
int hsr_exact_footprint(const struct hsr_splat *splat, int i, int j,
                        bool *out_of_memory);

/* Whether there are buckets: the depths of the box from lo to hi reach farther
 * than near, and than one depth. */
bool hsr_exact_is_deep(const struct hsr_view *view, const double lo[3],
                       const double hi[3], bool *out_of_memory);

/* The part of the kernel before the end of bucket `bucket` of n in pixel (i,
 * j), the buckets reaching over the depths of the box from lo to hi: -32 to 32.
 * The pixel is covered. */
int hsr_exact_footprint_part(const struct hsr_splat *splat, int i, int j,
                             const double lo[3], const double hi[3], int bucket,
                             int n, bool *out_of_memory);

#ifdef __cplusplus
}
#endif
#endif
