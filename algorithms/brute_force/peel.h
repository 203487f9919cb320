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

/* The counters that it keeps, after those of tiler.h. */
enum {
  HSR_PEEL_BEHIND = HSR_N_TILER_COUNTERS,
  HSR_PEEL_FARTHEST,
  HSR_PEEL_LAYERS,
  HSR_PEEL_SHOWN
};
#define HSR_PEEL_COUNTERS                                                      \
  [HSR_PEEL_BEHIND] = {"layer tests",                                          \
                       "transparent faces compared in depth with what is "     \
                       "combined at a sample",                                 \
                       HSR_COMPARE,                                            \
                       HSR_OF_FACE,                                            \
                       HSR_OF_FACE,                                            \
                       "farther|nearer"},                                      \
  [HSR_PEEL_FARTHEST] = {"farthest tests",                                     \
                         "transparent faces compared in depth with the "       \
                         "farthest of the layer so far",                       \
                         HSR_COMPARE,                                          \
                         HSR_OF_FACE,                                          \
                         HSR_OF_FACE,                                          \
                         "nearer|farther"},                                    \
  [HSR_PEEL_LAYERS] = {"layers", "passes over the transparent faces",          \
                       HSR_ACTIVATE, HSR_OF_WINDOW},                           \
  [HSR_PEEL_SHOWN] = {                                                         \
      "combined",                                                              \
      "colours shown at samples: of opaque faces, and then of "                \
      "layers over them",                                                      \
      HSR_ACCEPT, HSR_OF_FACE, HSR_OF_WINDOW}

/* Their lines of the outline. */
#define HSR_PEEL_LINES                                                         \
  {"for each layer of transparent faces", HSR_RAISES(HSR_PEEL_LAYERS)},        \
      {"  for each of these, at each sample: nearer than what is combined?",   \
       HSR_RAISES(HSR_PEEL_BEHIND)},                                           \
      {"    and farther than what the layer has there so far? Keep it",        \
       HSR_RAISES(HSR_PEEL_FARTHEST)},                                         \
  {                                                                            \
    "  put the layer over what is combined", HSR_RAISES(HSR_PEEL_SHOWN)        \
  }

#ifdef __cplusplus
}
#endif
#endif
