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
};

/* Finds them; HSR_E_NOMEM. */
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

/* What it counts. */
extern const struct hsr_part hsr_loose_part;
enum { HSR_LOOSE_COMPARED = HSR_FIRST_OF(HSR_PART_LOOSE), HSR_LOOSE_SHOWN };

/* Draws them over a picture of ids. */
void hsr_loose_draw(struct hsr_loose *loose, uint32_t *ids, size_t stride);

#ifdef __cplusplus
}
#endif
#endif
