/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mask pyramid with depths, for lazy z-buffering. Polygons are tiled in any
 * order: by masks as long as the order allows it, otherwise by a z-buffer.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 6.1.
 * Notation    znear, zfar of a cell -> near, far, as q (common/exact/screen.h):
 *             greater is nearer. fragment -> struct hsr_lazy_fragment. Pixel ->
 *             a cell of the finest level, of 8 x 8 samples; of a picture that
 *             is not filtered, these are 8 x 8 pixels.
 * Invariants  - The q of what is seen so far, at any sample of a cell, is in
 *             the cell's [far, near].
 *             - A pixel is tiled or z-buffered. If it is tiled, no two of its
 *             fragments share a sample. If it is z-buffered, the face of each
 *             sample is kept.
 *             - Tiling a polygon into a pixel is legal if it shares no sample
 *             with the pixel's fragments, or is behind them: wholly, by near
 *             and far, or at each sample that they share.
 *             - A subcell is whole if one polygon covers it and hides all that
 *             was met there. Then it shows that face alone, and what is kept
 *             below it is stale.
 * Ties        What near and far leave open is compared at the samples, exactly.
 *             Of faces in one plane the lower id is nearer.
 * Departures  - Colours are added after all polygons have been met, from the
 *             fragments. So no colour is discarded when a pixel becomes
 *             z-buffered, and fragments that show are kept to the end.
 *             - near and far of a cell are computed anew from its subcells,
 *             when these have changed.
 *             - A z-buffered pixel keeps faces, not depths: depths are computed
 *             again when they are compared. */
#ifndef HSR_ALGORITHMS_TILING_LAZY_PYRAMID_H
#define HSR_ALGORITHMS_TILING_LAZY_PYRAMID_H

#include "algorithms/image_space/area/tiling/frame.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Bounds of q. far > near: there is nothing. */
struct hsr_lazy_depth {
  double far, near;
};

/* A cell above the finest level; its masks are in struct hsr_masks. */
struct hsr_lazy_cell {
  struct hsr_lazy_depth depth;
  /* A bit for each subcell that is whole: it shows `face` alone. The bit is
   * cleared when the subcell is entered. */
  uint64_t whole;
  uint32_t face;
};

/* Fragments and blocks of samples are in growing arrays, and are known by their
 * index there + 1; 0: none. */
struct hsr_lazy_fragment {
  uint64_t mask; /* the samples of the pixel that it covers */
  uint32_t face;
  uint32_t next; /* the next fragment of the pixel, or of those to be reused */
};
struct hsr_lazy_samples {
  uint32_t face[64]; /* HSR_BACKGROUND: none yet */
};
struct hsr_lazy_pixel {
  struct hsr_lazy_depth depth;
  uint32_t fragments; /* the first, if the pixel is tiled */
  uint32_t samples;   /* in use if it is z-buffered; kept for later otherwise */
  bool z_buffered;
};

/* The part and its counters; lazy_pyramid.c has the meanings, in this order.
 * Groups of lines of its outline: a polygon in a pixel; a pixel at the end. */
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
  struct hsr_masks *masks; /* C and V of the cells; this module changes them */
  struct hsr_lazy_cell *cell[HSR_MASK_LEVELS]; /* by level above the finest */
  struct hsr_lazy_pixel *pixel;
  struct hsr_growing fragment, samples; /* struct hsr_lazy_fragment, _samples */
  uint32_t vacant_fragment;             /* the first to be reused */
  /* By level: something changed in its cell that is being visited. */
  bool changed[HSR_MASK_LEVELS];
  bool out_of_memory;

  struct hsr_screen screen;     /* of the samples; planes as they are needed */
  struct hsr_lazy_depth *depth; /* by face: bounds over all of it, */
  bool *known;                  /* where they and its plane have been found */
  struct hsr_arena *arena;
  struct hsr_tally *tally;

  /* The polygon that is being tiled, and its bounds in the pixel that is being
   * visited. */
  uint32_t face;
  struct hsr_lazy_depth own;

  /* hsr_lazy_shows: the greatest q of the thing, and what was found so far. */
  double nearest;
  bool shows;
};

/* Makes a vacant pyramid. `masks` is initialized and vacant. All but `arena`,
 * which has the arrays, is borrowed as long as *pyramid. HSR_E_NOMEM. */
enum hsr_status
hsr_lazy_begin(struct hsr_lazy_pyramid *pyramid, struct hsr_masks *masks,
               const struct hsr_world *world, const struct hsr_view *view,
               struct hsr_tally *tally, struct hsr_arena *arena);

/* Makes sure that the plane and the depth bounds of a face are known. */
void hsr_lazy_face(struct hsr_lazy_pyramid *pyramid, uint32_t face);

/* Tiles a polygon, of a face of the world; the polygon lies within the box of
 * samples. Returns false if the whole box is found to be hidden. Sets
 * pyramid->out_of_memory if memory runs out. */
bool hsr_lazy_tile(struct hsr_lazy_pyramid *pyramid, uint32_t face,
                   const struct hsr_mask_polygon *polygon,
                   struct hsr_bounds box);

/* May anything be seen of a thing that lies within the polygon and whose q is
 * nowhere greater than `nearest`? Samples that the lines do not place surely
 * outside count as inside. */
bool hsr_lazy_shows(struct hsr_lazy_pyramid *pyramid,
                    const struct hsr_mask_polygon *polygon,
                    struct hsr_bounds box, double nearest);

/* Gives the picture: tells the sink all samples of the window, each once.
 * Before samples of a face, or of HSR_BACKGROUND, it calls `take` with that
 * face. */
void hsr_lazy_resolve(struct hsr_lazy_pyramid *pyramid,
                      const struct hsr_mask_sink *sink, void *context,
                      void (*take)(void *context, uint32_t face));

#ifdef __cplusplus
}
#endif
#endif
