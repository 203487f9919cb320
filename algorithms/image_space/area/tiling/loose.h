/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loose faces: those that the BSP trees cannot order, or not for this eye
 * (common/trees/bsp.h, Not flat). The corners of such a face are not on one
 * plane. They are drawn last: at each sample their depth is compared with that
 * of the face that the sample shows. */
#ifndef HSR_ALGORITHMS_TILING_LOOSE_H
#define HSR_ALGORITHMS_TILING_LOOSE_H

#include "algorithms/algorithm.h"
#include "common/trees/bsp.h"
#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The loose faces of one view. All is valid only if n > 0, but for is_loose. */
struct hsr_loose {
  struct hsr_screen screen;
  uint32_t *face, n; /* ascending */
  bool *is_loose;    /* by face of the world; NULL: none is loose */
  bool *has_plane;   /* by face: screen.plane[] has been filled in */
  struct hsr_tally *tally;
};

/* Finds the loose faces of a tree's world for a view. All is borrowed; arrays
 * are the arena's. HSR_E_NOMEM. */
enum hsr_status hsr_loose_begin(struct hsr_loose *loose,
                                const struct hsr_bsp *bsp,
                                const struct hsr_view *view,
                                struct hsr_tally *tally,
                                struct hsr_arena *arena);

/* Returns HSR_E_REFUSED, and says in *err that a filtered picture cannot have
 * loose faces. There is at least one. */
enum hsr_status hsr_loose_refuse(const struct hsr_loose *loose,
                                 const struct hsr_world *world,
                                 struct hsr_error *err);

/* What it counts. */
extern const struct hsr_part hsr_loose_part;
enum { HSR_LOOSE_COMPARED = HSR_FIRST_OF(HSR_PART_LOOSE), HSR_LOOSE_SHOWN };

/* Draws them over a picture of ids, `stride` ids a row, from sample (0, 0) on.
 * Nothing if there are none. */
void hsr_loose_draw(struct hsr_loose *loose, uint32_t *ids, size_t stride);

#ifdef __cplusplus
}
#endif
#endif
