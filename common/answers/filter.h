/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The filtered picture, whose pixels have 8 x 8 samples each, or 4 x 8, 4 x 4 or
 * 64 x 64 (docs/filtered-picture.md).
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 4.4; P. Haeberli and K. Akeley, "The Accumulation
 *             Buffer", SIGGRAPH 1990.
 * Sub-sample  Sub-sample (a, b) of pixel (i, j), a and b from 0 to 7, is sample
 *             (i, j) of the view whose offset is ((a + 1/2 + jx)/8 - 1/2,
 *             (b + 1/2 + jy)/8 - 1/2). The pixel's pattern of jitter gives jx
 *             and jy; without jitter they are 0. Where they are 0, the
 *             sub-sample is sample (8 i + a, 8 j + b) of the picture of
 *             8 m x 8 n samples. In the pattern of 4 x 8, a is from 0 to 3, and
 *             4 takes the place of 8 along x; in that of 4 x 4 along y too.
 * Cell        A pixel of 64 x 64 sub-samples is 8 x 8 cells. These are as the
 *             pixels of 8 x 8 are in the picture of 8 m x 8 n pixels. In all
 *             other patterns the cell is the pixel.
 * Bit         Sub-sample (a, b) of a cell is bit 8 b + a of a mask of 64 bits, in all
 *             patterns.
 * Colour      A face has the colour of hsr_picture_colour, by N.L, in 16 bits a
 *             channel, linear.
 * Sum         A pixel holds a sum of colour times weight, over all sub-samples
 *             of the picture that the filter's kernel reaches. It is an
 *             integer, so the order of adding does not matter. It is at most
 *             65535 times 65536, so 32 bits hold it. */
#ifndef HSR_COMMON_FILTER_H
#define HSR_COMMON_FILTER_H

#include "common/view/view.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
  HSR_SUB = 8,        /* rows of sub-samples in a pixel, and columns */
  HSR_SUB_ABUFFER = 4 /* columns in the pattern of 4 x 8 */
};

/* But for the first, in the order of the words of the option `filter`. */
enum hsr_filter {
  HSR_FILTER_NONE,
  HSR_FILTER_BOX,      /* area sampling: all of the pixel has one weight */
  HSR_FILTER_COSINE,   /* a hump of one pixel's radius, (1 + cos pi r) / 2 */
  HSR_FILTER_BOX_4X8,  /* the box over 4 x 8 samples, Carpenter's masks */
  HSR_FILTER_BOX_4X4,  /* the box over 4 x 4 */
  HSR_FILTER_FIELD,    /* one field of a frame: 1-4-6-4-1 over its lines */
  HSR_FILTER_BOX_64X64 /* the box over 64 x 64: a level more of masks */
};

/* How many cells a pixel has along a side. */
static inline int hsr_filter_cells(enum hsr_filter filter) {
  return filter == HSR_FILTER_BOX_64X64 ? HSR_SUB : 1;
}

/* How many columns of sub-samples a cell has. */
static inline int hsr_filter_columns(enum hsr_filter filter) {
  return filter == HSR_FILTER_BOX_4X8 || filter == HSR_FILTER_BOX_4X4
             ? HSR_SUB_ABUFFER
             : HSR_SUB;
}

/* And rows. */
static inline int hsr_filter_rows(enum hsr_filter filter) {
  return filter == HSR_FILTER_BOX_4X4 ? HSR_SUB_ABUFFER : HSR_SUB;
}

/* The mask of all sub-samples of a cell. */
static inline uint64_t hsr_filter_all(enum hsr_filter filter) {
  return filter == HSR_FILTER_BOX_4X8   ? UINT64_C(0x0f0f0f0f0f0f0f0f)
         : filter == HSR_FILTER_BOX_4X4 ? UINT64_C(0x0f0f0f0f)
                                        : UINT64_MAX;
}

enum { HSR_MOST_PATTERNS = 16 };

struct hsr_filtering {
  enum hsr_filter filter;
  int patterns; /* of jitter, 0 to HSR_MOST_PATTERNS; 0: there is none */
};

/* The weights of one filter. */
#define HSR_WHOLE_WEIGHT 65536u /* of all within a kernel's reach */
struct hsr_kernel {
  /* The weight with which sub-sample `bit` of a cell counts in the pixel dx to
   * the right of its own, and dy below: weight[dy + 1][dx + 1][bit]. */
  uint32_t weight[3][3][64];
  /* The sum of these weights over the sub-samples in row b of the pixel whose
   * bits are set in `byte`: row[dy + 1][dx + 1][b][byte]. */
  uint32_t row[3][3][HSR_SUB][256];
  int reach;         /* how many pixels to each side a pixel adds to: 0 or 1 */
  int cells;         /* along a side of a pixel; over 1: all weigh the same */
  int columns, rows; /* of sub-samples in a cell */
  uint64_t all;      /* the mask of all of them; others have no weight */
};
void hsr_kernel_init(struct hsr_kernel *kernel, enum hsr_filter filter);

/* Jitter: how far each sub-sample of a pixel is moved, where 1 is the side of
 * the sub-sample's own square. Odd multiples of 1/32, in (-1/2, 1/2). */
struct hsr_jitter {
  double x[64], y[64];
};
void hsr_jitter_init(struct hsr_jitter *jitter, int pattern);

/* Which pattern a cell has, 0 to patterns - 1; -1 where there is no jitter. */
int hsr_jitter_pattern(const struct hsr_filtering *filtering, int i, int j);

/* The view whose sample (i, j) is sub-sample `bit` of cell (i, j), for cells of
 * this pattern of jitter; pattern -1: without jitter. */
struct hsr_view hsr_subsample_view(const struct hsr_view *view,
                                   enum hsr_filter filter, int pattern,
                                   int bit);

/* The colour of a face by its id in the scene, or of HSR_BACKGROUND. The world
 * may be laid out or not. Black if there is no such face. */
void hsr_filter_colour(const struct hsr_world *world,
                       const struct hsr_view *view, uint32_t id,
                       uint16_t rgb[3]);

/* Adds the colour of the sub-samples whose bits are set in the mask of a cell of
 * pixel (i, j) to the sums of all pixels of an m x n picture that they reach. */
void hsr_filter_add(const struct hsr_kernel *kernel, int m, int n, int i, int j,
                    uint64_t mask, const uint16_t rgb[3], uint32_t *sums);

/* Adds a whole picture without jitter: ids[] of 8 m x 8 n samples, or as many
 * columns and rows as the pixels have, where m x n is the size of
 * `view`. */
void hsr_filter_add_picture(const struct hsr_kernel *kernel,
                            const struct hsr_world *world,
                            const struct hsr_view *view, const uint32_t *ids,
                            uint32_t *sums);

/* Adds one sub-sample of every cell that has this pattern: ids[] are the samples
 * of the view of hsr_subsample_view. `view` is that of the pixels. */
void hsr_filter_add_subsample(const struct hsr_kernel *kernel,
                              const struct hsr_filtering *filtering,
                              const struct hsr_world *world,
                              const struct hsr_view *view, int pattern, int bit,
                              const uint32_t *ids, uint32_t *sums);

/* Makes linear colours 0..1 of the sums: it divides each by the sum of the
 * weights that lie within the picture. Three floats a pixel, m * n pixels, no
 * padding. */
void hsr_filter_finish(const struct hsr_filtering *filtering, int m, int n,
                       const uint32_t *sums, float *rgb);

#ifdef __cplusplus
}
#endif
#endif
