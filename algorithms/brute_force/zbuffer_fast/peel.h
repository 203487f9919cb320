/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Transparent faces by a z-buffer, in layers from back to front.
 *
 * Source      A. Mammen, "Transparency and antialiasing algorithms implemented
 *             with the virtual pixel maps technique", IEEE Computer Graphics
 *             and Applications 9(4), 1989, 43-55. Later known as depth peeling:
 *             C. Everitt, "Interactive order-independent transparency", NVIDIA,
 *             2001, takes the layers from front to back.
 * Method      The opaque faces are tiled first. Then there is a pass for each
 *             layer: all transparent faces are tiled, and at each sample the
 *             farthest is kept of those that are nearer than what is combined
 *             there already. After the pass it is combined with that.
 * Invariant   between passes: at each sample all faces are combined that are
 *             not nearer than behind[]; no other is
 * Ties        those of hsr_nearer
 * Departures  Depths are compared by hsr_nearer, not by values in a memory:
 *             two layers of equal recorded depths would be lost. The layers are
 *             taken from back to front since colours are combined in integers.
 * Cost        H_f^2 F comparisons or up to two for each transparent face F and
 *             each layer, and one pass more to see that there is no other */
#ifndef HSR_ALGORITHMS_PEEL_H
#define HSR_ALGORITHMS_PEEL_H

#include "algorithms/engines/tiler/tiler.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Draws the transparent faces. Those that are opaque have been tiled, in one
 * part: tiler->ids says what is visible of them. Memory is taken from the job's
 * scratch. HSR_E_NOMEM. */
enum hsr_status hsr_peel(struct hsr_glass *glass, struct hsr_tiler *tiler);

/* What it counts, besides what tiler.h does. */
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
