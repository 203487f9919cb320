/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faces that the trees have no place for (common/trees/bsp.h), or none from this eye:
 * all of them are not flat. They come last, and are compared in depth at each
 * sample with what is there. */
#ifndef HSR_ALGORITHMS_TILING_LOOSE_H
#define HSR_ALGORITHMS_TILING_LOOSE_H

#include "algorithms/algorithm.h"
#include "common/trees/bsp.h"
#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Compiled twice, as the algorithms are. */
#define hsr_loose_begin HSR_OF_BUILD(hsr_loose_begin)
#define hsr_loose_refuse HSR_OF_BUILD(hsr_loose_refuse)
#define hsr_loose_draw HSR_OF_BUILD(hsr_loose_draw)

struct hsr_loose {
  struct hsr_screen screen;
  uint32_t *face, n; /* ascending */
  bool *is_loose;    /* a face of the world; NULL: none is */
  bool *has_plane;   /* a face: its plane is that of the view */
  struct hsr_tally *tally;
  uint64_t compared;
};

/* Finds them. HSR_E_NOMEM. */
enum hsr_status hsr_loose_begin(struct hsr_loose *loose,
                                const struct hsr_bsp *bsp,
                                const struct hsr_view *view,
                                struct hsr_tally *tally,
                                struct hsr_arena *arena);

/* That a filtered picture cannot have them: HSR_E_REFUSED. There is one at
 * least. */
enum hsr_status hsr_loose_refuse(const struct hsr_loose *loose,
                                 const struct hsr_world *world,
                                 struct hsr_error *err);

/* Draws them over a picture of ids. */
void hsr_loose_draw(struct hsr_loose *loose, uint32_t *ids, size_t stride);

#ifdef __cplusplus
}
#endif
#endif
