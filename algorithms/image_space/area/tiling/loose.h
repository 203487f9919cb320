/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faces that have no place in the trees (common/trees/bsp.h), or none from this
 * eye. None of them is flat. They come last: at each sample their depth is
 * compared with that of the face that the sample shows. */
#ifndef HSR_ALGORITHMS_TILING_LOOSE_H
#define HSR_ALGORITHMS_TILING_LOOSE_H

#include "algorithms/algorithm.h"
#include "common/trees/bsp.h"
#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_loose {
  struct hsr_screen screen;
  uint32_t *face, n; /* ascending */
  bool *is_loose;    /* a face of the world; NULL: none is */
  bool *has_plane;   /* a face: its plane is that of the view */
  struct hsr_tally *tally;
  int compared; /* counters: a face is compared with what a sample shows, */
  int shown;    /* and is written there */
};

/* Finds them; the counters are those of struct hsr_loose. HSR_E_NOMEM. */
enum hsr_status hsr_loose_begin(struct hsr_loose *loose,
                                const struct hsr_bsp *bsp,
                                const struct hsr_view *view,
                                struct hsr_tally *tally, int compared,
                                int shown, struct hsr_arena *arena);

/* That a filtered picture cannot have them: HSR_E_REFUSED. There is one at
 * least. */
enum hsr_status hsr_loose_refuse(const struct hsr_loose *loose,
                                 const struct hsr_world *world,
                                 struct hsr_error *err);

/* The counters of a module that draws them. */
#define HSR_LOOSE_COUNTERS(compared, shown)                                    \
  [compared] = {"thickness checks",                                            \
                "comparisons in depth with faces that are not flat and have "  \
                "no place in the trees",                                       \
                HSR_COMPARE,                                                   \
                HSR_OF_FACE,                                                   \
                HSR_OF_FACE,                                                   \
                "farther|nearer"},                                             \
  [shown] = {"loose samples",                                                  \
             "where such a face is the nearest so far: written", HSR_ACCEPT,   \
             HSR_OF_FACE, HSR_OF_WINDOW}

#define HSR_LOOSE_LINES(compared, shown)                                       \
  {"for each face that is not flat and has no place in the trees"},            \
      {"  at each sample: is it nearer than the face there?",                  \
       HSR_RAISES(compared)},                                                  \
  {                                                                            \
    "    display it", HSR_RAISES(shown)                                        \
  }

/* Draws them over a picture of ids. */
void hsr_loose_draw(struct hsr_loose *loose, uint32_t *ids, size_t stride);

#ifdef __cplusplus
}
#endif
#endif
