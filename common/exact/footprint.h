/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact answers about splats. docs/composited-picture.md, "Footprints", has the
 * definitions. The filters of a module decide most questions; these functions
 * are for the rest. Each call takes microseconds. */
#ifndef HSR_COMMON_FOOTPRINT_H
#define HSR_COMMON_FOOTPRINT_H

#include "common/grids/splatting.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The radius of each kernel, by enum hsr_splat_kernel, in millionths of a cell.
 */
extern const int hsr_kernel_reach[];

/* The factor c of the definition, in millionths, by enum hsr_splat_blur and
 * enum hsr_splat_kernel. */
extern const int hsr_blur_factor[][2];

/* A splat, by the numbers of the definition. */
struct hsr_splat {
  const struct hsr_view *view; /* borrowed */
  double at[3];                /* the place of the sample, world units */
  double size[3];              /* of its cell, along x, y, z, world units */
  double width;                /* as the next ones, of struct hsr_splatting */
  bool antialias;
  enum hsr_splat_kernel kernel;
  enum hsr_splat_blur blur;
  double threshold;
};

enum {
  HSR_FOOTPRINT = 1024,    /* entries of a kernel's table of weights */
  HSR_FOOTPRINT_PARTS = 32 /* parts of half a kernel along the ray */
};

/* The functions below set *out_of_memory if memory runs out. Their result is
 * then meaningless. */

/* Whether the depth of the sample is above near. */
bool hsr_exact_is_beyond_near(const struct hsr_splat *splat,
                              bool *out_of_memory);

/* Whether the splat is blurred by its motion since the previous view. */
bool hsr_exact_is_blurred(const struct hsr_splat *splat, bool *out_of_memory);

/* Returns the energy e of the splat, 0 to 65536. */
uint32_t hsr_exact_energy(const struct hsr_splat *splat, bool *out_of_memory);

/* Returns the index, in the kernel's table, of the splat's weight in pixel (i,
 * j); HSR_FOOTPRINT if the splat does not cover the pixel. */
int hsr_exact_footprint(const struct hsr_splat *splat, int i, int j,
                        bool *out_of_memory);

/* Whether a volume is divided into buckets. It is if its box, from lo to hi in
 * world units, has depths above near and more than one depth. */
bool hsr_exact_is_deep(const struct hsr_view *view, const double lo[3],
                       const double hi[3], bool *out_of_memory);

/* Returns the part of the kernel that lies before the end of a bucket, in pixel
 * (i, j), which the splat covers: -HSR_FOOTPRINT_PARTS to HSR_FOOTPRINT_PARTS.
 * The bucket has number `bucket` of n, which divide the depths of the box from
 * lo to hi, in world units. */
int hsr_exact_footprint_part(const struct hsr_splat *splat, int i, int j,
                             const double lo[3], const double hi[3], int bucket,
                             int n, bool *out_of_memory);

#ifdef __cplusplus
}
#endif
#endif
