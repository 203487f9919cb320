/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hierarchical occlusion maps: what occluders cover, and how far they may be.
 *
 * Source      H. Zhang, D. Manocha, T. Hudson and K. E. Hoff III, "Visibility
 *             Culling using Hierarchical Occlusion Maps", SIGGRAPH 1997, 77-88.
 * Notation    z -> q as in tiler.h: greater is nearer. The opacity of an entry
 *             of a map -> covered[] over the samples it stands for. An entry of
 *             the depth estimation buffer -> farthest[].
 * Invariant   When the maps have been made, an entry of level 0 is 1 if an
 *             occluder shows at its sample, else 0; one of a higher level is the
 *             sum of the four below. Where an occluder shows, it is not farther
 *             than the entry of farthest[] there. Samples outside of the window
 *             count as covered.
 * Ties        As in pyramid.h.
 * Departures  - An entry is opaque if all its samples are covered. The paper has
 *             thresholds below that, for culling that may be wrong. So opacities
 *             are kept as counts, which are exact.
 *             - The occluders are faces. The paper draws simpler stand-ins for
 *             large objects, chosen beforehand; the estimate of the depth is by
 *             its rectangle and farthest corner, as there.
 *             - Level 0 is as large as the window. Theirs is smaller.
 * Cost        the maps are made once a frame; a test reads entries by recursion,
 *             and then all estimates in the rectangle */
#ifndef HSR_ALGORITHMS_MAPS_H
#define HSR_ALGORITHMS_MAPS_H

#include "algorithms/engines/pyramid/entries.h"
#include "algorithms/engines/tiler/tiler.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
  HSR_MAPS_LEVELS = 15, /* of 2^14 samples a side */
  HSR_MAPS_BITS = 3     /* an estimate stands for 8 x 8 samples */
};

struct hsr_maps {
  struct hsr_window window; /* its first sample is the first entry of level 0 */
  int n_levels;             /* the last level is one entry */
  uint32_t *covered[HSR_MAPS_LEVELS]; /* 2^(n_levels - 1 - level) a side */
  float *farthest; /* row by row: HUGE_VALF where there is no occluder */
  int columns;     /* of estimates */
  bool made;       /* before that nothing is hidden */
  struct hsr_entry_count *count; /* of what is read: entries, and estimates as
                                    entries of level HSR_MAPS_BITS. Borrowed, and
                                    not NULL in the counting build */
};

/* Makes room for the maps of a window, without any occluder. The arrays are the
 * arena's. HSR_E_NOMEM. */
enum hsr_status hsr_maps_init(struct hsr_maps *maps,
                              const struct hsr_window *window,
                              struct hsr_arena *arena);

/* Notes an occluder: it shows in a box of samples only, which is within the
 * window, and nowhere farther than depth `farthest`; 0, if that is unknown. An
 * empty box is no occluder. The maps must not have been made. */
void hsr_maps_note(struct hsr_maps *maps, struct hsr_bounds box,
                   float farthest);

/* Makes the maps of the occluders, which are all faces in the tiler's ids. The
 * window is the tiler's only part. */
void hsr_maps_make(struct hsr_maps *maps, const struct hsr_tiler *tiler);

/* The test. True: what is within a box of samples, which is within the window
 * and not empty, and nowhere nearer than depth q, is certainly hidden: the
 * occluders cover the box, and all of them in it are nearer. */
bool hsr_maps_hides(struct hsr_maps *maps, struct hsr_bounds box, float q);

#ifdef __cplusplus
}
#endif
#endif
