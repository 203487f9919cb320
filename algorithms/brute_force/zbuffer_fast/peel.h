/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depth peeling: transparent faces by a z-buffer, in layers from back to front.
 *
 * Source      A. Mammen, "Transparency and antialiasing algorithms implemented
 *             with the virtual pixel maps technique", IEEE Computer Graphics
 *             and Applications 9(4), 1989, 43-55. Later known as depth peeling:
 *             C. Everitt, "Interactive order-independent transparency", NVIDIA,
 *             2001, takes the layers from front to back.
 * Method      The opaque faces are tiled first. Then there is a pass for each
 *             layer. In a pass all transparent faces are tiled. At each sample,
 *             of those that are nearer than what has been combined there, the
 *             farthest is kept. After the pass it is combined with what is
 *             there.
 * Invariant   between passes: at each sample, exactly those faces have been
 *             combined that are not nearer than the last one combined there
 * Ties        those of hsr_nearer
 * Departures  Depths are compared by hsr_nearer, not by values in a memory:
 *             two layers of equal recorded depths would be lost. The layers are
 *             taken from back to front since colours are combined in integers.
 * Cost        for each of the F transparent faces and each layer, one or two
 *             comparisons at each of its H_f^2 samples; and one more pass to
 *             see that no layer is left */
#ifndef HSR_ALGORITHMS_PEEL_H
#define HSR_ALGORITHMS_PEEL_H

#include "algorithms/engines/tiler/tiler.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Draws the transparent faces over the opaque ones, which have been tiled, the
 * window being one part: tiler->ids has the visible ones. Memory is taken from
 * the job's scratch. HSR_E_NOMEM. */
enum hsr_status hsr_peel(struct hsr_glass *glass, struct hsr_tiler *tiler);

/* The part, besides hsr_tiler_part, and its counters. */
extern const struct hsr_part hsr_peel_part;
enum {
  HSR_PEEL_BEHIND = HSR_FIRST_OF(HSR_PART_PEEL),
  HSR_PEEL_FARTHEST,
  HSR_PEEL_LAYERS,
  HSR_PEEL_SHOWN
};

#ifdef __cplusplus
}
#endif
#endif
