/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mask pyramid with depths. Polygons are tiled in any order: by masks as
 * long as the order allows it, and otherwise by a z-buffer.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 6.1.
 * Notation    znear, zfar -> near, far, as q (common/exact/screen.h), greater
 *             being nearer;
 *             fragment -> struct hsr_lazy_fragment; the pixel of the paper -> a
 *             cell of the finest level, of 8 x 8 samples
 * Invariants  the q of what is seen so far at any sample of a cell lies within
 *             [far, near] of the cell. A pixel is either tiled, and no two of
 *             its fragments share a sample; or z-buffered, and the face of each
 *             sample is known. A polygon that covers a cell and hides all that
 *             was met there makes the cell whole: then the cell shows that face
 *             alone, and nothing is kept below it. Tiling is legal while a
 *             polygon shares no sample with the fragments of a pixel or is
 *             behind them: by znear and zfar, or at each of these samples.
 * Ties        what znear and zfar leave open is compared at the samples,
 *             exactly; of faces in one plane the lower one is nearer
 * Departures  colours are added when all polygons have been met, from the
 *             fragments; so no fragment is thrown away early. near and far of a
 *             cell are found anew from those of its subcells. */
#ifndef HSR_ALGORITHMS_TILING_LAZY_PYRAMID_H
#define HSR_ALGORITHMS_TILING_LAZY_PYRAMID_H

#include "algorithms/image_space/area/tiling/frame.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Bounds of q. If there is nothing, far > near. */
struct hsr_lazy_depth {
  double far, near;
};

/* A cell above the finest level, beside its masks. */
struct hsr_lazy_cell {
  struct hsr_lazy_depth depth;
  uint64_t whole; /* the subcells that have not been entered since `face` made
                     the cell whole: all that is there is that face */
  uint32_t face;
};

/* Indices are those of the growing arrays + 1; 0: none. */
struct hsr_lazy_fragment {
  uint64_t mask;
  uint32_t face, next;
};
struct hsr_lazy_samples {
  uint32_t face[64]; /* HSR_BACKGROUND: none yet */
};
struct hsr_lazy_pixel {
  struct hsr_lazy_depth depth;
  uint32_t fragments, samples;
  bool z_buffered;
};

/* What it counts. The groups of lines: what becomes of a polygon in a pixel; and
 * of a pixel in the end. */
extern const struct hsr_part hsr_lazy_part;
enum {
  HSR_LAZY_FRAGMENTS = HSR_FIRST_OF(HSR_PART_LAZY),
  HSR_LAZY_DEMOTED,
  HSR_LAZY_COMPARED,
  HSR_LAZY_ENTERED,
  HSR_LAZY_Z_BUFFERED
};
enum { HSR_PIXEL_LINES, HSR_END_LINES };

struct hsr_lazy_pyramid {
  struct hsr_masks *masks; /* its C and V are kept here */
  struct hsr_lazy_cell *cell[HSR_MASK_LEVELS];
  struct hsr_lazy_pixel *pixel;
  struct hsr_growing fragment, samples;
  uint32_t vacant_fragment; /* the first of a list */
  bool changed[HSR_MASK_LEVELS];
  bool out_of_memory;

  struct hsr_screen screen;     /* of the samples; planes as they are needed */
  struct hsr_lazy_depth *depth; /* a face: over all of it, once it is known */
  bool *known;                  /* a face: its plane and depth are */
  struct hsr_arena *arena;
  struct hsr_tally *tally;

  /* The polygon at hand. */
  uint32_t face;
  struct hsr_lazy_depth own; /* in the pixel at hand */
  double nearest;            /* of the box at hand */
  bool shows;
};

/* Makes a vacant pyramid; `masks` is ready and vacant. HSR_E_NOMEM. */
enum hsr_status
hsr_lazy_begin(struct hsr_lazy_pyramid *pyramid, struct hsr_masks *masks,
               const struct hsr_world *world, const struct hsr_view *view,
               struct hsr_tally *tally, struct hsr_arena *arena);

/* Makes sure that the plane of a face is known. */
void hsr_lazy_face(struct hsr_lazy_pyramid *pyramid, uint32_t face);

/* Tiles a polygon of a face; the polygon lies within the box of samples.
 * Returns false if the box is hidden. */
bool hsr_lazy_tile(struct hsr_lazy_pyramid *pyramid, uint32_t face,
                   const struct hsr_mask_polygon *polygon,
                   struct hsr_bounds box);

/* May anything be seen of a thing that lies within the polygon and whose q is
 * nowhere greater than `nearest`? Samples that the lines do not place surely
 * outside count as inside. */
bool hsr_lazy_shows(struct hsr_lazy_pyramid *pyramid,
                    const struct hsr_mask_polygon *polygon,
                    struct hsr_bounds box, double nearest);

/* Tells the sink all samples of the window. Before those of a face, or of
 * HSR_BACKGROUND, it calls `take`. */
void hsr_lazy_resolve(struct hsr_lazy_pyramid *pyramid,
                      const struct hsr_mask_sink *sink, void *context,
                      void (*take)(void *context, uint32_t face));

#ifdef __cplusplus
}
#endif
#endif
